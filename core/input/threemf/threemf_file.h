/* threemf_file.h - input: shared by the files of the 3MF reader, private to them.
 *
 * Order:  each model part is read whole: the root, then the parts that it names by paths (production extension).
 *         Build items and components then become nodes, which place the meshes (scene/parts/nodes.h).
 * Units:  positions keep the root part's unit.
 * Source: 3MF Core Specification 1.3, Materials and Properties 1.2.1, Production 1.1.2.
 */
#ifndef ZR_THREEMF_FILE_H
#define ZR_THREEMF_FILE_H

#include "input/model/model_scene.h"
#include "input/model/recenter_scene.h"
#include "input/text/xml.h"
#include "input/zip/zip_read.h"

#define ZR_THREEMF_NONE UINT32_MAX

/* Bounds the cost of insertion: a new id may move all larger ones in the sorted order. */
enum { ZR_THREEMF_RESOURCES_MAX = 1 << 16 };

enum { ZR_THREEMF_FILAMENTS_MAX = 64 };

/* ROW(ID, URI, true if it is read or adds no geometry or colour, its contents in words) */
#define ZR_THREEMF_SPACES(ROW)                                                                                         \
    ROW(CORE, "http://schemas.microsoft.com/3dmanufacturing/core/2015/02", true, "core")                               \
    ROW(CORE_OLD, "http://schemas.microsoft.com/3dmanufacturing/2013/01", true, "core")                                \
    ROW(MATERIAL, "http://schemas.microsoft.com/3dmanufacturing/material/2015/02", true, "materials")                  \
    ROW(PRODUCTION, "http://schemas.microsoft.com/3dmanufacturing/production/2015/06", true, "production")             \
    ROW(SETS, "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07", true, "sets of triangles")          \
    ROW(SLICE, "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07", false, "slices")                          \
    ROW(BEAMS, "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02", false, "beam lattices")             \
    ROW(BALLS, "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07", false,                        \
        "balls of beam lattices")                                                                                      \
    ROW(VOLUMETRIC, "http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01", false, "volumetric data")              \
    ROW(IMPLICIT, "http://schemas.3mf.io/3dmanufacturing/implicit/2023/12", false, "implicit functions")               \
    ROW(BOOLEAN, "http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07", false, "boolean operations")       \
    ROW(DISPLACEMENT, "http://schemas.microsoft.com/3dmanufacturing/displacement/2022/07", false, "displacement")      \
    ROW(SECURE, "http://schemas.microsoft.com/3dmanufacturing/securecontent/2019/04", false, "secure content")         \
    ROW(SECURE_NEW, "http://schemas.microsoft.com/3dmanufacturing/securecontent/2019/07", false, "secure content")

enum zr_threemf_space {
#define ZR_THREEMF_SPACE(ID, ...) ZR_THREEMF_SPACE_##ID,
    ZR_THREEMF_SPACES(ZR_THREEMF_SPACE)
#undef ZR_THREEMF_SPACE
        ZR_THREEMF_SPACE_COUNT
};

/* Input that is ignored or drawn differently; one warning per kind. */
enum zr_threemf_note {
    ZR_THREEMF_NOTE_SPACES, /* one per namespace */
    ZR_THREEMF_NOTE_UNKNOWN = ZR_THREEMF_NOTE_SPACES + ZR_THREEMF_SPACE_COUNT,
    ZR_THREEMF_NOTE_REQUIRED,
    ZR_THREEMF_NOTE_WORDS, /* the warnings before it quote a word */
    ZR_THREEMF_NOTE_IMAGE = ZR_THREEMF_NOTE_WORDS,
    ZR_THREEMF_NOTE_TILES,
    ZR_THREEMF_NOTE_LAYERS,
    ZR_THREEMF_NOTE_NO_LAYER,
    ZR_THREEMF_NOTE_OVER,
    ZR_THREEMF_NOTE_PLAIN,
    ZR_THREEMF_NOTE_CLEAR,
    ZR_THREEMF_NOTE_PAINT,
    ZR_THREEMF_NOTE_EXTRUDER,
    ZR_THREEMF_NOTE_PAINTED,
    ZR_THREEMF_NOTE_OTHER,
    ZR_THREEMF_NOTE_MODIFIER,
    ZR_THREEMF_NOTE_NOT_PRINTED,
    ZR_THREEMF_NOTE_UNIT,
    ZR_THREEMF_NOTE_HOLE,
    ZR_THREEMF_NOTE_COUNT
};

