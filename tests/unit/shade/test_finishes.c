/* Finishes of surfaces: layers take as much light as they reflect. */
#include "scene/scene.h"
#include "shade/lights/sheen.h"
#include "shade/models/xray.h"
#include "support/isas.h"
#include "unit/common/lit_samples.h"

enum { STEPS = 5, VIEWS = 8, MATERIALS = STEPS * STEPS };

static struct lit_samples samples;
static struct zr_material materials[MATERIALS];
static const struct zr_lamp lamp = {
    .to_light = {0.48f, 0.6f, 0.64f}, .color = {0.02f, 0.02f, 0.02f}, .lights_pbr = true};

static float view_cosine(int view)
{
    return ((float)view + 0.5f) / VIEWS;
}

/* Sample (material, view) has a normal of its view. */
static void make_samples(zr_vec3 base, const struct zr_material *like)
{
    samples_clear(&samples);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i] = *like;
        materials[i].shading = ZR_SHADING_PBR;
        for (int view = 0; view < VIEWS; view++) {
            const float z = view_cosine(view);
            samples_set(&samples, (size_t)(i * VIEWS + view), (uint32_t)i, base, (zr_vec3){sqrtf(1.0f - z * z), 0, z},
                        (zr_vec3){0, 0, 0});
        }
    }
}

static struct zr_linear_lighting from_the_front(float ambient)
{
    struct zr_linear_lighting lighting = no_light(materials);
    lighting.is_parallel = true;
    lighting.to_eye = (zr_vec3){0, 0, 1};
    lighting.lights.ambient = (zr_vec3){ambient, ambient, ambient};
    return lighting;
}

static void check_all(const char *of, float within, float (*want)(int material, int view))
{
    for (int at = 0; at < MATERIALS * VIEWS; at++)
        for (int k = 0; k < 3; k++)
            if (!(fabsf(samples.out[k][at] - want(at / VIEWS, at % VIEWS)) <= within))
                fail_msg("%s: material %d, view %d, channel %d: %f instead of %f", of, at / VIEWS, at % VIEWS, k,
                         (double)samples.out[k][at], (double)want(at / VIEWS, at % VIEWS));
}

static float half(int material, int view)
{
    (void)material;
    (void)view;
    return 0.5f;
}

/* ---- clear coats ---- */

/* Factors grow by material, and roughness within a factor. */
static void make_coats(void)
{
    for (int i = 0; i < MATERIALS; i++)
        materials[i].finish = (struct zr_finish){.coat = (float)(i / STEPS) / (STEPS - 1),
                                                 .coat_roughness = (float)(i % STEPS) / (STEPS - 1)};
}

static float share_of_coat(int material, int view)
{
    return (float)(material / STEPS) / (STEPS - 1) * (0.04f + 0.96f * powf(1.0f - view_cosine(view), 5.0f));
}

static float half_of_coat(int material, int view)
{
    return 0.5f * share_of_coat(material, view);
}

static const struct zr_material white = {.roughness = 0.7f, .metallic = 0.5f, ZR_MATERIAL_PLASTIC};
static const struct zr_material black = {.roughness = 0.7f};

TEST_EACH_ISA(coats_lose_and_add_no_light)
{
    const struct zr_linear_lighting lighting = from_the_front(0.5f);
    make_samples((zr_vec3){1, 1, 1}, &white);
    make_coats();
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("white below a coat", 1e-5f, half);
    make_samples((zr_vec3){0, 0, 0}, &black);
    make_coats();
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("black below a coat", 1e-5f, half_of_coat);
}

/* A coat as smooth as the surface below shows the highlight of a lamp at the strength of its share. */
static float plain[MATERIALS * VIEWS];
static float of_lamp(int material, int view)
{
    return plain[material * VIEWS + view] * share_of_coat(material, view);
}

TEST_EACH_ISA(coats_show_lamps_as_mirrors_do)
{
    const struct zr_material mirror = {.metallic = 1};
    struct zr_linear_lighting lighting = from_the_front(0);
    lighting.lights.count = 1;
    lighting.lights.lamps = &lamp;
    make_samples((zr_vec3){1, 1, 1}, &mirror);
    for (int i = 0; i < MATERIALS; i++)
        materials[i].roughness = (float)(i % STEPS) / (STEPS - 1);
    samples_light(&samples, isa_under_test(state), &lighting);
    memcpy(plain, samples.out[0], sizeof plain);
    make_samples((zr_vec3){0, 0, 0}, &black);
    make_coats();
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("lamp on a coat", 1e-6f, of_lamp);
}

