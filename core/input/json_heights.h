/* json_heights.h - input: a grid of heights, z = f(x, y) -> positions and quads. */
#ifndef ZR_JSON_HEIGHTS_H
#define ZR_JSON_HEIGHTS_H

#include "input/growing.h"
#include "input/json_value.h"
#include "scene/scene.h"

/* A grid as it is given. All zero but `values`, whose items are floats. */
struct zr_heights {
    struct zr_growing values; /* row by row; NaN where there is a hole */
    size_t rows, columns;     /* columns: of the first row; 0 where rows are missing or differ, which is reported */
    bool has_holes;
    uint64_t keys;    /* those that are there */
    float x[2], y[2]; /* of the first and the last column, and row, where they are given */
};

/* struct zr_heights: a list of rows, or an object that has one. */
zr_json_read_fn zr_read_heights;

/* Positions, faces and, where they are wanted, texture coordinates of the mesh, holes included; false where there was a
 * fault, here or before. Once everything else
 * of the mesh is there, zr_heights_drop_holes takes away the cells that touch a hole, and positions left without a
 * cell. */
bool zr_heights_make(struct zr_json *json, const struct zr_json_path *path, const struct zr_heights *heights,
                     bool with_texcoords, struct zr_mesh *mesh);
void zr_heights_drop_holes(struct zr_arena *arena, const struct zr_heights *heights, struct zr_mesh *mesh);

#endif
