/* Texts of proxies and clients about a connection. The first byte says which: p, a PROXY header; f, Forwarded; x,
 * X-Forwarded-For; t, traceparent. The log shows all of them. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "gate/forwarded.h"
#include "http/proxy_header.h"
#include "log/log_text.h"
#include "log/trace.h"

static void fuzz_proxy_header(const char *bytes, size_t size)
{
    struct proxy_header whole = {0}, split = {0};
    size_t taken = proxy_header_take(&whole, bytes, size), one = 0;
    for (size_t more = 1; one < size && more == 1; one += more)
        more = proxy_header_take(&split, bytes + one, 1);
    fuzz_expect(whole.is_whole == split.is_whole && whole.wrong == split.wrong && whole.taken == split.taken &&
                    whole.has_source == split.has_source && ip_is_same(&whole.source, &split.source),
                "pieces do not matter");
    fuzz_expect(taken <= PROXY_HEADER_V2_MAX, "a header is bounded");
    fuzz_expect(taken == size || whole.is_whole || whole.wrong, "bytes are left behind an end only");
    fuzz_accepted = whole.is_whole;
}

/* The address of the client stands last before those of proxies, whatever it sends itself. */
static void fuzz_forwarded(enum forwarded_form form, const char *text)
{
    static const char *const APPENDED[] = {[FORWARDED_FOR] = ", 8.8.8.8, 10.0.0.2",
                                           [FORWARDED_STANDARD] = ", for=8.8.8.8;by=\"_a,b\", for=\"10.0.0.2:80\""};
    struct networks trusted;
    struct ip peer, wanted;
    fuzz_expect(networks_parse(&trusted, "10.0.0.0/8") && ip_parse(&peer, "10.0.0.1", 8) &&
                    ip_parse(&wanted, "8.8.8.8", 7),
                "these are addresses");
    const struct ip client = forwarded_client(form, &trusted, &peer, text);
    fuzz_accepted = !networks_contain(&trusted, &client);
    char *list = malloc(strlen(text) + strlen(APPENDED[form]) + 1);
    fuzz_expect(list, "memory");
    strcpy(stpcpy(list, text), APPENDED[form]);
    const struct ip found = forwarded_client(form, &trusted, &peer, list);
    fuzz_expect(ip_is_same(&found, &wanted), "a client cannot choose its address");
    free(list);
}

static void fuzz_trace(const char *text)
{
    struct trace trace, again;
    fuzz_accepted = trace_read(&trace, text, strlen(text));
    if (!fuzz_accepted) return;
    fuzz_expect(trace_read(&again, trace.answer, 1), "an answer is valid");
    fuzz_expect(strcmp(again.id, trace.id) == 0 && strcmp(again.parent, trace.span) == 0, "and of the same trace");
}

static void fuzz_log(const char *text)
{
    char escaped[LOG_TEXT_ESCAPED_SIZE], shown[64];
    log_text_escape(escaped, text);
    fuzz_expect(strlen(escaped) < sizeof escaped, "the room is enough");
    for (const char *c = escaped; *c; c++) {
        fuzz_expect((unsigned char)*c >= ' ' && *c != 0x7F, "no byte ends the string or the line");
        fuzz_expect(*c != '"', "a quote is escaped");
        if (*c == '\\') fuzz_expect(*++c, "an escape is whole");
    }
    log_text_redact(shown, sizeof shown, text);
    fuzz_expect(strlen(shown) < sizeof shown, "the copy is bounded");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_accepted = false;
    if (size == 0) return 0;
    char *text = malloc(size);
    fuzz_expect(text, "memory");
    memcpy(text, data + 1, size - 1);
    text[size - 1] = '\0';
    fuzz_log(text);
    if (*data == 'p') fuzz_proxy_header((const char *)data + 1, size - 1);
    if (*data == 'f') fuzz_forwarded(FORWARDED_STANDARD, text);
    if (*data == 'x') fuzz_forwarded(FORWARDED_FOR, text);
    if (*data == 't') fuzz_trace(text);
    free(text);
    return 0;
}