/* ---- sheens ---- */

static const float grid = ZR_SHEEN_SIDE - 1;

/* The integral of the distribution times the visibility, at most 1. */
static double integrated_sheen(double roughness, double nv)
{
    enum { PARTS = 160 };
    const double pi = acos(-1.0), r = fmax(roughness, (double)ZR_SHEEN_ROUGHNESS_LEAST), alpha = r * r;
    double sum = 0.0;
    for (int i = 0; i < PARTS * PARTS; i++) {
        const double theta = (i / PARTS + 0.5) / PARTS * pi / 2, phi = (i % PARTS + 0.5) / PARTS * pi;
        const double x = sin(theta) * cos(phi) + sqrt(1.0 - nv * nv), y = sin(theta) * sin(phi), nl = cos(theta);
        const double square_sine = (x * x + y * y) / (x * x + y * y + (nl + nv) * (nl + nv));
        const double d = (2.0 + 1.0 / alpha) * pow(square_sine, 0.5 / alpha) / (2.0 * pi);
        sum += d / (4.0 * (nl + nv - nl * nv)) * nl * sin(theta);
    }
    return fmin(2.0 * sum * (pi / 2 / PARTS) * (pi / PARTS), 1.0);
}

TEST(the_table_of_sheens_is_their_albedo)
{
    for (int i = 0; i < ZR_SHEEN_SIDE; i++)
        for (int j = 0; j < ZR_SHEEN_SIDE; j++) {
            const double nv = (double)j / (ZR_SHEEN_SIDE - 1),
                         want = integrated_sheen((double)i / (ZR_SHEEN_SIDE - 1), fmax(nv * nv, 1e-4));
            if (!(fabs((double)zr_sheen_table[i][j] - want) <= 0.004)) fail_msg("row %d, column %d: %f", i, j, want);
        }
}

/* Colour and roughness by material. */
static void make_sheens(float color)
{
    for (int i = 0; i < MATERIALS; i++)
        materials[i].finish =
            (struct zr_finish){.sheen = {color, color, color}, .sheen_roughness = (float)(i % ZR_SHEEN_SIDE) / grid};
}

/* 0.5 T, looked up between columns. */
static float half_of_sheen(int material, int view)
{
    const float column = sqrtf(view_cosine(view)) * grid, share = column - floorf(column);
    const float *at = &zr_sheen_table[material % ZR_SHEEN_SIDE][(int)column];
    return 0.5f * (at[0] + (at[1] - at[0]) * share);
}

TEST_EACH_ISA(sheens_lose_and_add_no_light)
{
    const struct zr_linear_lighting lighting = from_the_front(0.5f);
    make_samples((zr_vec3){1, 1, 1}, &white);
    make_sheens(1);
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("white below a sheen", 1e-5f, half);
    make_samples((zr_vec3){0, 0, 0}, &black);
    make_sheens(1);
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("black below a sheen", 1e-4f, half_of_sheen);
}

/* ---- films ---- */

static float brightest(int at)
{
    return fmaxf(samples.out[0][at], fmaxf(samples.out[1][at], samples.out[2][at]));
}

/* The brightest channel of a white plastic keeps all light, whatever the film reflects, and colours change with its
 * thickness. */
TEST_EACH_ISA(films_lose_and_add_no_light)
{
    const struct zr_material plastic = {.roughness = 0.3f, ZR_MATERIAL_PLASTIC};
    const struct zr_linear_lighting lighting = from_the_front(0.5f);
    int colored = 0;
    make_samples((zr_vec3){1, 1, 1}, &plastic);
    for (int i = 0; i < MATERIALS; i++)
        materials[i].finish = (struct zr_finish){.film = 1, .film_ior = 1.8f, .film_nm = 50.0f * (float)i + 100.0f};
    samples_light(&samples, isa_under_test(state), &lighting);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        if (!(fabsf(brightest(at) - 0.5f) <= 1e-5f)) fail_msg("sample %d: %f", at, (double)brightest(at));
        colored += fabsf(samples.out[0][at] - samples.out[2][at]) > 0.01f;
    }
    assert_true(colored > MATERIALS * VIEWS / 4);
}

