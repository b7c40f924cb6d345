/* Tests the materials of glTF files whose extensions describe the reflection of plastics. */
#include "support/pictures/png.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

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

/* ---- textures of specular and glossiness ---- */

#define TEXTURES                                                                                                       \
    "\"images\":[{\"uri\":\"d\"},{\"uri\":\"s\"}],\"samplers\":[{\"wrapS\":33071}],\"textures\":[{\"source\":0},"      \
    "{\"source\":1},{\"source\":1,\"sampler\":0},{}],"
#define GLOSSY_MATERIAL(keys)  "{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{" keys "}}}"
#define DIFFUSE                "\"diffuseTexture\":{\"index\":0},"
#define SPECULAR(number, more) "\"specularGlossinessTexture\":{\"index\":" #number more "}"
#define TWO_MATERIALS(first, second)                                                                                   \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_pbrSpecularGlossiness\","                    \
    "\"KHR_texture_transform\"],\"buffers\":[{\"byteLength\":36,\"uri\":\"b\"}],\"bufferViews\":[{\"buffer\":0,"       \
    "\"byteLength\":36}],"                                                                                             \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":0,"        \
    "\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{"            \
    "\"POSITION\":0,"                                                                                                  \
    "\"TEXCOORD_0\":1,\"TEXCOORD_1\":1},\"material\":0},{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_"  \
    "1\":1},"                                                                                                          \
    "\"material\":1}]}],\"nodes\":[{\"mesh\":0}]," TEXTURES                                                            \
    "\"materials\":[" GLOSSY_MATERIAL(first) "," GLOSSY_MATERIAL(second) "]}"

/* Two texels: a plastic without specular light, and a metal. */
static const uint8_t of_diffuse[8] = {188, 137, 0, 128, 0, 0, 0, 255},
                     of_specular[8] = {0, 0, 0, 64, 255, 188, 137, 255};

static struct reading *read_textured(const char *text, uint64_t texels_max)
{
    size_t sizes[2];
    uint8_t *files[2] = {png_memory_write(of_diffuse, 2, 1, &sizes[0]), png_memory_write(of_specular, 2, 1, &sizes[1])};
    const struct zr_asset all[] = {parts[0],
                                   {.name = "d", .bytes = files[0], .size = sizes[0]},
                                   {.name = "s", .bytes = files[1], .size = sizes[1]}};
    struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_GLTF, .channel = "color", .assets = all, .asset_count = 3};
    limits.image_pixels_max = texels_max;
    struct reading *reading = read_request(request, text, strlen(text), limits, (size_t)1 << 28);
    free(files[0]);
    free(files[1]);
    return reading;
}

static const uint8_t *texels_of(const struct zr_scene *scene, uint32_t primitive, enum zr_texture_slot slot)
{
    const struct zr_material *material = &scene->materials[scene->meshes[primitive].material];
    assert_true(material->textures[slot] > 0);
    const struct zr_image *image = &scene->images[scene->textures[material->textures[slot] - 1].image];
    assert_int_equal(image->width, 2);
    return image->texels;
}

TEST(textures_of_specular_and_glossiness_are_converted_texel_by_texel)
{
    static const uint8_t color[8] = {191, 140, 0, 128, 255, 188, 137, 255}, rough[8] = {0, 191, 0, 255, 0, 0, 255, 255};
    static const uint8_t halved[8] = {0, 223, 0, 255, 0, 128, 255, 255};
    struct reading *reading =
        read_textured(TWO_MATERIALS(DIFFUSE SPECULAR(1, ), DIFFUSE SPECULAR(1, ) ",\"glossinessFactor\":0.5"), 1000);
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    const struct zr_material *material = &scene->materials[scene->meshes[0].material];
    assert_int_equal(scene->warning_count, 0);
    assert_memory_equal(texels_of(scene, 0, ZR_TEXTURE_BASE_COLOR), color, sizeof color);
    assert_memory_equal(texels_of(scene, 0, ZR_TEXTURE_METALLIC_ROUGHNESS), rough, sizeof rough);
    assert_memory_equal(texels_of(scene, 1, ZR_TEXTURE_METALLIC_ROUGHNESS), halved, sizeof halved);
    assert_true(material->metallic == 1.0f && material->roughness == 1.0f && material->base_color.x == 1.0f);
    assert_int_equal(scene->image_count, 6);
    assert_int_equal(scene->texture_count, 4); /* the two of the file are not drawn */
    reading_free(reading);
    reading = read_textured(TWO_MATERIALS(DIFFUSE SPECULAR(1, ), DIFFUSE SPECULAR(1, )), 8);
    assert_read(reading);
    assert_int_equal(reading->scene->image_count, 4); /* equal images are made once */
    reading_free(reading);
    reading = read_textured(TWO_MATERIALS(SPECULAR(1, ) ",\"diffuseFactor\":[0,0,0,0.5]", SPECULAR(1, )), 1000);
    assert_read(reading);
    scene = reading->scene;
    assert_int_equal(texels_of(scene, 0, ZR_TEXTURE_BASE_COLOR)[0], 0);
    assert_int_equal(texels_of(scene, 1, ZR_TEXTURE_BASE_COLOR)[0], 255);
    assert_true(scene->materials[scene->meshes[0].material].base_color.w == 0.5f);
    reading_free(reading);
}

/* Such textures are left out, with a warning. */
TEST(textures_that_cannot_be_converted_in_pairs_are_left_out)
{
    static const char says[] = "/materials/0/extensions/KHR_materials_pbrSpecularGlossiness: drawn without its "
                               "specularGlossinessTexture";
    static const struct {
        const char *text, *warning;
        uint64_t texels_max;
    } cases[] = {
        {TWO_MATERIALS(DIFFUSE SPECULAR(2, ), ""), says, 1000},
        {TWO_MATERIALS(DIFFUSE SPECULAR(1, ",\"texCoord\":1"), ""), says, 1000},
        {TWO_MATERIALS(DIFFUSE SPECULAR(1, ",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[2,2]}}"), ""), says,
         1000},
        {TWO_MATERIALS(DIFFUSE SPECULAR(1, ), ""), says, 7},
        {TWO_MATERIALS(DIFFUSE SPECULAR(1, ), ""), NULL, 8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_textured(cases[i].text, cases[i].texels_max);
        assert_read(reading);
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *material = &scene->materials[scene->meshes[0].material];
        const char *found = scene->warning_count == 1 ? scene->warnings[0] : "";
        if (strcmp(found, cases[i].warning ? cases[i].warning : "") != 0) fail_msg("case %zu: %s", i, found);
        if (cases[i].warning) {
            assert_true(material->roughness == 0.5f && material->metallic == 0.0f);
            assert_memory_equal(texels_of(scene, 0, ZR_TEXTURE_BASE_COLOR), of_diffuse, sizeof of_diffuse);
            assert_int_equal(material->textures[ZR_TEXTURE_METALLIC_ROUGHNESS], 0);
        }
        reading_free(reading);
    }
    struct reading *reading = read_textured(TWO_MATERIALS(SPECULAR(9, ), ""), 1000);
    assert_complaint(reading, ZR_BAD_SCENE,
                     "/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture/index",
                     "index 9");
    reading_free(reading);
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
