/* The system's memory is used up, at each allocation of whole requests in turn: every request ends as one that has no
 * memory, or as if nothing had happened, and nothing is lost. */
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/run.h"
#include "core.h"
#include "input/images/image_read.h"
#include "output/images/png.h"
#include "output/npy.h"
#include "render_request.h"
#include "support/failing_malloc.h"
#include "support/pictures/jpeg.h"
#include "support/sanitized.h"
#include "support/tests.h"

/* ---- allocations, counted, and failing when told so ---- */

static struct failing_malloc control;
static long live; /* blocks that have not been freed */

static bool fails(void)
{
    return failing_malloc_fails(&control);
}

static void *counted(void *made)
{
    if (made) live++;
    return made;
}

/* Whose allocations these are: a sanitizer's, by the name that it has for them, or the C library's. */
#if IS_SANITIZED
#define NEXT(name)                                                                                                     \
    extern __typeof__(name) __interceptor_##name;                                                                      \
    static __typeof__(name) *const next = __interceptor_##name
#else
#define NEXT(name)                                                                                                     \
    static __typeof__(name) *next;                                                                                     \
    if (!next) *(void **)(void *)&next = dlsym(RTLD_NEXT, #name)
#endif

void *malloc(size_t size)
{
    NEXT(malloc);
    return fails() ? NULL : counted(next(size));
}

void *calloc(size_t count, size_t size)
{
    NEXT(calloc);
    return fails() ? NULL : counted(next(count, size));
}

void *realloc(void *old, size_t size)
{
    NEXT(realloc);
    if (fails()) return NULL;
    return old ? next(old, size) : counted(next(old, size));
}

void *aligned_alloc(size_t alignment, size_t size)
{
    NEXT(aligned_alloc);
    return fails() ? NULL : counted(next(alignment, size));
}

int posix_memalign(void **out, size_t alignment, size_t size)
{
    NEXT(posix_memalign);
    if (fails()) return ENOMEM;
    const int status = next(out, alignment, size);
    if (status == 0) live++;
    return status;
}

void free(void *old)
{
    NEXT(free);
    if (old) live--;
    next(old);
}

/* ---- requests ---- */

#define OUTPUTS                                                                                                        \
    "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\",\"encoding\":\"png16\"},{\"channel\":\"depth\"},"     \
    "{\"channel\":\"windowDepth\"},{\"channel\":\"faceId\"},{\"channel\":\"info\"}]"
#define WINDOW "\"window\":{\"width\":16,\"height\":12}"

static const char several[] =
    "{" WINDOW "," OUTPUTS ",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]],\"colors\":[\"#ff0000\",\"#00ff00\","
    "\"#0000ff\"]},{\"vertices\":[[0,0,1],[1,0,1],[1,1,1],[0,1,1]],\"holes\":[[[0.2,0.2,1],[0.2,0.4,1],[0.4,0.2,1]]]}],"
    "\"materials\":[{\"name\":\"m\",\"baseColorFactor\":[0.5,0.25,1,0.5]}],\"meshes\":[{\"name\":\"a\",\"positions\":["
    "[0,0,2],[1,0,2],[0,1,2]],\"faces\":[[0,1,2]],\"lines\":[[0,1]],\"points\":[2],\"material\":\"m\",\"outline\":true}"
    ",{\"name\":"
    "\"b\",\"heights\":[[0,1],[1,0]]}],\"nodes\":[{\"mesh\":0,\"children\":[1]},{\"mesh\":\"a\",\"translation\":[1,0,0]"
    "}"
    "],\"lights\":[{\"type\":\"directional\",\"direction\":[0,0,-1]}]}";
static const char into_base[] =
    "{" WINDOW "," OUTPUTS
    ",\"view\":{\"eye\":[0,0,5],\"znear\":1,\"zfar\":10},\"base\":{\"color\":{\"asset\":\"color\"}"
    ",\"windowDepth\":{\"asset\":\"depth\"},\"depth\":{\"asset\":\"depth\"},\"faceId\":{\"asset\":\"ids\"}},"
    "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}";
static const char refused[] = "{" WINDOW ",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0]],\"color\":\"red?\"}],\"a\":1}";
static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n";

#define LIT_MESH                                                                                                       \
    "\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],\"faces\":[[0,1,2],[0,1,3],[1,2,3]],\"lines\":[[0,"  \
    "1]],"                                                                                                             \
    "\"outline\":true}],\"lineWidth\":2.5,\"samples\":16,\"edges\":{\"width\":3},\"lights\":[{\"type\":"               \
    "\"directional\","                                                                                                 \
    "\"direction\":[0,-1,-1],\"shadows\":true},{\"type\":\"hemisphere\"},{\"type\":\"spot\",\"position\":[0,2,2],"     \
    "\"direction\":[0,-1,-1],\"shadows\":true},{\"type\":\"point\",\"position\":[1,1,1]}]"
static const char *const lit[] = {
    "{" WINDOW ",\"look\":\"outdoor\"," LIT_MESH ",\"outputs\":[{\"channel\":\"color\"}]}",
    "{" WINDOW ",\"look\":\"studio\",\"algorithm\":\"painter\",\"shading\":\"phong\"," LIT_MESH "," OUTPUTS "}"};

static struct zr_asset assets[3];

/* What comes of one. */
struct outcome {
    enum zr_status status;
    uint8_t bytes[1 << 16];
    size_t size;
};

static struct zr_arena pictures;

static struct zr_asset asset(const char *name, const struct zr_buffer *buffer)
{
    return (struct zr_asset){.name = name, .bytes = (const char *)buffer->bytes, .size = buffer->size};
}

static int make_assets(void **state)
{
    static uint8_t rgba[12 * 16 * 4];
    static float depth[12 * 16];
    static uint32_t ids[12 * 16];
    struct zr_buffer color = {.arena = &pictures}, depths = {.arena = &pictures}, numbers = {.arena = &pictures};
    const struct zr_png png = {.kind = ZR_PNG_RGB, .width = 16, .height = 12, .pixels = rgba};
    (void)state;
    zr_arena_init(&pictures, 1 << 24);
    for (size_t i = 0; i < sizeof rgba; i++)
        rgba[i] = (uint8_t)(i * 7);
    for (size_t i = 0; i < 12 * 16; i++)
        depth[i] = 1.0f;
    if (zr_png_write(&png, NULL, NULL, &color) != ZR_OK ||
        zr_npy_write(ZR_NPY_FLOAT32, 16, 12, 1, depth, &depths) != ZR_OK ||
        zr_npy_write(ZR_NPY_UINT32, 16, 12, 1, ids, &numbers) != ZR_OK)
        return -1;
    assets[0] = asset("color", &color);
    assets[1] = asset("depth", &depths);
    assets[2] = asset("ids", &numbers);
    return 0;
}

static int free_assets(void **state)
{
    (void)state;
    zr_arena_free(&pictures);
    return 0;
}

/* From the body to the answer, as the server does it. `subject` is a struct zr_request. */
static void run_request(const void *subject, struct outcome *outcome)
{
    const struct zr_request *request = subject;
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene = NULL;
    const struct zr_frame *frame = NULL;
    struct zr_answer answer = {0};
    struct zr_error error = {0};
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 26);
    outcome->size = 0;
    outcome->status = zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, request, &limits, &scene);
    if (outcome->status == ZR_OK)
        outcome->status = zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame);
    if (outcome->status == ZR_OK)
        outcome->status = zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, scene, frame, &answer);
    if (outcome->status == ZR_OK && answer.size <= sizeof outcome->bytes) {
        memcpy(outcome->bytes, answer.bytes, answer.size);
        outcome->size = answer.size;
    }
    zr_arena_free(&arena);
}

