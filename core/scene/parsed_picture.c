#include "scene/parsed_picture.h"

#include <string.h>

_Static_assert(ZR_PICTURE_KEY_COUNT <= 64, "a bit each");

static const struct {
    const char *object, *key;
} keys[ZR_PICTURE_KEY_COUNT] = {
#define KEY(ID, object, key, member, is_linear) {object, key},
    ZR_PICTURE_KEYS(KEY)
#undef KEY
};

void zr_picture_give_key(struct zr_parsed_picture *given, const char *object, const char *key)
{
    for (int i = 0; i < ZR_PICTURE_KEY_COUNT; i++)
        if (strcmp(keys[i].object, object) == 0 && strcmp(keys[i].key, key) == 0)
            zr_picture_give(given, (enum zr_picture_key)i);
}

struct zr_picture zr_picture_merge(const struct zr_parsed_picture *given, const struct zr_look *look)
{
    struct zr_picture merged = *look->picture;
#define TAKE(ID, object, key, member, is_linear)                                                                       \
    if (zr_picture_gives(given, ZR_PICTURE_##ID)) merged.member = given->given.member;
    ZR_PICTURE_KEYS(TAKE)
#undef TAKE
    if (zr_picture_gives(given, ZR_PICTURE_ENVIRONMENT) && merged.environment.name != ZR_ENVIRONMENT_NONE &&
        !zr_picture_gives(given, ZR_PICTURE_ENVIRONMENT_FRAME))
        merged.environment.camera_frame = !merged.environment.map && merged.environment.name != ZR_ENVIRONMENT_OUTDOOR;
    if (zr_picture_gives(given, ZR_PICTURE_EDGES_WIDTH)) merged.edges.keeps_width = true;
    if (zr_picture_gives(given, ZR_PICTURE_EDGES_FROM) && !zr_picture_gives(given, ZR_PICTURE_EDGES_WIDTH))
        merged.edges.width = merged.edges.is_from_mesh ? 0.0f : 1.5f;
    if (zr_picture_gives(given, ZR_PICTURE_EDGES_CREASE)) merged.edges.ignores_normals = true;
    return merged;
}

const char *zr_picture_linear_key(const struct zr_parsed_picture *given, const struct zr_picture *merged)
{
    const struct zr_picture *p = merged;
    const bool needs[ZR_PICTURE_KEY_COUNT] = {
#define NEEDS(ID, object, key, member, is_linear) (is_linear),
        ZR_PICTURE_KEYS(NEEDS)
#undef NEEDS
    };
    for (int i = 0; i < ZR_PICTURE_KEY_COUNT; i++)
        if (needs[i] && zr_picture_gives(given, (enum zr_picture_key)i))
            return *keys[i].object ? keys[i].object : keys[i].key;
    return NULL;
}

uint32_t zr_picture_side_in(uint32_t side, uint32_t width, uint32_t height)
{
    const uint32_t larger = width > height ? width : height;
    while (side > 1 && (uint64_t)side * larger > ZR_WINDOW_SAMPLES_MAX)
        side /= 2;
    return side;
}

void zr_warn_of_fewer_samples(struct zr_scene_builder *builder, uint32_t side, uint32_t fits)
{
    zr_warning_list_add(builder->arena, &builder->color_warnings,
                        "samples: %u a pixel instead of the look's %u, which are more than this window can have",
                        fits * fits, side * side);
}
