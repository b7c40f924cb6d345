/* server/gate/gate.c: files of tokens, keys and presets, and what is wrong in them. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "config.h"
#include "gate/gate.h"
#include "gate/lines.h"
#include "gate/preset.h"
#include "support/tests.h"

enum { MESSAGE_SIZE = 512 };

#define KEY "000102030405060708090a0b0c0d0e0f"

/* A file that exists while a test runs; its name is the same each time. */
static char path[] = "/tmp/gate-test-XXXXXX";

static int make_file(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    return fd < 0 ? -1 : close(fd);
}

static int remove_file(void **state)
{
    (void)state;
    return unlink(path);
}

static void write_file(const char *text, size_t size, unsigned mode)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(path, mode), 0);
}

/* The settings of a daemon without flags, whose token is `token`. */
static struct config config_with(const char *token)
{
    static struct config config;
    char message[MESSAGE_SIZE], *flags[] = {"", "--token", (char *)(uintptr_t)token, NULL};
    assert_int_equal(config_read(&config, 3, flags, message, sizeof message), CONFIG_SERVE);
    return config;
}

enum file { TOKENS, KEYS, PRESETS };

/* Reads a gate from the file. */
static struct gate *read_file(enum file file, char message[MESSAGE_SIZE])
{
    struct config config = config_with("");
    char *const members[] = {config.token_file, config.keys_file, config.presets};
    snprintf(members[file], CONFIG_TEXT_SIZE, "%s", path);
    *message = '\0';
    return gate_read(&config, message, MESSAGE_SIZE);
}

static struct gate *gate_of(enum file file, const char *text)
{
    char message[MESSAGE_SIZE];
    write_file(text, strlen(text), 0600);
    struct gate *gate = read_file(file, message);
    if (!gate) fail_msg("%s", message);
    return gate;
}

/* `wanted` stands behind the file's name. */
static void assert_fault(enum file file, const char *text, size_t size, const char *wanted)
{
    char message[MESSAGE_SIZE];
    write_file(text, size, 0600);
    struct gate *gate = read_file(file, message);
    if (gate) fail_msg("accepted: %.200s", text);
    assert_memory_equal(message, path, sizeof path - 1);
    assert_string_equal(message + sizeof path - 1, wanted);
}

static bool knows(const struct gate *gate, const char *token)
{
    return gate_knows_token(gate, token, strlen(token));
}

TEST(tokens_are_those_of_the_setting_and_the_file)
{
    struct config config = config_with("of the setting");
    char message[MESSAGE_SIZE];
    write_file("# comment\n\n  one \r\ntwo", 22, 0600);
    snprintf(config.token_file, sizeof config.token_file, "%s", path);
    struct gate *gate = gate_read(&config, message, sizeof message);
    assert_non_null(gate);
    assert_true(gate_asks_for_token(gate));
    assert_true(knows(gate, "of the setting") && knows(gate, "one") && knows(gate, "two"));
    assert_false(knows(gate, "") || knows(gate, "on") || knows(gate, "one ") || knows(gate, "# comment"));
    gate_free(gate);
}

TEST(without_settings_everybody_may_ask)
{
    const struct config config = config_with("");
    char message[MESSAGE_SIZE];
    struct gate *gate = gate_read(&config, message, sizeof message);
    assert_non_null(gate);
    assert_false(gate_asks_for_token(gate) || knows(gate, ""));
    assert_int_equal(gate_keys(gate)->count, 0);
    assert_null(gate_preset(gate, ""));
    gate_free(gate);
}

TEST(only_presets_needs_presets)
{
    struct config config = config_with("");
    char message[MESSAGE_SIZE];
    strcpy(config.only_presets, "on");
    assert_null(gate_read(&config, message, sizeof message));
    assert_string_equal(message, "--only-presets=on needs --presets");
}

TEST(presets_have_names_and_queries)
{
    char names[32];
    struct gate *gate = gate_of(PRESETS, "small = look=studio&width=320\nplain=\nBig_2-x\t=\tlook=technical\r\n");
    assert_string_equal(gate_preset(gate, "small"), "look=studio&width=320");
    assert_string_equal(gate_preset(gate, "plain"), "");
    assert_string_equal(gate_preset(gate, "Big_2-x"), "look=technical");
    assert_null(gate_preset(gate, "smal"));
    gate_list_presets(gate, names, sizeof names);
    assert_string_equal(names, "small, plain, Big_2-x");
    gate_list_presets(gate, names, 12);
    assert_string_equal(names, "small");
    gate_free(gate);
}