enum zr_threemf_kind {
    ZR_THREEMF_OBJECT,
    ZR_THREEMF_COLORS, /* base materials, composite materials or a colour group */
    ZR_THREEMF_COORDS, /* coordinates in a texture: a texture2dgroup */
    ZR_THREEMF_MULTI,  /* multiproperties */
    ZR_THREEMF_TEXTURE /* an image: a texture2d */
};

/* Returns a colour 0xAABBGGRR. */
static inline zr_vec4 zr_threemf_color_of(uint32_t rgba)
{
    return (zr_vec4){(float)(rgba & 255) / 255.0f, (float)(rgba >> 8 & 255) / 255.0f,
                     (float)(rgba >> 16 & 255) / 255.0f, (float)(rgba >> 24) / 255.0f};
}

/* A property of a corner: a colour, 0xAABBGGRR, times a texture. */
struct zr_threemf_value {
    uint32_t color;
    uint32_t texture; /* number of the resource, or ZR_THREEMF_NONE */
    float u, v;
};

/* A resource of a part. */
struct zr_threemf_resource {
    uint32_t part, id;
    enum zr_threemf_kind kind;
    const char *at; /* place in its part */

    /* Colours: 0xAABBGGRR. */
    uint32_t color_count;
    const uint32_t *colors;
    bool is_base; /* one colour per triangle */

    /* A texture2dgroup, or multiproperties. */
    uint32_t value_count;
    const struct zr_threemf_value *values;
    bool is_outside; /* a coordinate is outside of 0 to 1 */

    /* A texture2d. */
    const struct zr_zip_member *image; /* NULL: the archive lacks it */
    const char *unpacked;              /* bytes of the image, once they are read */
    bool is_listed;                    /* among the images that are decoded ahead */
    int wrap_s, wrap_t, filter;        /* indices of the words of threemf_texture.c */
    bool ends;                         /* its tilestyle is none */
    bool is_over;                      /* it lies over a colour of multiproperties */
    uint32_t material;                 /* number in the file scene, or ZR_THREEMF_NONE */
    bool has_material;                 /* the material is made, or cannot be made */

    /* An object: a mesh, or components. */
    const char *name;
    bool is_left_out;  /* its type is `other` */
    uint32_t mesh;     /* or ZR_THREEMF_NONE */
    uint32_t extruder; /* or 0 */
    uint32_t first_link, link_count;
    uint32_t first_node; /* node of its first link; ZR_THREEMF_NONE: not added yet */
};

/* A slicer's setting of an object, of a part of it, or of a range of its triangles. */
struct zr_threemf_setting {
    uint32_t object, part; /* ids; part: ZR_THREEMF_NONE for the object or its triangles */
    uint32_t first, last;  /* triangles; first > last: all */
    uint32_t extruder;     /* from 1 on; 0: not given */
    bool is_left_out;      /* a modifier, or support */
};

/* A component or a build item. */
struct zr_threemf_link {
    uint32_t extruder; /* or 0 */
    bool is_left_out;
    uint32_t part, target_part, id;
    const char *at;
    zr_mat4 transform;
    double offset[3]; /* its translation */
};

/* A model part. */
struct zr_threemf_part {
    const struct zr_zip_member *member;
    const char *bytes; /* NULL: not read yet */
    size_t size;
    const char *unit;       /* name in the channel info */
    double microns;         /* length of the unit in micrometres; 0: not read */
    const char *counted_to; /* byte whose line is `line` */
    size_t line;
};

/* An array that grows in the arena. */
struct zr_threemf_list {
    uint32_t count, room;
    void *items;
};

struct zr_threemf {
    struct zr_arena *arena;
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    struct zr_error *error;
    struct zr_zip zip;
    bool is_unnamed;              /* no relationship leads to the root part, the only model of the archive */
    uint32_t *part_of_member;     /* or ZR_THREEMF_NONE */
    struct zr_xml_text last_path; /* path found last; its part is last_part */
    uint32_t last_part;
    struct zr_threemf_list parts;     /* struct zr_threemf_part */
    struct zr_threemf_list resources; /* struct zr_threemf_resource */
    struct zr_threemf_list links;     /* struct zr_threemf_link: those of one object follow each other */
    struct zr_threemf_list items;     /* struct zr_threemf_link: the build items */
    struct zr_threemf_list meshes;    /* struct zr_mesh */
    struct zr_threemf_list textures;  /* uint32_t *: one per mesh: the texture of each face, or NULL */
    struct zr_threemf_list moves;     /* const struct zr_recenter_move *: one per mesh, or NULL */
    struct zr_threemf_list settings;  /* struct zr_threemf_setting, sorted */
    uint32_t filament_count, filaments[ZR_THREEMF_FILAMENTS_MAX]; /* 0xAABBGGRR */
    struct zr_threemf_list extruders; /* uint8_t *: one per mesh: the extruder of each face, or NULL */
    struct zr_threemf_list order;     /* uint32_t: numbers of resources, sorted by part and id */
    struct {
        uint64_t count;
        uint32_t part;
        size_t line;
        struct zr_xml_text word;
    } notes[ZR_THREEMF_NOTE_COUNT];

