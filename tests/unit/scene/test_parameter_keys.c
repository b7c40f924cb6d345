/* A parameter of the query is a key of a scene. */
#include <stdio.h>
#include <string.h>

#include "input/scene/json_objects.h"
#include "scene/output.h"
#include "support/tests.h"
#include "unit/common/triangle_query.h"

static const char SCENE[] = "{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0.5]], \"faces\": [[0,1,2]], "
                            "\"doubleSided\": true}]";

static bool is_same_light(const struct zr_light *a, const struct zr_light *b)
{
    return a->type == b->type && a->has_shadows == b->has_shadows && a->lit == b->lit &&
           a->camera_frame == b->camera_frame && is_same_rgb(a->direction, b->direction) &&
           is_same_rgb(a->color, b->color) && is_same_rgb(a->ground, b->ground) &&
           is_same_rgb(a->position, b->position) && a->range == b->range;
}

static bool is_same_section(const struct zr_sections *a, const struct zr_sections *b)
{
    bool is_same = a->count == b->count && a->is_corner == b->is_corner && a->has_hatch == b->has_hatch;
    for (uint32_t k = 0; is_same && k < a->count; k++)
        is_same = a->planes[k].keep == b->planes[k].keep && a->planes[k].fraction == b->planes[k].fraction &&
                  memcmp(a->planes[k].normal, b->planes[k].normal, sizeof a->planes[k].normal) == 0;
    return is_same;
}

TEST(bare_mesh_is_a_scene_with_the_keys_of_the_query)
{
    static const struct {
        struct zr_request request;
        const char *keys;
    } cases[] = {
        {{.edges = "true"}, "\"edges\": true"},
        {{.edges = "0", .look = "technical"}, "\"edges\": false, \"look\": \"technical\""},
        {{.occlusion = "false"}, "\"occlusion\": false"},
        {{.groundShadow = "false"}, "\"groundShadow\": false"},
        {{.exposure = "1.5"}, "\"exposure\": 1.5"},
        {{.exposure = "+.5", .look = "outdoor"}, "\"exposure\": 0.5, \"look\": \"outdoor\""},
        {{.toneMapping = "none"}, "\"toneMapping\": \"none\""},
        {{.environment = "outdoor"}, "\"environment\": \"outdoor\""},
        {{.environment = "false"}, "\"environment\": false"},
        {{.creaseDegrees = "60"}, "\"creaseDegrees\": 60"},
        {{.lineWidth = "3", .outline = "red"}, "\"lineWidth\": 3, \"outline\": \"red\""},
        {{.samples = "4", .shading = "gooch"}, "\"samples\": 4, \"shading\": \"gooch\""},
        {{.ambient = "#808080"}, "\"ambient\": \"#808080\""},
        {{.lightDirection = "0,-1,-1"}, "\"lights\": [{\"type\": \"directional\", \"direction\": [0,-1,-1]}]"},
        {{.light = "point", .lightPosition = "1,2,3", .lightColor = "red", .lightIntensity = "2"},
         "\"lights\": [{\"type\": \"point\", \"position\": [1,2,3], \"color\": \"red\", \"intensity\": 2}]"},
        {{.lightDirection = "0,0,-1", .shadows = "true"},
         "\"lights\": [{\"type\": \"directional\", \"direction\": [0,0,-1], \"shadows\": true}]"},
        {{.algorithm = "scanline"}, "\"algorithm\": \"scanline\""},
        {{.edges = "true", .look = "textbook"}, "\"edges\": true, \"look\": \"textbook\""},
        {{.section = "x"}, "\"sections\": {\"planes\": [{\"axis\": \"x\"}]}"},
        {{.section = "x:0.12345678901234567:positive,y:0.12345678901234567:negative,z:0.12345678901234567:positive,"
                     "x:0.12345678901234567:negative,y:0.12345678901234567:positive,z:0.12345678901234567:negative"},
         "\"sections\": {\"planes\": [{\"axis\": \"x\", \"fraction\": 0.12345678901234567, \"keep\": \"positive\"}, "
         "{\"axis\": \"y\", \"fraction\": 0.12345678901234567, \"keep\": \"negative\"}, "
         "{\"axis\": \"z\", \"fraction\": 0.12345678901234567, \"keep\": \"positive\"}, "
         "{\"axis\": \"x\", \"fraction\": 0.12345678901234567, \"keep\": \"negative\"}, "
         "{\"axis\": \"y\", \"fraction\": 0.12345678901234567, \"keep\": \"positive\"}, "
         "{\"axis\": \"z\", \"fraction\": 0.12345678901234567, \"keep\": \"negative\"}]}"},
        {{.section = "y:0.25:positive,z", .sectionCorner = "true", .sectionHatch = "false"},
         "\"sections\": {\"planes\": [{\"axis\": \"y\", \"fraction\": 0.25, \"keep\": \"positive\"}, {\"axis\": "
         "\"z\"}], "
         "\"corner\": true, \"hatch\": false}"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1024];
        const bool has_look = cases[i].request.look != NULL;
        snprintf(text, sizeof text, "%s, %s%s}", SCENE, cases[i].keys, has_look ? "" : ", \"look\": \"studio\"");
        struct reading *bare = read_triangle(cases[i].request), *scene = read_text(ZR_FORMAT_JSON, text);
        assert_read(scene);
        const struct zr_scene *a = bare->scene, *b = scene->scene;
        print_message("%s\n", cases[i].keys);
        assert_true(is_same_picture(a->picture, b->picture));
        assert_true(zr_vec4_equal(a->background, b->background) && a->algorithm == b->algorithm);
        assert_true(is_same_rgb(a->ambient, b->ambient));
        assert_true(is_same_section(&a->sections, &b->sections));
        assert_int_equal(a->light_count, b->light_count);
        for (uint32_t k = 0; k < a->light_count; k++)
            assert_true(is_same_light(&a->lights[k], &b->lights[k]));
        const struct zr_material *ma = &a->materials[0], *mb = &b->materials[0];
        assert_true(ma->shading == mb->shading && zr_vec4_equal(ma->base_color, mb->base_color));
        assert_true(ma->outline == mb->outline && zr_vec4_equal(ma->outline_color, mb->outline_color));
        assert_true(ma->double_sided && mb->double_sided);
        reading_free(bare);
        reading_free(scene);
    }
}

