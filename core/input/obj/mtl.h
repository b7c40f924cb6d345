/* mtl.h - input: materials of Wavefront MTL files, converted to materials of a scene.
 *
 *     mtl = zr_mtl_open(builder, request, limits, error)
 *     zr_mtl_add(mtl, name, length) for each file that mtllib names; then mtl->has_maps
 *     zr_mtl_use(mtl, name, length) for each usemtl: the number of the material in mtl->made
 *     zr_mtl_make_used(mtl): the values and images of these materials
 *     zr_mtl_close: the warnings
 *
 * Source: Wavefront, "MTL material format" 4.2 (1995); Clara.io, "Extending Wavefront MTL for physically-based
 *         rendering" (2013), for Pr, Pm, map_Pr, map_Pm, map_Ke and norm.
 * Values: Kd and Ke are sRGB-encoded, as in three.js. Values are clamped to 0..1; Ke may be larger.
 * Base:   Kd; its alpha is d, or 1 - Tr if d is not given. An alpha of 0 is taken as 1, as in obj2gltf, since some
 *         programs write Tr 1 or d 0 for opaque. An alpha below 1 or a map_d means BLEND. map_Kd multiplies Kd, as in
 *         the format and three.js. A Kd of 0, 0, 0 beside a map_Kd would draw black: it is taken as 1, as in Blender
 *         and obj2gltf. map_d is the alpha channel of its image if that is not 1 everywhere, else the red one.
 * Rough:  Pr, else the formula of obj2gltf: 1 - Ns / 1000, times 1 - s if the luminance s = 0.2125 r + 0.7154 g +
 *         0.0721 b of Ks is below 0.1. Without Pr and Ns, the look's roughness.
 * Metal:  Pm, else 0 if Ns or Ks is given, else the look's metalness. Ks has no other effect.
 * Normal: norm, else map_Bump or bump, if the image has colours: recent programs write normal maps there. -bm is its
 *         factor. A grey image holds heights, which are not drawn.
 * Lazy:   zr_mtl_add only indexes lines. Only used materials and their images are read.
 * Thread: one struct zr_mtl belongs to one thread.
 */
#ifndef ZR_MTL_H
#define ZR_MTL_H

#include "input/images/image_list.h"
#include "input/model/model_scene.h"
#include "input/text/text.h"

/* Maps of a material. */
enum zr_mtl_map {
    ZR_MTL_MAP_COLOR,
    ZR_MTL_MAP_ALPHA,
    ZR_MTL_MAP_ROUGHNESS,
    ZR_MTL_MAP_METALLIC,
    ZR_MTL_MAP_EMISSION,
    ZR_MTL_MAP_NORMAL,
    ZR_MTL_MAP_BUMP,
    ZR_MTL_MAPS
};

/* Kinds of faults and of properties that are not drawn. Each causes one warning (mtl_notes.c). */
enum zr_mtl_note {
    ZR_MTL_NOTE_UNKNOWN,
    ZR_MTL_NOTE_LEFT_OUT,
    ZR_MTL_NOTE_STRAY,
    ZR_MTL_NOTE_TWICE,
    ZR_MTL_NOTE_BAD_VALUE,
    ZR_MTL_NOTE_CLAMPED,
    ZR_MTL_NOTE_DISAGREE,
    ZR_MTL_NOTE_UNSEEN,
    ZR_MTL_NOTE_BLACK,
    ZR_MTL_NOTE_OPTION,
    ZR_MTL_NOTE_MISSING,
    ZR_MTL_NOTE_BAD_IMAGE,
    ZR_MTL_NOTE_HEIGHTS,
    ZR_MTL_NOTE_ALPHA_PLACE,
    ZR_MTL_NOTE_OPAQUE,
    ZR_MTL_NOTES
};

/* A line without blanks at its ends, or a part of it. */
struct zr_mtl_text {
    const char *at, *end;
    size_t line; /* number from 1 */
};

struct zr_mtl_noted {
    size_t count;
    struct zr_mtl_text first;
    struct zr_reason reason; /* set by BAD_IMAGE and STRAY */
};

/* A material of a file: its name, and the lines below it. */
struct zr_mtl_entry {
    struct zr_mtl_text name, lines;
    uint32_t number; /* in mtl->made, or ZR_FILE_MATERIAL_NONE: not used yet */
    uint32_t order;  /* position in the files */
};

/* A map as written, with its options. */
struct zr_mtl_given_map {
    bool is_given, is_clamped;
    struct zr_mtl_text whole, name; /* the statement; the file */
    float offset[2], scale[2], strength;
};

