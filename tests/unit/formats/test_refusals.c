/* What readers refuse or warn of: every case of tests/refusals, a file per subject.
 *
 *     format application/json                       the first line: a media type
 *     let NAME = text                               then names; ${NAME} stands for its text in what follows
 *     npy NAME = '<f4' (2, 3): 0 0 0 1 nan 2        a part of each request: type, shape and numbers of an NPY file;
 *                                                   '<f4' Fortran (2, 3): column by column
 *
 *     bad scene at /view/eye: three numbers         status, place (left out if it is empty) and a part of the message
 *     and at /view/up: three numbers                lines for the next faults, if they are tested, too
 *     {"polygons": [], "view": {"eye": 1}}          the body, up to an empty line; ${0a} is the byte 0x0a
 *
 *     warning: mesh 0: pointSize has no effect      a body that is read with this warning and no other; strict, it is refused
 *     and: a part of the next warning               lines for the next warnings
 *     warning of colors: material 'b'               the same, but strict requests for depth alone are not refused
 *     no warning                                    a body that is read without a warning
 *     # a comment                                   between cases
 *
 * Bodies of 3MF are the text of the model part.
 */
#include <stdio.h>
#include <stdlib.h>

#include "input/formats/formats.h"
#include "support/files.h"
#include "support/input/npy.h"
#include "support/input/zip_file.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

enum { LETS_MAX = 16, PARTS_MAX = 24, NUMBERS_MAX = 64, MORE_MAX = 4, BODY_MAX = 1 << 16 };

static const char *const statuses[] = {[ZR_BAD_SYNTAX] = "bad syntax",
                                       [ZR_BAD_TYPE] = "bad type",
                                       [ZR_BAD_REQUEST] = "bad request",
                                       [ZR_BAD_SCENE] = "bad scene"};

struct cases {
    const char *path;
    int line, count, failures;
    enum zr_format format;
    size_t let_count;
    char *names[LETS_MAX], *texts[LETS_MAX];
    size_t part_count;
    struct zr_asset parts[PARTS_MAX];
    size_t more_count;
    const char *more[MORE_MAX]; /* the next faults or warnings, " at PLACE: message" or ": message" */
    size_t size;
    char body[BODY_MAX];
};

static void put(struct cases *cases, const char *bytes, size_t size)
{
    assert_true(cases->size + size < BODY_MAX);
    memcpy(cases->body + cases->size, bytes, size);
    cases->size += size;
}

/* Appends a text to the body, its names and bytes replaced. */
static void expand(struct cases *cases, const char *text)
{
    for (const char *name; (name = strstr(text, "${")) != NULL; text = strchr(name, '}') + 1) {
        size_t i = 0;
        put(cases, text, (size_t)(name - text));
        name += 2;
        const size_t length = strcspn(name, "}");
        while (i < cases->let_count &&
               (strlen(cases->names[i]) != length || memcmp(cases->names[i], name, length) != 0))
            i++;
        unsigned byte = 0;
        if (i < cases->let_count)
            expand(cases, cases->texts[i]);
        else if (length == 2 && sscanf(name, "%2x", &byte) == 1)
            put(cases, (char[]){(char)byte}, 1);
        else
            fail_msg("%s, line %d: no name '%.*s'", cases->path, cases->line, (int)length, name);
    }
    put(cases, text, strlen(text));
}

/* True if fault `number` is as " at PLACE: message" has it. */
static bool has_fault(const struct zr_error *error, size_t number, const char *wanted)
{
    if (number >= error->count) return false;
    const struct zr_error_item *item = &error->items[number];
    const char *place = strncmp(wanted, " at ", 4) == 0 ? wanted + 4 : "", *detail = strstr(wanted, ": ");
    const size_t length = *place ? (size_t)(detail - place) : 0;
    return strlen(item->pointer) == length && memcmp(item->pointer, place, length) == 0 &&
           strstr(item->detail, detail + 2);
}

