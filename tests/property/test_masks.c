/* Masks of instances in every scene of tests/scenes and clients/examples: as drawn alone, as visible, and as files. */
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "output/masks.h"
#include "render_request.h"
#include "scene/camera/resolved_view.h"
#include "support/files.h"
#include "support/scenes.h"
#include "support/tests.h"

static struct zr_arena arena;
static struct zr_error faults;
static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_INSTANCE_ID, .encoding = ZR_ENCODING_NPY},
                                           {.channel = ZR_CHANNEL_MASKS, .encoding = ZR_ENCODING_ZIP}};

static const struct zr_frame *draw(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                   uint32_t output_count, struct zr_team *team)
{
    const struct zr_frame *frame;
    struct zr_scene *drawn = zr_arena_copy(&arena, scene, sizeof *scene);
    struct zr_resolved_view *view = zr_arena_copy(&arena, resolved, sizeof *resolved);
    assert_true(drawn && view);
    drawn->views[0].outputs = outputs;
    drawn->views[0].output_count = output_count;
    view->view = &drawn->views[0];
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .team = team, .error = &faults}, drawn, view, &frame),
                     ZR_OK);
    return frame;
}

static bool bit_at(const struct zr_instance_mask *mask, const uint64_t *bits, uint32_t x, uint32_t y)
{
    if (y < mask->amodal.box[1] || y >= mask->amodal.box[3] || x < mask->left || x >= mask->left + 64 * mask->words)
        return false;
    return bits[(size_t)(y - mask->amodal.box[1]) * mask->words + (x - mask->left) / 64] >> x % 64 & 1;
}

/* Compares a mask, which may be NULL, with the pixels of an id, and its number and box with them. */
static void assert_pixels(const char *path, const struct zr_frame *frame, uint32_t id,
                          const struct zr_instance_mask *mask, bool amodal)
{
    const uint32_t *ids = frame->channels[ZR_CHANNEL_INSTANCE_ID];
    struct zr_mask_extent want = {0, {UINT32_MAX, UINT32_MAX, 0, 0}};
    bool same = true;
    for (uint32_t y = 0; y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++) {
            const bool is_there = ids[(size_t)y * frame->width + x] == id;
            same = same && (mask && bit_at(mask, amodal ? mask->amodal_bits : mask->visible_bits, x, y)) == is_there;
            if (!is_there) continue;
            want.pixels++;
            if (x < want.box[0]) want.box[0] = x;
            if (y < want.box[1]) want.box[1] = y;
            if (x >= want.box[2]) want.box[2] = x + 1;
            if (y >= want.box[3]) want.box[3] = y + 1;
        }
    if (!same)
        fail_msg("%s: instance %u: other pixels %s", path, mask ? mask->instance : id - 1, amodal ? "alone" : "");
    const struct zr_mask_extent *extent = mask ? amodal ? &mask->amodal : &mask->visible : NULL;
    assert_true((extent ? extent->pixels : 0) == want.pixels);
    if (want.pixels > 0) assert_memory_equal(extent->box, want.box, sizeof want.box);
}

/* ---- files ---- */

/* Decodes COCO's text pixel by pixel, and returns false where it is no mask of the size. */
static bool text_is(const char *text, size_t size, const struct zr_frame *frame, const struct zr_instance_mask *mask,
                    const uint64_t *bits)
{
    int64_t runs[3] = {0};
    uint64_t at = 0, count = 0;
    const uint64_t pixels = (uint64_t)frame->width * frame->height;
    for (size_t i = 0; i < size; count++) {
        int64_t value = 0;
        int shift = 0, group;
        do {
            if (i == size) return false;
            group = text[i++] - 48;
            if (group < 0 || group > 63) return false;
            value |= (int64_t)(group & 31) << shift;
            shift += 5;
        } while (group & 32);
        if (group & 16) value -= INT64_C(1) << shift;
        if (count > 2) value += runs[1];
        runs[1] = runs[0];
        runs[0] = value;
        if (value < 0 || (value == 0 && count > 0) || at + (uint64_t)value > pixels) return false;
        for (; value > 0; value--, at++)
            if (bit_at(mask, bits, (uint32_t)(at / frame->height), (uint32_t)(at % frame->height)) != count % 2)
                return false;
    }
    return at == pixels;
}

static size_t find(const char *text, size_t size, size_t from, const char *what)
{
    const size_t length = strlen(what);
    for (; from + length <= size; from++)
        if (memcmp(text + from, what, length) == 0) return from + length;
    fail_msg("no %s", what);
    return 0;
}

/* Copies a JSON string without its backslashes. */
static size_t copy_string(const char *text, char *out)
{
    size_t size = 0;
    for (; *text != '"'; text++)
        out[size++] = *text == '\\' ? *++text : *text;
    return size;
}

static void check_json(const char *path, const struct zr_scene *scene, const struct zr_frame *frame)
{
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_masks_json_write(scene, frame, NULL, &out), ZR_OK);
    const char *text = (const char *)out.bytes;
    char *counts = zr_arena_alloc(&arena, out.size, 1);
    size_t at = 0;
    for (uint32_t i = 0; i < frame->masks->count; i++)
        for (int k = 0; k < 2; k++) {
            const struct zr_instance_mask *mask = &frame->masks->at[i];
            at = find(text, out.size, at, "\"counts\":\"");
            const size_t size = copy_string(text + at, counts);
            if (!text_is(counts, size, frame, mask, k == 0 ? mask->amodal_bits : mask->visible_bits))
                fail_msg("%s: other run lengths of instance %u", path, mask->instance);
        }
}

