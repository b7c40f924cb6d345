#include "request/compare.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory_error.h"
#include "output/json/comparison_json.h"

enum { VALUE_SIZE = 64 };

static bool is_word(const char *text, size_t size, const char *word)
{
    return strlen(word) == size && memcmp(text, word, size) == 0;
}

/* Reads a number of at least 0. */
static bool read_length(const char *text, size_t size, double *out)
{
    char copy[VALUE_SIZE], *end;
    if (size == 0 || size >= sizeof copy || memchr("0123456789.", *text, 11) == NULL) return false;
    memcpy(copy, text, size);
    copy[size] = '\0';
    *out = strtod(copy, &end);
    return *end == '\0' && *out >= 0.0 && *out < HUGE_VAL;
}

static enum zr_status read_parameter(const char *text, size_t size, struct zr_comparison_options *out,
                                     struct zr_error *error)
{
    const char *equals = memchr(text, '=', size);
    const size_t name = equals ? (size_t)(equals - text) : size, length = equals ? size - name - 1 : 0;
    const char *value = equals ? equals + 1 : text + size;
    if (is_word(text, name, "tolerance")) {
        if (read_length(value, length, &out->tolerance)) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "tolerance", "a length of at least 0 is needed");
    }
    if (is_word(text, name, "precision")) {
        out->is_quick = is_word(value, length, "quick");
        if (out->is_quick || is_word(value, length, "full")) return ZR_OK;
        return zr_error_add(error, ZR_BAD_REQUEST, "precision", "one of: quick, full");
    }
    if (is_word(text, name, "align")) {
        for (int i = 0; i < 4; i++)
            if (is_word(value, length, zr_align_words[i])) {
                out->align = (enum zr_align)i;
                return ZR_OK;
            }
        return zr_error_add(error, ZR_BAD_REQUEST, "align", "one of: none, bounds, principal, icp");
    }
    return zr_error_add(error, ZR_BAD_REQUEST, NULL,
                        "unknown parameter; those of comparisons are align, precision, tolerance");
}

static enum zr_status read_query(const char *query, struct zr_comparison_options *out, struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    *out = (struct zr_comparison_options){.tolerance = -1.0};
    while (query && *query && status == ZR_OK) {
        const size_t size = strcspn(query, "&");
        if (size > 0) status = read_parameter(query, size, out, error);
        query += size + (query[size] == '&');
    }
    return status;
}

enum zr_status zr_compare(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                          const char *query, struct zr_compare_answer *answer)
{
    struct zr_comparison_options options;
    struct zr_comparison comparison;
    struct zr_buffer buffer = {.arena = run->arena};
    enum zr_status status = read_query(query, &options, run->error);
    if (status == ZR_OK) status = zr_comparison_make(run, a, b, &options, &comparison);
    if (status == ZR_OK) status = zr_comparison_json_write(&comparison, a, b, &buffer);
    if (status == ZR_OK && !zr_buffer_add(&buffer, "", 1)) status = ZR_NO_MEMORY;
    if (status == ZR_NO_MEMORY) return zr_memory_error_add(run->error, run->arena, "comparing", "");
    if (status != ZR_OK) return status;
    *answer = (struct zr_compare_answer){(const char *)buffer.bytes, buffer.size - 1, comparison.is_same};
    return ZR_OK;
}
