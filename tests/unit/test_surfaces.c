/* Surfaces of looks are lit as their definitions say, evaluated in double: pbr, flat, gouraud, phong, gooch. */
#include "lit_samples.h"
#include "support/isas.h"

enum { MATERIALS = 64 };

static struct lit_samples samples;
static struct zr_material materials[MATERIALS];

typedef d3 expected_fn(const struct zr_linear_lighting *lighting, size_t at);

static void assert_below(double value, double bound, const char *what)
{
    print_message("%s: %.3g\n", what, value);
    if (!(value < bound)) fail_msg("%s: %g, not below %g", what, value, bound);
}

/* A third dielectric, a third metal. */
static void make_materials(struct random *r, enum zr_shading shading)
{
    for (int i = 0; i < MATERIALS; i++)
        materials[i] = (struct zr_material){.shading = shading,
                                            .metallic = i % 3 == 2 ? any(r, 0, 1) : (float)(i % 3),
                                            .roughness = i < 6 ? (float)(i / 3) : any(r, 0, 1),
                                            .specular = i % 2 ? any3(r, 0, 0.5) : (zr_vec3){0, 0, 0},
                                            .shininess = any(r, 0, 100),
                                            .cool = any3(r, 0, 1)};
}

static void make_samples(struct random *r)
{
    samples_clear(&samples);
    for (size_t i = 0; i < SAMPLES; i++)
        samples_set_any(&samples, r, i, random_below(r, MATERIALS));
}

static struct reference_surface surface(size_t at)
{
    return samples_surface(&samples, at, materials);
}

/* Worst difference, relative to what is more than `floor`, of samples that are not as bright as white. */
static double worst_of(const struct zr_linear_lighting *lighting, expected_fn *expected, double floor)
{
    double worst = 0.0;
    int compared = 0;
    for (size_t i = 0; i < SAMPLES; i++) {
        const d3 got = samples_color(&samples, i), want = expected(lighting, i);
        for (int k = 0; k < 3; k++) {
            compared += want.v[k] < 1.0;
            worst = fmax(worst, fabs(got.v[k] - fmin(want.v[k], 1.0)) / fmax(want.v[k], floor));
        }
    }
    assert_true(compared > 3 * SAMPLES * 9 / 10);
    return worst;
}

/* ---- lamps on pbr ---- */

static d3 times_color(d3 a, zr_vec3 color)
{
    const d3 c = d3_of(color);
    return (d3){{a.v[0] * c.v[0], a.v[1] * c.v[1], a.v[2] * c.v[2]}};
}

static d3 lamp_expected(const struct zr_linear_lighting *lighting, size_t at)
{
    const struct reference_surface s = surface(at);
    return times_color(reference_lamp(&s, d3_unit(d3_of(lighting->lights.lamps->to_light))),
                       lighting->lights.lamps->color);
}

static void lamps_are_those_of_gltf(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(21);
    double worst = 0.0;
    for (int round = 0; round < 8; round++) {
        const struct zr_lamp lamp = {
            .to_light = any_facing(&r, (zr_vec3){0, 0, 1}, 0.0f), .color = any3(&r, 0.1, 0.6), .lights_pbr = true};
        make_materials(&r, ZR_SHADING_PBR);
        make_samples(&r);
        struct zr_linear_lighting lighting = no_light(materials);
        lighting.lights.lamps = &lamp;
        lighting.lights.count = 1;
        samples_light(&samples, isa, &lighting);
        worst = fmax(worst, worst_of(&lighting, lamp_expected, 1e-3));
    }
    assert_below(worst, 1e-4, "one lamp, worst relative difference");
}

/* The appendix begins with a mix of two surfaces and ends with one whose colours are mixed. They differ in between
 * only, and there in the diffuse part only. */
static void dielectrics_and_metals_are_those_of_both_forms(void **state)
{
    struct random r = random_seeded(22);
    double ends = 0.0, between = 0.0;
    (void)state;
    make_materials(&r, ZR_SHADING_PBR);
    make_samples(&r);
    for (size_t i = 0; i < SAMPLES; i++) {
        const struct reference_surface s = surface(i);
        const d3 l = d3_of(any_facing(&r, get3(samples.g.normal, i), 0.1f));
        const d3 one = reference_lamp(&s, l), two = reference_lamp_of_two(&s, l);
        double *worst = s.metallic == 0.0 || s.metallic == 1.0 ? &ends : &between;
        for (int k = 0; k < 3; k++)
            *worst = fmax(*worst, fabs(one.v[k] - two.v[k]));
    }
    assert_below(ends, 1e-12, "dielectric or metal, forms differ by");
    assert_below(between, 0.25, "between, forms differ by");
    assert_true(between > 0.1);
}