TEST(faults_name_file_and_line)
{
    static const struct {
        enum file file;
        const char *text, *fault;
    } CASES[] = {
        {TOKENS, "", ": the file has no entry"},
        {KEYS, "# " KEY "\n", ": the file has no entry"},
        {PRESETS, " \n", ": the file has no entry"},
        {TOKENS, "one\ntwo\tthree\n", ":2: a token has printable ASCII without spaces at its ends"},
        {TOKENS, "\xC3\xA4\n", ":1: a token has printable ASCII without spaces at its ends"},
        {KEYS, KEY "\n\n0123\n",
         ":3: a key has 16 to 128 bytes, each of two hexadecimal digits; this line has 4 digits"},
        {KEYS, KEY "0\n", ":1: a key has 16 to 128 bytes, each of two hexadecimal digits; this line has 33 digits"},
        {KEYS, "000102030405060708090a0b0c0d0e0g\n", ":1: byte 32 is no hexadecimal digit"},
        {PRESETS, "small\n", ":1: this is not NAME = QUERY"},
        {PRESETS, "=look=studio\n",
         ":1: '' is no name of a preset: 1 to 64 characters of A-Z, a-z, 0-9, _ and - are allowed"},
        {PRESETS, "a/b = look=studio\n",
         ":1: 'a/b' is no name of a preset: 1 to 64 characters of A-Z, a-z, 0-9, _ and - are allowed"},
        {PRESETS, "a = look=studio\nb = look=studio\na = width=1\n", ":3: the preset 'a' is here twice"},
        {PRESETS, "a = look=studio width=3\n",
         ":1: a query cannot have a space, '?' or '#'; write bytes beyond ASCII as %XX"},
        {PRESETS, "a = ?look=studio\n", ":1: a query cannot have a space, '?' or '#'; write bytes beyond ASCII as %XX"},
        {PRESETS, "a = look=%zz\n", ":1: a %-escape is broken"},
        {PRESETS, "a = width=3&widht=3\n", ":1: unknown parameter 'widht' (did you mean width?)"},
        {PRESETS, "a = width=3&width=3\n", ":1: duplicate parameter 'width'"},
        {PRESETS, "a = width=0\n", ":1: parameter width: '0' is not a whole number of pixels from 1 to 8192"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++)
        assert_fault(CASES[i].file, CASES[i].text, strlen(CASES[i].text), CASES[i].fault);
    assert_fault(TOKENS, "a\0b", 3, ": this is no text: it has a zero byte");
}

/* Writes `count` lines of a format that takes their number, and `length` times 'a' at the end of the last. */
static char *many(size_t count, const char *format, size_t length)
{
    char *text = malloc(count * 64 + length + 2), *end = text;
    assert_non_null(text);
    for (unsigned i = 0; i < count; i++)
        end += sprintf(end, format, i);
    memset(end, 'a', length);
    end[length] = '\0';
    return text;
}

TEST(numbers_and_lengths_are_bounded)
{
    static const struct {
        enum file file;
        size_t count;
        const char *format;
        size_t length;
        const char *fault; /* NULL: accepted */
    } CASES[] = {
        {TOKENS, GATE_TOKENS_MAX, "token-%u\n", 0, NULL},
        {TOKENS, GATE_TOKENS_MAX + 1, "token-%u\n", 0, ":65: more than 64 tokens"},
        {TOKENS, 1, "%u", GATE_TOKEN_MAX - 1, NULL},
        {TOKENS, 1, "%u", GATE_TOKEN_MAX, ":1: a token has at most 255 bytes"},
        {KEYS, SIGNATURE_KEYS_MAX, "%032x\n", 0, NULL},
        {KEYS, SIGNATURE_KEYS_MAX + 1, "%032x\n", 0, ":17: more than 16 keys"},
        {KEYS, 0, "", 2 * SIGNATURE_KEY_MAX, NULL},
        {KEYS, 0, "", 2 * SIGNATURE_KEY_MAX + 2,
         ":1: a key has 16 to 128 bytes, each of two hexadecimal digits; this line has 258 digits"},
        {PRESETS, GATE_PRESETS_MAX, "preset-%u = look=studio\n", 0, NULL},
        {PRESETS, GATE_PRESETS_MAX + 1, "preset-%u = look=studio\n", 0, ":257: more than 256 presets"},
        {PRESETS, 1, "p%u = member=", PRESET_QUERY_MAX - 7, NULL},
        {PRESETS, 1, "p%u = member=", PRESET_QUERY_MAX - 6, ":1: a query has at most 2048 bytes"},
        {TOKENS, 0, "", LINES_BYTES_MAX + 1, ": the file has more than 1 MiB"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        char *text = many(CASES[i].count, CASES[i].format, CASES[i].length);
        if (CASES[i].fault)
            assert_fault(CASES[i].file, text, strlen(text), CASES[i].fault);
        else
            gate_free(gate_of(CASES[i].file, text));
        free(text);
    }
}

TEST(files_that_are_no_regular_files_are_refused)
{
    static const char *const PATHS[] = {"/dev/zero", "/tmp", "/nonexistent/file"};
    for (size_t i = 0; i < sizeof PATHS / sizeof *PATHS; i++) {
        struct config config = config_with("");
        char message[MESSAGE_SIZE] = "";
        snprintf(config.keys_file, sizeof config.keys_file, "%s", PATHS[i]);
        assert_null(gate_read(&config, message, sizeof message));
        assert_memory_equal(message, PATHS[i], strlen(PATHS[i]));
    }
}

TEST(files_of_secrets_that_all_may_read_are_warned_of)
{
    char message[MESSAGE_SIZE], wanted[MESSAGE_SIZE];
    write_file("one\n", 4, 0644);
    struct gate *gate = read_file(TOKENS, message);
    snprintf(wanted, sizeof wanted, "%s may be read by all users of this machine", path);
    assert_string_equal(gate_warning(gate), wanted);
    gate_free(gate);
    gate = gate_of(TOKENS, "one\n");
    assert_string_equal(gate_warning(gate), "");
    gate_free(gate);
    gate = gate_of(KEYS, KEY);
    assert_string_equal(gate_warning(gate),
                        "there are keys and no token: clients without a signature may still POST and PUT");
    gate_free(gate);
}

TEST(a_change_is_described_by_numbers)
{
    char text[160];
    struct gate *one = gate_of(TOKENS, "one\n"), *two = gate_of(TOKENS, "one\ntwo\n");
    gate_describe(two, one, text, sizeof text);
    assert_string_equal(text, "tokens: 2 (before: 1), keys: 0, presets: 0");
    gate_free(one);
    gate_free(two);
}

RUN_TESTS(make_file, remove_file)
