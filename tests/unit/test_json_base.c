/* Scenes with a base: what is read, what is refused, and what is drawn. */
#include <cjson/cJSON.h>
#include <math.h>

#include "input_check.h"
#include "output/npy.h"
#include "output/png.h"
#include "shade/frame.h"
#include "support/base64.h"
#include "support/scenes.h"

enum { WIDTH = 4, HEIGHT = 2, PIXELS = WIDTH * HEIGHT, ASSETS = 5 };

/* The whole window at window depth 0.5, eye depth 0. */
#define HEAD                                                                                                           \
    "{\"window\":{\"width\":4,\"height\":2},\"shading\":\"unlit\",\"view\":{\"projectionMatrix\":"                     \
    "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},\"polygons\":[{\"vertices\":[[-1,-1,0],[3,-1,0],[-1,3,0]],\"color\":"          \
    "\"#112233\",\"doubleSided\":true}],"
#define ALL                                                                                                            \
    "\"color\":{\"asset\":\"c\"},\"windowDepth\":{\"asset\":\"w\"},\"depth\":{\"asset\":\"d\"},\"faceId\":"            \
    "{\"asset\":\"f\"}"
#define OUTPUTS                                                                                                        \
    "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"},{\"channel\":\"depth\"},"                      \
    "{\"channel\":\"faceId\"},{\"channel\":\"info\"}]"
#define BASE(members) "\"base\":{" members "}"
#define HASH_C        "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc"
#define HASH_W        "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"

/* Four pixels behind the polygon and one at its depth; three in front or with nothing. */
static const float WINDOW_DEPTH[PIXELS] = {0, 0.25f, 0.5f, 0.75f, 1, 0.500001f, 0.9f, 0.49999f};
static const float DEPTH[PIXELS] = {-1, -0.5f, 0, 0.5f, INFINITY, NAN, 0.8f, -0.01f};
static const uint32_t FACE_ID[PIXELS] = {1, 2, 3, 4, 0, 5, 6, 7};
static uint8_t colors[PIXELS * 4];

static struct zr_arena arena;
static struct zr_asset assets[ASSETS];

static struct zr_asset png_asset(const char *name, enum zr_png_kind kind, uint32_t width, uint32_t height)
{
    static uint8_t large[64 * 64 * 4];
    struct zr_png png = {.kind = kind, .width = width, .height = height, .pixels = width == WIDTH ? colors : large};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_png_write(&png, NULL, NULL, &out), ZR_OK);
    return (struct zr_asset){name, out.bytes, out.size};
}

static struct zr_asset npy_asset(const char *name, enum zr_npy_type type, const void *values)
{
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_npy_write(type, WIDTH, HEIGHT, values, &out), ZR_OK);
    return (struct zr_asset){name, out.bytes, out.size};
}

static int make_assets(void **state)
{
    (void)state;
    zr_arena_init(&arena, 1 << 26);
    for (size_t i = 0; i < sizeof colors; i++)
        colors[i] = (uint8_t)(i % 4 == 3 ? 255 - i : 7 * i);
    assets[0] = png_asset("c", ZR_PNG_RGBA, WIDTH, HEIGHT);
    assets[1] = npy_asset("w", ZR_NPY_FLOAT32, WINDOW_DEPTH);
    assets[2] = npy_asset("d", ZR_NPY_FLOAT32, DEPTH);
    assets[3] = npy_asset("f", ZR_NPY_UINT32, FACE_ID);
    return 0;
}

static int free_assets(void **state)
{
    (void)state;
    zr_arena_free(&arena);
    return 0;
}

/* With the four assets, and `extra` where it has a name. */
static struct reading *read_with(const char *text, struct zr_asset extra, const char *channel)
{
    assets[4] = extra;
    struct zr_request request = {.format = ZR_FORMAT_JSON,
                                 .channel = channel,
                                 .assets = assets,
                                 .asset_count = extra.name ? ASSETS : ASSETS - 1};
    return read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 26);
}

