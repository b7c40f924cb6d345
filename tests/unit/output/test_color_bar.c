/* Colour bars: what a scene says of one, where it is in windows of every size, and what its pixels are. */
#include "overlay/color_bar.h"

#include <string.h>

#include "base/rgba.h"
#include "output/images/png.h"
#include "output/npy.h"
#include "support/pictures/png.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

static const struct zr_color_bar plain_bar = {.is_on = true};

/* ---- where ---- */

static void assert_inside(struct zr_box box, uint32_t width, uint32_t height)
{
    if (box.x < 0 || box.y < 0 || box.x + box.width > (int32_t)width || box.y + box.height > (int32_t)height)
        fail_msg("%u x %u: %d %d, %d x %d", width, height, box.x, box.y, box.width, box.height);
}

static const struct zr_color_scale scales[] = {
    {ZR_COLORMAP_VIRIDIS, 0, 1, false},      {ZR_COLORMAP_TURBO, -1.7f, 1.97f, false},
    {ZR_COLORMAP_GRAY, -3e38f, 3e38f, true}, {ZR_COLORMAP_GRAY, 0.12345678f, 0.12345679f, true},
    {ZR_COLORMAP_COOLWARM, 7, 7, true},      {ZR_COLORMAP_GRAY, -1e30f, 37, true}};
enum { SCALES = sizeof scales / sizeof *scales };

static const struct zr_color_bar bars[] = {{.is_on = true},
                                           {.is_on = true, .is_left = true, .title = "T, °C"},
                                           {.is_on = true, .title = "a title that is long gets smaller dots"}};
enum { BARS = sizeof bars / sizeof *bars };

TEST(all_of_a_bar_is_in_the_window_whatever_its_size)
{
    enum { SIDE_MAX = 300 };
    uint32_t drawn = 0;
    for (uint32_t height = 1; height <= SIDE_MAX; height++)
        for (uint32_t width = 1; width <= SIDE_MAX; width++)
            for (int k = 0; k < SCALES * BARS; k += 1 + (int)((width + height) % 3)) {
                struct zr_color_bar_layout l;
                if (!zr_color_bar_lay_out(&bars[k % BARS], &scales[k / BARS], width, height, &l)) continue;
                drawn++;
                assert_inside(l.all, width, height);
                assert_true(2 * l.block.width <= (int32_t)width);
                assert_true(bars[k % BARS].is_left ? 2 * l.bar.x < (int32_t)width : 2 * l.bar.x >= (int32_t)width);
            }
    assert_true(drawn > 100000);
}

/* ---- pixels ---- */

enum { CANVAS_SIDE = 300 };
static uint32_t pixels[CANVAS_SIDE * CANVAS_SIDE];

static uint32_t pixel(const struct zr_canvas *canvas, int32_t x, int32_t y)
{
    return canvas->pixels[y * canvas->width + x];
}

/* Painted on `paper`; nothing outside of what it says is touched. */
static void paint(const struct zr_color_bar_layout *l, uint32_t width, uint32_t height, uint32_t paper,
                  struct zr_canvas *canvas)
{
    *canvas = (struct zr_canvas){pixels, (int32_t)width, (int32_t)height};
    for (uint32_t i = 0; i < width * height; i++)
        pixels[i] = paper;
    zr_color_bar_paint(l, canvas);
    for (int32_t y = 0; y < canvas->height; y++)
        for (int32_t x = 0; x < canvas->width; x++) {
            const bool is_in =
                x >= l->all.x && x < l->all.x + l->all.width && y >= l->all.y && y < l->all.y + l->all.height;
            if (!is_in) assert_int_equal(pixel(canvas, x, y), paper);
        }
}

/* ---- scenes ---- */

#define SQUARE  "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], \"faces\": [[0,1,2],[0,2,3]]"
#define SCALARS SQUARE ", \"scalars\": [1,2,3,4]"
#define WINDOW  "\"window\": {\"width\": 200, \"height\": 160}, "
#define MESH    "\"meshes\": [{" SCALARS "}], "
#define ALL_DATA                                                                                                       \
    "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": \"windowDepth\"}, {\"channel\": " \
    "\"faceId\"}, {\"channel\": \"instanceId\"}, {\"channel\": \"normals\"}, {\"channel\": \"position\"}, "            \
    "{\"channel\": \"layers\"}]"

TEST(a_scene_says_what_the_bar_is_like)
{
    struct reading *reading = read_scene("{" MESH "\"colorBar\": true}");
    const struct zr_color_bar *bar = &reading->scene->color_bar;
    assert_true(bar->is_on && !bar->is_left && !bar->has_mesh && !bar->title);
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
    reading = read_scene("{" MESH "\"colorBar\": {}}");
    assert_true(reading->scene->color_bar.is_on);
    reading_free(reading);
    reading = read_scene("{\"colorBar\": {\"mesh\": \"b\", \"title\": \"p, Pa\", \"place\": \"left\"}, \"meshes\": "
                         "[{\"name\": \"a\", " SCALARS "}, {\"name\": \"b\", " SCALARS "}]}");
    bar = &reading->scene->color_bar;
    assert_true(bar->is_on && bar->is_left && bar->has_mesh);
    assert_int_equal(bar->mesh, 1);
    assert_string_equal(bar->title, "p, Pa");
    reading_free(reading);
    static const char *const off[] = {"{" MESH "\"colorBar\": false}", "{\"meshes\": [{" SCALARS "}]}"};
    for (int i = 0; i < 2; i++) {
        reading = read_scene(off[i]);
        assert_false(reading->scene->color_bar.is_on);
        reading_free(reading);
    }
}

