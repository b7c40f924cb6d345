/* Vertices of PLY: stores them; all threads read binary records of one size. */
#include <math.h>
#include <string.h>

#include "input/ply/ply_file.h"
#include "input/text/parts.h"

/* Read in a tenth of a millisecond. */
#ifndef ZR_PLY_PART_VERTICES /* smaller in tests/unit/formats/test_ply_parts.c */
#define ZR_PLY_PART_VERTICES (1 << 13)
#endif

double zr_ply_color_scale(enum zr_ply_type type)
{
    return type == ZR_PLY_F32 || type == ZR_PLY_F64 ? 1.0 : type == ZR_PLY_U16 ? 65535.0 : 255.0;
}

bool zr_ply_make_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan)
{
    const size_t count = file->vertex_count = plan->element->count;
    file->positions = zr_arena_alloc(file->arena, count, sizeof *file->positions);
    if (plan->slots[ZR_PLY_NX]) file->normals = zr_arena_alloc(file->arena, count, sizeof *file->normals);
    if (plan->slots[ZR_PLY_RED]) file->colors = zr_arena_alloc(file->arena, count, sizeof *file->colors);
    if (plan->slots[ZR_PLY_S]) file->texcoords = zr_arena_alloc(file->arena, count, sizeof *file->texcoords);
    return zr_arena_ok(file->arena);
}

/* ---- storing ---- */

static bool is_within(double value, double limit)
{
    return value >= -limit && value <= limit; /* false for a NaN */
}

/* Stores a position beyond the limit: a hole if it is not finite, else a fault. */
static void store_odd(struct zr_ply_file *file, size_t vertex, const double v[3], struct zr_error *error)
{
    if (!isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2])) {
        file->positions[vertex] = (zr_vec4){NAN, NAN, NAN, 1};
        atomic_store_explicit(&file->has_holes, true, memory_order_relaxed);
        return;
    }
    zr_error_add(error, ZR_BAD_SCENE, NULL, "vertex %zu: (%.9g, %.9g, %.9g) is beyond the limit of %.9g", vertex, v[0],
                 v[1], v[2], zr_recenter_limit(file->limits));
}

static void store_positions(struct zr_ply_file *file, const struct zr_ply_columns *columns, size_t first, size_t count,
                            size_t faults, struct zr_error *error)
{
    const double near = (double)file->limits->coordinate_max, limit = zr_recenter_limit(file->limits);
    bool is_far = false;
    for (size_t i = 0; i < count && error->count < faults; i++) {
        const double v[3] = {columns->values[ZR_PLY_X][i], columns->values[ZR_PLY_Y][i], columns->values[ZR_PLY_Z][i]};
        if (!(is_within(v[0], limit) && is_within(v[1], limit) && is_within(v[2], limit))) {
            store_odd(file, first + i, v, error);
            continue;
        }
        is_far |= !(is_within(v[0], near) && is_within(v[1], near) && is_within(v[2], near));
        if (file->finds_box && (!file->used || file->used[first + i])) zr_box_include(&file->box, v);
        file->positions[first + i] = zr_recenter_position(v, file->origin);
    }
    if (is_far) atomic_store_explicit(&file->is_far, true, memory_order_relaxed);
}

/* Stores an invalid normal as zero, which a computed normal later replaces. */
static void store_normals(struct zr_ply_file *file, const struct zr_ply_columns *columns, size_t first, size_t count)
{
    const double limit = (double)file->limits->coordinate_max;
    for (size_t i = 0; i < count; i++) {
        const double *x = columns->values[ZR_PLY_NX] + i, *y = columns->values[ZR_PLY_NY] + i,
                     *z = columns->values[ZR_PLY_NZ] + i;
        const bool is_good = is_within(*x, limit) && is_within(*y, limit) && is_within(*z, limit);
        file->normals[first + i] = is_good ? (zr_vec3){(float)*x, (float)*y, (float)*z} : (zr_vec3){0, 0, 0};
    }
}

