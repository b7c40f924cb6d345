/* What the readers of OFF, PCD and XYZ share. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/cancel.h"
#include "input/points/points_file.h"
#include "input/text/number.h"
#include "input/text/recenter.h"

enum { POINTS_PER_CANCEL_CHECK = 1 << 14, LINES_PER_CANCEL_CHECK = 1 << 12 };

/* ---- points ---- */

struct zr_points zr_points_open(struct zr_scene_builder *builder, const struct zr_cancel *cancel,
                                const struct zr_limits *limits, struct zr_error *error, const char *format)
{
    return (struct zr_points){.builder = builder, .limits = limits, .cancel = cancel, .error = error, .format = format};
}

bool zr_points_reserve(struct zr_points *points, size_t count)
{
    struct zr_arena *arena = points->builder->arena;
    if (count <= points->room) return true;
    if (count > ZR_POINTS_MAX) {
        zr_error_add(points->error, ZR_BAD_SCENE, NULL, "more than %d points", ZR_POINTS_MAX);
        return false;
    }
    points->positions = zr_arena_grow(arena, points->positions, points->count, count, sizeof *points->positions);
    if (points->has_colors)
        points->colors = zr_arena_grow(arena, points->colors, points->count, count, sizeof *points->colors);
    if (points->has_normals)
        points->normals = zr_arena_grow(arena, points->normals, points->count, count, sizeof *points->normals);
    points->room = count;
    return zr_arena_ok(arena);
}

size_t zr_points_add(struct zr_points *points, const double position[3])
{
    double *out = points->positions[points->count];
    const bool is_finite = isfinite(position[0]) && isfinite(position[1]) && isfinite(position[2]);
    memcpy(out, position, 3 * sizeof *out);
    if (!is_finite) out[0] = (double)NAN;
    return points->count++;
}

static float limited(float v)
{
    return !(v > 0.0f) ? 0.0f : v > 1.0f ? 1.0f : v;
}

void zr_points_scale_colors(zr_vec4 *colors, size_t count, float scale)
{
    float most = 0.0f;
    for (size_t i = 0; scale == 0.0f && i < count; i++)
        most = fmaxf(most, fmaxf(colors[i].x, fmaxf(colors[i].y, colors[i].z)));
    if (scale == 0.0f) scale = most > 1.0f ? 1.0f / 255.0f : 1.0f;
    for (size_t i = 0; i < count; i++) {
        zr_vec4 *c = &colors[i];
        if (c->x == ZR_POINTS_NO_COLOR) {
            *c = (zr_vec4){1, 1, 1, 1};
            continue;
        }
        const float alpha = c->w > 1.0f ? c->w * scale : c->w;
        *c = (zr_vec4){limited(c->x * scale), limited(c->y * scale), limited(c->z * scale), limited(alpha)};
    }
}

