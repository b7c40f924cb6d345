/* parsed_picture.h - scene: the keys of the picture that a scene or a query gives. They override the look. */
#ifndef ZR_PARSED_PICTURE_H
#define ZR_PARSED_PICTURE_H

#include "scene/looks.h"
#include "scene/picture_keys.h"
#include "scene/scene_builder.h"

enum zr_picture_key {
#define ZR_PICTURE_ENUM(ID, ...) ZR_PICTURE_##ID,
    ZR_PICTURE_KEYS(ZR_PICTURE_ENUM)
#undef ZR_PICTURE_ENUM
        ZR_PICTURE_KEY_COUNT
};

struct zr_parsed_picture {
    uint64_t keys; /* those that are given: 1 << enum zr_picture_key */
    struct zr_picture picture;
};

static inline void zr_picture_give(struct zr_parsed_picture *given, enum zr_picture_key key)
{
    given->keys |= UINT64_C(1) << key;
}

static inline bool zr_picture_gives(const struct zr_parsed_picture *given, enum zr_picture_key key)
{
    return given->keys >> key & 1u;
}

/* Notes that the key of this object is given; ignores keys that have no row. */
void zr_picture_give_key(struct zr_parsed_picture *given, const char *object, const char *key);

/* What is said, and the rest from the look, is_linear included. An environment that is named has its own frame where
 * none is said. */
struct zr_picture zr_picture_merge(const struct zr_parsed_picture *given, const struct zr_look *look);

/* The key of the contract that needs linear light, of those that are said; NULL: none does. `merged`: what came of it.
 * What is switched off needs nothing. */
const char *zr_picture_linear_key(const struct zr_parsed_picture *given, const struct zr_picture *merged);

/* The most samples a pixel, up to `side` squared, that a window of these sides can have: their side. */
uint32_t zr_picture_side_in(uint32_t side, uint32_t width, uint32_t height);

/* Where nobody said how many, a look's samples are as many as the window can have. */
void zr_warn_of_fewer_samples(struct zr_scene_builder *builder, uint32_t side, uint32_t fits);

#endif
