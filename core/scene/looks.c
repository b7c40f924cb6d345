#include "scene/looks.h"

#include <stdio.h>
#include <string.h>

#include "scene/picture.h"

#define RGB(hex)                                                                                                       \
    {                                                                                                                  \
        (float)((hex) >> 16 & 255) / 255.0f, (float)((hex) >> 8 & 255) / 255.0f, (float)((hex)&255) / 255.0f           \
    }
#define OPAQUE(hex)                                                                                                    \
    {                                                                                                                  \
        (float)((hex) >> 16 & 255) / 255.0f, (float)((hex) >> 8 & 255) / 255.0f, (float)((hex)&255) / 255.0f, 1        \
    }

/* ---- lamps ---- */

/* A key light in front, from the left, and a weaker light from above. Both are off the camera's axis, since a light on
 * the axis gives the three visible faces of an isometric cube one grey. Candidates had directions of exactly unit
 * length, left each face at least a third of its colour, and gave no normal more than all of it. With these two, the
 * faces of a cube differ most over ten views:
 *
 *     azimuth, elevation    left    right   top        azimuth, elevation    left    right   top
 *     isometric             0.663   0.341   0.965      30, 35                0.627   0.376   0.965
 *     isometric, below      0.894   0.631   0.392 *    30, 50                0.557   0.341   0.953
 *     45, 20                0.714   0.396   0.933      60, 20                0.714   0.416   0.933
 *     45, 50                0.608   0.341   0.953      60, 35                0.678   0.341   0.965
 *     30, 20                0.690   0.420   0.933      60, 50                0.639   0.341   0.953
 *                                                      * the underside
 */
static const struct zr_light textbook_lights[] = {
    {.direction = {2.0f / 3, -1.0f / 3, -2.0f / 3}, .color = {0.45f, 0.45f, 0.45f}, .camera_frame = true},
    {.direction = {-4.0f / 13, -12.0f / 13, -3.0f / 13}, .color = {0.37f, 0.37f, 0.37f}, .camera_frame = true},
};

/* Least-squares fit of the environment studio, for flat, gouraud and phong. The key light travels along
 * -normalize(-0.60, 0.66, 0.46). */
#define CLASSIC_LIGHTS                                                                                                 \
    {.type = ZR_LIGHT_HEMISPHERE,                                                                                      \
     .direction = {0, 1, 0},                                                                                           \
     .color = {0.479f, 0.488f, 0.500f},                                                                                \
     .ground = {0.305f, 0.297f, 0.289f},                                                                               \
     .camera_frame = true,                                                                                             \
     .lit = ZR_LIT_CLASSIC},                                                                                           \
    {                                                                                                                  \
        .type = ZR_LIGHT_DIRECTIONAL, .direction = {0.597851594f, -0.657636754f, -0.458352889f},                       \
        .color = {1.066f, 1.039f, 1.000f}, .camera_frame = true, .lit = ZR_LIT_CLASSIC                                 \
    }

static const struct zr_light studio_lights[] = {CLASSIC_LIGHTS};

/* The sun travels along -normalize(-0.42, 0.80, 0.43). Along the brightest part of the sky, it would meet top and front
 * of a cube at one angle. */
static const struct zr_light outdoor_lights[] = {
    CLASSIC_LIGHTS,
    {.type = ZR_LIGHT_DIRECTIONAL,
     .direction = {0.419727266f, -0.799480506f, -0.429720772f},
     .color = {1.28f, 1.28f * 0.90f, 1.28f * 0.75f},
     .environment_frame = true,
     .has_shadows = true,
     .lit = ZR_LIT_PBR},
};

#define LIGHTS(array) .light_count = sizeof(array) / sizeof(array)[0], .lights = (array)

/* ---- shared values of rows ---- */

