/* core/api: errors, sizes of structs, the ceiling of memory, and numbers in every locale. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/renderer.h"
#include "support/tests.h"

static void refuse(const struct zraster_request *request, zraster_status wanted, const char *pointer,
                   const char *detail)
{
    zraster_picture *picture;
    zraster_error *error;
    assert_int_equal(zraster_draw(renderer, request, &picture, &error), wanted);
    assert_null(picture);
    assert_string_equal(zraster_error_pointer(error, 0), pointer);
    if (!strstr(zraster_error_detail(error, 0), detail)) fail_msg("%s", zraster_error_text(error));
    assert_string_equal(zraster_error_pointer(error, 99), "");
    zraster_error_free(error);
    assert_int_equal(zraster_draw(renderer, request, &picture, NULL), wanted);
}

TEST(errors_have_a_place_and_a_reason)
{
    struct zraster_request request =
        request_of("{\"meshes\": [{\"positions\": [[0,0,0]], \"faces\": [[0,0,7]]}], \"samples\": 3}");
    refuse(&request, ZRASTER_BAD_SCENE, "/meshes/0/faces/0/2", "index 7 of 1");
    zraster_picture *picture;
    zraster_error *error;
    zraster_draw(renderer, &request, &picture, &error);
    assert_int_equal(zraster_error_count(error), 2);
    assert_non_null(strstr(zraster_error_text(error), "\n/samples: 3; 1, 4"));
    zraster_error_free(error);
    request = request_of("{\"a\": ");
    refuse(&request, ZRASTER_BAD_SYNTAX, "", "line 1");
    request = request_of("what is it");
    refuse(&request, ZRASTER_BAD_TYPE, "", "no type is given");
    request.body_size = 0;
    refuse(&request, ZRASTER_BAD_SYNTAX, "", "the body is empty");
    request.type = "model/step";
    refuse(&request, ZRASTER_BAD_TYPE, "", "'model/step' is none of: application/json");
    request = request_of(triangle);
    request.query = "chanel=depth";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "unknown parameter 'chanel' (did you mean channel?)");
    request.query = "channel=%4";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "%-escape");
    request.query = "strict=perhaps";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "parameter strict: 'perhaps' is unknown");
    static const struct {
        struct zraster_array array;
        uint32_t flags;
        const char *why;
    } parts[] = {
        {{"x", 8, 1, {1}}, 0, "its type is unknown"},
        {{"x", ZRASTER_F4, 0, {1}}, 0, "its ndim is not 1 to 4"},
        {{"x", ZRASTER_F4, 5, {1}}, 0, "its ndim is not 1 to 4"},
        {{"x", ZRASTER_BYTES, 2, {1, 1}}, 0, "bytes need ndim 1"},
        {{"x", ZRASTER_U8, 2, {SIZE_MAX / 2, 3}}, 0, "its shape is too large"},
        {{NULL, ZRASTER_U1, 1, {1}}, 0, "its data is NULL"},
        {{"x", ZRASTER_U1, 1, {1}}, 4, "unknown flags"},
    };
    request = request_of(triangle);
    request.part_count = 1;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const struct zraster_part part = {.name = "p", .array = parts[i].array, .flags = parts[i].flags};
        request.parts = &part;
        refuse(&request, ZRASTER_BAD_REQUEST, "", parts[i].why);
    }
    const struct zraster_part numbers = {.name = "p", .array = {"abcd", ZRASTER_F4, 1, {1}}};
    request = request_of("{\"base\": {\"windowDepth\": {\"asset\": \"p\"}}, \"view\": {\"znear\": 1, \"zfar\": 9}, "
                         "\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}");
    request.parts = &numbers;
    request.part_count = 1;
    refuse(&request, ZRASTER_BAD_SCENE, "/base/windowDepth/asset",
           "the part 'p' is an array of f4; the bytes of a file are needed");
    refuse(NULL, ZRASTER_BAD_REQUEST, "", "NULL");
}

TEST(memory_has_a_ceiling)
{
    const struct zraster_options options = {.struct_size = sizeof options, .memory_max = 1 << 20, .threads = 1};
    const struct zraster_request request = request_of(triangle);
    zraster *small;
    zraster_picture *picture;
    zraster_error *error;
    assert_int_equal(zraster_open(&options, &small), ZRASTER_OK);
    assert_int_equal(zraster_draw(small, &request, &picture, &error), ZRASTER_NO_MEMORY);
    assert_non_null(strstr(zraster_error_text(error), "more than the 1048576 bytes that a request may use"));
    zraster_error_free(error);
    zraster_close(small);
}

TEST(structs_of_other_versions_are_taken)
{
    struct {
        struct zraster_request request;
        void *later;
    } newer = {.request = request_of(triangle)};
    zraster_picture *picture, *wanted = picture_of(renderer, triangle);
    newer.request.struct_size = sizeof newer;
    assert_int_equal(zraster_draw(renderer, &newer.request, &picture, NULL), ZRASTER_OK);
    zraster_picture_free(picture);
    newer.later = &newer;
    refuse(&newer.request, ZRASTER_BAD_REQUEST, "", "a member that this version of zraster lacks");
    struct zraster_request older = request_of(triangle);
    older.struct_size = offsetof(struct zraster_request, query);
    older.query = "chanel"; /* behind its end */
    assert_int_equal(zraster_draw(renderer, &older, &picture, NULL), ZRASTER_OK);
    assert_true(is_same_bytes(bytes_of(picture, NULL), bytes_of(wanted, NULL)));
    zraster_picture_free(picture);
    zraster_picture_free(wanted);
    older.struct_size = 0;
    refuse(&older, ZRASTER_BAD_REQUEST, "", "struct_size of zraster_request is 0");
    struct zraster_options options = {.struct_size = 0};
    zraster *none;
    assert_int_equal(zraster_open(&options, &none), ZRASTER_BAD_REQUEST);
    assert_null(none);
    options.struct_size = offsetof(struct zraster_options, memory_keep);
    assert_int_equal(zraster_open(&options, &none), ZRASTER_OK);
    zraster_close(none);
}

