/* info.c - client: `zraster info`: the facts of the channel info as a table. */
#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#include "commands/expect.h"
#include "engine/job.h"
#include "engine/report.h"
#include "files/say.h"
#include "options/parameters.h"

enum { COLUMN = 26, LIST_MAX = 16 };

static bool is_plain(const cJSON *value)
{
    return !cJSON_IsArray(value) && !cJSON_IsObject(value);
}

static void print_text(const char *text)
{
    say_text(stdout, text, strlen(text));
}

static void print_value(const cJSON *value)
{
    if (cJSON_IsString(value))
        print_text(value->valuestring);
    else if (cJSON_IsNumber(value))
        printf(value->valuedouble == (double)(long)value->valuedouble ? "%.0f" : "%.6g", value->valuedouble);
    else
        fputs(cJSON_IsTrue(value) ? "true" : cJSON_IsFalse(value) ? "false" : "null", stdout);
}

/* Prints a list of plain values on one line. Returns false for another value. */
static bool print_list(const cJSON *list)
{
    const cJSON *item;
    if (!cJSON_IsArray(list) || cJSON_GetArraySize(list) > LIST_MAX) return false;
    cJSON_ArrayForEach(item, list) if (!is_plain(item)) return false;
    cJSON_ArrayForEach(item, list)
    {
        if (item != list->child) putchar(' ');
        print_value(item);
    }
    return true;
}

/* Returns true for values that only --json lists: counts of 0, empty texts and lists, and the faces.
 * A separate table lists the parts. */
static bool is_nothing(const char *path, const cJSON *value)
{
    const bool is_count = strncmp(path, "counts.", strlen("counts.")) == 0;
    return strcmp(path, "faces") == 0 || strcmp(path, "parts") == 0 ||
           (is_count && cJSON_IsNumber(value) && value->valuedouble == 0) ||
           (cJSON_IsString(value) && !*value->valuestring) || (!is_plain(value) && cJSON_GetArraySize(value) == 0);
}

/* Prints a line per value: its path, such as bounds.min, and the value. */
static void print_facts(const char *path, const cJSON *value)
{
    const cJSON *member;
    char inner[256];
    int number = 0;
    if (is_nothing(path, value)) return;
    if (is_plain(value) || (cJSON_IsArray(value) && is_plain(value->child) && cJSON_GetArraySize(value) <= LIST_MAX)) {
        printf("%-*s ", COLUMN, path);
        if (!print_list(value)) print_value(value);
        putchar('\n');
        return;
    }
    cJSON_ArrayForEach(member, value)
    {
        if (member->string)
            snprintf(inner, sizeof inner, "%s%s%s", path, *path ? "." : "", member->string);
        else
            snprintf(inner, sizeof inner, "%s.%d", path, number++);
        print_facts(inner, member);
    }
}

/* ---- the table of parts ---- */

enum { NAME_COLUMNS = 24, GROUPS_MAX = 12 };

/* Prints a name in NAME_COLUMNS characters: a longer one is cut. */
static void print_name(const char *name)
{
    const char *end = name;
    int columns = 0;
    for (; *end; end++) {
        const bool begins = ((unsigned char)*end & 0xC0) != 0x80;
        if (begins && columns == NAME_COLUMNS) break;
        columns += begins;
    }
    say_text(stdout, name, (size_t)(end - name));
    printf("%*s", NAME_COLUMNS - columns, "");
}

static double number_of(const cJSON *list, int index)
{
    const cJSON *item = cJSON_GetArrayItem(list, index);
    return item ? item->valuedouble : 0.0;
}

/* Prints the sides of the box. */
static void print_size(const cJSON *box)
{
    const cJSON *min = cJSON_GetObjectItem(box, "min"), *max = cJSON_GetObjectItem(box, "max");
    char text[64] = "-";
    if (cJSON_IsArray(min) && cJSON_IsArray(max))
        snprintf(text, sizeof text, "%.4g x %.4g x %.4g", number_of(max, 0) - number_of(min, 0),
                 number_of(max, 1) - number_of(min, 1), number_of(max, 2) - number_of(min, 2));
    printf("  %-29s", text);
}

/* Prints a group of holes: "4 x ø3.2 through", "1 x ø5 blind, 8 deep". */
static void print_holes(const cJSON *group, const char *before)
{
    const cJSON *through = cJSON_GetObjectItem(group, "through"), *step;
    const cJSON *count = cJSON_GetObjectItem(group, "count"), *diameter = cJSON_GetObjectItem(group, "diameter"),
                *depth = cJSON_GetObjectItem(group, "depth");
    if (!cJSON_IsNumber(count) || !cJSON_IsNumber(diameter) || !cJSON_IsNumber(depth)) return;
    printf("%s%.0f x \xc3\xb8%.4g", before, count->valuedouble, diameter->valuedouble);
    cJSON_ArrayForEach(step, cJSON_GetObjectItem(group, "steps"))
    {
        const cJSON *wide = cJSON_GetObjectItem(step, "diameter");
        if (cJSON_IsNumber(wide)) printf("/%.4g", wide->valuedouble);
    }
    if (cJSON_IsTrue(through)) fputs(" through", stdout);
    if (cJSON_IsFalse(through)) fputs(" blind", stdout);
    printf(" %.4g", depth->valuedouble);
}

