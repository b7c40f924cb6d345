/* core/views: each view of a request equals the view drawn alone, byte for byte; sheets, stacks and animations hold
 * the same pixels; wrong views are refused before any is drawn. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "output/npy.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "support/png.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "views.h"
#include "views/view_scene.h"

TEST_ARENA((size_t)1 << 29)

#define GEOMETRY                                                                                                       \
    "\"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[3,0,0],[0,2,0],[0,0,1]], "                                \
    "\"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}, {\"name\": \"b\", \"positions\": [[1,1,1],[2,1,1],[1,2,2]], "      \
    "\"faces\": [[0,1,2]]}], \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\"}, {\"name\": \"m\", \"mesh\": \"b\"}]"
#define SCENE "{" GEOMETRY ", \"window\": {\"width\": 80, \"height\": 60}"

static struct zr_limits limits;

static struct zr_request request_of(const char *text)
{
    return (struct zr_request){.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
}

static enum zr_status read_views(struct zr_team *team, struct zr_request request, struct zr_views *views,
                                 struct zr_error *error)
{
    limits = zr_limits_default();
    *error = (struct zr_error){0};
    enum zr_status status = zr_views_read(&arena, team, &request, &limits, views, error);
    if (status == ZR_OK && views->set) status = zr_views_plan(&arena, team, views, NULL, error);
    return status;
}

/* Draws the views of a scene. */
static struct zr_files draw_with(struct zr_team *team, struct zr_request request, struct zr_views *views)
{
    struct zr_error error;
    struct zr_files files = {.count = 0};
    enum zr_status status = read_views(team, request, views, &error);
    assert_true(status != ZR_OK || views->set);
    if (status == ZR_OK) status = zr_views_draw(&arena, team, views, NULL, &files, &error);
    if (status != ZR_OK) fail_msg("%d %s: %s", (int)status, error.items[0].pointer, error.items[0].detail);
    return files;
}

static struct zr_files draw(const char *text, struct zr_views *views)
{
    return draw_with(NULL, request_of(text), views);
}

/* Draws a scene with one view. */
static const struct zr_frame *draw_alone(const char *text, struct zr_files *files)
{
    const struct zr_request request = request_of(text);
    const struct zr_scene *scene;
    const struct zr_frame *frame = NULL;
    struct zr_error error = {0};
    limits = zr_limits_default();
    enum zr_status status = zr_scene_read(&arena, NULL, &request, &limits, &scene, &error);
    if (status == ZR_OK) status = zr_render(&arena, NULL, scene, NULL, NULL, &frame, &error);
    if (status == ZR_OK) status = zr_encode_files(&arena, NULL, scene, frame, NULL, NULL, files, &error);
    if (status != ZR_OK) fail_msg("%s: %s: %s", text, error.items[0].pointer, error.items[0].detail);
    return frame;
}

static const struct zr_zip_entry *file_of(const struct zr_files *files, const char *name)
{
    for (uint32_t i = 0; i < files->count; i++)
        if (strcmp(files->entries[i].name, name) == 0) return &files->entries[i];
    fail_msg("no file %s", name);
    return NULL;
}

static void assert_same(const struct zr_zip_entry *got, const struct zr_zip_entry *want, const char *what)
{
    if (got->size != want->size || memcmp(got->bytes, want->bytes, got->size) != 0)
        fail_msg("%s: other bytes than those of the view alone", what);
}

/* ---- lists ---- */

TEST_AROUND(items_equal_scenes_with_their_keys, open_arena, close_arena)
{
    static const char *const items[] = {
        "\"view\": {\"preset\": \"top\"}",
        "\"view\": {\"eye\": [5,4,3], \"target\": [1,0,0], \"perspective\": {\"yfovDegrees\": 30}}",
        "\"view\": {\"azimuthDegrees\": 30, \"elevationDegrees\": -20}, \"window\": {\"width\": 33, \"height\": 47}",
        "\"look\": \"technical\"",
        "\"look\": \"studio\", \"background\": \"#ff000080\"",
        "\"hide\": \"m\"",
        "\"isolate\": [\"m\"], \"edges\": true",
        "\"ghost\": \"n\", \"highlight\": \"m\"",
        "\"explode\": 1.5",
        "\"sections\": {\"planes\": [{\"axis\": \"x\"}]}"};
    enum { COUNT = sizeof items / sizeof *items };
    static const char outputs[] = "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, "
                                  "{\"channel\": \"info\"}, {\"channel\": \"normals\", \"encoding\": \"png\"}]";
    char text[4096], name[64];
    int used = snprintf(text, sizeof text, SCENE ", %s, \"views\": [", outputs);
    for (int i = 0; i < COUNT; i++)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, "%s{\"name\": \"v%d\", %s}", i ? ", " : "", i, items[i]);
    snprintf(text + used, sizeof text - (size_t)used, "]}");
    struct zr_views views;
    const struct zr_files files = draw(text, &views);
    assert_int_equal(files.count, COUNT * 4);
    for (int i = 0; i < COUNT; i++) {
        struct zr_files alone;
        const char *base = strstr(items[i], "\"window\"") ? "{" GEOMETRY : SCENE;
        snprintf(text, sizeof text, "%s, %s, %s}", base, outputs, items[i]);
        draw_alone(text, &alone);
        for (uint32_t k = 0; k < 4; k++) {
            snprintf(name, sizeof name, "v%d.%s", i, alone.entries[k].name);
            assert_same(file_of(&files, name), &alone.entries[k], name);
        }
    }
}