static void store_texcoords(struct zr_ply_file *file, const struct zr_ply_columns *columns, size_t first, size_t count)
{
    const double limit = (double)file->limits->coordinate_max;
    for (size_t i = 0; i < count; i++) {
        const double s = columns->values[ZR_PLY_S][i], t = columns->values[ZR_PLY_T][i];
        const bool is_good = is_within(s, limit) && is_within(t, limit);
        file->texcoords[first + i] = is_good ? (zr_vec4){(float)s, (float)t, 0, 0} : (zr_vec4){0, 0, 0, 0};
    }
}

/* Stores opaque colours of 0xRRGGBB, whose bits a float may have. */
static void store_packed(enum zr_ply_type type, const double *values, size_t count, zr_vec4 *out)
{
    for (size_t i = 0; i < count; i++) {
        const float number = (float)values[i];
        uint32_t bits = (uint32_t)(int64_t)(fabs(values[i]) <= 4294967295.0 ? values[i] : 0.0);
        if (type == ZR_PLY_F32) memcpy(&bits, &number, sizeof bits);
        out[i] = (zr_vec4){(float)(bits >> 16 & 255) / 255.0f, (float)(bits >> 8 & 255) / 255.0f,
                           (float)(bits & 255) / 255.0f, 1};
    }
}

/* Stores the mean colours of splats: the constant harmonic times its coefficient, around grey. */
static void store_splats(const struct zr_ply_columns *columns, size_t count, zr_vec4 *out)
{
    static const double harmonic = 0.28209479177387814; /* 1 / (2 sqrt(pi)) */
    for (size_t i = 0; i < count; i++) {
        float v[3];
        for (int k = 0; k < 3; k++) {
            const double value = 0.5 + harmonic * columns->values[ZR_PLY_RED + k][i];
            v[k] = value > 0.0 ? (float)(value < 1.0 ? value : 1.0) : 0.0f;
        }
        out[i] = (zr_vec4){v[0], v[1], v[2], 1};
    }
}

void zr_ply_store_colors(struct zr_ply_file *file, const struct zr_ply_plan *plan, const struct zr_ply_columns *columns,
                         size_t count, zr_vec4 *out)
{
    double scales[4];
    bool is_odd = false;
    if (plan->is_splat) {
        store_splats(columns, count, out);
        return;
    }
    if (plan->is_packed) { /* a reader of records fills the last slot of a property */
        store_packed(plan->slots[ZR_PLY_BLUE]->type, columns->values[ZR_PLY_BLUE], count, out);
        return;
    }
    for (int k = 0; k < 4; k++) {
        const struct zr_ply_property *property = plan->slots[ZR_PLY_RED + k];
        scales[k] = property ? zr_ply_color_scale(property->type) : 1.0;
    }
    for (size_t i = 0; i < count; i++) {
        float v[4] = {0, 0, 0, 1};
        for (int k = 0; k < 4; k++) {
            if (k < 3 || plan->slots[ZR_PLY_ALPHA]) v[k] = (float)(columns->values[ZR_PLY_RED + k][i] / scales[k]);
            is_odd |= !(v[k] >= 0.0f && v[k] <= 1.0f);
        }
        out[i] = (zr_vec4){v[0], v[1], v[2], v[3]};
    }
    if (is_odd) atomic_store_explicit(&file->has_odd_colors, true, memory_order_relaxed);
}

/* Stores normals, texture coordinates and colours. */
static void store_others(struct zr_ply_file *file, const struct zr_ply_plan *plan, const struct zr_ply_columns *columns,
                         size_t first, size_t count)
{
    if (file->normals) store_normals(file, columns, first, count);
    if (file->colors) zr_ply_store_colors(file, plan, columns, count, file->colors + first);
    if (file->texcoords) store_texcoords(file, columns, first, count);
}

void zr_ply_store_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan,
                           const struct zr_ply_columns *columns, size_t first, size_t count, size_t faults,
                           struct zr_error *error)
{
    store_positions(file, columns, first, count, faults, error);
    store_others(file, plan, columns, first, count);
}

/* ---- binary, all threads ---- */