TEST(material_of_a_query_keeps_what_it_does_not_name)
{
    struct reading *reading = read_triangle((struct zr_request){.metallic = "1", .roughness = "0.25"});
    const struct zr_material *material = &reading->scene->materials[0], *look = &reading->scene->look->material;
    assert_true(material->metallic == 1 && material->roughness == 0.25f && material->double_sided);
    assert_true(zr_vec4_equal(material->base_color, look->base_color));
    reading_free(reading);
    reading = read_triangle((struct zr_request){.look = "textbook", .doubleSided = "false"});
    material = &reading->scene->materials[0];
    assert_true(zr_vec4_equal(material->base_color, reading->scene->look->material.base_color));
    assert_false(material->double_sided);
    reading_free(reading);
    reading = read_triangle((struct zr_request){.padding = "0.25"});
    const struct zr_view *view = &reading->scene->views[0];
    assert_true(view->fit_padding == 0.25f && view->azimuth_degrees == 35 && view->elevation_degrees == 28);
    assert_int_equal(view->projection, ZR_PROJECTION_PERSPECTIVE);
    reading_free(reading);
}

/* The field that a pointer leads to; NULL: it leads to none. */
static const struct zr_json_field *field_of(const char *pointer)
{
    const struct zr_json_object *object = &zr_json_object_scene;
    const struct zr_json_field *field = NULL;
    char copy[128];
    snprintf(copy, sizeof copy, "%s", pointer);
    for (char *key = strtok(copy, "/"); key; key = strtok(NULL, "/")) {
        if (strcmp(key, "0") == 0) continue;
        if (!object) return NULL;
        field = NULL;
        for (size_t i = 0; i < object->count; i++)
            if (strcmp(object->fields[i].key, key) == 0) field = &object->fields[i];
        if (!field) return NULL;
        object = field->object;
    }
    return field;
}

TEST(each_parameter_leads_to_a_key_that_has_what_its_kind_needs)
{
    static const struct {
        const char *name, *pointer, *kind, *help;
    } rows[] = {
#define ROW(name, pointer, scope, kind, help) {#name, pointer, #kind, help},
        ZR_PARAMETER_ROWS(ROW)
#undef ROW
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *kind = rows[i].kind;
        if (strncmp(rows[i].pointer, "/query/", strlen("/query/")) == 0) continue;
        const struct zr_json_field *field = field_of(rows[i].pointer);
        if (!field || !field->read) fail_msg("%s leads nowhere: %s", rows[i].name, rows[i].pointer);
        if (strcmp(kind, "NUMBER") == 0 || strcmp(kind, "DEGREES") == 0 || strcmp(kind, "PIXELS") == 0)
            if (!(field->low < field->high)) fail_msg("%s has no range", rows[i].name);
        if (strcmp(kind, "COUNT") == 0) assert_non_null(field->words);
        for (int k = 0; field->words && k < field->words->count && !strstr(rows[i].help, "others"); k++)
            if (!strstr(rows[i].help, field->words->words[k]))
                fail_msg("the help of %s lacks %s", rows[i].name, field->words->words[k]);
    }
}

RUN_TESTS(NULL, NULL)
