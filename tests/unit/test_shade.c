/* From visibility to channels, and the pipeline as a whole. */
#include <math.h>
#include <string.h>

#include "geometry/build.h"
#include "raster/binned_scene.h"
#include "scene/resolved_view.h"
#include "shade/paint.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/scenes.h"

static void row_0_is_the_top_of_the_picture(void **state)
{
    (void)state;
    /* The upper half of the window, y up. */
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {-1, 0, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 10, 6, p, 2);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (int y = 0; y < 6; y++)
        for (int x = 0; x < 10; x++) {
            int i = y * 10 + x, covered = y < 3;
            assert_int_equal(frame->face_id[i] != 0, covered);
            assert_int_equal(frame->color[4 * i], covered ? 255 : 0);
            assert_int_equal(frame->color[4 * i + 3], 255);
            assert_true(frame->window_depth[i] == (covered ? 0.5f : 1.0f));
            assert_int_equal(isinf(frame->depth[i]) != 0, !covered);
        }
    zr_arena_free(&arena);
}

static void colours_are_interpolated_in_perspective(void **state)
{
    (void)state;
    /* From black at w = 1 on the left to white at w = 3 on the right: half way across
     * the window 1/w is 2/3 and colour/w is 1/6, so the colour is 1/4. */
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -3, 0, 3}, {3, 3, 0, 3}, {-1, -1, 0, 1}, {3, 3, 0, 3}, {-1, 1, 0, 1}};
    const zr_vec4 c[] = {{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 255, 9, p, 2);
    test.mesh.colors = c;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (int y = 0; y < 9; y++)
        assert_in_range(frame->color[4 * (y * 255 + 127)], 63, 64);
    zr_arena_free(&arena);
}

static void eye_depth_is_metric_in_both_projections(void **state)
{
    (void)state;
    /* A floor that leads away from the camera: y = -1, z from -1 to -9. */
    const zr_vec4 p[] = {{-9, -1, -1, 1}, {9, -1, -1, 1}, {9, -1, -9, 1},
                         {-9, -1, -1, 1}, {9, -1, -9, 1}, {-9, -1, -9, 1}};
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    scene_of_triangles(&test, 64, 64, p, 2);
    test.scene.views[0].projection = ZR_PROJECTION_PERSPECTIVE;
    test.scene.views[0].yfov_radians = 1.5707963f;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (int y = 36; y < 64; y++) {
        double slope = ((double)y + 0.5 - 32.0) / 32.0; /* of the ray through the pixel's centre: depth 1 / slope */
        float depth = frame->depth[y * 64 + 32];
        if (1.0 / slope > 1.0 && 1.0 / slope < 9.0) assert_true(fabs((double)depth * slope - 1.0) < 1e-5);
    }
    const zr_vec4 wall[] = {{-1, -1, -2, 1}, {1, -1, -2, 1}, {1, 1, -6, 1},
                            {-1, -1, -2, 1}, {1, 1, -6, 1},  {-1, 1, -6, 1}};
    scene_of_triangles(&test, 8, 64, wall, 2);
    test.scene.views[0].projection = ZR_PROJECTION_ORTHOGRAPHIC;
    test.scene.views[0].xmag = test.scene.views[0].ymag = 1.0f;
    frame = scene_render(&arena, NULL, &test.scene);
    for (int y = 0; y < 64; y++)
        assert_true(fabsf(frame->depth[y * 8 + 4] - (6.0f - 4.0f * ((float)y + 0.5f) / 64.0f)) < 1e-4f);
    zr_arena_free(&arena);
}

static void depth_of_slivers_stays_between_their_vertices(void **state)
{
    (void)state;
    static zr_vec4 p[300];
    for (int i = 0; i < 100; i++) {
        float y = -1.0f + 0.02f * (float)i;
        p[3 * i] = (zr_vec4){-1, y, -0.5f, 1};
        p[3 * i + 1] = (zr_vec4){1, y + 1e-3f * (float)(i % 7), -0.2f, 1};
        p[3 * i + 2] = (zr_vec4){0.1f, y + 6e-4f * (float)(i % 7), -0.9f, 1};
    }
    static struct test_scene test;
    scene_of_triangles(&test, 1000, 1000, p, 100);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 27);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    int seen = 0;
    for (int i = 0; i < 1000 * 1000; i++) {
        if (frame->face_id[i] == 0) continue;
        assert_true(frame->depth[i] >= 0.2f && frame->depth[i] <= 0.9f);
        seen++;
    }
    assert_true(seen > 100);
    zr_arena_free(&arena);
}

