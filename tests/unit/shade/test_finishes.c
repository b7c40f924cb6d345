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
    const struct zr_material glass = {.finish = {.transmission = 1}, ZR_MATERIAL_PLASTIC};
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

RUN_TESTS(NULL, NULL)