TEST_AROUND(poses_move_nodes, open_arena, close_arena)
{
#define MATRIX "[0,1,0,0, -1,0,0,0, 0,0,1,0, 0.5,0,0,1]"
    static const char scene[] = SCENE ", \"views\": [{\"poses\": {\"n\": " MATRIX "}}]}";
    static const char moved[] =
        "{\"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[3,0,0],[0,2,0],[0,0,1]], \"faces\": "
        "[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}, {\"name\": \"b\", \"positions\": [[1,1,1],[2,1,1],[1,2,2]], \"faces\": "
        "[[0,1,2]]}], \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\", \"matrix\": " MATRIX "}, {\"mesh\": \"b\"}], "
        "\"window\": {\"width\": 80, \"height\": 60}}";
    struct zr_views views;
    struct zr_files alone;
    const struct zr_files files = draw(scene, &views);
    draw_alone(moved, &alone);
    assert_same(file_of(&files, "0001.color.png"), &alone.entries[0], "poses");
}

/* With both axes that point up, and with a projection of the scene's, which stays. */
TEST_AROUND(presets_equal_views_with_them, open_arena, close_arena)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    static const char *const others[] = {"", ", \"up\": \"z\"", ", \"view\": {\"eye\": [9,9,9]}"};
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
        char text[2048];
        struct zr_views views;
        snprintf(text, sizeof text,
                 SCENE "%s, \"views\": [\"front\", \"back\", \"left\", \"right\", \"top\", \"bottom\", \"isometric\"]}",
                 others[k]);
        const struct zr_files files = draw(text, &views);
        for (int i = 0; i < 7; i++) {
            struct zr_files alone;
            char name[64];
            if (k == 2)
                snprintf(text, sizeof text,
                         SCENE ", \"view\": {\"preset\": \"%s\", \"perspective\": {\"yfovDegrees\": 45}}}", presets[i]);
            else
                snprintf(text, sizeof text, SCENE "%s, \"view\": {\"preset\": \"%s\"}}", others[k], presets[i]);
            snprintf(name, sizeof name, "%s.color.png", presets[i]);
            draw_alone(text, &alone);
            assert_same(file_of(&files, name), &alone.entries[0], name);
        }
    }
}

static const char stl[] =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 0 2 1\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 2 1\nvertex 0 0 4\nendloop\n"
    "endfacet\nendsolid s\n";

static struct zr_request stl_request(void)
{
    return (struct zr_request){
        .format = ZR_FORMAT_STL, .bytes = stl, .size = sizeof stl - 1, .width = "80", .height = "60"};
}

TEST_AROUND(parameters_equal_those_of_one_view, open_arena, close_arena)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    struct zr_request request = stl_request();
    struct zr_views views;
    request.views = "front,back,left,right,top,bottom,isometric";
    const struct zr_files files = draw_with(NULL, request, &views);
    for (int i = 0; i < 7; i++) {
        const struct zr_scene *scene;
        struct zr_error error = {0};
        struct zr_request one = stl_request();
        char name[64];
        const struct zr_frame *frame;
        struct zr_files alone;
        one.preset = presets[i];
        assert_int_equal(zr_scene_read(&arena, NULL, &one, &limits, &scene, &error), ZR_OK);
        assert_int_equal(zr_render(&arena, NULL, scene, NULL, NULL, &frame, &error), ZR_OK);
        assert_int_equal(zr_encode_files(&arena, NULL, scene, frame, NULL, NULL, &alone, &error), ZR_OK);
        snprintf(name, sizeof name, "%s.color.png", presets[i]);
        assert_same(file_of(&files, name), &alone.entries[0], name);
    }
}

/* ---- turntables and orbits ---- */

