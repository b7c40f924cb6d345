/* Fragments, layers and what is made of them: lists, blending by hand, masks, thickness, limits. */
#include "render/layer_channels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/rgba.h"
#include "base/run.h"
#include "raster/fragments.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA((size_t)1 << 30)

/* ---- lists ---- */

enum { PLACES = 7, FRAGMENTS = 3000 };

static int compare_keys(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

TEST_AROUND(lists_are_complete_and_sorted_by_depth_and_then_by_owner, open_arena, close_arena)
{
    static uint32_t place[FRAGMENTS], owner[FRAGMENTS];
    static float depth[FRAGMENTS];
    struct random random = random_seeded(3);
    struct zr_fragments fragments = {.ends = NULL};
    for (int i = 0; i < FRAGMENTS; i++) {
        place[i] = random_below(&random, PLACES - 1); /* the last one stays empty */
        depth[i] = (float)random_below(&random, 50) / 49.0f;
        owner[i] = 1 + random_below(&random, 1u << 28);
    }
    assert_true(zr_fragments_begin(&arena, NULL, PLACES, &fragments));
    for (int i = 0; i < FRAGMENTS; i++)
        zr_fragments_put(&fragments, place[i], depth[i], owner[i]);
    assert_true(zr_fragments_prefix_sum(&arena, NULL, &fragments));
    for (int i = 0; i < FRAGMENTS; i++)
        zr_fragments_put(&fragments, place[i], depth[i], owner[i]);
    zr_fragments_sort(NULL, &fragments);
    assert_int_equal(zr_fragments_count(&fragments), FRAGMENTS);
    for (uint32_t p = 0; p < PLACES; p++) {
        static uint64_t want[FRAGMENTS];
        uint32_t wanted = 0, count;
        for (int i = 0; i < FRAGMENTS; i++)
            if (place[i] == p) want[wanted++] = zr_fragment_key(depth[i], owner[i]);
        qsort(want, wanted, sizeof *want, compare_keys);
        const uint64_t *keys = zr_fragments_of(&fragments, p, &count);
        assert_int_equal(count, wanted);
        assert_memory_equal(keys, want, wanted * sizeof *want);
        for (uint32_t i = 1; i < count; i++)
            assert_true(zr_fragment_depth(keys[i - 1]) < zr_fragment_depth(keys[i]) ||
                        (zr_fragment_depth(keys[i - 1]) == zr_fragment_depth(keys[i]) &&
                         zr_fragment_owner(keys[i - 1]) <= zr_fragment_owner(keys[i])));
    }
}

/* ---- pictures ---- */

enum { SIDE = 16, SHEETS = 3 };

static struct test_scene test;
static zr_vec4 positions[3 * SHEETS], colors[3 * SHEETS];
static uint32_t face_materials[SHEETS];
static struct zr_material materials[SHEETS];

/* One triangle over the whole window a sheet, at its depth in clip space, in one colour. */
static void make_sheets(const float depths[SHEETS], const zr_vec4 of[SHEETS], const enum zr_alpha_mode modes[SHEETS])
{
    for (int s = 0; s < SHEETS; s++)
        for (int k = 0; k < 3; k++) {
            positions[3 * s + k] = (zr_vec4){k == 1 ? 4.0f : -1.5f, k == 2 ? 4.0f : -1.5f, depths[s], 1};
            colors[3 * s + k] = of[s];
        }
    scene_of_triangles(&test, SIDE, SIDE, positions, SHEETS);
    for (uint32_t s = 0; s < SHEETS; s++) {
        materials[s] = test.material;
        materials[s].alpha_mode = modes[s];
        materials[s].alpha_cutoff = 0.5f;
        face_materials[s] = s;
    }
    test.mesh.colors = colors;
    test.mesh.face_materials = face_materials;
    test.scene.materials = materials;
    test.scene.material_count = SHEETS;
    test.scene.background = (zr_vec4){1, 1, 1, 1};
}

static const zr_vec4 red = {1, 0, 0, 0.5f}, green = {0, 1, 0, 0.25f}, blue = {0, 0, 1, 1};
static const enum zr_alpha_mode blend_all[SHEETS] = {ZR_ALPHA_BLEND, ZR_ALPHA_BLEND, ZR_ALPHA_BLEND};

/* Of many layers, one tile of which is more than the request may have. */
TEST_AROUND(layers_end_where_memory_does, open_arena, close_arena)
{
    enum { LAYERS = 4000 };
    static zr_vec4 many[3 * LAYERS];
    for (int i = 0; i < 3 * LAYERS; i++)
        many[i] = (zr_vec4){i % 3 == 1 ? 4.0f : -1.5f, i % 3 == 2 ? 4.0f : -1.5f, (float)i / (4.0f * LAYERS), 1};
    scene_of_triangles(&test, 64, 64, many, LAYERS);
    test.material.alpha_mode = ZR_ALPHA_BLEND;
    test.material.base_color.w = 0.5f;
    struct zr_arena small;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    zr_arena_init(&small, (size_t)64 << 20); /* 4000 layers of 4096 pixels take 131 MB */
    assert_int_equal(zr_render(&(struct zr_run){.arena = &small, .error = &error}, &test.scene, NULL, &frame),
                     ZR_NO_MEMORY);
    assert_non_null(strstr(error.items[0].detail, "all layers of translucent surfaces are kept, 8 bytes"));
    zr_arena_free(&small);
    const struct zr_frame *whole = scene_render(&arena, NULL, &test.scene);
    assert_true(whole->covered_pixels == 64 * 64);
}

/* ---- thickness ---- */

/* A body: vertices on a sphere that is stretched and dented, by rings from pole to pole; closed. */
struct body {
    double stretch[3], dent;
    uint32_t rings, around;
    bool has_hole; /* turned inside out, half as large, in its middle */
};

enum { BODY_SIDE = 512, RINGS_MOST = 40, AROUND_MOST = 60, CORNERS_MOST = 2 * (RINGS_MOST + 1) * AROUND_MOST };
static zr_vec4 points[CORNERS_MOST];
static uint32_t faces[12 * CORNERS_MOST], offsets[4 * CORNERS_MOST + 1];

static void point_of(const struct body *body, uint32_t i, uint32_t j, double scale, zr_vec4 *out)
{
    const double t = 3.14159265358979 * i / body->rings, p = 6.28318530717959 * j / body->around;
    const double r = scale * (1.0 + body->dent * sin(3.0 * t) * cos(2.0 * p));
    *out = (zr_vec4){(float)(r * body->stretch[0] * sin(t) * cos(p)), (float)(r * body->stretch[1] * cos(t)),
                     (float)(r * body->stretch[2] * sin(t) * sin(p)), 1};
}

/* Returns how many triangles there are. */
static uint32_t make_shell(const struct body *body, double scale, bool turned, uint32_t first_point, uint32_t count)
{
    for (uint32_t i = 0; i <= body->rings; i++)
        for (uint32_t j = 0; j < body->around; j++)
            /* All points of a pole are one. */
            point_of(body, i, i == 0 || i == body->rings ? 0 : j, scale, &points[first_point + i * body->around + j]);
    for (uint32_t i = 0; i < body->rings; i++)
        for (uint32_t j = 0; j < body->around; j++) {
            const uint32_t k = (j + 1) % body->around, row = first_point + i * body->around, next = row + body->around;
            const uint32_t two[2][3] = {{row + j, row + k, next + k}, {row + j, next + k, next + j}};
            for (int t = 0; t < 2; t++, count++) {
                faces[3 * count] = two[t][0];
                faces[3 * count + 1] = two[t][turned ? 2 : 1];
                faces[3 * count + 2] = two[t][turned ? 1 : 2];
            }
        }
    return count;
}

/* By the divergence theorem. */
static double volume_of(uint32_t triangles)
{
    double sum = 0.0;
    for (uint32_t t = 0; t < triangles; t++) {
        const zr_vec4 *a = &points[faces[3 * t]], *b = &points[faces[3 * t + 1]], *c = &points[faces[3 * t + 2]];
        const double u[3] = {(double)a->x, (double)a->y, (double)a->z},
                     v[3] = {(double)b->x, (double)b->y, (double)b->z},
                     w[3] = {(double)c->x, (double)c->y, (double)c->z};
        sum += u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
               u[2] * (v[0] * w[1] - v[1] * w[0]);
    }
    return sum / 6.0;
}

static const float *thickness_of(const struct body *body, enum zr_algorithm algorithm, uint32_t *triangles)
{
    static const struct zr_output output = {.channel = ZR_CHANNEL_THICKNESS, .encoding = ZR_ENCODING_NPY};
    const uint32_t shell = (body->rings + 1) * body->around;
    *triangles = make_shell(body, 1.0, false, 0, 0);
    if (body->has_hole) *triangles = make_shell(body, 0.5, true, shell, *triangles);
    scene_of_triangles(&test, BODY_SIDE, BODY_SIDE, points, 1);
    for (uint32_t t = 0; t <= *triangles; t++)
        offsets[t] = 3 * t;
    test.mesh.position_count = body->has_hole ? 2 * shell : shell;
    test.mesh.face_count = *triangles;
    test.mesh.face_offsets = offsets;
    test.mesh.indices = faces;
    test.material.double_sided = false;
    test.scene.algorithm = algorithm;
    test.scene.views[0].pose = ZR_POSE_DIRECTION;
    test.scene.views[0].direction = (zr_vec3){-0.3f, -0.6f, -1.0f};
    test.scene.views[0].up = (zr_vec3){0, 1, 0};
    test.scene.views[0].projection = ZR_PROJECTION_ORTHOGRAPHIC;
    test.scene.views[0].xmag = test.scene.views[0].ymag = 2.0f;
    test.scene.views[0].outputs = &output;
    test.scene.views[0].output_count = 1;
    return scene_render(&arena, NULL, &test.scene)->channels[ZR_CHANNEL_THICKNESS];
}

static double sum_of(const float *thickness)
{
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)BODY_SIDE * BODY_SIDE; i++)
        sum += (double)thickness[i];
    return sum * (4.0 / BODY_SIDE) * (4.0 / BODY_SIDE);
}

