/* Texture coordinates of any size: whole repeats are taken off. */
#include <math.h>

#include "shade/texcoords.h"
#include "support/tests.h"

static struct zr_texture texture_of(float scale, enum zr_wrap wrap)
{
    return (struct zr_texture){.wrap_s = wrap, .wrap_t = wrap, .rows = {{scale, 0, 0}, {0, scale, 0}}};
}

TEST(near_coordinates_stay)
{
    const zr_vec4 given[] = {{3, -4, 5, 6}, {9999, 0.25f, 0, -9999}};
    const struct zr_mesh mesh = {.position_count = 2, .texcoords = given};
    zr_vec4 out[2];
    assert_false(zr_texcoords_are_far(&mesh));
    zr_texcoords_put(&mesh, NULL, 15, out);
    assert_memory_equal(out, given, sizeof out);
}

TEST(far_coordinates_lose_an_even_number_of_repeats)
{
    const zr_vec4 given[] = {{376010, 0.5f, 0, -2e9f}, {376011.25f, 0.75f, 0, -2e9f}};
    const struct zr_mesh mesh = {.position_count = 2, .texcoords = given};
    const struct zr_texture repeated = texture_of(1, ZR_WRAP_REPEAT), clamped = texture_of(1, ZR_WRAP_CLAMP);
    zr_vec4 out[2];
    assert_true(zr_texcoords_are_far(&mesh));
    zr_texcoords_put(&mesh, NULL, 1 | 8, out);
    assert_true(out[0].x == 0.0f && out[1].x == 1.25f && out[0].y == 0.5f && out[0].w == 0.0f);
    zr_texcoords_put(&mesh, &repeated, 0, out);
    assert_true(out[0].x == 0.0f && out[1].x == 1.25f && out[1].y == 0.75f);
    zr_texcoords_put(&mesh, &clamped, 0, out);
    assert_true(out[0].x == 376010.0f);
}

TEST(transforms_of_any_size_stay_finite)
{
    const zr_vec4 given[] = {{1e38f, 0.5f, 0, 0}, {1e38f, 1, 0, 0}};
    const struct zr_mesh mesh = {.position_count = 2, .texcoords = given};
    const struct zr_texture far = texture_of(1e12f, ZR_WRAP_REPEAT), clamped = texture_of(1e12f, ZR_WRAP_CLAMP);
    zr_vec4 out[2];
    zr_texcoords_put(&mesh, &far, 0, out);
    assert_true(out[0].x == out[1].x && fabsf(out[0].x) <= 1e12f && out[1].y - out[0].y == 5e11f);
    zr_texcoords_put(&mesh, &clamped, 0, out);
    assert_true(out[0].x == 1e12f);
}

TEST(only_whole_scales_keep_repeats)
{
    struct zr_texture textures[] = {texture_of(2, ZR_WRAP_REPEAT), texture_of(1.5f, ZR_WRAP_MIRROR),
                                    texture_of(1, ZR_WRAP_CLAMP)};
    const struct zr_scene scene = {.textures = textures, .texture_count = 3};
    const unsigned wanted[] = {15, 12, 12};
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(zr_texcoords_repeat(&scene, &(struct zr_material){.textures = {i + 1}}), wanted[i]);
    textures[2].texcoord = 1;
    assert_int_equal(zr_texcoords_repeat(&scene, &(struct zr_material){.textures = {1, 0, 3}}), 3);
}

RUN_TESTS(NULL, NULL)