TEST(what_is_odd_about_a_bar_is_warned_of)
{
    static const struct {
        const char *text, *warning; /* NULL: none */
    } cases[] = {
        {"{\"colorBar\": true, \"meshes\": [{" SQUARE "}]}", "no mesh that is drawn has scalars"},
        {"{\"colorBar\": false, \"meshes\": [{" SQUARE "}]}", NULL},
        {"{\"colorBar\": true, \"outputs\": [{\"channel\": \"depth\"}], \"meshes\": [{" SQUARE "}]}", NULL},
        {"{\"colorBar\": true, \"meshes\": [{\"heights\": [[0,1],[2,4]]}]}", "no mesh that is drawn has scalars"},
        {"{\"colorBar\": true, \"meshes\": [{\"heights\": [[0,1],[2,4]], \"colormap\": \"gray\"}]}", NULL},
        {"{\"colorBar\": {\"mesh\": \"a\"}, \"meshes\": [{\"name\": \"a\", " SQUARE "}, {" SCALARS "}]}",
         "the mesh has neither scalars nor"},
        {"{\"colorBar\": true, \"meshes\": [{" SQUARE "}, {" SCALARS "}]}", NULL},
        {"{\"colorBar\": true, \"meshes\": [{" SCALARS "}, {" SCALARS "}]}", NULL}, /* the same range */
        {"{\"colorBar\": true, \"meshes\": [{" SCALARS "}, {" SCALARS ", \"colormap\": \"gray\"}, {" SCALARS
         ", \"range\": [0, 9]}]}",
         "meshes have another colormap or range than the bar shows, at 2 places"},
        {"{\"colorBar\": {\"mesh\": \"a\"}, \"meshes\": [{" SCALARS "}, {\"name\": \"a\", " SCALARS
         ", \"range\": [0, 9]}]}",
         NULL}, /* the scene knows that there are others */
        {"{\"colorBar\": true, \"window\": {\"width\": 48, \"height\": 48}, " MESH "\"up\": \"y\"}",
         "a window of 48 x 48 has no room"},
        {"{\"colorBar\": {\"title\": \"as long as a whole sentence can be\"}, " WINDOW MESH "\"up\": \"y\"}", NULL},
        {"{\"colorBar\": {\"title\": \"so long a title is not for pictures of two hundred pixels\"}, " WINDOW MESH
         "\"up\": \"y\"}",
         "the title is too long"},
        {"{\"colorBar\": {\"title\": \"\\u2202T\"}, " WINDOW MESH "\"up\": \"y\"}", "characters that have no glyph"},
        {"{\"colorBar\": true, \"nodes\": [{\"mesh\": 1}], \"meshes\": [{" SCALARS "}, {" SQUARE "}]}",
         "no mesh that is drawn has scalars"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_scene(cases[i].text);
        const uint32_t count = reading->scene->warning_count;
        const char *last = count > 0 ? reading->scene->warnings[count - 1] : "";
        if (!cases[i].warning && count > 0) fail_msg("%s: %s", cases[i].text, last);
        if (cases[i].warning && (!strstr(last, cases[i].warning) || strncmp(last, "colorBar: ", 10) != 0))
            fail_msg("%s: '%s'", cases[i].text, last);
        assert_true(strlen(last) < 159); /* none is cut */
        scene_encode(&reading->arena, NULL, reading->scene);
        reading_free(reading);
    }
}

TEST(queries_switch_bars_on_and_off)
{
    static const char with[] = "{" MESH "\"colorBar\": {\"title\": \"T\"}}",
                      without[] = "{\"meshes\": [{" SCALARS "}]}";
    static const struct {
        const char *text, *query;
        bool is_on;
    } cases[] = {{with, "true", true}, {with, "false", false}, {without, "true", true}, {without, "false", false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading =
            read_request((struct zr_request){.format = ZR_FORMAT_JSON, .colorBar = cases[i].query}, cases[i].text,
                         strlen(cases[i].text), zr_limits_default(), 1 << 24);
        assert_read(reading);
        assert_int_equal(reading->scene->color_bar.is_on, cases[i].is_on);
        assert_true((reading->scene->color_bar.title != NULL) == (cases[i].text == with));
        reading_free(reading);
    }
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .colorBar = "true"}, obj,
                                           strlen(obj), zr_limits_default(), 1 << 24);
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 1);
    reading_free(reading);
    reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON, .colorBar = "yes"}, without, strlen(without),
                           zr_limits_default(), 1 << 24);
    assert_complaint(reading, ZR_BAD_REQUEST, "", "parameter colorBar: 'yes' is unknown");
    reading_free(reading);
    reading = read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .colorBar = "true", .strict = "1"}, obj,
                           strlen(obj), zr_limits_default(), 1 << 24);
    assert_complaint(reading, ZR_BAD_SCENE, "", "colorBar: no mesh");
    reading_free(reading);
}