TEST_AROUND(thickness_sums_to_the_volume_of_closed_meshes, open_arena, close_arena)
{
    static const struct body bodies[] = {{{1, 1, 1}, 0, 40, 60, false},      {{1.5, 0.3, 0.8}, 0, 30, 40, false},
                                         {{1, 1, 1}, 0.35, 40, 60, false},   {{0.4, 1.6, 0.4}, 0.2, 20, 12, false},
                                         {{1, 1, 1}, 0, 4, 4, false},        {{1, 1, 1}, 0, 40, 60, true},
                                         {{1.2, 0.7, 1}, 0.3, 40, 60, true}, {{1.7, 0.05, 1.7}, 0.1, 16, 48, false}};
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        uint32_t triangles;
        const double got = sum_of(thickness_of(&bodies[i], ZR_ALGORITHM_HALFSPACE, &triangles));
        const double want = volume_of(triangles);
        print_message("body %zu: volume %.6f, by thickness %.3g of it more\n", i, want, got / want - 1.0);
        assert_true(want > 0.1 && fabs(got / want - 1.0) < 0.005);
        zr_arena_reset(&arena, SIZE_MAX);
    }
}

/* One triangle is no body. */
TEST_AROUND(what_is_open_has_no_thickness_and_still_layers, open_arena, close_arena)
{
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_THICKNESS, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_LAYERS, .encoding = ZR_ENCODING_NPY}};
    make_sheets((const float[]){0.1f, 0.4f, 0.7f}, (const zr_vec4[]){red, green, blue}, blend_all);
    test.scene.views[0].outputs = outputs;
    test.scene.views[0].output_count = 2;
    materials[0].alpha_mode = ZR_ALPHA_OPAQUE; /* hidden fragments count as well */
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        assert_true(((const float *)frame->channels[ZR_CHANNEL_THICKNESS])[i] == 0.0f);
        assert_int_equal(((const uint32_t *)frame->channels[ZR_CHANNEL_LAYERS])[i], SHEETS);
    }
}

