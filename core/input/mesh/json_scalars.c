#include "input/mesh/parsed_mesh.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/cancel.h"
#include "input/json/json_array.h"
#include "input/json/json_number_rows.h"
#include "scene/degenerate_face.h"
#include "scene/mesh_label.h"

#define VALUE_MAX ((double)FLT_MAX)

/* Values between two checks for cancellation. */
enum { VALUES_PER_CANCEL_CHECK = 1 << 16 };

/* ---- reading ---- */

/* Reads numbers in usual form; true at the list's end. `json` is before the '['; on false it is at the '[' or ','
 * before a number in another form. */
static bool read_plain(struct zr_json *json, struct zr_growing *values)
{
    const char *behind;
    float *value;
    while ((value = zr_growing_next(values, json)) &&
           (behind = zr_numbers_next(json->at, json->end, -VALUE_MAX, VALUE_MAX, value))) {
        values->count++;
        json->at = behind;
        if (*behind == ']') {
            json->at++;
            return true;
        }
        if (values->count % VALUES_PER_CANCEL_CHECK == 0 && zr_json_stops(json)) return false;
    }
    return false;
}

/* Reads the other numbers and reports each fault. */
static void read_odd(struct zr_json *json, const struct zr_json_path *path, struct zr_growing *values)
{
    for (; zr_json_item(json); values->count++) {
        double number = 0.0;
        float *value = zr_growing_next(values, json);
        if (!value) return;
        zr_json_number_in(json, ZR_JSON_ITEM(path, values->count), -VALUE_MAX, VALUE_MAX, &number);
        *value = (float)number;
    }
}

bool zr_read_scalars(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_array_wanted wanted = {.least = 1, .most = 1, .low = -VALUE_MAX, .high = VALUE_MAX};
    struct zr_growing *values = &((struct zr_scalars *)out)->values;
    if (zr_json_type(json) == ZR_JSON_OBJECT) return zr_json_array_read(json, path, &wanted, values);
    if (!zr_json_list(json, path) || !zr_growing_reserve(values, json, 1)) return false;
    if (!read_plain(json, values)) {
        if (values->count == 0)
            zr_json_enter(json, '[');
        else
            json->depth++;
        read_odd(json, path, values);
    }
    zr_growing_trim(values, json->arena);
    return true;
}

bool zr_read_scalar_range(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_scalars *scalars = out;
    double ends[2] = {0, 0};
    const struct zr_json_row row = {2, 2, -VALUE_MAX, VALUE_MAX};
    if (!zr_json_numbers(json, path, row, ends, NULL)) return false;
    if (ends[0] > ends[1])
        return zr_json_fault(json, path, "%.9g to %.9g: the lower end must come first", ends[0], ends[1]);
    scalars->range[0] = (float)ends[0];
    scalars->range[1] = (float)ends[1];
    return scalars->has_range = true;
}

/* ---- colours ---- */

/* The numbers to colour, and their range. */
struct coloring {
    const float *values;
    size_t count;
    const float *z; /* of zr_scalars_apply, if values are per position; else NULL */
    float low, high;
    enum zr_colormap map;
    uint64_t below, above; /* how many numbers are outside of the range */
};

static bool is_hole(const struct coloring *coloring, size_t i)
{
    return coloring->z && isnan(coloring->z[i]);
}

static bool any_hole(const float *z, const uint32_t *corners, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (isnan(z[corners ? corners[i] : i])) return true;
    return false;
}

/* Returns one byte per number: 1 if a drawn face, line or point has it, else 0. `z`: heights of a grid, which draws no
 * cell beside a hole; NULL for other meshes. Returns NULL if a grid has no hole, if memory runs out, and after a fault,
 * since indices may then be wrong. */
static uint8_t *find_drawn(struct zr_json *json, bool is_of_faces, const float *z, const struct zr_mesh *mesh)
{
    if (json->error->count > 0 || (z && !any_hole(z, NULL, mesh->position_count))) return NULL;
    uint8_t *drawn = zr_arena_zero(json->arena, is_of_faces ? mesh->face_count : mesh->position_count, sizeof *drawn);
    for (uint32_t face = 0; drawn && face < mesh->face_count; face++) {
        const uint32_t *corners = mesh->indices + mesh->face_offsets[face];
        const size_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
        if (zr_face_is_degenerate(mesh, face) || (z && any_hole(z, corners, count))) continue;
        for (size_t i = 0; i < count; i++)
            drawn[is_of_faces ? face : corners[i]] = 1;
    }
    if (!drawn || is_of_faces) return drawn;
    for (size_t i = 0; i < mesh->line_count; i++) {
        const uint32_t *line = mesh->lines + 2 * i;
        if (!zr_is_same_place(mesh, line[0], line[1])) drawn[line[0]] = drawn[line[1]] = 1;
    }
    for (uint32_t i = 0; i < mesh->point_count; i++)
        drawn[zr_mesh_point(mesh, i)] = 1;
    return drawn;
}

