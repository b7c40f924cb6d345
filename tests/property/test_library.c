/* core/api: the same bytes as the core gives, for every scene of tests/scenes and clients/examples, drawn at once,
 * from a kept scene, and from a kept scene with changes. */
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "core.h"
#include "render_request.h"
#include "support/files.h"
#include "support/renderer.h"
#include "support/sanitized.h"
#include "support/tests.h"
#include "views/views.h"

static struct zr_arena arena;

struct answer {
    zraster_status status;
    char *bytes; /* of the answer, or the text of the error */
    size_t size;
};

static struct answer answer_of(zraster_status status, const void *bytes, size_t size)
{
    struct answer answer = {status, malloc(size + 1), size};
    assert_non_null(answer.bytes);
    memcpy(answer.bytes, bytes, size);
    return answer;
}

/* Draws all views. */
static enum zr_status draw_views(struct zr_views *views, struct zr_answer *answer, struct zr_error *error)
{
    struct zr_files files;
    enum zr_status status = zr_views_plan(&(struct zr_run){.arena = &arena, .error = error}, views);
    if (status == ZR_OK) status = zr_views_draw(&(struct zr_run){.arena = &arena, .error = error}, views, &files);
    return status == ZR_OK ? zr_files_answer(&arena, &files, views->scene, answer, error) : status;
}

static enum zr_status draw_one(const struct zr_scene *scene, struct zr_answer *answer, struct zr_error *error)
{
    const struct zr_frame *frame;
    const enum zr_status status = zr_render(&(struct zr_run){.arena = &arena, .error = error}, scene, NULL, &frame);
    return status == ZR_OK ? zr_encode(&(struct zr_run){.arena = &arena, .error = error}, scene, frame, answer)
                           : status;
}

/* Draws by the core alone. */
static struct answer core_answer(const char *text, size_t size)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_UNKNOWN, .bytes = text, .size = size};
    struct zr_views views;
    struct zr_answer answer;
    struct zr_error error = {0};
    zr_arena_reset(&arena, SIZE_MAX);
    enum zr_status status =
        zr_views_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &views);
    if (status == ZR_OK)
        status = views.set ? draw_views(&views, &answer, &error) : draw_one(views.scene, &answer, &error);
    if (status != ZR_OK) return answer_of((zraster_status)status, error.items[0].detail, strlen(error.items[0].detail));
    return answer_of(ZRASTER_OK, answer.bytes, answer.size);
}

/* Ends a drawing: encodes the picture and frees it. */
static struct answer take(zraster_status status, zraster_picture *picture, zraster_error *error)
{
    struct zraster_bytes bytes;
    if (status == ZRASTER_OK) status = zraster_picture_encode(picture, NULL, &bytes, &error);
    const struct answer answer = status == ZRASTER_OK ? answer_of(status, bytes.data, bytes.size)
                                                      : answer_of(status, zraster_error_detail(error, 0),
                                                                  strlen(zraster_error_detail(error, 0)));
    zraster_error_free(error);
    zraster_picture_free(picture);
    return answer;
}

/* Draws by the library and then overwrites the body. */
static struct answer library_answer(const char *text, size_t size)
{
    struct answer body = answer_of(ZRASTER_OK, text, size);
    const struct zraster_request request = request_of_bytes(body.bytes, size);
    zraster_picture *picture;
    zraster_error *error;
    const zraster_status status = zraster_draw(renderer, &request, &picture, &error);
    memset(body.bytes, 'x', size);
    free(body.bytes);
    return take(status, picture, error);
}

static zraster_scene *keep(const char *text, size_t size)
{
    struct answer body = answer_of(ZRASTER_OK, text, size);
    const struct zraster_request request = request_of_bytes(body.bytes, size);
    zraster_scene *scene;
    zraster_error *error;
    if (zraster_scene_read(renderer, &request, &scene, &error) != ZRASTER_OK) fail_msg("%s", zraster_error_text(error));
    memset(body.bytes, 'x', size);
    free(body.bytes);
    return scene;
}

static struct answer changed_answer(const zraster_scene *scene, const char *change)
{
    const struct zraster_request request = request_of_bytes(change, change ? strlen(change) : 0);
    zraster_picture *picture;
    zraster_error *error;
    const zraster_status status = zraster_scene_draw(scene, change ? &request : NULL, &picture, &error);
    return take(status, picture, error);
}

static void assert_same(struct answer wanted, struct answer got, const char *name, const char *by)
{
    if (wanted.status != got.status || wanted.size != got.size || memcmp(wanted.bytes, got.bytes, got.size) != 0)
        fail_msg("%s by %s: %d %zu bytes, wanted %d %zu bytes: %.*s", name, by, got.status, got.size, wanted.status,
                 wanted.size, got.status ? (int)got.size : 0, got.bytes);
    free(wanted.bytes);
    free(got.bytes);
}

/* ---- changes ---- */

