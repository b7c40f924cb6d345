/* Comparisons of models by the library: numbers of the answer, files of other axes and origins, faults. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "api/zraster.h"
#include "support/tests.h"

static zraster *renderer;

static int open_renderer(void **state)
{
    (void)state;
    return zraster_open(NULL, &renderer) != ZRASTER_OK;
}

static int close_renderer(void **state)
{
    (void)state;
    zraster_close(renderer);
    return 0;
}

/* A box, 12 triangles: 0, 2, 4 of the corners' bits are x, y, z. */
static const int triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

enum { TEXT = 1 << 13 };

static const char *obj(char text[TEXT], const double low[3], const double size[3], int faces)
{
    char *at = text;
    for (int i = 0; i < 8; i++)
        at += sprintf(at, "v %.9g %.9g %.9g\n", low[0] + size[0] * (i & 1), low[1] + size[1] * (i >> 1 & 1),
                      low[2] + size[2] * (i >> 2));
    for (int f = 0; f < faces; f++)
        at += sprintf(at, "f %d %d %d\n", triangles[f][0] + 1, triangles[f][1] + 1, triangles[f][2] + 1);
    return text;
}

static const char *stl(char text[TEXT], const double low[3], const double size[3])
{
    char *at = text + sprintf(text, "solid box\n");
    for (int f = 0; f < 12; f++) {
        at += sprintf(at, "facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; k++) {
            const int i = triangles[f][k];
            at += sprintf(at, "vertex %.9g %.9g %.9g\n", low[0] + size[0] * (i & 1), low[1] + size[1] * (i >> 1 & 1),
                          low[2] + size[2] * (i >> 2));
        }
        at += sprintf(at, "endloop\nendfacet\n");
    }
    strcpy(at, "endsolid box\n");
    return text;
}

static zraster_scene *read(const char *text, const char *type)
{
    const struct zraster_request request = {
        .struct_size = sizeof request, .body = text, .body_size = strlen(text), .type = type};
    zraster_scene *scene;
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    return scene;
}

/* Compares. The caller deletes the answer. */
static cJSON *compare(const char *a, const char *a_type, const char *b, const char *b_type, const char *query)
{
    zraster_scene *first = read(a, a_type), *second = read(b, b_type);
    zraster_comparison *comparison;
    assert_int_equal(zraster_compare(first, second, query, NULL, &comparison, NULL), ZRASTER_OK);
    cJSON *answer = cJSON_Parse(zraster_comparison_json(comparison));
    assert_non_null(answer);
    assert_int_equal(zraster_comparison_same(comparison), cJSON_IsTrue(cJSON_GetObjectItem(answer, "same")));
    zraster_comparison_free(comparison);
    zraster_scene_free(first);
    zraster_scene_free(second);
    return answer;
}

/* Returns a number by its path: "volume.iou". */
static double number(const cJSON *answer, const char *path)
{
    char key[64];
    const cJSON *at = answer;
    for (const char *part = path; *part; part += strcspn(part, ".") + (part[strcspn(part, ".")] == '.')) {
        snprintf(key, sizeof key, "%.*s", (int)strcspn(part, "."), part);
        at = cJSON_GetObjectItem(at, key);
        if (!at) fail_msg("no %s in %s", part, path);
    }
    return at->valuedouble;
}

static void assert_number(const cJSON *answer, const char *path, double truth, double most)
{
    const double value = number(answer, path);
    if (!(fabs(value - truth) <= most)) fail_msg("%s is %.9g, not %.9g", path, value, truth);
}

static const double zero[3] = {0, 0, 0}, cube[3] = {1, 1, 1};
static char one[TEXT], two[TEXT];

