/* Bodies of several parts: taken apart, or refused where two readers could disagree. */
#include <stdio.h>
#include <string.h>

#include "routes/multipart.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

#define B       "--AaB03x\r\n"
#define END     "\r\n--AaB03x--\r\n"
#define NAME(x) "Content-Disposition: form-data; name=\"" x "\"\r\n"

static struct multipart parts;
static const char *fault;

static bool parse(const char *bytes, size_t size)
{
    struct guarded guarded = guarded_copy(bytes, size);
    fault = "";
    bool ok = multipart_parse("AaB03x", guarded.bytes, size, &parts, &fault);
    for (size_t i = 0; ok && i < parts.count; i++) { /* what is outside of the body crashes here, or is not equal */
        const struct multipart_part *part = &parts.parts[i];
        assert_true(part->bytes >= guarded.bytes && part->bytes + part->size <= guarded.bytes + size);
        parts.parts[i].bytes = bytes + (part->bytes - guarded.bytes);
        if (part->type) parts.parts[i].type = bytes + (part->type - guarded.bytes);
        assert_true(strlen(part->name) >= 1 && strlen(part->name) <= MULTIPART_NAME_MAX);
    }
    guarded_free(&guarded);
    return ok;
}

static void assert_part(size_t index, const char *name, const char *bytes)
{
    const struct multipart_part *part = &parts.parts[index];
    assert_string_equal(part->name, name);
    assert_int_equal(part->size, strlen(bytes));
    assert_memory_equal(part->bytes, bytes, part->size);
    assert_ptr_equal(multipart_find(&parts, name), part);
}

TEST(parts_are_found_with_their_names_and_types)
{
    static const char body[] =
        B NAME("scene") "Content-Type: application/json; charset=utf-8\r\n\r\n{}\r\n" B
                        "content-type:image/png \r\ncontent-disposition:form-data;name=color ; filename=\"C:\\a "
                        "\\\"b\\\";name=c\"\r\n\r\n"
                        "\x89PNG\r\n--AaB03\r\n--AaB0\n--AaB03x\r\r\n" B NAME(
                            "last") "X-Other: 1\r\nzraster-use: optional\r\n\r\n" END "epilogue";
    assert_true(parse(body, sizeof body - 1));
    assert_int_equal(parts.count, 3);
    assert_part(0, "scene", "{}");
    assert_int_equal(parts.parts[0].type_size, strlen("application/json; charset=utf-8"));
    assert_part(1, "color", "\x89PNG\r\n--AaB03\r\n--AaB0\n--AaB03x\r");
    assert_memory_equal(parts.parts[1].type, "image/png", parts.parts[1].type_size);
    assert_int_equal(parts.parts[1].type_size, 9);
    assert_part(2, "last", "");
    assert_null(parts.parts[2].type);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(parts.parts[i].is_optional, i == 2);
    assert_null(multipart_find(&parts, "c"));
}

TEST(preamble_padding_and_an_empty_part_are_understood)
{
    static const char body[] =
        "This is MIME.\r\n--AaB03x \t\r\n" NAME("a") "\r\n--AaB03x\r\n" NAME("b") "\r\n\r\n\r\n--AaB03x--";
    assert_true(parse(body, sizeof body - 1));
    assert_int_equal(parts.count, 2);
    assert_part(0, "a", "");
    assert_part(1, "b", "\r\n");
    assert_true(parse("--AaB03x--", 10));
    assert_int_equal(parts.count, 0);
}

