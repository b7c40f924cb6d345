/* Reads 3MF: meshes, instances, colours and warnings. Refusals: tests/refusals/3mf.txt. */
#include "input/formats/formats.h"
#include "scene/texture.h"
#include "support/pictures/png.h"
#include "support/tests.h"
#include "unit/common/threemf_texts.h"

#define MATERIAL   "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
#define PRODUCTION "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "

TEST(a_model_is_read)
{
    struct reading *reading =
        read_model("<model " CORE "unit=\"inch\"><resources><object id=\"1\" name=\"a &amp; b\">" MESH
                   "</object></resources><build><item objectid=\"1\"/></build></model>");
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(reading->scene->mesh_count, 1);
    assert_int_equal(reading->scene->instance_count, 1);
    assert_int_equal(reading->scene->warning_count, 0);
    assert_string_equal(mesh->name, "a & b");
    assert_string_equal(reading->scene->file.unit, "inch");
    assert_int_equal(mesh->position_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_true(mesh->positions[1].x == 1.5f && mesh->positions[2].y == 1.0f && mesh->positions[2].z == 0.5f);
    assert_null(mesh->colors);
    assert_null(mesh->face_colors);
    assert_true(reading->scene->materials[mesh->material].double_sided);
    reading_free(reading);
}

TEST(members_of_3mf_inflate_to_the_limit_and_no_further)
{
    static const char model[] = "<model " CORE "><resources><object id=\"1\">" MESH
                                "</object></resources><build><item objectid=\"1\"/></build></model>";
    static const struct zip_entry parts[] = {{"Metadata/model_settings.config", "<config/>", 9, true},
                                             {"3D/3dmodel.model", model, sizeof model - 1, true}};
    const size_t all = sizeof model - 1 + parts[0].size;
    size_t size, directory;
    unsigned char *file = zip_file(parts, 2, &size, &directory);
    for (size_t less = 0; less < 2; less++) {
        struct zr_quick quick = {.image_pixels_max = 1, .node_visits_max = 10, .array_bytes_max = all - less};
        struct zr_limits limits = zr_limits_default();
        limits.unpacked_bytes_max = all - less;
        struct reading *reading =
            read_request((struct zr_request){.format = ZR_FORMAT_3MF}, file, size, limits, (size_t)1 << 26);
        if (less) assert_complaint(reading, ZR_BAD_SCENE, "", "inflate to more than");
        assert_int_equal(reading->status, less ? ZR_BAD_SCENE : ZR_OK);
        reading_free(reading);
        reading = read_request((struct zr_request){.format = ZR_FORMAT_3MF, .quick = &quick}, file, size,
                               zr_limits_default(), (size_t)1 << 26);
        assert_int_equal(reading->status, less ? ZR_CANCELLED : ZR_OK);
        assert_int_equal(quick.is_exceeded, less);
        reading_free(reading);
    }
    free(file);
}

TEST(the_only_model_is_read_without_relationships)
{
    static const char model[] = "<model " CORE "><resources><object id=\"1\">" MESH
                                "</object></resources><build><item objectid=\"1\"/></build></model>";
    const struct zip_entry parts[] = {{"[Content_Types].xml", "<Types/>", 8, true},
                                      {"3D/3dmodel.model", model, sizeof model - 1, true},
                                      {"3D/other.model", model, sizeof model - 1, true}};
    for (size_t count = 2; count < 4; count++) {
        size_t size, directory;
        unsigned char *file = zip_file(parts, count, &size, &directory);
        struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_3MF, .look = "textbook"}, file,
                                               size, zr_limits_default(), (size_t)1 << 26);
        assert_int_equal(zr_format_of_bytes((const char *)file, size), count == 2 ? ZR_FORMAT_3MF : ZR_FORMAT_ZIP);
        free(file);
        if (count == 2) {
            assert_read(reading);
            assert_int_equal(reading->scene->mesh_count, 1);
            assert_true(warns(reading, "3MF: no relationship of _rels/.rels leads to a 3D model; '3D/3dmodel.model' is "
                                       "drawn, the only one"));
        } else {
            assert_int_equal(reading->status, ZR_BAD_SYNTAX);
        }
        reading_free(reading);
    }
}