static const char *const changes[] = {
    "{}",
    "{\"window\": {\"width\": 61, \"height\": 43}}",
    ("{\"view\": {\"azimuthDegrees\": 30, \"elevationDegrees\": 20}, \"outputs\": [{\"channel\": \"color\"}, "
     "{\"channel\": \"depth\"}, {\"channel\": \"info\"}]}"),
    "{\"look\": \"studio\", \"samples\": 4}",
    "{\"look\": \"technical\", \"up\": \"z\", \"background\": \"#123456\"}",
    "{\"lights\": [{\"type\": \"directional\", \"direction\": [1, -2, -3]}], \"ambient\": [0.5, 0.5, 0.5]}",
    "{\"materials\": [], \"shading\": \"unlit\"}",
    "{\"fog\": {\"near\": 1, \"far\": 9, \"color\": \"red\"}}",
    "{\"edges\": true, \"occlusion\": false, \"exposure\": 0.5, \"creaseDegrees\": 40}",
    "{\"colorBar\": true, \"lineWidth\": 3, \"algorithm\": \"scanline\"}",
};

/* Returns the text of one scene with the keys of both, without its animation: a change has one view. */
static char *merge(const char *scene, const char *change)
{
    cJSON *all = cJSON_Parse(scene), *keys = cJSON_Parse(change);
    cJSON_DeleteItemFromObjectCaseSensitive(all, "animate");
    while (keys->child) {
        cJSON *key = cJSON_DetachItemViaPointer(keys, keys->child);
        char name[64];
        snprintf(name, sizeof name, "%s", key->string);
        cJSON_DeleteItemFromObjectCaseSensitive(all, name);
        cJSON_AddItemToObject(all, name, key);
    }
    char *text = cJSON_PrintUnformatted(all);
    cJSON_Delete(all);
    cJSON_Delete(keys);
    return text;
}

/* Gives the node of this name a matrix in place of its transform. */
static char *merge_pose(const char *scene, const char *node, const char *matrix)
{
    cJSON *all = cJSON_Parse(scene), *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(all, "nodes"))
    {
        const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(item, "name"));
        if (!name || strcmp(name, node) != 0) continue;
        static const char *const keys[] = {"matrix", "translation", "rotation", "scale"};
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
            cJSON_DeleteItemFromObjectCaseSensitive(item, keys[i]);
        cJSON_AddItemToObject(item, "matrix", cJSON_Parse(matrix));
    }
    char *text = cJSON_PrintUnformatted(all);
    cJSON_Delete(all);
    return text;
}

/* ---- all scenes ---- */

/* Each change is made to one scene of three. Under a sanitizer, this draws one scene of three; test_scene_files draws
 * all. */
static void check_file(const char *path, void *context)
{
    size_t size, number = (*(size_t *)context)++;
    if (IS_SANITIZED && number % 3 > 0) return;
    char *text = file_read(path, &size);
    assert_non_null(text);
    assert_same(core_answer(text, size), library_answer(text, size), path, "zraster_draw");
    zraster_scene *scene = keep(text, size);
    assert_same(core_answer(text, size), changed_answer(scene, NULL), path, "a kept scene");
    for (size_t i = (number + number / 3) % 3; i < sizeof changes / sizeof *changes; i += 3) {
        char *merged = merge(text, changes[i]);
        assert_same(core_answer(merged, strlen(merged)), changed_answer(scene, changes[i]), path, changes[i]);
        free(merged);
    }
    zraster_scene_free(scene);
    free(text);
}

TEST(all_scenes_are_drawn_as_by_the_core)
{
    size_t number = 0;
    assert_true(files_each("tests/scenes", ".json", check_file, &number) > 30);
    assert_true(files_each("clients/examples", ".json", check_file, &number) > 0);
}

/* ---- poses ---- */

static const char hinge[] =
    "{\"window\": {\"width\": 80, \"height\": 60}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"info\"}], "
    "\"nodes\": [{\"name\": \"door\", \"mesh\": 0, \"translation\": [1, 0, 0], \"children\": [1]}, "
    "{\"name\": \"knob\", \"mesh\": \"k\", \"scale\": [0.5, 0.5, 0.5]}], "
    "\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[7,7,7]], \"faces\": [[0,1,2,3]]}, "
    "{\"name\": \"k\", \"positions\": [[0,0,1],[1,0,1],[0,1,1]], \"faces\": [[0,1,2]]}]}";