/* In the middle of a box, seen from the front, and on the way out of it. */
TEST_AROUND(points_and_lines_have_no_inside, open_arena, close_arena)
{
    static const struct body body = {{1.2, 0.7, 1}, 0.3, 20, 30, true};
    static const uint32_t some[] = {0, 7, 31, 60, 99, 140};
    uint32_t triangles;
    const float *want = thickness_of(&body, ZR_ALGORITHM_HALFSPACE, &triangles);
    test.mesh.points = some;
    test.mesh.point_count = sizeof some / sizeof some[0];
    test.mesh.point_size = 40.0f;
    test.mesh.lines = some;
    test.mesh.line_count = test.mesh.point_count / 2;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    assert_memory_equal(frame->channels[ZR_CHANNEL_THICKNESS], want, (size_t)BODY_SIDE * BODY_SIDE * sizeof *want);
}

/* ---- what lies over a pixel ---- */

static const struct zr_pixel_fragments *fragments_of(enum zr_algorithm algorithm, uint32_t x, uint32_t y)
{
    static struct zr_output output;
    output = (struct zr_output){.channel = ZR_CHANNEL_FRAGMENTS, .encoding = ZR_ENCODING_JSON, .x = x, .y = y};
    test.scene.algorithm = algorithm;
    test.scene.views[0].outputs = &output;
    test.scene.views[0].output_count = 1;
    return &scene_render(&arena, NULL, &test.scene)->fragments;
}