static void lit_backs_are_shown_where_both_sides_are_drawn(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    const zr_vec4 away[] = {{-1, -1, 0, 1}, {-1, 3, 0, 1}, {3, -1, 0, 1}};
    const struct zr_light headlight = {.direction = {0, 0, -1}, .color = {1, 1, 1}, .camera_frame = true};
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    for (int turned = 0; turned < 2; turned++)
        for (int shading = ZR_SHADING_FLAT; shading <= ZR_SHADING_GOURAUD; shading++) {
            scene_of_triangles(&test, 4, 4, turned ? away : p, 1);
            test.material.shading = (enum zr_shading)shading;
            test.scene.lights = &headlight;
            test.scene.light_count = 1;
            const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
            assert_int_equal(frame->color[0], 255);
        }
    zr_arena_free(&arena);
}

static void two_meshes_with_clipping_keep_their_own_colours(void **state)
{
    (void)state;
    /* Each mesh is cut by the window's border, so that pieces are added while there
     * is another mesh to come. */
    const zr_vec4 left[] = {{-3, -1, 0, 1}, {0, -1, 0, 1}, {0, 2, 0, 1}},
                  right[] = {{0, -1, 0, 1}, {3, -1, 0, 1}, {0, 2, 0, 1}};
    const zr_vec4 red[] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}},
                  blue[] = {{0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 1, 1}};
    static struct test_scene a, b;
    scene_of_triangles(&a, 32, 32, left, 1);
    scene_of_triangles(&b, 32, 32, right, 1);
    a.mesh.colors = red;
    b.mesh.colors = blue;
    const struct zr_mesh meshes[] = {a.mesh, b.mesh};
    const struct zr_instance instances[] = {{0, zr_mat4_identity(), NULL}, {1, zr_mat4_identity(), NULL}};
    a.scene.meshes = meshes;
    a.scene.instances = instances;
    a.scene.mesh_count = a.scene.instance_count = 2;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    const struct zr_frame *frame = scene_render(&arena, NULL, &a.scene);
    assert_int_equal(frame->counts.clipped, 2);
    const uint8_t *bottom = frame->color + (size_t)31 * 32 * 4;
    for (int x = 0; x < 32; x++) {
        assert_int_equal(bottom[4 * x], x < 16 ? 255 : 0);
        assert_int_equal(bottom[4 * x + 2], x < 16 ? 0 : 255);
        assert_int_equal(frame->face_id[31 * 32 + x], x < 16 ? 1 : 2);
    }
    zr_arena_free(&arena);
}

/* ---- triangles that are painted early ---- */

/* As small as pixels in the one window, and as small as stamps in the other. */
enum { SHEET = 40, SHEET_FACES = SHEET * SHEET, SHEET_WINDOW = 48, SHEET_WINDOW_OF_STAMPS = 150 };

/* Of quadrilaterals, or each of them as two triangles, all of which show their front. In perspective: its rows reach
 * back. */