static void check_png(const char *bytes, size_t size, const struct zr_frame *frame, const struct zr_instance_mask *mask,
                      const uint64_t *bits)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&image, bytes, size));
    assert_int_equal(image.format, PNG_FORMAT_GRAY);
    assert_true(image.width == frame->width && image.height == frame->height);
    uint8_t *pixels = zr_arena_alloc(&arena, (size_t)frame->width * frame->height, 1);
    assert_true(pixels && png_image_finish_read(&image, NULL, pixels, 0, NULL));
    for (uint32_t y = 0; y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++)
            if (pixels[(size_t)y * frame->width + x] != (bit_at(mask, bits, x, y) ? 255 : 0))
                fail_msg("another pixel %u, %u of instance %u", x, y, mask->instance);
}

/* Reads the files of the ZIP, which are stored, in their order. */
static void check_zip(const struct zr_frame *frame)
{
    enum { HEAD = 30, SIZE_AT = 18, NAME_AT = 26 };
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_masks_zip_write(frame, NULL, &faults, &out), ZR_OK);
    size_t at = 0;
    for (uint32_t i = 0; i < frame->masks->count; i++)
        for (int k = 0; k < 2; k++) {
            const struct zr_instance_mask *mask = &frame->masks->at[i];
            const uint8_t *head = out.bytes + at;
            char name[32];
            snprintf(name, sizeof name, "masks/%06u.%s.png", mask->instance + 1, k == 0 ? "amodal" : "visible");
            const size_t size =
                (size_t)head[SIZE_AT] | (size_t)head[SIZE_AT + 1] << 8 | (size_t)head[SIZE_AT + 2] << 16;
            assert_int_equal(head[NAME_AT], strlen(name));
            assert_memory_equal(head + HEAD, name, strlen(name));
            at += HEAD + strlen(name);
            check_png((const char *)out.bytes + at, size, frame, mask, k == 0 ? mask->amodal_bits : mask->visible_bits);
            at += size;
        }
}

/* ---- scenes ---- */

static size_t hidden_in_part, culled;

static void check_scene(const char *path, const struct zr_scene *scene, struct zr_team *team)
{
    const struct zr_resolved_view *resolved;
    assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &faults}, scene, &resolved),
                     ZR_OK);
    const struct zr_frame *frame = draw(scene, resolved, 2, team);
    uint32_t next = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        struct zr_scene alone = *scene;
        alone.instances += i;
        alone.instance_count = 1;
        const bool is_there = next < frame->masks->count && frame->masks->at[next].instance == i;
        const struct zr_instance_mask *mask = is_there ? &frame->masks->at[next++] : NULL;
        assert_pixels(path, draw(&alone, resolved, 1, NULL), 1, mask, true);
        assert_pixels(path, frame, i + 1, mask, false);
        hidden_in_part += mask && mask->visible.pixels > 0 && mask->visible.pixels < mask->amodal.pixels;
        culled += !mask;
    }
    assert_int_equal(next, frame->masks->count);
    check_json(path, scene, frame);
    check_zip(frame);
}

static void check_file(const char *path, void *team)
{
    struct zr_request request = {.format = ZR_FORMAT_JSON};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    char *bytes = file_read(path, &request.size);
    zr_arena_init(&arena, (size_t)1 << 31);
    request.bytes = bytes;
    assert_int_equal(zr_scene_read(&(struct zr_run){.arena = &arena, .error = &faults}, &request, &limits, &scene),
                     ZR_OK);
    struct zr_scene drawn = *scene;
    const uint32_t width = drawn.views[0].width, height = drawn.views[0].height;
    drawn.algorithm = ZR_ALGORITHM_HALFSPACE;
    if (width > 200 || height > 200) { /* smaller ones show as much */
        drawn.views[0].width = width > 200 ? 200 : width;
        drawn.views[0].height = height > 200 ? 200 : height;
    }
    if (!scene->base && !scene->csg && scene->sections.count == 0 && scene->instance_count <= 40)
        check_scene(path, &drawn, team);
    zr_arena_free(&arena);
    free(bytes);
}

TEST(masks_are_those_of_instances_drawn_alone_and_of_their_visible_pixels)
{
    struct zr_team *team = zr_team_create(3);
    assert_true(files_each("tests/scenes", ".json", check_file, team) > 30);
    assert_true(files_each("clients/examples", ".json", check_file, team) > 0);
    print_message("%zu instances are hidden in part, %zu have no pixels\n", hidden_in_part, culled);
    assert_true(hidden_in_part > 20 && culled > 3);
    zr_team_destroy(team);
}

/* Every algorithm keeps the same fragments. */
TEST(algorithms_have_the_same_masks)
{
    static const zr_vec4 positions[] = {{-0.9f, -0.9f, 0.1f, 1}, {0.9f, -0.8f, 0.2f, 1}, {0, 0.9f, 0.3f, 1}};
    static struct test_scene test;
    zr_arena_init(&arena, (size_t)1 << 28);
    scene_of_triangles(&test, 90, 70, positions, 1);
    for (int a = 0; a < ZR_ALGORITHM_PAINTER; a++) {
        test.scene.algorithm = (enum zr_algorithm)a;
        check_scene("one triangle", &test.scene, NULL);
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
