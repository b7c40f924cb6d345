/* Keys of parts: each picture equals the picture of a scene that is written out without the key. */
#include <stdio.h>

#include "support/renderer.h"
#include "support/tests.h"

/* Three bodies side by side, named a, b and a; the third has colours. */
#define BODY(x, name, more)                                                                                            \
    "{\"name\": \"" name "\"" more ", \"positions\": [[" #x ",0,0],[" #x ",1,0],[" #x ",0,1],[4,0.5,0.5]], "           \
    "\"faces\": [[0,2,1],[0,1,3],[1,2,3],[2,0,3]]}"
#define COLORED ", \"colors\": [[1,0,0],[0,1,0],[0,0,1],[1,1,0]]"
#define BODIES  "\"meshes\": [" BODY(0, "a", "") ", " BODY(6, "b", "") ", " BODY(12, "a", COLORED) "]"
#define VIEW    "\"window\": {\"width\": 90, \"height\": 60}, "
#define OUTPUTS                                                                                                        \
    "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": \"faceId\"}, {\"channel\": "      \
    "\"instanceId\"}, {\"channel\": \"info\"}], "
#define SCENE(keys) "{" VIEW OUTPUTS keys BODIES "}"

static void assert_same_channel(const char *what, zraster_picture *a, zraster_picture *b, const char *channel)
{
    if (!is_same_bytes(bytes_of(a, channel), bytes_of(b, channel))) fail_msg("%s: %s differs", what, channel);
}

/* Draws both scenes and compares colours and depths. Compares ids if with_ids. */
static void assert_same(const char *text, const char *wanted, bool with_ids)
{
    zraster_picture *a = picture_of(renderer, text), *b = picture_of(renderer, wanted);
    assert_same_channel(text, a, b, "color");
    assert_same_channel(text, a, b, "depth");
    if (with_ids) assert_same_channel(text, a, b, "faceId");
    if (with_ids) assert_same_channel(text, a, b, "instanceId");
    zraster_picture_free(a);
    zraster_picture_free(b);
}

static void assert_other(const char *text, const char *other)
{
    zraster_picture *a = picture_of(renderer, text), *b = picture_of(renderer, other);
    if (is_same_bytes(bytes_of(a, "color"), bytes_of(b, "color"))) fail_msg("%s: both pictures are equal", text);
    zraster_picture_free(a);
    zraster_picture_free(b);
}

/* Copies the info of a picture as text. */
static void info_of(const char *text, char *out, size_t room)
{
    zraster_picture *picture = picture_of(renderer, text);
    const struct zraster_bytes info = bytes_of(picture, "info");
    assert_true(info.size < room);
    memcpy(out, info.data, info.size);
    out[info.size] = '\0';
    zraster_picture_free(picture);
}

/* Returns the number of visible pixels that the info has for a part. */
static int pixels_of(const char *info, int id)
{
    char key[32];
    snprintf(key, sizeof key, "\"id\":%d,", id);
    const char *parts = strstr(info, "\"parts\":"), *part = parts ? strstr(parts, key) : NULL;
    const char *pixels = part ? strstr(part, "\"pixels\":") : NULL;
    if (!pixels) fail_msg("no part %d in %s", id, info);
    return atoi(pixels + strlen("\"pixels\":"));
}

TEST(hidden_parts_are_not_drawn_and_fitted_views_leave_them_out)
{
    static const char alone[] = "{" VIEW OUTPUTS "\"meshes\": [" BODY(0, "a", "") "]}";
    static const char ends[] = "{" VIEW OUTPUTS "\"meshes\": [" BODY(0, "a", "") ", " BODY(12, "a", COLORED) "]}";
    assert_same(SCENE("\"hide\": [\"b\", \"a.2\"], "), alone, true);
    assert_same(SCENE("\"isolate\": \"a\", "), alone, true);
    assert_same(SCENE("\"hide\": \"b\", "), ends, false);
    assert_same(SCENE("\"look\": \"studio\", \"hide\": \"b\", "),
                "{" VIEW OUTPUTS
                "\"look\": \"studio\", \"meshes\": [" BODY(0, "a", "") ", " BODY(12, "a", COLORED) "]}",
                false);
    assert_same(SCENE("\"hide\": [], \"isolate\": [], \"ghost\": [], \"highlight\": [], \"explode\": 0, "), SCENE(""),
                true);
}