TEST(bodies_that_are_not_whole_or_ambiguous_are_refused)
{
    static const struct {
        const char *body, *fault;
    } cases[] = {
        {"", "does not contain the boundary"},
        {"{}", "does not contain the boundary"},
        {"--AaB03", "does not contain the boundary"},
        {"x--AaB03x--", "does not contain the boundary"},
        {"\n--AaB03x--", "does not contain the boundary"},
        {"--AaB03x", "closing boundary"},
        {"--AaB03x-", "bytes follow a boundary"},
        {"--AaB03xy\r\n", "bytes follow a boundary"},
        {"--AaB03x\n" NAME("a") "\r\n1" END, "bytes follow a boundary"},
        {B, "break off"},
        {B NAME("a"), "break off"},
        {B NAME("a") "\r\n1", "closing boundary"},
        {B NAME("a") "\r\n1\r\n--AaB03x", "closing boundary"},
        {B NAME("a") "\r\n1\r\n--AaB03xyz--\r\n", "bytes follow a boundary"},
        {B NAME("a") "\r\n1\r\n" B NAME("a") "\r\n2" END, "the same name"},
        {B "\r\n1" END, "no Content-Disposition"},
        {B "Content-Type: text/plain\r\n\r\n1" END, "no Content-Disposition"},
        {B NAME("a") NAME("b") "\r\n1" END, "two Content-Disposition"},
        {B "Content-Disposition: form-data\r\n\r\n1" END, "no name"},
        {B "Content-Disposition: form-data; name=\"\"\r\n\r\n1" END, "1 to 128"},
        {B "Content-Disposition: form-data; name=\r\n\r\n1" END, "malformed"},
        {B "Content-Disposition: form-data; name=\"a\r\n\r\n1" END, "malformed"},
        {B "Content-Disposition: form-data; name=\"a\" b\r\n\r\n1" END, "malformed"},
        {B "Content-Disposition: form-data; name=\"a\"; name=\"b\"\r\n\r\n1" END, "two names"},
        {B "Content-Disposition: form-data; filename=\"a\"\r\n\r\n1" END, "no name"},
        {B "Content-Disposition: form-data; name*=utf-8''a\r\n\r\n1" END, "no name"},
        {B "Content-Disposition: attachment; name=\"a\"\r\n\r\n1" END, "not form-data"},
        {B "Content-Disposition: form-data; name=\"a\\\"b\"\r\n\r\n1" END, "backslash"},
        {B "Content-Disposition: form-data; name=\"a\tb\"\r\n\r\n1" END, "control character"},
        {B "Content-Disposition: form-data;\r\n name=\"a\"\r\n\r\n1" END, "no name"},
        {B "Content-Disposition: form-data; name=\"a\"\n\r\n1" END, "control character"},
        {B "Content-Disposition : form-data; name=\"a\"\r\n\r\n1" END, "malformed"},
        {B "nothing\r\n\r\n1" END, "malformed"},
        {B NAME("a") "Content-Transfer-Encoding: base64\r\n\r\nMQ==" END, "Content-Transfer-Encoding"},
        {B NAME("a") "Content-Type: a/b\r\nContent-Type: c/d\r\n\r\n1" END, "two Content-Type"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_false(parse(cases[i].body, strlen(cases[i].body)));
        if (!strstr(fault, cases[i].fault)) fail_msg("case %zu: %s", i, fault);
    }
}

TEST(bounds_are_kept_to_the_byte)
{
    char body[32768], name[200];
    for (size_t length = MULTIPART_NAME_MAX; length <= MULTIPART_NAME_MAX + 1; length++) {
        memset(name, 'n', length);
        name[length] = '\0';
        int size = snprintf(body, sizeof body, B "Content-Disposition: form-data; name=\"%s\"\r\n\r\n1" END, name);
        assert_int_equal(parse(body, (size_t)size), length == MULTIPART_NAME_MAX);
    }
    for (int count = MULTIPART_PARTS_MAX; count <= MULTIPART_PARTS_MAX + 1; count++) {
        int size = 0;
        for (int i = 0; i < count; i++)
            size += snprintf(body + size, sizeof body - (size_t)size,
                             B "Content-Disposition: form-data; name=p%d\r\n\r\n\r\n", i);
        size += snprintf(body + size, sizeof body - (size_t)size, "--AaB03x--");
        assert_int_equal(parse(body, (size_t)size), count == MULTIPART_PARTS_MAX);
        if (count > MULTIPART_PARTS_MAX) assert_string_equal(fault, "the body has more than 256 parts");
    }
    for (int more = 0; more < 2; more++) {
        static const char FIXED[] = NAME("a") "X: \r\n\r\n";
        int fill = MULTIPART_HEADER_MAX - (int)(sizeof FIXED - 1) + more;
        int size = snprintf(body, sizeof body, B NAME("a") "X: %0*d\r\n\r\n1" END, fill, 0);
        assert_int_equal(parse(body, (size_t)size), !more);
        if (more) assert_string_equal(fault, "a part's headers have more than 4096 bytes");
    }
}

TEST(boundaries_are_taken_as_rfc_2046_says)
{
    char boundary[MULTIPART_BOUNDARY_SIZE], type[200], seventy[72];
    static const char *const good[][2] = {
        {"multipart/form-data; boundary=AaB03x", "AaB03x"},
        {"multipart/form-data;boundary=\"AaB03x\"", "AaB03x"},
        {"multipart/form-data ; charset=utf-8; Boundary=----WebKitFormBoundary7MA4YWxk;",
         "----WebKitFormBoundary7MA4YWxk"},
        {"multipart/form-data; boundary=\"a b:c/(d)=?\"", "a b:c/(d)=?"},
        {"multipart/form-data; boundary='+_.-", "'+_.-"},
        {"multipart/form-data; boundary=--=_a/b?:(c); charset=utf-8", "--=_a/b?:(c)"},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        if (!multipart_boundary(good[i][0], boundary, &fault)) fail_msg("%s: %s", good[i][0], fault);
        assert_string_equal(boundary, good[i][1]);
    }
    static const char *const bad[] = {
        "multipart/form-data",
        "multipart/form-data; charset=utf-8",
        "multipart/form-data; boundary",
        "multipart/form-data; boundary=",
        "multipart/form-data; boundary=\"\"",
        "multipart/form-data; boundary=\"a",
        "multipart/form-data; boundary=\"a \"",
        "multipart/form-data; boundary=\"a\\b\"",
        "multipart/form-data; boundary=\"a&b\"",
        "multipart/form-data; boundary=a&b",
        "multipart/form-data; boundary=a; boundary=b",
        "multipart/form-data; boundary=a b",
        "multipart/form-data boundary=a",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (multipart_boundary(bad[i], boundary, &fault)) fail_msg("%s gave %s", bad[i], boundary);
    for (size_t length = 70; length <= 71; length++) {
        memset(seventy, 'b', length);
        seventy[length] = '\0';
        snprintf(type, sizeof type, "multipart/form-data; boundary=%s", seventy);
        assert_int_equal(multipart_boundary(type, boundary, &fault), length == 70);
    }
}

TEST(bodies_with_anything_changed_never_lead_outside)
{
    static const char body[] = B NAME("scene") "Content-Type: application/json\r\n\r\n{}\r\n" B NAME(
        "b") "\r\n12345\r\n" B "Content-Disposition: form-data; name=c; filename=\"d\\\"e\"\r\n\r\n" END;
    static const char pieces[] = "\r\n-\"\\;=: AaB03x\0\x80";
    struct random random = random_seeded(29);
    int parsed = 0, refused = 0;
    for (int round = 0; round < 30000; round++) {
        char mutated[sizeof body * 2];
        size_t size = sizeof body - 1;
        memcpy(mutated, body, size);
        for (uint32_t k = random_below(&random, 4); k > 0; k--) {
            size_t at = random_below(&random, (uint32_t)size), count = random_below(&random, 12);
            if (count > size - at) count = size - at;
            char byte = pieces[random_below(&random, sizeof pieces - 1)];
            switch (random_below(&random, 3)) {
            case 0: /* changed */
                mutated[at] = byte;
                break;
            case 1: /* left out */
                memmove(mutated + at, mutated + at + count, size - at - count);
                size -= count;
                break;
            default: /* repeated */
                if (size + count > sizeof mutated) break;
                memmove(mutated + at + count, mutated + at, size - at);
                size += count;
            }
        }
        if (parse(mutated, size))
            parsed++;
        else
            refused++;
        assert_true(parts.count <= MULTIPART_PARTS_MAX);
    }
    for (size_t cut = 0; cut < sizeof body - 5; cut++) /* as far as the closing "--" is not whole */
        assert_false(parse(body, cut));
    assert_true(parsed > 3000 && refused > 3000);
}

RUN_TESTS(NULL, NULL)
