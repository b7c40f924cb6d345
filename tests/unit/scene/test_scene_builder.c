/* What readers make scenes with. */
#include "base/team.h"
#include "scene/looks.h"
#include "scene/scene_builder.h"
#include "support/tests.h"

static struct zr_material material(float red, bool unfilled)
{
    return (struct zr_material){.base_color = {red, 0, 0, 1}, .unfilled = unfilled, .outline_color = {0, 0, 0, 1}};
}

TEST(equal_materials_have_one_number)
{
    enum { KINDS = 1000 };
    struct zr_arena arena;
    struct zr_scene scene = {.picture = zr_look_textbook()->picture, .mesh_count = 0};
    zr_arena_init(&arena, (size_t)1 << 22);
    struct zr_scene_builder builder = zr_scene_builder_open(&arena, NULL, &scene);
    for (int again = 0; again < 2; again++)
        for (uint32_t i = 0; i < KINDS; i++) {
            const struct zr_material filled = material((float)i, false), unfilled = material((float)i, true);
            assert_int_equal(zr_scene_builder_material(&builder, &filled), 2 * i);
            assert_int_equal(zr_scene_builder_material(&builder, &unfilled), 2 * i + 1);
        }
    const struct zr_material minus_zero = material(-0.0f, false);
    assert_int_equal(zr_scene_builder_material(&builder, &minus_zero), 0);
    zr_scene_builder_close(&builder);
    assert_int_equal(scene.material_count, 2 * KINDS);
    for (uint32_t i = 0; i < 2 * KINDS; i++) {
        assert_true(scene.materials[i].base_color.x == (float)(i / 2));
        assert_int_equal(scene.materials[i].unfilled, i % 2);
    }
    zr_arena_free(&arena);
}

TEST(what_meshes_leave_open_is_filled_in)
{
    enum { TRIANGLES = 50000 };
    static const uint32_t offsets[] = {0, 4, 7};
    struct zr_team *team = zr_team_create(2);
    for (int threads = 1; threads <= 2; threads++) {
        struct zr_arena arena;
        struct zr_scene scene = {.picture = zr_look_textbook()->picture, .mesh_count = 0};
        zr_arena_init(&arena, (size_t)1 << 22);
        struct zr_scene_builder builder = zr_scene_builder_open(&arena, threads > 1 ? team : NULL, &scene);
        struct zr_mesh *meshes = zr_scene_builder_meshes(&builder, 3);
        assert_non_null(meshes);
        meshes[0].face_count = TRIANGLES;
        meshes[1].face_count = 2;
        meshes[1].face_offsets = offsets;
        zr_scene_builder_close(&builder);
        assert_int_equal(scene.mesh_count, 3);
        for (uint32_t i = 0; i < TRIANGLES; i++)
            assert_int_equal(scene.meshes[0].face_offsets[i], 3 * i);
        for (uint32_t i = 0; i < 3 * TRIANGLES; i++)
            assert_int_equal(scene.meshes[0].indices[i], i);
        assert_int_equal(scene.meshes[0].face_offsets[TRIANGLES], 3 * TRIANGLES);
        assert_ptr_equal(scene.meshes[1].face_offsets, offsets);
        assert_int_equal(scene.meshes[1].indices[6], 6);
        assert_string_equal(scene.meshes[2].name, "");
        assert_int_equal(scene.meshes[2].face_offsets[0], 0);
        zr_arena_free(&arena);
    }
    zr_team_destroy(team);
}

TEST(memory_that_is_short_is_seen_in_the_arena)
{
    struct zr_arena arena;
    struct zr_scene scene = {.picture = zr_look_textbook()->picture, .mesh_count = 0};
    zr_arena_init(&arena, 4096);
    struct zr_scene_builder builder = zr_scene_builder_open(&arena, NULL, &scene);
    struct zr_mesh *meshes = zr_scene_builder_meshes(&builder, 1);
    assert_non_null(meshes);
    meshes->face_count = 100000;
    const struct zr_material one = material(1, false);
    assert_int_equal(zr_scene_builder_material(&builder, &one), 0);
    zr_scene_builder_close(&builder);
    assert_false(zr_arena_ok(&arena));
    assert_int_equal(zr_scene_builder_material(&builder, &one), 0);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
