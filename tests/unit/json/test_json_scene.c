#include "scene/output.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST(smallest_scene_has_defaults)
{
    struct reading *reading = read_rest("");
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->views[0].width, 640);
    assert_int_equal(scene->views[0].height, 480);
    assert_true(scene->background.x == 1 && scene->background.w == 1 && scene->ambient.y == 0.34f);
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(scene->instance_count, 1);
    assert_int_equal(scene->light_count, 2);
    assert_true(scene->lights[0].camera_frame && scene->lights[0].color.x == 0.45f);
    assert_int_equal(scene->views[0].output_count, 1);
    assert_int_equal(scene->views[0].outputs[0].channel, ZR_CHANNEL_COLOR);
    assert_int_equal(scene->warning_count, 0);
    assert_int_equal(scene->algorithm, ZR_ALGORITHM_HALFSPACE);
    assert_int_equal(scene->views[0].pose, ZR_POSE_PRESET);
    assert_int_equal(scene->views[0].preset, ZR_PRESET_ISOMETRIC);
    assert_int_equal(scene->views[0].projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(scene->views[0].fit_padding == 0.05f);
    const struct zr_material *material = &scene->materials[scene->meshes[0].face_materials[0]];
    assert_true(material->base_color.x == 0.7f && !material->double_sided);
    assert_int_equal(material->shading, ZR_SHADING_FLAT);
    assert_string_equal(scene->meshes[0].name, "polygons");
    reading_free(reading);
}

TEST(mesh_is_read_whole)
{
    struct reading *reading = read_scene(
        "{\"materials\": [{\"name\": \"b\"}, {\"name\": \"a\", \"baseColorFactor\": [0.5, 0.25, 1], \"doubleSided\": "
        "true}],"
        "\"meshes\": [{\"name\": \"part \\u00e4\", \"material\": \"a\", " POSITIONS
        ", \"normals\": [[0,0,1],[0,0,2],[0,0,3],[0,0,4]], \"colors\": [\"#ff0000\",[0,1,0],[0,0,1,1],\"#0000ffff\"],"
        "\"faceColors\": [\"#00FF80\", [1,1,1]], \"faces\": [[0,1,2],[3,2,1,0]]}]}");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t indices[7] = {0, 1, 2, 3, 2, 1, 0};
    assert_string_equal(mesh->name, "part \xC3\xA4");
    assert_int_equal(mesh->position_count, 4);
    assert_true(mesh->positions[2].w == 1 && mesh->positions[3].w == 2);
    assert_int_equal(mesh->face_count, 2);
    assert_int_equal(mesh->face_offsets[1], 3);
    assert_int_equal(mesh->face_offsets[2], 7);
    assert_memory_equal(mesh->indices, indices, sizeof indices);
    assert_int_equal(mesh->normal_count, 4);
    assert_true(mesh->normals[3].z == 4 && !mesh->normal_indices);
    assert_true(mesh->colors[0].x == 1 && mesh->colors[0].y == 0 && mesh->colors[3].z == 1);
    assert_true(mesh->face_colors[0].y == 255.0f * (1.0f / 255.0f) && mesh->face_colors[0].z == 128 * (1.0f / 255.0f));
    const struct zr_material *material = &reading->scene->materials[mesh->material];
    assert_true(material->base_color.x == 0.5f && material->base_color.w == 1 && material->double_sided);
    assert_int_equal(material->shading, ZR_SHADING_GOURAUD);
    reading_free(reading);
}

