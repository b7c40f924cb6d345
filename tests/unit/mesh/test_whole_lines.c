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

/* Draws an OBJ file by parallel rays along -z. */
static struct drawn draw(const char *text)
{
    const struct zr_scene *scene = model_of_text(&arena, text, "technical");
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    struct zr_view view = scene->views[0];
    struct zr_camera camera;
    struct zr_error error = {0};
    struct zr_drawing drawing;
    view.width = view.height = SIDE;
    view.pose = ZR_POSE_DIRECTION;
    view.direction = (zr_vec3){0, 0, -1};
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
    const struct drawn drawn = draw(text);
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

RUN_TESTS(open_arena, close_arena)
