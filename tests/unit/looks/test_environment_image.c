/* Light of environment images: what their maps hold, and what surfaces show of it. */
#include <stdio.h>

#include "base/run.h"
#include "input/images/environment_image.h"
#include "shade/frame.h"
#include "support/input/base64.h"
#include "support/isas.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST_ARENA(1 << 28)

enum { WIDTH = 64, HEIGHT = 32, FILE_MAX = 1 << 14, ROW = 4 * WIDTH };

/* Mantissas and exponent of 1 and of 1000. */
static const uint8_t white[4] = {128, 128, 128, 129}, lamp[4] = {250, 250, 250, 138};

struct file {
    size_t size;
    uint8_t bytes[FILE_MAX];
};

static void put(struct file *file, const void *bytes, size_t size)
{
    assert_true(file->size + size <= FILE_MAX);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static struct file *begin(struct file *file)
{
    static const char head[] = "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
    file->size = 0;
    put(file, head, sizeof head - 1);
    return file;
}

/* A white image, but for one texel. */
static void put_plain(struct file *file, int x, int y, const uint8_t texel[4])
{
    begin(file);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        put(file, i == y * WIDTH + x ? texel : white, 4);
}

/* The same image in runs: of each byte in turn, or by repeated texels. */
static void put_runs(struct file *file, bool by_bytes)
{
    static const uint8_t head[4] = {2, 2, 0, WIDTH}, repeat[4] = {1, 1, 1, WIDTH - 1};
    begin(file);
    for (int y = 0; y < HEIGHT; y++) {
        put(file, by_bytes ? head : white, 4);
        if (!by_bytes) put(file, repeat, 4);
        for (int k = 0; by_bytes && k < 4; k++) {
            const uint8_t run[2] = {128 + WIDTH - 10, white[k]};
            put(file, run, 2);
            put(file, &(uint8_t){10}, 1);
            for (int i = 0; i < 10; i++)
                put(file, &white[k], 1);
        }
    }
}

static const struct zr_environment_map *map_of(const struct file *file)
{
    struct zr_environment_map *map = NULL;
    struct zr_reason reason = {""};
    const enum zr_status status = zr_environment_map_read(
        &arena, &(struct zr_encoded_image){file->bytes, file->size, WIDTH * HEIGHT}, &map, &reason);
    if (status != ZR_OK) fail_msg("status %d: %s", (int)status, reason.text);
    return map;
}

static void assert_white(const struct zr_environment_map *map)
{
    assert_false(map->has_sun);
    for (size_t i = 0; i < 4 * (size_t)ZR_MAP_TEXELS; i++)
        if (i % 4 < 3 && fabsf(map->texels[i] - 1.0f) > 1e-6f) fail_msg("float %zu is %g", i, (double)map->texels[i]);
    for (int h = 0; h < ZR_MAP_HARMONICS; h++)
        assert_true(fabsf(map->harmonics[h].y - (h == 0 ? 1.0f : 0.0f)) < 1e-4f);
}

TEST_AROUND(white_images_give_one_everywhere_however_they_are_packed, open_arena, close_arena)
{
    static struct file file;
    put_plain(&file, 0, 0, white);
    assert_white(map_of(&file));
    put_runs(&file, false);
    assert_white(map_of(&file));
    put_runs(&file, true);
    assert_white(map_of(&file));
}

/* The texel's solid angle times 1000 over pi is what a surface below it gets; 50 times the mean of that stays. */
TEST_AROUND(a_bright_texel_becomes_a_sun_in_its_direction_with_its_light, open_arena, close_arena)
{
    static struct file file;
    put_plain(&file, 40, 8, lamp);
    const struct zr_environment_map *map = map_of(&file);
    const double across = (40.5 / 64.0 - 0.5) * 2.0 * 3.14159265, up = (0.5 - 8.5 / 32.0) * 3.14159265;
    const double angle = cos(up) * (2.0 * 3.14159265 / 64.0) * (3.14159265 / 32.0),
                 mean = 1.0 + 999.0 * angle / 12.5664;
    const zr_vec3 d = map->sun_direction;
    assert_true(map->has_sun);
    assert_true(fabs((double)d.x + cos(up) * cos(across)) < 1e-5);
    assert_true(fabs((double)d.y + sin(up)) < 1e-5);
    assert_true(fabs((double)d.z + cos(up) * sin(across)) < 1e-5);
    assert_true(fabs((double)map->sun_color.x / ((1000.0 - 50.0 * mean) * angle / 3.14159265) - 1.0) < 0.01);
    assert_true(fabs((double)(4.0f * map->harmonics[0].x) - 4.0 * (1.0 + (50.0 * mean - 1.0) * angle / 12.5664)) <
                0.02);
}

TEST_AROUND(images_beyond_the_limit_are_refused_and_reading_stops_when_cancelled, open_arena, close_arena)
{
    static struct file file;
    struct zr_environment_map *map;
    struct zr_reason reason = {""};
    struct zr_cancel cancel = {.parent = NULL};
    put_plain(&file, 0, 0, white);
    assert_int_equal(zr_environment_map_read(
                         &arena, &(struct zr_encoded_image){file.bytes, file.size, WIDTH * HEIGHT - 1}, &map, &reason),
                     ZR_BAD_SCENE);
    assert_non_null(strstr(reason.text, "imagePixelsMax"));
    atomic_store(&cancel.raised, true);
    arena.cancel = &cancel;
    assert_int_equal(
        zr_environment_map_read(&arena, &(struct zr_encoded_image){file.bytes, file.size, 1 << 20}, &map, &reason),
        ZR_CANCELLED);
    arena.cancel = NULL;
}

/* ---- pictures ---- */

/* Four quarters of the horizon: red from -x to -z, green to +x, blue to +z, white to -x. */
static void put_quarters(struct file *file)
{
    static const uint8_t colors[4][4] = {{128, 0, 0, 129}, {0, 128, 0, 129}, {0, 0, 128, 129}, {128, 128, 128, 129}};
    begin(file);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        put(file, colors[i % WIDTH / (WIDTH / 4)], 4);
}

/* Draws a square that faces +z, and returns its middle. `surface`: keys of its material. */
static void draw(struct zr_team *team, const struct file *file, const char *environment, const char *surface,
                 uint8_t out[3])
{
    static char text[2 * FILE_MAX];
    char *uri = base64_of("data:;base64,", file->bytes, file->size);
    struct zr_error error = {.status = ZR_OK};
    struct zr_arena drawing;
    const struct zr_frame *frame;
    zr_arena_init(&drawing, (size_t)1 << 28);
    snprintf(text, sizeof text,
             "{\"look\": \"studio\", \"occlusion\": false, \"edges\": false, \"groundShadow\": false, \"toneMapping\": "
             "\"none\", \"exposure\": 1, \"samples\": 1,"
             "\"window\": {\"width\": 9, \"height\": 9}, \"view\": {\"eye\": [0, 0, 4], \"target\": [0, 0, 0]},"
             "\"environment\": {\"uri\": \"%s\"%s}, \"materials\": [{\"name\": \"m\", \"shading\": \"pbr\", %s}],"
             "\"polygons\": [{\"vertices\": [[-1,-1,0], [1,-1,0], [1,1,0], [-1,1,0]], \"material\": \"m\"}]}",
             uri, environment, surface);
    free(uri);
    struct reading *reading = read_scene(text);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &drawing, .team = team, .error = &error}, reading->scene, NULL, &frame),
        ZR_OK);
    memcpy(out, frame->color + 4 * (4 * 9 + 4), 3);
    reading_free(reading);
    zr_arena_free(&drawing);
}