    /* State of the current part. */
    uint32_t part;
    struct zr_xml xml;
    struct zr_xml_tag tag;
    bool is_stopped; /* after a syntax fault or a cancel */
};

/* A slicer's paint on a triangle. */
struct zr_threemf_paint {
    const char *at;
    uint32_t length;
    uint8_t extruder; /* extruder of unpainted areas; 0: the part's extruder */
    bool is_left_out;
};

/* Properties of the triangles of a mesh. */
struct zr_threemf_corners {
    struct zr_threemf *file;
    const struct zr_threemf_setting *volumes; /* settings of ranges of triangles, ascending */
    uint32_t volume_count, volume;            /* `volume`: index of the setting at or before the last triangle */
    uint32_t dropped;                         /* triangles of the file that were left out so far */
    struct zr_threemf_paint *paints;          /* NULL: no triangle so far has paint or a volume */
    uint32_t room;                            /* capacity in triangles */
    uint32_t *colors;                         /* 0xAABBGGRR, one per corner; NULL: no triangle has one so far */
    uint32_t *textures; /* one per triangle, or ZR_THREEMF_NONE; NULL: no triangle has one so far */
    float (*coords)[2]; /* one per corner, if there are textures */
    uint32_t given;     /* triangles with a property */
    bool has_gradients;
    bool has_solid[2], has_clear[2]; /* of base materials, of others: a corner has alpha above 0; alpha 0 */
    uint32_t last_pid;
    const struct zr_threemf_resource *last;
};

/* Appends an uninitialised item. NULL without memory. */
void *zr_threemf_list_add(struct zr_arena *arena, struct zr_threemf_list *list, size_t size);

static inline struct zr_threemf_part *zr_threemf_parts(const struct zr_threemf *file)
{
    return file->parts.items;
}
static inline struct zr_threemf_resource *zr_threemf_resources(const struct zr_threemf *file)
{
    return file->resources.items;
}

