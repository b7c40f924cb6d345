/* No data channel changes with a look, with samples or with an effect; and a picture does not change with them. */
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "scene/output.h"
#include "shade/frame.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

/* A house with a hole in its wall, one smooth mesh without normals, one with, lines, and two materials. */
#define SCENE_                                                                                                         \
    "\"window\": {\"width\": 75, \"height\": 50},"                                                                     \
    "\"view\": {\"eye\": [3, 2.5, 4], \"target\": [0.4, 0.3, 0], \"perspective\": {\"yfovDegrees\": 40}},"             \
    "\"polygons\": [{\"vertices\": [[-1,0,0],[1,0,0],[1,1,0],[0,1.7,0],[-1,1,0]],"                                     \
    "                \"holes\": [[[-0.5,0.2,0],[-0.5,0.8,0],[0.1,0.8,0],[0.1,0.2,0]]], \"color\": \"#cc3333\"}],"      \
    "\"meshes\": [{\"positions\": [[0,0,1],[1,0,1],[1,0,2],[0,0,2],[0.5,1,1.5]], \"doubleSided\": true,"               \
    "              \"faces\": [[0,4,1],[1,4,2],[2,4,3],[3,4,0]], \"lines\": [[0,2],[1,3]]},"                           \
    "             {\"positions\": [[-1,0,1],[-0.2,0,1],[-0.2,0.8,1.2]], \"normals\": [[0,0,1],[1,0,1],[0,1,1]],"       \
    "              \"faces\": [[0,1,2]]}]"
enum { PIXELS = 75 * 50, TEXT_SIZE = 4096 };

#define COLOR "{\"channel\": \"color\"}"

/* All channels that have numbers, between two other outputs; until the next call. */
static const char *data(const char *before, const char *behind)
{
    static char text[TEXT_SIZE];
    int used = snprintf(text, sizeof text, "%s", before);
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (zr_channel_rows[c].values == ZR_VALUES_FLOAT32 || zr_channel_rows[c].values == ZR_VALUES_UINT32)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s{\"channel\": \"%s\"%s}", used ? ", " : "",
                             zr_channel_rows[c].name,
                             c == ZR_CHANNEL_FLOW ? ", \"to\": {\"view\": {\"preset\": \"front\"}}" : "");
    snprintf(text + used, sizeof text - (size_t)used, "%s%s", *behind ? ", " : "", behind);
    return text;
}

struct drawing {
    struct reading *reading;
    struct zr_arena arena;
    const struct zr_frame *frame;
};

static void draw(struct drawing *d, const char *outputs, const char *rest)
{
    char text[TEXT_SIZE];
    struct zr_error error = {.status = ZR_OK};
    const int length =
        snprintf(text, sizeof text, "{" SCENE_ ", \"outputs\": [%s]%s%s}", outputs, *rest ? ", " : "", rest);
    assert_in_range(length, 1, TEXT_SIZE - 1);
    d->reading = read_scene(text);
    zr_arena_init(&d->arena, (size_t)1 << 28);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &d->arena, .error = &error}, d->reading->scene, NULL, &d->frame), ZR_OK);
}

static void end(struct drawing *d)
{
    zr_arena_free(&d->arena);
    reading_free(d->reading);
}

static const char *const pictures[] = {
    "\"look\": \"studio\"",
    "\"look\": \"technical\"",
    "\"look\": \"outdoor\"",
    "\"look\": \"blueprint\"",
    "\"look\": \"xray\"",
    "\"samples\": 16",
    "\"samples\": 4, \"colorManagement\": \"srgb\", \"occlusion\": true, \"edges\": {\"width\": 3}",
    "\"creaseDegrees\": 60, \"groundShadow\": true, \"exposure\": 2, \"toneMapping\": \"khronos-neutral\"",
};

TEST(data_channels_know_nothing_of_pictures)
{
    struct drawing plain;
    draw(&plain, data("", ""), "");
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++)
        for (int with_color = 0; with_color < 2; with_color++) {
            struct drawing other;
            draw(&other, data("", with_color ? COLOR : ""), pictures[i]);
            for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
                const size_t bytes = (size_t)PIXELS * zr_channel_rows[c].words * 4;
                if (c == ZR_CHANNEL_COLOR || !plain.frame->channels[c]) continue;
                assert_non_null(other.frame->channels[c]);
                if (memcmp(plain.frame->channels[c], other.frame->channels[c], bytes) != 0)
                    fail_msg("%s is another with %s", zr_channel_rows[c].name, pictures[i]);
            }
            assert_true(plain.frame->deepest == other.frame->deepest);
            assert_int_equal(plain.frame->covered_pixels, other.frame->covered_pixels);
            end(&other);
        }
    end(&plain);
}

TEST(pictures_know_nothing_of_data_channels)
{
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        struct drawing alone, beside;
        draw(&alone, COLOR, pictures[i]);
        draw(&beside, data(COLOR, ""), pictures[i]);
        assert_memory_equal(alone.frame->color, beside.frame->color, PIXELS * 4);
        end(&beside);
        end(&alone);
    }
}

/* A cube on the ground, seen by a camera that is a matrix, whose upper 3x3 is that of a turn times `scale`. */
static const struct zr_frame *draw_scaled(struct reading **reading, struct zr_arena *in, double scale)
{
    char text[TEXT_SIZE];
    struct zr_error error = {.status = ZR_OK};
    const struct zr_frame *frame;
    const double s = scale;
    snprintf(text, sizeof text,
             "{\"look\": \"studio\", \"window\": {\"width\": 75, \"height\": 50}, \"view\": {\"perspective\":"
             "{\"yfovDegrees\": 40}, \"worldToCamera\": [%g,0,0,0, 0,%g,%g,0, 0,%g,%g,0, %g,%g,%g,1]}, \"meshes\": [{"
             "\"doubleSided\": true, \"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]],"
             "\"faces\": [[0,3,2,1],[4,5,6,7],[0,1,5,4],[3,7,6,2],[0,4,7,3],[1,2,6,5]]}]}",
             s, 0.8 * s, 0.6 * s, -0.6 * s, 0.8 * s, -0.5 * s, 0.1 * s, -4 * s);
    *reading = read_scene(text);
    zr_arena_init(in, (size_t)1 << 28);
    assert_int_equal(zr_render(&(struct zr_run){.arena = in, .error = &error}, (*reading)->scene, NULL, &frame), ZR_OK);
    return frame;
}

TEST(cameras_that_scale_show_the_same)
{
    static const double scales[] = {0.01, 100};
    struct reading *plain, *scaled;
    struct zr_arena of_plain, of_scaled;
    const struct zr_frame *want = draw_scaled(&plain, &of_plain, 1);
    assert_true(want->covered_samples > 300 * 16);
    for (int i = 0; i < 2; i++) {
        const struct zr_frame *got = draw_scaled(&scaled, &of_scaled, scales[i]);
        for (size_t k = 0; k < (size_t)PIXELS * 4; k++)
            if (abs(got->color[k] - want->color[k]) > 2)
                fail_msg("scale %g, pixel %zu: %d, not %d", scales[i], k / 4, got->color[k], want->color[k]);
        zr_arena_free(&of_scaled);
        reading_free(scaled);
    }
    zr_arena_free(&of_plain);
    reading_free(plain);
}

RUN_TESTS(NULL, NULL)