TEST(items_and_components_are_placed)
{
    struct reading *reading = read_model(
        "<model " CORE "><resources><object id=\"7\" name=\"leaf\">" MESH "</object><object id=\"3\">" MESH "</object>"
        "<object id=\"8\"><components><component objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>"
        "<component objectid=\"7\" transform=\"0 1 0 -1 0 0 0 0 1 0 20 0\"/></components></object></resources>"
        "<build><item objectid=\"8\" transform=\"2 0 0 0 2 0 0 0 2 0 0 5\"/><item objectid=\"8\"/></build></model>");
    static const float places[][3] = {{20, 0, 5}, {0, 40, 5}, {10, 0, 0}, {0, 20, 0}};
    assert_read(reading);
    assert_int_equal(reading->scene->mesh_count, 1); /* object 3 is not placed */
    assert_int_equal(reading->scene->instance_count, 4);
    for (size_t i = 0; i < 4; i++) {
        const struct zr_instance *instance = &reading->scene->instances[i];
        assert_string_equal(instance->node, "leaf");
        for (int axis = 0; axis < 3; axis++)
            assert_true(instance->object_to_world.m[12 + axis] == places[i][axis]);
    }
    /* the second instance rotates x to y and scales by 2 */
    assert_true(reading->scene->instances[1].object_to_world.m[1] == 2.0f);
    reading_free(reading);
}

/* The middle of far coordinates and transforms is subtracted in double. Unused vertices are ignored. */
TEST(middle_of_far_scenes_is_their_origin)
{
    static const char far[] =
        "<mesh><vertices><vertex x=\"408200.25\" y=\"4080920.5\" z=\"0\"/><vertex x=\"408210.25\" y=\"4080920.5\" "
        "z=\"0\"/><vertex x=\"408200.25\" y=\"4080930.5\" z=\"4\"/><vertex x=\"0\" y=\"-1e15\" "
        "z=\"1\"/></vertices><triangles>" TRIANGLE "</triangles></mesh>";
    static const zr_vec4 want[] = {{-5, -5, -2, 1}, {5, -5, -2, 1}, {-5, 5, 2, 1}};
    char model[4096];
    snprintf(model, sizeof model,
             "<model " CORE "><resources><object id=\"1\">%s</object></resources><build><item objectid=\"1\"/>"
             "</build></model>",
             far);
    struct reading *reading = read_model(model);
    assert_origin(reading, 408205.25, 4080925.5, 2);
    assert_memory_equal(reading->scene->meshes[0].positions, want, sizeof want);
    assert_true(reading->scene->instances[0].object_to_world.m[13] == 0.0f);
    reading_free(reading);
    /* a transform back to the origin, and a far transform */
    snprintf(model, sizeof model,
             "<model " CORE "><resources><object id=\"1\">%s</object><object id=\"2\">" MESH "</object></resources>"
             "<build><item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 -408205.25 -4080925.5 0\"/>"
             "<item objectid=\"2\"/></build></model>",
             far);
    reading = read_model(model);
    assert_read(reading);
    assert_null(reading->scene->origin);
    assert_true(reading->scene->instances[0].object_to_world.m[12] == 0.0f);
    assert_true(reading->scene->instances[0].object_to_world.m[14] == 2.0f);
    reading_free(reading);
    reading = read_model("<model " CORE "><resources><object id=\"1\">" MESH "</object></resources><build>"
                         "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 4080920.125 0 0\"/>"
                         "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 4080924.625 0 0\"/></build></model>");
    assert_origin(reading, 4080923.125, 0.5, 0.25);
    assert_true(reading->scene->instances[0].object_to_world.m[12] == -3.0f);
    assert_true(reading->scene->instances[1].object_to_world.m[12] == 1.5f);
    assert_true(reading->scene->instances[1].object_to_world.m[13] == -0.5f);
    reading_free(reading);
}