static void make_sheet(struct test_scene *test, bool quads, zr_vec4 *p, zr_vec4 *colors, zr_vec4 *face_colors)
{
    static const int triangles[6] = {0, 1, 2, 0, 2, 3};
    const uint32_t corners = quads ? 4 : 6;
    struct random random = random_seeded(11);
    zr_vec4 grid[SHEET + 1][SHEET + 1];
    for (int row = 0; row <= SHEET; row++)
        for (int column = 0; column <= SHEET; column++) {
            const float w = 1.0f + 0.02f * (float)row;
            const float x = (float)column / SHEET * 1.8f - 0.9f, y = (float)row / SHEET * 1.8f - 0.9f;
            grid[row][column] = (zr_vec4){x * w, y * w, 0.5f * w, w};
        }
    uint32_t n = 0;
    for (int i = 0; i < SHEET_FACES; i++) {
        const int row = i / SHEET, column = i % SHEET;
        const zr_vec4 four[4] = {grid[row][column], grid[row][column + 1], grid[row + 1][column + 1],
                                 grid[row + 1][column]};
        for (uint32_t k = 0; k < corners; k++, n++) {
            p[n] = four[quads ? (int)k : triangles[k]];
            colors[n] = (zr_vec4){(float)random_range(&random, 0, 1), (float)random_range(&random, 0, 1), 0.5f, 1};
        }
    }
    const uint32_t faces = quads ? SHEET_FACES : 2 * SHEET_FACES, each = n / faces;
    scene_of_triangles(test, SHEET_WINDOW, SHEET_WINDOW, p, n / 3);
    for (uint32_t f = 0; f < faces; f++) {
        test->face_offsets[f + 1] = each * (f + 1);
        face_colors[f] = (zr_vec4){1, (float)(f % 7) / 7, (float)(f % 3) / 3, 1};
    }
    test->mesh.face_count = faces;
    test->mesh.position_count = n;
    test->mesh.faces_are_fans = quads; /* rounded, one or the other is not convex */
    test->mesh.colors = colors;
}

/* Pixels of tile 0 that are painted while triangles are sorted. */
static uint32_t count_early(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene)
{
    struct zr_camera camera;
    struct zr_geometry geometry;
    struct zr_scene_attributes surfaces;
    const struct zr_prepaint *payloads;
    struct zr_binned_scene visible;
    struct zr_error error = {.count = 0};
    struct zr_tile *tile = zr_arena_alloc(arena, 1, sizeof *tile);
    assert_int_equal(zr_camera_resolve(scene, &scene->views[0], NULL, NULL, NULL, &camera, &error), ZR_OK);
    const uint32_t width = scene->views[0].width, height = scene->views[0].height;
    const struct zr_window window = {width, height, 1, 1.0f};
    const struct zr_attribute_wants wants = {.colors = zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR),
                                             .normals = zr_view_wants(&scene->views[0], ZR_CHANNEL_NORMALS)};
    assert_int_equal(zr_geometry_build(arena, team, scene, &camera, &window, NULL, false, &geometry), ZR_OK);
    assert_int_equal(zr_scene_attributes_make(arena, team, scene, &camera, &geometry, &wants, NULL, &surfaces), ZR_OK);
    assert_int_equal(zr_paint_prepare(arena, team, &geometry, &surfaces, width * height, &payloads), ZR_OK);
    assert_int_equal(zr_binned_scene_make(arena, team, &geometry, payloads, width, height, NULL, NULL, &visible),
                     ZR_OK);
    assert_true(zr_visibility_tile(&visible.visibility, 0, NULL, tile));
    uint32_t early = 0;
    for (int32_t i = 0; tile->has_words && i < ZR_TILE_STRIDE * tile->height; i++)
        early += tile->words[i] != 0;
    return early;
}

/* Backs that there are not make no difference, but that nothing is painted early where they would be drawn. */
static void assert_early_is_late(enum zr_isa isa, uint32_t window, uint32_t least)
{
    struct zr_team *team = zr_team_create_for(2, isa);
    static struct test_scene test;
    static zr_vec4 p[6 * SHEET_FACES], colors[6 * SHEET_FACES], face_colors[2 * SHEET_FACES];
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 26);
    for (int way = 0; way < 3; way++) { /* colours of vertices; of corners; of the corners of quadrilaterals */
        make_sheet(&test, way == 2, p, colors, face_colors);
        if (way > 0) test.mesh.face_colors = face_colors;
        test.scene.views[0].width = test.scene.views[0].height = window;
        const struct zr_frame *late = scene_render(&arena, team, &test.scene);
        assert_int_equal(count_early(&arena, team, &test.scene), 0);
        test.material.double_sided = false;
        const struct zr_frame *early = scene_render(&arena, team, &test.scene);
        assert_true(count_early(&arena, team, &test.scene) >= least);
        assert_int_equal(early->covered_pixels, late->covered_pixels);
        assert_memory_equal(early->color, late->color, (size_t)4 * window * window);
        zr_arena_reset(&arena, 1 << 26);
    }
    zr_arena_free(&arena);
    zr_team_destroy(team);
}

