/* Tests the extensions of glTF that set finishes of materials. */
#include "support/tests.h"
#include "unit/common/input_check.h"

static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
static struct zr_asset parts[] = {{.name = "b", .bytes = corners, .size = sizeof corners}};

#define FILE_OF(extension, keys)                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"" extension "\"],\"extensionsRequired\":[\"" extension     \
    "\"],\"buffers\":[{\"byteLength\":36,\"uri\":\"b\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"          \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"meshes\":"              \
    "[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"nodes\":[{\"mesh\":0}],\"textures\":"     \
    "[{}],\"materials\":[{\"extensions\":{\"" extension "\":{" keys "}}}]}"
#define AT(key)    "/materials/0/extensions/" key
#define COAT       "KHR_materials_clearcoat"
#define SHEEN      "KHR_materials_sheen"
#define FILM       "KHR_materials_iridescence"
#define GLASS      "KHR_materials_transmission"
#define VOLUME     "KHR_materials_volume"
#define DISPERSION "KHR_materials_dispersion"
#define BRUSH      "KHR_materials_anisotropy"

static struct reading *read_file(const char *text)
{
    struct zr_request request = {.format = ZR_FORMAT_GLTF, .channel = "color", .assets = parts, .asset_count = 1};
    return read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
}

/* `warning`: NULL, or the only one. */
static const struct {
    const char *text, *warning;
    struct zr_finish finish;
} finishes[] = {
    {FILE_OF(COAT, "\"clearcoatFactor\":0.5,\"clearcoatRoughnessFactor\":0.25"),
     NULL,
     {.coat = 0.5f, .coat_roughness = 0.25f}},
    {FILE_OF(COAT, ""), NULL, {.coat = 0}},
    {FILE_OF(COAT, "\"clearcoatFactor\":-1,\"clearcoatRoughnessFactor\":0.25"),
     AT(COAT "/clearcoatFactor: beyond its range, and clamped"),
     {.coat_roughness = 0.25f}},
    {FILE_OF(COAT, "\"clearcoatFactor\":1,\"clearcoatNormalTexture\":{\"index\":0}"),
     "/textures/0: without a source, and not drawn",
     {.coat = 1}},
    {FILE_OF(COAT, "\"clearcoatFactor\":1,\"clearcoatTexture\":{\"index\":0}"),
     "/textures/0: without a source, and not drawn",
     {.coat = 1}},
    {FILE_OF(SHEEN, "\"sheenColorFactor\":[1,0.5,0.25],\"sheenRoughnessFactor\":0.75"),
     NULL,
     {.sheen = {1, 0.5f, 0.25f}, .sheen_roughness = 0.75f}},
    {FILE_OF(SHEEN, "\"sheenColorFactor\":[1,-1,0]"),
     AT(SHEEN "/sheenColorFactor: beyond its range, and clamped"),
     {.sheen = {1, 0, 0}}},
    {FILE_OF(SHEEN, "\"sheenColorFactor\":[1,1,1],\"sheenRoughnessTexture\":{\"index\":0}"),
     AT(SHEEN "/sheenRoughnessTexture: this texture is not drawn"),
     {.sheen = {1, 1, 1}}},
    {FILE_OF(FILM, "\"iridescenceFactor\":1"), NULL, {.film = 1, .film_ior = 1.3f, .film_nm = 400}},
    {FILE_OF(FILM, "\"iridescenceFactor\":0.5,\"iridescenceIor\":0,\"iridescenceThicknessMaximum\":800"),
     AT(FILM "/iridescenceIor: beyond its range, and clamped"),
     {.film = 0.5f, .film_ior = 1, .film_nm = 800}},
    {FILE_OF(FILM, "\"iridescenceFactor\":1,\"iridescenceThicknessMaximum\":0"), NULL, {.film = 0}},
    {FILE_OF(BRUSH, "\"anisotropyStrength\":0.5"), NULL, {.anisotropy = 0.5f, .along = {1, 0}}},
    {FILE_OF(BRUSH, "\"anisotropyStrength\":2"),
     AT(BRUSH "/anisotropyStrength: beyond its range, and clamped"),
     {.anisotropy = 1, .along = {1, 0}}},
    {FILE_OF(BRUSH, "\"anisotropyRotation\":1"), NULL, {.anisotropy = 0}},
    {FILE_OF(GLASS, "\"transmissionFactor\":0.75"),
     NULL,
     {.transmission = 0.75f, .ior = 1.5f, .attenuation = {1, 1, 1}}},
    {FILE_OF(GLASS, "\"transmissionFactor\":0,\"transmissionTexture\":{\"index\":0}"), NULL, {.transmission = 0}},
    {FILE_OF(VOLUME, "\"thicknessFactor\":1,\"attenuationDistance\":2"), NULL, {.transmission = 0}},
    {FILE_OF(GLASS, "\"transmissionFactor\":1},\"KHR_materials_ior\":{\"ior\":2},\"" VOLUME
                    "\":{\"thicknessFactor\":0.5,\"attenuationDistance\":2,\"attenuationColor\":[1,0.5,0]"),
     NULL,
     {.transmission = 1, .ior = 2, .thickness = 0.5f, .attenuation = {1, 0.5f, 0}, .distance = 2}},
    {FILE_OF(GLASS, "\"transmissionFactor\":1},\"" VOLUME "\":{\"thicknessFactor\":-1,\"attenuationDistance\":0"),
     AT(VOLUME "/thicknessFactor: beyond its range, and clamped"),
     {.transmission = 1, .ior = 1.5f, .attenuation = {1, 1, 1}}},
    {FILE_OF(GLASS,
             "\"transmissionFactor\":1},\"" VOLUME "\":{\"thicknessFactor\":1e300,\"attenuationDistance\":1e300"),
     AT(VOLUME "/thicknessFactor: beyond its range, and clamped"),
     {.transmission = 1, .ior = 1.5f, .thickness = 1e15f, .attenuation = {1, 1, 1}}},
    {FILE_OF(GLASS, "\"transmissionFactor\":1},\"" DISPERSION "\":{\"dispersion\":-0.1"),
     AT(DISPERSION "/dispersion: beyond its range, and clamped"),
     {.transmission = 1, .ior = 1.5f, .attenuation = {1, 1, 1}}},
    {FILE_OF(GLASS, "\"transmissionFactor\":1},\"" DISPERSION "\":{\"dispersion\":0.5"),
     NULL,
     {.transmission = 1, .ior = 1.5f, .attenuation = {1, 1, 1}, .dispersion = 0.5f}},
};