/* 16 samples per pixel. The crease angle keeps chamfers of 45 degrees sharp and makes cylinders of 12 sides round. */
#define LINEAR                .is_linear = true, .side = 4, .line_width = 1, .crease_degrees = 35
#define GOOCH                 .gooch = {0.35f, 0.65f}
#define NEUTRAL(factor)       .tone = ZR_TONE_NEUTRAL, .exposure = (factor)
#define NO_TONE               .tone = ZR_TONE_NONE, .exposure = 1
#define STUDIO                .environment = {ZR_ENVIRONMENT_STUDIO, 1, 0, true, NULL}
#define METAL                 .environment = {ZR_ENVIRONMENT_METAL, 1, 0, true, NULL}
#define OUTDOOR               .environment = {ZR_ENVIRONMENT_OUTDOOR, 1, 0, false, NULL}
#define GRADIENT(from, to)    .has_gradient = true, .top = RGB(from), .bottom = RGB(to)
#define OCCLUSION(on, factor) .occlusion = {(on), 0.2f, (factor)}
#define GROUNDED              .occlusion = {true, 0.15f, 1.7f}, .has_ground = true
/* At 30 degrees, scans get stray creases. */
#define EDGES(on, ink, wide, silhouettes, creases)                                                                     \
    .edges = {.is_on = (on),                                                                                           \
              .color = RGB(ink),                                                                                       \
              .width = (wide),                                                                                         \
              .crease_degrees = 40,                                                                                    \
              .silhouette_opacity = (silhouettes),                                                                     \
              .crease_opacity = (creases)}
#define NO_EDGES EDGES(false, INK, 1.5f, 1, 0.85f)
#define EDGES_OF_MESH(ink)                                                                                             \
    .edges = {.is_on = true,                                                                                           \
              .color = RGB(ink),                                                                                       \
              .width = 0,                                                                                              \
              .crease_degrees = 30,                                                                                    \
              .silhouette_opacity = 1,                                                                                 \
              .crease_opacity = 0.85f,                                                                                 \
              .is_from_mesh = true}
#define INK  0x1f2a36
#define COOL 0x9fb0c3

/* Phong highlights are weak, as on plastic. */
#define MATERIAL(model, hex, metal, rough) MATERIAL_COOL(model, hex, metal, rough, COOL)
#define MATERIAL_COOL(model, hex, metal, rough, cool_hex)                                                              \
    .material = {.shading = (model),                                                                                   \
                 .base_color = OPAQUE(hex),                                                                            \
                 .specular = {0.12f, 0.12f, 0.12f},                                                                    \
                 .shininess = 32,                                                                                      \
                 .metallic = (metal),                                                                                  \
                 .roughness = (rough),                                                                                 \
                 ZR_MATERIAL_PLASTIC,                                                                                  \
                 .cool = RGB(cool_hex)}

/* Elevation: isometric views show cars and animals from too high, and below 25 degrees plates become slivers. Angle of
 * view: 45 degrees distort, and 20 look flat. The padding leaves room for the ground's shadow. */
#define FROM_ASIDE(share)                                                                                              \
    .view = {.pose = ZR_POSE_ORBIT,                                                                                    \
             .preset = ZR_PRESET_ISOMETRIC,                                                                            \
             .azimuth_degrees = 35,                                                                                    \
             .elevation_degrees = 28,                                                                                  \
             .projection = ZR_PROJECTION_PERSPECTIVE,                                                                  \
             .fov_radians = 0.52359878f,      /* 30 degrees */                                                         \
             .wide_fov_radians = 0.88910519f, /* 2 atan(16/9 tan(15 degrees)) */                                       \
             .padding = (share)}
#define ISOMETRIC                                                                                                      \
    .view = {.pose = ZR_POSE_PRESET,                                                                                   \
             .preset = ZR_PRESET_ISOMETRIC,                                                                            \
             .projection = ZR_PROJECTION_ORTHOGRAPHIC,                                                                 \
             .padding = 0.05f}

/* ---- the rows ---- */

