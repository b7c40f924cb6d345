/* core/views: arrays, animations and sheets of several views have the pixels of the views drawn alone. */
#include "base/run.h"
#include "output/images/webp_frames.h"
#include "output/npy.h"
#include "support/pictures/gif.h"
#include "support/pictures/png.h"
#include "unit/common/views_check.h"

/* ---- joined files ---- */

TEST_AROUND(arrays_of_equal_windows_are_one_array, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files files =
        draw(SCENE
             ", \"outputs\": [{\"channel\": \"normals\"}, {\"channel\": \"faceId\"}], \"views\": [\"front\", \"top\"]}",
             &views);
    static const char *const views_alone[] = {"front", "top"};
    assert_int_equal(files.count, 2);
    for (int k = 0; k < 2; k++) {
        const struct zr_zip_entry *file = file_of(&files, k == 0 ? "normals.npy" : "faceId.npy");
        const size_t bytes = (size_t)80 * 60 * (k == 0 ? 12 : 4);
        assert_int_equal(file->size, ZR_NPY_HEADER + 2 * bytes);
        assert_non_null(strstr((const char *)file->bytes + 10, k == 0 ? "(2, 60, 80, 3)" : "(2, 60, 80)"));
        for (int v = 0; v < 2; v++) {
            char text[1024];
            struct zr_files alone;
            snprintf(text, sizeof text, SCENE ", \"outputs\": [{\"channel\": \"%s\"}], \"view\": {\"preset\": \"%s\"}}",
                     k == 0 ? "normals" : "faceId", views_alone[v]);
            draw_alone(text, &alone);
            assert_memory_equal((const char *)file->bytes + ZR_NPY_HEADER + (size_t)v * bytes,
                                (const char *)alone.entries[0].bytes + ZR_NPY_HEADER, bytes);
        }
    }
}

TEST_AROUND(arrays_of_other_windows_stay_apart, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files files = draw(SCENE ", \"outputs\": [{\"channel\": \"depth\"}], \"views\": [\"front\", "
                                             "{\"name\": \"b\", \"window\": {\"width\": 9, \"height\": 9}}]}",
                                       &views);
    assert_int_equal(files.count, 2);
    assert_int_equal(file_of(&files, "b.depth.npy")->size, ZR_NPY_HEADER + 4 * 81);
    file_of(&files, "front.depth.npy");
}

