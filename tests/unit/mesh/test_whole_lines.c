/* Lines of drawings are whole: patches of a smooth surface have no seams, and creases do not end in smooth skin. */
#include <math.h>

#include "lines/drawing.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1u << 28)

enum { SIDE = 400 };

struct drawn {
    struct zr_polylines lines;
    double scale; /* pixels per unit */
};

/* Draws a scene by parallel rays along a direction. */
static struct drawn draw(const struct zr_scene *scene, zr_vec3 direction)
{
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    struct zr_view view = scene->views[0];
    struct zr_camera camera;
    struct zr_error error = {0};
    struct zr_drawing drawing;
    view.width = view.height = SIDE;
    view.pose = ZR_POSE_DIRECTION;
    view.direction = direction;
    view.up = (zr_vec3){0, 1, 0};
    view.projection = ZR_PROJECTION_ORTHOGRAPHIC;
    assert_int_equal(zr_camera_resolve(&(struct zr_run){.error = &error}, scene, &view, &bounds, &camera), ZR_OK);
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = &bounds,
                                         .width = SIDE,
                                         .height = SIDE,
                                         .rule = {.crease_degrees = 30}};
    assert_int_equal(zr_drawing_make(&(struct zr_run){.arena = &arena}, &desc, &drawing), ZR_OK);
    return (struct drawn){drawing.polylines, 0.5 * SIDE * (double)camera.projection.m[0]};
}

/* Returns the length of all lines in units of the model. */
static double length_of(const char *text)
{
    const struct drawn drawn = draw(model_of_text(&arena, text, "technical"), (zr_vec3){0, 0, -1});
    double sum = 0.0;
    for (uint32_t i = 0; i < drawn.lines.count; i++)
        for (uint32_t k = 1; k < drawn.lines.at[i].count; k++) {
            const double *p = drawn.lines.points[drawn.lines.at[i].first + k - 1], *q = p + 2;
            sum += hypot(q[0] - p[0], q[1] - p[1]);
        }
    return sum / drawn.scale;
}

/* ---- seams ---- */

/* Quads of 1 x 1 and of two times 1 x 0.5, which share no edge at x = 1. The second patch lies higher by `z`, and its
 * normals are `n`. */
#define PATCHES(z, n)                                                                                                  \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 " z "\nv 2 0 " z "\nv 2 .5 " z "\nv 1 .5 " z "\nv 2 1 " z "\nv 1 1 " z  \
    "\nvn 0 0 1\nvn " n "\nf 1//1 2//1 3//1 4//1\nf 5//2 6//2 7//2 8//2\nf 8//2 7//2 9//2 10//2\n"

TEST(patches_of_a_smooth_surface_have_no_seam)
{
    assert_true(fabs(length_of(PATCHES("0", "0 0 1")) - 6.0) < 0.1);
    assert_true(fabs(length_of(PATCHES("0", "0.1 0 1")) - 6.0) < 0.1);
}

TEST(borders_at_a_step_or_between_other_normals_are_lines)
{
    assert_true(length_of(PATCHES("0.01", "0 0 1")) > 6.9);
    assert_true(length_of(PATCHES("0", "0.3 0 1")) > 6.9);
}

TEST(borders_without_normals_of_the_file_are_lines)
{
    assert_true(length_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 .5 0\nv 1 .5 0\nv 2 1 0\nf 1 2 3 4\n"
                          "f 2 5 6 7\nf 7 6 8 3\n") > 6.9);
}

/* ---- free ends ---- */

enum { ROWS = 9 };

/* A roof of two strips along y from 0 to 8, whose quads meet at about degrees[i] at y = i. `twist`: 0 makes quads
 * between equal degrees planes. */
