/* Levels of textures, and what they take. */
#include "shade/texture_maps.h"

#include "base/run.h"
#include "support/tests.h"

static struct zr_arena arena;

static void open_arena(void)
{
    zr_arena_init(&arena, (size_t)1 << 24);
}

/* A scene of one image and one texture, which its material has. */
struct test {
    struct zr_image image;
    struct zr_texture texture;
    struct zr_material material;
    struct zr_scene scene;
    struct zr_texture_maps maps;
};

static void make(struct test *test, uint32_t width, uint32_t height, uint32_t bits, const void *texels, bool decode)
{
    test->image = (struct zr_image){width, height, bits, texels, NULL};
    test->texture.is_color = true;
    test->material.textures[0] = 1;
    test->scene = (struct zr_scene){.image_count = 1,
                                    .images = &test->image,
                                    .texture_count = 1,
                                    .textures = &test->texture,
                                    .material_count = 1,
                                    .materials = &test->material};
    assert_int_equal(zr_texture_maps_make(&(struct zr_run){.arena = &arena}, &test->scene, decode, &test->maps), ZR_OK);
}

TEST(levels_halve_down_to_one_texel)
{
    static const uint8_t texels[7 * 3 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR};
    open_arena();
    make(&test, 7, 3, 8, texels, false);
    const struct zr_texture_map *map = &test.maps.of[0];
    static const uint32_t sides[3][2] = {{7, 3}, {3, 1}, {1, 1}};
    assert_int_equal(map->level_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(map->levels[i].width, sides[i][0]);
        assert_int_equal(map->levels[i].height, sides[i][1]);
    }
    assert_ptr_equal(map->levels[0].texels, texels);
    zr_arena_free(&arena);
}

TEST(no_level_is_made_that_nobody_looks_at)
{
    static const uint8_t texels[64 * 64 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR};
    open_arena();
    make(&test, 64, 64, 8, texels, true);
    assert_int_equal(test.maps.of[0].level_count, 1);
    assert_true(zr_texture_maps_measure(&test.scene, false).texels == 0.0);
    zr_arena_free(&arena);
}

TEST(a_texture_that_no_material_has_gets_no_levels)
{
    static const uint8_t texels[64 * 64 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR};
    open_arena();
    make(&test, 64, 64, 8, texels, true);
    assert_true(test.maps.of[0].level_count > 1);
    test.scene.material_count = 0;
    assert_int_equal(zr_texture_maps_make(&(struct zr_run){.arena = &arena}, &test.scene, true, &test.maps), ZR_OK);
    assert_int_equal(test.maps.of[0].level_count, 0);
    zr_arena_free(&arena);
}

/* Two textures of one image, and one of an image of another size. */
TEST(textures_share_a_place_if_they_sample_the_same_texels)
{
    static const uint8_t texels[8 * 8 * 4];
    const struct zr_image images[2] = {{8, 8, 8, texels, NULL}, {8, 4, 8, texels, NULL}};
    const struct zr_texture first = {.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR, .rows = {{1, 0, 0}, {0, 1, 0}}};
    struct zr_texture textures[7] = {first, first, first, first, first, first, first};
    struct zr_material materials[7] = {0};
    struct zr_texture_maps maps;
    const struct zr_scene scene = {.image_count = 2,
                                   .images = images,
                                   .texture_count = 7,
                                   .textures = textures,
                                   .material_count = 7,
                                   .materials = materials};
    for (uint32_t i = 0; i < 7; i++)
        materials[i].textures[0] = 1 + i;
    textures[1].is_color = true;
    textures[2].image = 1;
    textures[3].texcoord = 1;
    textures[4].wrap_t = ZR_WRAP_CLAMP;
    textures[5].magnify = ZR_FILTER_LINEAR;
    textures[6].rows[1][2] = 0.5f;
    open_arena();
    assert_int_equal(zr_texture_maps_make(&(struct zr_run){.arena = &arena}, &scene, true, &maps), ZR_OK);
    assert_int_equal(maps.of[1].place, maps.of[0].place);
    for (uint32_t i = 2; i < 7; i++)
        for (uint32_t k = 0; k < i; k++)
            assert_int_not_equal(maps.of[i].place, maps.of[k].place);
    zr_arena_free(&arena);
}

/* Whatever its value, a texel that is averaged with its like stays as it is. */
TEST(colours_that_are_alike_stay)
{
    for (uint32_t bits = 8; bits <= 16; bits += 8)
        for (uint32_t value = 0; value < 1u << bits; value += bits == 8 ? 1 : 257) {
            uint16_t words[2 * 4];
            uint8_t bytes[2 * 4];
            for (int i = 0; i < 8; i++) {
                words[i] = (uint16_t)value;
                bytes[i] = (uint8_t)value;
            }
            struct test test = {.texture.minify = ZR_FILTER_NEAREST_MIPMAP_NEAREST};
            open_arena();
            make(&test, 2, 1, bits, bits == 8 ? (const void *)bytes : (const void *)words, true);
            assert_memory_equal(test.maps.of[0].levels[1].texels, bits == 8 ? (const void *)bytes : (const void *)words,
                                bits / 2);
            zr_arena_free(&arena);
        }
}

/* As much as was foretold, but for what arrays are aligned to; and not a third less. */
TEST(memory_is_foretold)
{
    enum { WIDTH = 300, HEIGHT = 200 };
    static const uint8_t texels[WIDTH * HEIGHT * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR};
    open_arena();
    const size_t before = arena.used;
    make(&test, WIDTH, HEIGHT, 8, texels, true);
    const double taken = (double)(arena.used - before);
    const struct zr_texture_maps_size told = zr_texture_maps_measure(&test.scene, true);
    assert_true(taken <= told.bytes + 2048.0 && told.bytes <= taken * 1.34);
    assert_true(told.texels >= WIDTH * HEIGHT / 3.05 && told.texels <= WIDTH * HEIGHT / 2.9);
    zr_arena_free(&arena);
}

TEST(memory_that_is_short_is_told)
{
    static const uint8_t texels[64 * 64 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR};
    open_arena();
    make(&test, 64, 64, 8, texels, true);
    zr_arena_free(&arena);
    for (size_t ceiling = 0; ceiling < 4096; ceiling += 256) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        const enum zr_status status =
            zr_texture_maps_make(&(struct zr_run){.arena = &small}, &test.scene, true, &test.maps);
        assert_int_equal(status, ZR_NO_MEMORY);
        zr_arena_free(&small);
    }
}

RUN_TESTS(NULL, NULL)
