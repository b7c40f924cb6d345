/* gltf_parts.h - input: the parts of a primitive of glTF: attributes, faces, targets, skins, compressed data;
 * private to its readers. */
#ifndef ZR_GLTF_PARTS_H
#define ZR_GLTF_PARTS_H

#include "input/gltf/gltf_file.h"

struct zr_draco_mesh; /* draco.h */

/* `mode` of a primitive. */
enum {
    ZR_GLTF_POINTS,
    ZR_GLTF_LINES,
    ZR_GLTF_LINE_LOOP,
    ZR_GLTF_LINE_STRIP,
    ZR_GLTF_TRIANGLES,
    ZR_GLTF_TRIANGLE_STRIP,
    ZR_GLTF_TRIANGLE_FAN
};

/* Attributes of a primitive: accessor numbers, or NONE. */
struct zr_gltf_attributes {
    uint32_t position, normal, tangent, texcoords[ZR_GLTF_SETS], color, joints[2], weights[2];
};

#define ZR_GLTF_NO_ATTRIBUTES                                                                                          \
    {                                                                                                                  \
        ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE, {ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE,             \
                                                   ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE},            \
            ZR_GLTF_NONE, {ZR_GLTF_NONE, ZR_GLTF_NONE},                                                                \
        {                                                                                                              \
            ZR_GLTF_NONE, ZR_GLTF_NONE                                                                                 \
        }                                                                                                              \
    }

struct zr_gltf_primitive {
    struct zr_gltf_attributes attributes;
    uint32_t indices, material, mode;
    const char *targets;               /* JSON text, or NULL */
    const struct zr_draco_mesh *draco; /* has the faces, instead of `indices`; or NULL */
};

/* A primitive while its mesh is made. */
struct zr_gltf_making {
    const struct zr_json_path *path, *attributes; /* of the primitive; of its attributes */
    const struct zr_gltf_primitive *given;
    struct zr_gltf_range range; /* vertices that the primitive uses */
    uint32_t vertices;          /* elements of its attribute POSITION */
    uint32_t *corners;          /* indices relative to range.first; NULL: consecutive vertices */
    uint32_t corner_count;
    uint32_t number; /* of the mesh in the scene */
    struct zr_mesh *mesh;
};

/* An attribute of vertices, joints or instances. */
struct zr_gltf_attribute {
    const struct zr_json_path *path; /* of the object with the attributes */
    const char *name;
    uint32_t accessor;
    int shape;      /* enum zr_gltf_shape */
    uint32_t least; /* number of elements that are needed */
};

/* ---- gltf_attribute.c ---- */

/* Reads a list of attributes. Skips others, such as TEXCOORD_2 or _TEMPERATURE, without a warning. */
void zr_gltf_read_attributes(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                             struct zr_gltf_attributes *out);

/* Returns the name of an attribute, and its offset in struct zr_gltf_attributes; NULL after the last one. */
const char *zr_gltf_attribute_of(uint32_t number, size_t *offset);

/* Opens an attribute. */
bool zr_gltf_open_attribute(struct zr_gltf *file, const struct zr_gltf_attribute *attribute,
                            struct zr_gltf_values *out);

/* Reads a range of an attribute of 3 or 4 finite floats, without gaps, to new memory. NULL after a fault. */
float *zr_gltf_read_vectors(struct zr_gltf *file, const struct zr_gltf_attribute *attribute,
                            const struct zr_gltf_range *range);

/* ---- gltf_morph.c, gltf_skin.c: both change the positions, normals and tangents of a mesh ---- */

/* Adds the primitive's targets, times the weights of the node or the mesh. */
bool zr_gltf_morph(struct zr_gltf *file, const struct zr_gltf_making *making);

/* Checks the moved vertices. `by`: the cause, such as "a skin". `path` leads to the primitive. */
bool zr_gltf_check_moved(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_mesh *mesh,
                         const char *by);

/* Moves vertices to world space by the joints of the entry of file->uses that is read now. */
bool zr_gltf_bend(struct zr_gltf *file, const struct zr_gltf_making *making);

/* ---- gltf_primitive.c; gltf_topology.c ---- */

/* Fills a mesh whose name is set. False if the primitive is empty, or after a fault. */
bool zr_gltf_make_primitive(struct zr_gltf *file, const struct zr_json_path *path,
                            const struct zr_gltf_primitive *given, struct zr_mesh *mesh, uint32_t number);

/* Makes faces, lines or points of the corners. False if memory is lacking, or if there are too few corners, which a
 * warning counts. */
bool zr_gltf_make_topology(struct zr_gltf *file, const struct zr_gltf_making *making);

/* Leaves out the faces, lines and points at positions whose x is NaN, and sets these to a finite position. False if
 * memory is lacking, or if nothing is left, which a warning counts. */
bool zr_gltf_drop_holes(struct zr_gltf *file, const struct zr_gltf_making *making, zr_vec4 *positions);

/* ---- gltf_draco.c: KHR_draco_mesh_compression ---- */

/* Decodes the mesh of a primitive with the extension, once per view. Sets given->draco, and `decoded` of the accessors
 * of its attributes until zr_gltf_close_draco. False after a fault. `path` leads to `extensions`, their JSON text. */
bool zr_gltf_open_draco(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                        struct zr_gltf_primitive *given);
void zr_gltf_close_draco(struct zr_gltf *file, const struct zr_gltf_primitive *given);

/* ---- gltf_image_ahead.c ---- */

/* Decodes the images of all drawn materials by several threads, before the first material is read. */
void zr_gltf_read_images_ahead(struct zr_gltf *file);

#endif