TEST(finishes_are_read)
{
    for (size_t i = 0; i < sizeof finishes / sizeof *finishes; i++) {
        struct reading *reading = read_file(finishes[i].text);
        assert_read(reading);
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *found = &scene->materials[scene->meshes[0].material];
        if (memcmp(&found->finish, &finishes[i].finish, sizeof found->finish) != 0) fail_msg("case %zu", i);
        const char *warning = scene->warning_count == 1 ? scene->warnings[0] : "";
        const char *wanted = finishes[i].warning ? finishes[i].warning : "";
        if (scene->warning_count > 1 || strcmp(warning, wanted) != 0) fail_msg("case %zu: %s", i, warning);
        reading_free(reading);
    }
}

TEST(looks_that_are_a_material_have_no_finish)
{
    struct zr_request request = {
        .format = ZR_FORMAT_GLTF, .look = "clay", .channel = "color", .assets = parts, .asset_count = 1};
    struct reading *reading =
        read_request(request, finishes[0].text, strlen(finishes[0].text), zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    assert_true(!zr_material_has_finish(&reading->scene->materials[reading->scene->meshes[0].material]));
    reading_free(reading);
}

static const struct {
    const char *text, *place, *says;
} faults[] = {
    {FILE_OF(COAT, "\"clearcoatFactor\":true"), AT(COAT "/clearcoatFactor"), "number"},
    {FILE_OF(COAT, "\"clearcoatFactor\":1,\"clearcoatTexture\":{\"index\":7}"), AT(COAT "/clearcoatTexture/index"),
     "index 7"},
    {FILE_OF(SHEEN, "\"sheenColorFactor\":[1,1]"), AT(SHEEN "/sheenColorFactor"), "numbers"},
    {FILE_OF(FILM, "\"iridescenceIor\":\"x\""), AT(FILM "/iridescenceIor"), "number"},
    {FILE_OF(GLASS, "\"transmissionFactor\":[]"), AT(GLASS "/transmissionFactor"), "number"},
    {FILE_OF(VOLUME, "\"attenuationColor\":1"), AT(VOLUME "/attenuationColor"), "numbers"},
};

TEST(faults_in_finishes_are_refused)
{
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        struct reading *reading = read_file(faults[i].text);
        assert_complaint(reading, ZR_BAD_SCENE, faults[i].place, faults[i].says);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