#define AWAY(name) "{\"name\": \"" name "\", \"view\": {\"eye\": [0,0,99], \"target\": [0,0,200]}}"
TEST_AROUND(warnings_of_some_views_name_them, open_arena, close_arena)
{
    static const struct {
        const char *views, *warning;
    } cases[] = {{"\"front\", " AWAY("away") ", \"top\"", "view away: nothing is visible"},
                 {"\"front\", " AWAY("a") ", " AWAY("b"), "2 of 3 views, the first is a: nothing is visible"},
                 {AWAY("a") ", " AWAY("b"), "nothing is visible"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        struct zr_views views;
        snprintf(text, sizeof text, SCENE ", \"views\": [%s]}", cases[i].views);
        const struct zr_files files = draw(text, &views);
        assert_int_equal(files.warnings.count, 1);
        assert_memory_equal(files.warnings.texts[0], cases[i].warning, strlen(cases[i].warning));
    }
}

static uint32_t u32_at(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Makes the PNG of a frame: the chunks before the first frame, and the frame's data as IDAT. libpng checks their sums.
 */
static void take_frame(const uint8_t *apng, size_t size, uint32_t number, struct zr_buffer *out)
{
    uint32_t frame = UINT32_MAX, sequence = 0;
    zr_buffer_add(out, apng, 8 + 25);
    for (size_t at = 8 + 25; at < size; at += u32_at(apng + at) + 12) {
        const uint8_t *chunk = apng + at;
        const uint32_t length = u32_at(chunk);
        const bool is_control = memcmp(chunk + 4, "fcTL", 4) == 0, is_more = memcmp(chunk + 4, "fdAT", 4) == 0;
        if (is_control) frame++;
        if (is_control || is_more) assert_int_equal(u32_at(chunk + 8), sequence++);
        if (memcmp(chunk + 4, "IDAT", 4) == 0) assert_int_equal(frame, 0);
        if (frame != number) continue;
        if (memcmp(chunk + 4, "IDAT", 4) == 0) zr_buffer_add(out, chunk, length + 12);
        if (!is_more) continue;
        uint8_t head[8];
        for (int i = 0; i < 4; i++)
            head[i] = (uint8_t)((length - 4) >> (24 - 8 * i));
        memcpy(head + 4, "IDAT", 4);
        zr_buffer_add(out, head, 8);
        zr_buffer_add(out, chunk + 12, length - 4);
        uint32_t sum = UINT32_MAX; /* CRC-32 of ISO 3309, bit by bit */
        for (size_t i = out->size - length; i < out->size; i++) {
            sum ^= out->bytes[i];
            for (int bit = 0; bit < 8; bit++)
                sum = sum >> 1 ^ (sum & 1u ? 0xedb88320u : 0);
        }
        for (int i = 0; i < 4; i++)
            head[i] = (uint8_t)(~sum >> (24 - 8 * i));
        zr_buffer_add(out, head, 4);
    }
    assert_int_equal(frame + 1, 3);
    static const uint8_t end[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    assert_memory_equal(apng + size - sizeof end, end, sizeof end);
    zr_buffer_add(out, end, sizeof end);
}

TEST_AROUND(frames_of_an_animation_have_the_pixels_of_their_views, open_arena, close_arena)
{
    static const char *const backgrounds[] = {"\"#102030\"", "\"#10203040\""};
    for (int k = 0; k < 2; k++) {
        char text[1024];
        struct zr_views views;
        snprintf(text, sizeof text,
                 SCENE ", \"background\": %s, \"outputs\": [{\"channel\": \"color\", \"encoding\": \"apng\"}], "
                       "\"views\": [\"front\", \"top\", {\"hide\": \"m\"}]}",
                 backgrounds[k]);
        const struct zr_files files = draw(text, &views);
        static const char *const keys[] = {"\"view\": {\"preset\": \"front\"}", "\"view\": {\"preset\": \"top\"}",
                                           "\"hide\": \"m\""};
        assert_int_equal(files.count, 1);
        assert_string_equal(files.entries[0].name, "color.apng");
        assert_string_equal(files.types[0], "image/apng");
        assert_memory_equal((const char *)files.entries[0].bytes + 33, "\0\0\0\1sRGB\0", 9);
        for (uint32_t i = 0; i < 3; i++) {
            struct zr_buffer png = {.arena = &arena};
            struct zr_files alone;
            uint32_t width, height;
            take_frame(files.entries[0].bytes, files.entries[0].size, i, &png);
            snprintf(text, sizeof text, SCENE ", \"background\": %s, %s}", backgrounds[k], keys[i]);
            draw_alone(text, &alone);
            void *got = png_memory_read(png.bytes, png.size, PNG_AS_RGBA, &width, &height);
            void *want = png_memory_read(alone.entries[0].bytes, alone.entries[0].size, PNG_AS_RGBA, &width, &height);
            assert_non_null(got);
            assert_non_null(want);
            assert_memory_equal(got, want, 80 * 60 * 4);
            free(got);
            free(want);
        }
    }
}

/* ---- animated WebP ---- */

static uint32_t little_at(const uint8_t *at, int bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint32_t)at[i] << (8 * i);
    return value;
}

/* Compares a chunk ANMF with the picture of its view, drawn alone. Returns its duration. */
static uint32_t check_frame(const uint8_t *chunk, const struct zr_zip_entry *alone)
{
    static const uint8_t place[] = {0, 0, 0, 0, 0, 0, 79, 0, 0, 59, 0, 0};
    const uint8_t *image = (const uint8_t *)alone->bytes + 12;
    const size_t extended = memcmp(image, "VP8X", 4) == 0 ? 18 : 0; /* a frame has none */
    assert_memory_equal(chunk, "ANMF", 4);
    assert_memory_equal(chunk + 8, place, sizeof place);
    assert_int_equal(chunk[8 + 15], 2); /* replaces the last frame */
    assert_int_equal(little_at(chunk + 4, 4), 16 + alone->size - 12 - extended);
    assert_memory_equal(chunk + 8 + 16, image + extended, alone->size - 12 - extended);
    return little_at(chunk + 8 + 12, 3);
}

TEST_AROUND(frames_of_an_animated_webp_have_the_bytes_of_their_views, open_arena, close_arena)
{
    static const struct {
        const char *background, *how;
        uint8_t flags; /* animation, alpha */
    } cases[] = {{"#102030", "\"lossless\": true", 2},
                 {"#10203040", "\"lossless\": true", 2 | 16},
                 {"#102030", "\"quality\": 40", 2},
                 {"#10203040", "\"quality\": 40", 2 | 16}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[1024], output[200];
        struct zr_views views;
        snprintf(output, sizeof output,
                 ", \"background\": \"%s\", \"outputs\": [{\"channel\": \"color\", \"encoding\": \"webp\", %s}]",
                 cases[k].background, cases[k].how);
        snprintf(text, sizeof text, SCENE "%s, \"turntable\": {\"frames\": 3, \"seconds\": 0.1}}", output);
        const struct zr_files files = draw(text, &views);
        const uint8_t *webp = files.entries[0].bytes;
        const size_t size = files.entries[0].size;
        assert_int_equal(files.count, 1);
        assert_string_equal(files.entries[0].name, "color.webp");
        assert_string_equal(files.types[0], "image/webp");
        assert_memory_equal(webp, "RIFF", 4);
        assert_int_equal(little_at(webp + 4, 4) + 8, size);
        assert_memory_equal(webp + 8, "WEBPVP8X\x0a\0\0", 11);
        const uint8_t canvas[] = {cases[k].flags, 0, 0, 0, 79, 0, 0, 59, 0, 0};
        assert_memory_equal(webp + 20, canvas, sizeof canvas);
        assert_memory_equal(webp + 30, "ANIM\x06\0\0\0\0\0\0\0\0\0", 14);
        const uint8_t *at = webp + 44;
        for (uint32_t i = 0; i < 3; i++) {
            static const uint32_t times[] = {33, 34, 33};
            const struct zr_frame *frame;
            struct zr_files alone;
            struct zr_error error = {0};
            const struct zr_scene *scene = scene_of_view(&views, i);
            assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame), ZR_OK);
            assert_int_equal(
                zr_encode_files(&(struct zr_run){.arena = &arena, .error = &error}, scene, frame, NULL, &alone), ZR_OK);
            assert_int_equal(check_frame(at, &alone.entries[0]), times[i]);
            at += 8 + little_at(at + 4, 4);
        }
        assert_ptr_equal(at, webp + size);
    }
}

