#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

#include "base/run.h"
#include "output/images/depth16.h"
#include "output/images/png.h"
#include "output/info.h"
#include "output/npy.h"
#include "output/zip.h"
#include "support/pictures/png.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 27)

/* What libpng's own reader makes of a file, in `format`. */
static unsigned char *decode(const void *bytes, size_t size, png_uint_32 format, png_image *image)
{
    memset(image, 0, sizeof *image);
    image->version = PNG_IMAGE_VERSION;
    assert_true(png_image_begin_read_from_memory(image, bytes, size));
    image->format = format;
    unsigned char *pixels = zr_arena_alloc(&arena, PNG_IMAGE_SIZE(*image), 1);
    assert_true(png_image_finish_read(image, NULL, pixels, 0, NULL));
    return pixels;
}

TEST_AROUND(png_gives_back_the_pixels_of_odd_sizes, open_arena, close_arena)
{
    struct random random = random_seeded(3);
    static uint32_t pixels[97 * 61];
    for (size_t i = 0; i < 97 * 61; i++)
        pixels[i] = (uint32_t)random_next(&random);
    const uint32_t widths[] = {1, 2, 97, 5917}, heights[] = {5917, 3, 61, 1};
    for (int i = 0; i < 4; i++)
        for (int alpha = 0; alpha < 2; alpha++) {
            struct zr_png png = {
                .kind = alpha ? ZR_PNG_RGBA : ZR_PNG_RGB, .width = widths[i], .height = heights[i], .pixels = pixels};
            struct zr_buffer out = {.arena = &arena};
            assert_int_equal(zr_png_write(&png, NULL, NULL, &out), ZR_OK);
            png_image image;
            unsigned char *got = decode(out.bytes, out.size, alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB, &image);
            assert_int_equal(image.width, widths[i]);
            assert_int_equal(image.height, heights[i]);
            const unsigned char *want = (const unsigned char *)pixels;
            size_t channels = alpha ? 4 : 3;
            for (size_t k = 0; k < (size_t)widths[i] * heights[i]; k++)
                assert_memory_equal(got + k * channels, want + 4 * k, channels);
        }
}

TEST_AROUND(png_of_16_bits_is_grey_and_big_endian, open_arena, close_arena)
{
    const uint16_t steps[4] = {0, 1, 0x1234, 65535};
    struct zr_png png = {.kind = ZR_PNG_GREY16, .width = 2, .height = 2, .pixels = steps, .text = "scale"};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_png_write(&png, NULL, NULL, &out), ZR_OK);
    assert_int_equal(out.bytes[24], 16); /* IHDR: bits a channel */
    assert_int_equal(out.bytes[25], 0);  /* grey */
    png_image image;
    unsigned char *got = decode(out.bytes, out.size, PNG_FORMAT_LINEAR_Y, &image);
    /* The simplified reader takes 16-bit files as linear light already. */
    assert_memory_equal(got, steps, sizeof steps);
    assert_non_null(memmem(out.bytes, out.size, "tEXtComment\0scale", 17));
}

TEST_AROUND(png_without_memory_or_cancelled_fails_cleanly, open_arena, close_arena)
{
    static uint32_t pixels[300 * 300];
    struct zr_png png = {.kind = ZR_PNG_RGB, .width = 300, .height = 300, .pixels = pixels};
    int failures = 0;
    for (size_t ceiling = 0; ceiling < 2000000; ceiling += 20000) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        struct zr_buffer out = {.arena = &small};
        enum zr_status status = zr_png_write(&png, NULL, NULL, &out);
        assert_true(status == ZR_OK || status == ZR_NO_MEMORY);
        failures += status != ZR_OK;
        zr_arena_free(&small);
    }
    assert_in_range(failures, 10, 99);
    struct zr_cancel cancel = {.raised = true};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_png_write(&png, NULL, &cancel, &out), ZR_CANCELLED);
}