TEST_EACH_ISA(rotations_turn_the_image_counter_clockwise_seen_from_above)
{
    static const struct {
        const char *rotation;
        uint8_t color[3];
    } cases[] = {{", \"rotationDegrees\": 45", {255, 255, 255}},
                 {", \"rotationDegrees\": 135", {255, 0, 0}},
                 {", \"rotationDegrees\": -45", {0, 0, 255}},
                 {", \"rotationDegrees\": -45, \"frame\": \"camera\"", {0, 0, 255}}};
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    static struct file file;
    put_quarters(&file);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint8_t color[3];
        draw(team, &file, cases[i].rotation,
             "\"baseColorFactor\": [1, 1, 1, 1], \"metallicFactor\": 1, \"roughnessFactor\": 0", color);
        for (int k = 0; k < 3; k++)
            if (abs(color[k] - cases[i].color[k]) > 8) fail_msg("case %zu: channel %d is %d", i, k, color[k]);
    }
    zr_team_destroy(team);
}

TEST_EACH_ISA(white_surfaces_of_any_material_show_a_white_image_as_it_is)
{
    static const char *const surfaces[] = {"\"metallicFactor\": 0, \"roughnessFactor\": 1",
                                           "\"metallicFactor\": 1, \"roughnessFactor\": 0.15",
                                           "\"metallicFactor\": 0.5, \"roughnessFactor\": 0.7"};
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    static struct file file;
    put_plain(&file, 0, 0, white);
    for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++) {
        char surface[120];
        uint8_t color[3];
        snprintf(surface, sizeof surface, "\"baseColorFactor\": [1, 1, 1, 1], %s", surfaces[i]);
        draw(team, &file, ", \"intensity\": 0.5", surface, color);
        for (int k = 0; k < 3; k++)
            if (abs(color[k] - 188) > 1) fail_msg("%s: %d", surface, color[k]);
    }
    zr_team_destroy(team);
}

RUN_TESTS(NULL, NULL)