static void tiny_triangles_are_painted_early_as_they_would_be_later(void **state)
{
    assert_early_is_late(isa_under_test(state), SHEET_WINDOW, SHEET_WINDOW * SHEET_WINDOW / 2);
}

/* Without vectors there are no stamps. */
static void small_triangles_are_painted_early_as_they_would_be_later(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    const bool has_stamps = isa != ZR_ISA_SCALAR;
    assert_early_is_late(isa, SHEET_WINDOW_OF_STAMPS, has_stamps ? ZR_TILE_SIZE * ZR_TILE_SIZE / 2 : 0);
}

/* Two sheets, one of them flat: in the same place the first is seen, else the nearer one. */
static void assert_early_gives_way(enum zr_isa isa, uint32_t window)
{
    struct zr_team *team = zr_team_create_for(2, isa);
    static struct test_scene test;
    static zr_vec4 p[6 * SHEET_FACES], nearer[6 * SHEET_FACES], colors[6 * SHEET_FACES], face_colors[2 * SHEET_FACES];
    make_sheet(&test, false, p, colors, face_colors);
    test.material.double_sided = false;
    test.scene.views[0].width = test.scene.views[0].height = window;
    memcpy(nearer, p, sizeof p);
    for (int i = 0; i < 6 * SHEET_FACES; i++)
        nearer[i].z *= 0.5f;
    struct zr_mesh flat = test.mesh;
    flat.colors = NULL;
    flat.face_colors = face_colors;
    const struct zr_instance instances[2] = {{0, zr_mat4_identity(), NULL}, {1, zr_mat4_identity(), NULL}};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 26);
    enum { SMOOTH_FIRST, FLAT_FIRST, FLAT_NEARER };
    for (int way = SMOOTH_FIRST; way <= FLAT_NEARER; way++) {
        flat.positions = way == FLAT_NEARER ? nearer : p;
        const struct zr_mesh seen = way == SMOOTH_FIRST ? test.mesh : flat;
        const struct zr_mesh meshes[2] = {way == FLAT_FIRST ? flat : test.mesh, way == FLAT_FIRST ? test.mesh : flat};
        test.scene.instances = instances;
        test.scene.meshes = &seen;
        test.scene.mesh_count = test.scene.instance_count = 1;
        const struct zr_frame *alone = scene_render(&arena, team, &test.scene);
        test.scene.meshes = meshes;
        test.scene.mesh_count = test.scene.instance_count = 2;
        const struct zr_frame *both = scene_render(&arena, team, &test.scene);
        assert_int_equal(both->covered_pixels, alone->covered_pixels);
        const uint32_t early = count_early(&arena, team, &test.scene);
        if (window == SHEET_WINDOW)
            assert_int_equal(early, way == SMOOTH_FIRST ? both->covered_pixels : 0);
        else if (way != SMOOTH_FIRST)
            assert_int_equal(early, 0);
        assert_memory_equal(both->color, alone->color, (size_t)4 * window * window);
        zr_arena_reset(&arena, 1 << 26);
    }
    zr_arena_free(&arena);
    zr_team_destroy(team);
}

static void early_colours_give_way_to_what_is_seen(void **state)
{
    assert_early_gives_way(isa_under_test(state), SHEET_WINDOW);
    assert_early_gives_way(isa_under_test(state), SHEET_WINDOW_OF_STAMPS);
}