TEST(names_patterns_and_ids_choose_parts)
{
    static const struct {
        const char *key;
        int shown; /* sum of 1, 2 and 4 for the parts */
    } cases[] = {{"\"hide\": \"a\", ", 6},           {"\"hide\": \"a*\", ", 2},      {"\"hide\": \"?\", ", 4},
                 {"\"hide\": \"a.?\", ", 3},         {"\"hide\": \"*2\", ", 3},      {"\"hide\": 2, ", 5},
                 {"\"hide\": \"3\", ", 3},           {"\"hide\": [1, \"b\"], ", 4},  {"\"isolate\": \"a*\", ", 5},
                 {"\"isolate\": [2, \"*.*\"], ", 6}, {"\"isolate\": \"*a*2*\", ", 4}};
    char text[4000], info[8000];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "{" VIEW OUTPUTS "%s" BODIES "}", cases[i].key);
        info_of(text, info, sizeof info);
        int shown = 0;
        for (int id = 1; id <= 3; id++)
            if (pixels_of(info, id) > 0) shown += 1 << (id - 1);
        if (shown != cases[i].shown) fail_msg("%s shows %d, not %d", cases[i].key, shown, cases[i].shown);
    }
}

TEST(highlights_have_a_colour_and_ghosts_are_blended)
{
#define MATERIALS                                                                                                      \
    "\"materials\": [{\"name\": \"m\", \"baseColorFactor\": \"tomato\"}, {\"name\": \"g\", \"alphaMode\": \"BLEND\", " \
    "\"baseColorFactor\": [0.7, 0.7, 0.7, 0.16]}], "
    static const char red[] =
        "{" VIEW OUTPUTS MATERIALS
        "\"meshes\": [" BODY(0, "a", ", \"material\": \"m\", \"shading\": \"flat\"") ", " BODY(6, "b", "") ", " BODY(
            12, "a", ", \"material\": \"m\", \"shading\": \"gouraud\"") "]}";
    static const char ghost[] =
        "{" VIEW OUTPUTS MATERIALS
        "\"meshes\": [" BODY(0, "a", "") ", " BODY(6, "b", ", \"material\": \"g\"") ", " BODY(12, "a", COLORED) "]}";
    assert_same(SCENE("\"highlight\": {\"parts\": \"a*\", \"color\": \"tomato\"}, "), red, true);
    assert_same(SCENE("\"highlight\": [{\"parts\": \"*\"}, {\"parts\": \"b\", \"color\": \"red\"}, {\"parts\": [1, 3], "
                      "\"color\": \"tomato\"}], \"ghost\": \"b\", "),
                SCENE("\"highlight\": [{\"parts\": \"a*\", \"color\": \"tomato\"}, {\"parts\": \"b\", \"color\": "
                      "\"#ff0000\"}], \"ghost\": 2, "),
                true);
    assert_same(SCENE("\"ghost\": \"b\", "), ghost, true);
    assert_same(SCENE("\"ghost\": \"*\", \"highlight\": \"b\", "), SCENE("\"ghost\": [1, 3], \"highlight\": \"b\", "),
                true);
    assert_other(SCENE("\"ghost\": [\"*\", \"b\"], \"highlight\": \"b\", "),
                 SCENE("\"ghost\": \"*\", \"highlight\": \"b\", "));
    assert_other(SCENE("\"ghost\": \"b\", "), SCENE(""));
}