/* Prints a line of holes, if there are some. */
static void print_features(const cJSON *features)
{
    const cJSON *group;
    int number = 0;
    cJSON_ArrayForEach(group, cJSON_GetObjectItem(features, "holes"))
    {
        if (number < GROUPS_MAX) print_holes(group, number == 0 ? "  holes: " : ", ");
        number++;
    }
    if (number > GROUPS_MAX) printf(", and %d more kinds", number - GROUPS_MAX);
    if (number > 0) putchar('\n');
    const cJSON *reason = cJSON_GetObjectItem(features, "omittedReason");
    if (cJSON_IsString(reason)) printf("  holes were not searched: %s\n", reason->valuestring);
}

static void print_part(const cJSON *part)
{
    const cJSON *name = cJSON_GetObjectItem(part, "name"), *triangles = cJSON_GetObjectItem(part, "triangles"),
                *volume = cJSON_GetObjectItem(part, "volume"), *area = cJSON_GetObjectItem(part, "area"),
                *error = cJSON_GetObjectItem(part, "volumeError");
    print_name(cJSON_IsString(name) ? name->valuestring : "");
    printf(" %10.0f", cJSON_IsNumber(triangles) ? triangles->valuedouble : 0.0);
    print_size(cJSON_GetObjectItem(part, "box"));
    printf(" %10.4g", cJSON_IsNumber(area) ? area->valuedouble : 0.0);
    if (cJSON_IsNumber(volume) && cJSON_IsNumber(error))
        printf("  closed %12.6g +- %.2g\n", volume->valuedouble, error->valuedouble);
    else if (cJSON_IsNumber(volume))
        printf("  closed %12.6g\n", volume->valuedouble);
    else
        puts("  open              -");
    print_features(cJSON_GetObjectItem(part, "features"));
}

static void print_parts(const cJSON *facts)
{
    const cJSON *parts = cJSON_GetObjectItem(facts, "parts"), *omitted = cJSON_GetObjectItem(facts, "partsOmitted"),
                *part;
    if (cJSON_GetArraySize(parts) == 0) return;
    printf("\n%-*s %10s  %-29s %10s  %-6s %12s\n", NAME_COLUMNS, "part", "triangles", "size", "area", "", "volume");
    cJSON_ArrayForEach(part, parts) print_part(part);
    if (cJSON_IsNumber(omitted)) printf("and %.0f more parts\n", omitted->valuedouble);
}

int command_info(struct options *options)
{
    struct engine engine;
    struct answer answer;
    if (options->file_count != 1) return options_wrong("info needs one file: \"zraster info part.stl\"");
    if (options->parameters[PARAMETER_channel]) return options_wrong("info has no --channel; leave it out");
    options->parameters[PARAMETER_channel] = "info";
    if (!options->parameters[PARAMETER_features]) options->parameters[PARAMETER_features] = "true";
    struct bytes faults = {.data = NULL};
    cJSON *expected = options->own[OPTION_EXPECT] ? expect_read(options->own[OPTION_EXPECT], &faults) : NULL;
    int status = faults.size > 0 ? options_wrong("%s", bytes_text(&faults)) : input_check_type(options);
    bytes_free(&faults);
    if (status == 0) status = engine_open(&engine, options, options_threads(options), 1);
    if (status != 0) {
        cJSON_Delete(expected);
        return status;
    }
    struct job job = {.target = output_target(options->files[0], "-"), .options = options};
    job_draw(&engine, &job, &answer);
    bool passes = true;
    if (job.status == STATUS_DONE && expected) {
        cJSON *facts = cJSON_ParseWithLength(answer.file.data, answer.file.size);
        passes = expect_print(facts, expected, options->own[OPTION_JSON] != NULL);
        cJSON_Delete(facts);
    } else if (job.status == STATUS_DONE && options->own[OPTION_JSON])
        fwrite(answer.file.data, 1, answer.file.size, stdout);
    else if (job.status == STATUS_DONE) {
        cJSON *facts = cJSON_ParseWithLength(answer.file.data, answer.file.size);
        print_facts("", facts);
        print_parts(facts);
        cJSON_Delete(facts);
    } else if (job.status != STATUS_INTERRUPTED)
        report_of_file(stderr, job.target.file, &job.faults);
    status = job.status == STATUS_DONE && !passes ? STATUS_DIFFERENT : job.status;
    cJSON_Delete(expected);
    answer_free(&answer);
    job_free(&job);
    engine_close(&engine);
    return status;
}
