/* Glass that refracts: pictures of what is behind it. */
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "shade/frame.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

enum { WIDTH = 60, HEIGHT = 40 };

struct drawing {
    struct reading *reading;
    struct zr_arena arena;
    const struct zr_frame *frame;
};

static void draw(const char *text, struct drawing *d)
{
    struct zr_error error = {.status = ZR_OK};
    d->reading = read_scene(text);
    assert_int_equal(d->reading->scene->warning_count, 0);
    zr_arena_init(&d->arena, (size_t)1 << 28);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &d->arena, .error = &error}, d->reading->scene, NULL, &d->frame), ZR_OK);
}

static void end(struct drawing *d)
{
    zr_arena_free(&d->arena);
    reading_free(d->reading);
}

/* A red wall right of x = 0.5, far behind a square of glass that covers the middle; no light but that of the wall. */
#define SCENE_OF(head, alpha, glass)                                                                                   \
    "{\"look\": \"studio\", \"environment\": false, \"groundShadow\": false, \"occlusion\": false, "                   \
    "\"toneMapping\": "                                                                                                \
    "\"none\", \"window\": {\"width\": 60, \"height\": 40}, " head                                                     \
    "\"view\": {\"eye\": [0, 0, 9], \"target\": [0, 0, 0], \"perspective\": {\"yfovDegrees\": 30}}, "                  \
    "\"materials\": [{\"name\": \"red\", \"shading\": \"unlit\", \"baseColorFactor\": \"#ff0000\"}, "                  \
    "{\"name\": \"glass\", \"transmissionFactor\": 1, \"metallicFactor\": 0, \"baseColorFactor\": [1, 1, 1, "          \
    "1], " glass "}], "                                                                                                \
    "\"meshes\": [{\"material\": \"red\", \"positions\": [[0.5,-5,-3],[9,-5,-3],[9,5,-3],[0.5,5,-3]], \"faces\": "     \
    "[[0,1,2,3]]}, {\"material\": \"glass\", \"positions\": [[-1.5,-1,0],[1.5,-1,0],[1.5,1,0],[-1.5,1,0]], "           \
    "\"faces\": [[0,1,2,3]]}]}"
#define SCENE(head, glass) SCENE_OF(head, "1", glass)
#define BLACK              "\"background\": \"#000000\", "

static const uint8_t *pixel(const struct drawing *d, int x, int y)
{
    return d->frame->color + 4 * (WIDTH * (size_t)y + (size_t)x);
}

static void assert_pixel(const struct drawing *d, int x, int y, int r, int g, int b)
{
    const uint8_t *p = pixel(d, x, y);
    if (abs(p[0] - r) > 4 || abs(p[1] - g) > 4 || abs(p[2] - b) > 4)
        fail_msg("pixel %d, %d: %d %d %d", x, y, p[0], p[1], p[2]);
}

/* The index 1 bends nothing and blurs nothing, whatever the depth and roughness. */
TEST(glass_of_index_1_cannot_be_seen)
{
    struct drawing d;
    draw(SCENE(BLACK, "\"ior\": 1, \"thicknessFactor\": 2, \"roughnessFactor\": 0.5"), &d);
    assert_pixel(&d, 25, 20, 0, 0, 0);
    assert_pixel(&d, 36, 20, 255, 0, 0);
    assert_pixel(&d, 50, 20, 255, 0, 0);
    end(&d);
}

/* White light becomes half as strong in green after the distance 1, and the wall's light has no green: red is left. */
TEST(volumes_color_what_is_behind)
{
    struct drawing d;
    draw(SCENE(BLACK, "\"ior\": 1, \"roughnessFactor\": 0, \"thicknessFactor\": 2, \"attenuationDistance\": 1, "
                      "\"attenuationColor\": [0.5, 1, 1]"),
         &d);
    assert_pixel(&d, 36, 20, 137, 0, 0); /* 0.25 of linear light */
    assert_pixel(&d, 50, 20, 255, 0, 0);
    end(&d);
}

/* A node that scales the glass scales its depth. */
TEST(depth_is_in_units_of_the_mesh)
{
    struct drawing d;
    draw("{\"look\": \"studio\", \"environment\": false, \"groundShadow\": false, \"occlusion\": false, "
         "\"toneMapping\": \"none\", \"window\": {\"width\": 60, \"height\": 40}, \"background\": \"#ffffff\", "
         "\"view\": {\"eye\": [0, 0, 9], \"target\": [0, 0, 0], \"perspective\": {\"yfovDegrees\": 30}}, "
         "\"materials\": [{\"name\": \"glass\", \"transmissionFactor\": 1, \"metallicFactor\": 0, \"ior\": 1, "
         "\"baseColorFactor\": [1, 1, 1, 1], "
         "\"roughnessFactor\": 0, \"thicknessFactor\": 0.5, \"attenuationDistance\": 1, \"attenuationColor\": [0.5, 1, "
         "1]}], \"meshes\": [{\"name\": \"m\", \"material\": \"glass\", \"positions\": "
         "[[-0.5,-0.5,0],[0.5,-0.5,0],[0.5,0.5,0],[-0.5,0.5,0]], \"faces\": [[0,1,2,3]]}], "
         "\"nodes\": [{\"mesh\": \"m\", \"scale\": [4, 4, 4]}]}",
         &d);
    assert_pixel(&d, 30, 20, 137, 255, 255);
    end(&d);
}

/* Rough glass mixes wall and background. */
TEST(rough_glass_blurs)
{
    struct drawing d;
    draw(SCENE(BLACK, "\"thicknessFactor\": 0.5, \"roughnessFactor\": 0.7"), &d);
    const uint8_t *left = pixel(&d, 22, 20), *right = pixel(&d, 38, 20);
    assert_true(left[0] > 40 && right[0] < 235);
    end(&d);
}

/* Without a background, light passes straight, and glass alone is translucent. */
TEST(glass_over_a_transparent_background_is_translucent)
{
    struct drawing d;
    draw(SCENE("\"background\": \"#00000000\", ", "\"thicknessFactor\": 0.5, \"roughnessFactor\": 0"), &d);
    assert_true(pixel(&d, 25, 20)[3] < 64);
    assert_int_equal(pixel(&d, 38, 20)[3], 255);
    end(&d);
}

/* Glass that is OPAQUE has no alpha. */
TEST(alpha_of_opaque_glass_is_ignored)
{
    struct drawing with, without;
    draw(SCENE(BLACK, "\"thicknessFactor\": 0.5, \"roughnessFactor\": 0"), &without);
    draw(SCENE_OF(BLACK, "0.25", "\"thicknessFactor\": 0.5, \"roughnessFactor\": 0, \"alphaMode\": \"OPAQUE\""), &with);
    assert_memory_equal(with.frame->color, without.frame->color, (size_t)4 * WIDTH * HEIGHT);
    end(&with);
    end(&without);
}

RUN_TESTS(NULL, NULL)
