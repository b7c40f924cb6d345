#include <dirent.h>

#include "support/files.h"
#include "support/tests.h"
#include "unit/common/guarded.h"
#include "unit/common/json_strict.h"

static struct zr_error error;

static enum zr_status scan_limited(const void *bytes, size_t size, struct zr_limits limits, size_t ceiling)
{
    struct zr_arena arena;
    zr_arena_init(&arena, ceiling);
    struct guarded guarded = guarded_copy(bytes, size);
    memset(&error, 0, sizeof error);
    enum zr_status status = read_strictly(&arena, guarded.bytes, size, &limits, &error);
    guarded_free(&guarded);
    zr_arena_free(&arena);
    assert_int_equal(status, error.status);
    assert_int_equal(error.count, status == ZR_OK ? 0 : 1);
    return status;
}

static enum zr_status scan(const char *text)
{
    return scan_limited(text, strlen(text), zr_limits_default(), (size_t)1 << 26);
}

static void expect_status(const char *text, enum zr_status status)
{
    if (scan(text) != status) fail_msg("%s: status %d, detail '%s'", text, (int)error.status, error.items[0].detail);
}

static void expect_detail(const char *text, const char *detail)
{
    assert_true(scan(text) != ZR_OK);
    assert_string_equal(error.items[0].pointer, "");
    if (!strstr(error.items[0].detail, detail)) fail_msg("'%s' does not say '%s'", error.items[0].detail, detail);
}

TEST(valid_texts_are_accepted)
{
    expect_status("{\"a\": [1, -2.5e+3, true, false, null, \"x\"], \"b\": {}}", ZR_OK);
    expect_status(" \t\r\n0 \n", ZR_OK);
    expect_status("\"a long string that takes more than one word of eight bytes\"", ZR_OK);
    expect_status("\"\\ud83d\\uDE00 \xF0\x9F\x98\x80 \xC3\xA4 \xE2\x82\xAC\"", ZR_OK);
}

TEST(malformed_texts_are_refused)
{
    static const char *const texts[] = {
        "",           " ",        "[1,]",      "[,1]",         "[1 2]",     "{\"a\"}",  "{\"a\":}",
        "{\"a\":1,}", "{a:1}",    "[1}",       "{\"a\":1]",    "[",         "]",        "01",
        "-",          "+1",       "1.",        ".5",           "1e",        "1e+",      "0x1",
        "NaN",        "Infinity", "tru",       "truee",        "nul",       "'a'",      "\"a",
        "\"\\\"",     "\"\\x\"",  "\"\\u12\"", "\"\\u12g4\"",  "\"a\nb\"",  "\"a\tb\"", "1 2",
        "[1] x",      "// c\n1",  "[1,//\n2]", "\"\x7f\x80\"", "{\"a\" 1}", "{1:1}",    "\"\\",
        "\"\\u",      "[\"",      "-a"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        expect_status(texts[i], ZR_BAD_SYNTAX);
    assert_int_equal(scan_limited("[1\0]", 4, zr_limits_default(), 4096), ZR_BAD_SYNTAX);
    assert_int_equal(scan_limited("\"a\0b\"", 5, zr_limits_default(), 4096), ZR_BAD_SYNTAX);
    assert_int_equal(scan_limited(NULL, 0, zr_limits_default(), 4096), ZR_BAD_SYNTAX);
}

TEST(every_prefix_of_a_text_is_refused_within_its_bytes)
{
    static const char text[] =
        "{\"k\\u00e9y\": [true, false, null, -1.5e-7, \"\\ud83d\\ude00 \xE2\x82\xAC\"], \"b\": {}}";
    for (size_t size = 0; size < sizeof text - 1; size++)
        assert_int_equal(scan_limited(text, size, zr_limits_default(), 4096), ZR_BAD_SYNTAX);
    expect_status(text, ZR_OK);
}

TEST(invalid_utf8_is_refused)
{
    static const char *const texts[] = {"\"\x80\"",
                                        "\"\xC0\xAF\"",
                                        "\"\xC1\xBF\"",
                                        "\"\xC3\"",
                                        "\"\xE0\x80\xAF\"",
                                        "\"\xED\xA0\x80\"",
                                        "\"\xE2\x82\"",
                                        "\"\xF0\x80\x80\xAF\"",
                                        "\"\xF4\x90\x80\x80\"",
                                        "\"\xF5\x80\x80\x80\"",
                                        "\"\xF0\x9F\x98\"",
                                        "\"\xFF\"",
                                        "{\"\xFF\":1}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        expect_status(texts[i], ZR_BAD_SYNTAX);
        assert_non_null(strstr(error.items[0].detail, "UTF-8"));
    }
}

TEST(escaped_surrogate_without_partner_is_refused)
{
    static const char *const texts[] = {"\"\\ud800\"",       "\"\\udc00\"",        "\"\\ud800x\"",
                                        "\"\\ud800\\n\"",    "\"\\ud800\\ud800\"", "\"\\udc00\\ud800\"",
                                        "\"\\ud800\\u0041\""};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        expect_status(texts[i], ZR_BAD_SYNTAX);
}

TEST(byte_order_mark_is_refused_by_name)
{
    expect_detail("\xEF\xBB\xBF{}", "byte order mark");
    assert_int_equal(error.status, ZR_BAD_SYNTAX);
}

TEST(complaint_names_line_and_column_in_characters)
{
    expect_detail("{\n  \"\xC3\xA4\": x}", "line 2, column 8: expected a value, found 'x'");
    expect_detail("[1,\n2,\n3", "line 3, column 2: expected ',' or ']', found the end of the text");
    expect_detail("[1,]", "line 1, column 4: expected a value, found ']'");
    expect_detail("[01]", "line 1, column 2: expected a number without leading zeros");
}

TEST(too_deep_gives_bad_scene)
{
    struct zr_limits limits = zr_limits_default();
    limits.json_depth_max = 3;
    assert_int_equal(scan_limited("[[[1]]]", 7, limits, 4096), ZR_OK);
    assert_int_equal(scan_limited("[[\n[{}]]]", 9, limits, 4096), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].detail, "line 2, column 2: nested deeper than 3 levels");
}