/* Finds the least and the greatest number of drawn faces or positions. */
static void find_range(struct zr_json *json, const float *z, const struct zr_mesh *mesh, struct coloring *coloring)
{
    uint8_t *drawn = find_drawn(json, coloring->count != mesh->position_count, z, mesh);
    coloring->low = FLT_MAX;
    coloring->high = -FLT_MAX;
    for (size_t i = 0; i < coloring->count; i++) {
        if ((drawn && !drawn[i]) || is_hole(coloring, i)) continue;
        if (coloring->values[i] < coloring->low) coloring->low = coloring->values[i];
        if (coloring->values[i] > coloring->high) coloring->high = coloring->values[i];
    }
    if (drawn) zr_arena_trim(json->arena, drawn, coloring->count, 0, sizeof *drawn);
}

/* The place of a number in the map, 0..1. In double, so that a difference of two floats is finite. A range of length 0
 * maps its value to the middle. */
static float place(struct coloring *coloring, size_t i)
{
    const double low = (double)coloring->low, high = (double)coloring->high;
    const float value = coloring->values[i];
    if (is_hole(coloring, i)) return 0.0f;
    coloring->below += value < coloring->low;
    coloring->above += value > coloring->high;
    if (value < coloring->low) return 0.0f;
    if (value > coloring->high) return 1.0f;
    return low < high ? (float)(((double)value - low) / (high - low)) : 0.5f;
}

static const zr_vec4 *make_colors(struct zr_json *json, struct coloring *coloring)
{
    zr_vec4 *colors = zr_arena_alloc(json->arena, coloring->count, sizeof *colors);
    for (size_t i = 0; colors && i < coloring->count; i++) {
        if (i % VALUES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(json->cancel)) return NULL;
        colors[i] = zr_colormap_color(coloring->map, place(coloring, i));
    }
    return colors;
}

static void warn(struct zr_json *json, const struct zr_json_path *path, const struct zr_mesh *mesh,
                 const struct coloring *coloring, struct zr_warning_list *warnings)
{
    const unsigned long long outside = coloring->below + coloring->above;
    if (outside > 0)
        zr_warning_list_add(json->arena, warnings,
                            "%s: %llu of %zu scalars are outside of the range from %.9g to %.9g and have the "
                            "colours of its ends",
                            zr_mesh_label_of(path->index, mesh->name).text, outside, coloring->count,
                            (double)coloring->low, (double)coloring->high);
}

/* NULL if all numbers are in holes, or if memory runs out. */
static const struct zr_color_scale *make_scale(struct zr_json *json, const struct coloring *coloring,
                                               bool is_range_given)
{
    if (coloring->low > coloring->high) return NULL;
    struct zr_color_scale *scale = zr_arena_alloc(json->arena, 1, sizeof *scale);
    if (scale) *scale = (struct zr_color_scale){coloring->map, coloring->low, coloring->high, is_range_given};
    return scale;
}

static void check_none(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars,
                       const float *z)
{
    if (scalars->colormap >= 0 && !z)
        zr_json_fault(json, ZR_JSON_KEY(path, "colormap"), "a colormap needs scalars or heights");
    if (scalars->has_range)
        zr_json_fault(json, ZR_JSON_KEY(path, "range"), "a range without scalars%s", z ? " or a colormap" : "");
}

void zr_scalars_check_none(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars)
{
    check_none(json, path, scalars, NULL);
}

/* False if there is nothing to colour, or after a fault. */
static bool choose(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars,
                   const float *z, const struct zr_mesh *mesh)
{
    const bool has_values = scalars->values.items != NULL, has_map = scalars->colormap >= 0;
    if (!has_values && !(z && has_map)) {
        check_none(json, path, scalars, z);
        return false;
    }
    if (!mesh->colors && !mesh->face_colors) return true;
    return zr_json_fault(json, ZR_JSON_KEY(path, has_values ? "scalars" : "colormap"),
                         "two kinds of colours: %s and %s", has_values ? "scalars" : "a colormap",
                         mesh->colors ? "colors" : "faceColors");
}

void zr_scalars_apply(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars,
                      const float *z, struct zr_warning_list *warnings, struct zr_mesh *mesh)
{
    if (!choose(json, path, scalars, z, mesh)) return;
    const bool has_values = scalars->values.items != NULL;
    struct coloring coloring = {.values = has_values ? scalars->values.items : z,
                                .count = has_values ? scalars->values.count : mesh->position_count,
                                .low = scalars->range[0],
                                .high = scalars->range[1],
                                .map =
                                    scalars->colormap < 0 ? ZR_COLORMAP_VIRIDIS : (enum zr_colormap)scalars->colormap};
    if (coloring.count != mesh->position_count && coloring.count != mesh->face_count) {
        zr_json_fault(json, ZR_JSON_KEY(path, "scalars"),
                      "%zu items for %u positions and %u faces; one per position or one per face is needed",
                      coloring.count, mesh->position_count, mesh->face_count);
        return;
    }
    if (coloring.count == mesh->position_count) coloring.z = z;
    if (!scalars->has_range) find_range(json, z, mesh, &coloring);
    const zr_vec4 *colors = make_colors(json, &coloring);
    if (coloring.count == mesh->position_count)
        mesh->colors = colors;
    else
        mesh->face_colors = colors;
    mesh->scale = make_scale(json, &coloring, scalars->has_range);
    if (scalars->has_range) warn(json, path, mesh, &coloring, warnings);
}