/* Finds the origin to subtract. False after a fault. */
static bool find_origin(const struct zr_points *points, const double **origin)
{
    const double limit = zr_recenter_limit(points->limits);
    struct zr_box box = zr_box_empty();
    *origin = NULL;
    for (size_t i = 0; i < points->count; i++) {
        if (i % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return false;
        if (!isnan(points->positions[i][0])) zr_box_include(&box, points->positions[i]);
    }
    for (int k = 0; k < 3 && box.low[0] <= box.high[0]; k++)
        if (box.low[k] < -limit || box.high[k] > limit) {
            zr_error_add(points->error, ZR_BAD_SCENE, NULL, "a coordinate is %g; magnitudes up to %g are allowed",
                         box.low[k] < -limit ? box.low[k] : box.high[k], limit);
            return false;
        }
    return zr_recenter_origin(points->builder->arena, &box, points->limits, origin, points->error) == ZR_OK;
}

struct zr_mesh *zr_points_make(struct zr_points *points)
{
    struct zr_arena *arena = points->builder->arena;
    const double *origin = NULL;
    if (!find_origin(points, &origin)) return NULL;
    struct zr_mesh *mesh = zr_scene_builder_meshes(points->builder, 1);
    zr_vec4 *positions = zr_arena_alloc(arena, points->count, sizeof *positions);
    if (!mesh || !positions) return NULL;
    for (size_t i = 0; i < points->count; i++) {
        if (i % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return NULL;
        positions[i] =
            isnan(points->positions[i][0]) ? (zr_vec4){0, 0, 0, 1} : zr_recenter_position(points->positions[i], origin);
    }
    points->builder->scene->origin = origin;
    mesh->positions = positions;
    mesh->position_count = (uint32_t)points->count;
    mesh->colors = points->colors;
    return mesh;
}

enum zr_status zr_points_status(const struct zr_points *points, enum zr_status status)
{
    if (status == ZR_OK) return status;
    if (zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
    return points->error->count > 0 ? points->error->status : status;
}

enum zr_status zr_points_draw(struct zr_points *points, struct zr_mesh *mesh)
{
    struct zr_arena *arena = points->builder->arena;
    uint32_t *numbers = mesh ? zr_arena_alloc(arena, points->count, sizeof *numbers) : NULL;
    if (!numbers) return zr_points_status(points, ZR_NO_MEMORY);
    for (size_t i = 0; i < points->count; i++)
        if (!isnan(points->positions[i][0])) numbers[mesh->point_count++] = (uint32_t)i;
    mesh->points = numbers;
    if (mesh->point_count == points->count) { /* point i is position i */
        zr_arena_trim(arena, numbers, points->count, 0, sizeof *numbers);
        mesh->points = NULL;
    }
    const size_t holes = points->count - mesh->point_count;
    if (holes > 0)
        zr_warning_list_add(arena, &points->builder->warnings, "%s: %zu %s left out", points->format, holes,
                            holes == 1 ? "point is not finite and is" : "points are not finite and are");
    if (mesh->point_count == 0)
        return zr_error_add(points->error, ZR_BAD_SCENE, NULL, "no geometry: the %s file has no point to draw",
                            points->format);
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- lines of text ---- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

static bool is_separator(char c)
{
    return is_blank(c) || c == ',' || c == ';';
}

/* Returns the start of a comment: # at the start or after a blank, and // at the start. */
static const char *end_of_content(const struct zr_points_line *line)
{
    const char *at = line->at;
    if (line->end - at > 1 && at[0] == '/' && at[1] == '/') return at;
    while (at < line->end && (at = memchr(at, '#', (size_t)(line->end - at))) != NULL) {
        if (at == line->at || is_blank(at[-1])) return at;
        at++;
    }
    return line->end;
}

/* Takes a line off the text: it ends with \n, \r\n or \r. Each byte is looked at twice at most. */
static struct zr_points_line take_line(struct zr_points_text *text)
{
    const char *const at = text->at;
    if (!text->newline || text->newline < at) text->newline = memchr(at, '\n', (size_t)(text->end - at));
    if (!text->newline) text->newline = text->end;
    const char *carriage = memchr(at, '\r', (size_t)(text->newline - at)), *end = carriage ? carriage : text->newline;
    text->at = end + (end < text->end) + (carriage && end + 1 < text->end && end[1] == '\n');
    text->line++;
    return (struct zr_points_line){at, end};
}

bool zr_points_next(struct zr_points_text *text, struct zr_points_line *line)
{
    while (text->at < text->end) {
        if (text->line % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(text->cancel)) return false;
        *line = take_line(text);
        while (line->at < line->end && is_blank(*line->at))
            line->at++;
        line->end = end_of_content(line);
        while (line->end > line->at && is_blank(line->end[-1]))
            line->end--;
        if (line->at < line->end) return true;
    }
    return false;
}

struct zr_points_line zr_points_word(struct zr_points_line *line)
{
    while (line->at < line->end && is_separator(*line->at))
        line->at++;
    struct zr_points_line word = {line->at, line->at};
    while (word.end < line->end && !is_separator(*word.end))
        word.end++;
    line->at = word.end;
    return word;
}

bool zr_points_is(const struct zr_points_line *word, const char *text)
{
    const size_t length = (size_t)(word->end - word->at);
    return length == strlen(text) && strncasecmp(word->at, text, length) == 0;
}

/* Reads nan and inf, with a sign, as a number that is not finite. */
static bool read_not_finite(const struct zr_points_line *word, double *out)
{
    static const char *const words[] = {"nan", "inf", "infinity", "nan(ind)", "1.#qnan", "1.#ind", "1.#inf"};
    struct zr_points_line rest = *word;
    if (rest.at < rest.end && (*rest.at == '-' || *rest.at == '+')) rest.at++;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (zr_points_is(&rest, words[i])) {
            *out = (double)NAN;
            return true;
        }
    return false;
}

int zr_points_numbers(struct zr_points_line *line, double *out, int most)
{
    int count = 0;
    while (count < most) {
        const struct zr_points_line before = *line, word = zr_points_word(line);
        if (word.at == word.end) break;
        if (zr_number_read(word.at, word.end, &out[count]) != word.end && !read_not_finite(&word, &out[count])) {
            *line = (struct zr_points_line){word.at, before.end};
            return -1;
        }
        count++;
    }
    return count;
}

enum zr_status zr_points_fault(struct zr_points *points, size_t line, const char *format, ...)
{
    char text[200];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "line %zu: %s", line, text);
}
