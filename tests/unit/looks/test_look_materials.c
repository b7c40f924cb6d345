/* Looks that are a material: what they replace in model files, and what stays. */
#include "scene/looks.h"
#include "support/input/mtl_pictures.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

#define FILE_OF(name_, text)                                                                                           \
    {                                                                                                                  \
        .name = (name_), .bytes = (text), .size = sizeof(text) - 1                                                     \
    }
#define SQUARE                                                                                                         \
    "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"       \
    "usemtl a\nf 1/1 2/2 3/3 4/4\n"

/* Reads a coloured square whose material has these lines: alone with the query, or named by a scene. */
static struct reading *read_square(struct zr_request request, const char *lines, const char *scene)
{
    char mtl[256];
    snprintf(mtl, sizeof mtl, "newmtl a\n%s\n", lines);
    const struct zr_asset assets[] = {{.name = "m.mtl", .bytes = mtl, .size = strlen(mtl)},
                                      FILE_OF("c.png", PICTURE_COLORS),
                                      FILE_OF("alpha.png", PICTURE_ALPHAS),
                                      FILE_OF("m.obj", SQUARE)};
    const char *bytes = scene ? scene : SQUARE;
    request.format = scene ? ZR_FORMAT_JSON : ZR_FORMAT_OBJ;
    request.assets = assets;
    request.asset_count = sizeof assets / sizeof *assets;
    struct reading *reading = read_request(request, bytes, strlen(bytes), zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    return reading;
}

static const struct zr_material *material_of(const struct reading *reading)
{
    return zr_material_of_face(reading->scene, &reading->scene->meshes[0], 0);
}

static void assert_color(const struct reading *reading, zr_vec3 rgb, float alpha)
{
    const zr_vec4 color = material_of(reading)->base_color;
    assert_true(color.x == rgb.x && color.y == rgb.y && color.z == rgb.z && color.w == alpha);
}

static zr_vec3 color_of(const char *look)
{
    const zr_vec4 color = zr_look_find(look)->material.base_color;
    return (zr_vec3){color.x, color.y, color.z};
}

static const zr_vec3 red = {1, 0, 0}, blue = {0, 0, 1};

TEST(looks_that_are_a_material_replace_those_of_files)
{
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look *look = &zr_looks[i];
        struct reading *reading =
            read_square((struct zr_request){.look = look->name}, "Kd 1 0 0\nKe 0 1 0\nPm 0.5\nPr 0.2", NULL);
        const struct zr_material *got = material_of(reading);
        assert_color(reading, look->is_material ? color_of(look->name) : red, 1);
        assert_true((got->metallic == 0.5f) == !look->is_material && (got->roughness == 0.2f) == !look->is_material);
        assert_true((got->emissive.y == 1) == !look->is_material);
        assert_true((reading->scene->meshes[0].colors == NULL) == look->is_material);
        reading_free(reading);
    }
}

TEST(the_query_and_the_scene_override_the_look)
{
    struct reading *reading = read_square((struct zr_request){.look = "clay", .color = "blue"}, "Kd 1 0 0", NULL);
    assert_color(reading, blue, 1);
    reading_free(reading);
    reading = read_square((struct zr_request){.look = "metal", .roughness = "0.1"}, "Kd 1 0 0\nPr 0.2", NULL);
    assert_true(material_of(reading)->roughness == 0.1f && material_of(reading)->metallic == 1);
    reading_free(reading);
    reading = read_square((struct zr_request){.size = 0}, "Kd 1 0 0",
                          "{\"look\": \"clay\", \"materials\": [{\"name\": \"b\", \"baseColorFactor\": [0, 0, 1]}], "
                          "\"meshes\": [{\"asset\": \"m.obj\", \"material\": \"b\"}]}");
    assert_color(reading, blue, 1);
    reading_free(reading);
}

TEST(materials_are_kept_if_the_request_says_so)
{
    static const char *const scenes[] = {
        NULL, "{\"look\": \"clay\", \"materials\": \"keep\", \"meshes\": [{\"asset\": \"m.obj\"}]}"};
    for (int i = 0; i < 2; i++) {
        struct zr_request request = {.size = 0};
        if (!scenes[i]) request.look = "clay", request.materials = "keep";
        struct reading *reading = read_square(request, "Kd 1 0 0", scenes[i]);
        assert_color(reading, red, 1);
        assert_non_null(reading->scene->meshes[0].colors);
        reading_free(reading);
    }
    struct reading *reading = read_square((struct zr_request){.size = 0}, "Kd 1 0 0",
                                          "{\"look\": \"clay\", \"meshes\": [{\"asset\": \"m.obj\"}]}");
    assert_color(reading, color_of("clay"), 1);
    assert_null(reading->scene->meshes[0].colors);
    reading_free(reading);
}

TEST(opacity_and_maps_of_shape_stay)
{
    struct reading *reading =
        read_square((struct zr_request){.look = "clay"}, "Kd 1 0 0\nd 0.25\nmap_Kd c.png\nnorm c.png", NULL);
    const struct zr_material *got = material_of(reading);
    assert_color(reading, color_of("clay"), 0.25f);
    assert_true(got->alpha_mode == ZR_ALPHA_BLEND && got->is_alpha_only);
    assert_true(got->textures[ZR_TEXTURE_BASE_COLOR] > 0 && got->textures[ZR_TEXTURE_NORMAL] > 0);
    reading_free(reading);
    reading = read_square((struct zr_request){.look = "clay"}, "Kd 1 0 0\nmap_Kd c.png\nmap_Ke c.png", NULL);
    got = material_of(reading);
    assert_true(!got->is_alpha_only && !zr_material_has_textures(got));
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
