/* json_scalars.h - input: numbers of a mesh, and the colormap that turns them into colours.
 *
 * Colours are made while the scene is read; drawing has no scalars. Between corners, colours are interpolated, not
 * numbers, as for all vertex colours.
 */
#ifndef ZR_JSON_SCALARS_H
#define ZR_JSON_SCALARS_H

#include "input/json/json_list.h"
#include "input/json/json_value.h"
#include "scene/colormap.h"
#include "scene/scene_builder.h"

struct zr_scalars {
    struct zr_growing values; /* floats; items is NULL if there are no scalars */
    int colormap;             /* enum zr_colormap; -1: not given */
    bool has_range;
    float range[2];
};
#define ZR_SCALARS_UNSET                                                                                               \
    {                                                                                                                  \
        .values.size = sizeof(float), .colormap = -1                                                                   \
    }

/* Rows for the table of an object that fills a `type`, whose member `member` is a struct zr_scalars. */
#define ZR_SCALARS_FIELDS(type, member)                                                                                \
    {.key = "scalars",                                                                                                 \
     .read = zr_read_scalars,                                                                                          \
     .offset = offsetof(type, member),                                                                                 \
     .text = "numbers, one per position or per face, coloured by a colormap"},                                         \
        {.key = "colormap",                                                                                            \
         .read = zr_json_choice,                                                                                       \
         .offset = offsetof(type, member.colormap),                                                                    \
         .words = &zr_colormap_names,                                                                                  \
         .otherwise = "viridis",                                                                                       \
         .text = "colour map of the scalars, or of the heights of a mesh without scalars"},                            \
    {                                                                                                                  \
        .key = "range", .read = zr_read_scalar_range, .offset = offsetof(type, member),                                \
        .otherwise = "the smallest and the largest number", .text = "numbers of the first and the last colour"         \
    }
zr_json_read_fn zr_read_scalars, zr_read_scalar_range; /* struct zr_scalars */

/* Reports a map or range of a mesh without scalars and heights. `path`: the mesh's. */
void zr_scalars_check_none(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars);

/* Sets colors or face_colors, and scale, of a mesh with positions and faces; does nothing without scalars and map. `z`:
 * of a grid, one per position, NaN in holes, whose scalars do not count; else NULL. `path`: the mesh's. Reports faults,
 * such as other colours of the mesh, and warns of scalars outside of the range. */
void zr_scalars_apply(struct zr_json *json, const struct zr_json_path *path, const struct zr_scalars *scalars,
                      const float *z, struct zr_warning_list *warnings, struct zr_mesh *mesh);

#endif
