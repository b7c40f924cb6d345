/* json_heights.h - input: converts a grid of heights, z = f(x, y), to positions and quads. */
#ifndef ZR_JSON_HEIGHTS_H
#define ZR_JSON_HEIGHTS_H

#include "input/json/json_list.h"
#include "input/json/json_value.h"
#include "scene/scene.h"

/* A grid as read. Zero-initialise, except values.size = sizeof(float). */
struct zr_heights {
    struct zr_growing values; /* floats, row by row; NaN is a hole */
    size_t rows, columns;     /* columns: of the first row; 0 after a reported fault */
    bool has_holes;
    uint64_t keys;    /* bit i: key i is given */
    float x[2], y[2]; /* coordinates of the first and the last column and row, if given */
};

/* struct zr_heights: a list of rows, or an object that has one. */
zr_json_read_fn zr_read_heights;

/* zr_heights_make makes positions, faces and, on demand, texture coordinates of the mesh, holes included. False after a
 * fault, here or before. Once all other data of the mesh are set, zr_heights_drop_holes removes cells with a hole at a
 * corner, and unused positions. */
bool zr_heights_make(struct zr_json *json, const struct zr_json_path *path, const struct zr_heights *heights,
                     bool with_texcoords, struct zr_mesh *mesh);
void zr_heights_drop_holes(struct zr_arena *arena, const struct zr_heights *heights, struct zr_mesh *mesh);

#endif
