/* compare_models.c - client: `zraster compare a.stl b.stl`: the numbers of two models as lines. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/compare.h"
#include "engine/engine.h"
#include "engine/interruption.h"
#include "engine/report.h"
#include "files/input.h"
#include "files/neighbours.h"
#include "files/output.h"
#include "files/say.h"
#include "options/wording.h"

enum { COLUMN = 18 };

/* ---- reading ---- */

/* Reads a model. Returns 0, or the exit status of a fault that is reported. */
static int read_model(const struct engine *engine, const struct options *options, const char *path,
                      zraster_scene **scene)
{
    struct input input;
    struct bytes faults = {.data = NULL};
    zraster_error *error = NULL;
    int status = 0;
    if (!input_read(&input, path, options, &faults) || !neighbours_read(&input, options->own[OPTION_ROOT], &faults))
        status = interrupted() ? STATUS_INTERRUPTED : input.is_usage ? STATUS_USAGE : STATUS_FAILED;
    else if (engine_read_here(engine, &input, NULL, scene, &error) != ZRASTER_OK) {
        bytes_print(&faults, "%s", zraster_error_text(error));
        wording_translate(&faults, &input, options);
        status = interrupted() ? STATUS_INTERRUPTED : STATUS_FAILED;
    }
    if (status != 0 && status != STATUS_INTERRUPTED) report_faults(stderr, path, &faults);
    input_free(&input);
    bytes_free(&faults);
    zraster_error_free(error);
    return status;
}

/* ---- printing ---- */

static const cJSON *member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItem(object, key);
}

/* Formats a value for a cell; "-" if there is none. */
static void format(const cJSON *value, char text[64])
{
    if (cJSON_IsNumber(value))
        snprintf(text, 64, value->valuedouble == (double)(long)value->valuedouble ? "%.0f" : "%.6g",
                 value->valuedouble);
    else
        snprintf(text, 64, "%s", cJSON_IsTrue(value) ? "yes" : cJSON_IsFalse(value) ? "no" : "-");
}

static void print_row(const char *name, const cJSON *a, const cJSON *b)
{
    char first[64], second[64];
    format(a, first);
    format(b, second);
    printf("%-*s %*s %*s\n", COLUMN, name, COLUMN, first, COLUMN, second);
}

static void format_size(const cJSON *box, char text[64])
{
    const cJSON *min = member(box, "min"), *max = member(box, "max");
    double sides[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const cJSON *low = cJSON_GetArrayItem(min, k), *high = cJSON_GetArrayItem(max, k);
        if (low && high) sides[k] = high->valuedouble - low->valuedouble;
    }
    snprintf(text, 64, "%.4g x %.4g x %.4g", sides[0], sides[1], sides[2]);
}

static void print_solids(const cJSON *a, const cJSON *b)
{
    static const char *const rows[] = {"triangles", "volume", "area", "closed", "solids", "cavities", "handles"};
    char first[64], second[64];
    printf("\n%-*s %*s %*s\n", COLUMN, "", COLUMN, "a", COLUMN, "b");
    format_size(member(a, "box"), first);
    format_size(member(b, "box"), second);
    printf("%-*s %*s %*s\n", COLUMN, "size", COLUMN, first, COLUMN, second);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (member(a, rows[i]) || member(b, rows[i])) print_row(rows[i], member(a, rows[i]), member(b, rows[i]));
}

static void print_deviations(const cJSON *deviation)
{
    static const char *const rows[] = {"mean", "abs", "rms", "p95", "max"};
    const cJSON *a = member(deviation, "aToB"), *b = member(deviation, "bToA");
    char text[64];
    if (!deviation) return;
    printf("\n%-*s %*s %*s\n", COLUMN, "deviation", COLUMN, "a to b", COLUMN, "b to a");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (member(a, rows[i])) print_row(rows[i], member(a, rows[i]), member(b, rows[i]));
    format(member(deviation, "hausdorff"), text);
    printf("\nhausdorff %s", text);
    format(member(deviation, "chamfer"), text);
    printf(", chamfer %s", text);
    format(member(member(deviation, "f1"), "value"), text);
    printf(", f1 %s", text);
    format(member(deviation, "normalConsistency"), text);
    printf(", normal consistency %s\n", text);
}