/* ---- glass ---- */

static float opacity[ROOM];

/* Blended over light of 0.5, clear glass that is smooth has the light of its surroundings. */
TEST_EACH_ISA(glass_loses_and_adds_no_light)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct zr_material glass = {.finish = {.transmission = 1, .attenuation = {1, 1, 1}}, ZR_MATERIAL_PLASTIC};
    const struct zr_linear_lighting lighting = from_the_front(0.5f);
    make_samples((zr_vec3){1, 1, 1}, &glass);
    for (int i = 0; i < MATERIALS; i++)
        materials[i].finish.transmission = (float)(i / STEPS) / (STEPS - 1);
    for (int i = 0; i < ROOM; i++)
        opacity[i] = 1.0f;
    samples_light(&samples, isa, &lighting);
    zr_xray_of(isa)(&lighting, &samples.g, opacity);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const float fresnel = 0.04f + 0.96f * powf(1.0f - view_cosine(at % VIEWS), 5.0f);
        const float want = 1.0f - materials[at / VIEWS].finish.transmission * (1.0f - fresnel);
        if (!(fabsf(opacity[at] - want) <= 1e-5f)) fail_msg("opacity %d: %f", at, (double)opacity[at]);
        const float all = samples.out[0][at] * opacity[at] + 0.5f * (1.0f - opacity[at]);
        if (!(fabsf(all - 0.5f) <= 0.005f)) fail_msg("light %d: %f", at, (double)all);
    }
}

/* ---- anisotropy ---- */

/* Texture values of all samples: 1, and directions along x or across it. */
static float ones[ROOM], directions[3][ROOM];
static const struct zr_gbuffer_textures brushed = {
    .base = {ones, ones, ones},
    .roughness = ones,
    .metallic = ones,
    .occlusion = ones,
    .emissive = {ones, ones, ones},
    .normal = {samples.planes[3], samples.planes[4], samples.planes[5]},
    .coat = ones,
    .coat_roughness = ones,
    .coat_normal = {samples.planes[3], samples.planes[4], samples.planes[5]},
    .sheen = {ones, ones, ones},
    .film = ones,
    .film_thickness = ones,
    .transmission = ones,
    .thickness = ones,
    .along = {directions[0], directions[1], directions[2]},
    .anisotropy = ones};

/* Normals of views lean to the right: material i has the strength of i / STEPS and a direction in the plane of lean, or
 * for odd i % STEPS one across it. */
static void make_brushed(const struct zr_material *like)
{
    make_samples((zr_vec3){1, 1, 1}, like);
    samples.g.textures = &brushed;
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const int i = at / VIEWS;
        const bool across = i % STEPS % 2;
        materials[i].finish.anisotropy = (float)(1 + i / STEPS) / STEPS;
        materials[i].roughness = 0.2f + 0.15f * (float)(i % STEPS);
        directions[0][at] = across ? 0.0f : view_cosine(at % VIEWS);
        directions[1][at] = across ? 1.0f : 0.0f;
        directions[2][at] = across ? 0.0f : -samples.planes[3][at];
        ones[at] = 1.0f;
    }
}

TEST_EACH_ISA(brushed_surfaces_lose_and_add_no_light)
{
    const struct zr_linear_lighting lighting = from_the_front(0.5f);
    make_brushed(&white);
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("brushed white", 1e-5f, half);
}

/* The formulas of KHR_materials_anisotropy, for the light of a lamp at the eye on a metal. */
static float brushed_lobe(int material, int view)
{
    const double pi = acos(-1.0), nv = (double)view_cosine(view), nx = sqrt(1.0 - nv * nv);
    const double strength = (1.0 + material / STEPS) / STEPS, roughness = 0.2 + 0.15 * (material % STEPS);
    const double across = fmax(roughness * roughness, 0.06),
                 along = fmax(roughness * roughness * (1.0 - strength * strength) + strength * strength, 0.06);
    const bool is_across = material % STEPS % 2;
    const double t = is_across ? 0.0 : -nx, b = is_across ? nx : 0.0; /* of the lamp, as of the eye and of the half */
    const double sum = t * t / (along * along) + b * b / (across * across) + nv * nv;
    const double d = 1.0 / (pi * along * across * sum * sum);
    const double v = 0.5 / (2.0 * nv * sqrt(along * along * t * t + across * across * b * b + nv * nv));
    return (float)(pi * d * v * nv * 0.02);
}

