/* GIF files: a reader of its own gives the pixels back. */
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "output/images/gif.h"
#include "support/pictures/gif.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

enum { SIDE_MAX = 640, PIXELS_MAX = SIDE_MAX * SIDE_MAX };
static uint8_t rgba[4 * PIXELS_MAX], read[4 * PIXELS_MAX];

static struct zr_buffer write_gif(uint32_t width, uint32_t height, bool has_alpha)
{
    const struct zr_gif gif = {.width = width, .height = height, .rgba = rgba, .has_alpha = has_alpha};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_gif_write(&gif, NULL, &out), ZR_OK);
    return out;
}

/* Reads a file of one frame into `read`. */
static void read_back(uint32_t width, uint32_t height, bool has_alpha)
{
    const struct zr_buffer out = write_gif(width, height, has_alpha);
    struct gif gif = gif_open(out.bytes, out.size);
    assert_true(gif.width == width && gif.height == height && !gif.repeats);
    assert_true(gif_next(&gif, read));
    assert_false(gif_next(&gif, read));
}

/* Fills the picture with random pixels of some colours. */
static void make_noise(uint32_t pixels, uint32_t colors, bool has_alpha, uint64_t seed)
{
    struct random random = random_seeded(seed);
    for (uint32_t i = 0; i < pixels; i++) {
        const uint32_t color = (uint32_t)random_next(&random) % colors;
        const uint8_t pixel[] = {(uint8_t)(37 * color), (uint8_t)(color / 7), (uint8_t)(color >> 3),
                                 (uint8_t)(has_alpha && color % 3 == 0 ? color % 128 : 128 + color % 128)};
        memcpy(rgba + 4 * i, pixel, 4);
    }
}

TEST_AROUND(up_to_256_colors_are_kept, open_arena, close_arena)
{
    static const uint32_t colors[] = {1, 2, 3, 4, 5, 16, 17, 255, 256};
    static const uint32_t sides[][2] = {{1, 1}, {1, 7}, {2, 1}, {61, 37}, {640, 640}};
    for (size_t k = 0; k < sizeof colors / sizeof *colors; k++)
        for (size_t s = 0; s < sizeof sides / sizeof *sides; s++)
            for (int has_alpha = 0; has_alpha < 2; has_alpha++) {
                const uint32_t pixels = sides[s][0] * sides[s][1];
                make_noise(pixels, colors[k], has_alpha, 1 + k);
                read_back(sides[s][0], sides[s][1], has_alpha);
                for (uint32_t i = 0; i < pixels; i++) {
                    const bool is_out = has_alpha && rgba[4 * i + 3] < 128;
                    assert_int_equal(read[4 * i + 3], is_out ? 0 : 255);
                    if (!is_out) assert_memory_equal(read + 4 * i, rgba + 4 * i, 3);
                }
            }
}

/* Returns the mean of the squared distance between the colours of visible pixels, and compares alpha. */
static double compare(uint32_t pixels, bool has_alpha)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t i = 0; i < 4 * pixels; i += 4) {
        const bool is_out = has_alpha && rgba[i + 3] < 128;
        assert_int_equal(read[i + 3], is_out ? 0 : 255);
        if (is_out) continue;
        count++;
        for (int c = 0; c < 3; c++)
            sum += (read[i + (uint32_t)c] - rgba[i + (uint32_t)c]) * (read[i + (uint32_t)c] - rgba[i + (uint32_t)c]);
    }
    return sum / count;
}

/* 256 boxes by halving have sides of 32, 32 and 64, and a mean squared distance of (32^2 + 32^2 + 64^2) / 12 = 512. */
TEST_AROUND(random_colors_are_as_near_as_those_of_256_halved_boxes, open_arena, close_arena)
{
    for (int has_alpha = 0; has_alpha < 2; has_alpha++) {
        struct random random = random_seeded(3);
        for (size_t i = 0; i < sizeof rgba; i++)
            rgba[i] = (uint8_t)random_next(&random);
        read_back(SIDE_MAX, SIDE_MAX, has_alpha);
        assert_true(compare(PIXELS_MAX, has_alpha) < 530.0);
    }
}

/* 640 * 640 shades between two colours: 256 steps of the longest side are at most half a step away. */
TEST_AROUND(shades_are_near, open_arena, close_arena)
{
    for (uint32_t i = 0; i < PIXELS_MAX; i++) {
        const uint32_t x = i % SIDE_MAX, y = i / SIDE_MAX;
        const uint8_t pixel[] = {(uint8_t)(x * 255 / 639), (uint8_t)(x * 200 / 639 + y % 2), (uint8_t)(x / 4), 255};
        memcpy(rgba + 4 * i, pixel, 4);
    }
    read_back(SIDE_MAX, SIDE_MAX, false);
    assert_true(compare(PIXELS_MAX, false) < 3.0);
}

TEST_AROUND(frames_are_whole_pictures_and_their_times_add_up, open_arena, close_arena)
{
    enum { FRAMES = 7, SIDE = 20 };
    struct zr_buffer out = {.arena = &arena};
    struct zr_gif_frames frames = {.out = &out, .frames = FRAMES, .seconds = 1.0 / FRAMES};
    uint32_t hundredths = 0;
    for (uint32_t k = 0; k < FRAMES; k++) {
        make_noise(SIDE * SIDE, 50 + 90 * k, k % 2, k);
        const struct zr_buffer frame = write_gif(SIDE, SIDE, k % 2);
        assert_int_equal(zr_gif_frames_add(&frames, frame.bytes, frame.size), ZR_OK);
    }
    struct gif gif = gif_open(out.bytes, out.size);
    assert_true(gif.repeats);
    for (uint32_t k = 0; k < FRAMES; k++) {
        assert_true(gif_next(&gif, read));
        hundredths += gif.delay;
        make_noise(SIDE * SIDE, 50 + 90 * k, k % 2, k);
        assert_true(compare(SIDE * SIDE, k % 2) < (k < 3 ? 1.0 : 60.0));
    }
    assert_false(gif_next(&gif, read));
    assert_int_equal(hundredths, 100);
}

TEST_AROUND(cancelled_writing_ends, open_arena, close_arena)
{
    static const struct zr_cancel cancel = {.raised = true};
    make_noise(PIXELS_MAX, 9999, false, 1);
    const struct zr_gif gif = {.width = SIDE_MAX, .height = SIDE_MAX, .rgba = rgba};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_gif_write(&gif, &cancel, &out), ZR_CANCELLED);
}

RUN_TESTS(NULL, NULL)
