/* json_mesh.h - input: a mesh of a JSON scene, and its lists of numbers, which are read into arrays where they are met.
 *
 * What lists must agree on is looked at once all of them are read: json_mesh.c does so, json_mesh_lists.c reads them.
 */
#ifndef ZR_JSON_MESH_H
#define ZR_JSON_MESH_H

#include "input/json_heights.h"
#include "input/json_scalars.h"
#include "input/json_scene.h"

/* Faces, lines and points while they are read. positions: what indices are known to be below, UINT32_MAX where these
 * come later in the text. */
struct zr_parsed_faces {
    struct zr_growing ends, indices; /* ends: of each face in indices, behind a first one that is 0 */
    uint32_t positions;
};

struct zr_parsed_lines {
    struct zr_growing ends; /* two a line */
    uint32_t positions;
};

struct zr_parsed_points {
    struct zr_growing indices;
    uint32_t positions;
};

/* A mesh as the scene has it. */
struct zr_parsed_mesh {
    uint64_t keys;               /* those that are there */
    const char *name, *material; /* NULL: no word of it */
    struct zr_face_style face_style;
    struct zr_growing positions, normals, colors, face_colors, texcoords, texcoords1, tangents;
    struct zr_parsed_faces faces;
    struct zr_parsed_lines lines;
    struct zr_parsed_points points;
    float point_size;
    struct zr_heights heights;
    struct zr_scalars scalars;
};

zr_json_read_fn zr_read_mesh_positions, zr_read_mesh_colors, zr_read_mesh_normals, zr_read_mesh_texcoords,
    zr_read_mesh_tangents;                                                   /* struct zr_growing */
zr_json_read_fn zr_read_mesh_faces, zr_read_mesh_lines, zr_read_mesh_points; /* struct zr_parsed_mesh */

#endif