TEST_EACH_ISA(brushed_surfaces_have_long_highlights)
{
    const struct zr_material metal = {.metallic = 1};
    const struct zr_lamp at_eye = {.to_light = {0, 0, 1}, .color = {0.02f, 0.02f, 0.02f}, .lights_pbr = true};
    struct zr_linear_lighting lighting = from_the_front(0);
    lighting.lights.count = 1;
    lighting.lights.lamps = &at_eye;
    make_brushed(&metal);
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("brushed metal", 2e-5f, brushed_lobe);
}

/* ---- glass with a backdrop ---- */

/* Texels of four levels of 8 x 8, and a window in which points are pixels: x and y times 8, from the middle. */
enum { SIDE = 8, TEXELS = SIDE * SIDE + 16 + 4 + 1 };
static float texels[TEXELS][4], thicknesses[MATERIALS], powers[MATERIALS];
static struct zr_backdrop backdrop = {.texels = texels[0],
                                      .level_count = 4,
                                      .first = {0, 64, 80, 84},
                                      .width = {8, 4, 2, 1},
                                      .height = {8, 4, 2, 1},
                                      .roughest = 3,
                                      .to_window = {{8, 0, 0, 4}, {0, 8, 0, 4}, {0, 0, 0, 1}},
                                      .thickness = thicknesses,
                                      .power = powers};

static void fill_backdrop(float r, float g, float b)
{
    for (int i = 0; i < TEXELS; i++) {
        texels[i][0] = r;
        texels[i][1] = g;
        texels[i][2] = b;
    }
}

static const struct zr_material clear = {
    .finish = {.transmission = 1, .ior = 1.5f, .thickness = 1, .attenuation = {1, 1, 1}}, ZR_MATERIAL_PLASTIC};

/* Light of 0.5 from all around stays 0.5 for every roughness and transmission. */
TEST_EACH_ISA(glass_over_a_backdrop_loses_and_adds_no_light)
{
    struct zr_linear_lighting lighting = from_the_front(0.5f);
    lighting.backdrop = &backdrop;
    fill_backdrop(0.5f, 0.5f, 0.5f);
    make_samples((zr_vec3){1, 1, 1}, &clear);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].roughness = (float)(i % STEPS) / (STEPS - 1);
        materials[i].finish.transmission = (float)(1 + i / STEPS) / STEPS;
        thicknesses[i] = 0.1f * (float)i;
        powers[i] = 0;
    }
    samples_light(&samples, isa_under_test(state), &lighting);
    check_all("clear glass", 1e-5f, half);
}

/* Power by material, of the attenuation .5. */
static float power_of(int material)
{
    return material == 0 ? 0.0f : ldexpf(1.0f, material - 8);
}

TEST_EACH_ISA(volumes_attenuate_light_by_their_depth)
{
    struct zr_linear_lighting lighting = from_the_front(0);
    lighting.backdrop = &backdrop;
    fill_backdrop(1, 1, 1);
    make_samples((zr_vec3){1, 1, 1}, &clear);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].reflectance = (zr_vec3){0, 0, 0};
        materials[i].grazing = 0;
        materials[i].finish.attenuation = (zr_vec3){0.5f, 1, 0};
        powers[i] = fminf(power_of(i), ZR_BACKDROP_POWER_MAX);
    }
    samples_light(&samples, isa_under_test(state), &lighting);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const float want[3] = {powf(0.5f, powers[at / VIEWS]), 1, at / VIEWS == 0 ? 1.0f : 0.0f};
        for (int k = 0; k < 3; k++)
            if (!(fabsf(samples.out[k][at] - want[k]) <= 1e-4f))
                fail_msg("sample %d, channel %d: %f", at, k, (double)samples.out[k][at]);
    }
}

/* Returns where a ray of the view ends, in texels of level 0: the normal leans to the right. */
static double refracted_column(double ior, double thickness, int view)
{
    const double nz = (double)view_cosine(view), nx = sqrt(1.0 - nz * nz), eta = 1.0 / ior;
    const double along = nx * (eta * nz - sqrt(1.0 - eta * eta * (1.0 - nz * nz)));
    return fmin(fmax(8.0 * along * thickness + 4.0, 0.5), 7.5);
}

