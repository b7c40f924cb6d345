#include "scene/parsed_picture.h"

#define TAKE(key, member)                                                                                              \
    if (zr_picture_gives(given, ZR_PICTURE_##key)) merged.member = given->picture.member

static struct zr_environment merge_environment(const struct zr_parsed_picture *given, const struct zr_environment *look)
{
    struct zr_picture merged = {.environment = *look};
    TAKE(ENVIRONMENT, environment.name);
    TAKE(ENVIRONMENT_INTENSITY, environment.intensity);
    TAKE(ENVIRONMENT_ROTATION, environment.rotation_degrees);
    if (zr_picture_gives(given, ZR_PICTURE_ENVIRONMENT) && merged.environment.name != ZR_ENVIRONMENT_NONE)
        merged.environment.camera_frame = merged.environment.name != ZR_ENVIRONMENT_OUTDOOR;
    TAKE(ENVIRONMENT_FRAME, environment.camera_frame);
    return merged.environment;
}

struct zr_picture zr_picture_merge(const struct zr_parsed_picture *given, const struct zr_look *look)
{
    struct zr_picture merged = look->picture;
    merged.environment = merge_environment(given, &look->picture.environment);
    TAKE(SIDE, side);
    TAKE(LINE_WIDTH, line_width);
    TAKE(BACKGROUND, has_gradient);
    TAKE(BACKGROUND, top);
    TAKE(BACKGROUND, bottom);
    TAKE(TONE, tone);
    TAKE(EXPOSURE, exposure);
    TAKE(OCCLUSION, occlusion.is_on);
    TAKE(OCCLUSION_RADIUS, occlusion.radius);
    TAKE(OCCLUSION_STRENGTH, occlusion.strength);
    TAKE(GROUND, has_ground);
    TAKE(EDGES, edges.is_on);
    TAKE(EDGES_COLOR, edges.color);
    TAKE(EDGES_WIDTH, edges.width);
    TAKE(EDGES_CREASE, edges.crease_degrees);
    TAKE(CREASE, crease_degrees);
    TAKE(UP, z_is_up);
    return merged;
}

const char *zr_picture_linear_key(const struct zr_parsed_picture *given, const struct zr_picture *merged)
{
    const struct {
        enum zr_picture_key key;
        bool is_on;
        const char *name;
    } rows[] = {{ZR_PICTURE_BACKGROUND, merged->has_gradient, "background"},
                {ZR_PICTURE_ENVIRONMENT, merged->environment.name != ZR_ENVIRONMENT_NONE, "environment"},
                {ZR_PICTURE_ENVIRONMENT_INTENSITY, true, "environment"},
                {ZR_PICTURE_ENVIRONMENT_ROTATION, true, "environment"},
                {ZR_PICTURE_ENVIRONMENT_FRAME, true, "environment"},
                {ZR_PICTURE_TONE, merged->tone != ZR_TONE_NONE, "toneMapping"},
                {ZR_PICTURE_EXPOSURE, true, "exposure"},
                {ZR_PICTURE_OCCLUSION, merged->occlusion.is_on, "occlusion"},
                {ZR_PICTURE_GROUND, merged->has_ground, "groundShadow"},
                {ZR_PICTURE_EDGES, merged->edges.is_on, "edges"},
                {ZR_PICTURE_CREASE, true, "creaseDegrees"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].is_on && zr_picture_gives(given, rows[i].key)) return rows[i].name;
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