/* Adds a fault at a place of a part: "3D/3dmodel.model, line 7: ...". Returns false. */
bool zr_threemf_fault_in(struct zr_threemf *file, uint32_t part, const char *at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define zr_threemf_fault(file, at, ...) zr_threemf_fault_in(file, (file)->part, at, __VA_ARGS__)

/* Counts an occurrence for a warning, at a place of the current part. */
void zr_threemf_note(struct zr_threemf *file, int note, const char *at, struct zr_xml_text word);

/* True if reading must stop: after a syntax fault, a cancel or a full list of faults, or without memory. */
bool zr_threemf_stops(const struct zr_threemf *file);

/* threemf_package.c: opens the archive, and adds the root part that the relationships name. */
bool zr_threemf_find_root(struct zr_threemf *file);

/* Returns the member at a path from the package's root, or NULL. */
const struct zr_zip_member *zr_threemf_find_member(const struct zr_threemf *file, struct zr_xml_text path);

/* Returns the number of the part at a path such as "/3D/a.model", adding it if it is new; ZR_THREEMF_NONE after a fault. */
uint32_t zr_threemf_find_part(struct zr_threemf *file, const char *at, struct zr_xml_text path);

/* threemf_element.c: advances to the next child of the element whose begin set xml.depth to `depth`. Returns true and sets
 * file->tag; false at that element's end, or if reading stops. Skips unread descendants. */
bool zr_threemf_child(struct zr_threemf *file, size_t depth);

/* True for a namespace of the core specification, and for no namespace. */
static inline bool zr_threemf_is_core(int space)
{
    return space == ZR_THREEMF_SPACE_CORE || space == ZR_THREEMF_SPACE_CORE_OLD || space == ZR_XML_NO_NAMESPACE;
}

/* True if the current element has this name in the namespace. CORE includes no namespace. */
bool zr_threemf_is(const struct zr_threemf *file, enum zr_threemf_space space, const char *name);

/* threemf_part.c: reads a part whole. */
void zr_threemf_read_part(struct zr_threemf *file, uint32_t part);

/* threemf_values.c: read attributes of the current element; false after a fault. A missing attribute leaves *out unchanged,
 * or is a fault if it is needed. */
bool zr_threemf_count(struct zr_threemf *file, const char *name, bool is_needed, uint32_t *out);
bool zr_threemf_transform(struct zr_threemf *file, zr_mat4 *out, double offset[3]);
bool zr_threemf_color(struct zr_threemf *file, const char *name, uint32_t *out);
bool zr_threemf_digits(struct zr_xml_text text, uint32_t *out);
bool zr_threemf_number(const struct zr_xml *xml, struct zr_xml_text text, double *out);

/* threemf_resource.c: adds a resource of the current part, or reports a duplicate id; finds one. NULL if there is none. */
struct zr_threemf_resource *zr_threemf_add(struct zr_threemf *file, enum zr_threemf_kind kind);
struct zr_threemf_resource *zr_threemf_find(const struct zr_threemf *file, uint32_t part, uint32_t id);

/* Reads the current element as a group of colours: children with this name and colour attribute. */
void zr_threemf_read_colors(struct zr_threemf *file, enum zr_threemf_space space, const char *child,
                            const char *attribute);

/* threemf_texture.c: read the current element: a texture2d, a texture2dgroup, composite materials or multiproperties. */
void zr_threemf_read_texture(struct zr_threemf *file);
void zr_threemf_read_coords(struct zr_threemf *file);
void zr_threemf_read_composites(struct zr_threemf *file);
void zr_threemf_read_multi(struct zr_threemf *file);

/* threemf_corners.c: sets the properties of triangle `triangle`, for which there is room.
 * `p`: indices into the group `pid`, or ZR_THREEMF_NONE. */
void zr_threemf_corners_set(struct zr_threemf_corners *corners, uint32_t triangle, uint32_t pid, const uint32_t p[3]);
void zr_threemf_corners_paint(struct zr_threemf_corners *corners, uint32_t triangle, struct zr_xml_text paint);
void zr_threemf_corners_grow(struct zr_threemf_corners *corners, uint32_t count, uint32_t room);

/* Gives a mesh its colours and texture coordinates, and adds its entry of file->textures. False without memory. */
bool zr_threemf_corners_finish(struct zr_threemf_corners *corners, struct zr_mesh *mesh);

/* threemf_slicer.c: reads the settings of slicers.
 * Finds the settings of an object and its triangles, ascending, or of a part. */
void zr_threemf_read_slicer(struct zr_threemf *file);
const struct zr_threemf_setting *zr_threemf_find_settings(const struct zr_threemf *file, uint32_t object, uint32_t part,
                                                          uint32_t *count);

/* threemf_paint.c: cuts a triangle into pieces by its paint, and returns their number, or 0 if the text is invalid.
 * `positions`: three per piece. `extruders`: one per piece; 0: the part's extruder. Both may be NULL. */
uint32_t zr_threemf_paint_read(struct zr_xml_text text, const zr_vec4 corners[3], zr_vec4 *positions,
                               uint8_t *extruders);

/* threemf_painted.c: replaces a mesh by its painted pieces, and adds its entry of file->extruders. False without memory. */
bool zr_threemf_paint_mesh(struct zr_threemf_corners *corners, struct zr_mesh *mesh);

/* Colours the faces of a mesh by their extruders, if the mesh has no colours. */
void zr_threemf_color_by_extruders(struct zr_threemf *file, struct zr_mesh *mesh, const uint8_t *extruders,
                                   const struct zr_threemf_resource *object);

/* threemf_material.c: makes the materials of `count` meshes. textures[i]: the texture of each face of mesh i, or NULL.
 * Materials replace the textures in this list. Without textures, leaves the scene without materials. */
bool zr_threemf_make_materials(struct zr_threemf *file, struct zr_scene_builder *builder,
                               const struct zr_request *request, struct zr_model_scene *scene, uint32_t count,
                               uint32_t **textures);

/* threemf_mesh.c: reads the mesh of an object, and its entry of `moves`; `object`: its id. `pid`, `pindex`: its default
 * property, or ZR_THREEMF_NONE. Returns the mesh's number, or ZR_THREEMF_NONE after a fault. */
uint32_t zr_threemf_read_mesh(struct zr_threemf *file, uint32_t object, uint32_t pid, uint32_t pindex);

/* threemf_build.c: places the meshes that the build uses, in builder->file. */
enum zr_status zr_threemf_place(struct zr_threemf *file, struct zr_scene_builder *builder,
                                const struct zr_request *request);

#endif