static const struct zr_asset NO_EXTRA = {NULL, NULL, 0};

static struct reading *read_good(const char *text)
{
    struct reading *reading = read_with(text, NO_EXTRA, NULL);
    assert_read(reading);
    return reading;
}

static void refuses_with(const char *text, struct zr_asset extra, const char *pointer, const char *detail)
{
    struct reading *reading = read_with(text, extra, NULL);
    assert_complaint(reading, ZR_BAD_SCENE, pointer, detail);
    reading_free(reading);
}

static const struct zr_frame *render(struct reading *reading)
{
    return scene_render(&reading->arena, NULL, reading->scene);
}

/* Where the polygon is seen, from pixel 0 on: '#'. */
static void assert_seen(const struct zr_frame *frame, const char *want)
{
    char got[PIXELS + 1] = "";
    for (int i = 0; i < PIXELS; i++)
        got[i] = frame->window_depth[i] == 0.5f && frame->face_id[i] == 8 ? '#' : '.';
    assert_string_equal(got, want);
}

static void assert_warned(const struct zr_scene *scene, const char *text)
{
    for (uint32_t i = 0; i < scene->warning_count; i++)
        if (strstr(scene->warnings[i], text)) return;
    fail_msg("no warning says '%s'; there are %u", text, scene->warning_count);
}

static void base_is_seen_where_it_is_nearer_and_at_equal_depth(void **state)
{
    (void)state;
    struct reading *reading = read_good(HEAD OUTPUTS "," BASE(ALL) "}");
    const struct zr_frame *frame = render(reading);
    assert_seen(frame, "...####.");
    for (int i = 0; i < PIXELS; i++) {
        bool seen = "...####."[i] == '#';
        const uint8_t polygon[4] = {0x11, 0x22, 0x33, 255};
        assert_memory_equal(frame->color + 4 * i, seen ? polygon : colors + 4 * i, 4);
        assert_true(frame->depth[i] == (seen ? 0.0f : DEPTH[i]));
        assert_int_equal(frame->face_id[i], seen ? 8 : FACE_ID[i]);
        assert_true(frame->window_depth[i] == (seen ? 0.5f : WINDOW_DEPTH[i]));
    }
    assert_int_equal(frame->covered_pixels, 4);
    reading_free(reading);
}

static void scene_that_wins_ties_is_seen_at_equal_depth_too(void **state)
{
    (void)state;
    struct reading *reading = read_good(HEAD OUTPUTS "," BASE(ALL ",\"ties\":\"scene\"") "}");
    assert_seen(render(reading), "..#####.");
    reading_free(reading);
}

static void depth_alone_is_converted_by_the_view(void **state)
{
    (void)state;
    /* The identity has z = -depth: from 1 in front, window depth 0, to -1, window depth 1. */
    const float depth[PIXELS] = {1, 0.5f, 0, -0.5f, INFINITY, NAN, 2, -2};
    const float want[PIXELS] = {0, 0.25f, 0.5f, 0.75f, 1, 1, 0, 1};
    struct reading *reading =
        read_with(HEAD "\"outputs\":[{\"channel\":\"windowDepth\"}]," BASE("\"depth\":{\"asset\":\"x\"}") "}",
                  npy_asset("x", ZR_NPY_FLOAT32, depth), NULL);
    assert_read(reading);
    const struct zr_frame *frame = render(reading);
    for (int i = 0; i < PIXELS; i++)
        assert_true(frame->window_depth[i] == (want[i] > 0.5f ? 0.5f : want[i]));
    reading_free(reading);
}