/* Reads the body, with these parameters of the query or NULL. */
static struct reading *read_body(struct cases *cases, const char *channel, const char *strict)
{
    const struct zr_request request = {.format = cases->format,
                                       .channel = channel,
                                       .strict = strict,
                                       .assets = cases->parts,
                                       .asset_count = cases->part_count};
    const struct zip_entry part = {"3D/3dmodel.model", cases->body, cases->size, true};
    size_t size = cases->size;
    unsigned char *package = cases->format == ZR_FORMAT_3MF ? zip_3mf(&part, 1, &size) : NULL;
    struct reading *reading = read_request(request, package ? (const void *)package : cases->body, size,
                                           zr_limits_default(), (size_t)1 << 28);
    free(package);
    return reading;
}

static void print_reading(const struct reading *reading)
{
    print_error("  status %d\n", (int)reading->status);
    for (size_t i = 0; i < zr_error_held(&reading->error); i++)
        print_error("  at %s: %s\n", reading->error.items[i].pointer, reading->error.items[i].detail);
    for (uint32_t i = 0; reading->scene && i < reading->scene->warning_count; i++)
        print_error("  warning: %s\n", reading->scene->warnings[i]);
}

/* True if the body is refused with this status and with `wanted` and then the next faults. */
static bool is_refused(struct cases *cases, const char *strict, enum zr_status status, const char *wanted)
{
    struct reading *reading = read_body(cases, NULL, strict);
    const struct zr_error *error = &reading->error;
    bool is_refused =
        reading->status == status && error->status == status && !reading->scene && has_fault(error, 0, wanted);
    for (size_t i = 0; i < cases->more_count; i++)
        is_refused &= has_fault(error, i + 1, cases->more[i]);
    if (!is_refused) print_reading(reading);
    reading_free(reading);
    return is_refused;
}

/* True if the body is read with the warning ": message", and then the next ones; NULL: without any. */
static bool is_warned_of(struct cases *cases, const char *wanted)
{
    struct reading *reading = read_body(cases, NULL, NULL);
    const struct zr_scene *scene = reading->scene;
    const size_t count = wanted ? 1 + cases->more_count : 0;
    bool is_warned = reading->status == ZR_OK && scene->warning_count == count;
    for (size_t i = 0; is_warned && i < count; i++)
        is_warned = strstr(scene->warnings[i], (i ? cases->more[i - 1] : wanted) + strlen(": ")) != NULL;
    if (!is_warned) print_reading(reading);
    reading_free(reading);
    return is_warned;
}

static bool is_read_strictly_for(struct cases *cases, const char *channel)
{
    struct reading *reading = read_body(cases, channel, "1");
    const bool is_read = reading->status == ZR_OK;
    reading_free(reading);
    return is_read;
}

/* True if the case is as its head has it. */
static bool holds(struct cases *cases, const char *head, int line)
{
    if (strcmp(head, "no warning") == 0)
        return is_warned_of(cases, NULL) && is_read_strictly_for(cases, "color") &&
               is_read_strictly_for(cases, "depth");
    const char *detail = strstr(head, ": ");
    if (!detail) fail_msg("%s, line %d: no 'STATUS at PLACE: message'", cases->path, line);
    if (strncmp(head, "warning", strlen("warning")) == 0) {
        const bool is_of_colors = strncmp(head, "warning of colors: ", strlen("warning of colors: ")) == 0;
        return is_warned_of(cases, detail) && is_refused(cases, "1", ZR_BAD_SCENE, detail) &&
               !is_read_strictly_for(cases, "color") && is_read_strictly_for(cases, "depth") == is_of_colors;
    }
    enum zr_status status = ZR_BAD_SYNTAX;
    while (status <= ZR_BAD_SCENE && strncmp(head, statuses[status], strlen(statuses[status])) != 0)
        status++;
    if (status > ZR_BAD_SCENE) fail_msg("%s, line %d: no such status", cases->path, line);
    return is_refused(cases, NULL, status, head + strlen(statuses[status]));
}

static void check(struct cases *cases, const char *head, int line)
{
    cases->count++;
    if (holds(cases, head, line)) return;
    print_error("%s, line %d\n", cases->path, line);
    cases->failures++;
}