TEST_AROUND(npy_has_the_header_that_numpy_writes, open_arena, close_arena)
{
    const float values[6] = {0, 1, 2, 3, 4, INFINITY};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_npy_write(ZR_NPY_FLOAT32, 3, 2, 1, values, &out), ZR_OK);
    assert_int_equal(out.size, 128 + 24);
    assert_memory_equal(out.bytes, "\x93NUMPY\x01\x00\x76\x00", 10);
    static const char dictionary[] = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }  ";
    assert_memory_equal(out.bytes + 10, dictionary, sizeof dictionary - 1);
    assert_int_equal(out.bytes[127], '\n');
    assert_memory_equal(out.bytes + 128, values, sizeof values);
}

TEST_AROUND(zip_gives_back_its_files_and_is_the_same_every_time, open_arena, close_arena)
{
    const struct zr_zip_entry entries[2] = {{"a.bin", "hello", 5}, {"b.npy", "", 0}};
    struct zr_buffer out = {.arena = &arena}, again = {.arena = &arena};
    assert_int_equal(zr_zip_write(entries, 2, &out), ZR_OK);
    assert_int_equal(zr_zip_write(entries, 2, &again), ZR_OK);
    assert_int_equal(out.size, again.size);
    assert_memory_equal(out.bytes, again.bytes, out.size);
    zip_error_t error;
    zip_error_init(&error);
    zip_t *archive =
        zip_open_from_source(zip_source_buffer_create(out.bytes, out.size, 0, &error), ZIP_CHECKCONS, &error);
    assert_non_null(archive);
    assert_int_equal(zip_get_num_entries(archive, 0), 2);
    char text[8];
    zip_file_t *file = zip_fopen(archive, "a.bin", 0);
    assert_int_equal(zip_fread(file, text, sizeof text), 5);
    assert_memory_equal(text, "hello", 5);
    zip_fclose(file);
    zip_discard(archive);
}

/* The bytes of the files are not looked at. */
TEST(zip_has_less_than_4_gib)
{
    const size_t gib = (size_t)1 << 30;
    const struct zr_zip_entry small[2] = {{"a.npy", NULL, 2 * gib}, {"b.npy", NULL, gib}},
                              large[2] = {{"a.npy", NULL, 2 * gib}, {"b.npy", NULL, 2 * gib}},
                              vast[2] = {{"a.npy", NULL, SIZE_MAX - 300}, {"b.npy", NULL, 300}};
    struct zr_buffer out = {.arena = &arena};
    size_t size;
    assert_true(zr_zip_size(small, 2, &size));
    assert_int_equal(size, 3 * gib + 22 + 2 * (30 + 46 + 2 * 5));
    assert_false(zr_zip_size(large, 2, &size));
    assert_false(zr_zip_size(vast, 2, &size));
    assert_int_equal(zr_zip_write(large, 2, &out), ZR_NO_MEMORY);
}

TEST(depth16_counts_what_does_not_fit_and_never_wraps)
{
    static const float depth[6] = {INFINITY, 0.001f, 1.0f, 65.535f, 65.6f, -3.0f};
    static const uint16_t want[6] = {0, 1, 1000, 65535, 65535, 1};
    for (enum zr_isa isa = 0; isa < ZR_ISA_COUNT; isa++) {
        uint16_t steps[6] = {7, 7, 7, 7, 7, 7};
        if (!zr_isa_is_available(isa)) continue;
        assert_int_equal(zr_depth16_of(isa)(depth, 0.001f, 6, steps), 2);
        assert_memory_equal(steps, want, sizeof want);
    }
}