/* Columns have rising light; red and blue are bent by other indices. */
TEST_EACH_ISA(light_through_glass_is_refracted_and_dispersed)
{
    struct zr_linear_lighting lighting = from_the_front(0);
    lighting.backdrop = &backdrop;
    for (int i = 0; i < SIDE * SIDE; i++)
        texels[i][0] = texels[i][1] = texels[i][2] = 0.1f * (float)(i % SIDE);
    make_samples((zr_vec3){1, 1, 1}, &clear);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].reflectance = (zr_vec3){0, 0, 0};
        materials[i].grazing = 0;
        materials[i].finish.ior = 1.0f + 0.2f * (float)(i % STEPS);
        materials[i].finish.dispersion = i < MATERIALS / 2 ? 0.0f : 10.0f;
        thicknesses[i] = 0.25f * (float)(i / STEPS);
        powers[i] = 0;
    }
    samples_light(&samples, isa_under_test(state), &lighting);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const struct zr_finish *finish = &materials[at / VIEWS].finish;
        const double apart = 0.025 * (double)finish->dispersion * ((double)finish->ior - 1.0);
        for (int k = 0; k < 3; k++) {
            const double ior = (double)finish->ior + (k - 1) * apart,
                         column = refracted_column(ior, (double)thicknesses[at / VIEWS], at % VIEWS);
            if (!(fabs((double)samples.out[k][at] - 0.1 * (column - 0.5)) <= 1e-4))
                fail_msg("sample %d, channel %d: %f in column %f", at, k, (double)samples.out[k][at], column);
        }
    }
}

/* A level has the light of its number. */
TEST_EACH_ISA(rough_glass_shows_coarse_levels)
{
    struct zr_linear_lighting lighting = from_the_front(0);
    lighting.backdrop = &backdrop;
    for (int level = 0; level < backdrop.level_count; level++)
        for (int i = backdrop.first[level]; i < (level == 3 ? TEXELS : backdrop.first[level + 1]); i++)
            texels[i][0] = texels[i][1] = texels[i][2] = 0.25f * (float)level;
    make_samples((zr_vec3){1, 1, 1}, &clear);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].reflectance = (zr_vec3){0, 0, 0};
        materials[i].grazing = 0;
        materials[i].roughness = (float)(i % STEPS) / (STEPS - 1);
        materials[i].finish.ior = 1.0f + 0.25f * (float)(i / STEPS);
    }
    samples_light(&samples, isa_under_test(state), &lighting);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const struct zr_material *material = &materials[at / VIEWS];
        const float want = 0.75f * material->roughness * fminf(2.0f * material->finish.ior - 2.0f, 1.0f);
        if (!(fabsf(samples.out[1][at] - want) <= 1e-5f)) fail_msg("sample %d: %f", at, (double)samples.out[1][at]);
    }
}

/* Without texels, straight rays keep their colour at the opacity of its least channel. */
TEST_EACH_ISA(volumes_without_a_backdrop_attenuate_straight_rays)
{
    const enum zr_isa isa = isa_under_test(state);
    struct zr_linear_lighting lighting = from_the_front(0);
    struct zr_backdrop none = backdrop;
    none.texels = NULL;
    lighting.backdrop = &none;
    make_samples((zr_vec3){1, 1, 1}, &clear);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].finish.attenuation = (zr_vec3){0.5f, 1, 1};
        powers[i] = 0.25f * (float)i;
    }
    for (int i = 0; i < ROOM; i++)
        opacity[i] = 1.0f;
    zr_xray_of(isa)(&lighting, &samples.g, opacity);
    for (int at = 0; at < MATERIALS * VIEWS; at++) {
        const float fresnel = 0.04f + 0.96f * powf(1.0f - view_cosine(at % VIEWS), 5.0f);
        const float want = 1.0f - (1.0f - fresnel) * powf(0.5f, powers[at / VIEWS]);
        if (!(fabsf(opacity[at] - want) <= 1e-4f)) fail_msg("opacity %d: %f", at, (double)opacity[at]);
    }
}

RUN_TESTS(NULL, NULL)
