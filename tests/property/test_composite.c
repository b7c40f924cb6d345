/* A scene drawn in two halves, the second into what the first gave, is the scene drawn at
 * once: to the byte, in every channel, through the encodings and back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "core.h"
#include "render_request.h"
#include "scene/output.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

enum { POLYGONS_MAX = 60, POLYGON_SIZE = 600, SCENE_SIZE = POLYGONS_MAX * POLYGON_SIZE + 4096, CHANNELS = 4 };

static const struct zr_output OUTPUTS[CHANNELS] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                                   {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                                   {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY},
                                                   {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
static const char *const NAMES[CHANNELS] = {"color", "windowDepth", "depth", "faceId"};

TEST_ARENA(1 << 28)
static char polygons[POLYGONS_MAX][POLYGON_SIZE];
static char head[1024];

/* The four channels of a picture, encoded. */
struct picture {
    struct zr_answer channels[CHANNELS];
    const struct zr_frame *frame;
    uint64_t covered;
};

static struct picture draw(const char *text, const struct zr_asset *assets, size_t asset_count)
{
    struct zr_limits limits = zr_limits_default();
    struct zr_request request = {
        .format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text), .assets = assets, .asset_count = asset_count};
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct picture picture;
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s: %s", error.items[0].pointer, error.items[0].detail);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame), ZR_OK);
    for (int i = 0; i < CHANNELS; i++) {
        struct zr_view view = *frame->view;
        struct zr_frame one = *frame;
        view.outputs = &OUTPUTS[i];
        view.output_count = 1;
        one.view = &view;
        assert_int_equal(
            zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, scene, &one, &picture.channels[i]), ZR_OK);
    }
    picture.frame = frame;
    picture.covered = frame->covered_pixels;
    return picture;
}

/* The polygons from `begin` to `end`, and the members `rest`. */
static char *scene_of(int begin, int end, const char *rest)
{
    char *text = zr_arena_alloc(&arena, SCENE_SIZE, 1);
    assert_non_null(text);
    int used =
        snprintf(text, SCENE_SIZE,
                 "{%s%s,\"shading\":\"unlit\",\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"},"
                 "{\"channel\":\"depth\"},{\"channel\":\"faceId\"}],\"polygons\":[",
                 head, rest);
    for (int i = begin; i < end; i++)
        used += snprintf(text + used, SCENE_SIZE - (size_t)used, "%s%s", i > begin ? "," : "", polygons[i]);
    assert_true(used + 3 < SCENE_SIZE);
    strcpy(text + used, "]}");
    return text;
}

/* The polygons drawn into `base`, whose parts come beside the scene. */
static struct picture draw_into(const struct picture *base, int begin, int end, const char *rest)
{
    char members[512];
    struct zr_asset assets[CHANNELS];
    for (int i = 0; i < CHANNELS; i++)
        assets[i] =
            (struct zr_asset){.name = NAMES[i], .bytes = base->channels[i].bytes, .size = base->channels[i].size};
    snprintf(members, sizeof members,
             ",\"base\":{\"color\":{\"asset\":\"color\"},\"windowDepth\":{\"asset\":\"windowDepth\"},"
             "\"depth\":{\"asset\":\"depth\"},\"faceId\":{\"asset\":\"faceId\"}%s}",
             rest);
    return draw(scene_of(begin, end, members), assets, CHANNELS);
}

static void assert_same(const struct picture *a, const struct picture *b, const char *what)
{
    /* What a PNG decodes to; its bytes need not be the same (output/images/png.h). */
    if (memcmp(a->frame->color, b->frame->color, (size_t)4 * a->frame->width * a->frame->height) != 0)
        fail_msg("%s: colours differ", what);
    for (int i = 1; i < CHANNELS; i++)
        if (a->channels[i].size != b->channels[i].size ||
            memcmp(a->channels[i].bytes, b->channels[i].bytes, a->channels[i].size) != 0)
            fail_msg("%s: %s differs", what, NAMES[i]);
}

