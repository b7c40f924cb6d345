/* alphaMode and alphaCutoff in JSON, and the warning of an alpha without an alphaMode. */
#include "support/input/zip_file.h"
#include "support/pictures/png.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST(alpha_gives_one_warning)
{
    static const char *const texts[] = {
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}, {" TRIANGLE ", \"color\": \"#ff000080\"}]}",
        "{\"polygons\": [{" TRIANGLE ", \"material\": \"glass\"}], \"materials\": [{\"name\": \"glass\", "
        "\"baseColorFactor\": [1,1,1,0.5]}]}",
        "{\"polygons\": [{" TRIANGLE ", \"colors\": [[1,1,1],[1,1,1],[1,1,1,0]]}]}",
        "{\"meshes\": [{" POSITIONS ", \"faces\": [[0,1,2]], \"faceColors\": [[0,0,0,0]]}]}",
        "{" POLYGONS ", \"outline\": \"#ff000080\"}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_scene(texts[i]);
        assert_int_equal(reading->scene->warning_count, 1);
        assert_non_null(strstr(reading->scene->warnings[0], "alpha below 1"));
        reading_free(reading);
    }
    struct reading *reading = read_rest("\"background\": \"#ffffff00\"");
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 0);
    assert_true(reading->scene->background.w == 0);
    reading_free(reading);
}

/* By the mesh, its material or the scene. */
TEST(explicit_opaque_ends_the_warning)
{
    static const char *const texts[] = {
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\", \"alphaMode\": \"OPAQUE\"}]}",
        "{\"alphaMode\": \"OPAQUE\", \"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}]}",
        "{\"polygons\": [{" TRIANGLE
        ", \"material\": \"m\", \"color\": \"#ff000080\"}], \"materials\": [{\"name\": \"m\", "
        "\"alphaMode\": \"OPAQUE\"}]}",
        "{\"alphaMode\": \"MASK\", \"meshes\": [{\"alphaMode\": \"OPAQUE\", " POSITIONS
        ", \"faces\": [[0,1,2]], \"faceColors\": [[1,0,0,0.3]]}]}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_scene(texts[i]);
        if (reading->scene->warning_count != 0) fail_msg("%s: %s", texts[i], reading->scene->warnings[0]);
        reading_free(reading);
    }
}

/* The nearest alphaMode counts; alpha is then nothing to warn of. */
TEST(alpha_modes_are_those_of_the_nearest_that_say_one)
{
    struct reading *reading = read_scene(
        "{\"alphaMode\": \"BLEND\", \"materials\": [{\"name\": \"m\", \"alphaMode\": \"MASK\", \"alphaCutoff\": "
        "0.25}], "
        "\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}, {" TRIANGLE ", \"material\": \"m\"}, "
        "{" TRIANGLE ", \"material\": \"m\", \"alphaMode\": \"OPAQUE\"}, {" TRIANGLE ", \"alphaMode\": \"MASK\"}]}");
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    static const enum zr_alpha_mode want[] = {ZR_ALPHA_BLEND, ZR_ALPHA_MASK, ZR_ALPHA_OPAQUE, ZR_ALPHA_MASK};
    for (uint32_t f = 0; f < 4; f++) {
        const struct zr_material *material = zr_material_of_face(scene, &scene->meshes[0], f);
        assert_int_equal(material->alpha_mode, want[f]);
        if (want[f] == ZR_ALPHA_MASK) assert_true(material->alpha_cutoff == (f == 1 ? 0.25f : 0.5f));
    }
    assert_int_equal(scene->warning_count, 0);
    reading_free(reading);
}