/* znear 1, zfar 3: window depth 1.5 (d - 1) / d. */
static void depth_in_perspective_is_converted_too(void **state)
{
    (void)state;
    const float depth[PIXELS] = {0.5f, 1, 1.5f, 2, 3, 4, -1, 0};
    struct reading *reading =
        read_with("{\"window\":{\"width\":4,\"height\":2},\"view\":{\"eye\":[0,0,2],\"perspective\":{\"yfov\":1},"
                  "\"znear\":1,\"zfar\":3},\"outputs\":[{\"channel\":\"windowDepth\"},{\"channel\":\"depth\"}],"
                  "\"polygons\":[{\"vertices\":[[50,0,0],[51,0,0],[50,1,0]]}]," BASE("\"depth\":{\"asset\":\"x\"}") "}",
                  npy_asset("x", ZR_NPY_FLOAT32, depth), NULL);
    assert_read(reading);
    const struct zr_frame *frame = render(reading);
    for (int i = 0; i < PIXELS; i++) {
        double want = fmin(fmax(depth[i] > 0 ? 1.5 * ((double)depth[i] - 1) / (double)depth[i] : 0, 0), 1);
        assert_true(fabs((double)frame->window_depth[i] - want) < 1e-6);
        assert_true(frame->depth[i] == depth[i]);
    }
    for (uint32_t i = 0; i < reading->scene->warning_count; i++)
        assert_null(strstr(reading->scene->warnings[i], "fitted"));
    reading_free(reading);
}

/* A z-buffer means nothing without the planes that it was drawn between; eye-space depth needs none. */
static void window_depth_without_its_planes_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *view;
        bool good;
    } cases[] = {{"\"preset\":\"front\"", false},
                 {"\"eye\":[0,0,2],\"znear\":1", false},
                 {"\"eye\":[0,0,2],\"zfar\":9", false},
                 {"\"eye\":[0,0,2],\"znear\":1,\"zfar\":9", true},
                 {"\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", true}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const bool metric = i % 2;
        char text[512];
        snprintf(text, sizeof text,
                 "{\"window\":{\"width\":4,\"height\":2},\"view\":{%s},\"outputs\":[{\"channel\":\"depth\"}],"
                 "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"base\":{%s\"depth\":{\"asset\":\"d\"}}}",
                 cases[i / 2].view, metric ? "" : "\"windowDepth\":{\"asset\":\"w\"},");
        if (cases[i / 2].good || metric)
            reading_free(read_good(text));
        else
            refuses_with(text, NO_EXTRA, "/view", "znear and zfar are missing");
    }
    refuses_with(
        "{\"window\":{\"width\":4,\"height\":2},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]," BASE(ALL) "}",
        NO_EXTRA, "/view", "znear and zfar are missing");
}

