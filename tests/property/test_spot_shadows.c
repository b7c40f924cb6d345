/* Shadows of spots, and of directional lamps: a plane has none of itself, at whatever angle light comes and whatever
 * looks at it; and shadows of bodies are those of rays. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "support/random.h"
#include "support/rays.h"
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

/* ---- beside rays ---- */

static struct rays_scene bodies;
static char polygons[4096];

static void add_quad(double corner[3], double u[3], double v[3])
{
    const size_t length = strlen(polygons);
    rays_add_quad(&bodies, corner, u, v);
    snprintf(polygons + length, sizeof polygons - length,
             "%s{\"doubleSided\": true, \"vertices\": [[%.4f, %.4f, %.4f], [%.4f, %.4f, %.4f], [%.4f, %.4f, %.4f], "
             "[%.4f, %.4f, %.4f]]}",
             length ? ", " : "", corner[0], corner[1], corner[2], corner[0] + u[0], corner[1] + u[1], corner[2] + u[2],
             corner[0] + u[0] + v[0], corner[1] + u[1] + v[1], corner[2] + u[2] + v[2], corner[0] + v[0],
             corner[1] + v[1], corner[2] + v[2]);
}

/* Faces that look down are left out: others cast their shadows. */
static void add_box(const double low[3], const double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double u[3] = {0}, v[3] = {0}, near[3] = {low[0], low[1], low[2]}, far[3] = {low[0], low[1], low[2]};
        u[i] = high[i] - low[i];
        v[j] = high[j] - low[j];
        far[axis] = high[axis];
        if (axis < 2) add_quad(near, u, v);
        add_quad(far, u, v);
    }
}

/* A floor with a block, a low plate and a post, all seen from above. */
static void make_bodies(void)
{
    static const double boxes[][2][3] = {
        {{-1.2, -0.6, 0}, {-0.5, 0.3, 0.7}}, {{0.1, 0.2, 0}, {1.3, 0.9, 0.15}}, {{0.6, -0.9, 0}, {0.75, -0.75, 1.2}}};
    bodies.triangle_count = bodies.sphere_count = 0;
    polygons[0] = 0;
    add_quad((double[3]){-2.4, -1.8, 0}, (double[3]){4.8, 0, 0}, (double[3]){0, 3.6, 0});
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++)
        add_box(boxes[i][0], boxes[i][1]);
}

/* Returns the height that is seen at x, y, or minus that less 1 if it is in the shadow. */
static double lit_height(double x, double y, const double to_lamp[3])
{
    struct ray ray = {.from = {x, y, 9}, .along = {0, 0, -1}, .farthest = 10};
    double normal[3];
    const double height = 9 - rays_first(&bodies, &ray, normal);
    const struct ray back = {{x, y, height + 1e-6}, {to_lamp[0], to_lamp[1], to_lamp[2]}, 1e-6, 99};
    return rays_hit(&bodies, &back) ? -height - 1 : height;
}

/* All of the surroundings of a pixel, within 0.012 of the diagonal, is one surface, lit or not. */
static bool is_away_from_contours(double x, double y, double pixel, const double to_lamp[3])
{
    const double here = lit_height(x, y, to_lamp);
    for (int i = 0; i < 24; i++) {
        const double angle = i * acos(-1.0) / 6, r = pixel * (i < 12 ? 1.25 : 2.5);
        if (fabs(lit_height(x + r * cos(angle), y + r * sin(angle), to_lamp) - here) > 1e-9) return false;
    }
    return true;
}

struct verdict {
    int away, wrong_away, wrong;
};

/* `with`, `lit` and `dark`: the picture, and what it would be without shadows, and without the lamp. */
static void judge(const uint8_t *const pictures[3], const double to_lamp[3], struct verdict *out)
{
    const double pixel = 4.8 / WIDTH;
    for (int i = 0; i < PIXELS; i++) {
        const double x = (i % WIDTH + 0.5 - WIDTH / 2) * pixel, y = (HEIGHT / 2 - i / WIDTH - 0.5) * pixel;
        const bool is_lit = lit_height(x, y, to_lamp) >= 0, is_away = is_away_from_contours(x, y, pixel, to_lamp);
        const uint8_t with = pictures[0][4 * i], lit = pictures[1][4 * i], dark = pictures[2][4 * i];
        assert_true(lit > dark + 50);
        out->away += is_away;
        out->wrong_away += is_away && with != (is_lit ? lit : dark);
        out->wrong += (with - dark) * 4 > (lit - dark) * 3 ? !is_lit : is_lit; /* half of the light: encoded, 0.74 */
    }
}

TEST(shadows_are_where_rays_say)
{
    struct random r = random_seeded(93);
    struct verdict all = {0};
    make_bodies();
    zr_arena_init(&arena, (size_t)1 << 28);
    for (int round = 0; round < 6; round++) {
        const double height = (30 + 9 * round) * acos(-1.0) / 180, turn = random_range(&r, 0, 6.2831853);
        const double to_lamp[3] = {cos(height) * cos(turn), cos(height) * sin(turn), sin(height)};
        const struct setting s = {.polygons = polygons,
                                  .view = "\"eye\": [0, 0, 5], \"target\": [0, 0, 0], \"up\": [0, 1, 0], "
                                          "\"orthographic\": {\"xmag\": 2.4, \"ymag\": 1.8}",
                                  .shading = "flat",
                                  .at = {to_lamp[0], to_lamp[1], to_lamp[2]},
                                  .to = {0, 0, 0}};
        const uint8_t *pictures[3];
        for (int k = 0; k < 3; k++) {
            write_scene(&s, k < 2 ? 0.8 : 0, k == 0 ? "true" : "false");
            pictures[k] = draw();
        }
        judge(pictures, to_lamp, &all);
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    zr_arena_free(&arena);
    print_message("%d pixels away from contours, %d of them wrong; %d wrong of %d\n", all.away, all.wrong_away,
                  all.wrong, 6 * PIXELS);
    assert_true(all.away > 4 * PIXELS);
    assert_int_equal(all.wrong_away, 0);
    assert_in_range(all.wrong, 0, 6 * PIXELS / 300);
}

RUN_TESTS(NULL, NULL)
