/* Levels of textures, and what they take. */
#include "shade/texture_maps.h"

#include "support/cmocka_all.h"

static struct zr_arena arena;

static void open_arena(void)
{
    zr_arena_init(&arena, (size_t)1 << 24);
}

/* A scene of one image and one texture. */
struct test {
    struct zr_image image;
    struct zr_texture texture;
    struct zr_scene scene;
    struct zr_texture_maps maps;
};

static void make(struct test *test, uint32_t width, uint32_t height, uint32_t bits, const void *texels, bool decode)
{
    test->image = (struct zr_image){width, height, bits, texels};
    test->texture.is_color = true;
    test->scene =
        (struct zr_scene){.image_count = 1, .images = &test->image, .texture_count = 1, .textures = &test->texture};
    assert_int_equal(zr_texture_maps_make(&arena, NULL, &test->scene, decode, NULL, &test->maps), ZR_OK);
}

static const uint8_t *texel(const struct test *test, uint32_t level, uint32_t number)
{
    return (const uint8_t *)test->maps.of[0].levels[level].texels + 4 * number;
}

static void levels_halve_down_to_one_texel(void **state)
{
    (void)state;
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

static void no_level_is_made_that_nobody_looks_at(void **state)
{
    (void)state;
    static const uint8_t texels[64 * 64 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR};
    open_arena();
    make(&test, 64, 64, 8, texels, true);
    assert_int_equal(test.maps.of[0].level_count, 1);
    assert_true(zr_texture_maps_measure(&test.scene, false).texels == 0.0);
    zr_arena_free(&arena);
}

static void values_as_they_are_have_their_mean_rounded_half_up(void **state)
{
    (void)state;
    static const uint8_t texels[2 * 2 * 4] = {0, 10, 255, 1, 1, 10, 255, 1, 0, 11, 255, 2, 1, 11, 254, 2};
    static const uint8_t want[4] = {1, 11, 255, 2}; /* 0.5, 10.5, 254.75, 1.5 */
    struct test test = {.texture.minify = ZR_FILTER_NEAREST_MIPMAP_NEAREST};
    open_arena();
    make(&test, 2, 2, 8, texels, false);
    assert_memory_equal(texel(&test, 1, 0), want, 4);
    zr_arena_free(&arena);
}

/* Black and white are half the light, which is 188 of 255; alpha is no colour. */
static void colours_are_averaged_in_linear_light(void **state)
{
    (void)state;
    static const uint8_t texels[2 * 4] = {0, 0, 0, 0, 255, 255, 255, 255};
    static const uint8_t want[4] = {188, 188, 188, 128};
    struct test test = {.texture.minify = ZR_FILTER_NEAREST_MIPMAP_NEAREST};
    open_arena();
    make(&test, 2, 1, 8, texels, true);
    assert_memory_equal(texel(&test, 1, 0), want, 4);
    zr_arena_free(&arena);
}

/* Whatever its value, a texel that is averaged with its like stays as it is. */
static void colours_that_are_alike_stay(void **state)
{
    (void)state;
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

/* Of five texels two cover two and a half each. */
static void odd_sides_are_shared_by_area(void **state)
{
    (void)state;
    static const uint8_t texels[5 * 4] = {100, 0, 0, 0, 50, 0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 200, 0, 0, 0};
    struct test test = {.texture.minify = ZR_FILTER_NEAREST_MIPMAP_NEAREST};
    open_arena();
    make(&test, 5, 1, 8, texels, false);
    assert_int_equal(texel(&test, 1, 0)[0], 62); /* (2 100 + 2 50 + 10) / 5 */
    assert_int_equal(texel(&test, 1, 1)[0], 90); /* (10 + 2 20 + 2 200) / 5 */
    zr_arena_free(&arena);
}

/* Even sides of 8 bits are halved another way than odd ones: the same comes of it, whatever two texels meet. */
static void two_rows_that_are_alike_halve_as_one_row_does(void **state)
{
    (void)state;
    enum { WIDTH = 512 };
    static uint8_t texels[2 * WIDTH * 4];
    for (int value = 0; value < 256; value++)
        for (int decode = 0; decode < 2; decode++) {
            struct test one = {.texture.minify = ZR_FILTER_NEAREST_MIPMAP_NEAREST}, two = one;
            for (int i = 0; i < 2 * WIDTH * 4; i++)
                texels[i] = (uint8_t)(i / 4 % 2 ? value : i / 8 % 256);
            open_arena();
            make(&one, WIDTH, 1, 8, texels, decode);
            make(&two, WIDTH, 2, 8, texels, decode);
            assert_memory_equal(texel(&two, 1, 0), texel(&one, 1, 0), WIDTH / 2 * 4);
            zr_arena_free(&arena);
        }
}

/* As much as was foretold, but for what arrays are aligned to; and not a third less. */
static void memory_is_foretold(void **state)
{
    (void)state;
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

static void memory_that_is_short_is_told(void **state)
{
    (void)state;
    static const uint8_t texels[64 * 64 * 4];
    struct test test = {.texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR};
    open_arena();
    make(&test, 64, 64, 8, texels, true);
    zr_arena_free(&arena);
    for (size_t ceiling = 0; ceiling < 4096; ceiling += 256) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        const enum zr_status status = zr_texture_maps_make(&small, NULL, &test.scene, true, NULL, &test.maps);
        assert_int_equal(status, ZR_NO_MEMORY);
        zr_arena_free(&small);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(levels_halve_down_to_one_texel),
                                       cmocka_unit_test(no_level_is_made_that_nobody_looks_at),
                                       cmocka_unit_test(values_as_they_are_have_their_mean_rounded_half_up),
                                       cmocka_unit_test(colours_are_averaged_in_linear_light),
                                       cmocka_unit_test(colours_that_are_alike_stay),
                                       cmocka_unit_test(odd_sides_are_shared_by_area),
                                       cmocka_unit_test(two_rows_that_are_alike_halve_as_one_row_does),
                                       cmocka_unit_test(memory_is_foretold),
                                       cmocka_unit_test(memory_that_is_short_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
