/* Views through a lens: rays, the pinhole picture behind them, and what pixels take from it. */
#include <math.h>
#include <string.h>

#include "base/rgba.h"
#include "base/run.h"
#include "render/lens.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

/* ---- the model: OpenCV's formulas, by libm ---- */

struct point {
    double x, y;
};

static struct point distort(const struct zr_lens *lens, struct point at)
{
    const double *k = lens->k, p1 = lens->p[0], p2 = lens->p[1], s = at.x * at.x + at.y * at.y;
    if (lens->model == ZR_LENS_FISHEYE) {
        const double r = sqrt(s), a = atan(r), b = a * a;
        const double scale =
            r > 0.0 ? a * (1 + k[0] * b + k[1] * pow(b, 2) + k[2] * pow(b, 3) + k[3] * pow(b, 4)) / r : 1;
        return (struct point){at.x * scale, at.y * scale};
    }
    const double g =
        (1 + k[0] * s + k[1] * s * s + k[2] * pow(s, 3)) / (1 + k[3] * s + k[4] * s * s + k[5] * pow(s, 3));
    return (struct point){at.x * g + 2 * p1 * at.x * at.y + p2 * (s + 2 * at.x * at.x),
                          at.y * g + p1 * (s + 2 * at.y * at.y) + 2 * p2 * at.x * at.y};
}

static const struct zr_lens lenses[] = {
    {ZR_LENS_OPENCV, {0}, {0}},
    {ZR_LENS_OPENCV, {-0.28, 0.07, 0.01}, {0}},
    {ZR_LENS_OPENCV, {0.12, 0.05}, {0}},
    {ZR_LENS_OPENCV, {-0.05, 0.01}, {0.02, -0.015}},
    {ZR_LENS_OPENCV, {3.2, 1.4, 0.06, 3.5, 2.6, 0.4}, {0.0003, 0.0002}},
    {ZR_LENS_OPENCV, {-0.3, 0.35, -0.05}, {0.001, 0.002}},
    {ZR_LENS_FISHEYE, {0}, {0}},
    {ZR_LENS_FISHEYE, {-0.02, 0.004, -0.001, 0.0002}, {0}},
    {ZR_LENS_FISHEYE, {0.2, -0.1, 0.05, -0.01}, {0}},
};
enum { LENSES = sizeof lenses / sizeof *lenses };

TEST(ray_is_distorted_to_its_point_and_has_the_slopes_there)
{
    static struct zr_lens_inverse inverse;
    for (int i = 0; i < LENSES; i++) {
        int rays = 0;
        zr_lens_invert(&lenses[i], &inverse);
        for (double y = -0.8; y <= 0.8; y += 0.05)
            for (double x = -0.8; x <= 0.8; x += 0.05) {
                const double step = 1e-6;
                const struct zr_lens_ray ray = zr_lens_undistort(&inverse, x, y);
                if (ray.end != ZR_LENS_RAY) continue;
                const struct point at = distort(&lenses[i], (struct point){ray.x, ray.y}),
                                   right = distort(&lenses[i], (struct point){ray.x + step, ray.y}),
                                   below = distort(&lenses[i], (struct point){ray.x, ray.y + step});
                assert_true(fabs(at.x - x) + fabs(at.y - y) < 1e-12);
                assert_true(fabs((right.x - at.x) / step - ray.xx) < 1e-4 * (1 + fabs(ray.xx)));
                assert_true(fabs((below.x - at.x) / step - ray.xy) < 1e-4 * (1 + fabs(ray.xy)));
                assert_true(fabs((below.y - at.y) / step - ray.yy) < 1e-4 * (1 + fabs(ray.yy)));
                rays++;
            }
        assert_true(rays > 500);
    }
}