/* ---- locale ---- */

/* Needs localedef of libc-bin; a locale whose decimal separator is a comma. */
TEST(numbers_have_a_point_in_every_locale)
{
    char folder[] = "/tmp/zraster-locale-XXXXXX", command[400];
    assert_non_null(mkdtemp(folder));
    snprintf(
        command, sizeof command,
        "cd %s && printf 'LC_NUMERIC\\ndecimal_point \",\"\\nthousands_sep \"\"\\ngrouping -1\\nEND LC_NUMERIC\\n' >in "
        "&& localedef -c -i in -f ANSI_X3.4-1968 ./comma >/dev/null 2>&1; test -s comma/LC_NUMERIC",
        folder);
    assert_int_equal(system(command), 0);
    zraster_picture *wanted = picture_of(renderer, triangle);
    const struct zraster_bytes info = bytes_of(wanted, "info");
    setenv("LOCPATH", folder, 1);
    assert_non_null(setlocale(LC_NUMERIC, "comma"));
    char half[8];
    snprintf(half, sizeof half, "%.1f", 0.5);
    assert_string_equal(half, "0,5");
    zraster_picture *picture = picture_of(renderer, triangle);
    assert_true(is_same_bytes(bytes_of(picture, "info"), info));
    assert_true(is_same_bytes(bytes_of(picture, NULL), bytes_of(wanted, NULL)));
    struct zraster_request request = request_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    request.query = "azimuth=12.5&elevation=999";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "from -90 to 90");
    request.query = "azimuth=12.5";
    zraster_picture *turned;
    assert_int_equal(zraster_draw(renderer, &request, &turned, NULL), ZRASTER_OK);
    snprintf(half, sizeof half, "%.1f", 0.5);
    assert_string_equal(half, "0,5"); /* as before */
    setlocale(LC_NUMERIC, "C");
    zraster_picture_free(turned);
    zraster_picture_free(picture);
    zraster_picture_free(wanted);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

RUN_TESTS(open_renderer, close_renderer)