/* Writes the key "view" of a view's camera. */
static void write_view(const struct zr_view *view, char *text, size_t size)
{
    int used = snprintf(text, size, "\"view\": {\"target\": [%.9g, %.9g, %.9g], \"azimuthDegrees\": %.17g, ",
                        (double)view->target.x, (double)view->target.y, (double)view->target.z, view->azimuth_degrees);
    used += snprintf(text + used, size - (size_t)used, "\"elevationDegrees\": %.17g, ", view->elevation_degrees);
    if (view->projection == ZR_PROJECTION_ORTHOGRAPHIC)
        snprintf(text + used, size - (size_t)used, "\"orthographic\": {\"xmag\": %.9g, \"ymag\": %.9g}}",
                 (double)view->xmag, (double)view->ymag);
    else
        snprintf(text + used, size - (size_t)used, "\"distance\": %.9g, \"perspective\": {\"yfovDegrees\": 40}}",
                 (double)view->distance);
}

static const struct zr_scene *scene_of_view(const struct zr_views *views, uint32_t number)
{
    const struct zr_scene *scene;
    struct zr_error error = {0};
    assert_int_equal(zr_view_scene(views, number, &arena, NULL, NULL, &scene, &error), ZR_OK);
    return scene;
}

static void check_turn(const char *keys, const char *projection, uint32_t count)
{
    char text[2048], view[400], name[64];
    struct zr_views views;
    snprintf(text, sizeof text, SCENE ", \"view\": {%s}, %s}", projection, keys);
    const struct zr_files files = draw(text, &views);
    assert_int_equal(files.count, count);
    for (uint32_t i = 0; i < count; i++) {
        struct zr_files alone;
        write_view(&scene_of_view(&views, i)->views[0], view, sizeof view);
        snprintf(text, sizeof text, SCENE ", %s}", view);
        draw_alone(text, &alone);
        snprintf(name, sizeof name, "%04u.color.png", i + 1);
        assert_same(file_of(&files, name), &alone.entries[0], name);
    }
}

TEST_AROUND(frames_of_a_turn_equal_views_of_their_cameras, open_arena, close_arena)
{
    check_turn("\"turntable\": {\"frames\": 5}", "", 5);
    check_turn("\"turntable\": {\"frames\": 4, \"elevation\": -15}", "\"perspective\": {\"yfovDegrees\": 40}", 4);
    check_turn("\"orbit\": {\"count\": 7}", "\"perspective\": {\"yfovDegrees\": 40}", 7);
    check_turn("\"orbit\": {\"count\": 3, \"distance\": 9}", "\"perspective\": {\"yfovDegrees\": 40}", 3);
    check_turn("\"turntable\": {\"frames\": 3}",
               "\"eye\": [4,5,6], \"target\": [1,1,0], \"perspective\": {\"yfovDegrees\": 40}", 3);
}

/* All frames have one scale, and no frame touches its border, which a wrong scale would make it do. */
TEST_AROUND(frames_have_one_scale_and_show_everything, open_arena, close_arena)
{
    static const char *const kinds[] = {"\"turntable\": {\"frames\": 12}", "\"orbit\": {\"count\": 30}"};
    static const char *const projections[] = {"\"perspective\": {\"yfovDegrees\": 40}", "\"orthographic\": {}"};
    for (int k = 0; k < 4; k++) {
        char text[2048];
        struct zr_views views;
        snprintf(text, sizeof text, SCENE ", \"outputs\": [{\"channel\": \"depth\"}], \"view\": {%s}, %s}",
                 projections[k / 2], kinds[k % 2]);
        const struct zr_files files = draw(text, &views);
        const float *depths = (const float *)((const char *)files.entries[0].bytes + ZR_NPY_HEADER);
        int32_t touches = 0, nearest = 1000;
        for (uint32_t v = 0; v < views.set->count; v++, depths += 80 * 60)
            for (int32_t i = 0; i < 80 * 60; i++) {
                if (isinf(depths[i])) continue;
                const int32_t x = i % 80, y = i / 80, a = x < 79 - x ? x : 79 - x, b = y < 59 - y ? y : 59 - y;
                const int32_t border = a < b ? a : b;
                touches += border == 0;
                if (border < nearest) nearest = border;
            }
        assert_int_equal(touches, 0);
        assert_in_range(nearest, 1, 6); /* padding: a twentieth of 60 or 80 pixels */
    }
}

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

/* ---- threads and memory ---- */

