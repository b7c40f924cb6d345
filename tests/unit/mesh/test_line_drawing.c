/* Lines from the mesh behind visibility: links, steps of contours, strokes, ink, and whole drawings. */
#include <math.h>

#include "base/run.h"
#include "lines/contour_steps.h"
#include "lines/drawing.h"
#include "lines/ink.h"
#include "lines/links.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"
#include "unit/common/line_pieces.h"

TEST_ARENA(1u << 30)

/* ---- links ---- */

static struct zr_segment segment(double x0, double y0, double x1, double y1, uint32_t class)
{
    return (struct zr_segment){{{x0, y0, 0}, {x1, y1, 0}}, class};
}

static struct zr_links link_segments(const struct zr_segment *segments, uint32_t count)
{
    struct zr_links links;
    assert_int_equal(zr_links_make(&arena, NULL, segments, count, &links), ZR_OK);
    return links;
}

TEST(the_straightest_pair_of_a_class_is_linked)
{
    const struct zr_segment at_node[] = {segment(0, 0, 5, 0, 0), segment(5, 0, 10, 1, 0), segment(5, 0, 5, 5, 0),
                                         segment(5, 0, 10, 0, 1)};
    const struct zr_links links = link_segments(at_node, 4);
    assert_int_equal(links.ends[1], 2);
    assert_int_equal(links.ends[2], 1);
    assert_int_equal(links.ends[4], ZR_NO_END);
    assert_int_equal(links.ends[6], ZR_NO_END);
}

TEST(two_ends_are_linked_at_any_turn_within_a_thirty_second_of_a_pixel)
{
    const struct zr_segment near[] = {segment(0, 0, 5, 0, 0), segment(5.03, 0, 0, 0.5, 0)},
                            far[] = {segment(0, 0, 5, 0, 0), segment(5.04, 0, 0, 0.5, 0)};
    assert_int_equal(link_segments(near, 2).ends[1], 2);
    assert_int_equal(link_segments(far, 2).ends[1], ZR_NO_END);
}

TEST(a_ring_is_walked_once)
{
    const struct zr_segment ring[] = {segment(0, 0, 5, 0, 0), segment(5, 5, 5, 0, 0), segment(0, 0, 5, 5, 0)};
    const struct zr_links links = link_segments(ring, 3);
    const uint32_t first = zr_links_first(&links, 1);
    uint32_t count = 0, end = first;
    do {
        end = zr_links_next(&links, end);
        count++;
    } while (end != first && count < 9);
    assert_int_equal(count, 3);
}

/* ---- steps of contours ---- */

enum { PIECES_MOST = 16 };

/* A contour along y = 50 from x = 10 on, in pieces of 4 pixels with these steps. */
static struct zr_line_pieces contour(const float *steps, uint32_t count)
{
    struct zr_line_pieces pieces = {.count = count, .at = zr_arena_zero(&arena, count, sizeof *pieces.at)};
    for (uint32_t i = 0; i < count; i++)
        pieces.at[i] = (struct zr_line_piece){.ends = {{10 + 4.0 * i, 50, 0}, {14 + 4.0 * i, 50, 0}},
                                              .kind = ZR_LINE_CONTOUR,
                                              .step = steps[i],
                                              .step_most = steps[i],
                                              .is_at_background = steps[i] == HUGE_VALF};
    return pieces;
}

/* Applies the steps and writes which pieces are left: "xx.x". */
static const char *left_of(struct zr_line_pieces pieces)
{
    static char text[PIECES_MOST + 1];
    const struct zr_cells cells = {.columns = 20, .rows = 20};
    assert_int_equal(zr_contour_steps_apply(&arena, NULL, &cells, &pieces), ZR_OK);
    assert_true(pieces.count <= PIECES_MOST);
    for (uint32_t i = 0; i < pieces.count; i++)
        text[i] = pieces.at[i].is_dropped ? '.' : 'x';
    text[pieces.count] = 0;
    return text;
}