static void depth_in_an_oblique_projection_is_refused(void **state)
{
    (void)state;
    struct reading *reading = read_good(
        "{\"window\":{\"width\":4,\"height\":2},\"view\":{\"projectionMatrix\":[1,0,0.5,0,0,1,0,0,0,0,1,0,0,0,0,"
        "1]},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"outputs\":[{\"channel\":\"depth\"}]," BASE(
            "\"depth\":{\"asset\":\"d\"}") "}");
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(zr_render(&reading->arena, NULL, reading->scene, NULL, NULL, &frame, &error), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/base/depth");
    assert_non_null(strstr(error.items[0].detail, "give windowDepth"));
    reading_free(reading);
}

static cJSON *info_of(struct reading *reading)
{
    static const struct zr_output output = {ZR_CHANNEL_INFO, ZR_ENCODING_JSON, 0};
    struct zr_scene scene = *reading->scene;
    scene.outputs = &output;
    scene.output_count = 1;
    const struct zr_answer answer = scene_encode(&reading->arena, NULL, &scene);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    return info;
}

static int number(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    assert_true(cJSON_IsNumber(item));
    return (int)item->valuedouble;
}

static void info_tells_new_faces_from_the_base(void **state)
{
    (void)state;
    static const struct {
        const char *base;
        int first;
    } cases[] = {{HEAD OUTPUTS "," BASE(ALL) "}", 8}, {HEAD OUTPUTS "," BASE(ALL ",\"firstFaceId\":100") "}", 100}};
    for (int i = 0; i < 2; i++) {
        struct reading *reading = read_good(cases[i].base);
        cJSON *info = info_of(reading), *mesh = cJSON_GetObjectItem(info, "meshes")->child,
              *face = cJSON_GetObjectItem(info, "faces")->child;
        assert_int_equal(number(info, "backgroundPixels"), 0); /* the one pixel of nothing is covered */
        assert_int_equal(number(cJSON_GetObjectItem(info, "base"), "pixels"), 4);
        assert_int_equal(number(mesh, "pixels"), 4);
        assert_int_equal(number(mesh, "firstFaceId"), cases[i].first);
        assert_int_equal(number(face, "id"), cases[i].first);
        assert_null(face->next);
        cJSON_Delete(info);
        reading_free(reading);
    }
}

static void ids_that_clash_or_do_not_fit_are_refused(void **state)
{
    (void)state;
    const uint32_t highest[PIXELS] = {UINT32_MAX}, last_but_one[PIXELS] = {UINT32_MAX - 1};
    const char *text =
        HEAD BASE("\"color\":{\"asset\":\"c\"},\"windowDepth\":{\"asset\":\"w\"},\"faceId\":{\"asset\":\"x\"}") "}";
    refuses_with(text, npy_asset("x", ZR_NPY_UINT32, highest), "/base/firstFaceId", "do not fit 32 bits");
    struct reading *reading = read_with(text, npy_asset("x", ZR_NPY_UINT32, last_but_one), NULL);
    assert_read(reading);
    assert_int_equal(reading->scene->base->first_face_id, UINT32_MAX);
    reading_free(reading);
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":7") "}", NO_EXTRA, "/base/firstFaceId", "base.faceId has 7 already");
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":0") "}", NO_EXTRA, "/base/firstFaceId", "the id of nothing");
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":-1") "}", NO_EXTRA, "/base/firstFaceId", "outside of 0");
}

static void what_the_outputs_need_must_be_there(void **state)
{
    (void)state;
    static const char only_depth[] = HEAD BASE("\"windowDepth\":{\"asset\":\"w\"}") "}";
    static const struct {
        const char *channel, *pointer;
    } cases[] = {{NULL, "/base/color"},
                 {"color", "/base/color"},
                 {"depth", "/base/depth"},
                 {"faceId", "/base/faceId"},
                 {"info", "/base/faceId"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_with(only_depth, NO_EXTRA, cases[i].channel);
        assert_complaint(reading, ZR_BAD_SCENE, cases[i].pointer, "missing");
        reading_free(reading);
    }
    struct reading *reading = read_with(only_depth, NO_EXTRA, "windowDepth");
    assert_read(reading);
    reading_free(reading);
    refuses_with(HEAD BASE("\"color\":{\"asset\":\"c\"}") "}", NO_EXTRA, "/base", "windowDepth is missing");
    refuses_with(HEAD BASE("") "}", NO_EXTRA, "/base", "windowDepth is missing");
}

static void bases_that_are_not_one_are_refused_where_it_shows(void **state)
{
    (void)state;
    static const struct {
        const char *text, *pointer, *detail;
    } cases[] = {
        {HEAD "\"base\":7}", "/base", "expected an object"},
        {HEAD BASE(ALL ",\"colour\":1") "}", "/base/colour", "unknown key"},
        {HEAD BASE(ALL ",\"ties\":\"new\"") "}", "/base/ties", "'new' is unknown; allowed: base, scene"},
        {HEAD BASE("\"windowDepth\":7") "}", "/base/windowDepth", "expected a data: URI"},
        {HEAD BASE("\"windowDepth\":{}") "}", "/base/windowDepth", "one of uri and asset"},
        {HEAD BASE("\"windowDepth\":{\"uri\":\"data:,\",\"asset\":\"w\"}") "}", "/base/windowDepth", "only one"},
        {HEAD BASE("\"windowDepth\":{\"asset\":7}") "}", "/base/windowDepth/asset", "expected a string"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"z\"}") "}", "/base/windowDepth/asset", "has the name 'z'"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"sha256:00\"}") "}", "/base/windowDepth/asset",
         "64 lower-case hexadecimal digits"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"sha256:" HASH_W "\"}") "}", "/base/windowDepth/asset",
         "no assets are kept here"},
        {HEAD BASE("\"windowDepth\":{\"url\":\"x\"}") "}", "/base/windowDepth/url", "unknown key"},
        {HEAD BASE("\"windowDepth\":\"http://a/b.npy\"") "}", "/base/windowDepth", "nothing is fetched"},
        {HEAD BASE("\"windowDepth\":{\"uri\":\"data:;base64,Zm9\"}") "}", "/base/windowDepth/uri", "cut short"},
        {HEAD BASE("\"windowDepth\":\"data:;base64,Zm9v\"") "}", "/base/windowDepth", "not an NPY file"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"f\"}") "}", "/base/windowDepth", "float32 is needed"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"color\":{\"asset\":\"w\"}") "}", "/base/color", "not a PNG"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"faceId\":{\"asset\":\"w\"}") "}", "/base/faceId",
         "uint32 is needed"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuses_with(cases[i].text, NO_EXTRA, cases[i].pointer, cases[i].detail);
}

