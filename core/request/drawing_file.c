#include "request/drawing_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/memory_error.h"
#include "base/utf8.h"
#include "drawing/technical_drawing.h"
#include "drawing_rows.h"
#include "input/query/query_text.h"
#include "output/json/json_print.h"
#include "output/plot_png.h"
#include "output/plot_svg.h"
#include "overlay/annotate/length_text.h"

#define DPI_USUAL 150.0

struct wanted {
    struct zr_technical_options options;
    bool is_png;
    double dpi;
};

/* Each reads a value. False: it is not one of `values`. */
static bool read_page(const char *value, struct wanted *out)
{
    out->options.page = strcmp(value, "a4") == 0 ? ZR_PAGE_A4 : ZR_PAGE_A3;
    return strcmp(value, "a4") == 0 || strcmp(value, "a3") == 0;
}

static bool read_scale(const char *value, struct wanted *out)
{
    return zr_page_scale_read(value, &out->options.scale);
}

static bool read_projection(const char *value, struct wanted *out)
{
    out->options.is_first_angle = strcmp(value, "first") == 0;
    return out->options.is_first_angle || strcmp(value, "third") == 0;
}

/* Reads a number without sign and exponent. */
static bool read_number(const char *value, double *out)
{
    char *end;
    if (*value == '\0' || value[strspn(value, "0123456789.")] != '\0') return false;
    *out = strtod(value, &end);
    return *end == '\0';
}

static bool read_section(const char *value, struct wanted *out)
{
    const bool is_axis = *value >= 'x' && *value <= 'z';
    out->options.cut_at = 0.5;
    if (!is_axis || (value[1] != '\0' && value[1] != ':')) return false;
    out->options.cut = (enum zr_cut_axis)(ZR_CUT_X + (*value - 'x'));
    if (value[1] == '\0') return true;
    return read_number(value + 2, &out->options.cut_at) && out->options.cut_at > 0.0 && out->options.cut_at < 1.0;
}

static bool read_hidden(const char *value, struct wanted *out)
{
    out->options.has_hidden = strcmp(value, "true") == 0;
    return out->options.has_hidden || strcmp(value, "false") == 0;
}

static bool read_title(const char *value, struct wanted *out)
{
    out->options.title = value;
    return true;
}

static bool read_date(const char *value, struct wanted *out)
{
    out->options.date = value;
    return true;
}

static bool read_format(const char *value, struct wanted *out)
{
    out->is_png = strcmp(value, "png") == 0;
    return out->is_png || strcmp(value, "svg") == 0;
}

static bool read_dpi(const char *value, struct wanted *out)
{
    return read_number(value, &out->dpi) && out->dpi >= ZR_PLOT_DPI_LEAST && out->dpi <= ZR_PLOT_DPI_MOST;
}

#define PARAMETER(name, placeholder, values, ...) {#name, values, read_##name},
static const struct {
    const char *name, *values;
    bool (*read)(const char *value, struct wanted *out);
} parameters[] = {ZR_DRAWING_ROWS(PARAMETER)};
enum { PARAMETERS = sizeof parameters / sizeof *parameters };
#undef PARAMETER

/* Returns the number of the parameter, or PARAMETERS. */
static size_t parameter_of(const char *text)
{
    const size_t size = strcspn(text, "=&");
    size_t i = 0;
    while (i < PARAMETERS && !(strlen(parameters[i].name) == size && memcmp(text, parameters[i].name, size) == 0))
        i++;
    return i;
}

bool zr_drawing_has_parameter(const char *text)
{
    return parameter_of(text) < PARAMETERS;
}

/* Replaces bytes that are no UTF-8 by "?". */
static void mend(char *text)
{
    const char *end = text + strlen(text);
    while (text < end) {
        const size_t length = zr_utf8_length(text, end);
        if (length == 0) *text = '?';
        text += length > 0 ? length : 1;
    }
}

static enum zr_status read_parameter(struct zr_arena *arena, const char *text, size_t size, struct wanted *out,
                                     struct zr_error *error)
{
    const size_t number = parameter_of(text);
    const char *equals = memchr(text, '=', size);
    const char *value = equals ? equals + 1 : text + size;
    const size_t length = size - (size_t)(value - text);
    char *decoded = zr_arena_zero(arena, length + 1, 1);
    if (!decoded) return ZR_NO_MEMORY;
    if (number == PARAMETERS) {
#define NAME(name, ...) " " #name
        return zr_error_add(error, ZR_BAD_REQUEST, NULL,
                            "unknown parameter; those of drawings are:" ZR_DRAWING_ROWS(NAME));
#undef NAME
    }
    const bool is_decoded = zr_percent_decode(decoded, value, length);
    mend(decoded);
    if (!is_decoded || !parameters[number].read(decoded, out))
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "parameter %s: %.100s is not %s", parameters[number].name,
                            decoded, parameters[number].values);
    return ZR_OK;
}

static enum zr_status read_query(struct zr_arena *arena, const char *query, struct wanted *out, struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    *out =
        (struct wanted){.options = {.page = ZR_PAGE_A3, .has_hidden = true, .title = "", .date = ""}, .dpi = DPI_USUAL};
    while (query && *query && status == ZR_OK) {
        const size_t size = strcspn(query, "&");
        if (size > 0) status = read_parameter(arena, query, size, out, error);
        query += size + (query[size] == '&');
    }
    return status;
}

