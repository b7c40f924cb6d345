/* Tests the materials of glTF files whose extensions describe the reflection of plastics. */
#include "input_check.h"
#include "support/tests.h"

static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
static struct zr_asset parts[] = {{.name = "b", .bytes = corners, .size = sizeof corners}};

#define FILE_OF(material)                                                                                              \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_specular\",\"KHR_materials_ior\","           \
    "\"KHR_materials_pbrSpecularGlossiness\"],\"buffers\":[{\"byteLength\":36,\"uri\":\"b\"}],\"bufferViews\":"        \
    "[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"          \
    "\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"            \
    "\"nodes\":[{\"mesh\":0}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,1,0,1]},"               \
    "\"extensions\":{" material "}}]}"
#define GLOSSY(keys) FILE_OF("\"KHR_materials_pbrSpecularGlossiness\":{" keys "}")

static struct reading *read_file(const char *text)
{
    struct zr_request request = {.format = ZR_FORMAT_GLTF, .channel = "color", .assets = parts, .asset_count = 1};
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    return reading;
}

TEST(specular_and_glossiness_become_metallic_and_roughness)
{
    static const struct {
        const char *text, *warning;
        float color[4], metallic, roughness; /* the colour is encoded */
    } cases[] = {
        {GLOSSY("\"diffuseFactor\":[0.5,0.25,0,0.5],\"specularFactor\":[0.04,0.04,0.04],\"glossinessFactor\":0.25"),
         NULL,
         {0.73536f, 0.53710f, 0, 0.5f},
         0,
         0.75f},
        {GLOSSY("\"diffuseFactor\":[0.5,0.5,0.5,1],\"specularFactor\":[0,0,0],\"glossinessFactor\":1"),
         NULL,
         {0.74892f, 0.74892f, 0.74892f, 1},
         0,
         0},
        {GLOSSY("\"diffuseFactor\":[0,0,0,1],\"specularFactor\":[1,0.5,0.25]"), NULL, {1, 0.73536f, 0.53710f, 1}, 1, 0},
        {GLOSSY("\"specularGlossinessTexture\":{\"index\":0}"),
         "/materials/0/extensions/KHR_materials_pbrSpecularGlossiness: drawn without its specularGlossinessTexture",
         {1, 1, 1, 1},
         0,
         0.5f},
        {GLOSSY("\"diffuseFactor\":[2,0,0,1],\"specularFactor\":[0,0,0]"),
         "/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor: beyond its range, and clamped",
         {1, 0, 0, 1},
         0,
         0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_file(cases[i].text);
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *material = &scene->materials[scene->meshes[0].material];
        const float found[6] = {material->base_color.x, material->base_color.y, material->base_color.z,
                                material->base_color.w, material->metallic,     material->roughness};
        for (int k = 0; k < 6; k++) {
            const float wanted = k < 4 ? cases[i].color[k] : k == 4 ? cases[i].metallic : cases[i].roughness;
            if (!(fabsf(found[k] - wanted) < 2e-4f)) fail_msg("case %zu: number %d is %g", i, k, (double)found[k]);
        }
        assert_int_equal(scene->warning_count, cases[i].warning ? 1 : 0);
        if (cases[i].warning) assert_string_equal(scene->warnings[0], cases[i].warning);
        reading_free(reading);
    }
}

TEST(reflectances_are_read)
{
    static const struct {
        const char *text, *warning;
        zr_vec3 reflectance;
        float grazing;
    } cases[] = {{FILE_OF("\"KHR_materials_ior\":{\"ior\":1.5}"), NULL, {0.04f, 0.04f, 0.04f}, 1},
                 {FILE_OF("\"KHR_materials_ior\":{\"ior\":3}"), NULL, {0.25f, 0.25f, 0.25f}, 1},
                 {FILE_OF("\"KHR_materials_ior\":{\"ior\":0}"), NULL, {1, 1, 1}, 1},
                 {FILE_OF("\"KHR_materials_ior\":{\"ior\":0.5}"),
                  "/materials/0/extensions/KHR_materials_ior/ior: beyond its range, and clamped",
                  {0, 0, 0},
                  1},
                 {FILE_OF("\"KHR_materials_ior\":{\"ior\":3},\"KHR_materials_specular\":{\"specularFactor\":0.5,"
                          "\"specularColorFactor\":[1,2,8]}"),
                  NULL,
                  {0.125f, 0.25f, 0.5f},
                  0.5f},
                 {FILE_OF("\"KHR_materials_specular\":{\"specularColorTexture\":{\"index\":0}}"),
                  "/materials/0/extensions/KHR_materials_specular: drawn without its textures",
                  {0.04f, 0.04f, 0.04f},
                  1},
                 {FILE_OF("\"KHR_materials_specular\":{\"specularFactor\":0},\"KHR_materials_unlit\":{}"),
                  NULL,
                  {0.04f, 0.04f, 0.04f},
                  1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_file(cases[i].text);
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *found = &scene->materials[scene->meshes[0].material];
        const zr_vec3 wanted = cases[i].reflectance;
        if (fabsf(found->reflectance.x - wanted.x) > 1e-6f || fabsf(found->reflectance.y - wanted.y) > 1e-6f ||
            fabsf(found->reflectance.z - wanted.z) > 1e-6f || found->grazing != cases[i].grazing)
            fail_msg("case %zu: %g %g %g, %g", i, (double)found->reflectance.x, (double)found->reflectance.y,
                     (double)found->reflectance.z, (double)found->grazing);
        assert_int_equal(scene->warning_count, cases[i].warning ? 1 : 0);
        if (cases[i].warning) assert_string_equal(scene->warnings[0], cases[i].warning);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