static void values_outside_of_their_range_are_refused_by_pixel(void **state)
{
    (void)state;
    static const char depth_text[] = HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"depth\":{\"asset\":\"x\"}") "}";
    static const char window_text[] = HEAD BASE("\"windowDepth\":{\"asset\":\"x\"}") "}";
    const float bad[] = {NAN, INFINITY, -INFINITY, -0.001f, 1.0000001f};
    for (size_t i = 0; i < 5; i++) {
        float values[PIXELS] = {0, 1, -0.0f};
        values[6] = values[7] = bad[i];
        refuses_with(window_text, npy_asset("x", ZR_NPY_FLOAT32, values), "/base/windowDepth",
                     "pixel (2, 1), counted from the top left");
    }
    const float values[PIXELS] = {0, 0, 0, 0, 0, -INFINITY};
    refuses_with(depth_text, npy_asset("x", ZR_NPY_FLOAT32, values), "/base/depth", "pixel (1, 1)");
}

static void picture_of_another_size_is_refused(void **state)
{
    (void)state;
    refuses_with(HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"color\":{\"asset\":\"x\"}") "}",
                 png_asset("x", ZR_PNG_RGB, 64, 64), "/base/color", "64 x 64 pixels, not the window's 4 x 2");
}

static void window_beyond_its_limits_is_refused_for_itself(void **state)
{
    (void)state;
    refuses_with("{\"window\":{\"width\":0},\"view\":{\"znear\":1,\"zfar\":9},\"polygons\":[{\"vertices\":[[0,0,0],[1,"
                 "0,0],[0,1,0]]}]," BASE(ALL) "}",
                 NO_EXTRA, "/window/width", "0 pixels");
}

static void data_uris_do_as_well_as_assets(void **state)
{
    (void)state;
    static const char *const forms[] = {"\"%s\"", "{\"uri\":\"%s\"}"};
    for (int i = 0; i < 2; i++) {
        char text[8192], part[2048];
        int used = snprintf(text, sizeof text, HEAD OUTPUTS ",\"base\":{");
        static const char *const keys[] = {"color", "windowDepth", "depth", "faceId"};
        for (int k = 0; k < 4; k++) {
            char *uri = base64_of(k ? "data:application/x-npy;base64," : "data:image/png;base64,", assets[k].bytes,
                                  assets[k].size);
            snprintf(part, sizeof part, forms[i], uri);
            used += snprintf(text + used, sizeof text - (size_t)used, "%s\"%s\":%s", k ? "," : "", keys[k], part);
            free(uri);
        }
        snprintf(text + used, sizeof text - (size_t)used, "}}");
        struct reading *reading = read_good(text);
        assert_seen(render(reading), "...####.");
        assert_warned(reading->scene, "the asset 'c' is not used");
        reading_free(reading);
    }
}

