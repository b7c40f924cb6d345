/* Surfaces between plastic and metal: mixes of both, of which none loses light. */
#include "scene/scene.h"
#include "support/isas.h"
#include "unit/common/lit_samples.h"

enum { STEPS = 5, VIEWS = 8, PAIRS = STEPS * STEPS };

static struct lit_samples samples;
static struct zr_material materials[PAIRS];
static const struct zr_lamp lamp = {
    .to_light = {0.48f, 0.6f, 0.64f}, .color = {0.02f, 0.02f, 0.02f}, .lights_pbr = true};

/* Sample (pair, view) has the material of its pair, roughness slowest, and a normal of its view. */
static void make_samples(zr_vec3 base, zr_vec3 reflectance)
{
    samples_clear(&samples);
    for (int pair = 0; pair < PAIRS; pair++) {
        materials[pair] = (struct zr_material){.shading = ZR_SHADING_PBR,
                                               .roughness = (float)(pair / STEPS) / (STEPS - 1),
                                               .metallic = (float)(pair % STEPS) / (STEPS - 1),
                                               .reflectance = reflectance,
                                               .grazing = 1.0f};
        for (int view = 0; view < VIEWS; view++) {
            const float z = ((float)view + 0.5f) / VIEWS;
            samples_set(&samples, (size_t)(pair * VIEWS + view), (uint32_t)pair, base,
                        (zr_vec3){sqrtf(1.0f - z * z), 0, z}, (zr_vec3){0, 0, 0});
        }
    }
}

static struct zr_linear_lighting from_the_front(void)
{
    struct zr_linear_lighting lighting = no_light(materials);
    lighting.is_parallel = true;
    lighting.to_eye = (zr_vec3){0, 0, 1};
    return lighting;
}

static float got(int roughness, int metallic, int view, int channel)
{
    return samples.out[channel][(roughness * STEPS + metallic) * VIEWS + view];
}

/* Within 1 % of the mix of metal and plastic. */
static void check_mixes(void)
{
    for (int rough = 0; rough < STEPS; rough++)
        for (int metal = 0; metal < STEPS; metal++)
            for (int view = 0; view < VIEWS; view++)
                for (int k = 0; k < 3; k++) {
                    const float share = (float)metal / (STEPS - 1), all = got(rough, STEPS - 1, view, k);
                    const float want = got(rough, 0, view, k) * (1.0f - share) + all * share;
                    assert_true(want > 0.0f && all < 1.0f);
                    if (!(fabsf(got(rough, metal, view, k) - want) <= 0.01f * want))
                        fail_msg("roughness %d/4, metallic %d/4, view %d, channel %d: %f instead of %f", rough, metal,
                                 view, k, (double)got(rough, metal, view, k), (double)want);
                }
}

static const zr_vec3 bases[] = {{1, 0.6f, 0.2f}, {0.02f, 0.5f, 0.9f}, {0, 0, 0}, {1, 1, 1}};
static const zr_vec3 plastics[] = {{0.04f, 0.04f, 0.04f}, {0.1f, 0.02f, 0.04f}, {0.5f, 0.5f, 0.5f}};

TEST_EACH_ISA(colors_are_mixes_of_metal_and_plastic)
{
    const enum zr_isa isa = isa_under_test(state);
    struct zr_linear_lighting lights[3] = {from_the_front(), from_the_front(), from_the_front()};
    lights[0].lights.ambient = (zr_vec3){0.4f, 0.4f, 0.4f};
    lights[1].has_environment = zr_environment_make(ZR_ENVIRONMENT_STUDIO, &lights[1].environment);
    lights[1].environment_intensity = 0.1f;
    lights[2].lights.count = 1;
    lights[2].lights.lamps = &lamp;
    for (int light = 0; light < 3; light++)
        for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
            for (size_t k = 0; k < sizeof plastics / sizeof *plastics; k++) {
                make_samples(bases[i], plastics[k]);
                samples_light(&samples, isa, &lights[light]);
                check_mixes();
            }
}

/* Under light that is the same from everywhere, what absorbs nothing is as bright as its surroundings. */
TEST_EACH_ISA(white_surfaces_lose_no_light)
{
    const enum zr_isa isa = isa_under_test(state);
    struct zr_linear_lighting lighting = from_the_front();
    lighting.lights.ambient = (zr_vec3){0.5f, 0.5f, 0.5f};
    for (size_t i = 0; i < sizeof plastics / sizeof *plastics; i++) {
        if (plastics[i].x != plastics[i].z) continue;
        make_samples((zr_vec3){1, 1, 1}, plastics[i]);
        samples_light(&samples, isa, &lighting);
        for (int at = 0; at < PAIRS * VIEWS; at++)
            for (int k = 0; k < 3; k++)
                assert_true(fabsf(samples.out[k][at] - 0.5f) <= 1e-5f);
    }
}

RUN_TESTS(NULL, NULL)