/* Returns the pixels per inch of a query for a PNG; 0: it is for another format. */
static double dpi_of(const char *query)
{
    const char *dpi = query ? strstr(query, "dpi=") : NULL;
    if (!query || !strstr(query, "format=png")) return 0.0;
    const double value = dpi ? strtod(dpi + strlen("dpi="), NULL) : DPI_USUAL;
    return value <= ZR_PLOT_DPI_MOST ? value : ZR_PLOT_DPI_MOST;
}

double zr_drawing_cost_ms(const struct zr_scene *scene, const char *query)
{
    const double inches = 16.5 * 11.7, dpi = dpi_of(query);
    double triangles = 0.0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        triangles += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
    }
    return 40.0 + 0.006 * triangles + 6e-6 * inches * dpi * dpi;
}

/* Writes the facts in one line of words. */
static void write_summary(const struct zr_technical_facts *facts, const struct wanted *wanted, const char *scale,
                          char *out, size_t size)
{
    const double *sizes = facts->sizes, largest = fmax(sizes[0], fmax(sizes[1], sizes[2]));
    char lengths[3][ZR_LENGTH_SIZE], holes[80] = "no round hole";
    for (int k = 0; k < 3; k++)
        zr_length_write(sizes[k], largest, "", lengths[k]);
    if (facts->holes > 0)
        snprintf(holes, sizeof holes, "%" PRIu32 " of %" PRIu32 " round holes in notes", facts->noted, facts->holes);
    snprintf(out, size, "scale %s on %s, %s angle; width %s, depth %s, height %s mm (%s%s); %s", scale,
             zr_page_names[wanted->options.page], wanted->options.is_first_angle ? "first" : "third", lengths[0],
             lengths[2], lengths[1], facts->unit ? "unit of the file: " : "the file has no unit: 1 is 1 mm",
             facts->unit ? facts->unit : "", holes);
}

/* Prints the facts, and all warnings, as one object. */
static enum zr_status print_facts(const struct zr_run *run, const struct zr_technical_facts *facts,
                                  const struct wanted *wanted, const char *scale, struct zr_drawing_file *out)
{
    static const char *const names[] = {"width", "height", "depth"};
    struct zr_buffer buffer = {.arena = run->arena};
    struct zr_print print = {.out = &buffer};
    char summary[8 * ZR_LENGTH_SIZE];
    write_summary(facts, wanted, scale, summary, sizeof summary);
    zr_print_begin(&print, NULL, '{');
    zr_print_string(&print, "summary", summary);
    zr_print_string(&print, "page", wanted->options.page == ZR_PAGE_A4 ? "a4" : "a3");
    zr_print_string(&print, "scale", scale);
    zr_print_string(&print, "projection", wanted->options.is_first_angle ? "first" : "third");
    if (facts->unit)
        zr_print_string(&print, "units", facts->unit);
    else
        zr_print_null(&print, "units");
    zr_print_begin(&print, "millimetres", '{');
    for (int k = 0; k < 3; k++)
        zr_print_double(&print, names[k], facts->sizes[k]);
    zr_print_end(&print, '}');
    zr_print_count(&print, "holes", facts->holes);
    zr_print_count(&print, "holesNoted", facts->noted);
    zr_print_begin(&print, "warnings", '[');
    for (size_t i = 0; i < out->warnings.count; i++)
        zr_print_string(&print, NULL, out->warnings.texts[i]);
    zr_print_end(&print, ']');
    zr_print_end(&print, '}');
    zr_buffer_add(&buffer, "", 1);
    out->json = (const char *)buffer.bytes;
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

static enum zr_status make(const struct zr_run *run, const struct zr_scene *scene, const struct wanted *wanted,
                           struct zr_drawing_file *out)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct zr_buffer buffer = {.arena = run->arena};
    struct zr_warning_list warnings = {0}; /* in scratch */
    struct zr_plot plot;
    struct zr_technical_facts facts;
    for (uint32_t i = 0; i < scene->warning_count; i++)
        zr_warning_list_add(run->arena, &out->warnings, "%s", scene->warnings[i]);
    enum zr_status status = zr_technical_drawing_make(&inner, scene, &wanted->options, &plot, &facts, &warnings);
    zr_warning_list_append(run->arena, &out->warnings, &warnings);
    if (status == ZR_OK) status = print_facts(run, &facts, wanted, plot.scale, out);
    if (status == ZR_OK)
        status = wanted->is_png ? zr_plot_png_write(&inner, &plot, wanted->dpi, &buffer)
                                : zr_plot_svg_write(&plot, run->cancel, &buffer);
    out->bytes = buffer.bytes;
    out->size = buffer.size;
    out->content_type = wanted->is_png ? "image/png" : "image/svg+xml";
    return status;
}

enum zr_status zr_drawing_file_make(const struct zr_run *run, const struct zr_scene *scene, const char *query,
                                    struct zr_drawing_file *out)
{
    struct wanted wanted;
    *out = (struct zr_drawing_file){.bytes = NULL};
    enum zr_status status = read_query(run->scratch, query, &wanted, run->error);
    if (status == ZR_OK) status = make(run, scene, &wanted, out);
    if (status == ZR_NO_MEMORY && zr_is_cancelled(run->cancel)) status = ZR_CANCELLED;
    if (status == ZR_NO_MEMORY && run->error->count == 0)
        zr_memory_error_add(run->error, zr_arena_ok(run->scratch) ? run->arena : run->scratch, "drawing", "");
    return status;
}