/* Strips look at the row above theirs, which is made twice and counted once. */
TEST_AROUND(depth16_is_written_row_by_row, open_arena, close_arena)
{
    enum { WIDTH = 700, HEIGHT = 1200 };
    float *depth = malloc(sizeof *depth * WIDTH * HEIGHT);
    assert_non_null(depth);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        depth[i] = i % 3 == 0 ? INFINITY : 0.01f * (float)(i % 7000);
    const struct zr_frame frame = {.width = WIDTH, .height = HEIGHT, .depth = depth};
    uint64_t clamped = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        clamped += i % 3 != 0 && (i % 7000 == 0 || i % 7000 > 6553);
    static const enum zr_compress ways[] = {ZR_COMPRESS_FAST, ZR_COMPRESS_SMALL};
    struct zr_team *team = zr_team_create(3);
    for (int i = 0; i < 2; i++) {
        struct zr_depth16 depth16 = {
            .frame = &frame, .values = depth, .scale = 0.001f, .quantize = zr_depth16_of(zr_isa_best())};
        struct zr_buffer out = {.arena = &arena};
        const struct zr_png png = {.kind = ZR_PNG_GREY16,
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .rows = zr_depth16_rows(&depth16),
                                   .compress = ways[i]};
        assert_int_equal(zr_png_write(&png, team, NULL, &out), ZR_OK);
        assert_int_equal(depth16.clamped, clamped);
        uint32_t width, height;
        uint16_t *got = png_memory_read(out.bytes, out.size, PNG_AS_GREY16, &width, &height);
        assert_non_null(got);
        assert_int_equal(width, WIDTH);
        for (uint32_t y = 0; y < HEIGHT; y++) {
            uint16_t want[WIDTH];
            depth16.quantize(depth + (size_t)y * WIDTH, 0.001f, WIDTH, want);
            assert_memory_equal(got + (size_t)y * WIDTH, want, sizeof want);
        }
        free(got);
    }
    zr_team_destroy(team);
    free(depth);
}

TEST(depth16_scale_left_open_fits_the_far_plane)
{
    struct zr_frame frame = {.deepest = 10};
    frame.camera.znear = 1;
    frame.camera.zfar = 655.35f;
    assert_true(fabsf(zr_depth16_scale(&frame, 0) - 0.01f) < 1e-6f);
    assert_true(zr_depth16_scale(&frame, 0.5f) == 0.5f);
    frame.camera.znear = frame.camera.zfar = 0; /* a projectionMatrix: no planes known */
    assert_true(fabsf(zr_depth16_scale(&frame, 0) * 65535.0f - 10.0f) < 1e-4f);
}

TEST_AROUND(depth_as_png16_has_steps_of_its_scale_and_warns_of_what_does_not_fit, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, -0.5f, 1}, {0, 0, -0.5f, 1}, {-1, 1, -0.5f, 1},
                         {0, -1, -6, 1},    {1, -1, -6, 1},   {1, 0, -6, 1}};
    const struct {
        float scale;
        uint16_t steps[3]; /* where nothing is, and of the two faces */
        const char *comment;
        bool fits;
    } cases[] = {{0.25f, {0, 2, 24}, "depth in scene units = value * 0.25; 0 where nothing is", true},
                 {0.00005f, {0, 10000, 65535}, "depth in scene units = value * 4.99999987e-05;", false},
                 {0,
                  {0, 5461, 65535},
                  "depth in scene units = value * 9.15541314e-05;",
                  true}}; /* 6 / 65535: there is no far plane */
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 2);
    test.scene.views[0].projection_matrix.m[10] = 0.125f;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    uint32_t pixels[3] = {0, 0, 0};
    for (int i = 0; i < 256; i++)
        pixels[frame->face_id[i]]++;
    assert_true(pixels[0] > 0 && pixels[1] == 28 && pixels[2] > 0);
    test.scene.views[0].output_count = 1;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const struct zr_output output = {
            .channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_PNG16, .scale = cases[c].scale};
        struct zr_answer answer;
        struct zr_error error = {.count = 0};
        test.scene.views[0].outputs = &output;
        assert_int_equal(zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, frame, &answer),
                         ZR_OK);
        assert_string_equal(answer.content_type, "image/png");
        png_image image;
        const unsigned char *bytes = decode(answer.bytes, answer.size, PNG_FORMAT_LINEAR_Y, &image);
        assert_true(image.width == 16 && image.height == 16);
        for (int i = 0; i < 256; i++)
            assert_memory_equal(bytes + 2 * i, &cases[c].steps[frame->face_id[i]], 2);
        assert_non_null(memmem(answer.bytes, answer.size, cases[c].comment, strlen(cases[c].comment)));
        char warning[96];
        snprintf(warning, sizeof warning, "the depth of %u pixels does not fit 16 bits at this scale", pixels[2]);
        assert_string_equal(answer.warnings, cases[c].fits ? "" : warning);
    }
}

