/* Shadows of spots, and of directional lamps: a plane has none of itself, at whatever angle light comes and whatever
 * looks at it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static struct zr_arena arena;
static char text[4096];

/* Draws what `text` says; the picture stays until the arena is reset. */
static const uint8_t *draw(void)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .size = strlen(text), .bytes = text};
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s %s: %s", error.items[0].pointer, error.items[0].detail, text);
    return scene_render(&arena, NULL, scene)->color;
}

/* A scene of these polygons, seen by this view, under one spot from a place to another, and a little ambient light; or,
 * where `outer` is 0, under a directional lamp. */
struct setting {
    const char *polygons, *view, *shading;
    double at[3], to[3], outer;
};

/* `strength`: of the light, where the lamp looks. */
static void write_scene(const struct setting *s, double strength, const char *shadows)
{
    const double square = s->at[0] * s->at[0] + s->at[1] * s->at[1] + s->at[2] * s->at[2];
    char lamp[256] = "\"type\": \"directional\"";
    if (s->outer > 0.0)
        snprintf(lamp, sizeof lamp,
                 "\"type\": \"spot\", \"position\": [%.6f, %.6f, %.6f], \"outerConeAngleDegrees\": %.4f", s->at[0],
                 s->at[1], s->at[2], s->outer);
    snprintf(text, sizeof text,
             "{\"colorManagement\": \"srgb\", \"window\": {\"width\": %d, \"height\": %d}, \"ambient\": [0.05, 0.05, "
             "0.05], \"shading\": \"%s\", \"view\": {%s}, \"lights\": [{%s, \"direction\": [%.6f, %.6f, %.6f], "
             "\"intensity\": %.6f, \"shadows\": %s}], \"polygons\": [%s]}",
             WIDTH, HEIGHT, s->shading, s->view, lamp, s->to[0] - s->at[0], s->to[1] - s->at[1], s->to[2] - s->at[2],
             s->outer > 0.0 ? strength * square : strength, shadows, s->polygons);
}

static int count_differences(const struct setting *s)
{
    int count = 0;
    write_scene(s, 0.8, "false");
    const uint8_t *without = draw();
    write_scene(s, 0.8, "true");
    const uint8_t *with = draw();
    for (int i = 0; i < PIXELS; i++)
        count += memcmp(with + 4 * i, without + 4 * i, 4) != 0;
    return count;
}

/* Pixels that the spot lights: those that differ from what they are under one of no intensity. */
static int count_lit(const struct setting *s)
{
    int count = 0;
    write_scene(s, 0.8, "false");
    const uint8_t *with = draw();
    write_scene(s, 0.0, "false");
    const uint8_t *without = draw();
    for (int i = 0; i < PIXELS; i++)
        count += memcmp(with + 4 * i, without + 4 * i, 4) != 0;
    return count;
}

/* Cameras in whose axes all is thirty times as large, or as small: with a projectionMatrix they stay so. */
#define LARGER  "\"worldToCamera\": [[30, 0, 0, 0], [0, 30, 0, 0], [0, 0, 30, -150], [0, 0, 0, 1]]"
#define SMALLER "\"worldToCamera\": [[0.03, 0, 0, 0], [0, 0.03, 0, 0], [0, 0, 0.03, -0.15], [0, 0, 0, 1]]"
static const char *const views[] = {
    "\"eye\": [1, -2, 5], \"target\": [0, 0, 0], \"perspective\": {\"yfovDegrees\": 45}",
    "\"eye\": [-2, 3, 4], \"target\": [0, 0, 0], \"orthographic\": {\"xmag\": 3.2, \"ymag\": 2.4}",
    LARGER ", \"projectionMatrix\": [[1.60838,0,0,0],[0,2.14451,0,0],[0,0,-1.14286,-64.2857],[0,0,-1,0]]",
    SMALLER ", \"projectionMatrix\": [[1.60838,0,0,0],[0,2.14451,0,0],[0,0,-1.14286,-0.0642857],[0,0,-1,0]]"};
enum { VIEWS = sizeof views / sizeof *views };
static const char *const shadings[] = {"flat", "phong", "pbr"};

#define PLANE "{\"doubleSided\": true, \"vertices\": [[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]]}"

/* Returns how many pixels are lit, in all rounds. */
static int check_planes(uint64_t seed, bool by_spots)
{
    struct random r = random_seeded(seed);
    int lit = 0;
    zr_arena_init(&arena, (size_t)1 << 28);
    for (int round = 0; round < 60; round++) {
        const double height = random_range(&r, 1, 85) * acos(-1.0) / 180, turn = random_range(&r, 0, 6.2831853);
        const double d = pow(10.0, random_range(&r, -0.2, 1.5)), side = round % 4 == 3 ? -1 : 1;
        struct setting s = {.polygons = PLANE,
                            .view = views[round % VIEWS],
                            .shading = shadings[round / 3 % 3],
                            .at = {d * cos(height) * cos(turn), d * cos(height) * sin(turn), side * d * sin(height)},
                            .to = {random_range(&r, -0.3, 0.3), random_range(&r, -0.3, 0.3), 0},
                            .outer = by_spots ? random_range(&r, 2, 80) : 0};
        const int differ = count_differences(&s);
        if (differ) fail_msg("round %d: %d pixels of a plane are in its own shadow: %s", round, differ, text);
        lit += count_lit(&s);
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    zr_arena_free(&arena);
    return lit;
}

TEST(a_plane_has_no_shadow_of_itself)
{
    assert_true(check_planes(91, true) > 60 * PIXELS / 20);
}

TEST(nor_has_it_one_by_directional_lamps)
{
    assert_true(check_planes(92, false) > 60 * PIXELS / 20);
}

/* A wall on a plane, lit from one side by a lamp that is as high as the wall is wide; seen from above. */

RUN_TESTS(NULL, NULL)