#define LEFT_OF(...)                                                                                                   \
    left_of(contour((const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / sizeof(float)))

TEST(a_contour_without_a_step_goes)
{
    assert_string_equal(LEFT_OF(0, 0, 0, 0), "....");
    assert_string_equal(LEFT_OF(2, 2, 3, 3), "....");
    assert_string_equal(LEFT_OF(2, 2, 5, 2), "xxxx");
}

TEST(a_short_contour_goes_unless_it_is_at_the_background)
{
    assert_string_equal(LEFT_OF(9, 9), "..");
    assert_string_equal(LEFT_OF(9, HUGE_VALF), "xx");
}

TEST(runs_without_a_step_go_at_ends_and_where_they_are_long)
{
    assert_string_equal(LEFT_OF(9, 9, 9, 0), "xxx.");
    assert_string_equal(LEFT_OF(9, 9, 9, 0, 9, 9, 9), "xxxxxxx");
    assert_string_equal(LEFT_OF(9, 9, 9, 0, 0, 9, 9, 9), "xxx..xxx");
}

TEST(a_small_gap_is_bridged)
{
    struct zr_line_pieces pieces = contour((const float[]){9, 9, 9, 9, 9}, 5);
    pieces.at[2].is_dropped = true;
    assert_string_equal(left_of(pieces), "xx.xxx"); /* the last one is the bridge: 8 pixels on each side are too few */
}

/* ---- strokes ---- */

enum { SIDE = 64 };

static float opacity[SIDE * SIDE];

static void draw_strokes(struct zr_line_piece *pieces, uint32_t count, float w)
{
    const struct zr_polylines lines = join(&arena, pieces, count);
    assert_int_equal(zr_strokes_draw(&(struct zr_run){.arena = &arena}, &lines, w, SIDE, SIDE, opacity), ZR_OK);
}

static float at(int x, int y)
{
    return opacity[y * SIDE + x];
}

TEST(a_stroke_covers_by_distance_and_joints_are_no_darker)
{
    struct zr_line_piece pieces[] = {piece(10, 20.5, 30, 20.5, ZR_LINE_BORDER),
                                     piece(30, 20.5, 30.5, 50, ZR_LINE_BORDER)};
    draw_strokes(pieces, 2, 2.0f);
    assert_true(at(20, 20) == 1.0f && at(20, 21) == 0.5f && at(20, 19) == 0.5f && at(20, 22) == 0.0f);
    assert_true(at(5, 20) == 0.0f && at(8, 20) == 0.0f);
    assert_true(at(30, 20) == 1.0f && at(31, 19) < 0.5f);
}

TEST(thin_strokes_are_pale)
{
    struct zr_line_piece pieces[] = {piece(10, 20.5, 40, 20.5, ZR_LINE_BORDER)};
    draw_strokes(pieces, 1, 0.5f);
    assert_true(at(20, 20) == 0.5f && at(20, 21) == 0.0f);
}

TEST(hidden_strokes_are_dashed)
{
    struct zr_line_piece pieces[] = {piece(5, 20.5, 58, 20.5, ZR_LINE_BORDER)};
    pieces[0].is_hidden = true;
    draw_strokes(pieces, 1, 2.0f); /* width 1, dashes of 8 and gaps of 5 pixels */
    int runs = 0;
    for (int x = 1; x < SIDE; x++)
        runs += at(x, 20) == 0.5f && at(x - 1, 20) != 0.5f;
    assert_int_equal(runs, 5);
    assert_true(at(6, 20) == 0.5f && at(15, 20) == 0.0f && at(19, 20) == 0.5f);
}

TEST(strokes_beyond_the_window_are_cut)
{
    struct zr_line_piece pieces[] = {piece(-8, -8, 72, 72, ZR_LINE_BORDER), piece(-8, 30, -3, 90, ZR_LINE_BORDER)};
    draw_strokes(pieces, 2, 1.0f);
    assert_true(at(0, 0) == 1.0f && at(63, 63) == 1.0f && at(0, 40) == 0.0f);
}

TEST(widths_grow_with_the_window)
{
    assert_true(zr_stroke_width(0, 640, 480) == 1.5f);
    assert_true(zr_stroke_width(0, 1920, 4000) == 3.0f);
    assert_true(zr_stroke_width(0, 64, 64) == 1.0f);
    assert_true(zr_stroke_width(2.5f, 640, 480) == 2.5f);
}

/* ---- ink ---- */

TEST(ink_is_laid_over_stored_values)
{
    const float half[] = {0.5f, 0.0f, 1.0f, 0.5f}; /* one column, from the lowest pixel */
    uint8_t pixels[4][4] = {{0, 0, 0, 0}, {200, 100, 0, 255}, {7, 8, 9, 10}, {255, 255, 255, 255}};
    zr_ink_lay(&(struct zr_run){.arena = NULL}, half, (zr_vec3){0, 0.2f, 1}, 1, 4, &pixels[0][0]);
    assert_memory_equal(pixels[0], ((const uint8_t[]){0, 51, 255, 128}), 4);
    assert_memory_equal(pixels[1], ((const uint8_t[]){0, 51, 255, 255}), 4);
    assert_memory_equal(pixels[2], ((const uint8_t[]){7, 8, 9, 10}), 4);
    assert_memory_equal(pixels[3], ((const uint8_t[]){128, 153, 255, 255}), 4);
}

/* ---- whole drawings ---- */

static float *draw_model(struct zr_team *team, const struct zr_scene *scene, uint32_t width, uint32_t height)
{
    struct zr_view view = scene->views[0];
    struct zr_camera camera;
    struct zr_error error = {0};
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    struct zr_drawing drawing;
    float *out = zr_arena_alloc(&arena, (size_t)width * height, sizeof *out);
    view.width = width;
    view.height = height;
    assert_int_equal(zr_camera_resolve(&(struct zr_run){.error = &error}, scene, &view, &bounds, &camera), ZR_OK);
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = &bounds,
                                         .width = width,
                                         .height = height,
                                         .rule = {.crease_degrees = 30}};
    assert_int_equal(zr_drawing_make(&(struct zr_run){.arena = &arena, .team = team}, &desc, &drawing), ZR_OK);
    assert_int_equal(zr_strokes_draw(&(struct zr_run){.arena = &arena, .team = team}, &drawing.polylines,
                                     zr_stroke_width(0, width, height), width, height, out),
                     ZR_OK);
    return out;
}