TEST_AROUND(depths_outside_of_a_range_are_0_or_the_greatest_value, open_arena, close_arena)
{
    /* In front of the eye: 0.5 and 6. */
    const zr_vec4 p[] = {{-1, 0, -0.5f, 1}, {0, 0, -0.5f, 1}, {-1, 1, -0.5f, 1},
                         {0, -1, -6, 1},    {1, -1, -6, 1},   {1, 0, -6, 1}};
    const struct {
        float range[2];
        uint16_t steps[3]; /* where nothing is, and of the two faces */
        float values[3];
    } cases[] = {{{0.5f, 6}, {65535, 500, 6000}, {INFINITY, 0.5f, 6}},
                 {{0.75f, 5}, {65535, 0, 65535}, {INFINITY, 0, INFINITY}},
                 {{0, 100}, {65535, 500, 6000}, {INFINITY, 0.5f, 6}}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 2);
    test.scene.views[0].projection_matrix.m[10] = 0.125f;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    test.scene.views[0].output_count = 1;
    for (size_t c = 0; c < 2 * sizeof cases / sizeof *cases; c++) {
        const float *range = cases[c / 2].range;
        const struct zr_output output = {.channel = ZR_CHANNEL_DEPTH,
                                         .encoding = c % 2 ? ZR_ENCODING_TIFF : ZR_ENCODING_PNG16,
                                         .scale = 0.001f,
                                         .has_range = true,
                                         .range = {range[0], range[1]}};
        struct zr_answer answer;
        struct zr_error error = {.count = 0};
        test.scene.views[0].outputs = &output;
        assert_int_equal(zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, frame, &answer),
                         ZR_OK);
        assert_string_equal(answer.content_type, c % 2 ? "image/tiff" : "image/png");
        png_image image;
        const unsigned char *bytes = c % 2 ? (const unsigned char *)answer.bytes + answer.size - 4 * 256
                                           : decode(answer.bytes, answer.size, PNG_FORMAT_LINEAR_Y, &image);
        for (int i = 0; i < 256; i++)
            if (c % 2)
                assert_memory_equal(bytes + 4 * i, &cases[c / 2].values[frame->face_id[i]], 4);
            else
                assert_memory_equal(bytes + 2 * i, &cases[c / 2].steps[frame->face_id[i]], 2);
        assert_string_equal(answer.warnings, "");
    }
}

TEST_AROUND(png32_is_rgba_without_a_palette, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static const struct zr_output output = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG32};
    enum { COLOR_TYPE = 25, RGBA = 6 }; /* of the IHDR */
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    test.scene.views[0].output_count = 1;
    test.scene.views[0].outputs = &output;
    const struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_int_equal(((const unsigned char *)answer.bytes)[COLOR_TYPE], RGBA);
    png_image image;
    const unsigned char *bytes = decode(answer.bytes, answer.size, PNG_FORMAT_RGBA, &image);
    for (int i = 0; i < 256; i++)
        assert_int_equal(bytes[4 * i + 3], 255);
}

TEST_AROUND(several_outputs_come_as_one_archive, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_string_equal(answer.content_type, "application/zip");
    zip_error_t error;
    zip_error_init(&error);
    zip_t *archive =
        zip_open_from_source(zip_source_buffer_create(answer.bytes, answer.size, 0, &error), ZIP_CHECKCONS, &error);
    assert_non_null(archive);
    const char *const names[] = {"color.png", "depth.npy", "windowDepth.npy", "faceId.npy"};
    for (zip_int64_t i = 0; i < 4; i++)
        assert_int_equal(zip_name_locate(archive, names[i], 0), i);
    zip_discard(archive);
}

TEST_AROUND(scene_that_shows_nothing_is_warned_of, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {-1, 1, 0, 1}, {0, 0, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    test.material.double_sided = false;
    test.scene.views[0].output_count = 1;
    assert_non_null(strstr(scene_encode(&arena, NULL, &test.scene).warnings, "faces away"));
}

TEST_AROUND(polygons_without_three_distinct_corners_are_warned_of, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1},
                         {0, 0, 0, 1},  {1, 1, 0, 1}, {1, 1, 0, 1},  {1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 3);
    assert_string_equal(
        scene_encode(&arena, NULL, &test.scene).warnings,
        "2 of 3 polygons have fewer than three distinct corners and were dropped, the first: face 1 of mesh 0 "
        "'test'");
    scene_of_triangles(&test, 16, 16, p, 1);
    assert_string_equal(scene_encode(&arena, NULL, &test.scene).warnings, "");
}