static const char *roof(const double degrees[ROWS], double twist)
{
    static char text[4096];
    size_t used = 0;
    for (int i = 0; i < ROWS; i++) {
        const double fall = tan(degrees[i] * 0.5 * 0.017453292519943295) * (1.0 + (i % 2 ? twist : -twist));
        used += (size_t)snprintf(text + used, sizeof text - used, "v -1 %d %.9g\nv 0 %d 0\nv 1 %d %.9g\n", i, -fall, i,
                                 i, -fall);
    }
    for (int i = 0; i + 1 < ROWS; i++) {
        const int a = 3 * i + 1;
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\nf %d %d %d %d\n", a, a + 1, a + 4,
                                 a + 3, a + 1, a + 2, a + 5, a + 4);
    }
    return text;
}

/* Returns the length of the ridge that is drawn. The border has 20. */
static double ridge_of(const double degrees[ROWS])
{
    return length_of(roof(degrees, 0.01)) - 20.0;
}

TEST(weak_creases_with_a_free_end_are_no_lines)
{
    const double within[ROWS] = {10, 10, 38, 38, 38, 38, 10, 10, 10}, at_border[ROWS] = {38, 38, 38, 38, 10, 10, 10},
                 whole[ROWS] = {38, 38, 38, 38, 38, 38, 38, 38, 38};
    assert_true(fabs(ridge_of(within)) < 0.1);
    assert_true(fabs(ridge_of(at_border)) < 0.1);
    assert_true(fabs(ridge_of(whole) - 8.0) < 0.1);
}

/* Such as chamfers, whose rounded corners bend less. */
TEST(weak_creases_between_planes_are_lines)
{
    const double within[ROWS] = {10, 10, 38, 38, 38, 38, 10, 10, 10};
    assert_true(length_of(roof(within, 0.0)) - 20.0 > 2.9);
}

TEST(strong_creases_with_two_free_ends_are_no_lines)
{
    const double within[ROWS] = {10, 10, 60, 60, 60, 60, 10, 10, 10}, at_border[ROWS] = {60, 60, 60, 60, 10, 10, 10};
    assert_true(fabs(ridge_of(within)) < 0.1);
    assert_true(ridge_of(at_border) > 2.9);
}

/* Returns the distance of a point from the segment between two others. */
static double distance_of(const double p[2], const double from[2], const double to[2])
{
    const double x = to[0] - from[0], y = to[1] - from[1], square = x * x + y * y;
    double t = square > 0.0 ? ((p[0] - from[0]) * x + (p[1] - from[1]) * y) / square : 0.0;
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return hypot(p[0] - from[0] - t * x, p[1] - from[1] - t * y);
}

/* True if no line but `own` passes within half a pixel. */
static bool is_alone(const struct zr_polylines *lines, uint32_t own, const double p[2])
{
    for (uint32_t i = 0; i < lines->count; i++)
        for (uint32_t k = 1; i != own && k < lines->at[i].count; k++) {
            const double *from = lines->points[lines->at[i].first + k - 1];
            if (distance_of(p, from, from + 2) <= 0.5) return false;
        }
    return true;
}

/* Counts the free ends of lines that are no outlines. */
static uint32_t free_ends_of(const struct zr_polylines *lines)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct zr_polyline *line = &lines->at[i];
        const double *first = lines->points[line->first], *last = lines->points[line->first + line->count - 1];
        if (line->class != ZR_STROKE_INNER || (first[0] == last[0] && first[1] == last[1])) continue;
        found += is_alone(lines, i, first);
        found += is_alone(lines, i, last);
    }
    return found;
}

TEST(creases_of_models_have_no_free_ends)
{
    static const char *const names[] = {"spot.obj", "parts/gear.obj", "parts/housing.obj", "parts/plate.obj"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct zr_scene *scene = model_of_file(&arena, names[i], "technical");
        if (!scene) return;
        const struct drawn drawn = draw(scene, (zr_vec3){-1, -0.8f, -1.2f});
        print_message("%s: %u free ends\n", names[i], free_ends_of(&drawn.lines));
        assert_int_equal(free_ends_of(&drawn.lines), 0);
    }
}

RUN_TESTS(open_arena, close_arena)