struct reading {
    struct zr_ply_file *file;
    const struct zr_ply_plan *plan;
    bool is_swapped;
    bool is_plain; /* x, y and z are three floats side by side, in the machine's byte order */
};

/* Stores plain positions up to the first beyond the limit of meshes near the origin; returns their number. */
static size_t read_plain(const struct reading *reading, const char *at, size_t first, size_t count)
{
    const float limit = reading->file->limits->coordinate_max;
    const size_t stride = reading->plan->element->least_bytes;
    zr_vec4 *out = reading->file->positions + first;
    for (size_t i = 0; i < count; i++, at += stride) {
        float v[3];
        memcpy(v, at, sizeof v);
        if (!(fabsf(v[0]) <= limit && fabsf(v[1]) <= limit && fabsf(v[2]) <= limit)) return i;
        out[i] = (zr_vec4){v[0], v[1], v[2], 1};
    }
    return count;
}

/* Reads `count` records, at most ZR_PLY_BLOCK. */
static void read_block(const struct reading *reading, size_t first, size_t count, size_t faults, struct zr_error *error)
{
    const struct zr_ply_plan *plan = reading->plan;
    const size_t stride = plan->element->least_bytes;
    const char *at = reading->file->at + first * stride;
    struct zr_ply_columns columns;
    int slot = ZR_PLY_X;
    const bool is_stored =
        reading->is_plain && read_plain(reading, at + plan->slots[ZR_PLY_X]->offset, first, count) == count;
    if (is_stored) slot = ZR_PLY_NX;
    for (; slot < ZR_PLY_SLOTS; slot++) {
        const struct zr_ply_property *property = plan->slots[slot];
        if (property)
            zr_ply_column(at + property->offset, stride, count, property->type, reading->is_swapped,
                          columns.values[slot]);
    }
    if (!is_stored) store_positions(reading->file, &columns, first, count, faults, error);
    store_others(reading->file, plan, &columns, first, count);
}

/* Reads records begin..end - 1, up to `faults` faults. */
static void read_range(const struct reading *reading, size_t begin, size_t end, size_t faults, struct zr_error *error)
{
    for (size_t first = begin; first < end && error->count < faults; first += ZR_PLY_BLOCK)
        read_block(reading, first, end - first < ZR_PLY_BLOCK ? end - first : ZR_PLY_BLOCK, faults, error);
}

static bool read_part(void *context, size_t part)
{
    const struct reading *reading = context;
    const size_t begin = part * ZR_PLY_PART_VERTICES, left = reading->file->vertex_count - begin;
    struct zr_error error = {.count = 0};
    read_range(reading, begin, begin + (left < ZR_PLY_PART_VERTICES ? left : ZR_PLY_PART_VERTICES), 1, &error);
    return error.count == 0;
}

enum zr_status zr_ply_read_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan)
{
    struct reading reading = {.file = file, .plan = plan, .is_swapped = zr_ply_is_swapped(file->header.form)};
    const struct zr_ply_property *const *slots = plan->slots;
    const size_t count = file->vertex_count, parts = (count + ZR_PLY_PART_VERTICES - 1) / ZR_PLY_PART_VERTICES;
    reading.is_plain = !reading.is_swapped && !file->finds_box && !file->origin;
    for (size_t k = 0; k < 3; k++)
        reading.is_plain &= slots[k]->type == ZR_PLY_F32 && slots[k]->offset == slots[0]->offset + 4 * k;
    const size_t failed = file->finds_box ? 0 : zr_parts_read(file->team, file->cancel, 0, parts, read_part, &reading);
    for (size_t part = failed; part < parts && !zr_is_cancelled(file->cancel); part++) {
        const size_t begin = part * ZR_PLY_PART_VERTICES, left = count - begin;
        read_range(&reading, begin, begin + (left < ZR_PLY_PART_VERTICES ? left : ZR_PLY_PART_VERTICES), ZR_ERROR_ITEMS,
                   file->error);
    }
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    file->at += count * plan->element->least_bytes;
    return file->error->count > 0 ? file->error->status : ZR_OK;
}