/* Some lie flat, on the near and the far plane too; some repeat an earlier one in other colours. */
static void make_polygon(struct random *random, int number)
{
    static char shapes[POLYGONS_MAX][POLYGON_SIZE / 2];
    static const double layers[] = {-1, -0.5, 0, 0.5, 1};
    char *shape = shapes[number];
    if (number > 0 && random_below(random, 3) == 0) {
        memcpy(shape, shapes[random_below(random, (uint32_t)number)], sizeof shapes[0]);
    } else {
        double cx = random_range(random, -1, 1), cy = random_range(random, -1, 1),
               size = random_range(random, 0.2, 1.5);
        bool flat = random_below(random, 2) == 0;
        double z = layers[random_below(random, 5)];
        int used = 0;
        for (int k = 0; k < 3; k++)
            used += snprintf(shape + used, sizeof shapes[0] - (size_t)used, "%s[%.9g,%.9g,%.9g]", k ? "," : "",
                             cx + random_range(random, -size, size), cy + random_range(random, -size, size),
                             flat ? z : random_range(random, -1.2, 1.2));
    }
    double c[9];
    for (int k = 0; k < 9; k++)
        c[k] = random_range(random, 0, 1);
    snprintf(polygons[number], POLYGON_SIZE,
             "{\"vertices\":[%s],\"doubleSided\":true,\"colors\":[[%.4f,%.4f,%.4f],[%.4f,%.4f,%.4f],[%.4f,%.4f,%.4f]]}",
             shape, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
}

/* Orthographic with planes at layers of the polygons, or in perspective from outside. */
static void make_head(struct random *random, uint32_t round)
{
    static const char *const views[] = {
        "{\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}",
        "{\"eye\":[0.3,0.2,3],\"perspective\":{\"yfovDegrees\":40},\"znear\":2,\"zfar\":4.25}",
        "{\"eye\":[0,0,2],\"orthographic\":{\"xmag\":1,\"ymag\":1},\"znear\":1,\"zfar\":3}"};
    snprintf(head, sizeof head, "\"window\":{\"width\":%u,\"height\":%u},\"background\":[0.1,0.2,0.3,%s],\"view\":%s",
             1 + random_below(random, 150), 1 + random_below(random, 150), round % 2 ? "1" : "0.4", views[round % 3]);
}

/* A base without anything in it, whose picture is the background. */
static struct picture draw_nothing(void)
{
    strcpy(polygons[POLYGONS_MAX - 1], "{\"vertices\":[[90,90,0],[91,90,0],[90,91,0]]}");
    return draw(scene_of(POLYGONS_MAX - 1, POLYGONS_MAX, ""), NULL, 0);
}

TEST_AROUND(halves_drawn_one_into_the_other_are_the_whole, open_arena, close_arena)
{
    struct random random = random_seeded(71);
    uint64_t first_seen = 0, second_seen = 0;
    for (uint32_t round = 0; round < 120; round++) {
        int count = 2 + (int)random_below(&random, POLYGONS_MAX - 3);
        make_head(&random, round);
        for (int i = 0; i < count; i++)
            make_polygon(&random, i);
        int split = 1 + (int)random_below(&random, (uint32_t)count - 1);
        struct picture whole = draw(scene_of(0, count, ""), NULL, 0);

        struct picture first = draw(scene_of(0, split, ""), NULL, 0);
        char numbers[64];
        snprintf(numbers, sizeof numbers, ",\"firstFaceId\":%d", split + 1);
        struct picture forwards = draw_into(&first, split, count, numbers);
        assert_same(&whole, &forwards, "the second half drawn into the first");
        second_seen += forwards.covered;

        struct picture nothing = draw_nothing(), second = draw_into(&nothing, split, count, numbers);
        struct picture backwards = draw_into(&second, 0, split, ",\"ties\":\"scene\",\"firstFaceId\":1");
        assert_same(&whole, &backwards, "the first half drawn into the second");
        first_seen += backwards.covered;
        assert_true(forwards.covered <= whole.covered && backwards.covered <= whole.covered);
        zr_arena_reset(&arena, 1 << 28);
    }
    assert_true(first_seen > 100000 && second_seen > 100000);
}

TEST_AROUND(layers_one_by_one_are_the_whole, open_arena, close_arena)
{
    struct random random = random_seeded(73);
    for (uint32_t round = 0; round < 12; round++) {
        enum { LAYERS = 12 };
        make_head(&random, round);
        for (int i = 0; i < LAYERS; i++)
            make_polygon(&random, i);
        struct picture whole = draw(scene_of(0, LAYERS, ""), NULL, 0), layered = draw(scene_of(0, 1, ""), NULL, 0);
        for (int i = 1; i < LAYERS; i++) {
            char numbers[64];
            snprintf(numbers, sizeof numbers, ",\"ties\":\"base\",\"firstFaceId\":%d", i + 1);
            layered = draw_into(&layered, i, i + 1, numbers);
        }
        assert_same(&whole, &layered, "layers");
        zr_arena_reset(&arena, 1 << 28);
    }
}

RUN_TESTS(NULL, NULL)