/* Appends a number of a type such as "<f4". */
static void put_number(char *numbers, size_t *used, const char *type, const char *text)
{
    const size_t bytes = (size_t)(type[2] - '0');
    const double value = strtod(text, NULL);
    const float single = (float)value;
    const long long whole = strtoll(text, NULL, 10);
    assert_true(bytes <= 8 && *used + bytes <= 8 * NUMBERS_MAX);
    memcpy(numbers + *used, type[1] != 'f' ? (const void *)&whole : bytes == 4 ? (const void *)&single : &value, bytes);
    *used += bytes;
}

/* Adds the part NAME = 'TYPE' SHAPE: NUMBERS. */
static void add_npy(struct cases *cases, const char *name, char *text)
{
    char numbers[8 * NUMBERS_MAX], *type = text + 1, *shape = strchr(text, '('), *values = strchr(text, ':'), *word;
    size_t used = 0;
    if (!shape || !values || cases->part_count == PARTS_MAX)
        fail_msg("%s, line %d: no npy NAME = 'TYPE' SHAPE: NUMBERS", cases->path, cases->line);
    const char *order = strstr(text, " Fortran ") ? "True" : "False";
    *strchr(type, '\'') = '\0';
    *values++ = '\0';
    while ((word = strsep(&values, " ")))
        if (*word) put_number(numbers, &used, type, word);
    struct zr_asset *part = &cases->parts[cases->part_count++];
    part->name = name;
    part->bytes = npy_file(type, order, shape, numbers, used, &part->size);
    assert_non_null(part->bytes);
}

/* The format and the names; returns what is behind them. */
static char *read_head(struct cases *cases, char *text)
{
    char *line, *rest = text;
    while ((line = strsep(&rest, "\n")) && *line) {
        cases->line++;
        char *value = strstr(line, " = ");
        if (strncmp(line, "format ", 7) == 0)
            cases->format = zr_format_of_type(line + 7);
        else if (strncmp(line, "npy ", 4) == 0 && value) {
            *value = '\0';
            add_npy(cases, line + 4, value + 3);
        } else if (*line != '#') {
            if (strncmp(line, "let ", 4) != 0 || !value || cases->let_count == LETS_MAX)
                fail_msg("%s, line %d: no 'let NAME = text'", cases->path, cases->line);
            *value = '\0';
            cases->names[cases->let_count] = line + 4;
            cases->texts[cases->let_count++] = value + 3;
        }
    }
    cases->line++;
    assert_true(cases->format != ZR_FORMAT_UNKNOWN);
    return rest;
}

struct counts {
    int cases, failures;
};

static void check_file(const char *path, void *context)
{
    struct counts *counts = context;
    static struct cases cases;
    char *text = file_read(path, &(size_t){0});
    assert_non_null(text);
    cases = (struct cases){.path = path, .format = ZR_FORMAT_UNKNOWN};
    char *line, *rest = read_head(&cases, text), *head = NULL;
    int head_line = 0;
    while ((line = strsep(&rest, "\n"))) {
        cases.line++;
        if (!head && *line == '#') continue;
        if (*line && !head) {
            head = line;
            head_line = cases.line;
            cases.size = cases.more_count = 0;
        } else if (strncmp(line, "and at ", 7) == 0 || strncmp(line, "and: ", 5) == 0) {
            assert_true(cases.more_count < MORE_MAX && strstr(line, ": "));
            cases.more[cases.more_count++] = line + strlen("and");
        } else if (*line) {
            if (cases.size > 0) put(&cases, "\n", 1);
            expand(&cases, line);
        } else if (head) {
            check(&cases, head, head_line);
            head = NULL;
        }
    }
    for (size_t i = 0; i < cases.part_count; i++)
        free((void *)(uintptr_t)cases.parts[i].bytes);
    free(text);
    counts->cases += cases.count;
    counts->failures += cases.failures;
}

TEST(every_case_is_refused_or_warned_of_as_it_says)
{
    struct counts counts = {0, 0};
    const int files = files_each("tests/refusals", ".txt", check_file, &counts);
    if (files < 0) fail_msg("tests/refusals: not there; tests run from the project's top folder");
    print_message("%d cases of %d files\n", counts.cases, files);
    assert_true(counts.cases > 300);
    assert_int_equal(counts.failures, 0);
}

RUN_TESTS(NULL, NULL)