TEST(points_of_undistorted_rays_are_found_again_up_to_the_end_of_the_lens)
{
    static struct zr_lens_inverse inverse;
    for (int i = 0; i < LENSES; i++) {
        zr_lens_invert(&lenses[i], &inverse);
        const bool is_fisheye = lenses[i].model == ZR_LENS_FISHEYE;
        for (int turn = 0; turn < 12; turn++)
            for (int k = 1; k < 50; k++) {
                const double t = inverse.most * k / 50, r = is_fisheye ? tan(t) : t;
                const struct point at = {r * cos(turn), r * sin(turn)};
                const struct point to = distort(&lenses[i], at);
                const struct zr_lens_ray ray = zr_lens_undistort(&inverse, to.x, to.y);
                /* p1 and p2 end some rays before the end of the radial part. */
                if (lenses[i].p[0] != 0 && (ray.end != ZR_LENS_RAY || k > 30)) continue;
                assert_int_equal(ray.end, ZR_LENS_RAY);
                assert_true(hypot(ray.x - at.x, ray.y - at.y) < 1e-9 * (1 + r));
            }
    }
}

TEST(lens_without_end_ends_at_80_degrees_and_others_at_their_fold)
{
    static const struct zr_lens barrel = {ZR_LENS_OPENCV, {-0.5}, {0}}, pole = {ZR_LENS_OPENCV, {0, 0, 0, -1}, {0}};
    static struct zr_lens_inverse inverse;
    zr_lens_invert(&lenses[0], &inverse);
    assert_false(inverse.is_folded);
    assert_true(fabs(inverse.most - tan(80 * 3.14159265358979 / 180)) < 1e-12);
    assert_int_equal(zr_lens_undistort(&inverse, 5.7, 0).end, ZR_LENS_WIDE);
    zr_lens_invert(&lenses[6], &inverse);
    assert_true(fabs(inverse.far - 80 * 3.14159265358979 / 180) < 1e-12);
    zr_lens_invert(&barrel, &inverse); /* r (1 - r^2 / 2) rises up to r^2 = 2/3 */
    assert_true(inverse.is_folded && fabs(inverse.most - sqrt(2.0 / 3)) < 1e-9);
    assert_int_equal(zr_lens_undistort(&inverse, inverse.far * 0.9999, 0).end, ZR_LENS_RAY);
    assert_int_equal(zr_lens_undistort(&inverse, inverse.far * 1.0001, 0).end, ZR_LENS_FOLDED);
    zr_lens_invert(&pole, &inverse); /* r / (1 - r^2) */
    assert_true(inverse.is_folded && fabs(inverse.most - 1) < 1e-6);
}

/* ---- pictures ---- */

#define MESHES                                                                                                         \
    "\"materials\":[{\"name\":\"all\",\"doubleSided\":true}],\"meshes\":[{\"name\":\"hill\",\"material\":\"all\","     \
    "\"heights\":[[0,0.2,0.1,0.4],[0.3,0.9,0.5,0.2],[0.1,0.6,0.8,0.3],[0,0.4,0.1,0.2]],\"colormap\":\"viridis\"},"     \
    "{\"name\":\"box\",\"material\":\"all\",\"positions\":[[0,0,0],[3,0,0],[0,3,0],[0,0,3]],\"texcoords\":[[0,0],"     \
    "[1,0],[0,1],[1,1]],\"faces\":[[0,2,1],[0,1,3],[1,2,3],[0,3,2]]}],"
#define VIEW                                                                                                           \
    "\"window\":{\"width\":75,\"height\":58},\"view\":{\"eye\":[1.2,1.9,4.6],\"target\":[1.4,0.9,1.5],"                \
    "\"intrinsics\":{\"fx\":50,\"fy\":54,\"cx\":35.5,\"cy\":30,\"skew\":0.7}"
#define OUTPUTS                                                                                                        \
    "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\"},{\"channel\":\"windowDepth\"},{\"channel\":"         \
    "\"faceId\"},{\"channel\":\"distance\"},{\"channel\":\"instanceId\"},{\"channel\":\"frontFacing\"},{\"channel\":"  \
    "\"barycentrics\"},{\"channel\":\"position\",\"space\":\"world\"},{\"channel\":\"normals\"},{\"channel\":"         \
    "\"texcoord\"},{\"channel\":\"layers\"},{\"channel\":\"thickness\"},{\"channel\":\"info\"},"                       \
    "{\"channel\":\"fragments\",\"x\":30,\"y\":29}]"