TEST(z_is_up)
{
    const char *model = "<model " CORE "><resources><object id=\"1\">" MESH
                        "</object></resources><build><item objectid=\"1\"/></build></model>";
    const struct zip_entry part = {"3D/3dmodel.model", model, strlen(model), false};
    struct reading *reading = read_parts(&part, 1, NULL);
    assert_read(reading);
    assert_true(reading->scene->instances[0].object_to_world.m[9] == 1.0f); /* z to y */
    assert_string_equal(reading->scene->file.up, "z");
    assert_string_equal(reading->scene->file.up_source, "format");
    assert_string_equal(reading->scene->file.unit, "millimetre");
    reading_free(reading);
}

#define COLORS                                                                                                         \
    "<basematerials id=\"1\"><base name=\"r\" displaycolor=\"#FF0000\"/><base name=\"g\" "                             \
    "displaycolor=\"#00FF0080\"/></basematerials><m:colorgroup id=\"2\"><m:color color=\"#0000FF\"/><m:color "         \
    "color=\"#FFFFFF\"/></m:colorgroup>"

TEST(colours_are_of_faces_or_corners)
{
    struct reading *reading = read_model(
        "<model " CORE MATERIAL "><resources>" COLORS "<object id=\"3\" pid=\"1\" pindex=\"0\"><mesh>" VERTICES
        "<triangles>" TRIANGLE "<triangle v1=\"0\" v2=\"1\" v3=\"2\" p1=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" "
        "pid=\"2\" p1=\"0\"/></triangles></mesh>"
        "</object><object id=\"4\"><mesh>" VERTICES "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"2\" "
        "p1=\"0\" p2=\"1\" p3=\"0\"/></triangles></mesh></object>"
        "</resources><build><item objectid=\"3\"/><item objectid=\"4\"/></build></model>");
    assert_read(reading);
    const struct zr_mesh *faces = &reading->scene->meshes[0], *corners = faces + 1;
    assert_null(faces->colors);
    assert_true(faces->face_colors[0].x == 1 && faces->face_colors[0].y == 0 && faces->face_colors[0].w == 1);
    assert_true(faces->face_colors[1].y == 1 && faces->face_colors[1].w == 128.0f / 255.0f);
    assert_true(faces->face_colors[2].z == 1);
    assert_int_equal(reading->scene->materials[faces->material].alpha_mode, ZR_ALPHA_BLEND);
    assert_int_equal(reading->scene->materials[corners->material].alpha_mode, ZR_ALPHA_OPAQUE);
    assert_null(corners->face_colors);
    assert_int_equal(corners->position_count, 3);
    assert_true(corners->colors[0].x == 0 && corners->colors[1].x == 1 && corners->positions[1].y == 1.0f);
    assert_true(reading->scene->materials[faces->material].base_color.x == 1.0f);
    reading_free(reading);
}

TEST(parts_named_by_paths_are_read)
{
    const char *root =
        "<model " CORE PRODUCTION "requiredextensions=\"p\"><resources><object id=\"1\"><components>"
        "<component objectid=\"1\" p:path=\"/3D/Objects/a%20b.model\"/></components></object></resources>"
        "<build><item objectid=\"1\"/><item objectid=\"2\" p:path=\"/3d/objects/A b.model\"/></build></model>";
    const char *other =
        "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"UTF-8\"?>\r\n<c:model xmlns:c=\"http://schemas.microsoft.com/"
        "3dmanufacturing/core/2015/02\"><c:resources><c:object id=\"1\"><c:mesh><c:vertices><c:vertex x=\"0\" "
        "y=\"0\" z=\"0\"/><c:vertex x=\"1\" y=\"0\" z=\"0\"/><c:vertex x=\"0\" y=\"1\" z=\"0\"/></c:vertices>"
        "<c:triangles><c:triangle v1=\"0\" v2=\"1\" v3=\"2\"/></c:triangles></c:mesh></c:object>"
        "<object id=\"2\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">" MESH
        "</object></c:resources></c:model>";
    const struct zip_entry parts[] = {{"3D/3dmodel.model", root, strlen(root), true},
                                      {"3D/Objects/a b.model", other, strlen(other), true}};
    struct reading *reading = read_parts(parts, 2, "y");
    assert_read(reading);
    assert_int_equal(reading->scene->mesh_count, 2);
    assert_int_equal(reading->scene->instance_count, 2);
    reading_free(reading);
}