TEST_AROUND(a_moved_cube_has_the_numbers_of_the_formulas, open_renderer, close_renderer)
{
    cJSON *answer =
        compare(obj(one, zero, cube, 12), "obj", obj(two, (const double[3]){0.125, 0, 0}, cube, 12), "obj", NULL);
    assert_number(answer, "volume.iou", 7.0 / 9, 1e-6);
    assert_number(answer, "volume.onlyB", 0.125, 1e-6);
    assert_number(answer, "a.volume", 1, 1e-12);
    assert_number(answer, "a.area", 6, 1e-12);
    assert_number(answer, "a.solids", 1, 0);
    assert_number(answer, "a.handles", 0, 0);
    assert_number(answer, "deviation.hausdorff", 0.125, 1e-12);
    static const struct {
        const char *view;
        double iou;
    } views[3] = {{"front", 7.0 / 9}, {"right", 1}, {"top", 7.0 / 9}};
    for (int i = 0; i < 3; i++) {
        const cJSON *view = cJSON_GetArrayItem(cJSON_GetObjectItem(answer, "silhouettes"), i);
        assert_string_equal(cJSON_GetObjectItem(view, "view")->valuestring, views[i].view);
        assert_true(fabs(cJSON_GetObjectItem(view, "iou")->valuedouble - views[i].iou) < 1e-3);
    }
    assert_number(answer, "deviation.aToB.max", 0.125, 1e-12);
    assert_true(cJSON_IsFalse(cJSON_GetObjectItem(answer, "same")));
    assert_non_null(strstr(cJSON_GetObjectItem(answer, "summary")->valuestring, "IoU 0.77"));
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(answer, "warnings")), 0);
    cJSON_Delete(answer);
    answer = compare(one, "obj", two, "obj", "tolerance=0.13&precision=quick");
    assert_true(cJSON_IsTrue(cJSON_GetObjectItem(answer, "same")));
    cJSON_Delete(answer);
}

/* In an STL z points up, in an OBJ y: both are compared by the numbers in their files. */
TEST_AROUND(files_of_other_axes_are_the_same, open_renderer, close_renderer)
{
    const double low[3] = {1, 2, 3}, size[3] = {1, 2, 4};
    cJSON *answer = compare(stl(one, low, size), "stl", obj(two, low, size, 12), "obj", NULL);
    assert_true(cJSON_IsTrue(cJSON_GetObjectItem(answer, "same")));
    assert_number(answer, "volume.iou", 1, 0);
    const cJSON *max = cJSON_GetObjectItem(cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "a"), "box"), "max");
    assert_true(cJSON_GetArrayItem(max, 0)->valuedouble == 2 && cJSON_GetArrayItem(max, 1)->valuedouble == 4 &&
                cJSON_GetArrayItem(max, 2)->valuedouble == 7);
    cJSON_Delete(answer);
}

TEST_AROUND(open_surfaces_have_distances_alone, open_renderer, close_renderer)
{
    cJSON *answer =
        compare(obj(one, zero, cube, 12), "obj", obj(two, (const double[3]){0.25, 0, 0}, cube, 10), "obj", NULL);
    assert_null(cJSON_GetObjectItem(answer, "volume"));
    assert_null(cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "b"), "volume"));
    assert_number(answer, "a.volume", 1, 1e-12);
    assert_number(answer, "b.openEdges", 4, 0);
    assert_null(cJSON_GetObjectItem(cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "deviation"), "aToB"), "mean"));
    assert_true(number(answer, "deviation.bToA.mean") < number(answer, "deviation.bToA.abs"));
    assert_true(number(answer, "deviation.hausdorff") >= 0.25);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(answer, "warnings")), 1);
    cJSON_Delete(answer);
}

