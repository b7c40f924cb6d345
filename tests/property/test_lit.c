/* Colours of lit meshes, of each instruction set, are those by the other algorithms, which have all of their records
 * written out: there nothing is packed, and no side is known from sorting. */
#include <math.h>
#include <string.h>

#include "geometry/build.h"
#include "scene/resolved_view.h"
#include "shade/draw_attributes.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/scenes.h"

enum { WIDTH = 400, HEIGHT = 260, FACES = 500, CORNERS_MOST = 4, POSITIONS = FACES * CORNERS_MOST, MATERIALS = 3 };

static struct zr_arena arena;

struct subject {
    struct test_scene test; /* its scene */
    struct zr_mesh mesh;
    struct zr_material materials[MATERIALS];
    struct zr_light lights[2];
    struct zr_instance instances[2];
    zr_vec4 positions[POSITIONS], colors[POSITIONS], face_colors[FACES];
    uint32_t offsets[FACES + 1], indices[POSITIONS], face_materials[FACES];
};

static float any(struct random *random)
{
    return (float)random_range(random, 0, 1);
}

/* A polygon of its own corners around a place no farther than `far` from the window's centre: tiny, small, or longer,
 * up to `most`. */
static void make_face(struct subject *s, struct random *random, uint32_t face, uint32_t corners, double far,
                      double most)
{
    static const double sizes[] = {0.01, 0.01, 0.05, 0.3, 0.05, 0.01, 4.0};
    const double any_size = sizes[random_below(random, sizeof sizes / sizeof *sizes)];
    const double size = random_below(random, 20) == 0 ? 0.0 : any_size < most ? any_size : most;
    const double x = random_range(random, -far, far), y = random_range(random, -far, far),
                 z = random_range(random, -0.8, 0.8);
    const uint32_t first = s->offsets[face];
    for (uint32_t k = first; k < first + corners; k++) {
        const double w = random_range(random, 0.8, 1.2);
        s->positions[k] = (zr_vec4){(float)((x + random_range(random, -size, size)) * w),
                                    (float)((y + random_range(random, -size, size)) * w),
                                    (float)((z + random_range(random, -0.1, 0.1)) * w), (float)w};
        s->colors[k] = (zr_vec4){any(random), any(random), any(random), 1};
        s->indices[k] = k;
    }
    s->offsets[face + 1] = first + corners;
    s->face_colors[face] = (zr_vec4){any(random), any(random), any(random), 1};
    s->face_materials[face] =
        face > 0 && random_below(random, 9) ? s->face_materials[face - 1] : random_below(random, MATERIALS);
}

static void make_materials(struct subject *s, struct random *random, uint32_t shadings)
{
    static const enum zr_shading all[] = {ZR_SHADING_FLAT, ZR_SHADING_UNLIT, ZR_SHADING_GOURAUD};
    for (int i = 0; i < MATERIALS; i++)
        s->materials[i] = (struct zr_material){.base_color = {any(random), any(random), any(random), 1},
                                               .shading = all[random_below(random, shadings)],
                                               .double_sided = random_below(random, 4) > 0};
    for (int i = 0; i < 2; i++)
        s->lights[i] = (struct zr_light){.direction = {any(random) - 0.5f, any(random) - 0.5f, any(random) - 0.8f},
                                         .color = {any(random), any(random), any(random)},
                                         .camera_frame = true};
}

/* CUT by the window, and twice, the second time in a mirror and smaller; or wholly in view and once, so that nothing is
 * written out where all are triangles: ALONE, of one material, or BESIDE one face that is smooth, so that colours of
 * flat ones are not packed. Mostly all faces are flat. */
enum kind { CUT, ALONE, BESIDE, KINDS };

