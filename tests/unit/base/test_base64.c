/* Bytes as text: base64, and the data: URIs that hold it. */
#include <stdlib.h>
#include <string.h>

#include "input/text/base64.h"
#include "support/input/base64.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

/* Decodes from a guard page to one: a byte too far on either side is a crash. */
static bool decode(const char *text, size_t size, unsigned char *out, size_t *used)
{
    struct guarded from = guarded_copy(text, size), to = guarded_copy(text, zr_base64_room(size));
    bool ok = zr_base64_decode(from.bytes, size, (unsigned char *)(uintptr_t)to.bytes, used);
    if (ok && *used > 0) memcpy(out, to.bytes, *used);
    guarded_free(&from);
    guarded_free(&to);
    return ok;
}

/* RFC 4648, section 10. */
TEST(vectors_of_the_rfc_are_decoded)
{
    static const struct {
        const char *text, *bytes;
    } vectors[] = {{"", ""},
                   {"Zg==", "f"},
                   {"Zm8=", "fo"},
                   {"Zm9v", "foo"},
                   {"Zm9vYg==", "foob"},
                   {"Zm9vYmE=", "fooba"},
                   {"Zm9vYmFy", "foobar"}};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        unsigned char out[8];
        size_t used;
        assert_true(decode(vectors[i].text, strlen(vectors[i].text), out, &used));
        assert_int_equal(used, strlen(vectors[i].bytes));
        assert_memory_equal(out, vectors[i].bytes, used);
    }
}

TEST(any_bytes_come_back)
{
    struct random random = random_seeded(5);
    for (size_t size = 0; size < 300; size++) {
        unsigned char bytes[300] = {0}, out[300];
        for (size_t i = 0; i < size; i++)
            bytes[i] = (unsigned char)random_next(&random);
        char *text = base64_of("", bytes, size);
        size_t used;
        assert_true(decode(text, strlen(text), out, &used));
        assert_int_equal(used, size);
        if (size > 0) assert_memory_equal(out, bytes, size);
        free(text);
    }
}

TEST(text_that_is_not_base64_is_refused_where_it_shows)
{
    static const struct {
        const char *text;
        size_t at;
    } cases[] = {
        {"Z", 1},          {"Zg", 2},         {"Zg=", 2},      {"Zm9", 3},          {"=", 0},
        {"====", 0},       {"Z===", 1},       {"Zg==Zg==", 2}, {"Zm=v", 2},         {"Zm9vZ", 5},
        {"Zm9v\n", 4},     {"Zm9v\nZm9v", 4}, {" Zm9", 0},     {"Zm9-", 3},         {"Zm9_", 3},
        {"Zm9\x80", 3},    {"Zh==", 2},       {"Zm9=", 3},     {"Zm9vZm8=Zm8=", 7}, {"Zm9%Zm9v", 3},
        {"Zm9vZg==\n", 6},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char out[16];
        size_t used;
        assert_false(decode(cases[i].text, strlen(cases[i].text), out, &used));
        if (used != cases[i].at) fail_msg("'%s' was refused at %zu", cases[i].text, used);
    }
}

/* Of all bytes in all places of two groups only the alphabet is taken. */
TEST(every_byte_outside_the_alphabet_is_refused)
{
    for (size_t at = 0; at < 8; at++)
        for (int c = 1; c < 256; c++) {
            char text[9] = "AAAAAAAA";
            text[at] = (char)c;
            bool letter =
                (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
            unsigned char out[8];
            size_t used;
            bool want = letter || (c == '=' && at == 7);
            assert_int_equal(decode(text, 8, out, &used), want);
        }
}

static enum zr_status read_uri(const char *text, const void **bytes, size_t *size, struct zr_reason *reason)
{
    static struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    struct guarded guarded = guarded_copy(text, strlen(text));
    enum zr_status status = zr_data_uri_read(&arena, guarded.bytes, strlen(text), bytes, size, reason);
    static unsigned char kept[64];
    if (status == ZR_OK) {
        assert_true(*size <= sizeof kept);
        memcpy(kept, *bytes, *size);
        *bytes = kept;
    }
    guarded_free(&guarded);
    zr_arena_free(&arena);
    return status;
}

TEST(data_uris_of_any_type_are_read)
{
    static const char *const uris[] = {"data:image/png;base64,Zm9v", "data:;base64,Zm9v", "DATA:image/png;BASE64,Zm9v",
                                       "data:application/x-npy;base64,Zm9v",
                                       "data:text/plain;charset=utf-8;base64,Zm9v"};
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        struct zr_reason reason = {""};
        const void *bytes;
        size_t size;
        assert_int_equal(read_uri(uris[i], &bytes, &size, &reason), ZR_OK);
        assert_int_equal(size, 3);
        assert_memory_equal(bytes, "foo", 3);
    }
}

TEST(other_uris_are_refused_with_a_reason)
{
    static const struct {
        const char *text, *reason;
    } cases[] = {
        {"", "not a data: URI"},
        {"dat", "not a data: URI"},
        {"https://example.org/a.png", "'https://example.org/a.png' is not a data: URI"},
        {"file:///etc/passwd", "nothing is fetched"},
        {"data:", "without ;base64,"},
        {"data:image/png", "without ;base64,"},
        {"data:image/png,abc", "without ;base64,"},
        {"data:image/png;base64", "without ;base64,"},
        {"data:base64,Zm9v", "without ;base64,"},
        {"data:image/png;base64;x=y,Zm9v", "without ;base64,"},
        {"data:;base64,Zm9", "cut short: 3 characters"},
        {"data:;base64,Zm9v Zm9v", "character 4: ' '"},
        {"data:;base64,Zm9v%3D", "character 4: '%'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_reason reason = {""};
        const void *bytes;
        size_t size;
        assert_int_equal(read_uri(cases[i].text, &bytes, &size, &reason), ZR_BAD_SCENE);
        if (!strstr(reason.text, cases[i].reason)) fail_msg("'%s': %s", cases[i].text, reason.text);
    }
}

TEST(data_uri_without_memory_fails_cleanly)
{
    struct zr_arena arena;
    struct zr_reason reason;
    const void *bytes;
    size_t size;
    zr_arena_init(&arena, 0);
    assert_int_equal(zr_data_uri_read(&arena, "data:;base64,Zm9v", 17, &bytes, &size, &reason), ZR_NO_MEMORY);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