static const char *const looks[] = {
    "\"look\": \"textbook\"",
    "\"look\": \"textbook\", \"samples\": 16, \"background\": \"#00000000\"",
    "\"look\": \"studio\"",
    "\"look\": \"dark\", \"background\": \"#00000000\"",
    "\"look\": \"technical\", \"samples\": 1",
};

/* Two pictures of a scene, with a bar and without. */
TEST(only_the_color_channel_has_the_bar_and_only_where_it_is)
{
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        char text[2][1024];
        for (int on = 0; on < 2; on++)
            snprintf(text[on], sizeof text[on], "{" WINDOW MESH "%s, \"colorBar\": %s, " ALL_DATA "}", looks[i],
                     on ? "{\"title\": \"T\"}" : "false");
        struct reading *off = read_scene(text[0]), *on = read_scene(text[1]);
        const struct zr_frame *a = scene_render(&off->arena, NULL, off->scene);
        const struct zr_frame *b = scene_render(&on->arena, NULL, on->scene);
        const size_t count = (size_t)a->width * a->height;
        for (int c = ZR_CHANNEL_COLOR + 1; c < ZR_CHANNEL_COUNT; c++)
            if (a->channels[c])
                assert_memory_equal(a->channels[c], b->channels[c], count * 4 * zr_channel_rows[c].words);
        assert_true(a->covered_pixels == b->covered_pixels && a->covered_samples == b->covered_samples);
        struct zr_color_bar_layout l;
        assert_true(zr_color_bar_lay_out(&on->scene->color_bar, on->scene->meshes[0].scale, 200, 160, &l));
        uint32_t differ = 0;
        for (int32_t y = 0; y < 160; y++)
            for (int32_t x = 0; x < 200; x++) {
                const bool is_in =
                    x >= l.all.x && x < l.all.x + l.all.width && y >= l.all.y && y < l.all.y + l.all.height;
                const bool is_same = memcmp(a->color + 4 * (y * 200 + x), b->color + 4 * (y * 200 + x), 4) == 0;
                assert_true(is_in || is_same);
                differ += !is_same;
            }
        assert_true(differ > (uint32_t)(l.bar.width * l.bar.height));
        for (int32_t r = 0; r < l.bar.height; r++) { /* exact, whatever the look: behind light and tone mapping */
            uint32_t got;
            memcpy(&got, b->color + 4 * ((l.bar.y + l.bar.height - 1 - r) * 200 + l.bar.x), 4);
            assert_int_equal(got, zr_rgba_opaque(zr_colormap_color(0, (float)r / (float)(l.bar.height - 1))));
        }
        reading_free(off);
        reading_free(on);
    }
}

/* A base is what is behind it. */
TEST(a_bar_is_drawn_over_a_base)
{
    enum { WIDTH = 200, HEIGHT = 160, PIXELS = WIDTH * HEIGHT };
    static uint32_t colors[PIXELS];
    static float depths[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        colors[i] = 0xFF503010;
        depths[i] = 1.0f; /* nothing is there */
    }
    struct zr_arena files;
    zr_arena_init(&files, 1 << 24);
    struct zr_buffer color = {.arena = &files}, depth = {.arena = &files};
    const struct zr_png png = {.kind = ZR_PNG_RGB, .width = WIDTH, .height = HEIGHT, .pixels = colors};
    assert_int_equal(zr_png_write(&png, NULL, NULL, &color), ZR_OK);
    assert_int_equal(zr_npy_write(ZR_NPY_FLOAT32, WIDTH, HEIGHT, 1, depths, &depth), ZR_OK);
    const struct zr_asset assets[] = {{.name = "c", .bytes = color.bytes, .size = color.size},
                                      {.name = "w", .bytes = depth.bytes, .size = depth.size}};
    static const char text[] =
        "{" WINDOW MESH "\"view\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 9], \"znear\": 1, \"zfar\": 9}, "
        "\"colorBar\": true, \"base\": {\"color\": {\"asset\": \"c\"}, \"windowDepth\": {\"asset\": \"w\"}}}";
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_JSON, .assets = assets, .asset_count = 2}, text,
                     strlen(text), zr_limits_default(), 1 << 28);
    assert_read(reading);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    struct zr_color_bar_layout l;
    struct zr_canvas canvas;
    assert_true(zr_color_bar_lay_out(&plain_bar, reading->scene->meshes[0].scale, WIDTH, HEIGHT, &l));
    paint(&l, WIDTH, HEIGHT, 0xFF503010, &canvas);
    assert_memory_equal(frame->color, canvas.pixels, 4 * PIXELS);
    reading_free(reading);
    zr_arena_free(&files);
}

RUN_TESTS(NULL, NULL)
