/* Scenes with a base: what is read, and what is drawn. */
#include "base/run.h"
#include "support/tests.h"
#include "unit/common/base_scenes.h"

TEST(base_is_seen_where_it_is_nearer_and_at_equal_depth)
{
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

TEST(scene_that_wins_ties_is_seen_at_equal_depth_too)
{
    struct reading *reading = read_good(HEAD OUTPUTS "," BASE(ALL ",\"ties\":\"scene\"") "}");
    assert_seen(render(reading), "..#####.");
    reading_free(reading);
}

TEST(depth_alone_is_converted_by_the_view)
{
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
TEST(depth_in_perspective_is_converted_too)
{
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

static cJSON *info_of(struct reading *reading)
{
    static const struct zr_output output = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    struct zr_scene scene = *reading->scene;
    scene.views[0].outputs = &output;
    scene.views[0].output_count = 1;
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

TEST(info_tells_new_faces_from_the_base)
{
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

TEST(data_uris_do_as_well_as_assets)
{
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
static enum zr_status read_kept(void *context, const char *sha256, struct zr_arena *into, const void **bytes,
                                size_t *size)
{
    assert_ptr_equal(context, assets);
    const struct zr_asset *kept = strcmp(sha256, HASH_C) == 0 ? &assets[0] : &assets[1];
    if (kept == &assets[1] && strcmp(sha256, HASH_W) != 0) return ZR_BAD_SCENE;
    void *copy = zr_arena_alloc(into, kept->size, 1);
    if (!copy) return ZR_NO_MEMORY;
    memcpy(copy, kept->bytes, kept->size);
    *bytes = copy;
    *size = kept->size;
    return ZR_OK;
}

static const struct zr_request KEPT = {.format = ZR_FORMAT_JSON, .stored = {.read = read_kept, .context = assets}};

#define KEPT_SCENE(color, depth)                                                                                       \
    HEAD "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"}]," BASE(                                  \
        "\"color\":{\"asset\":\"sha256:" color "\"},\"windowDepth\":{\"asset\":\"sha256:" depth "\"}") "}"

TEST(assets_are_found_by_their_hash)
{
    static const char text[] = KEPT_SCENE(HASH_C, HASH_W);
    const float want[PIXELS] = {0, 0.25f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.49999f};
    struct reading *reading = read_request(KEPT, text, sizeof text - 1, zr_limits_default(), (size_t)1 << 26);
    assert_read(reading);
    assert_memory_equal(render(reading)->window_depth, want, sizeof want);
    reading_free(reading);
    assert_in_range(smallest_ceiling(KEPT, text, sizeof text - 1, 1 << 18), 10000, 1 << 18);
}

TEST(unknown_hashes_are_refused_each_where_it_stands)
{
    static const struct {
        const char *text, *pointer, *detail;
    } cases[] = {
        {KEPT_SCENE(HASH_C, HASH_C "0"), "/base/windowDepth/asset", "64 lower-case"},
        {KEPT_SCENE("C" HASH_C, HASH_W), "/base/color/asset", "64 lower-case"},
        {KEPT_SCENE("", HASH_W), "/base/color/asset", "64 lower-case"},
        {KEPT_SCENE("0123456789ABCDEF0123456789abcdef0123456789abcdef0123456789abcdef", HASH_W), "/base/color/asset",
         "64 lower-case"},
        {KEPT_SCENE("f123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef", HASH_W), "/base/color/asset",
         "the hash f123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef;"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text;
        struct reading *reading = read_request(KEPT, text, strlen(text), zr_limits_default(), (size_t)1 << 26);
        assert_complaint(reading, ZR_BAD_SCENE, cases[i].pointer, cases[i].detail);
        reading_free(reading);
    }
}

static enum zr_status fail_to_read(void *context, const char *sha256, struct zr_arena *into, const void **bytes,
                                   size_t *size)
{
    (void)sha256, (void)into, (void)bytes, (void)size;
    return *(const enum zr_status *)context;
}

/* No fault of the scene: it may well be kept. */
TEST(assets_that_cannot_be_read_are_not_called_missing)
{
    static const char text[] = KEPT_SCENE(HASH_C, HASH_W);
    enum zr_status cases[] = {ZR_INTERNAL, ZR_CANCELLED};
    for (size_t i = 0; i < 2; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_JSON,
                                           .stored = {.read = fail_to_read, .context = &cases[i]}};
        struct reading *reading = read_request(request, text, sizeof text - 1, zr_limits_default(), (size_t)1 << 26);
        assert_int_equal(reading->status, cases[i]);
        assert_null(strstr(reading->error.items[0].detail, "is kept"));
        reading_free(reading);
    }
}

TEST(what_may_be_meant_otherwise_is_warned_of)
{
    static const char middle[] = ",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"window\":{\"width\":4,"
                                 "\"height\":2},\"outputs\":[{\"channel\":\"%s\"}],\"base\":{";
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
        char between[512];
        snprintf(between, sizeof between, middle, cases[i].base == metric ? "depth" : "color");
        snprintf(text, sizeof text, "%s%s%s}}", cases[i].head, between, cases[i].base);
        struct reading *reading = read_good(text);
        assert_warned(reading->scene, cases[i].warning);
        reading_free(reading);
    }
    struct reading *reading = read_with(HEAD BASE(ALL) "}", (struct zr_asset){.name = "extra", .bytes = ""}, NULL);
    assert_warned(reading->scene, "the asset 'extra' is not used by the scene");
    reading_free(reading);
}

TEST(geometry_hidden_by_the_base_is_warned_of)
{
    const float zeros[PIXELS] = {0};
    struct reading *reading =
        read_with(HEAD "\"outputs\":[{\"channel\":\"windowDepth\"}]," BASE("\"windowDepth\":{\"asset\":\"x\"}") "}",
                  npy_asset("x", ZR_NPY_FLOAT32, zeros), NULL);
    assert_read(reading);
    struct zr_error error = {.count = 0};
    struct zr_answer answer;
    assert_int_equal(zr_encode(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene,
                               render(reading), &answer),
                     ZR_OK);
    assert_non_null(strstr(answer.warnings, "in front of the base"));
    reading_free(reading);
}

RUN_TESTS(make_assets, free_assets)