static void make_subject(struct subject *s, struct random *random, enum kind kind)
{
    const bool cut = kind == CUT, triangles = random_below(random, 2), mixed = cut && random_below(random, 2);
    for (uint32_t face = 0; face < FACES; face++)
        make_face(s, random, face, triangles ? 3 : 3 + random_below(random, CORNERS_MOST - 2), cut ? 1.3 : 0.6,
                  cut ? HUGE_VAL : 0.39);
    make_materials(s, random, random_below(random, 4) > 0 ? 2 : 3);
    scene_of_triangles(&s->test, WIDTH, HEIGHT, s->positions, 1);
    s->mesh = (struct zr_mesh){.name = "",
                               .position_count = s->offsets[FACES],
                               .positions = s->positions,
                               .face_count = FACES,
                               .face_offsets = s->offsets,
                               .indices = s->indices,
                               .colors = random_below(random, 4) ? NULL : s->colors,
                               .face_colors = random_below(random, 2) ? s->face_colors : NULL,
                               .face_materials = mixed || kind == BESIDE ? s->face_materials : NULL};
    if (kind == BESIDE) {
        memset(s->face_materials, 0, sizeof s->face_materials);
        s->face_materials[FACES - 1] = 1;
        s->materials[0].shading = ZR_SHADING_FLAT;
        s->materials[1].shading = ZR_SHADING_GOURAUD;
    }
    for (int i = 0; i < 2; i++)
        s->instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    zr_mat4 *last = &s->instances[cut ? 1 : 0].object_to_world;
    last->m[0] = random_below(random, 2) ? -0.6f : 0.9f;
    last->m[5] = 0.6f;
    struct zr_scene *scene = &s->test.scene;
    scene->materials = s->materials;
    scene->material_count = MATERIALS;
    scene->meshes = &s->mesh;
    scene->instances = s->instances;
    scene->instance_count = cut ? 2 : 1;
    scene->lights = s->lights;
    scene->light_count = 2;
    scene->ambient = (zr_vec3){0.1f, 0.1f, 0.2f};
}

static void assert_same(const struct zr_frame *want, const struct zr_frame *got, int round, int threads)
{
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        if (got->face_id[i] != want->face_id[i])
            fail_msg("round %d, %d threads: face %u at %zu, %zu, not %u", round, threads, got->face_id[i], i % WIDTH,
                     i / WIDTH, want->face_id[i]);
        if (memcmp(got->color + 4 * i, want->color + 4 * i, 4) != 0)
            fail_msg("round %d, %d threads: face %u has another colour at %zu, %zu", round, threads, got->face_id[i],
                     i % WIDTH, i / WIDTH);
    }
}

static void colors_are_those_of_primitives_that_are_placed_singly(void **state)
{
    static struct subject subject;
    static const size_t ceiling = (size_t)1 << 27;
    const enum zr_isa isa = isa_under_test(state);
    struct random random = random_seeded(21);
    struct zr_team *teams[2] = {zr_team_create_for(1, isa), zr_team_create_for(3, isa)};
    uint64_t clipped = 0, covered = 0;
    zr_arena_init(&arena, ceiling);
    for (int round = 0; round < 40; round++) {
        make_subject(&subject, &random, (enum kind)(round % KINDS));
        struct zr_scene written = subject.test.scene;
        written.algorithm = ZR_ALGORITHM_SCANLINE;
        const struct zr_frame *want = scene_render(&arena, NULL, &written);
        clipped += want->counts.clipped;
        covered += want->covered_pixels;
        for (int t = 0; t < 2; t++)
            assert_same(want, scene_render(&arena, teams[t], &subject.test.scene), round, 1 + 2 * t);
        zr_arena_reset(&arena, ceiling);
    }
    assert_true(clipped > 500 && covered > (uint64_t)WIDTH * HEIGHT * 20);
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
    zr_arena_free(&arena);
}

static const struct zr_window window = {WIDTH, HEIGHT, 1, 1.0f};

/* What lit triangles that show their backs show, flat and drawn from both sides, as many as are a draw by themselves,
 * and one that the window cuts. */