/* Keeps the first two assets, as copies in the request's arena. */
static bool read_kept(void *context, const char *sha256, struct zr_arena *into, const void **bytes, size_t *size)
{
    assert_ptr_equal(context, assets);
    const struct zr_asset *kept = strcmp(sha256, HASH_C) == 0 ? &assets[0] : &assets[1];
    if (kept == &assets[1] && strcmp(sha256, HASH_W) != 0) return false;
    void *copy = zr_arena_alloc(into, kept->size, 1);
    if (!copy) return false;
    memcpy(copy, kept->bytes, kept->size);
    *bytes = copy;
    *size = kept->size;
    return true;
}

static const struct zr_request KEPT = {.format = ZR_FORMAT_JSON, .stored = {read_kept, assets}};

#define KEPT_SCENE(color, depth)                                                                                       \
    HEAD "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"}]," BASE(                                  \
        "\"color\":{\"asset\":\"sha256:" color "\"},\"windowDepth\":{\"asset\":\"sha256:" depth "\"}") "}"

static void assets_are_found_by_their_hash(void **state)
{
    (void)state;
    static const char text[] = KEPT_SCENE(HASH_C, HASH_W);
    const float want[PIXELS] = {0, 0.25f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.49999f};
    struct reading *reading = read_request(KEPT, text, sizeof text - 1, zr_limits_default(), (size_t)1 << 26);
    assert_read(reading);
    assert_memory_equal(render(reading)->window_depth, want, sizeof want);
    reading_free(reading);
    assert_in_range(smallest_ceiling(KEPT, text, sizeof text - 1, 1 << 18), 10000, 1 << 18);
}

static void unknown_hashes_are_refused_each_where_it_stands(void **state)
{
    (void)state;
    static const struct {
        const char *text, *pointer, *detail;
    } cases[] = {
        {KEPT_SCENE(HASH_C, HASH_C "0"), "/base/windowDepth/asset", "64 lower-case"},
        {KEPT_SCENE("C" HASH_C, HASH_W), "/base/color/asset", "64 lower-case"},
        {KEPT_SCENE("", HASH_W), "/base/color/asset", "64 lower-case"},
        {KEPT_SCENE("0123456789ABCDEF0123456789abcdef0123456789abcdef0123456789abcdef", HASH_W), "/base/color/asset",
         "64 lower-case"},
        {KEPT_SCENE("f123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef", HASH_W), "/base/color/asset",
         "PUT /v1/assets/f123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text;
        struct reading *reading = read_request(KEPT, text, strlen(text), zr_limits_default(), (size_t)1 << 26);
        assert_complaint(reading, ZR_BAD_SCENE, cases[i].pointer, cases[i].detail);
        reading_free(reading);
    }
}

static void what_may_be_meant_otherwise_is_warned_of(void **state)
{
    (void)state;
    static const char middle[] = ",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"window\":{\"width\":4,"
                                 "\"height\":2},\"outputs\":[{\"channel\":\"depth\"}],\"base\":{";
    static const char metric[] = "\"depth\":{\"asset\":\"d\"}";
    static const struct {
        const char *head, *base, *warning;
    } cases[] = {
        {"{\"view\":{\"znear\":1,\"zfar\":3},\"background\":[0,0,0,0]", ALL, "pose is fitted"},
        {"{\"view\":{\"direction\":[0,0,-1],\"znear\":1,\"zfar\":3}", ALL, "pose is fitted"},
        {"{\"view\":{\"azimuthDegrees\":10,\"znear\":1,\"zfar\":3}", ALL, "pose is fitted"},
        {"{\"view\":{\"azimuthDegrees\":10,\"distance\":3,\"znear\":1,\"zfar\":3}", ALL, "pose is fitted"},
        {"{\"background\":[0,0,0,0]", metric, "pose is fitted"},
        {"{\"view\":{\"azimuthDegrees\":10,\"distance\":3,\"target\":[0,0,0],\"znear\":1}", metric,
         "znear and zfar are fitted"},
        {"{\"view\":{\"eye\":[0,0,2],\"znear\":1}", metric, "znear and zfar are fitted"},
        {"{\"view\":{\"eye\":[0,0,2],\"orthographic\":{},\"znear\":1,\"zfar\":3}", ALL, "size is fitted"},
        {"{\"view\":{\"eye\":[0,0,2],\"znear\":1,\"zfar\":3}", ALL, "base.color is transparent in parts"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%s%s%s}}", cases[i].head, middle, cases[i].base);
        struct reading *reading = read_good(text);
        assert_warned(reading->scene, cases[i].warning);
        reading_free(reading);
    }
    struct reading *reading = read_with(HEAD BASE(ALL) "}", (struct zr_asset){"extra", "", 0}, NULL);
    assert_warned(reading->scene, "the asset 'extra' is not used by the scene");
    reading_free(reading);
}