TEST(polygons_become_the_last_mesh)
{
    struct reading *reading = read_scene(
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff0000\"}, {\"vertices\": [[5,0,0],[6,0,0],[6,1,0],[5,1,0]],"
        "\"colors\": [[0,0,0],[0,0,0],[0,0,0],[0,0.5,0]], \"normals\": [[0,0,1],[0,0,1],[0,0,1],[0,0,7]]}, {" TRIANGLE
        "}], \"meshes\": [{" POSITIONS ", \"faces\": [[0,1,2]]}]}");
    assert_int_equal(reading->scene->mesh_count, 2);
    assert_int_equal(reading->scene->instance_count, 2);
    assert_int_equal(reading->scene->instances[1].mesh, 1);
    const struct zr_mesh *mesh = &reading->scene->meshes[1];
    const struct zr_material *materials = reading->scene->materials;
    assert_int_equal(mesh->face_count, 3);
    assert_int_equal(mesh->position_count, 10);
    assert_int_equal(mesh->face_offsets[1], 3);
    assert_int_equal(mesh->face_offsets[2], 7);
    assert_int_equal(mesh->face_offsets[3], 10);
    for (uint32_t i = 0; i < 10; i++)
        assert_int_equal(mesh->indices[i], i);
    assert_true(mesh->positions[3].x == 5);
    assert_int_equal(mesh->normal_count, 10);
    assert_true(mesh->normals[0].z == 0 && mesh->normals[6].z == 7 && mesh->normals[7].z == 0);
    assert_true(mesh->colors[0].x == 1 && mesh->colors[6].y == 0.5f && mesh->colors[6].x == 0 &&
                mesh->colors[9].z == 1);
    assert_true(mesh->face_colors[0].x == 1 && mesh->face_colors[0].y == 0 && mesh->face_colors[1].y == 1);
    assert_true(materials[mesh->face_materials[0]].base_color.x == 1);
    assert_true(materials[mesh->face_materials[2]].base_color.x == 0.7f);
    assert_int_equal(materials[mesh->face_materials[0]].shading, ZR_SHADING_FLAT);
    assert_int_equal(materials[mesh->face_materials[1]].shading, ZR_SHADING_GOURAUD);
    reading_free(reading);
}

TEST(looks_come_from_mesh_then_material_then_scene)
{
    struct reading *reading = read_scene(
        "{\"shading\": \"unlit\", \"materials\": [{\"name\": \"m\", \"shading\": \"gouraud\", \"doubleSided\": true},"
        "{\"name\": \"n\"}], \"polygons\": [{" TRIANGLE "}, {" TRIANGLE ", \"material\": \"m\"}, {" TRIANGLE
        ", \"material\": \"m\", \"shading\": \"flat\", \"doubleSided\": false}, {" TRIANGLE
        ", \"material\": \"n\"}, {" TRIANGLE ", \"material\": \"m\"}]}");
    const uint32_t *index = reading->scene->meshes[0].face_materials;
    const struct zr_material *materials = reading->scene->materials;
    assert_int_equal(materials[index[0]].shading, ZR_SHADING_UNLIT);
    assert_int_equal(materials[index[1]].shading, ZR_SHADING_GOURAUD);
    assert_int_equal(materials[index[2]].shading, ZR_SHADING_FLAT);
    assert_int_equal(materials[index[3]].shading, ZR_SHADING_UNLIT);
    assert_true(materials[index[1]].double_sided && !materials[index[2]].double_sided);
    assert_true(materials[index[3]].base_color.x == 1 && materials[index[0]].base_color.x == 0.7f);
    assert_int_equal(index[1], index[4]);
    assert_int_equal(reading->scene->material_count, 4);
    reading_free(reading);
}

TEST(many_materials_all_find_their_names)
{
    enum { COUNT = 300 };
    static char text[200000];
    char *at = text + sprintf(text, "{\"materials\": [");
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "%s{\"name\": \"m%d\", \"baseColorFactor\": [%.9g,0,0]}", i ? "," : "", i, i / 512.0);
    at += sprintf(at, "], \"polygons\": [");
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "%s{" TRIANGLE ", \"material\": \"m%d\"}", i ? "," : "", i);
    sprintf(at, "]}");
    struct reading *reading = read_scene(text);
    assert_int_equal(reading->scene->material_count, COUNT);
    for (int i = 0; i < COUNT; i++) {
        uint32_t material = reading->scene->meshes[0].face_materials[i];
        assert_true(reading->scene->materials[material].base_color.x == (float)i / 512.0f);
    }
    reading_free(reading);
}

TEST(long_unknown_key_is_cut_at_a_character)
{
    static char rest[3000] = "\"";
    for (int i = 0; i < 1000; i++)
        strcat(rest, "\xC3\xA4");
    strcat(rest, "\": 1");
    struct reading *reading = read_rest(rest);
    const char *pointer = reading->error.items[0].pointer;
    size_t length = strlen(pointer);
    assert_int_equal(reading->status, ZR_BAD_SCENE);
    assert_true(length > 100 && length % 2 == 1 && pointer[0] == '/');
    reading_free(reading);
}

TEST(several_faults_are_all_reported_up_to_the_limit)
{
    struct reading *reading = read_rest("\"shading\": 7, \"version\": 2, \"window\": {\"width\": 1.5}");
    assert_int_equal(reading->status, ZR_BAD_SCENE);
    assert_int_equal(reading->error.count, 3);
    reading_free(reading);
    static char text[100000] = "{\"polygons\": [0";
    size_t used = strlen(text);
    for (int i = 0; i < 10000; i++)
        used += (size_t)sprintf(text + used, ",{}");
    sprintf(text + used, "]}");
    reading = read_text(ZR_FORMAT_JSON, text);
    assert_int_equal(reading->error.count, ZR_ERROR_ITEMS);
    assert_string_equal(reading->error.items[19].pointer, "/polygons/19");
    reading_free(reading);
}