#define SCENE(distortion, look) "{" VIEW distortion "}," MESHES OUTPUTS ",\"look\":\"" look "\"}"
#define BARREL                  ",\"distortion\":[-0.25,0.08,0.001,-0.002,-0.01]"
#define PINCUSHION              ",\"distortion\":{\"k\":[0.3,0.1]}"
#define FISHEYE                 ",\"distortion\":{\"model\":\"fisheye\",\"k\":[0.02,-0.01]}"

TEST_ARENA((size_t)1 << 30)

static const struct zr_frame *frame_of(const char *text, struct reading **reading)
{
    *reading = read_scene(text);
    if ((*reading)->status != ZR_OK) fail_msg("%s: %s", text, (*reading)->error.items[0].detail);
    return scene_render(&arena, NULL, (*reading)->scene);
}

TEST_AROUND(lens_without_distortion_gives_the_same_bytes_in_every_channel, open_arena, close_arena)
{
    static const char *const texts[][3] = {{SCENE("", "textbook"), SCENE(",\"distortion\":[]", "textbook"),
                                            SCENE(",\"distortion\":{\"k\":[0,0]}", "textbook")},
                                           {SCENE("", "studio"), SCENE(",\"distortion\":[0,0,0,0,0]", "studio"),
                                            SCENE(",\"distortion\":{\"p\":[0,0]}", "studio")},
                                           {SCENE("", "technical"), SCENE(",\"distortion\":[0,0,0,0]", "technical"),
                                            SCENE(",\"distortion\":{\"k\":[]}", "technical")}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (int k = 1; k < 3; k++) {
            struct reading *a, *b;
            const struct zr_frame *plain = frame_of(texts[i][0], &a), *through = frame_of(texts[i][k], &b);
            assert_int_equal(b->scene->views[0].lens.model, ZR_LENS_OPENCV);
            for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
                if (plain->channels[c])
                    assert_memory_equal(plain->channels[c], through->channels[c],
                                        (size_t)75 * 58 * 4 * zr_channel_rows[c].words);
            assert_int_equal(plain->fragments.count, through->fragments.count);
            assert_true(plain->fragments.count > 0);
            if (i == 0) assert_int_equal(plain->covered_pixels, through->covered_pixels);
            assert_true(plain->deepest == through->deepest);
            reading_free(a);
            reading_free(b);
        }
}

/* Returns the frame of the pinhole picture behind a lens. */
static const struct zr_frame *pinhole_of(const struct zr_scene *scene, const struct zr_resolved_view **resolved)
{
    struct zr_lens_drawing *drawing = zr_arena_zero(&arena, 1, sizeof *drawing);
    const struct zr_frame *frame;
    struct zr_error error = {.count = 0};
    assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, scene, resolved), ZR_OK);
    zr_lens_drawing_open(scene, *resolved, drawing);
    struct zr_output outputs[16];
    memcpy(outputs, scene->views[0].outputs, scene->views[0].output_count * sizeof *outputs);
    drawing->scene.views[0].outputs = outputs;
    drawing->scene.views[0].output_count--; /* fragments */
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &drawing->scene, &drawing->resolved, &frame),
        ZR_OK);
    return frame;
}

/* Returns the pixel of a place, which is rounded to 1/4096 pixel first. */
static size_t nearest(double place)
{
    return (size_t)(floor((place - 0.5) * 4096 + 0.5) / 4096 + 0.5);
}

