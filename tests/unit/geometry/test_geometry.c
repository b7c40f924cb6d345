/* The stages of geometry/: clip, viewport, normals, light, and the floor as a whole. */
#include <math.h>

#include "base/run.h"
#include "geometry/build.h"
#include "geometry/clip.h"
#include "geometry/face.h"
#include "mesh/face_normals.h"
#include "shade/lights/light.h"
#include "support/scenes.h"
#include "support/tests.h"

/* ---- clip ---- */

static int clip(const zr_vec4 positions[3], struct zr_clipped *out)
{
    unsigned any = 0;
    for (int i = 0; i < 3; i++)
        any |= zr_clip_outcode(positions[i]);
    return zr_clip_triangle(positions, any, NULL, out);
}

TEST(clip_by_all_planes_stays_within_room_and_volume)
{
    const zr_vec4 p[3] = {{-30, -20, -9, 1}, {40, -10, 3, 1}, {3, 50, 8, 1}};
    struct zr_clipped out;
    int count = clip(p, &out);
    assert_in_range(count, 3, ZR_CLIP_MAX);
    for (int i = 0; i < count; i++) {
        assert_true(fabsf(out.vertices[i].position.x) <= out.vertices[i].position.w * 1.00001f);
        assert_true(fabsf(out.vertices[i].position.y) <= out.vertices[i].position.w * 1.00001f);
        assert_true(fabsf(out.vertices[i].position.z) <= out.vertices[i].position.w * 1.00001f);
    }
}

TEST(clip_outcode_of_nan_is_outside_of_everything)
{
    assert_int_equal(zr_clip_outcode((zr_vec4){NAN, NAN, NAN, NAN}), 63);
    assert_int_equal(zr_clip_outcode((zr_vec4){0, 0, 0, 1}), 0);
    assert_int_equal(zr_clip_outcode((zr_vec4){1, -1, 1, 1}), 0);
}

/* ---- viewport ---- */

TEST(viewport_without_a_place_is_refused)
{
    struct zr_viewport viewport = zr_viewport_make(64, 64);
    struct zr_window_vertex v;
    assert_false(zr_viewport_apply(&viewport, (zr_vec4){0, 0, 0, 0}, &v));
    assert_false(zr_viewport_apply(&viewport, (zr_vec4){1e30f, 0, 0, 1e-30f}, &v));
}

/* ---- normals and light ---- */

static struct zr_mesh quad_mesh(const zr_vec4 *positions, uint32_t count)
{
    static const uint32_t indices[] = {0, 1, 2, 3, 4, 5, 6, 7}, offsets[] = {0, 8};
    static uint32_t whole[2];
    whole[0] = offsets[0];
    whole[1] = count;
    return (struct zr_mesh){.name = "",
                            .position_count = count,
                            .positions = positions,
                            .face_count = 1,
                            .face_offsets = whole,
                            .indices = indices};
}

static bool is_concave(const zr_vec4 *ring, uint32_t count)
{
    /* Whatever plane it lies in, from either side, and from each corner on. */
    uint32_t concave = 0;
    for (int plane = 0; plane < 3; plane++)
        for (uint32_t turned = 0; turned < 2 * count; turned++) {
            zr_vec4 p[8];
            for (uint32_t i = 0; i < count; i++) {
                uint32_t from = (i + turned / 2) % count;
                zr_vec4 q = ring[turned % 2 ? count - 1 - from : from];
                p[i] = plane == 0 ? q : plane == 1 ? (zr_vec4){q.y, q.z, q.x, q.w} : (zr_vec4){q.z, q.x, q.y, q.w};
            }
            struct zr_mesh mesh = quad_mesh(p, count);
            concave += zr_face_is_concave(&mesh, 0);
        }
    assert_true(concave == 0 || concave == 6 * count);
    return concave > 0;
}