TEST(an_exploded_scene_equals_one_with_moved_nodes)
{
    /* The boxes have their middles at x = 2, 5 and 8 and y = z = 0.5. */
#define NODES(x0, x1, x2)                                                                                              \
    "{" VIEW OUTPUTS "\"nodes\": [{\"mesh\": 0, \"translation\": [" #x0 ",0,0]}, {\"mesh\": 1, \"translation\": [" #x1 \
    ",0,0]}, {\"mesh\": 2, \"translation\": [" #x2 ",0,0]}], " BODIES "}"
    assert_same(SCENE("\"explode\": 1, "), NODES(-4, -1, 2), true);
    assert_same(SCENE("\"explode\": {\"factor\": 2, \"axis\": \"x\"}, "), NODES(-8, -2, 4), true);
    assert_same(SCENE("\"explode\": {\"factor\": 1, \"axis\": \"y\"}, "), SCENE(""), true);
}

TEST(instances_of_one_mesh_have_styles_of_their_own)
{
#define PLACED(keys, first, second, third, meshes)                                                                     \
    "{" VIEW OUTPUTS keys "\"nodes\": [{\"name\": \"p\", \"mesh\": " first "}, {\"name\": \"q\", \"mesh\": " second    \
    ", \"translation\": [3, 0, 0]}, {\"name\": \"r\", \"mesh\": " third                                                \
    ", \"translation\": [0, 3, 0]}], \"meshes\": [" BODY(0, "m", "") meshes "]}"
#define RED  ", \"material\": \"red\""
#define REDS "\"materials\": [{\"name\": \"red\", \"baseColorFactor\": \"red\"}], "
    assert_same(PLACED("\"highlight\": {\"parts\": \"q\", \"color\": \"red\"}, ", "0", "0", "0", ""),
                PLACED(REDS, "0", "1", "0", ", " BODY(0, "m", RED)), true);
    assert_same(PLACED("\"highlight\": {\"parts\": [\"p\", \"r\"], \"color\": \"red\"}, ", "0", "0", "0", ""),
                PLACED(REDS, "1", "0", "1", ", " BODY(0, "m", RED)), true);
    assert_same(PLACED("\"hide\": \"q\", \"highlight\": {\"parts\": \"*\", \"color\": \"red\"}, ", "0", "0", "0", ""),
                "{" VIEW OUTPUTS REDS "\"nodes\": [{\"mesh\": 0}, {\"mesh\": 0, \"translation\": [0, 3, 0]}], "
                "\"meshes\": [" BODY(0, "m", RED) "]}",
                false);
}

TEST(lines_and_points_are_hidden_with_their_part)
{
#define SKETCH                                                                                                         \
    "{\"name\": \"s\", \"positions\": [[9,9,9],[9,0,0],[20,5,0]], \"lines\": [[0,1],[1,2]], \"points\": [0, 2], "      \
    "\"pointSize\": 5}"
    static const char *const keys[] = {"\"hide\": \"s\", ", "\"isolate\": \"a\", "};
    static const char alone[] = "{" VIEW OUTPUTS "\"meshes\": [" BODY(0, "a", "") "]}";
    for (int i = 0; i < 2; i++) {
        char text[4000];
        snprintf(text, sizeof text, "{" VIEW OUTPUTS "%s\"meshes\": [" BODY(0, "a", "") ", " SKETCH "]}", keys[i]);
        assert_same(text, alone, true);
    }
    assert_other("{" VIEW OUTPUTS "\"highlight\": \"s\", \"meshes\": [" SKETCH "]}",
                 "{" VIEW OUTPUTS "\"meshes\": [" SKETCH "]}");
}

/* ---- named parts of one mesh ---- */

#define OBJ(far, gap)                                                                                                  \
    "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\no two\nv " far " 0 0\nv " far      \
    " 1 0\nv " far " 0 1\nv " gap " 0.5 0.5\nf 5 6 7\nf 5 8 6\nf 6 8 7\nf 7 8 5\n"