TEST_AROUND(every_word_of_data_is_that_of_the_pinhole_picture_at_the_ray, open_arena, close_arena)
{
    static const char *const texts[] = {SCENE(BARREL, "studio"), SCENE(PINCUSHION, "textbook"),
                                        SCENE(FISHEYE, "textbook"),
                                        SCENE(",\"distortion\":{\"k\":[-1.2]}", "textbook")};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct reading *reading;
        const struct zr_resolved_view *resolved;
        const struct zr_frame *frame = frame_of(texts[i], &reading);
        const struct zr_frame *pinhole = pinhole_of(reading->scene, &resolved);
        uint64_t without = 0;
        for (uint32_t y = 0; y < frame->height; y++)
            for (uint32_t x = 0; x < frame->width; x++) {
                const struct zr_lens_ray ray = zr_lens_look_up(resolved->lens, x + 0.5, y + 0.5);
                const size_t pixel = (size_t)y * frame->width + x;
                const size_t from = ray.end == ZR_LENS_RAY ? nearest(ray.y) * pinhole->width + nearest(ray.x) : 0;
                without += ray.end != ZR_LENS_RAY;
                for (int c = ZR_CHANNEL_COLOR + 1; c < ZR_CHANNEL_COUNT; c++) {
                    const struct zr_channel_row *row = &zr_channel_rows[c];
                    const uint32_t *words = frame->channels[c], *source = pinhole->channels[c];
                    for (uint32_t k = 0; words && k < row->words; k++)
                        assert_int_equal(words[pixel * row->words + k],
                                         ray.end == ZR_LENS_RAY ? source[from * row->words + k] : row->clear_value);
                }
            }
        assert_int_equal(without, frame->pixels_without_ray);
        assert_true((i == 3) == (without > 0));
        assert_int_equal(frame->camera.projection.m[0] != pinhole->camera.projection.m[0], 1);
        reading_free(reading);
    }
}

TEST_AROUND(fragments_are_those_of_the_ray_and_carry_the_pixel_of_the_view, open_arena, close_arena)
{
    struct reading *reading;
    const struct zr_frame *frame = frame_of(SCENE(FISHEYE, "textbook"), &reading);
    const size_t pixel = 29 * 75 + 30;
    assert_true(frame->fragments.x == 30 && frame->fragments.y == 29 && frame->fragments.count > 0);
    assert_true(frame->fragments.at[0].depth == frame->depth[pixel]);
    assert_int_equal(frame->fragments.at[0].face_id, frame->face_id[pixel]);
    reading_free(reading);
    frame = frame_of("{" VIEW ",\"distortion\":{\"k\":[-5]}}," MESHES
                     "\"outputs\":[{\"channel\":\"fragments\",\"x\":0,\"y\":1}]}",
                     &reading);
    assert_true(frame->fragments.x == 0 && frame->fragments.y == 1 && frame->fragments.count == 0);
    reading_free(reading);
}

TEST_AROUND(wide_rays_and_large_pinhole_pictures_are_refused_by_name, open_arena, close_arena)
{
    static const struct {
        const char *view, *message;
    } cases[] = {{"\"intrinsics\":{\"fx\":30},\"distortion\":{\"model\":\"fisheye\"}",
                  "the ray of pixel 0, 0 is more than 80 degrees from the axis of the lens"},
                 {"\"intrinsics\":{\"fx\":3000},\"distortion\":[80,0,0,0]", NULL},
                 {"\"intrinsics\":{\"fx\":400,\"cx\":1e6},\"distortion\":{\"k\":[-0.001]}",
                  "the ray of pixel 0, 0 is more than"},
                 {"\"intrinsics\":{\"fx\":1560},\"distortion\":{\"model\":\"fisheye\"}", "need a pinhole picture of"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        const int side = i == 3 ? 3000 : 90;
        const struct zr_resolved_view *resolved;
        struct zr_error error = {.count = 0};
        snprintf(text, sizeof text,
                 "{\"window\":{\"width\":%d,\"height\":%d},\"view\":{\"eye\":[0,0,5],\"target\":[0,0,0],%s},"
                 "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}",
                 side, side, cases[i].view);
        struct reading *reading = read_scene(text);
        assert_int_equal(reading->status, ZR_OK);
        const enum zr_status status =
            zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, reading->scene, &resolved);
        if (!cases[i].message) {
            assert_int_equal(status, ZR_OK);
        } else {
            assert_int_equal(status, ZR_BAD_SCENE);
            assert_string_equal(error.items[0].pointer, "/view/distortion");
            if (!strstr(error.items[0].detail, cases[i].message)) fail_msg("%s", error.items[0].detail);
        }
        reading_free(reading);
    }
}