/* From bytes to texels. `subject` is a struct zr_asset. */
static void run_image(const void *subject, struct outcome *outcome)
{
    const struct zr_asset *picture = subject;
    struct zr_image image = {0};
    struct zr_reason reason;
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 26);
    outcome->size = 0;
    outcome->status = zr_image_read(
        &arena, &(struct zr_encoded_image){picture->bytes, picture->size, sizeof outcome->bytes / 4}, &image, &reason);
    if (outcome->status == ZR_OK) {
        outcome->size = (size_t)image.width * image.height * 4;
        memcpy(outcome->bytes, image.texels, outcome->size);
    }
    zr_arena_free(&arena);
}

typedef void run_fn(const void *subject, struct outcome *outcome);

static void assert_run_survives(const char *name, run_fn *run, const void *subject, enum zr_status status)
{
    static struct outcome whole, got;
    run(subject, &whole); /* what libraries keep for good they keep from now on */
    assert_int_equal(whole.status, status);
    assert_true((whole.size > 0) == (status == ZR_OK));
    unsigned runs = 0;
    for (unsigned every = 0; every <= 3; every++) {
        const long live_before = live;
        unsigned failed = 1;
        for (unsigned first = 1; failed > 0; first++, runs++) {
            failing_malloc_arm(&control, first, every);
            run(subject, &got);
            atomic_store(&control.first, 0);
            failed = atomic_load(&control.failed);
            if (live != live_before)
                fail_msg("%s: %ld blocks lost where allocation %u failed, every %u", name, live - live_before, first,
                         every);
            if (got.status == ZR_NO_MEMORY && failed > 0) continue;
            if (got.status != status || got.size != whole.size || memcmp(got.bytes, whole.bytes, got.size) != 0)
                fail_msg("%s: status %d where allocation %u failed, every %u", name, (int)got.status, first, every);
        }
    }
    print_message("%s: %u runs\n", name, runs);
    assert_true(runs >= 8);
}