TEST_AROUND(pictures_of_views_without_times_are_no_animation, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files files =
        draw(SCENE ", \"outputs\": [{\"channel\": \"color\", \"encoding\": \"webp\"}, {\"channel\": \"color\", "
                   "\"encoding\": \"gif\"}], \"views\": [\"front\", \"top\"]}",
             &views);
    assert_int_equal(files.count, 4);
    file_of(&files, "front.color.webp");
    file_of(&files, "front.color.gif");
}

TEST_AROUND(a_gif_of_a_turntable_has_the_pictures_of_its_views, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files files = draw(SCENE ", \"outputs\": [{\"channel\": \"color\", \"encoding\": \"gif\"}], "
                                             "\"turntable\": {\"frames\": 3, \"seconds\": 0.1}}",
                                       &views);
    assert_int_equal(files.count, 1);
    assert_string_equal(files.entries[0].name, "color.gif");
    assert_string_equal(files.types[0], "image/gif");
    struct gif gif = gif_open(files.entries[0].bytes, files.entries[0].size);
    for (uint32_t i = 0; i < 3; i++) {
        static const uint32_t times[] = {3, 4, 3};
        static uint8_t made[4 * 80 * 60], expected[4 * 80 * 60];
        const struct zr_frame *frame;
        struct zr_files alone;
        struct zr_error error = {0};
        const struct zr_scene *scene = scene_of_view(&views, i);
        const struct zr_run run = {.arena = &arena, .error = &error};
        assert_int_equal(zr_render(&run, scene, NULL, &frame), ZR_OK);
        assert_int_equal(zr_encode_files(&run, scene, frame, NULL, &alone), ZR_OK);
        struct gif still = gif_open(alone.entries[0].bytes, alone.entries[0].size);
        assert_true(gif_next(&gif, made) && gif_next(&still, expected));
        assert_memory_equal(made, expected, sizeof made);
        assert_int_equal(gif.delay, times[i]);
    }
    assert_false(gif_next(&gif, NULL));
}

TEST_AROUND(a_webp_of_4_gib_is_refused, open_arena, close_arena)
{
    const uint8_t still[] = "RIFF\x12\0\0\0WEBPVP8L\x06\0\0\0\x2f\0\0\0\0";
    struct zr_buffer out = {.arena = &arena};
    struct zr_webp_frames frames = {.out = &out, .frames = 9, .seconds = 1, .width = 1, .height = 1};
    assert_int_equal(zr_webp_frames_add(&frames, still, sizeof still - 1), ZR_OK);
    out.size = UINT32_MAX - 40; /* has no such memory, and needs none */
    assert_int_equal(zr_webp_frames_add(&frames, still, sizeof still - 1), ZR_BAD_SCENE);
}

/* ---- sheets ---- */