/* Parts by name: one stays, one moves, one grows, one is removed and one added. */
TEST_AROUND(parts_and_regions_are_told, open_renderer, close_renderer)
{
    static const struct {
        const char *name;
        double low[2][3], size[2][3];
    } rows[] = {{"stays", {{0, 0, 0}, {0, 0, 0}}, {{1, 1, 1}, {1, 1, 1}}},
                {"moves", {{2, 0, 0}, {2, 0.5, 0}}, {{1, 1, 1}, {1, 1, 1}}},
                {"grows", {{4, 0, 0}, {4, 0, 0}}, {{1, 1, 1}, {1, 1, 1.5}}},
                {"gone", {{6, 0, 0}}, {{1, 1, 0.5}}},
                {"new", {{0}, {8, 0, 0}}, {{0}, {1, 1, 0.75}}}};
    char *texts[2] = {one, two};
    for (int side = 0; side < 2; side++) {
        char *at = texts[side];
        int boxes = 0;
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            if (rows[i].size[side][0] == 0) continue;
            char box[TEXT];
            obj(box, rows[i].low[side], rows[i].size[side], 0);
            at += sprintf(at, "%sg %s\n", box, rows[i].name);
            for (int f = 0; f < 12; f++)
                at += sprintf(at, "f %d %d %d\n", triangles[f][0] + 1 + 8 * boxes, triangles[f][1] + 1 + 8 * boxes,
                              triangles[f][2] + 1 + 8 * boxes);
            boxes++;
        }
    }
    cJSON *answer = compare(one, "obj", two, "obj", NULL);
    static const char *const kinds[][2] = {
        {"removed", "gone"}, {"added", "new"}, {"moved", "moves"}, {"changed", "grows"}};
    for (size_t i = 0; i < 4; i++) {
        const cJSON *list = cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "parts"), kinds[i][0]);
        assert_int_equal(cJSON_GetArraySize(list), 1);
        assert_string_equal(cJSON_GetObjectItem(cJSON_GetArrayItem(list, 0), "name")->valuestring, kinds[i][1]);
    }
    const cJSON *regions = cJSON_GetObjectItem(answer, "regions"), *first = cJSON_GetArrayItem(regions, 0);
    assert_int_equal(cJSON_GetArraySize(regions), 5);
    assert_string_equal(cJSON_GetObjectItem(first, "in")->valuestring, "b");
    assert_string_equal(cJSON_GetObjectItem(first, "part")->valuestring, "new");
    assert_number(first, "volume", 0.75, 0.01);
    assert_non_null(strstr(cJSON_GetObjectItem(answer, "summary")->valuestring, "5 regions"));
    cJSON_Delete(answer);
}

TEST_AROUND(a_turned_part_is_aligned, open_renderer, close_renderer)
{
    obj(one, (const double[3]){10, 20, 30}, (const double[3]){1, 2, 3}, 12);
    obj(two, (const double[3]){-7, 3, 4}, (const double[3]){2, 3, 1}, 12);
    cJSON *answer = compare(one, "obj", two, "obj", "align=principal");
    assert_true(cJSON_IsTrue(cJSON_GetObjectItem(answer, "same")));
    const cJSON *alignment = cJSON_GetObjectItem(answer, "alignment"),
                *matrix = cJSON_GetObjectItem(alignment, "matrix");
    double middle[3] = {0};
    for (int k = 0; k < 3; k++)
        middle[k] =
            -6 * cJSON_GetArrayItem(matrix, k)->valuedouble + 4.5 * cJSON_GetArrayItem(matrix, 4 + k)->valuedouble +
            4.5 * cJSON_GetArrayItem(matrix, 8 + k)->valuedouble + cJSON_GetArrayItem(matrix, 12 + k)->valuedouble;
    assert_true(fabs(middle[0] - 10.5) < 1e-9 && fabs(middle[1] - 21) < 1e-9 && fabs(middle[2] - 31.5) < 1e-9);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(alignment, "ambiguous")), 3);
    assert_number(answer, "volume.iou", 1, 1e-12);
    cJSON_Delete(answer);
    answer = compare(one, "obj", two, "obj", "align=bounds");
    assert_true(cJSON_IsFalse(cJSON_GetObjectItem(answer, "same")));
    cJSON_Delete(answer);
}

TEST_AROUND(other_units_are_told, open_renderer, close_renderer)
{
    cJSON *answer =
        compare(obj(one, zero, cube, 12), "obj", obj(two, zero, (const double[3]){25.4, 25.4, 25.4}, 12), "obj", NULL);
    const cJSON *warnings = cJSON_GetObjectItem(answer, "warnings");
    assert_int_equal(cJSON_GetArraySize(warnings), 1);
    assert_non_null(strstr(cJSON_GetArrayItem(warnings, 0)->valuestring, "inches and millimetres"));
    cJSON_Delete(answer);
}

