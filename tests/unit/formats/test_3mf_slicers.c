/* Reads 3MF of slicers: filaments, paint, ranges of triangles. */
#include <stdio.h>
#include <string.h>

#include "support/tests.h"
#include "unit/common/threemf_texts.h"

static struct reading *read_sliced(const char *model, const char *project, const char *settings, bool is_prusa)
{
    const struct zip_entry parts[] = {
        {"3D/3dmodel.model", model, strlen(model), true},
        {is_prusa ? "Metadata/Slic3r_PE.config" : "Metadata/project_settings.config", project, strlen(project), true},
        {is_prusa ? "Metadata/Slic3r_PE_model.config" : "Metadata/model_settings.config", settings, strlen(settings),
         true}};
    struct reading *reading = read_parts(parts, 3, "y");
    assert_read(reading);
    return reading;
}

static void assert_face(const struct zr_mesh *mesh, uint32_t face, float r, float g, float b)
{
    assert_non_null(mesh->face_colors);
    const zr_vec4 c = mesh->face_colors[face];
    if (c.x != r || c.y != g || c.z != b || c.w != 1.0f)
        fail_msg("face %u: %g %g %g %g", face, (double)c.x, (double)c.y, (double)c.z, (double)c.w);
}

#define SQUARE                                                                                                         \
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"4\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"4\" "       \
    "z=\"0\"/></vertices><triangles>"
#define TRIANGLE_OF(attributes) "<triangle v1=\"0\" v2=\"1\" v3=\"2\" " attributes "/>"

/* Parts have the filaments of their extruders. Paint overrides them and cuts triangles. Modifiers are left out. */
TEST(filaments_and_paint_of_slicers_are_colours)
{
    const char project[] = "{\"filament_colour\": [\"#FF0000\", \"#0000FFFF\", \"#00FF00\"], \"other\": \"#FFFFFF\"}";
    const char settings[] =
        "<config><object id=\"3\"><metadata key=\"extruder\" value=\"1\"/><part id=\"1\" subtype=\"normal_part\">"
        "<metadata key=\"extruder\" value=\"2\"/></part><part id=\"2\" subtype=\"modifier_part\"/></object></config>";
    struct reading *reading = read_sliced(
        "<model " CORE "><resources><object id=\"1\">" SQUARE TRIANGLE_OF("") TRIANGLE_OF("paint_color=\"4\"")
            TRIANGLE_OF("paint_color=\"0C0483\"") TRIANGLE_OF("paint_color=\"43\"") TRIANGLE_OF(
                "paint_color=\"0D\"") "</triangles></mesh></object>"
                                      "<object id=\"2\">" MESH
                                      "</object><object id=\"3\"><components><component objectid=\"1\"/><component "
                                      "objectid=\"2\"/></components></object><object id=\"4\">" MESH
                                      "</object></resources><build>"
                                      "<item objectid=\"3\"/><item objectid=\"4\"/></build></model>",
        project, settings, false);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(reading->scene->mesh_count, 2);
    assert_int_equal(mesh->face_count, 8);
    assert_face(mesh, 0, 0, 0, 1); /* the part's filament */
    assert_face(mesh, 1, 1, 0, 0); /* painted */
    assert_face(mesh, 2, 0, 0, 1); /* the piece in the middle */
    assert_true(mesh->positions[6].x == 2.0f && mesh->positions[6].y == 0.0f && mesh->positions[7].y == 2.0f);
    assert_face(mesh, 3, 1, 0, 0);
    assert_true(mesh->positions[11].x == 0.0f && mesh->positions[11].y == 2.0f);
    assert_face(mesh, 4, 0, 0, 1); /* not painted */
    assert_face(mesh, 5, 0, 1, 0); /* the third extruder, written in two digits */
    assert_face(mesh, 6, 0, 0, 1); /* wrong paint: cut off */
    assert_face(mesh, 7, 0, 0, 1); /* wrong paint: a corner 3 */
    assert_face(&reading->scene->meshes[1], 0, 1, 0, 0);
    assert_int_equal(reading->scene->warning_count, 2);
    assert_true(warns(reading, "1 parts or triangles are modifiers of a slicer, and are left out"));
    assert_true(warns(reading, "2 triangles have unknown paint"));
    reading_free(reading);
}

TEST(ranges_of_triangles_have_the_settings_of_a_slicer)
{
    const char config[] = "; a = b\n; extruder_colour = \"\"\n; filament_colour = #FF8000;#0000FF\n; z = #000000\n";
    const char settings[] =
        "<config><object id=\"1\"><metadata type=\"object\" key=\"extruder\" value=\"2\"/><volume firstid=\"0\" "
        "lastid=\"0\"><metadata type=\"volume\" key=\"volume_type\" value=\"ModelPart\"/><metadata type=\"volume\" "
        "key=\"extruder\" value=\"1\"/></volume><volume firstid=\"1\" lastid=\"2\"><metadata type=\"volume\" "
        "key=\"volume_type\" value=\"ParameterModifier\"/></volume></object></config>";
    struct reading *reading =
        read_sliced("<model " CORE "><resources><object id=\"1\">" SQUARE TRIANGLE TRIANGLE TRIANGLE TRIANGLE
                    "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>",
                    config, settings, true);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->face_count, 2);
    assert_face(mesh, 0, 1, 128.0f / 255.0f, 0);
    assert_face(mesh, 1, 0, 0, 1);
    assert_true(warns(reading, "2 parts or triangles are modifiers"));
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