static zraster_picture *picture_of_obj(const char *obj, const char *query)
{
    char all[400];
    struct zraster_request request = request_of(obj);
    snprintf(all, sizeof all, "width=90&height=60&channel=color,depth,faceId,info&%s", query);
    request.type = "obj";
    request.query = all;
    return picture_of_request(renderer, &request, query);
}

static void assert_same_obj(const char *obj, const char *query, const char *wanted, const char *wanted_query,
                            bool with_ids)
{
    zraster_picture *a = picture_of_obj(obj, query), *b = picture_of_obj(wanted, wanted_query);
    assert_same_channel(query, a, b, "color");
    assert_same_channel(query, a, b, "depth");
    if (with_ids) assert_same_channel(query, a, b, "faceId");
    zraster_picture_free(a);
    zraster_picture_free(b);
}

TEST(groups_of_a_file_are_parts)
{
    static const char one[] = "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const char *const both = OBJ("4", "2");
    for (int i = 0; i < 2; i++) {
        const char *const look = i == 0 ? "look=studio" : "look=textbook";
        char query[100];
        snprintf(query, sizeof query, "%s&hide=two", look);
        assert_same_obj(both, query, one, look, true);
        snprintf(query, sizeof query, "%s&isolate=1", look);
        assert_same_obj(both, query, one, look, true);
    }
    /* The parts have their middles at x = 0.5 and 3; the middle of all is at 2. */
    assert_same_obj(both, "explode=2&explodeAxis=x",
                    "o one\nv -3 0 0\nv -2 0 0\nv -3 1 0\nv -3 0 1\nf 1 3 2\nf 1 2 4\n"
                    "f 2 3 4\nf 3 1 4\no two\nv 6 0 0\nv 6 1 0\nv 6 0 1\nv 4 0.5 0.5\nf 5 6 7\nf 5 8 6\nf 6 8 7\n"
                    "f 7 8 5\n",
                    "", true);
    assert_same_obj(both, "highlight=*&highlightColor=tomato", both, "color=tomato", true);
}

/* Draws a scene with the file OBJ("4", "2") as its mesh. `node`: members of the node that places it. */
static zraster_status draw_placed(const char *keys, const char *node, zraster_picture **picture, zraster_error **error)
{
    static const char obj[] = OBJ("4", "2");
    const struct zraster_part part = {
        .name = "f.obj", .array = {.data = obj, .type = ZRASTER_BYTES, .ndim = 1, .shape = {sizeof obj - 1}}};
    char text[600];
    snprintf(text, sizeof text,
             "{" VIEW OUTPUTS "%s\"nodes\": [{\"mesh\": 0, %s}], \"meshes\": [{\"asset\": \"f.obj\"}]}", keys, node);
    struct zraster_request request = request_of(text);
    request.parts = &part;
    request.part_count = 1;
    return zraster_draw(renderer, &request, picture, error);
}

TEST(parts_of_a_placed_file_move_in_world_space)
{
    /* A rotation by 90 degrees around y and a scale of 2: x of the file is -z of the world. */
#define TURNED "\"matrix\": [0,0,-2,0, 0,2,0,0, 2,0,0,0, 0,0,0,1]"
    zraster_picture *a, *b;
    char info[8000];
    assert_int_equal(draw_placed("\"explode\": {\"factor\": 1, \"axis\": \"z\"}, ", TURNED, &a, NULL), ZRASTER_OK);
    assert_int_equal(draw_placed("", TURNED, &b, NULL), ZRASTER_OK);
    const struct zraster_bytes bytes = bytes_of(a, "info");
    snprintf(info, sizeof info, "%.*s", (int)bytes.size, (const char *)bytes.data);
    /* The parts have z from -2 to 0 and from -8 to -4. Their middles, -1 and -6, move by 3 and -2; the middle is -4. */
    assert_non_null(strstr(info, "\"name\":\"one\",\"id\":1,\"box\":{\"min\":[0,0,1],\"max\":[2,2,3]}"));
    assert_non_null(
        strstr(info, "\"name\":\"two\",\"id\":2,\"instanceId\":1,\"box\":{\"min\":[0,0,-10],\"max\":[2,2,-6]}"));
    assert_false(is_same_bytes(bytes_of(a, "color"), bytes_of(b, "color")));
    zraster_picture_free(a);
    zraster_picture_free(b);
}

