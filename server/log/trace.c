#include "trace.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { LENGTH = TRACE_PARENT_SIZE - 1, ID_AT = 3, PARENT_AT = 36, FLAGS_AT = 53, SAMPLED = 1, KNOWN_FLAGS = 3 };

static bool is_hex(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

static bool is_valid(const char *text)
{
    static const char FORM[] = "xx-xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx-xxxxxxxxxxxxxxxx-xx";
    for (size_t i = 0; i < LENGTH; i++)
        if (FORM[i] == 'x' ? !is_hex(text[i]) : text[i] != '-') return false; /* a zero ends the loop, too */
    /* Version ff and all-zero ids are invalid. */
    if (strncmp(text, "ff", 2) == 0 || strspn(text + ID_AT, "0") >= 32 || strspn(text + PARENT_AT, "0") >= 16)
        return false;
    return text[LENGTH] == '\0' || (text[LENGTH] == '-' && strncmp(text, "00", 2) != 0);
}

/* Mixes neighbouring numbers into unlike ones: splitmix64, by Sebastiano Vigna. */
static uint64_t mix(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
}

bool trace_read(struct trace *trace, const char *traceparent, uint64_t unique)
{
    const uint64_t span = mix(unique);
    unsigned flags = 0;
    *trace = (struct trace){0};
    if (!traceparent || !is_valid(traceparent)) return false;
    sscanf(traceparent + FLAGS_AT, "%2x", &flags);
    snprintf(trace->id, sizeof trace->id, "%.32s", traceparent + ID_AT);
    snprintf(trace->parent, sizeof trace->parent, "%.16s", traceparent + PARENT_AT);
    snprintf(trace->span, sizeof trace->span, "%016" PRIx64, span ? span : 1);
    snprintf(trace->given, sizeof trace->given, "%s", traceparent);
    snprintf(trace->answer, sizeof trace->answer, "00-%s-%s-%02x", trace->id, trace->span, flags & KNOWN_FLAGS);
    trace->is_sampled = flags & SAMPLED;
    return true;
}