static void lamps_behind_and_of_others_give_nothing(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(23);
    const struct zr_lamp lamps[2] = {{.to_light = {0, 0, 1}, .color = {1, 1, 1}, .lights_classic = true},
                                     {.to_light = {0, 0, -1}, .color = {1, 1, 1}, .lights_pbr = true}};
    make_materials(&r, ZR_SHADING_PBR);
    make_samples(&r);
    struct zr_linear_lighting lighting = no_light(materials);
    lighting.lights.lamps = lamps;
    lighting.lights.count = 2;
    samples_light(&samples, isa, &lighting);
    for (size_t i = 0; i < SAMPLES; i++)
        if (samples.g.normal[2][i] >= 0.0f)
            for (int k = 0; k < 3; k++)
                assert_true(samples.out[k][i] == 0.0f);
}

/* ---- all around, on pbr ---- */

static d3 around_expected(const struct zr_linear_lighting *lighting, size_t at)
{
    const struct reference_surface s = surface(at);
    const struct zr_lamp *lamp = lighting->lights.lamps;
    const double intensity = (double)lighting->environment_intensity;
    const d3 directions[2] = {s.normal, reference_mirrored(&s)};
    d3 light[2];
    for (int i = 0; i < 2; i++) {
        d3 e = {{0}};
        for (int k = 0; k < 3; k++)
            e.v[k] = d3_dot(d3_of(lighting->eye_to_environment[k]), directions[i]);
        const double up = 0.5 + 0.5 * d3_dot(directions[i], d3_of(lamp->to_light));
        light[i] = i ? reference_radiance(&lighting->environment, e, s.roughness * s.roughness)
                     : reference_irradiance(&lighting->environment, e);
        light[i] = d3_mad(d3_of(lighting->lights.ambient), intensity, light[i]);
        light[i] = d3_mad(light[i], 1.0, d3_mix(d3_of(lamp->ground), d3_of(lamp->color), up));
    }
    return reference_around(&s, light[0], light[1]);
}

/* An environment turned any way, a hemisphere, ambient light; in creases. */
static void light_from_all_around_is_as_defined(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(24);
    double worst = 0.0;
    for (int round = 0; round < 8; round++) {
        const struct zr_lamp lamp = {.to_light = any_unit(&r),
                                     .color = any3(&r, 0, 0.2),
                                     .ground = any3(&r, 0, 0.1),
                                     .is_hemisphere = true,
                                     .lights_pbr = true};
        const zr_vec3 y = any_unit(&r), x = zr_vec3_normalize(zr_vec3_cross(y, any_unit(&r)));
        make_materials(&r, ZR_SHADING_PBR);
        make_samples(&r);
        struct zr_linear_lighting lighting = no_light(materials);
        lighting.lights.ambient = any3(&r, 0, 0.1);
        lighting.lights.lamps = &lamp;
        lighting.lights.count = 1;
        lighting.has_environment =
            zr_environment_make(round % 2 ? ZR_ENVIRONMENT_OUTDOOR : ZR_ENVIRONMENT_STUDIO, &lighting.environment);
        lighting.environment_intensity = any(&r, 0.1, 0.6);
        lighting.eye_to_environment[0] = x;
        lighting.eye_to_environment[1] = y;
        lighting.eye_to_environment[2] = zr_vec3_cross(x, y);
        samples_light(&samples, isa, &lighting);
        worst = fmax(worst, worst_of(&lighting, around_expected, 0.01));
    }
    assert_below(worst, 1e-4, "all around, worst relative difference");
}

/* ---- energy ---- */

static struct zr_environment_light uniform_environment(void)
{
    return (struct zr_environment_light){
        .sky = {1, 1, 1}, .ground = {1, 1, 1}, .half_width = 0.1f, .harmonics = {{1, 1, 1}}};
}