static void geometry_hidden_by_the_base_is_warned_of(void **state)
{
    (void)state;
    const float zeros[PIXELS] = {0};
    struct reading *reading =
        read_with(HEAD "\"outputs\":[{\"channel\":\"windowDepth\"}]," BASE("\"windowDepth\":{\"asset\":\"x\"}") "}",
                  npy_asset("x", ZR_NPY_FLOAT32, zeros), NULL);
    assert_read(reading);
    struct zr_error error = {.count = 0};
    struct zr_answer answer;
    assert_int_equal(zr_encode(&reading->arena, NULL, reading->scene, render(reading), NULL, &answer, &error), ZR_OK);
    assert_non_null(strstr(answer.warnings, "in front of the base"));
    reading_free(reading);
}

static void memory_that_is_short_is_said_so(void **state)
{
    (void)state;
    static const char text[] = HEAD OUTPUTS "," BASE(ALL) "}";
    struct zr_request request = {.format = ZR_FORMAT_JSON, .assets = assets, .asset_count = ASSETS - 1};
    assert_in_range(smallest_ceiling(request, text, sizeof text - 1, 1 << 18), 10000, 1 << 18);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(base_is_seen_where_it_is_nearer_and_at_equal_depth),
        cmocka_unit_test(scene_that_wins_ties_is_seen_at_equal_depth_too),
        cmocka_unit_test(depth_alone_is_converted_by_the_view),
        cmocka_unit_test(depth_in_perspective_is_converted_too),
        cmocka_unit_test(window_depth_without_its_planes_is_refused),
        cmocka_unit_test(depth_in_an_oblique_projection_is_refused),
        cmocka_unit_test(info_tells_new_faces_from_the_base),
        cmocka_unit_test(ids_that_clash_or_do_not_fit_are_refused),
        cmocka_unit_test(what_the_outputs_need_must_be_there),
        cmocka_unit_test(bases_that_are_not_one_are_refused_where_it_shows),
        cmocka_unit_test(values_outside_of_their_range_are_refused_by_pixel),
        cmocka_unit_test(picture_of_another_size_is_refused),
        cmocka_unit_test(window_beyond_its_limits_is_refused_for_itself),
        cmocka_unit_test(data_uris_do_as_well_as_assets),
        cmocka_unit_test(assets_are_found_by_their_hash),
        cmocka_unit_test(unknown_hashes_are_refused_each_where_it_stands),
        cmocka_unit_test(what_may_be_meant_otherwise_is_warned_of),
        cmocka_unit_test(geometry_hidden_by_the_base_is_warned_of),
        cmocka_unit_test(memory_that_is_short_is_said_so),
    };
    return cmocka_run_group_tests_name("json_base", tests, make_assets, free_assets);
}