TEST_AROUND(only_views_with_a_lens_are_charged_for_one, open_arena, close_arena)
{
    struct reading *plain = read_scene(SCENE("", "textbook")), *through = read_scene(SCENE(FISHEYE, "textbook"));
    const struct zr_cost a = scene_cost(plain->scene), b = scene_cost(through->scene);
    assert_true(a.counts[ZR_COST_LENS_PIXEL] == 0 && b.counts[ZR_COST_LENS_PIXEL] == 75 * 58);
    assert_true(b.window_bytes > a.window_bytes && b.ms > a.ms);
    reading_free(plain);
    reading_free(through);
}

/* ---- colours ---- */

#define AT(x, y)                                                                                                       \
    {                                                                                                                  \
        (int32_t)((x)*ZR_REMAP_ONE), (int32_t)((y)*ZR_REMAP_ONE)                                                       \
    }

static uint32_t rgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a)
{
    const uint8_t bytes[4] = {(uint8_t)r, (uint8_t)g, (uint8_t)b, (uint8_t)a};
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

/* Returns the colour of one pixel of the view. */
static uint32_t color_at(const uint32_t source[6], double x, double y)
{
    const struct zr_remap_place place = AT(x, y);
    const struct zr_remap remap = {1, 1, 3, 2, &place, 0};
    uint32_t out;
    assert_int_equal(zr_remap_color(&(struct zr_run){.arena = NULL}, &remap, 77, source, &out), ZR_OK);
    return out;
}

TEST(colors_are_mixed_by_distance_and_by_alpha)
{
    const uint32_t a = rgba(10, 20, 30, 255), b = rgba(20, 40, 60, 255), c = rgba(200, 100, 0, 0),
                   d = rgba(100, 200, 50, 128), source[6] = {a, b, c, a, a, d};
    assert_int_equal(color_at(source, 1, 0), b);
    assert_int_equal(color_at(source, 2, 0), c);
    assert_int_equal(color_at(source, 2, 1), d);
    assert_int_equal(color_at(source, 0.5, 0), rgba(15, 30, 45, 255));
    assert_int_equal(color_at(source, 0.25, 0), rgba(13, 25, 38, 255));
    assert_int_equal(color_at(source, 0.5, 0.5), rgba(13, 25, 38, 255));
    assert_int_equal(color_at(source, 1.5, 0), rgba(20, 40, 60, 128)); /* c is transparent */
    assert_int_equal(color_at(source, 2, 0.5), rgba(100, 200, 50, 64));
    assert_int_equal(color_at(source, 1.5, 1),
                     rgba((10 * 255 + 100 * 128 + 191) / 383, (20 * 255 + 200 * 128 + 191) / 383,
                          (30 * 255 + 50 * 128 + 191) / 383, 192));
}

TEST(pixels_without_a_ray_are_clear_and_shrunk_ones_are_means)
{
    const uint32_t a = rgba(0, 0, 0, 255), b = rgba(255, 255, 255, 255);
    uint32_t source[64], out[4], ids[4];
    const struct zr_remap_place places[4] = {AT(1.5, 1.5), AT(5.5, 1.5), AT(1.5, 5.5), {ZR_REMAP_NOWHERE, 0}};
    const struct zr_remap remap = {2, 2, 8, 8, places, 1};
    for (uint32_t i = 0; i < 64; i++)
        source[i] = (i + i / 8) % 2 ? a : b; /* a chess board */
    assert_int_equal(zr_remap_color(&(struct zr_run){.arena = NULL}, &remap, 77, source, out), ZR_OK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(out[i], rgba(128, 128, 128, 255));
    assert_int_equal(out[3], 77);
    for (uint32_t i = 0; i < 64; i++)
        source[i] = i;
    assert_int_equal(zr_remap_nearest(&(struct zr_run){.arena = NULL}, &remap, 1, 99, source, ids), ZR_OK);
    assert_true(ids[0] == 18 && ids[1] == 22 && ids[2] == 50 && ids[3] == 99);
}

RUN_TESTS(NULL, NULL)