static void assert_survives(const char *name, const struct zr_request *request, enum zr_status status)
{
    assert_run_survives(name, run_request, request, status);
}

TEST(each_channel_alone)
{
    static const struct {
        const char *channel, *encoding;
    } outputs[] = {{"color", "png"},       {"depth", "png16"}, {"depth", "npy"},
                   {"windowDepth", "npy"}, {"faceId", "npy"},  {"info", "json"}};
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++)
        assert_survives(outputs[i].channel,
                        &(struct zr_request){.format = ZR_FORMAT_JSON,
                                             .bytes = several,
                                             .size = strlen(several),
                                             .channel = outputs[i].channel,
                                             .encoding = outputs[i].encoding},
                        ZR_OK);
}

TEST(several_outputs_in_an_archive)
{
    assert_survives("archive",
                    &(struct zr_request){.format = ZR_FORMAT_JSON, .bytes = several, .size = strlen(several)}, ZR_OK);
}

TEST(small_pngs)
{
    assert_survives("small",
                    &(struct zr_request){.format = ZR_FORMAT_JSON,
                                         .bytes = several,
                                         .size = strlen(several),
                                         .channel = "color",
                                         .compress = "small"},
                    ZR_OK);
}

TEST(pictures_that_are_drawn_into)
{
    assert_survives("base",
                    &(struct zr_request){.format = ZR_FORMAT_JSON,
                                         .bytes = into_base,
                                         .size = strlen(into_base),
                                         .assets = assets,
                                         .asset_count = 3,
                                         .channel = "info"},
                    ZR_OK);
}

TEST(info_of_a_bare_mesh)
{
    assert_survives("OBJ",
                    &(struct zr_request){.format = ZR_FORMAT_OBJ, .bytes = obj, .size = strlen(obj), .channel = "info"},
                    ZR_OK);
}

/* Each look, with samples and all effects that it has; shadows, edges and lines besides. */
TEST(pictures_of_looks)
{
    static const char *const looks[] = {"studio", "technical", "outdoor", "blueprint", "xray", "textbook"};
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++)
        assert_survives(looks[i],
                        &(struct zr_request){.format = ZR_FORMAT_OBJ,
                                             .bytes = obj,
                                             .size = strlen(obj),
                                             .look = looks[i],
                                             .samples = "4",
                                             .width = "24",
                                             .height = "17"},
                        ZR_OK);
    for (size_t i = 0; i < sizeof lit / sizeof lit[0]; i++)
        assert_survives("lit", &(struct zr_request){.format = ZR_FORMAT_JSON, .bytes = lit[i], .size = strlen(lit[i])},
                        ZR_OK);
}

TEST(a_scene_that_is_refused)
{
    assert_survives("refused",
                    &(struct zr_request){.format = ZR_FORMAT_JSON, .bytes = refused, .size = strlen(refused)},
                    ZR_BAD_SCENE);
}

/* The allocations of libpng and libjpeg are the arena's, but for those by which libjpeg begins. */
TEST(images_of_textures)
{
    static const struct jpeg_kind kinds[] = {
        {.colors = JPEG_YCBCR, .across = 2, .down = 2, .quality = 75},
        {.colors = JPEG_YCBCR, .across = 1, .down = 1, .is_progressive = true, .quality = 75}};
    uint8_t pixels[24 * 17 * 3];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * 7);
    assert_run_survives("PNG", run_image, &assets[0], ZR_OK);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        size_t size;
        uint8_t *bytes = jpeg_memory_write(&kinds[i], pixels, 24, 17, &size);
        assert_non_null(bytes);
        assert_run_survives("JPEG", run_image, &(struct zr_asset){.name = "jpeg", .bytes = bytes, .size = size}, ZR_OK);
        assert_run_survives("JPEG cut short", run_image,
                            &(struct zr_asset){.name = "jpeg", .bytes = bytes, .size = size / 2}, ZR_BAD_SCENE);
        free(bytes);
    }
}

RUN_TESTS(make_assets, free_assets)