/* studio's base colour is tinted, since a grey model blends into a grey background. */
const struct zr_look zr_looks[] = {
    {.name = "studio",
     .version = 1,
     .text = "a clean product picture: soft light, shadow on the ground, pale gradient",
     .picture = &(const struct zr_picture){LINEAR, GOOCH, NEUTRAL(1), STUDIO, GRADIENT(0xf4f6f8, 0xd3dae1), GROUNDED,
                                           EDGES(true, 0x3f4b59, 1, 0.60f, 0.45f)},
     .background = OPAQUE(0xf4f6f8),
     MATERIAL(ZR_SHADING_PBR, 0x9fb6d0, 0, 0.55f),
     LIGHTS(studio_lights),
     FROM_ASIDE(0.05f)},
    {.name = "technical",
     .version = 1,
     .text = "an illustration with ink lines along outlines and creases, in cool and warm tones",
     .picture = &(const struct zr_picture){LINEAR, NO_TONE, STUDIO, OCCLUSION(true, 1.1f), EDGES_OF_MESH(INK), GOOCH},
     .background = OPAQUE(0xffffff),
     MATERIAL(ZR_SHADING_GOOCH, 0xfcfcfd, 0, 0.55f),
     .is_material = true,
     .cloud = OPAQUE(0x7d90a6),
     LIGHTS(studio_lights),
     ISOMETRIC},
    {.name = "clay",
     .version = 1,
     .text = "matte clay, which shows shape without reflections",
     .picture = &(const struct zr_picture){LINEAR, GOOCH, NEUTRAL(1), STUDIO, GRADIENT(0xf7f4f0, 0xded6cc), GROUNDED,
                                           NO_EDGES},
     .background = OPAQUE(0xf7f4f0),
     MATERIAL(ZR_SHADING_PBR, 0xd3b9a2, 0, 0.9f),
     .is_material = true,
     .wire = OPAQUE(0x7a6350),
     LIGHTS(studio_lights),
     FROM_ASIDE(0.05f)},
    {.name = "dark",
     .version = 1,
     .text = "a light model in front of a dark gradient",
     .picture = &(const struct zr_picture){LINEAR, GOOCH, NEUTRAL(1), STUDIO, GRADIENT(0x3c444d, 0x191d22), GROUNDED,
                                           EDGES(true, 0x7c8996, 1, 0.85f, 0.50f)},
     .background = OPAQUE(0x3c444d),
     MATERIAL(ZR_SHADING_PBR, 0xc9ced4, 0, 0.45f),
     LIGHTS(studio_lights),
     FROM_ASIDE(0.05f)},
    {.name = "metal",
     .version = 1,
     .text = "brushed metal with reflections of a studio",
     .picture = &(const struct zr_picture){LINEAR, GOOCH, NEUTRAL(1), METAL, GRADIENT(0xf4f6f8, 0xd3dae1), GROUNDED,
                                           EDGES(true, 0x2b3036, 1, 0.60f, 0.45f)},
     .background = OPAQUE(0xf4f6f8),
     MATERIAL(ZR_SHADING_PBR, 0xd4d6da, 1, 0.32f),
     .is_material = true,
     LIGHTS(studio_lights),
     FROM_ASIDE(0.05f)},
    {.name = "outdoor",
     .version = 1,
     .text = "sun and sky, with cast shadows",
     .picture = &(const struct zr_picture){LINEAR, GOOCH, NEUTRAL(0.75f), OUTDOOR, GRADIENT(0xbcd6f0, 0xefe9de),
                                           GROUNDED, NO_EDGES, .has_ground_sun = true},
     .background = OPAQUE(0xbcd6f0),
     MATERIAL(ZR_SHADING_PBR, 0xb9b4aa, 0, 0.55f),
     .wire = OPAQUE(0x5f5c55),
     LIGHTS(outdoor_lights),
     FROM_ASIDE(0.08f)},
    {.name = "blueprint",
     .version = 1,
     .text = "white lines on blue paper",
     .picture = &(const struct zr_picture){LINEAR, NO_TONE, STUDIO, OCCLUSION(true, 1.6f), EDGES_OF_MESH(0xe8f0fa),
                                           .gooch = {0.2f, 0.8f}},
     .background = OPAQUE(0x1d4a86),
     MATERIAL_COOL(ZR_SHADING_GOOCH, 0x5086c8, 0, 0.55f, 0x4c6290),
     .is_material = true,
     LIGHTS(studio_lights),
     ISOMETRIC},
    {.name = "xray",
     .version = 1,
     .text = "translucent surfaces, which show the inside",
     .picture = &(const struct zr_picture){LINEAR, NO_TONE, STUDIO, GRADIENT(0xffffff, 0xf1f4f8), OCCLUSION(false, 2),
                                           NO_EDGES, GOOCH},
     .background = OPAQUE(0xffffff),
     MATERIAL(ZR_SHADING_XRAY, 0x2b6cb0, 0, 0.55f),
     .is_material = true,
     LIGHTS(studio_lights),
     FROM_ASIDE(0.05f)},
    {.name = "textbook",
     .version = 1,
     .text = "plain OpenGL 2.1: one sample per pixel, two lights, no effects",
     .picture = &(const struct zr_picture){.side = 1,
                                           .line_width = 1,
                                           .crease_degrees = 180,
                                           .environment = {ZR_ENVIRONMENT_NONE, 1, 0, true, NULL},
                                           NO_TONE,
                                           OCCLUSION(false, 2),
                                           .edges = {.color = RGB(INK),
                                                     .width = 1.5f,
                                                     .crease_degrees = 30,
                                                     .silhouette_opacity = 1,
                                                     .crease_opacity = 0.85f},
                                           GOOCH},
     .background = OPAQUE(0xffffff),
     .material = {.base_color = {0.7f, 0.7f, 0.7f, 1},
                  .shininess = 32,
                  .roughness = 0.55f,
                  ZR_MATERIAL_PLASTIC,
                  .cool = RGB(COOL)},
     .shades_by_mesh = true,
     .ambient = {0.34f, 0.34f, 0.34f},
     LIGHTS(textbook_lights),
     ISOMETRIC},
};