static void furnace(enum zr_isa isa, const struct zr_linear_lighting *lighting, double *least, double *most)
{
    for (size_t i = 0; i < MATERIALS; i++)
        materials[i] = (struct zr_material){
            .shading = ZR_SHADING_PBR, .metallic = (float)(i % 2), .roughness = (float)(i / 2) / (MATERIALS / 2 - 1)};
    samples_clear(&samples);
    for (size_t i = 0; i < SAMPLES; i++) {
        const float nv = 0.05f + 0.95f * (float)(i / MATERIALS) / (SAMPLES / MATERIALS - 1);
        samples_set(&samples, i, (uint32_t)(i % MATERIALS), (zr_vec3){1, 1, 1},
                    (zr_vec3){sqrtf(fmaxf(0.0f, 1.0f - nv * nv)), 0, nv}, (zr_vec3){0, 0, -2});
    }
    samples_light(&samples, isa, lighting);
    for (size_t i = 0; i < SAMPLES; i++)
        for (int k = 0; k < 3; k++) {
            *least = fmin(*least, 2.0 * samples_color(&samples, i).v[k]);
            *most = fmax(*most, 2.0 * samples_color(&samples, i).v[k]);
        }
}

/* At half the exposure, so that what is more than 1 would be seen. */
static void nothing_is_lost_in_a_white_furnace(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct zr_linear_lighting ambient = no_light(materials), environment = ambient;
    double least = 1.0, most = 1.0;
    ambient.lights.ambient = (zr_vec3){1, 1, 1};
    environment.environment = uniform_environment();
    environment.has_environment = true;
    ambient.exposure = environment.exposure = 0.5f;
    furnace(isa, &ambient, &least, &most);
    furnace(isa, &environment, &least, &most);
    assert_below(1.0 - least, 0.02, "white furnace, lost");
    assert_below(most - 1.0, 0.0005, "white furnace, gained");
}

/* ---- occlusion ---- */

static void occlusion_does_not_touch_lamps(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(25);
    const struct zr_lamp lamp = {
        .to_light = {0.6f, 0, 0.8f}, .color = {0.5f, 0.5f, 0.5f}, .lights_pbr = true, .lights_classic = true};
    static const enum zr_shading shadings[] = {ZR_SHADING_PBR, ZR_SHADING_FLAT, ZR_SHADING_GOURAUD, ZR_SHADING_PHONG};
    static float open[3][SAMPLES];
    for (int i = 0; i < 4; i++) {
        make_materials(&r, shadings[i]);
        make_samples(&r);
        struct zr_linear_lighting lighting = no_light(materials);
        lighting.lights.lamps = &lamp;
        lighting.lights.count = 1;
        samples_light(&samples, isa, &lighting);
        for (int k = 0; k < 3; k++)
            memcpy(open[k], samples.out[k], sizeof open[k]);
        memset(samples.open, 0, sizeof samples.open);
        samples_light(&samples, isa, &lighting);
        for (int k = 0; k < 3; k++)
            assert_memory_equal(samples.out[k], open[k], sizeof open[k]);
        assert_true(open[0][0] > 0.0f || open[0][1] > 0.0f || open[0][2] > 0.0f || open[0][3] > 0.0f);
    }
}

/* ---- flat, gouraud, phong, gooch ---- */

static d3 classic_expected(const struct zr_linear_lighting *lighting, size_t at)
{
    const struct reference_surface s = surface(at);
    const struct zr_material *material = &materials[samples.material[at]];
    const struct zr_lamp *sky = &lighting->lights.lamps[0], *lamp = &lighting->lights.lamps[1];
    const d3 l = d3_unit(d3_of(lamp->to_light)), h = d3_unit(d3_mad(l, 1.0, s.to_eye));
    const double nl = d3_dot(s.normal, l), nh = fmax(d3_dot(s.normal, h), 0.0);
    const double up = 0.5 + 0.5 * d3_dot(s.normal, d3_of(sky->to_light));
    const bool shines = material->shading == ZR_SHADING_PHONG && nl > 0.0;
    d3 out = d3_mad(d3_of(lighting->lights.ambient), 1.0, d3_mix(d3_of(sky->ground), d3_of(sky->color), up));
    for (int k = 0; k < 3; k++) {
        const double color = d3_of(lamp->color).v[k], specular = d3_of(material->specular).v[k];
        out.v[k] = s.base.v[k] * (out.v[k] * reference_bounced(s.open, s.base.v[k]) + color * fmax(nl, 0.0));
        if (shines) out.v[k] += color * specular * pow(nh, (double)material->shininess);
    }
    return out;
}