/* Counts the pixels that are more red, or more yellow, than grey. */
static void count_colors(const zraster_picture *picture, uint32_t *red, uint32_t *amber, uint32_t *grey)
{
    struct zraster_array array;
    assert_int_equal(zraster_picture_channel(picture, "color", &array), 1);
    const uint8_t *rgba = array.data;
    *red = *amber = *grey = 0;
    for (size_t i = 0; i < array.shape[0] * array.shape[1]; i++, rgba += 4) {
        const int warm = rgba[0] - rgba[2], yellow = rgba[1] - rgba[2];
        *(warm < 60 ? grey : yellow > 50 ? amber : red) += 1;
    }
}

/* A scene of glTF has metres; a format without units is not told. */
TEST_AROUND(other_names_of_units_are_told, open_renderer, close_renderer)
{
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":"
        "[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
        "\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":"
        "36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    cJSON *answer = compare(gltf, "gltf", obj(one, zero, cube, 12), "obj", "precision=quick");
    assert_string_equal(cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "a"), "unit")->valuestring, "metre");
    assert_null(cJSON_GetObjectItem(cJSON_GetObjectItem(answer, "b"), "unit"));
    cJSON_Delete(answer);
}

TEST_AROUND(differences_are_drawn_in_their_colors, open_renderer, close_renderer)
{
    static const struct {
        const char *show;
        bool has_red, has_amber;
    } rows[] = {{"show=difference", true, true}, {"show=side", true, true}, {"show=deviation", true, false}};
    zraster_scene *a = read(obj(one, zero, (const double[3]){1, 1, 2}, 12), "obj"),
                  *b = read(obj(two, zero, (const double[3]){2, 1, 1}, 12), "obj");
    for (size_t i = 0; i < 3; i++) {
        const struct zraster_request change = {.struct_size = sizeof change, .query = "width=320&height=240"};
        zraster_comparison *comparison;
        zraster_picture *picture;
        uint32_t red, amber, grey;
        assert_int_equal(zraster_compare(a, b, rows[i].show, NULL, &comparison, NULL), ZRASTER_OK);
        const zraster_scene *scene = zraster_comparison_scene(comparison);
        assert_non_null(scene);
        assert_int_equal(zraster_scene_draw(scene, &change, &picture, NULL), ZRASTER_OK);
        count_colors(picture, &red, &amber, &grey);
        if ((red > 500) != rows[i].has_red || (amber > 500) != rows[i].has_amber || grey < 5000)
            fail_msg("%s: %u red, %u amber, %u grey", rows[i].show, red, amber, grey);
        if (zraster_picture_warning(picture, 0)) fail_msg("%s: %s", rows[i].show, zraster_picture_warning(picture, 0));
        zraster_picture_free(picture);
        zraster_comparison_free(comparison);
    }
    zraster_comparison *comparison;
    assert_int_equal(zraster_compare(a, b, "show=none", NULL, &comparison, NULL), ZRASTER_OK);
    assert_null(zraster_comparison_scene(comparison));
    zraster_comparison_free(comparison);
    zraster_scene_free(a);
    zraster_scene_free(b);
}

TEST_AROUND(faults_are_told, open_renderer, close_renderer)
{
    zraster_scene *scene = read(obj(one, zero, cube, 12), "obj"), *line = read("v 0 0 0\nv 1 0 0\nl 1 2\n", "obj");
    zraster_comparison *comparison;
    zraster_error *error;
    assert_int_equal(zraster_compare(scene, line, NULL, NULL, &comparison, &error), ZRASTER_BAD_SCENE);
    assert_non_null(strstr(zraster_error_text(error), "b has no faces"));
    assert_null(comparison);
    zraster_error_free(error);
    static const char *const wrong[] = {"tolerance=-1", "tolerance=", "tolerance=1x", "precision=low",
                                        "color=red",    "align=best", "show=all",     "x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(zraster_compare(scene, scene, wrong[i], NULL, &comparison, NULL), ZRASTER_BAD_REQUEST);
    zraster_cancel *cancel = zraster_cancel_new();
    zraster_cancel_raise(cancel);
    assert_int_equal(zraster_compare(scene, scene, NULL, cancel, &comparison, NULL), ZRASTER_CANCELLED);
    zraster_cancel_free(cancel);
    zraster_scene_free(scene);
    zraster_scene_free(line);
}

RUN_TESTS(NULL, NULL)