TEST(faces_with_dents_or_crossings_are_concave_and_convex_ones_are_not)
{
    const zr_vec4 dent[4] = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0.5f, 0.5f, 0, 1}, {0, 2, 0, 1}};
    assert_true(is_concave(dent, 4));
    const zr_vec4 small_notch[6] = {{0, 0, 0, 1},    {1000, 0, 0, 1}, {1000, 1000, 0, 1},
                                    {3, 1000, 0, 1}, {3, 997, 0, 1},  {0, 997, 0, 1}};
    assert_true(is_concave(small_notch, 6));
    const zr_vec4 bow_tie[4] = {{0, 0, 0, 1}, {1, 1, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    assert_true(is_concave(bow_tie, 4));
    const zr_vec4 pentagram[5] = {
        {0, 1, 0, 1}, {-0.59f, -0.81f, 0, 1}, {0.95f, 0.31f, 0, 1}, {-0.95f, 0.31f, 0, 1}, {0.59f, -0.81f, 0, 1}};
    assert_true(is_concave(pentagram, 5));
    const zr_vec4 square[4] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
    assert_false(is_concave(square, 4));
    const zr_vec4 hexagon[6] = {{2, 0, 0, 1},  {1, 1.7f, 0, 1},   {-1, 1.7f, 0, 1},
                                {-2, 0, 0, 1}, {-1, -1.7f, 0, 1}, {1, -1.7f, 0, 1}};
    assert_false(is_concave(hexagon, 6));
    /* Corners in the middle of edges, one of them twice, and a needle. */
    const zr_vec4 midpoints[8] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}, {2, 1, 0, 1},
                                  {2, 2, 0, 1}, {0, 2, 0, 1}, {0, 2, 0, 1}, {0, 1, 0, 1}};
    assert_false(is_concave(midpoints, 8));
    const zr_vec4 needle[4] = {{0, 0, 0, 1}, {1000, -0.5f, 0, 1}, {2000, 0, 0, 1}, {1000, 0.5f, 0, 1}};
    assert_false(is_concave(needle, 4));
}

TEST(faces_are_convex_only_if_they_are_exactly)
{
    const zr_vec4 dent[5] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0.5f, 1.0f - 1e-6f, 0, 1}, {0, 1, 0, 1}};
    assert_true(is_concave(dent, 5));
    const zr_vec4 bulge[5] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0.5f, 1.0f + 1e-6f, 0, 1}, {0, 1, 0, 1}};
    assert_false(is_concave(bulge, 5));
    const zr_vec4 repeated_dent[6] = {{2, 0, 0, 1}, {0.5f, 0.5f, 0, 1}, {0.5f, 0.5f, 0, 1},
                                      {0, 2, 0, 1}, {0, 0, 0, 1},       {0, 0, 0, 1}};
    assert_true(is_concave(repeated_dent, 6));
    const zr_vec4 on_slanted_edge[5] = {{0, 0, 0, 1}, {2, 2, 0, 1}, {0, 4, 0, 1}, {-1, 3, 0, 1}, {-2, 2, 0, 1}};
    assert_false(is_concave(on_slanted_edge, 5));
    const zr_vec4 spike[5] = {{0, 0, 0, 1}, {3, 0, 0, 1}, {2, 0, 0, 1}, {2, 2, 0, 1}, {0, 2, 0, 1}};
    assert_true(is_concave(spike, 5));
    const zr_vec4 twice_round[8] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1},
                                    {0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
    assert_true(is_concave(twice_round, 8));
    const zr_vec4 one_line[4] = {{0, 0, 0, 1}, {1, 2, 0, 1}, {3, 6, 0, 1}, {2, 4, 0, 1}};
    assert_false(is_concave(one_line, 4));
    const zr_vec4 divided[4] = {{0, 0, 0, 1}, {2, 0, 0, 0.5f}, {2, 2, 0, 2}, {0, 4, 0, 1}};
    assert_true(is_concave(divided, 4));
}