static void classic_surfaces_are_as_defined(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(26);
    double worst = 0.0;
    for (int round = 0; round < 6; round++) {
        const struct zr_lamp lamps[3] = {
            {.to_light = any_unit(&r),
             .color = any3(&r, 0, 0.3),
             .ground = any3(&r, 0, 0.2),
             .is_hemisphere = true,
             .lights_classic = true},
            {.to_light = any_facing(&r, (zr_vec3){0, 0, 1}, 0), .color = any3(&r, 0.1, 0.5), .lights_classic = true},
            {.to_light = any_unit(&r), .color = any3(&r, 0, 0.3), .lights_pbr = true}};
        make_materials(&r, (enum zr_shading[]){ZR_SHADING_FLAT, ZR_SHADING_GOURAUD, ZR_SHADING_PHONG}[round % 3]);
        make_samples(&r);
        struct zr_linear_lighting lighting = no_light(materials);
        lighting.lights.ambient = any3(&r, 0, 0.1);
        lighting.lights.lamps = lamps;
        lighting.lights.count = 3;
        samples_light(&samples, isa, &lighting);
        worst = fmax(worst, worst_of(&lighting, classic_expected, 0.01));
    }
    assert_below(worst, 1e-4, "flat, gouraud, phong, worst relative difference");
}

static d3 gooch_expected(const struct zr_linear_lighting *lighting, size_t at)
{
    const struct reference_surface s = surface(at);
    const d3 k = d3_unit((d3){{-0.45, 0.65, 0.61}}), cool = d3_of(materials[samples.material[at]].cool);
    const double share = pow(0.5 + 0.5 * d3_dot(s.normal, k), 1.5);
    d3 decoded;
    (void)lighting;
    for (int i = 0; i < 3; i++)
        decoded.v[i] = reference_decode(cool.v[i]);
    return d3_scale(d3_mix(decoded, s.base, share), 0.35 + 0.65 * s.open);
}

/* Neither exposure nor tone mapping changes ink. */
static void gooch_is_as_defined(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(27);
    make_materials(&r, ZR_SHADING_GOOCH);
    make_samples(&r);
    struct zr_linear_lighting lighting = no_light(materials);
    lighting.exposure = 3.0f;
    lighting.tone = ZR_TONE_NEUTRAL;
    samples_light(&samples, isa, &lighting);
    assert_below(worst_of(&lighting, gooch_expected, 0.01), 1e-5, "gooch, worst relative difference");
}

/* ---- what becomes of light ---- */

static d3 exposed_expected(const struct zr_linear_lighting *lighting, size_t at)
{
    const d3 emissive = d3_of(materials[samples.material[at]].emissive);
    const d3 light = d3_mad(around_expected(lighting, at), 1.0, emissive);
    return reference_tone(lighting->tone, d3_scale(light, (double)lighting->exposure));
}

static void exposure_comes_before_the_tone(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(28);
    const struct zr_lamp none = {.is_hemisphere = true};
    for (int tone = 0; tone < ZR_TONE_COUNT; tone++) {
        make_materials(&r, ZR_SHADING_PBR);
        for (int i = 0; i < MATERIALS; i++)
            materials[i].emissive = any3(&r, 0, 0.2);
        make_samples(&r);
        struct zr_linear_lighting lighting = no_light(materials);
        lighting.has_environment = zr_environment_make(ZR_ENVIRONMENT_STUDIO, &lighting.environment);
        lighting.lights.lamps = &none;
        lighting.tone = (enum zr_tone)tone;
        lighting.exposure = 0.7f;
        samples_light(&samples, isa, &lighting);
        assert_below(worst_of(&lighting, exposed_expected, 0.02), 1e-4, "exposed, worst relative difference");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(lamps_are_those_of_gltf),
        cmocka_unit_test(dielectrics_and_metals_are_those_of_both_forms),
        TEST_EACH_ISA(lamps_behind_and_of_others_give_nothing),
        TEST_EACH_ISA(light_from_all_around_is_as_defined),
        TEST_EACH_ISA(nothing_is_lost_in_a_white_furnace),
        TEST_EACH_ISA(occlusion_does_not_touch_lamps),
        TEST_EACH_ISA(classic_surfaces_are_as_defined),
        TEST_EACH_ISA(gooch_is_as_defined),
        TEST_EACH_ISA(exposure_comes_before_the_tone),
    };
    return cmocka_run_group_tests_name("surfaces", tests, NULL, NULL);
}