static void print_alignment(const cJSON *alignment)
{
    char before[64], after[64], scale[64];
    const cJSON *align = member(alignment, "align");
    if (!cJSON_IsString(align)) return;
    format(member(alignment, "rmsBefore"), before);
    format(member(alignment, "rmsAfter"), after);
    printf("\naligned by %s: root mean square distance %s before, %s after", align->valuestring, before, after);
    format(member(alignment, "scale"), scale);
    if (member(alignment, "scale")) printf("; b is scaled by %s", scale);
    putchar('\n');
}

static void print_volumes(const cJSON *volume)
{
    char both[64], a[64], b[64];
    if (!volume) return;
    format(member(volume, "both"), both);
    format(member(volume, "onlyA"), a);
    format(member(volume, "onlyB"), b);
    printf("\nvolume of both %s, only a %s, only b %s\n", both, a, b);
}

/* Returns number k of a list, or 0. */
static double item(const cJSON *list, int k)
{
    const cJSON *value = cJSON_GetArrayItem(list, k);
    return value ? value->valuedouble : 0.0;
}

/* Returns a coordinate of the centre of a box; errors of the rays beside 0 become 0. */
static double center_of(const cJSON *region, int k)
{
    const cJSON *box = member(region, "box");
    const double value = item(member(region, "center"), k),
                 side = item(member(box, "max"), k) - item(member(box, "min"), k);
    return fabs(value) < 1e-3 * side ? 0.0 : value;
}

static void print_regions(const cJSON *regions)
{
    const cJSON *region;
    if (cJSON_GetArraySize(regions) == 0) return;
    printf("\n%-*s %*s %*s  %s\n", COLUMN, "region", COLUMN, "volume", COLUMN, "size", "center");
    cJSON_ArrayForEach(region, regions)
    {
        const cJSON *in = member(region, "in"), *part = member(region, "part");
        char volume[64], size[64];
        format(member(region, "volume"), volume);
        format_size(member(region, "box"), size);
        printf("only in %-*s %*s %*s  %.4g, %.4g, %.4g  ", COLUMN - 8, cJSON_IsString(in) ? in->valuestring : "",
               COLUMN, volume, COLUMN, size, center_of(region, 0), center_of(region, 1), center_of(region, 2));
        if (cJSON_IsString(part)) say_text(stdout, part->valuestring, strlen(part->valuestring));
        putchar('\n');
    }
}

static void print_parts(const cJSON *parts)
{
    const cJSON *list, *part;
    cJSON_ArrayForEach(list, parts) cJSON_ArrayForEach(part, list)
    {
        const cJSON *name = member(part, "name"), *by = member(part, "by");
        if (!cJSON_IsString(name)) continue;
        printf("part %s: ", list->string);
        say_text(stdout, name->valuestring, strlen(name->valuestring));
        if (by) printf(" by %.4g, %.4g, %.4g", item(by, 0), item(by, 1), item(by, 2));
        putchar('\n');
    }
}

static void print_all(const struct options *options, const cJSON *all)
{
    const cJSON *summary = member(all, "summary"), *warning;
    if (cJSON_IsString(summary)) puts(summary->valuestring);
    print_solids(member(all, "a"), member(all, "b"));
    print_alignment(member(all, "alignment"));
    print_volumes(member(all, "volume"));
    print_deviations(member(all, "deviation"));
    print_regions(member(all, "regions"));
    if (cJSON_GetArraySize(member(all, "parts")) > 0) putchar('\n');
    print_parts(member(all, "parts"));
    fflush(stdout);
    if (options->own[OPTION_QUIET]) return;
    cJSON_ArrayForEach(warning, member(all, "warnings")) if (cJSON_IsString(warning)) say("%s", warning->valuestring);
}

/* ---- comparing ---- */

static struct target target_of(const struct options *options)
{
    struct target target = output_target(options->files[0], options->own[OPTION_OUTPUT]);
    if (!target.out) target.stem = "difference";
    return target;
}

/* Checks the name of the picture, before the models are read. Returns 0, or the exit status of a fault that is
 * reported. */
static int check_output(const struct options *options)
{
    struct bytes faults = {.data = NULL};
    if (!options->own[OPTION_OUTPUT]) return 0;
    struct target target = target_of(options);
    int status = output_check(&target, false, &faults);
    if (status == 0 && bytes_same_file(options->files[1], options->own[OPTION_OUTPUT])) {
        bytes_print(&faults, "the output would overwrite its own input; -o names another file");
        status = STATUS_USAGE;
    }
    if (status != 0) report_faults(stderr, options->own[OPTION_OUTPUT], &faults);
    bytes_free(&faults);
    return status;
}