/* Nothing behind it is looked at: as many brackets as a body has bytes cost nothing. */
TEST(too_deep_a_text_is_refused_where_it_is_too_deep)
{
    size_t size = 200000;
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, '[', size);
    assert_int_equal(scan_limited(text, size, zr_limits_default(), 4096), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].detail, "line 1, column 65: nested deeper than 64 levels");
    free(text);
}

TEST(kinds_of_all_levels_are_kept)
{
    enum { LEVELS = ZR_JSON_DEPTH_MAX };
    static char text[LEVELS * 8];
    char *at = text;
    for (int i = 0; i < LEVELS; i++)
        at += sprintf(at, "%s", i % 3 ? "[" : "{\"a\":");
    at += sprintf(at, "0");
    for (int i = LEVELS; i-- > 0;)
        *at++ = i % 3 ? ']' : '}';
    *at = '\0';
    struct zr_limits limits = zr_limits_default();
    limits.json_depth_max = LEVELS;
    assert_int_equal(scan_limited(text, strlen(text), limits, (size_t)1 << 20), ZR_OK);
    for (int back = 1; back <= LEVELS; back++) {
        at[-back] = at[-back] == ']' ? '}' : ']';
        assert_int_equal(scan_limited(text, strlen(text), limits, (size_t)1 << 20), ZR_BAD_SYNTAX);
        at[-back] = at[-back] == ']' ? '}' : ']';
    }
}

TEST(escaped_zero_gives_bad_scene)
{
    expect_status("[\"a\\u0000\"]", ZR_BAD_SCENE);
    assert_string_equal(error.items[0].detail, "line 1, column 4: U+0000 in a string");
    expect_status("{\"\\u0000\": 1}", ZR_BAD_SCENE);
    expect_status("[\"a\\u0000", ZR_BAD_SCENE);
    expect_status("[\"a\" \"\\u0000", ZR_BAD_SYNTAX);
}

TEST(numbers_may_have_any_length)
{
    static char text[2000] = "0.";
    memset(text + 2, '1', sizeof text - 3);
    expect_status(text, ZR_OK);
}

static struct guarded load(const char *path)
{
    size_t size = 0;
    char *bytes = file_read(path, &size);
    if (!bytes) fail_msg("cannot read %s", path);
    struct guarded copy = guarded_copy(bytes, size);
    free(bytes);
    return copy;
}

TEST(json_test_suite_is_judged_as_its_names_say)
{
    const char *data = getenv("ZRASTER_DATA");
    char folder[512], path[1024];
    snprintf(folder, sizeof folder, "%s/json-test-suite/test_parsing", data ? data : "../shared/data");
    DIR *directory = opendir(folder);
    if (!directory) {
        fprintf(stderr, "LEFT OUT: the JSON test suite, for want of the folder %s (set ZRASTER_DATA)\n", folder);
        skip();
    }
    int refused = 0, accepted = 0;
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        struct guarded file = load(path);
        enum zr_status status = scan_limited(file.bytes, file.size, zr_limits_default(), (size_t)1 << 26);
        const bool malformed = status == ZR_BAD_SYNTAX;
        guarded_free(&file);
        if (entry->d_name[0] == 'n' && !malformed && !strstr(error.items[0].detail, "nested deeper"))
            fail_msg("%s: status %d", entry->d_name, (int)status);
        if (entry->d_name[0] == 'y' && malformed) fail_msg("%s: %s", entry->d_name, error.items[0].detail);
        refused += entry->d_name[0] == 'n';
        accepted += entry->d_name[0] == 'y';
    }
    closedir(directory);
    assert_true(refused >= 180 && accepted >= 90);
}

RUN_TESTS(NULL, NULL)