/* Coordinates of a part are converted to the unit of the part that places it. */
TEST(units_of_parts_are_converted)
{
    const char *root = "<model " CORE PRODUCTION "unit=\"centimeter\"><resources/><build><item objectid=\"1\" "
                       "p:path=\"/3D/b.model\" transform=\"0 1 0 -1 0 0 0 0 1 5 6 7\"/></build></model>";
    const char *other =
        "<model " CORE "unit=\"inch\"><resources><object id=\"1\">" MESH "</object></resources></model>";
    const struct zip_entry parts[] = {{"3D/3dmodel.model", root, strlen(root), true},
                                      {"3D/b.model", other, strlen(other), true}};
    struct reading *reading = read_parts(parts, 2, "y");
    assert_read(reading);
    const float *m = reading->scene->instances[0].object_to_world.m;
    assert_true(m[1] == 2.54f && m[4] == -2.54f && m[10] == 2.54f && m[0] == 0.0f);
    assert_true(m[12] == 5.0f && m[13] == 6.0f && m[14] == 7.0f && m[15] == 1.0f);
    assert_true(warns(reading, "1 parts have a different unit from the first"));
    reading_free(reading);
}

TEST(what_is_not_drawn_is_warned_of)
{
    struct reading *reading = read_model(
        "<model " CORE MATERIAL "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" "
        "xmlns:q=\"http://example.org\"><metadata name=\"Title\">x</metadata><resources>\n<s:slicestack id=\"9\"/>"
        "<q:odd/>\n<odd/><m:texture2d id=\"6\" path=\"/a.png\"/><m:texture2dgroup id=\"5\" texid=\"6\"><m:tex2coord "
        "u=\"0\" v=\"0\"/></m:texture2dgroup><object id=\"1\"><mesh>" VERTICES "<triangles>" TRIANGLE
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"5\" p1=\"0\" paint_color=\"8\"/></triangles>"
        "</mesh></object><object id=\"2\" type=\"other\">" MESH "</object></resources>"
        "<build><item objectid=\"1\" printable=\"0\"/><item objectid=\"2\"/></build></model>");
    assert_read(reading);
    assert_int_equal(reading->scene->instance_count, 1);
    assert_true(
        warns(reading, "3MF: 1 elements of slices are not drawn; the first is in 3D/3dmodel.model, line 2: 's"));
    assert_true(warns(reading, "3MF: 1 elements are not known; the first is in 3D/3dmodel.model, line 3: 'odd'"));
    assert_true(warns(reading, "1 textures have no image in the archive"));
    assert_true(warns(reading, "1 triangles are painted"));
    assert_true(warns(reading, "type other are left out"));
    assert_true(warns(reading, "not printable"));
    assert_int_equal(reading->scene->warning_count, 6);
    reading_free(reading);
}

/* ---- materials ---- */

TEST(base_materials_or_colours_are_opaque_if_all_have_alpha_0)
{
    static const char says[] =
        "3MF: 1 objects have only materials or colours of alpha 0, and are drawn opaque; the first is in "
        "3D/3dmodel.model, line 2";
    static const struct {
        const char *triangles;
        float alpha; /* of the first triangle */
        bool warns;
    } cases[] = {
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/>", 1, true},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" "
         "p1=\"1\"/>" TRIANGLE,
         1, true},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" "
         "p1=\"2\"/>",
         0, false},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" p1=\"0\"/>", 1, true},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" "
         "p1=\"1\"/>",
         0, false},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" "
         "p1=\"1\"/>",
         1, true},
        {"<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/><triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" "
         "p1=\"0\"/>",
         1, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char model[2048];
        snprintf(model, sizeof model,
                 "<model " CORE MATERIAL "><resources><basematerials id=\"1\"><base name=\"a\" "
                 "displaycolor=\"#FF000000\"/><base name=\"b\" displaycolor=\"#00FF0000\"/><base name=\"c\" "
                 "displaycolor=\"#0000FF\"/></basematerials><m:colorgroup id=\"2\"><m:color color=\"#FF000000\"/>"
                 "<m:color color=\"#FF000080\"/></m:colorgroup><object id=\"9\"><mesh>" VERTICES
                 "<triangles>\n%s</triangles></mesh></object></resources><build><item objectid=\"9\"/></build></model>",
                 cases[i].triangles);
        struct reading *reading = read_model(model);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        if (mesh->face_colors[0].w != cases[i].alpha || warns(reading, says) != cases[i].warns)
            fail_msg("case %zu: alpha %g, %s", i, (double)mesh->face_colors[0].w,
                     reading->scene->warning_count ? reading->scene->warnings[0] : "");
        assert_true(mesh->face_colors[0].x == 1.0f && mesh->face_colors[0].y == 0.0f);
        reading_free(reading);
    }
}