/* Warnings of 99 bytes, each with its number in front. */
static struct zr_warning_list many_warnings(uint32_t count)
{
    struct zr_warning_list made = {count, count, zr_arena_alloc(&arena, count, sizeof *made.texts)};
    for (uint32_t i = 0; i < count; i++) {
        char *text = zr_arena_alloc(&arena, 100, 1);
        snprintf(text, 100, "%03u%096d", i % 1000, 0);
        made.texts[i] = text;
    }
    return made;
}

TEST_AROUND(warnings_are_joined_whole_and_the_rest_is_counted, open_arena, close_arena)
{
    /* 20 with what is between them take 2018 bytes; 21 take 2119. */
    for (uint32_t count = 0; count <= 200; count++) {
        struct zr_warning_list warnings = many_warnings(count);
        const char *joined = zr_warnings_join(&arena, &warnings);
        const size_t length = strlen(joined);
        const uint32_t whole = count <= 20 ? count : 20;
        assert_true(length < ZR_WARNINGS_SIZE);
        for (uint32_t i = 0; i < whole; i++) {
            assert_memory_equal(joined + (size_t)101 * i, warnings.texts[i], 99);
            if (i > 0) assert_memory_equal(joined + (size_t)101 * i - 2, "; ", 2);
        }
        char rest[32] = "";
        if (count > whole) snprintf(rest, sizeof rest, "; and %u more", count - whole);
        assert_string_equal(joined + (whole > 0 ? 101 * whole - 2 : 0), rest);
    }
}

TEST_AROUND(a_warning_without_any_room_is_counted_not_cut, open_arena, close_arena)
{
    static char fits[ZR_WARNINGS_SIZE], too_long[ZR_WARNINGS_SIZE + 1];
    memset(fits, 'a', ZR_WARNINGS_SIZE - 1);
    memset(too_long, 'b', ZR_WARNINGS_SIZE);
    assert_string_equal(zr_warnings_join(&arena, &(struct zr_warning_list){1, 1, (const char *[]){fits}}), fits);
    assert_string_equal(zr_warnings_join(&arena, &(struct zr_warning_list){1, 1, (const char *[]){too_long}}),
                        "and 1 more");
    assert_string_equal(zr_warnings_join(&arena, &(struct zr_warning_list){2, 2, (const char *[]){fits, "short"}}),
                        "and 2 more");
}

TEST_AROUND(picture_without_a_covered_pixel_is_warned_of_whatever_the_reason, open_arena, close_arena)
{
    const zr_vec4 between_pixels[] = {{0.001f, 0.001f, 0, 1}, {0.002f, 0.001f, 0, 1}, {0.001f, 0.002f, 0, 1}};
    const zr_vec4 at_the_far_plane[] = {{-1, -1, 1, 1}, {1, -1, 1, 1}, {-1, 1, 1, 1}};
    const zr_vec4 away_and_clipped[] = {{-3, -1, 0, 1}, {-1, 1, 0, 1}, {0, 0, 0, 1}};
    const zr_vec4 outside[] = {{2, 2, 0, 1}, {3, 2, 0, 1}, {2, 3, 0, 1}};
    const struct {
        const zr_vec4 *positions;
        const char *text;
    } cases[] = {{between_pixels, "no pixel is covered"},
                 {at_the_far_plane, "no pixel is covered"},
                 {away_and_clipped, "faces away"},
                 {outside, "outside the view"}};
    static struct test_scene test;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene_of_triangles(&test, 16, 16, cases[i].positions, 1);
        test.material.double_sided = false;
        test.scene.views[0].output_count = 1;
        assert_non_null(strstr(scene_encode(&arena, NULL, &test.scene).warnings, cases[i].text));
    }
}

RUN_TESTS(NULL, NULL)
