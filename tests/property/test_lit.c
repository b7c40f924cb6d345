/* Colours of lit meshes, of each instruction set, are those by the other algorithms, which have all of their records
 * written out: there nothing is packed, and no side is known from sorting. */
#include <math.h>
#include <string.h>

#include "support/isas.h"
#include "support/random.h"
#include "support/scenes.h"

enum { WIDTH = 400, HEIGHT = 260, FACES = 500, CORNERS_MOST = 4, POSITIONS = FACES * CORNERS_MOST, MATERIALS = 3 };

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
        s->lights[i] = (struct zr_light){{any(random) - 0.5f, any(random) - 0.5f, any(random) - 0.8f},
                                         {any(random), any(random), any(random)},
                                         true};
}

/* Mostly all faces are flat. Wholly in view, of one material, and alone, so that nothing is written out where all are
 * triangles; or cut by the window, and twice, the second time in a mirror and smaller. */
static void make_subject(struct subject *s, struct random *random, bool alone)
{
    const bool triangles = random_below(random, 2), mixed = !alone && random_below(random, 2);
    for (uint32_t face = 0; face < FACES; face++)
        make_face(s, random, face, triangles ? 3 : 3 + random_below(random, CORNERS_MOST - 2), alone ? 0.6 : 1.3,
                  alone ? 0.39 : HUGE_VAL);
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
                               .face_materials = mixed ? s->face_materials : NULL};
    for (int i = 0; i < 2; i++)
        s->instances[i] = (struct zr_instance){0, zr_mat4_identity()};
    zr_mat4 *last = &s->instances[alone ? 0 : 1].object_to_world;
    last->m[0] = random_below(random, 2) ? -0.6f : 0.9f;
    last->m[5] = 0.6f;
    struct zr_scene *scene = &s->test.scene;
    scene->materials = s->materials;
    scene->material_count = MATERIALS;
    scene->meshes = &s->mesh;
    scene->instances = s->instances;
    scene->instance_count = alone ? 1 : 2;
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

static void colors_are_those_of_records_that_are_written_out(void **state)
{
    static struct subject subject;
    static const size_t ceiling = (size_t)1 << 27;
    struct zr_arena arena;
    const enum zr_isa isa = isa_under_test(state);
    struct random random = random_seeded(21);
    struct zr_team *teams[2] = {zr_team_create_for(1, isa), zr_team_create_for(3, isa)};
    uint64_t clipped = 0, covered = 0;
    zr_arena_init(&arena, ceiling);
    for (int round = 0; round < 40; round++) {
        make_subject(&subject, &random, round % 2);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(colors_are_those_of_records_that_are_written_out),
    };
    return cmocka_run_group_tests_name("lit", tests, NULL, NULL);
}