TEST(poses_replace_the_matrices_of_nodes)
{
    static const char matrix[] = "[[0,-1,0,3],[1,0,0,0],[0,0,1,0.5],[0,0,0,1]]";
    static const char *const nodes[] = {"door", "knob"};
    zraster_scene *scene = keep(hinge, strlen(hinge));
    const struct answer plain = core_answer(hinge, strlen(hinge));
    for (int i = 0; i < 2; i++) {
        char change[200], *merged = merge_pose(hinge, nodes[i], matrix);
        snprintf(change, sizeof change, "{\"poses\": {\"%s\": %s}}", nodes[i], matrix);
        const struct answer posed = changed_answer(scene, change);
        assert_true(posed.size != plain.size || memcmp(posed.bytes, plain.bytes, plain.size) != 0);
        assert_same(core_answer(merged, strlen(merged)), posed, "hinge", change);
        free(merged);
    }
    assert_same(plain, changed_answer(scene, NULL), "hinge", "no change, after changes");
    zraster_scene_free(scene);
}

TEST(faults_of_a_change_have_their_place)
{
    static const struct {
        const char *change, *pointer, *detail;
        zraster_status status;
    } cases[] = {
        {"{\"poses\": {\"dor\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}}", "/poses/dor",
         "no node has the name 'dor'", ZRASTER_BAD_SCENE},
        {"{\"poses\": {\"door\": [1]}}", "/poses/door", "expected 16 numbers", ZRASTER_BAD_SCENE},
        {"{\"poses\": 3}", "/poses", "expected an object", ZRASTER_BAD_SCENE},
        {"{\"meshes\": []}", "/meshes", "keeps the geometry", ZRASTER_BAD_SCENE},
        {"{\"view\": {\"eye\": 1}}", "/view/eye", "expected a list", ZRASTER_BAD_SCENE},
        {"{\"veiw\": {}}", "/veiw", "unknown key", ZRASTER_BAD_SCENE},
        {"{\"a\\\"b\": {}}", "/a\"b", "unknown key", ZRASTER_BAD_SCENE},
        {"{\"up\": \"y\", \"up\": \"z\"}", "/up", "", ZRASTER_BAD_SCENE},
        {"[1]", "", "expected an object", ZRASTER_BAD_SCENE},
        {"{\"view\": }", "", "line 1, column 10", ZRASTER_BAD_SYNTAX},
        {"{\"nodes\": [{\"mesh\": 9}]}", "/nodes/0/mesh", "index 9 of 2", ZRASTER_BAD_SCENE},
    };
    zraster_scene *scene = keep(hinge, strlen(hinge));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zraster_request request = request_of(cases[i].change);
        zraster_picture *picture;
        zraster_error *error;
        if (zraster_scene_draw(scene, &request, &picture, &error) != cases[i].status)
            fail_msg("%s: %s", cases[i].change, zraster_error_text(error));
        if (strcmp(zraster_error_pointer(error, 0), cases[i].pointer) != 0 ||
            !strstr(zraster_error_detail(error, 0), cases[i].detail))
            fail_msg("%s: %s", cases[i].change, zraster_error_text(error));
        assert_null(picture);
        zraster_error_free(error);
    }
    zraster_scene_free(scene);
}

/* ---- bare meshes ---- */

static struct answer draw_with(const char *body, const char *query)
{
    struct zraster_request request = request_of(body);
    zraster_picture *picture;
    zraster_error *error;
    request.query = query;
    const zraster_status status = zraster_draw(renderer, &request, &picture, &error);
    return take(status, picture, error);
}

TEST(parameters_of_a_change_replace_those_of_a_bare_mesh)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n";
    struct zraster_request request = request_of(obj), change = request_of_bytes(NULL, 0);
    zraster_scene *scene;
    zraster_picture *picture;
    zraster_error *error;
    request.query = "width=70&height=50&look=technical&azimuth=10";
    change.query = "look=clay&azimuth=200";
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    for (int i = 0; i < 2; i++) {
        const zraster_status status = zraster_scene_draw(scene, &change, &picture, &error);
        assert_same(draw_with(obj, "width=70&height=50&look=clay&azimuth=200"), take(status, picture, error), "obj",
                    change.query);
    }
    assert_same(draw_with(obj, request.query), changed_answer(scene, NULL), "obj", "no change");
    assert_same(draw_with(obj, "width=70&height=50&look=technical&azimuth=10&background=red&samples=1"),
                changed_answer(scene, "{\"background\": \"red\", \"samples\": 1}"), "obj", "keys");
    assert_same(draw_with(obj, "width=71&height=50&look=technical&preset=top&projection=orthographic&padding=0.1"),
                changed_answer(scene, "{\"window\": {\"width\": 71}, \"view\": {\"preset\": \"top\", \"orthographic\": "
                                      "{}, \"fit\": {\"padding\": 0.1}}}"),
                "obj", "view");
    const struct answer refused = changed_answer(scene, "{\"poses\": {}}");
    assert_int_equal(refused.status, ZRASTER_BAD_SCENE);
    free(refused.bytes);
    zraster_scene_free(scene);
}

static int open_all(void **state)
{
    zr_arena_init(&arena, (size_t)1 << 30);
    return open_renderer(state);
}

static int close_all(void **state)
{
    zr_arena_free(&arena);
    return close_renderer(state);
}

RUN_TESTS(open_all, close_all)