/* In front of what is opaque a mask that nothing passes, and what is blended; behind it, and at its depth, what it
 * hides. */
TEST_AROUND(fragments_of_a_pixel_tell_what_is_shown, open_arena, close_arena)
{
    static const struct {
        float depths[SHEETS];
        enum zr_alpha_mode modes[SHEETS];
        uint32_t ids[SHEETS]; /* from the front on */
        bool shown[SHEETS];
    } cases[] = {
        {{0.7f, 0.1f, 0.4f}, {ZR_ALPHA_OPAQUE, ZR_ALPHA_BLEND, ZR_ALPHA_OPAQUE}, {2, 3, 1}, {true, true, false}},
        {{0.7f, 0.1f, 0.4f}, {ZR_ALPHA_BLEND, ZR_ALPHA_MASK, ZR_ALPHA_MASK}, {2, 3, 1}, {false, true, false}},
        {{0.7f, 0.1f, 0.4f}, {ZR_ALPHA_BLEND, ZR_ALPHA_MASK, ZR_ALPHA_BLEND}, {2, 3, 1}, {false, true, true}},
        {{0.4f, 0.4f, 0.4f}, {ZR_ALPHA_BLEND, ZR_ALPHA_OPAQUE, ZR_ALPHA_BLEND}, {1, 2, 3}, {false, true, false}},
    };
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++)
        for (int a = 0; a < ZR_ALGORITHM_PAINTER; a++) {
            make_sheets(cases[c].depths, (const zr_vec4[]){red, green, blue}, cases[c].modes);
            const struct zr_pixel_fragments *fragments = fragments_of((enum zr_algorithm)a, 3, 12);
            assert_int_equal(fragments->count, SHEETS);
            for (int i = 0; i < SHEETS; i++) {
                const struct zr_pixel_fragment *fragment = &fragments->at[i];
                assert_int_equal(fragment->face_id, cases[c].ids[i]);
                assert_int_equal(fragment->alpha_mode, cases[c].modes[cases[c].ids[i] - 1]);
                assert_int_equal(fragment->is_shown, cases[c].shown[i]);
                assert_int_equal(fragment->instance, 0);
            }
        }
}

/* Every pixel of a body: as many as layers has, and the first as the channels have it. */
TEST_AROUND(fragments_are_those_of_the_channels, open_arena, close_arena)
{
    static const struct body body = {{1.2, 0.7, 1}, 0.3, 20, 30, true};
    static const struct zr_output outputs[] = {
        {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_LAYERS, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_INSTANCE_ID, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_FRONT_FACING, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_POSITION, .encoding = ZR_ENCODING_NPY, .space = ZR_SPACE_WORLD}};
    uint32_t triangles, most = 0;
    (void)thickness_of(&body, ZR_ALGORITHM_HALFSPACE, &triangles);
    test.scene.views[0].outputs = outputs;
    test.scene.views[0].output_count = sizeof outputs / sizeof outputs[0];
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (uint32_t y = 5; y < BODY_SIDE; y += 97)
        for (uint32_t x = 0; x < BODY_SIDE; x += 61) {
            const size_t pixel = (size_t)y * BODY_SIDE + x;
            const struct zr_pixel_fragments *fragments = fragments_of(ZR_ALGORITHM_HALFSPACE, x, y);
            assert_int_equal(fragments->count, ((const uint32_t *)frame->channels[ZR_CHANNEL_LAYERS])[pixel]);
            if (fragments->count > most) most = fragments->count;
            if (fragments->count == 0) continue;
            const struct zr_pixel_fragment *first = &fragments->at[0];
            assert_true(first->is_shown && first->depth == frame->depth[pixel]);
            assert_int_equal(first->face_id, frame->face_id[pixel]);
            assert_int_equal(1 + first->instance, ((const uint32_t *)frame->channels[ZR_CHANNEL_INSTANCE_ID])[pixel]);
            assert_int_equal(first->front_facing, ((const uint32_t *)frame->channels[ZR_CHANNEL_FRONT_FACING])[pixel]);
            assert_memory_equal(first->position, (const float *)frame->channels[ZR_CHANNEL_POSITION] + 3 * pixel,
                                sizeof first->position);
            for (uint32_t i = 1; i < fragments->count; i++)
                assert_true(fragments->at[i].depth >= first->depth && !fragments->at[i].is_shown);
        }
    assert_true(most > 1);
}

RUN_TESTS(NULL, NULL)