/* A square whose third corner is the same point, but behind the eye: its edges go through infinity. */
TEST(faces_with_corners_behind_the_eye_are_judged_as_cones)
{
    const zr_vec4 turned[4] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {-1, -1, 0, -1}, {0, 1, 0, 1}};
    assert_true(is_concave(turned, 4));
    const zr_vec4 all_behind[4] = {{0, 0, 0, -1}, {-1, 0, 0, -1}, {-1, -1, 0, -1}, {0, -1, 0, -1}};
    assert_false(is_concave(all_behind, 4));
    /* A strip from in front of the eye to behind it; divided by w it is a bow tie. */
    const zr_vec4 strip[4] = {{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1}};
    assert_false(is_concave(strip, 4));
    const zr_vec4 crossed[4] = {{-1, 1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, -1}, {1, 1, 0, -1}};
    assert_true(is_concave(crossed, 4));
    const zr_vec4 to_infinity[4] = {{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 2, 0, 0}, {-1, 2, 0, 0}};
    assert_false(is_concave(to_infinity, 4));
    const zr_vec4 repeated[6] = {{-1, 1, 0, 1}, {1, 1, 0, 1},           {2, 2, 0, 2},
                                 {1, 1, 0, -1}, {0.5f, 0.5f, 0, -0.5f}, {-1, 1, 0, -1}};
    assert_false(is_concave(repeated, 6));
    const zr_vec4 dent[5] = {{-1, 1, 0, 1}, {0, 1, 0, 0.5f}, {1, 1, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1}};
    assert_true(is_concave(dent, 5));
    const zr_vec4 straight[5] = {{-1, 1, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1}};
    assert_false(is_concave(straight, 5));
    const zr_vec4 twice_round[8] = {{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1},
                                    {-1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1}};
    assert_true(is_concave(twice_round, 8));
    /* All around the eye: there is no side from which all of it is seen. */
    const zr_vec4 around[4] = {{1, 0, 0, 1}, {0, 1, 0, -1}, {-1, 0, 0, 1}, {0, -1, 0, -1}};
    assert_true(is_concave(around, 4));
    const zr_vec4 one_line[4] = {{0, 0, 0, 1}, {1, 2, 0, 1}, {-3, -6, 0, -1}, {2, 4, 0, 1}};
    assert_false(is_concave(one_line, 4));
}

/* ---- the floor ---- */

static struct zr_counts counts_of(const zr_vec4 *positions, uint32_t triangles, bool double_sided)
{
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, positions, triangles);
    test.material.double_sided = double_sided;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_counts counts = scene_render(&arena, NULL, &test.scene)->counts;
    zr_arena_free(&arena);
    return counts;
}

TEST(geometry_survives_points_at_infinity_and_the_zero_vertex)
{
    const zr_vec4 p[] = {{0, 0, 0, 0},        {0.5f, 0, 0, 1}, {0, 0.5f, 0, 1}, {1, 0, 0, 0},
                         {0, 1, 0, 0},        {0, 0, 1, 0},    {0, 0, 0, 0},    {0, 0, 0, 0},
                         {INFINITY, 0, 0, 1}, {0, 0, 0, 1},    {1, 1, 1, 1},    {1e30f, 1e30f, 0, 1e-30f}};
    struct zr_counts c = counts_of(p, 4, true);
    assert_int_equal(c.polygons, 4);
    assert_int_equal(c.outside + c.clipped + c.culled + c.zero_area + c.drawn_whole, c.triangles);
}

/* Returns the number of vertices that clipping made. */
static uint32_t build(const zr_vec4 *positions, bool has_line, struct zr_arena *arena, struct zr_geometry *geometry)
{
    static const uint32_t line[2] = {0, 1};
    static struct test_scene test;
    const struct zr_window window = {64, 64, 1, 1.0f};
    const struct zr_camera camera = {.world_to_eye = zr_mat4_identity(), .projection = zr_mat4_identity()};
    scene_of_triangles(&test, 64, 64, positions, 1);
    test.mesh.lines = line;
    test.mesh.line_count = has_line;
    assert_int_equal(
        zr_geometry_build(&(struct zr_run){.arena = arena}, &test.scene, &camera, &window, false, geometry), ZR_OK);
    return geometry->vertex_count - 3;
}

TEST(only_lines_and_clipped_vertices_have_depths_of_their_own)
{
    const zr_vec4 whole[3] = {{0, 0, 0.25f, 1}, {0.5f, 0, 0.5f, 1}, {0, 0.5f, 0, 1}},
                  cut[3] = {{0, 0, 0.25f, 1}, {4, 0, 0.25f, 1}, {0, 4, 0.25f, 1}};
    struct zr_arena arena;
    struct zr_geometry geometry;
    zr_arena_init(&arena, 1 << 24);
    assert_int_equal(build(whole, false, &arena, &geometry), 0);
    assert_null(geometry.eyes);
    assert_int_equal(build(whole, true, &arena, &geometry), 0);
    assert_true(geometry.eyes[0].z == 0.25f && geometry.eyes[1].z == 0.5f && geometry.eyes[1].w == 1.0f);
    const uint32_t made = build(cut, false, &arena, &geometry);
    assert_true(made > 0);
    for (uint32_t i = 3; i < 3 + made; i++)
        assert_true(geometry.eyes[i].z == 0.25f && geometry.eyes[i].w == 1.0f);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