TEST_AROUND(tiles_of_a_sheet_have_the_pixels_of_their_views, open_arena, close_arena)
{
    static const char *const sheets[] = {"\"threeView\"", "\"balanced\"", "{\"columns\": 3}"};
    for (int k = 0; k < 3; k++) {
        char text[2048], view[400];
        struct zr_views views;
        snprintf(text, sizeof text, "{" GEOMETRY ", \"window\": {\"width\": 300, \"height\": 220}, \"sheet\": %s%s}",
                 sheets[k],
                 k == 2 ? ", \"views\": [\"front\", \"top\", \"isometric\", {\"view\": {\"direction\": [1,1,1]}}]"
                        : "");
        const struct zr_files files = draw(text, &views);
        uint32_t width, height, ink = 0;
        assert_int_equal(files.count, 1);
        assert_string_equal(files.entries[0].name, "color.png");
        uint32_t *sheet = png_memory_read(files.entries[0].bytes, files.entries[0].size, PNG_AS_RGBA, &width, &height);
        assert_non_null(sheet);
        assert_true(width == 300 && height == 220);
        float ymag = 0.0f;
        for (uint32_t i = 0; i < views.set->count; i++) {
            const struct zr_view *given = &scene_of_view(&views, i)->views[0];
            const struct zr_box box = zr_sheet_box(&views.layout, i);
            static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
            assert_true(ymag == 0.0f || ymag == given->ymag); /* one scale */
            ymag = given->ymag;
            if (given->pose == ZR_POSE_PRESET)
                snprintf(view, sizeof view, "\"preset\": \"%s\"", presets[given->preset]);
            else if (given->pose == ZR_POSE_DIRECTION)
                snprintf(view, sizeof view, "\"direction\": [1,1,1]");
            else
                snprintf(view, sizeof view, "\"azimuthDegrees\": %.17g, \"elevationDegrees\": %.17g",
                         given->azimuth_degrees, given->elevation_degrees);
            snprintf(text, sizeof text,
                     "{" GEOMETRY ", \"window\": {\"width\": %d, \"height\": %d}, \"view\": {%s, "
                     "\"orthographic\": {\"xmag\": %.9g, \"ymag\": %.9g}}}",
                     box.width, box.height, view, (double)given->xmag, (double)given->ymag);
            struct zr_files alone;
            const struct zr_frame *frame = draw_alone(text, &alone);
            for (int32_t y = 0; y < box.height; y++)
                assert_memory_equal(&sheet[(box.y + y) * 300 + box.x], frame->color + (size_t)y * (size_t)box.width * 4,
                                    (size_t)box.width * 4);
            for (int32_t y = box.y + box.height; y < box.y + box.height + views.layout.caption; y++)
                for (int32_t x = box.x; x < box.x + box.width; x++)
                    ink += sheet[y * 300 + x] != UINT32_MAX;
        }
        assert_in_range(ink, 100, 4000); /* captions */
        free(sheet);
    }
}

TEST_AROUND(views_that_a_sheet_names_have_no_lens, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files plain =
        draw("{" GEOMETRY ", \"sheet\": \"threeView\", \"view\": {\"eye\": [1,1,4]}}", &views);
    const struct zr_files lens = draw(
        "{" GEOMETRY ", \"sheet\": \"threeView\", \"view\": {\"eye\": [1,1,4], \"distortion\": [0.1,0,0,0]}}", &views);
    assert_int_equal(plain.entries[0].size, lens.entries[0].size);
    assert_memory_equal(plain.entries[0].bytes, lens.entries[0].bytes, plain.entries[0].size);
}

TEST_AROUND(files_beside_the_info_of_a_sheet_stay_in_order, open_arena, close_arena)
{
#define BESIDE SCENE ", \"turntable\": {\"frames\": 2}, \"sheet\": \"views\", \"outputs\": [{\"channel\": \"color\"}, "
    struct zr_views views;
    const struct zr_files with = draw(BESIDE "{\"channel\": \"info\"}, {\"channel\": \"depth\"}]}", &views),
                          without = draw(BESIDE "{\"channel\": \"depth\"}]}", &views);
    assert_int_equal(with.count, without.count + 1);
    assert_same(file_of(&with, "depth.npy"), file_of(&without, "depth.npy"), "depth.npy");
#undef BESIDE
}

TEST_AROUND(info_of_a_sheet_has_all_boxes, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_files files =
        draw(SCENE ", \"sheet\": {\"layout\": \"threeView\", \"angle\": \"first\", \"captions\": "
                   "false}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"info\"}]}",
             &views);
    const struct zr_zip_entry *info = file_of(&files, "info.json");
    char *text = zr_arena_alloc(&arena, info->size + 1, 1);
    memcpy(text, info->bytes, info->size);
    text[info->size] = '\0';
    const char *at = strstr(text, ",\"sheet\":[");
    assert_non_null(at);
    static const char *const parts[] = {
        "{\"name\":\"right\",\"box\":[4,4,38,28]", "{\"name\":\"front\",\"box\":[42,4,76,28]",
        "{\"name\":\"isometric\",\"box\":[4,32,38,56]", "{\"name\":\"top\",\"box\":[42,32,76,56]", "}]}\n"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        at = strstr(at, parts[i]);
        if (!at) fail_msg("%s is not in %s", parts[i], text);
    }
}

RUN_TESTS(NULL, NULL)
