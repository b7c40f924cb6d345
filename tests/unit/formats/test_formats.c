/* input/formats/formats.c: what a Content-Type says, and what bytes look like. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "input/formats/formats.h"
#include "input/formats/sniff.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

/* What a clone without Git LFS has in place of a file, and a model with a part. */
#define LFS "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a214614ab\nsize 12345\n"
#define WITH_BUFFER                                                                                                    \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"a.bin\",\"byteLength\":36}],"                            \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"                                                              \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","                           \
    "\"min\":[0,0,0],\"max\":[1,1,1]}],"                                                                               \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}"

TEST(each_media_type_leads_to_its_format)
{
    static const struct {
        const char *type;
        enum zr_format format;
    } cases[] = {{"application/json", ZR_FORMAT_JSON},
                 {"Application/JSON; charset=utf-8", ZR_FORMAT_JSON},
                 {"model/obj\t;x", ZR_FORMAT_OBJ},
                 {"model/stl", ZR_FORMAT_STL},
                 {"application/zip", ZR_FORMAT_ZIP},
                 {"application/x-zip-compressed", ZR_FORMAT_ZIP},
                 {"model/gltf-binary", ZR_FORMAT_GLB},
                 {"model/gltf+json", ZR_FORMAT_GLTF},
                 {"application/sla", ZR_FORMAT_STL},
                 {"model/3mf", ZR_FORMAT_3MF},
                 {"application/vnd.ms-package.3dmanufacturing-3dmodel+xml", ZR_FORMAT_3MF},
                 {"model/x.stl-ascii", ZR_FORMAT_STL},
                 {"model/ply", ZR_FORMAT_PLY},
                 {"application/x-ply", ZR_FORMAT_PLY},
                 {"model/x.stl-asci", ZR_FORMAT_UNKNOWN},
                 {"model/x.stl-ascii2", ZR_FORMAT_UNKNOWN},
                 {"application/json application/sla", ZR_FORMAT_JSON},
                 {"", ZR_FORMAT_UNKNOWN},
                 {" ", ZR_FORMAT_UNKNOWN},
                 {";", ZR_FORMAT_UNKNOWN},
                 {NULL, ZR_FORMAT_UNKNOWN},
                 {"text/plain", ZR_FORMAT_UNKNOWN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(zr_format_of_type(cases[i].type), cases[i].format);
}

TEST(types_that_say_nothing_are_generic)
{
    static const char *const generic[] = {NULL,
                                          "",
                                          "; q",
                                          "text/plain",
                                          "TEXT/plain;charset=x",
                                          "application/octet-stream",
                                          "application/x-www-form-urlencoded"};
    for (size_t i = 0; i < sizeof generic / sizeof *generic; i++)
        assert_true(zr_media_type_is_generic(generic[i]));
    assert_false(zr_media_type_is_generic("text/plainer"));
    assert_false(zr_media_type_is_generic("image/png"));
    assert_false(zr_media_type_is_generic("text"));
}

/* In a buffer of just its size, so that sanitizers see what is read beyond. */
static void expect(const char *bytes, size_t size, enum zr_format format, const char *words)
{
    char *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    const enum zr_format got = zr_format_of_bytes(copy, size);
    const char *said = zr_bytes_in_words(copy, size);
    if (got != format || (said == NULL) != (words == NULL) || (said && strcmp(said, words) != 0))
        fail_msg("%.*s: format %d, %s", (int)size, bytes, (int)got, said ? said : "nothing");
    free(copy);
}

TEST(bytes_look_like_what_they_are)
{
    static const struct {
        const char *text;
        enum zr_format format;
        const char *words;
    } cases[] = {{"{", ZR_FORMAT_JSON, "JSON"},
                 {"\xEF\xBB\xBF \r\n\t[", ZR_FORMAT_JSON, "JSON"},
                 {"{\"asset\" :{}", ZR_FORMAT_GLTF, "GLTF"},
                 {" {\"a\":[\"\\\"{\"],\"scenes\": 1", ZR_FORMAT_GLTF, "GLTF"},
                 {"{\"base\":{\"asset\":1},\"asset", ZR_FORMAT_JSON, "JSON"},
                 {"glTF", ZR_FORMAT_GLB, "GLB"},
                 {"glT", ZR_FORMAT_UNKNOWN, NULL},
                 {"v 0 0 0\n", ZR_FORMAT_OBJ, "OBJ"},
                 {"# a\n\n#b\n  f 1 2 3", ZR_FORMAT_OBJ, "OBJ"},
                 {"mtllib a.mtl\n", ZR_FORMAT_OBJ, "OBJ"},
                 {"solid x\nfacet", ZR_FORMAT_STL, "STL"},
                 {"ply\n", ZR_FORMAT_PLY, "PLY"},
                 {"ply\r", ZR_FORMAT_PLY, "PLY"},
                 {"ply \t\r\nformat", ZR_FORMAT_PLY, "PLY"},
                 {"ply", ZR_FORMAT_UNKNOWN, NULL},
                 {"plyx\n", ZR_FORMAT_UNKNOWN, NULL},
                 {"v", ZR_FORMAT_UNKNOWN, NULL},
                 {"vertex 0 0 0\n", ZR_FORMAT_UNKNOWN, NULL},
                 {"# only a remark", ZR_FORMAT_UNKNOWN, NULL},
                 {"", ZR_FORMAT_UNKNOWN, NULL},
                 {" \n", ZR_FORMAT_UNKNOWN, NULL},
                 {"\xEF\xBB\xBF", ZR_FORMAT_UNKNOWN, NULL},
                 {"\x1F\x8B", ZR_FORMAT_UNKNOWN, "gzip (Content-Encoding: gzip is missing)"},
                 {"\x89PN", ZR_FORMAT_UNKNOWN, NULL},
                 {"\x89PNG", ZR_FORMAT_UNKNOWN, "a PNG picture"},
                 {"PK\x03\x04", ZR_FORMAT_ZIP, "ZIP"},
                 {"PK\x05\x06", ZR_FORMAT_ZIP, "ZIP"},
                 {"GIF89a", ZR_FORMAT_UNKNOWN, "a GIF picture"},
                 {"RIFF", ZR_FORMAT_UNKNOWN, "a RIFF file, as WebP pictures are"},
                 {"#?RADIANCE\n", ZR_FORMAT_UNKNOWN, "a Radiance picture"},
                 {"BMP", ZR_FORMAT_UNKNOWN, "a BMP picture"},
                 {"\xFF\xFE{", ZR_FORMAT_UNKNOWN, "UTF-16 text (UTF-8 is needed)"},
                 {"\xFE\xFF", ZR_FORMAT_UNKNOWN, "UTF-16 text (UTF-8 is needed)"},
                 {"\xFF\xFD", ZR_FORMAT_UNKNOWN, NULL},
                 {"# a\n; b\nsolid x\n", ZR_FORMAT_STL, "STL"},
                 {"\xEF\xBB\xBFsolid x\n", ZR_FORMAT_STL, "STL"},
                 {LFS, ZR_FORMAT_UNKNOWN, "a pointer of Git LFS (git lfs pull fetches the file)"},
                 {"<html>", ZR_FORMAT_UNKNOWN, "XML or HTML"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect(cases[i].text, strlen(cases[i].text), cases[i].format, cases[i].words);
}

TEST(binary_stl_is_known_by_its_size)
{
    char bytes[84 + 2 * 50] = {[80] = 2};
    expect(bytes, sizeof bytes, ZR_FORMAT_STL, "STL");
    expect(bytes, sizeof bytes - 1, ZR_FORMAT_UNKNOWN, NULL);
    expect(bytes, 83, ZR_FORMAT_UNKNOWN, NULL);
    memcpy(bytes, "\xFF\xFE", 2);
    expect(bytes, sizeof bytes, ZR_FORMAT_STL, "STL");
    memcpy(bytes, "{\"", 2); /* a header is any text; what a scene begins with is looked at first */
    expect(bytes, sizeof bytes, ZR_FORMAT_JSON, "JSON");
}

/* Its first coordinates tell it from other formats. */
TEST(binary_stl_with_bytes_behind_it_is_known_by_its_coordinates)
{
    char bytes[84 + 50 + 1] = {[80] = 1};
    const float coordinates[] = {1, -20, 1e5f, 0, INFINITY, NAN, 1e30f, 1e-30f};
    for (size_t i = 0; i < sizeof coordinates / sizeof *coordinates; i++) {
        memcpy(bytes + 84 + 12 + 8, &coordinates[i], sizeof *coordinates);
        expect(bytes, sizeof bytes, i < 3 ? ZR_FORMAT_STL : ZR_FORMAT_UNKNOWN, i < 3 ? "STL" : NULL);
    }
    bytes[80] = 0;
    expect(bytes, sizeof bytes, ZR_FORMAT_UNKNOWN, NULL);
}

TEST(pointers_of_lfs_are_named)
{
    for (int format = 0; format < ZR_FORMAT_COUNT; format++) {
        struct reading *reading = read_text((enum zr_format)format, LFS);
        assert_complaint(reading, ZR_BAD_SYNTAX, "", "a pointer of Git LFS, not the file: git lfs pull fetches it");
        assert_int_equal(reading->error.count, 1);
        reading_free(reading);
    }
    const struct zr_asset part = {.name = "a.bin", .bytes = LFS, .size = sizeof LFS - 1};
    struct reading *reading =
        read_with_part(ZR_FORMAT_GLTF, (struct zr_request){.look = "textbook"}, &part, WITH_BUFFER);
    assert_complaint(reading, ZR_BAD_SCENE, "/buffers/0/uri", "the part 'a.bin' is a pointer of Git LFS, not the file");
    reading_free(reading);
}

/* A binary STL may begin with the same bytes. */
TEST(utf16_is_named)
{
    static const char texts[2][8] = {"\xFF\xFEv\0 \0", "\xFE\xFF\0v\0 "};
    for (int format = 0; format < ZR_FORMAT_COUNT; format++)
        for (size_t i = 0; i < 2; i++) {
            char wanted[80];
            snprintf(wanted, sizeof wanted, "the body is UTF-16 text; %s is read as UTF-8",
                     zr_format_rows[format].name);
            struct reading *reading = read_bytes((enum zr_format)format, texts[i], 6);
            assert_complaint(reading, ZR_BAD_SYNTAX, "", wanted);
            assert_int_equal(reading->error.count, 1);
            reading_free(reading);
            reading = read_bytes(ZR_FORMAT_UNKNOWN, texts[i], 6);
            assert_complaint(reading, ZR_BAD_TYPE, "", "looks like UTF-16 text (UTF-8 is needed)");
            reading_free(reading);
        }
    char binary[84 + 50] = "\xFF\xFE";
    const float one = 1;
    binary[80] = 1;
    memcpy(binary + 84 + 12 + 12, &one, sizeof one);
    struct reading *reading = read_bytes(ZR_FORMAT_STL, binary, sizeof binary);
    assert_read(reading);
    reading_free(reading);
}

TEST(zeros_among_blanks_end_them)
{
    expect(" \0{", 3, ZR_FORMAT_UNKNOWN, NULL);
    expect("#\0\nv 1", 6, ZR_FORMAT_OBJ, "OBJ");
    expect("v\0 1", 4, ZR_FORMAT_UNKNOWN, NULL);
}

TEST(large_remarks_are_not_searched_to_their_end)
{
    enum { SIZE = 1 << 20 };
    char *text = malloc(SIZE);
    assert_non_null(text);
    memset(text, '#', SIZE);
    memcpy(text + SIZE - 8, "\nv 1 2 3", 8);
    expect(text, SIZE, ZR_FORMAT_UNKNOWN, NULL);
    free(text);
}

RUN_TESTS(NULL, NULL)