TEST(what_this_version_does_may_be_said)
{
    struct reading *reading =
        read_rest("\"version\": 1, \"samples\": 1, \"algorithm\": \"halfspace\", \"colorManagement\": \"none\"");
    assert_read(reading);
    reading_free(reading);
}

TEST(every_algorithm_is_chosen_by_its_name)
{
    static const char *const words[ZR_ALGORITHM_COUNT] = {"halfspace", "edgelist", "trapezoid", "scanline", "painter"};
    for (int i = 0; i < ZR_ALGORITHM_COUNT; i++) {
        char text[64];
        snprintf(text, sizeof text, "\"algorithm\": \"%s\"", words[i]);
        struct reading *reading = read_rest(text);
        assert_read(reading);
        assert_int_equal(reading->scene->algorithm, i);
        reading_free(reading);
    }
}

TEST(window_limits_are_named)
{
    struct reading *reading = read_rest("\"window\": {\"width\": 8192, \"height\": 4096}, \"outputs\": "
                                        "[{\"channel\": \"color\"}, {\"channel\": \"info\"}]");
    assert_read(reading);
    assert_int_equal(reading->scene->views[0].width, 8192);
    reading_free(reading);
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    static const char text[] =
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff0000\", \"colors\": [[1,1,1],[1,1,1],[1,1,1]], "
        "\"normals\": [[0,0,1],[0,0,1],[0,0,1]]}], \"lights\": [], \"outputs\": [{\"channel\": \"depth\"}],"
        "\"meshes\": [{\"name\": \"m\", " POSITIONS ", \"faces\": [[0,1,2]]}]}";
    assert_true(smallest_ceiling((struct zr_request){.channel = "depth"}, text, strlen(text), 65536) > 1024);
}

/* In a large list and outside of one. */
TEST(colors_have_names_and_short_forms)
{
    static const struct {
        const char *text;
        int rgba[4];
    } cases[] = {{"red", {255, 0, 0, 255}},
                 {"RebeccaPurple", {0x66, 0x33, 0x99, 255}},
                 {"LIGHTGOLDENRODYELLOW", {250, 250, 210, 255}},
                 {"tan", {210, 180, 140, 255}},
                 {"aliceblue", {240, 248, 255, 255}},
                 {"yellowgreen", {154, 205, 50, 255}},
                 {"grey", {128, 128, 128, 255}},
                 {"#f0A", {255, 0, 170, 255}},
                 {"#1234", {17, 34, 51, 68}},
                 {"#11223344", {17, 34, 51, 68}}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "{\"background\": \"%s\", \"polygons\": [{" TRIANGLE ", \"color\": \"%s\"}, {" TRIANGLE
                 ", \"colors\": [\"%s\", [0,0,0], \"%s\"]}]}",
                 cases[i].text, cases[i].text, cases[i].text, cases[i].text);
        struct reading *reading = read_scene(text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        const zr_vec4 *colors[] = {&reading->scene->background, &mesh->face_colors[0], &mesh->colors[3],
                                   &mesh->colors[5]};
        for (size_t k = 0; k < sizeof colors / sizeof colors[0]; k++) {
            const float got[4] = {colors[k]->x, colors[k]->y, colors[k]->z, colors[k]->w};
            for (int channel = 0; channel < 4; channel++)
                assert_true(got[channel] == (float)cases[i].rgba[channel] * (1.0f / 255.0f));
        }
        reading_free(reading);
    }
    static const char *const wrong[] = {"",     "#",  "#12",  "#12345",     "#1234567", "#xyz",
                                        "redd", "re", "red ", "\\u0000red", "#ff g",    "lightgoldenrodyellowish"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "{\"polygons\": [{" TRIANGLE ", \"color\": \"%s\"}]}", wrong[i]);
        struct reading *reading = read_text(ZR_FORMAT_JSON, text);
        assert_int_equal(reading->status, ZR_BAD_SCENE);
        reading_free(reading);
    }
}

TEST(byte_order_mark_is_passed_over)
{
    struct reading *reading = read_scene("\xEF\xBB\xBF{" POLYGONS "}");
    assert_int_equal(reading->scene->meshes[0].face_count, 1);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