/* Erases the ink that is connected to a pixel; returns its pixels. */
static uint32_t erase(float *ink, int width, int height, int x, int y, uint32_t *stack)
{
    uint32_t count = 0, depth = 0;
    ink[y * width + x] = 0.0f;
    stack[depth++] = (uint32_t)(y * width + x);
    while (depth > 0) {
        const int pixel = (int)stack[--depth];
        count++;
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                const int px = pixel % width + dx, py = pixel / width + dy;
                if (px < 0 || py < 0 || px >= width || py >= height || ink[py * width + px] <= 0.0f) continue;
                ink[py * width + px] = 0.0f;
                stack[depth++] = (uint32_t)(py * width + px);
            }
    }
    return count;
}

static uint32_t specks_of(float *ink, int width, int height)
{
    uint32_t *stack = zr_arena_alloc(&arena, (size_t)width * (size_t)height, sizeof *stack), specks = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            if (ink[y * width + x] > 0.0f) specks += erase(ink, width, height, x, y, stack) < 12;
    return specks;
}

/* True if a polyline of the drawing passes near a point, given as shares of the window. */
static bool passes(const struct zr_polylines *lines, double x, double y, double near)
{
    for (uint32_t i = 0; i < lines->count; i++)
        for (uint32_t k = 1; k < lines->at[i].count; k++) {
            const double *p = lines->points[lines->at[i].first + k - 1], *q = lines->points[lines->at[i].first + k];
            const double dx = q[0] - p[0], dy = q[1] - p[1], square = dx * dx + dy * dy;
            double t = square > 0.0 ? ((x - p[0]) * dx + (y - p[1]) * dy) / square : 0.0;
            t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
            if (hypot(x - p[0] - t * dx, y - p[1] - t * dy) <= near) return true;
        }
    return false;
}

/* A rib slopes down to an end 0.02 above a plate: a crease of 41 degrees, seen from above, and a contour. It is a line
 * wherever it has 12 pixels. */
