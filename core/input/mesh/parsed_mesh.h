/* parsed_mesh.h - input: a mesh of a JSON scene. Its lists of numbers go into arrays while the text is read.
 *
 * json_mesh_lists.c reads the lists. json_mesh.c checks that they agree, once all are read.
 */
#ifndef ZR_PARSED_MESH_H
#define ZR_PARSED_MESH_H

#include "input/json/json_list.h"
#include "input/mesh/shapes.h"
#include "input/scene/json_scene.h"
#include "scene/colormap.h"
#include "scene/scene_builder.h"

/* ---- json_heights.c: a grid of heights, z = f(x, y), becomes positions and quads ---- */

/* A grid as read. Zero-initialise, except values.size = sizeof(float). */
struct zr_heights {
    struct zr_growing values; /* floats, row by row; NaN is a hole */
    size_t rows, columns;     /* columns: of the first row; 0 after a reported fault */
    bool has_holes;
    uint64_t keys;     /* bit i: key i is given */
    double x[2], y[2]; /* coordinates of the first and the last column and row, if given */
};

/* struct zr_heights: a list of rows, or an object that has one. */
zr_json_read_fn zr_read_heights;

/* zr_heights_make makes positions, faces and, on demand, texture coordinates of the mesh, holes included. False after a
 * fault, here or before. Once all other data of the mesh are set, zr_heights_drop_holes removes cells with a hole at a
 * corner, and unused positions. */
bool zr_heights_make(struct zr_json *json, const struct zr_json_path *path, const struct zr_heights *heights,
                     bool with_texcoords, struct zr_mesh *mesh);
void zr_heights_drop_holes(struct zr_arena *arena, const struct zr_heights *heights, struct zr_mesh *mesh);

/* struct zr_shape_desc: json_shape.c */
zr_json_read_fn zr_read_shape;

/* ---- json_scalars.c: numbers of a mesh, and the colormap that turns them into colours ----
 *
 * Colours are made while the scene is read; drawing has no scalars. Between corners, colours are interpolated, not
 * numbers, as for all vertex colours. */

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

/* ---- meshes ---- */

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
    struct zr_shape_desc shape; /* json_shape.c; type -1: none, or refused */
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
/* Returns the origin that the file's reader subtracted, or NULL. */
const double *zr_model_origin(const struct zr_model *model);
bool zr_model_make(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                   const struct zr_style *style, struct zr_mesh *meshes);

zr_json_read_fn zr_read_mesh_positions, zr_read_mesh_colors, zr_read_mesh_normals, zr_read_mesh_texcoords,
    zr_read_mesh_tangents;                                                   /* struct zr_growing */
zr_json_read_fn zr_read_mesh_faces, zr_read_mesh_lines, zr_read_mesh_points; /* struct zr_parsed_mesh */

/* ---- json_soup.c: the polygons of a scene read so far, which become one mesh once the root is read ----
 *
 * Each is a face with its own vertices and style. */

/* Kinds of polygons, by their optional colours and normals: a sum. */
enum { ZR_POLYGON_COLOR = 1, ZR_POLYGON_COLORS = 2, ZR_POLYGON_NORMALS = 4, ZR_POLYGON_KINDS = 8 };

/* The key of a polygon's material. */
#define ZR_POLYGON_MATERIAL "material"

/* The style of polygons; it becomes a material once the root is read. */
struct zr_polygon_style {
    uint32_t polygon;             /* the first with this style */
    int has;                      /* its kind */
    struct zr_json_text material; /* name as written, escapes unresolved; at is NULL if there is none */
    struct zr_face_style face_style;
};

/* An optional array is empty until a polygon has such a list; then the earlier polygons get defaults. */
struct zr_soup {
    struct zr_growing positions, colors, normals; /* one per vertex; colors and normals are optional */
    struct zr_growing offsets, face_styles;       /* one per polygon */
    struct zr_growing face_colors;                /* one per polygon; optional */
    struct zr_growing rings, ring_offsets;        /* of all polygons; empty without holes */
    struct zr_growing styles;                     /* struct zr_polygon_style */
    /* the last style of each kind, for comparison: consecutive polygons often share it */
    uint32_t last_styles[ZR_POLYGON_KINDS];
};

_Static_assert(sizeof(struct zr_soup) <= ZR_JSON_STATE_MAX, "a state of json_list.h");

/* Defaults of colours, and of normals, which are computed later. */
extern const zr_vec4 zr_soup_white;
extern const zr_vec3 zr_soup_computed;

struct zr_soup zr_soup_empty(void);

/* Finds the number of an equal style, or adds the style. */
bool zr_soup_find_style(struct zr_json *json, struct zr_soup *soup, const struct zr_polygon_style *style,
                        uint32_t *number);

/* begin_part and join of a list of polygons (json_list.h). Parts have no holes. */
bool zr_soup_begin_part(struct zr_json *json, const void *state, void *part, double share);
bool zr_soup_join(struct zr_json *json, void *state, const void *part);

#endif
