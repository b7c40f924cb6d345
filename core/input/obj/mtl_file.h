/* mtl_file.h - input: shared by the files of the MTL reader, private to them. */
#ifndef ZR_MTL_FILE_H
#define ZR_MTL_FILE_H

#include "input/images/image_list.h"
#include "input/obj/mtl.h"

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
    ZR_MTL_NOTE_BLACK_ALONE,
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
    uint32_t number; /* in mtl->made, or ZR_MODEL_MATERIAL_NONE: not used yet */
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
    struct zr_model_scene *made;
    struct zr_mtl_entry *entries; /* sorted by name at the first search */
    uint32_t count, room, material_room, file_count, sought_count;
    bool is_sorted, has_maps;
    enum zr_status status; /* other than OK: reading stopped */
    struct zr_error *error;
    struct zr_mtl_made_image *images;
    uint32_t image_count, image_room;
    struct zr_mtl_noted notes[ZR_MTL_NOTES];
};

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