TEST(edges_between_faces_that_differ_are_lines_in_any_window)
{
    static const char text[] =
        "v -1.5 0 -1\nv 1.5 0 -1\nv 1.5 0.22 -1\nv -1.5 0.22 -1\nv -1.5 0 1\nv 1.5 0 1\nv 1.5 0.22 1\nv -1.5 0.22 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"
        "v 0.6 0.1 -0.1\nv 1.3 0.1 -0.1\nv 1.3 0.24 -0.1\nv 0.72 0.9 -0.1\n"
        "v 0.6 0.1 0.1\nv 1.3 0.1 0.1\nv 1.3 0.24 0.1\nv 0.72 0.9 0.1\n"
        "f 9 12 11 10\nf 13 14 15 16\nf 9 10 14 13\nf 12 16 15 11\nf 9 13 16 12\nf 10 11 15 14\n";
    static const uint32_t widths[] = {200, 240, 320, 480, 640, 700, 1000, 1600};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        const struct zr_scene *scene = model_of_text(&arena, text, "technical");
        const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
        const double side = (double)widths[i];
        struct zr_view view = scene->views[0];
        struct zr_camera camera;
        struct zr_error error = {0};
        struct zr_drawing drawing;
        view.width = view.height = widths[i];
        view.pose = ZR_POSE_DIRECTION;
        view.direction = (zr_vec3){0, -1, 0};
        view.up = (zr_vec3){0, 0, -1};
        view.projection = ZR_PROJECTION_ORTHOGRAPHIC;
        assert_int_equal(zr_camera_resolve(&(struct zr_run){.error = &error}, scene, &view, &bounds, &camera), ZR_OK);
        const struct zr_drawing_desc desc = {.scene = scene,
                                             .camera = &camera,
                                             .bounds = &bounds,
                                             .width = widths[i],
                                             .height = widths[i],
                                             .rule = {.crease_degrees = 30}};
        assert_int_equal(zr_drawing_make(&(struct zr_run){.arena = &arena}, &desc, &drawing), ZR_OK);
        const double scale = 0.5 * side * (double)camera.projection.m[0]; /* pixels per unit */
        if (!passes(&drawing.polylines, 0.5 * side + 1.3 * scale, 0.5 * side, 0.5)) fail_msg("at %u", widths[i]);
    }
}