/* Before the sheet, of its own mesh and of another: too large for a stamp, and small. */
static void early_colours_give_way_to_larger_triangles(void **state)
{
    enum { LARGER = 40 };
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    static struct test_scene test;
    static zr_vec4 p[6 * SHEET_FACES], colors[6 * SHEET_FACES], face_colors[2 * SHEET_FACES];
    struct random random = random_seeded(3);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 26);
    make_sheet(&test, false, p, colors, face_colors);
    test.scene.views[0].width = test.scene.views[0].height = SHEET_WINDOW_OF_STAMPS;
    for (int i = 0; i < LARGER; i++) { /* every 5th triangle of the sheet's middle: in all groups */
        zr_vec4 *corner = p + 3 * (SHEET_FACES / 2 + 5 * i);
        const float x = (float)random_range(&random, -0.9, 0.7), y = (float)random_range(&random, -0.9, 0.7);
        corner[0] = (zr_vec4){x, y, -0.5f, 1};
        corner[1] = (zr_vec4){x + 0.12f, y, -0.5f, 1};
        corner[2] = (zr_vec4){x, y + 0.12f, -0.5f, 1};
    }
    struct zr_mesh other = test.mesh;
    other.positions = p + 3 * (SHEET_FACES / 2);
    other.face_count = 5 * LARGER;
    other.position_count = 3 * other.face_count;
    other.colors = NULL;
    other.face_colors = face_colors;
    zr_mat4 moved = zr_mat4_identity();
    moved.m[12] = 0.05f;
    moved.m[14] = -0.1f;
    const struct zr_mesh meshes[2] = {test.mesh, other};
    const struct zr_instance instances[2] = {{0, zr_mat4_identity(), NULL}, {1, moved, NULL}};
    test.scene.meshes = meshes;
    test.scene.instances = instances;
    test.scene.mesh_count = test.scene.instance_count = 2;
    const struct zr_frame *late = scene_render(&arena, team, &test.scene);
    assert_int_equal(count_early(&arena, team, &test.scene), 0);
    test.material.double_sided = false;
    const struct zr_frame *early = scene_render(&arena, team, &test.scene);
    if (isa_under_test(state) != ZR_ISA_SCALAR) assert_true(count_early(&arena, team, &test.scene) > 0);
    assert_memory_equal(early->color, late->color, 4 * SHEET_WINDOW_OF_STAMPS * SHEET_WINDOW_OF_STAMPS);
    zr_arena_free(&arena);
    zr_team_destroy(team);
}

/* Colours of blocks are looked up in a table whose empty places have a colour, too: the background's, with the other
 * half of all alphas. It may be a face's. */
static void faces_may_have_any_colour_beside_any_background(void **state)
{
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}, {1, -1, 0, 1}, {1, 0.5f, 0, 1}, {-1, 1, 0, 1}};
    const zr_vec4 faces[] = {{1, 0, 0, 1}, {0, 0, 1, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, p, 2);
    test.mesh.face_colors = faces;
    test.scene.background = (zr_vec4){1, 0, 0, 127.0f / 255.0f};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_team *team = zr_team_create_for(1, isa_under_test(state));
    const struct zr_frame *frame = scene_render(&arena, team, &test.scene);
    uint64_t covered = 0;
    for (size_t i = 0; i < 64 * 64; i++) {
        static const uint8_t colors[][4] = {{255, 0, 0, 127}, {255, 0, 0, 255}, {0, 0, 255, 255}};
        assert_in_range(frame->face_id[i], 0, 2);
        assert_memory_equal(frame->color + 4 * i, colors[frame->face_id[i]], 4);
        covered += frame->face_id[i] > 0;
    }
    assert_in_range(covered, 3000, 4000);
    assert_int_equal(frame->covered_pixels, covered);
    zr_team_destroy(team);
    zr_arena_free(&arena);
}

/* Of a view that is fitted, from a resolved that was found before or while it is drawn; the resolved is what decides.
 */