/* Properties of a material as written. */
struct zr_mtl_values {
    bool has_diffuse, has_specular, has_emission, has_alpha, has_transparency, has_shininess, has_roughness,
        has_metallic;
    float diffuse[3], specular[3], emission[3], alpha, transparency, shininess, roughness, metallic;
    struct zr_mtl_text alpha_line;
    struct zr_mtl_given_map maps[ZR_MTL_MAPS];
};

/* A channel of an image, or white. */
struct zr_mtl_channel {
    uint32_t image; /* 1 + its number in the scene; 0: white */
    uint32_t channel;
};

/* An image that is made of channels of other images. */
struct zr_mtl_made_image {
    struct zr_mtl_channel channels[4];
    uint32_t number;
};

struct zr_mtl {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_scene_builder *builder;
    struct zr_parsed_assets assets;
    struct zr_image_list decoded; /* images of maps */
    struct zr_file_scene *made;
    struct zr_mtl_entry *entries; /* sorted by name at the first search */
    uint32_t count, room, material_room, file_count, sought_count;
    bool is_sorted, has_maps;
    enum zr_status status; /* other than OK: reading stopped */
    struct zr_error *error;
    struct zr_mtl_made_image *images;
    uint32_t image_count, image_room;
    struct zr_mtl_noted notes[ZR_MTL_NOTES];
};

/* Makes a reader without files; zr_mtl_add finds them among the request's assets.
 * Allocates from the builder's arena. Returns NULL without memory. */
struct zr_mtl *zr_mtl_open(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error);

/* mtl_index.c: indexes the file of this name.
 * False if the request has none, after a failure (mtl->status), or beyond ZR_MTL_SOUGHT_MAX names. */
enum { ZR_MTL_SOUGHT_MAX = 4096 };
bool zr_mtl_add(struct zr_mtl *mtl, const char *name, size_t length);

/* Indexes the only asset whose name ends in .mtl, for files that were renamed. Returns its name, or NULL. */
const char *zr_mtl_add_only(struct zr_mtl *mtl);

/* Returns the number of a material in mtl->made, or ZR_FILE_MATERIAL_NONE. zr_mtl_make_used sets its values. */
uint32_t zr_mtl_use(struct zr_mtl *mtl, const char *name, size_t length);

/* mtl_used.c: reads the used materials, in the order of their first uses. Decodes their images by several threads.
 * Failures are in mtl->status. */
void zr_mtl_make_used(struct zr_mtl *mtl);

/* Warns of properties that are not drawn, and of unused assets. */
void zr_mtl_close(struct zr_mtl *mtl);

/* ---- private to mtl*.c ---- */

/* mtl_text.c. Lines end at line feeds and carriage returns. zr_mtl_next returns false at the end, skips empty lines and
 * comments, and counts lines; `rest` is the rest of the text. */
bool zr_mtl_next(struct zr_mtl_text *rest, struct zr_mtl_text *line);
struct zr_mtl_text zr_mtl_word(struct zr_mtl_text *line);

/* Compares without regard to ASCII case; `word` is in lower case. */
bool zr_mtl_is_word(const struct zr_mtl_text *text, const char *word);

/* mtl_values.c: reads the lines of a material. */
void zr_mtl_read_values(struct zr_mtl *mtl, const struct zr_mtl_entry *entry, struct zr_mtl_values *out);

/* mtl_map.c: finds a file among the assets, or NULL; reads the options and the name of a map. */
const struct zr_asset *zr_mtl_find_file(struct zr_mtl *mtl, const struct zr_mtl_text *given);
void zr_mtl_read_map(struct zr_mtl *mtl, const struct zr_mtl_text *whole, struct zr_mtl_text line,
                     struct zr_mtl_given_map *out);

/* mtl_material.c: converts a material. */
void zr_mtl_convert(struct zr_mtl *mtl, const struct zr_mtl_values *given, struct zr_parsed_material *out);

/* mtl_image.c. zr_mtl_find_image: decodes the image of a map once. False if it cannot be drawn, which a warning counts.
 * zr_mtl_make_image: makes an image of four channels, with the size of the largest image. Equal channels share one
 * image. zr_mtl_is_grey: true if no texel has a colour. */
bool zr_mtl_find_image(struct zr_mtl *mtl, const struct zr_mtl_given_map *map, uint32_t *number);
bool zr_mtl_make_image(struct zr_mtl *mtl, const struct zr_mtl_text *whole, const struct zr_mtl_channel channels[4],
                       uint32_t *number);
bool zr_mtl_is_grey(const struct zr_mtl *mtl, uint32_t image);

/* mtl_notes.c */
void zr_mtl_note(struct zr_mtl *mtl, enum zr_mtl_note note, const struct zr_mtl_text *first);
void zr_mtl_warn(struct zr_mtl *mtl);

#endif