#define GROUPS                                                                                                         \
    "<basematerials id=\"1\"><base name=\"r\" displaycolor=\"#FF0000\"/><base name=\"b\" displaycolor=\"#0000FF\"/>"   \
    "</basematerials><m:texture2d id=\"2\" path=\"/3D/Texture/a%%20b.png\" contenttype=\"image/png\" "                 \
    "tilestyleu=\"mirror\" tilestylev=\"none\" filter=\"nearest\"/><m:texture2dgroup id=\"3\" texid=\"2\">"            \
    "<m:tex2coord u=\"0\" v=\"0\"/><m:tex2coord u=\"1\" v=\"0.25\"/><m:tex2coord u=\"0\" v=\"2\"/></m:texture2dgroup>" \
    "<m:compositematerials id=\"4\" matid=\"1\" matindices=\"0 1\"><m:composite values=\"0.5 0.5\"/><m:composite "     \
    "values=\"3 1\"/></m:compositematerials><m:multiproperties id=\"5\" pids=\"1 3\" blendmethods=\"multiply\">"       \
    "<m:multi pindices=\"1 2\"/><multi pindices=\"1 1\"/></m:multiproperties>"

/* Reads a mesh with these triangles and an image of one texel, opaque or translucent. */
static struct reading *read_painted(const char *triangles, uint8_t alpha)
{
    const uint8_t texel[4] = {10, 20, 30, alpha};
    char model[4096];
    size_t size;
    snprintf(model, sizeof model,
             "<model " CORE MATERIAL "><resources>" GROUPS "<object id=\"9\"><mesh>" VERTICES
             "<triangles>%s</triangles></mesh></object></resources><build><item objectid=\"9\"/></build></model>",
             triangles);
    uint8_t *image = png_memory_write(texel, 1, 1, &size);
    assert_non_null(image);
    const struct zip_entry parts[] = {{"3D/3dmodel.model", model, strlen(model), true},
                                      {"3D/Texture/a b.png", (const char *)image, size, false}};
    struct reading *reading = read_parts(parts, 2, "y");
    free(image);
    assert_read(reading);
    return reading;
}

#define PAINTED(properties) "<triangle v1=\"0\" v2=\"1\" v3=\"2\" " properties "/>"

