/* Limits of lit surfaces: a white furnace loses and gains nothing, lamps behind a surface do not light it. */
#include "support/isas.h"
#include "unit/common/lit_samples.h"

enum { MATERIALS = 64 };

static struct lit_samples samples;
static struct zr_material materials[MATERIALS];

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
                                            ZR_MATERIAL_PLASTIC,
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

TEST_EACH_ISA(lamps_behind_and_of_others_give_nothing)
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

static struct zr_environment_light uniform_environment(void)
{
    return (struct zr_environment_light){
        .sky = {1, 1, 1}, .ground = {1, 1, 1}, .half_width = 0.1f, .harmonics = {{1, 1, 1}}};
}

static void furnace(enum zr_isa isa, const struct zr_linear_lighting *lighting, double *least, double *most)
{
    for (size_t i = 0; i < MATERIALS; i++)
        materials[i] = (struct zr_material){.shading = ZR_SHADING_PBR,
                                            ZR_MATERIAL_PLASTIC,
                                            .metallic = (float)(i % 2),
                                            .roughness = (float)(i / 2) / (MATERIALS / 2 - 1)};
    samples_clear(&samples);
    for (size_t i = 0; i < SAMPLES; i++) {
        const float nv = 0.05f + 0.95f * (float)(i / MATERIALS) / (SAMPLES / MATERIALS - 1);
        samples_set(&samples, i, (uint32_t)(i % MATERIALS), (zr_vec3){1, 1, 1},
                    (zr_vec3){sqrtf(fmaxf(0.0f, 1.0f - nv * nv)), 0, nv}, (zr_vec3){0, 0, -2});
    }
    samples_light(&samples, isa, lighting);
    for (size_t i = 0; i < SAMPLES; i++)
        for (int k = 0; k < 3; k++) {
            *least = fmin(*least, 2.0 * (double)samples.out[k][i]);
            *most = fmax(*most, 2.0 * (double)samples.out[k][i]);
        }
}

/* At half the exposure, so that what is more than 1 would be seen. */
TEST_EACH_ISA(nothing_is_lost_in_a_white_furnace)
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

RUN_TESTS(NULL, NULL)