static struct zr_scene_attributes surfaces_of(bool colored, bool singly, struct zr_geometry *geometry)
{
    enum { WHOLE = 20 };
    static const zr_vec4 whole[3] = {{0, 0, 0, 1}, {0, 0.5f, 0, 1}, {0.5f, 0, 0, 1}},
                         cut[3] = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0, 2, 0, 1}};
    static zr_vec4 p[WHOLE + 1][3];
    static struct test_scene test;
    struct zr_scene_attributes surfaces;
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    for (int i = 0; i <= WHOLE; i++)
        memcpy(p[i], i < WHOLE ? whole : cut, sizeof p[i]);
    scene_of_triangles(&test, WIDTH, HEIGHT, p[0], WHOLE + 1);
    test.material.shading = ZR_SHADING_FLAT;
    test.material.double_sided = true;
    if (!colored) {
        test.scene.views[0].outputs++;
        test.scene.views[0].output_count--;
    }
    assert_int_equal(zr_camera_resolve(&test.scene, &test.scene.views[0], NULL, NULL, NULL, &camera, &error), ZR_OK);
    const struct zr_attribute_wants wants = {.colors = colored};
    assert_int_equal(zr_geometry_build(&arena, NULL, &test.scene, &camera, &window, NULL, singly, geometry), ZR_OK);
    assert_int_equal(zr_scene_attributes_make(&arena, NULL, &test.scene, &camera, geometry, &wants, NULL, &surfaces),
                     ZR_OK);
    return surfaces;
}

static void nothing_is_lit_where_no_picture_is_wanted(void **state)
{
    (void)state;
    zr_arena_init(&arena, 1 << 24);
    for (int singly = 0; singly <= 1; singly++) {
        struct zr_geometry geometry;
        const struct zr_scene_attributes none = surfaces_of(false, singly, &geometry);
        assert_int_equal(geometry.draw_count, 2 - singly);
        for (uint32_t i = 0; i < geometry.draw_count; i++) {
            assert_false(none.of_draw[i].packed);
            for (int k = 0; k < ZR_ATTRIBUTE_COUNT; k++)
                assert_false(none.of_draw[i].attributes[k].values);
        }
    }
    zr_arena_free(&arena);
}

static void flat_colors_are_packed_once_for_all_draws_of_a_mesh(void **state)
{
    (void)state;
    zr_arena_init(&arena, 1 << 24);
    for (int singly = 0; singly <= 1; singly++) {
        struct zr_geometry geometry;
        const struct zr_scene_attributes made = surfaces_of(true, singly, &geometry);
        assert_int_equal(geometry.draw_count, 2 - singly); /* what is cut is a draw by itself */
        for (uint32_t i = 0; i < geometry.draw_count; i++) {
            const struct zr_draw_attributes *surface = &made.of_draw[i];
            assert_true(surface->sided && surface->packed && surface->packed == made.of_draw[0].packed);
            assert_false(surface->attributes[ZR_ATTRIBUTE_COLOR].values);
            assert_int_equal(geometry.draws[i].counted, singly || i == 1);
        }
    }
    zr_arena_free(&arena);
}

/* Raised before points are made: a surface that wants them has some nevertheless. */
static void points_are_there_though_their_making_was_cancelled(void **state)
{
    (void)state;
    static const zr_vec4 p[3] = {{0, 0, 0, 1}, {0, 0.5f, 0, 1}, {0.5f, 0, 0, 1}};
    static struct test_scene test;
    const struct zr_cancel cancel = {.raised = true};
    struct zr_scene_attributes surfaces;
    struct zr_geometry geometry;
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    zr_arena_init(&arena, 1 << 24);
    scene_of_triangles(&test, WIDTH, HEIGHT, p, 1);
    test.material.shading = ZR_SHADING_PHONG;
    const struct zr_attribute_wants wants = {.colors = true};
    assert_int_equal(zr_camera_resolve(&test.scene, &test.scene.views[0], NULL, NULL, NULL, &camera, &error), ZR_OK);
    assert_int_equal(zr_geometry_build(&arena, NULL, &test.scene, &camera, &window, NULL, false, &geometry), ZR_OK);
    assert_int_equal(
        zr_scene_attributes_make(&arena, NULL, &test.scene, &camera, &geometry, &wants, &cancel, &surfaces),
        ZR_CANCELLED);
    assert_non_null(surfaces.of_draw[0].attributes[ZR_ATTRIBUTE_POINT].values);
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(colors_are_those_of_primitives_that_are_placed_singly),
        cmocka_unit_test(nothing_is_lit_where_no_picture_is_wanted),
        cmocka_unit_test(flat_colors_are_packed_once_for_all_draws_of_a_mesh),
        cmocka_unit_test(points_are_there_though_their_making_was_cancelled),
    };
    return cmocka_run_group_tests_name("lit", tests, NULL, NULL);
}