TEST(textures_of_the_package_are_drawn)
{
    struct reading *reading = read_painted(PAINTED("pid=\"3\" p1=\"0\" p2=\"1\" p3=\"2\""), 255);
    const struct zr_scene *scene = reading->scene;
    const struct zr_mesh *mesh = &scene->meshes[0];
    const struct zr_material *material = &scene->materials[mesh->material];
    assert_int_equal(scene->image_count, 1);
    assert_int_equal(scene->texture_count, 1);
    assert_int_equal(material->textures[ZR_TEXTURE_BASE_COLOR], 1);
    assert_int_equal(material->alpha_mode, ZR_ALPHA_OPAQUE);
    assert_null(mesh->face_materials);
    assert_null(mesh->colors);
    const struct zr_texture *texture = &scene->textures[0];
    assert_int_equal(texture->wrap_s, ZR_WRAP_MIRROR);
    assert_int_equal(texture->wrap_t, ZR_WRAP_CLAMP);
    assert_int_equal(texture->magnify, ZR_FILTER_NEAREST);
    float at[2];
    zr_texture_transform(texture, mesh->texcoords[1].x, mesh->texcoords[1].y, at);
    assert_true(at[0] == 1.0f && at[1] == 0.75f); /* v points up */
    assert_int_equal(scene->warning_count, 1);
    assert_true(warns(reading, "1 triangles extend beyond textures of the tilestyle none"));
    reading_free(reading);
    reading = read_painted(PAINTED("pid=\"3\" p1=\"0\"") PAINTED("pid=\"1\" p1=\"0\"") PAINTED(""), 77);
    mesh = &reading->scene->meshes[0];
    assert_non_null(mesh->face_materials);
    assert_true(mesh->colors[0].x == 1.0f && mesh->colors[0].y == 1.0f && mesh->colors[3].y == 0.0f);
    assert_int_equal(reading->scene->materials[mesh->face_materials[0]].alpha_mode, ZR_ALPHA_BLEND);
    assert_int_equal(reading->scene->materials[mesh->face_materials[1]].alpha_mode, ZR_ALPHA_OPAQUE);
    assert_int_equal(reading->scene->materials[mesh->face_materials[1]].textures[ZR_TEXTURE_BASE_COLOR], 0);
    assert_int_equal(mesh->face_materials[1], mesh->face_materials[2]);
    reading_free(reading);
}

TEST(composites_and_multiproperties_are_mixed)
{
    struct reading *reading = read_painted(PAINTED("pid=\"4\" p1=\"0\" p2=\"1\" p3=\"1\""), 255);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(reading->scene->image_count, 0); /* not used */
    assert_true(mesh->colors[0].x == 128.0f / 255.0f && mesh->colors[0].z == 128.0f / 255.0f);
    assert_true(mesh->colors[1].x == 191.0f / 255.0f && mesh->colors[1].z == 64.0f / 255.0f);
    reading_free(reading);
    reading = read_painted(PAINTED("pid=\"5\" p1=\"0\" p2=\"1\" p3=\"0\""), 255);
    mesh = &reading->scene->meshes[0];
    assert_true(mesh->colors[0].x == 0.0f && mesh->colors[0].z == 1.0f); /* blue times the texture */
    assert_true(mesh->texcoords[0].y == 2.0f && mesh->texcoords[1].y == 0.25f);
    assert_int_equal(reading->scene->texture_count, 1);
    reading_free(reading);
}

/* ---- packages ---- */

/* A required extension that adds to triangles is warned of. */
TEST(required_extensions_are_warned_of)
{
    struct reading *reading =
        read_model("<model " CORE "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" "
                   "requiredextensions=\"s\"><resources><object id=\"1\">" MESH "</object></resources><build>"
                   "<item objectid=\"1\"/></build></model>");
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 1);
    assert_true(warns(reading, "1 required extensions are not read, so parts may be missing"));
    assert_true(warns(reading, "'slices'"));
    reading_free(reading);
}

/* Components that double at each of 40 levels are counted before any instance is made. */
TEST(exponential_components_are_foretold)
{
    static char model[1 << 14];
    int used = snprintf(model, sizeof model, "<model " CORE "><resources><object id=\"1\">" MESH "</object>");
    for (int i = 2; i < 42; i++)
        used += snprintf(model + used, sizeof model - (size_t)used,
                         "<object id=\"%d\"><components><component objectid=\"%d\"/><component objectid=\"%d\"/>"
                         "</components></object>",
                         i, i - 1, i - 1);
    snprintf(model + used, sizeof model - (size_t)used, "</resources><build><item objectid=\"41\"/></build></model>");
    struct reading *reading = read_model(model);
    assert_complaint(reading, ZR_BAD_SCENE, "", "the build places more than the limit of 100000 meshes");
    reading_free(reading);
}

/* An end tag within a comment makes the room for triangles too small at first. */
TEST(end_tags_in_comments_end_nothing)
{
    struct reading *reading =
        read_model("<model " CORE "><resources><object id=\"1\"><mesh>" VERTICES
                   "<triangles><!-- </triangles> -->" TRIANGLE TRIANGLE
                   "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>");
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].face_count, 2);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