TEST(parts_of_a_flattened_file_cannot_move)
{
    zraster_picture *picture = NULL;
    zraster_error *error;
    assert_int_equal(draw_placed("\"explode\": 1, ", "\"scale\": [1, 0, 1]", &picture, &error), ZRASTER_BAD_SCENE);
    assert_string_equal(zraster_error_pointer(error, 0), "/explode");
    assert_non_null(strstr(zraster_error_detail(error, 0), "the matrix of instance 1 flattens its mesh"));
    zraster_error_free(error);
}

TEST(an_explosion_that_moves_nothing_causes_a_warning)
{
    char info[8000];
    info_of("{" VIEW OUTPUTS "\"explode\": {\"factor\": 2, \"axis\": \"y\"}, " BODIES "}", info, sizeof info);
    assert_non_null(strstr(info, "explode moves nothing: the middles of all parts are the same along y"));
}

/* ---- stable colours ---- */

static void color_of(const char *info, int id, char color[8])
{
    char key[32];
    snprintf(key, sizeof key, "\"id\":%d,", id);
    const char *part = strstr(strstr(info, "\"parts\":"), key);
    snprintf(color, 8, "%.7s", strstr(part, "\"color\":\"") + strlen("\"color\":\""));
}

TEST(the_colour_of_a_part_depends_on_its_name_only)
{
    char info[8000], of[3][8], alone[8];
    info_of(SCENE("\"colors\": \"parts\", "), info, sizeof info);
    for (int i = 0; i < 3; i++)
        color_of(info, i + 1, of[i]);
    assert_string_not_equal(of[0], of[1]);
    assert_string_not_equal(of[0], of[2]);
    assert_string_not_equal(of[1], of[2]);
    info_of("{" VIEW OUTPUTS "\"colors\": \"parts\", \"meshes\": [" BODY(1, "b", COLORED) "]}", info, sizeof info);
    color_of(info, 1, alone);
    assert_string_equal(alone, of[1]);
    assert_string_equal(alone, "#e8a673"); /* must never change */
}

/* ---- kept scenes ---- */

TEST(a_changed_scene_equals_one_that_is_read_with_the_keys)
{
    static const char *const keys[] = {"\"hide\": \"b\"", "\"explode\": 1.5", "\"colors\": \"parts\", \"ghost\": 1",
                                       "\"isolate\": \"a*\", \"highlight\": \"a\"", "\"hide\": []"};
    const struct zraster_request request = request_of(SCENE("\"hide\": \"a\", "));
    zraster_scene *scene;
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        char change[200], text[4000];
        zraster_picture *a, *b;
        snprintf(change, sizeof change, "{%s}", keys[i]);
        snprintf(text, sizeof text, "{" VIEW OUTPUTS "%s%s, " BODIES "}",
                 strncmp(keys[i], "\"hide\"", 6) == 0 ? "" : "\"hide\": \"a\", ", keys[i]);
        const struct zraster_request changed = request_of(change);
        assert_int_equal(zraster_scene_draw(scene, &changed, &a, NULL), ZRASTER_OK);
        b = picture_of(renderer, text);
        assert_same_channel(keys[i], a, b, "color");
        assert_same_channel(keys[i], a, b, "depth");
        assert_same_channel(keys[i], a, b, "faceId");
        zraster_picture_free(a);
        zraster_picture_free(b);
    }
    zraster_scene_free(scene);
}

RUN_TESTS(open_renderer, close_renderer)