/* A view that does not fit into the share of a thread is drawn alone, so the number of threads decides nothing. */
TEST_AROUND(files_are_the_same_for_all_teams_and_little_memory, open_arena, close_arena)
{
    static const char text[] = "{" GEOMETRY ", \"look\": \"studio\", \"window\": {\"width\": 256, \"height\": 256}, "
                               "\"turntable\": {\"frames\": 7}}";
    struct zr_views views;
    const struct zr_files want = draw(text, &views);
    uint32_t refused = 0, drawn = 0;
    for (size_t memory = 16; memory <= 128; memory += 16) {
        enum zr_status first = ZR_OK;
        for (int threads = 1; threads <= 4; threads++) {
            struct zr_arena small;
            const struct zr_request request = request_of(text);
            struct zr_team *team = zr_team_create(threads);
            struct zr_error error = {0};
            struct zr_files files;
            zr_arena_init(&small, memory << 20);
            enum zr_status status = zr_views_read(&small, team, &request, &limits, &views, &error);
            if (status == ZR_OK) status = zr_views_plan(&small, team, &views, NULL, &error);
            if (status == ZR_OK) status = zr_views_draw(&small, team, &views, NULL, &files, &error);
            if (threads == 1) first = status;
            assert_int_equal(status, first);
            assert_true(status == ZR_OK || (status == ZR_NO_MEMORY && !zr_arena_ok(&small)));
            refused += status != ZR_OK;
            drawn += status == ZR_OK;
            for (uint32_t i = 0; status == ZR_OK && i < want.count; i++)
                assert_same(&files.entries[i], &want.entries[i], "a frame");
            zr_arena_free(&small);
            zr_team_destroy(team);
        }
    }
    assert_true(refused > 0 && drawn > 0);
}

TEST_AROUND(a_raised_cancel_ends_the_drawing, open_arena, close_arena)
{
    struct zr_views views;
    struct zr_error error;
    struct zr_files files;
    const struct zr_cancel cancel = {.raised = true};
    assert_int_equal(read_views(NULL, request_of(SCENE ", \"turntable\": {}}"), &views, &error), ZR_OK);
    assert_int_equal(views.set->count, 36);
    assert_int_equal(zr_views_draw(&arena, NULL, &views, &cancel, &files, &error), ZR_CANCELLED);
}

/* ---- refusals ---- */

TEST_AROUND(wrong_views_are_refused_before_any_is_drawn, open_arena, close_arena)
{
    static const struct {
        const char *keys, *pointer, *detail;
    } cases[] = {
        {"\"views\": [\"front\", \"front\"]", "/views/1", "the name front, as view 0 has"},
        {"\"views\": [{}, {\"name\": \"0001\"}]", "/views/1/name", "the name 0001, as view 0 has"},
        {"\"views\": [\"top\", {\"view\": {\"eye\": [0,0,0], \"target\": [0,0,0]}}]", "/views/1/view/eye",
         "the target"},
        {"\"views\": [{\"view\": {\"eyes\": [0,0,0]}}]", "/views/0/view/eyes", "unknown key"},
        {"\"views\": [{\"look\": \"studyo\"}]", "/views/0/look", "did you mean studio?"},
        {"\"views\": [{\"poses\": {\"zz\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}}]", "/views/0/poses/zz", ""},
        {"\"views\": [{\"window\": {\"width\": 99999}}]", "/views/0/window/width", "1 to 8192"},
        {"\"views\": [{\"hide\": \"zz\"}]", "/views/0/hide", ""},
        {"\"turntable\": {}, \"view\": {\"cameraToWorld\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}", "/turntable",
         "does not turn"},
        {"\"orbit\": {\"count\": 4096}, \"window\": {\"width\": 1024, \"height\": 1024}", "/orbit",
         "4294967296 pixels of images, more than the limit of 536870912"},
        {"\"sheet\": \"threeView\", \"window\": {\"width\": 30, \"height\": 30}", "/sheet", "have no room for 4 views"},
        {"\"sheet\": {}, \"views\": [{\"window\": {\"width\": 9}}]", "/views/0/window", "have one size"},
        {"\"views\": [\"front\", {\"window\": {\"width\": 9, \"height\": 9}}], \"outputs\": [{\"channel\": \"color\", "
         "\"encoding\": \"apng\"}]",
         "/views/1", "another size than view 0"},
        {"\"views\": [\"front\", {\"background\": \"#0000\"}], \"outputs\": [{\"channel\": \"color\", \"encoding\": "
         "\"apng\"}]",
         "/views/1", "or an opaque background"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2048];
        struct zr_views views;
        struct zr_error error;
        struct zr_files files;
        const bool has_window =
            strstr(cases[i].keys, "\"window\": {\"width\": 1024") || strstr(cases[i].keys, "\": 30,");
        snprintf(text, sizeof text, "%s, %s}", has_window ? "{" GEOMETRY : SCENE, cases[i].keys);
        enum zr_status status = read_views(NULL, request_of(text), &views, &error);
        if (status == ZR_OK) status = zr_views_draw(&arena, NULL, &views, NULL, &files, &error);
        if (status != ZR_BAD_SCENE || strcmp(error.items[0].pointer, cases[i].pointer) != 0 ||
            !strstr(error.items[0].detail, cases[i].detail))
            fail_msg("%s: %d at %s: %s", cases[i].keys, (int)status, error.items[0].pointer, error.items[0].detail);
    }
}

RUN_TESTS(NULL, NULL)