const int zr_look_count = sizeof zr_looks / sizeof zr_looks[0];

const struct zr_look *zr_look_textbook(void)
{
    int i = zr_look_count - 1;
    while (i > 0 && strcmp(zr_looks[i].name, "textbook") != 0)
        i--;
    return &zr_looks[i];
}

struct zr_look_pin zr_look_pin_of(const struct zr_look *look)
{
    struct zr_look_pin pin;
    snprintf(pin.text, sizeof pin.text, "%s@%u", look->name, look->version);
    return pin;
}

const struct zr_look *zr_look_find(const char *text)
{
    const struct zr_look *found = NULL;
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look *look = &zr_looks[i];
        if (strcmp(look->name, text) == 0 || strcmp(zr_look_pin_of(look).text, text) == 0) found = look;
    }
    return found;
}

struct zr_look_names zr_looks_join(void)
{
    struct zr_look_names joined = {""};
    for (int i = 0; i < zr_look_count; i++) {
        const size_t used = strlen(joined.text);
        if (i > 0 && strcmp(zr_looks[i - 1].name, zr_looks[i].name) == 0) continue;
        snprintf(joined.text + used, sizeof joined.text - used, "%s%s", used ? ", " : "", zr_looks[i].name);
    }
    return joined;
}

void zr_look_apply(const struct zr_look *look, struct zr_scene *scene)
{
    scene->look = look;
    scene->picture = look->picture;
    scene->background = look->background;
    scene->ambient = look->ambient;
    scene->light_count = look->light_count;
    scene->lights = look->lights;
}

void zr_look_set_fov(const struct zr_look_view *from, struct zr_view *view)
{
    const bool is_upright = view->width < view->height;
    const uint64_t smaller = is_upright ? view->width : view->height, larger = is_upright ? view->height : view->width;
    const bool is_wide = 9 * larger > 16 * smaller;
    const float radians = is_wide ? from->wide_fov_radians : from->fov_radians;
    view->xfov_radians = is_upright != is_wide ? radians : 0.0f;
    view->yfov_radians = is_upright != is_wide ? 0.0f : radians;
}

void zr_look_set_view(const struct zr_look *look, struct zr_view *view)
{
    const struct zr_look_view *from = &look->view;
    view->pose = from->pose;
    view->preset = from->preset;
    view->azimuth_degrees = from->azimuth_degrees;
    view->elevation_degrees = from->elevation_degrees;
    view->up = (zr_vec3){0, 1, 0};
    view->projection = from->projection;
    view->fit_padding = from->padding;
    view->suits_extent = from->pose == ZR_POSE_ORBIT;
    zr_look_set_fov(from, view);
}
