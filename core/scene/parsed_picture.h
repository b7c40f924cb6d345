/* parsed_picture.h - scene: picture keys that a scene or a query gives. They override the look. */
#ifndef ZR_PARSED_PICTURE_H
#define ZR_PARSED_PICTURE_H

#include "scene/looks.h"
#include "scene/picture.h"
#include "scene/picture_keys.h"
#include "scene/scene_builder.h"

enum zr_picture_key {
#define ZR_PICTURE_ENUM(ID, ...) ZR_PICTURE_##ID,
    ZR_PICTURE_KEYS(ZR_PICTURE_ENUM)
#undef ZR_PICTURE_ENUM
        ZR_PICTURE_KEY_COUNT
};

struct zr_parsed_picture {
    uint64_t keys;            /* set of given keys: bits 1 << enum zr_picture_key */
    struct zr_picture given;  /* their values; the others are undefined */
    struct zr_picture merged; /* with the look, once the root is read: the scene's picture */
};

static inline void zr_picture_give(struct zr_parsed_picture *given, enum zr_picture_key key)
{
    given->keys |= UINT64_C(1) << key;
}

static inline bool zr_picture_gives(const struct zr_parsed_picture *given, enum zr_picture_key key)
{
    return given->keys >> key & 1u;
}

/* Marks the key of this object as given; ignores keys without a row. */
void zr_picture_give_key(struct zr_parsed_picture *given, const char *object, const char *key);

/* Returns the given values over the look's; is_linear is the look's. If an environment is given without a frame, the
 * frame is its own: world for outdoor, else camera. Edges that are given a source but no width get its usual width. A
 * given crease angle of edges overrides normals of files. */
struct zr_picture zr_picture_merge(const struct zr_parsed_picture *given, const struct zr_look *look);

/* Returns the first given key that needs linear light; for a key inside an object, the object's key, such as `edges`.
 * NULL: none. `merged`: result of zr_picture_merge. An effect that is off needs none. */
const char *zr_picture_linear_key(const struct zr_parsed_picture *given, const struct zr_picture *merged);

/* Returns the side of the sample grid that fits in a window: `side`, halved until side times the larger window side is
 * at most ZR_WINDOW_SAMPLES_MAX, or 1. */
uint32_t zr_picture_side_in(uint32_t side, uint32_t width, uint32_t height);

/* Adds a warning that the look's samples, side x side per pixel, are reduced to fits x fits. */
void zr_warn_of_fewer_samples(struct zr_scene_builder *builder, uint32_t side, uint32_t fits);

#endif