TEST(alpha_modes_that_are_none_and_what_cannot_have_any_are_refused)
{
    static const struct {
        const char *rest, *pointer, *detail;
    } cases[] = {{"\"alphaMode\": \"blend\"", "/alphaMode", "BLEND"},
                 {"\"alphaMode\": \"MASK\", \"alphaCutoff\": 1.5", "/alphaCutoff", "1"},
                 {"\"alphaMode\": \"BLEND\", \"algorithm\": \"painter\"", "/algorithm", "painter keeps no fragments"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 640, \"y\": 0}]", "", "640, 0, beside the window"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 0, \"y\": 480}]", "", "0, 480, beside the window"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 639, \"y\": 479}], \"algorithm\": \"painter\"",
                  "/algorithm", "fragments needs"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_rest(cases[i].rest);
        assert_int_equal(reading->status, ZR_BAD_SCENE);
        assert_string_equal(reading->error.items[0].pointer, cases[i].pointer);
        assert_non_null(strstr(reading->error.items[0].detail, cases[i].detail));
        reading_free(reading);
    }
}

/* Formats without an alphaMode blend by default; any alphaMode of the scene overrides that, but not a glTF's. */
TEST(an_alpha_mode_of_the_scene_overrides_the_blending_of_files)
{
    static const char obj[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    static const char mtl[] = "newmtl m\nKd 1 0 0\nd 0.4\n";
    static const char ply[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty float r\nproperty float g\nproperty float b\nproperty float a\nelement "
        "face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0 1 0 0 0.5\n1 0 0 1 0 0 1\n"
        "0 1 0 1 0 0 1\n3 0 1 2\n";
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
        "\"POSITION\":0},\"material\":0}]}],\"materials\":[{\"alphaMode\":\"BLEND\"}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    static const char model[] =
        "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
        "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"><resources><basematerials "
        "id=\"1\"><base "
        "name=\"r\" displaycolor=\"#FF000080\"/></basematerials><m:texture2d id=\"2\" path=\"/a.png\" "
        "contenttype=\"image/png\"/><m:texture2dgroup id=\"3\" texid=\"2\"><m:tex2coord u=\"0\" v=\"0\"/>"
        "</m:texture2dgroup><object id=\"9\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
        "z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\" "
        "pid=\"3\" "
        "p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/></triangles></mesh></object></resources>"
        "<build><item objectid=\"9\"/></build></model>";
    static const uint8_t texel[4] = {10, 20, 30, 77};
    size_t size, image_size;
    uint8_t *image = png_memory_write(texel, 1, 1, &image_size);
    const struct zip_entry entries[] = {{"3D/3dmodel.model", model, sizeof model - 1, true},
                                        {"a.png", (const char *)image, image_size, false}};
    unsigned char *package = zip_3mf(entries, 2, &size);
    const struct zr_asset parts[] = {{.name = "m.obj", .bytes = obj, .size = sizeof obj - 1},
                                     {.name = "a.mtl", .bytes = mtl, .size = sizeof mtl - 1},
                                     {.name = "m.ply", .bytes = ply, .size = sizeof ply - 1},
                                     {.name = "m.3mf", .bytes = package, .size = size},
                                     {.name = "m.gltf", .bytes = gltf, .size = sizeof gltf - 1}};
    static const char *const files[] = {"m.obj", "m.ply", "m.3mf", "m.gltf"};
    static const struct {
        const char *of_scene, *of_mesh;
        enum zr_alpha_mode mode, of_gltf;
    } cases[] = {
        {"BLEND", NULL, ZR_ALPHA_BLEND, ZR_ALPHA_BLEND},       {"OPAQUE", NULL, ZR_ALPHA_OPAQUE, ZR_ALPHA_BLEND},
        {"MASK", NULL, ZR_ALPHA_MASK, ZR_ALPHA_BLEND},         {NULL, NULL, ZR_ALPHA_BLEND, ZR_ALPHA_BLEND},
        {"BLEND", "OPAQUE", ZR_ALPHA_OPAQUE, ZR_ALPHA_OPAQUE}, {NULL, "MASK", ZR_ALPHA_MASK, ZR_ALPHA_MASK}};
    for (size_t i = 0; i < 4 * sizeof cases / sizeof *cases; i++) {
        char text[256], scene[32] = "", mesh[32] = "";
        const char *of_scene = cases[i / 4].of_scene, *of_mesh = cases[i / 4].of_mesh;
        if (of_scene) snprintf(scene, sizeof scene, "\"alphaMode\":\"%s\",", of_scene);
        if (of_mesh) snprintf(mesh, sizeof mesh, "\"alphaMode\":\"%s\",", of_mesh);
        snprintf(text, sizeof text, "{%s\"look\":\"studio\",\"meshes\":[{%s\"asset\":\"%s\"}]}", scene, mesh,
                 files[i % 4]);
        const struct zr_request request = {.format = ZR_FORMAT_JSON, .assets = parts, .asset_count = 5};
        struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
        assert_read(reading);
        const struct zr_mesh *made = &reading->scene->meshes[0];
        const enum zr_alpha_mode want = i % 4 == 3 ? cases[i / 4].of_gltf : cases[i / 4].mode;
        for (uint32_t face = 0; face < made->face_count; face++)
            if (zr_material_of_face(reading->scene, made, face)->alpha_mode != want)
                fail_msg("%s: face %u: %d", text, face,
                         (int)zr_material_of_face(reading->scene, made, face)->alpha_mode);
        reading_free(reading);
    }
    free(package);
    free(image);
}

RUN_TESTS(NULL, NULL)