TEST(models_have_hardly_any_specks)
{
    static const struct {
        const char *name;
        uint32_t most;
    } rows[] = {{"parts/gear.obj", 0}, {"parts/housing.obj", 0},  {"parts/plate.obj", 0},
                {"beetle.obj", 1},     {"stanford-bunny.obj", 1}, {"suzanne.obj", 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct zr_scene *scene = model_of_file(&arena, rows[i].name, "technical");
        if (!scene) return;
        const uint32_t specks = specks_of(draw_model(NULL, scene, 640, 480), 640, 480);
        print_message("%s: %u connected lines below 12 pixels\n", rows[i].name, specks);
        assert_true(specks <= rows[i].most);
    }
}

TEST(threads_draw_the_same)
{
    const struct zr_scene *scene = model_of_file(&arena, "parts/housing.obj", "technical");
    if (!scene) scene = model_of_text(&arena, CUBE_CORNERS CUBE_SIDES, "technical");
    struct zr_team *team = zr_team_create(4);
    assert_memory_equal(draw_model(NULL, scene, 320, 240), draw_model(team, scene, 320, 240),
                        320 * 240 * sizeof(float));
    zr_team_destroy(team);
}

/* ---- scenes of all kinds ---- */

static float *draw_json(const char *text)
{
    float *ink = draw_model(NULL, model_of_text(&arena, text, NULL), 100, 80);
    for (int i = 0; i < 100 * 80; i++)
        if (!(ink[i] >= 0.0f && ink[i] <= 1.0f)) fail_msg("ink of %g", (double)ink[i]);
    return ink;
}

static bool has_ink(const float *ink)
{
    for (int i = 0; i < 100 * 80; i++)
        if (ink[i] > 0.0f) return true;
    return false;
}

TEST(scenes_without_faces_have_no_lines)
{
    assert_false(has_ink(draw_json("{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"points\": [0,1,2]}]}")));
    assert_false(
        has_ink(draw_json("{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[2,0,0]], \"faces\": [[0,1,2]]}]}")));
}

TEST(a_triangle_and_its_mirrored_instance_have_lines)
{
    assert_true(has_ink(draw_json("{\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}")));
    assert_true(has_ink(draw_json("{\"meshes\": [{\"name\": \"t\", \"positions\": [[0,0,0],[1,0,0],[0,1,0]], "
                                  "\"faces\": [[0,1,2]]}], \"nodes\": [{\"mesh\": \"t\", \"scale\": [-1,1,1]}]}")));
}

/* Triangles between few corners, which repeat, are far away, or all but coincide; seen from outside and from within. */
TEST(any_triangles_can_be_drawn)
{
    static const double values[] = {0, 1, -1, 1.0000001, 1e5, -1e5, 1e-7, 0.5};
    static char text[1 << 16];
    struct random numbers = random_seeded(11);
    for (int round = 0; round < 60; round++) {
        size_t used =
            (size_t)snprintf(text, sizeof text, "{\"view\": {%s}, \"meshes\": [{\"positions\": [",
                             round % 3 == 0   ? "\"preset\": \"isometric\""
                             : round % 3 == 1 ? "\"eye\": [0.2,0.1,0.3], \"target\": [1,0,0]"
                                              : "\"eye\": [3,2,4], \"target\": [0,0,0], \"znear\": 3, \"zfar\": 6");
        const uint32_t kinds = round % 2 ? 3 : sizeof values / sizeof *values;
        for (int i = 0; i < 30; i++)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s[%.9g,%.9g,%.9g]", i ? "," : "",
                                     values[random_below(&numbers, kinds)], values[random_below(&numbers, kinds)],
                                     values[random_below(&numbers, kinds)]);
        used += (size_t)snprintf(text + used, sizeof text - used, "], \"faces\": [");
        for (int i = 0; i < 200; i++)
            used +=
                (size_t)snprintf(text + used, sizeof text - used, "%s[%u,%u,%u]", i ? "," : "",
                                 random_below(&numbers, 30), random_below(&numbers, 30), random_below(&numbers, 30));
        snprintf(text + used, sizeof text - used, "]}]}");
        draw_json(text);
    }
}

TEST(a_raised_cancel_ends_it)
{
    const struct zr_scene *scene = model_of_text(&arena, CUBE_CORNERS CUBE_SIDES, NULL);
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    struct zr_cancel cancel = {.raised = true};
    struct zr_camera camera = {.world_to_eye = zr_mat4_identity(), .projection = zr_mat4_identity()};
    struct zr_drawing drawing;
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = &bounds,
                                         .width = 64,
                                         .height = 64,
                                         .rule = {.crease_degrees = 30}};
    assert_int_equal(zr_drawing_make(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &desc, &drawing),
                     ZR_CANCELLED);
}

TEST(a_full_arena_is_told)
{
    const struct zr_scene *scene = model_of_text(&arena, CUBE_CORNERS CUBE_SIDES, NULL);
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    struct zr_camera camera = {.world_to_eye = zr_mat4_identity(), .projection = zr_mat4_identity()};
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = &bounds,
                                         .width = 64,
                                         .height = 64,
                                         .rule = {.crease_degrees = 30}};
    static _Alignas(ZR_ARENA_ALIGN) char room[1 << 22];
    uint32_t made = 0;
    for (size_t size = 1 << 10; size <= sizeof room; size += 1 << 14) {
        struct zr_arena small;
        struct zr_drawing drawing;
        zr_arena_init_within(&small, room, size);
        const enum zr_status status = zr_drawing_make(&(struct zr_run){.arena = &small}, &desc, &drawing);
        assert_true(status == ZR_OK || status == ZR_NO_MEMORY);
        made += status == ZR_OK;
    }
    assert_true(made > 0);
}

RUN_TESTS(open_arena, close_arena)
