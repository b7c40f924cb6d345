/* parsed_mesh.h - input: a mesh of a JSON scene. Its lists of numbers go into arrays while the text is read.
 *
 * json_mesh_lists.c reads the lists. json_mesh.c checks that they agree, once all are read.
 */
#ifndef ZR_PARSED_MESH_H
#define ZR_PARSED_MESH_H

#include "input/mesh/json_heights.h"
#include "input/mesh/json_scalars.h"
#include "input/scene/json_scene.h"

/* Faces, lines and points while they are read. positions: the bound that indices were checked against; UINT32_MAX if
 * positions come later in the text. */
struct zr_parsed_faces {
    struct zr_growing ends, indices; /* ends: 0, then the end of each face in indices */
    uint32_t positions;
};

struct zr_parsed_lines {
    struct zr_growing ends; /* two indices per line */
    uint32_t positions;
};

struct zr_parsed_points {
    struct zr_growing indices;
    uint32_t positions;
};

enum { ZR_POINT_SQUARE, ZR_POINT_ROUND, ZR_POINT_SHAPES };

/* A mesh as read. */
struct zr_parsed_mesh {
    uint64_t keys;               /* bit i: key i is given */
    const char *name, *material; /* NULL: not given */
    struct zr_face_style face_style;
    struct zr_bytes_name file;
    struct zr_model *model; /* the file as read (json_model.c); or NULL */
    struct zr_growing positions, normals, colors, face_colors, texcoords, texcoords1, tangents;
    struct zr_parsed_faces faces;
    struct zr_parsed_lines lines;
    struct zr_parsed_points points;
    float point_size;
    int point_shape; /* ZR_POINT_ROUND ... */
    struct zr_heights heights;
    struct zr_scalars scalars;
};

/* json_model.c: a mesh that is a model file, such as {"asset": "robot.glb"}.
 *
 * Order:  a file is read with the list of meshes; its materials and instances are made once the root is read.
 * Axes:   those of the file. A far origin (recenter.h) is added to its instances again.
 * Meshes: mesh i of the list is mesh i of the scene. The other meshes of its file follow the list and the polygons.
 *         Their entries of scene->mesh_owners are i.
 *
 * zr_model_read reads the file, and returns NULL after a fault. `path` leads to the mesh. zr_model_make is called after
 * zr_parsed_number_models. It fills meshes[], and returns true if the file has points.
 * Faces have the material of `style`, else the file's material. */
struct zr_model *zr_model_read(struct zr_parsed_scene *root, const struct zr_json_path *path,
                               const struct zr_bytes_name *name);
bool zr_model_make(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                   const struct zr_style *style, struct zr_mesh *meshes);

zr_json_read_fn zr_read_mesh_positions, zr_read_mesh_colors, zr_read_mesh_normals, zr_read_mesh_texcoords,
    zr_read_mesh_tangents;                                                   /* struct zr_growing */
zr_json_read_fn zr_read_mesh_faces, zr_read_mesh_lines, zr_read_mesh_points; /* struct zr_parsed_mesh */

#endif