static void picture_is_that_of_its_view(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -1, 1, 1}, {-1, 3, 2, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 48, p, 1);
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_PRESET, .preset = ZR_PRESET_FRONT, .yfov_radians = 0.5f});
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_error error = {.count = 0};
    const struct zr_resolved_view *resolved;
    const struct zr_frame *found_before, *found_by_it, *narrow;
    assert_int_equal(zr_resolved_view_find(&arena, NULL, &test.scene, NULL, &resolved, &error), ZR_OK);
    assert_int_equal(zr_render(&arena, NULL, &test.scene, resolved, NULL, &found_before, &error), ZR_OK);
    assert_int_equal(zr_render(&arena, NULL, &test.scene, NULL, NULL, &found_by_it, &error), ZR_OK);
    assert_memory_equal(found_before->color, found_by_it->color, 64 * 48 * 4);
    assert_memory_equal(&found_before->camera, &found_by_it->camera, sizeof resolved->camera);
    assert_memory_equal(&found_before->bounds.min, &found_by_it->bounds.min, sizeof(zr_vec3));
    assert_true(found_by_it->bounds.valid && found_by_it->covered_pixels > 200);
    struct zr_resolved_view narrowed = *resolved;
    narrowed.camera.projection.m[0] *= 0.5f;
    assert_int_equal(zr_render(&arena, NULL, &test.scene, &narrowed, NULL, &narrow, &error), ZR_OK);
    assert_true(narrow->covered_pixels < found_by_it->covered_pixels * 3 / 4);
    /* Bounds are told where they are asked for, even if the view needs none. */
    const struct zr_output info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_MATRIX,
                                             .world_to_camera = zr_mat4_identity(),
                                             .projection = ZR_PROJECTION_MATRIX,
                                             .projection_matrix = zr_mat4_identity()});
    assert_int_equal(zr_resolved_view_find(&arena, NULL, &test.scene, NULL, &resolved, &error), ZR_OK);
    assert_false(resolved->bounds.valid);
    test.scene.views[0].outputs = &info;
    test.scene.views[0].output_count = 1;
    assert_int_equal(zr_resolved_view_find(&arena, NULL, &test.scene, NULL, &resolved, &error), ZR_OK);
    assert_true(resolved->bounds.valid && resolved->bounds.max.x == 3.0f && resolved->bounds.max.z == 2.0f);
    zr_arena_free(&arena);
}

static void render_that_is_cancelled_says_so(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, p, 1);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_cancel cancel = {.raised = true};
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(zr_render(&arena, NULL, &test.scene, NULL, &cancel, &frame, &error), ZR_CANCELLED);
    assert_int_equal(error.count, 1);
    zr_arena_free(&arena);
}

static void render_under_every_memory_ceiling_fails_cleanly_or_gives_the_picture(void **state)
{
    (void)state;
    static zr_vec4 p[3 * 500];
    for (int i = 0; i < 1500; i++)
        p[i] = (zr_vec4){(float)(i % 7) - 3, (float)(i % 5) - 2, 0, (float)(i % 3 + 1)};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, p, 500);
    test.material.shading = ZR_SHADING_GOURAUD;
    int failures = 0, successes = 0;
    for (size_t ceiling = 0; ceiling < 2000000; ceiling += 4000) {
        struct zr_arena arena;
        zr_arena_init(&arena, ceiling);
        struct zr_error error = {.count = 0};
        const struct zr_frame *frame;
        enum zr_status status = zr_render(&arena, NULL, &test.scene, NULL, NULL, &frame, &error);
        if (status == ZR_OK) {
            assert_int_equal(frame->counts.polygons, 500);
            successes++;
        } else {
            assert_int_equal(status, ZR_NO_MEMORY);
            assert_int_equal(error.count, 1);
            assert_int_equal(successes, 0);
            failures++;
        }
        zr_arena_free(&arena);
    }
    assert_true(failures > 10 && successes > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(row_0_is_the_top_of_the_picture),
        cmocka_unit_test(colours_are_interpolated_in_perspective),
        cmocka_unit_test(eye_depth_is_metric_in_both_projections),
        cmocka_unit_test(depth_of_slivers_stays_between_their_vertices),
        cmocka_unit_test(lit_backs_are_shown_where_both_sides_are_drawn),
        cmocka_unit_test(two_meshes_with_clipping_keep_their_own_colours),
        TEST_EACH_ISA(tiny_triangles_are_painted_early_as_they_would_be_later),
        TEST_EACH_ISA(small_triangles_are_painted_early_as_they_would_be_later),
        TEST_EACH_ISA(early_colours_give_way_to_what_is_seen),
        TEST_EACH_ISA(early_colours_give_way_to_larger_triangles),
        TEST_EACH_ISA(faces_may_have_any_colour_beside_any_background),
        cmocka_unit_test(picture_is_that_of_its_view),
        cmocka_unit_test(render_that_is_cancelled_says_so),
        cmocka_unit_test(render_under_every_memory_ceiling_fails_cleanly_or_gives_the_picture),
    };
    return cmocka_run_group_tests_name("shade", tests, NULL, NULL);
}