/* Draws the scene of a comparison and saves it. Returns an exit status. */
static int save(const struct engine *engine, const struct options *options, const zraster_comparison *comparison)
{
    const char *out = options->own[OPTION_OUTPUT];
    struct bytes names = {.data = NULL}, faults = {.data = NULL}, query = {.data = NULL};
    struct target target = target_of(options);
    struct answer answer = {.status = STATUS_DONE};
    zraster_error *error = NULL;
    int status = 0;
    if (options->own[OPTION_SIZE]) bytes_print(&query, "width=%s&height=%s", options->width, options->height);
    const struct zraster_request change = {
        .struct_size = sizeof change, .query = bytes_text(&query), .cancel = engine->cancel};
    if (zraster_scene_draw(zraster_comparison_scene(comparison), &change, &answer.picture, &error) != ZRASTER_OK ||
        zraster_picture_encode(answer.picture, NULL, &answer.file, &error) != ZRASTER_OK) {
        bytes_print(&faults, "%s", zraster_error_text(error));
        status = interrupted() ? STATUS_INTERRUPTED : STATUS_FAILED;
    }
    if (status == 0) status = output_save(&target, &answer, options->own[OPTION_NO_CLOBBER] != NULL, &names, &faults);
    if (status != 0 && status != STATUS_INTERRUPTED) report_faults(stderr, out, &faults);
    answer_free(&answer);
    bytes_free(&names);
    bytes_free(&faults);
    bytes_free(&query);
    zraster_error_free(error);
    return status;
}

/* Reports a wrong parameter by the name of its option. */
static int refuse(const char *text)
{
    static const char show[] = "show: ";
    if (strncmp(text, show, sizeof show - 1) == 0) return options_wrong("--picture: %s", text + sizeof show - 1);
    return options_wrong("--%s", text);
}

static int compare(const struct engine *engine, const struct options *options, const zraster_scene *a,
                   const zraster_scene *b)
{
    struct bytes query = {.data = NULL};
    zraster_comparison *comparison = NULL;
    zraster_error *error = NULL;
    int status = STATUS_FAILED;
    if (options->own[OPTION_TOLERANCE]) bytes_print(&query, "tolerance=%s", options->own[OPTION_TOLERANCE]);
    if (options->own[OPTION_ALIGN]) bytes_print(&query, "&align=%s", options->own[OPTION_ALIGN]);
    if (options->own[OPTION_RESCALE]) bytes_print(&query, "&rescale=on");
    if (options->own[OPTION_OUTPUT])
        bytes_print(&query, "&show=%s", options->own[OPTION_PICTURE] ? options->own[OPTION_PICTURE] : "difference");
    const zraster_status result = zraster_compare(a, b, bytes_text(&query), engine->cancel, &comparison, &error);
    if (interrupted())
        status = STATUS_INTERRUPTED;
    else if (result == ZRASTER_OK) {
        const char *json = zraster_comparison_json(comparison);
        cJSON *all = options->own[OPTION_JSON] ? NULL : cJSON_Parse(json);
        if (all)
            print_all(options, all);
        else
            fputs(json, stdout);
        cJSON_Delete(all);
        status = options->own[OPTION_OUTPUT] ? save(engine, options, comparison) : STATUS_DONE;
        if (status == STATUS_DONE && !zraster_comparison_same(comparison)) status = STATUS_DIFFERENT;
    } else if (result == ZRASTER_BAD_REQUEST)
        status = refuse(zraster_error_text(error));
    else
        say("%s", zraster_error_text(error));
    bytes_free(&query);
    zraster_comparison_free(comparison);
    zraster_error_free(error);
    return status;
}

int compare_models(const struct options *options)
{
    struct engine engine;
    zraster_scene *scenes[2] = {NULL, NULL};
    struct options here = *options;
    here.own[OPTION_SERVER] = NULL; /* $ZRASTER_SERVER draws, and does not compare */
    int status = check_output(options);
    if (status == 0) status = engine_open(&engine, &here, options_threads(options), 1);
    if (status != 0) return status;
    for (int i = 0; i < 2 && status == 0; i++)
        status = read_model(&engine, options, options->files[i], &scenes[i]);
    if (status == 0) status = compare(&engine, options, scenes[0], scenes[1]);
    for (int i = 0; i < 2; i++)
        zraster_scene_free(scenes[i]);
    engine_close(&engine);
    return status;
}
