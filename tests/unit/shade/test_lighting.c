/* The kernel that lights samples: it writes its samples only, and any input gives a colour. */
#include "scene/looks.h"
#include "support/isas.h"
#include "unit/common/lit_samples.h"

enum { MATERIALS = 24, LAMPS = 4, PLACED = 3 };

static struct lit_samples samples, others;
static struct zr_material materials[MATERIALS];
static struct zr_lamp lamps[LAMPS + PLACED]; /* placed ones last */

static void make_materials(struct random *r)
{
    for (int i = 0; i < MATERIALS; i++)
        materials[i] = (struct zr_material){.shading = (enum zr_shading)(i % ZR_SHADING_COUNT),
                                            .metallic = any(r, 0, 1),
                                            .roughness = any(r, 0, 1),
                                            .specular = any3(r, 0, 0.5),
                                            .shininess = any(r, 0, 100),
                                            .emissive = any3(r, 0, 0.1),
                                            .cool = any3(r, 0, 1)};
}

/* A point lamp, one with a range, and a spot; one lights not all shadings. `scale`: of their light. */
static void make_placed(struct random *r, float scale)
{
    static const struct zr_camera camera = {.world_to_eye = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                            .projection = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0}}};
    for (int i = 0; i < PLACED; i++) {
        struct zr_light light = {.type = i == 2 ? ZR_LIGHT_SPOT : ZR_LIGHT_POINT,
                                 .position = {any(r, -3, 3), any(r, -3, 3), any(r, -6, 1)},
                                 .color = zr_vec3_scale(any3(r, 0, 2), scale),
                                 .direction = any_unit(r),
                                 .range = i == 1 ? any(r, 1, 9) : 0.0f,
                                 .inner_degrees = 20,
                                 .outer_degrees = 80};
        if (random_below(r, 4) == 0) light.position = (zr_vec3){0, 0, 0};
        lamps[LAMPS + i] = (struct zr_lamp){.is_placed = true,
                                            .place = zr_lamp_place_of(&light, &camera),
                                            .color = light.color,
                                            .lights_pbr = i != 1,
                                            .lights_classic = i != 0};
    }
}

static struct zr_linear_lighting make_lighting(struct random *r)
{
    struct zr_linear_lighting lighting = no_light(materials);
    for (int i = 0; i < LAMPS; i++)
        lamps[i] = (struct zr_lamp){.to_light = any_unit(r),
                                    .color = any3(r, 0, 0.5),
                                    .ground = any3(r, 0, 0.2),
                                    .is_hemisphere = i % 2,
                                    .lights_pbr = i != 2,
                                    .lights_classic = i != 3};
    lighting.lights =
        (struct zr_lights){.ambient = any3(r, 0, 0.1), .count = LAMPS + PLACED, .placed_count = PLACED, .lamps = lamps};
    make_placed(r, 1.0f);
    lighting.has_environment = zr_environment_make(ZR_ENVIRONMENT_OUTDOOR, &lighting.environment);
    lighting.tone = ZR_TONE_NEUTRAL;
    return lighting;
}

/* Runs of one material and base colour, as pictures have them, and mixed ones; lines, and nobody, here and there. */
static void make_samples(struct lit_samples *s, struct random *r)
{
    samples_clear(s);
    for (size_t i = 0; i < SAMPLES; i++) {
        const uint32_t kind = random_below(r, 16);
        const bool goes_on = i > 0 && i / 512 % 2 && kind > 3 && s->owner[i - 1];
        if (kind == 0) continue;
        samples_set_any(s, r, i, goes_on ? s->material[i - 1] : random_below(r, MATERIALS));
        if (goes_on) put3(s->g.base, i, get3(s->g.base, i - 1));
        if (kind == 1) put3(s->g.normal, i, (zr_vec3){0, 0, 0});
    }
}

/* ---- what is written ---- */

static void assert_same_outs(const struct lit_samples *a, const struct lit_samples *b, size_t first, size_t count)
{
    for (int k = 0; k < 3; k++)
        assert_memory_equal(a->out[k] + first, b->out[k] + first, count * sizeof a->out[k][0]);
}

/* A part of all samples, as rows of their own. */
static struct zr_gbuffer part_of(const struct zr_gbuffer *g, size_t first, int32_t width, int32_t height,
                                 ptrdiff_t stride)
{
    struct zr_gbuffer part = {.width = width,
                              .height = height,
                              .stride = stride,
                              .owner = g->owner + first,
                              .material = g->material + first};
    for (int k = 0; k < 3; k++) {
        part.base[k] = g->base[k] + first;
        part.normal[k] = g->normal[k] + first;
        part.point[k] = g->point[k] + first;
    }
    return part;
}

static void clear_others(void)
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < ROOM; i++)
            others.out[k][i] = -7.0f;
}

/* From anywhere, any width, and at most 15 more of a row are written. */
TEST_EACH_ISA(odd_sizes_are_part_of_all)
{
    const enum zr_isa isa = isa_under_test(state);
    enum { STRIDE = 80 };
    struct random r = random_seeded(31);
    make_materials(&r);
    make_samples(&samples, &r);
    const struct zr_linear_lighting lighting = make_lighting(&r);
    samples_light(&samples, ZR_ISA_SCALAR, &lighting);
    for (int round = 0; round < 300; round++) {
        const size_t width = random_below(&r, STRIDE - 15), height = random_below(&r, 5);
        const size_t first = random_below(&r, SAMPLES - 5 * STRIDE);
        const struct zr_gbuffer part = part_of(&samples.g, first, (int32_t)width, (int32_t)height, STRIDE);
        float *const out[3] = {others.out[0] + first, others.out[1] + first, others.out[2] + first};
        clear_others();
        zr_linear_light_of(isa)(&lighting, &part, samples.open + first, out);
        for (size_t y = 0; y < height; y++)
            assert_same_outs(&samples, &others, first + y * STRIDE, width);
        for (size_t i = 0; i < ROOM; i++) {
            const bool may =
                width > 0 && i >= first && i < first + height * STRIDE && (i - first) % STRIDE < width + 15;
            for (int k = 0; k < 3; k++)
                if (!may) assert_true(others.out[k][i] == -7.0f);
        }
    }
}

/* ---- what may happen ---- */

static float extreme(struct random *r)
{
    static const float values[] = {0.0f, -0.0f, 1e-45f, 1e-38f, 1e-20f, 1e-7f, 0.5f, 1.0f, -1.0f, -1e-30f};
    return values[random_below(r, sizeof values / sizeof values[0])];
}

static zr_vec3 extreme3(struct random *r)
{
    zr_vec3 v = {extreme(r), extreme(r), extreme(r)};
    return v;
}

/* Points at the eye and as far as there are any; normals that are not quite unit, or turn away; colours beyond 0..1. */
static void make_extreme_samples(struct random *r)
{
    samples_clear(&samples);
    for (size_t i = 0; i < SAMPLES; i++) {
        const float far = i % 3 ? 1.0f : ZR_FAR_POINT;
        const zr_vec3 normal = i % 2 ? extreme3(r) : any_unit(r), point = zr_vec3_scale(extreme3(r), far);
        samples_set(&samples, i, random_below(r, MATERIALS), zr_vec3_scale(extreme3(r), i % 5 ? 1.0f : 1e30f), normal,
                    point);
        samples.open[i] = (float)(i % 2);
    }
}

static float powers(struct random *r)
{
    return (float)pow(10.0, random_range(r, -12, 6));
}

/* Lights and exposure as strong as scenes may have them, and so weak that they are hardly there. */
static struct zr_linear_lighting make_extreme_lighting(struct random *r, uint32_t round)
{
    struct zr_linear_lighting lighting = make_lighting(r);
    for (int i = 0; i < MATERIALS; i++) {
        materials[i].roughness = (float[]){0, 1e-20f, 1e-6f, 0.999999f, 1, 0.5f}[random_below(r, 6)];
        materials[i].metallic = (float)random_below(r, 2);
        materials[i].shininess = (float[]){0, 1e-6f, 1, 10000}[random_below(r, 4)];
    }
    for (int i = 0; i < LAMPS; i++)
        lamps[i].color = zr_vec3_scale(lamps[i].color, powers(r));
    make_placed(r, round % 2 ? 1e15f : powers(r));
    lighting.environment_intensity = powers(r);
    lighting.exposure = powers(r);
    lighting.tone = (enum zr_tone)(round % ZR_TONE_COUNT);
    return lighting;
}

TEST_EACH_ISA(all_input_gives_colors)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(34);
    for (uint32_t round = 0; round < 60; round++) {
        make_materials(&r);
        make_extreme_samples(&r);
        const struct zr_linear_lighting lighting = make_extreme_lighting(&r, round);
        samples_light(&samples, isa, &lighting);
        for (size_t i = 0; i < SAMPLES; i++)
            for (int k = 0; k < 3; k++)
                if (!(samples.out[k][i] >= 0.0f && samples.out[k][i] <= 1.0f))
                    fail_msg("sample %zu, shading %d: %g", i, (int)materials[samples.material[i]].shading,
                             (double)samples.out[k][i]);
        others = samples;
        samples_light(&samples, ZR_ISA_SCALAR, &lighting);
        assert_same_outs(&samples, &others, 0, SAMPLES);
    }
}

/* Not black, as where a number had no value and was clamped. */
TEST_EACH_ISA(strong_light_is_white)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(35);
    for (int round = 0; round < 12; round++) {
        make_materials(&r);
        struct zr_linear_lighting lighting = make_lighting(&r);
        lighting.exposure = lighting.environment_intensity = 1e6f;
        lighting.tone = (enum zr_tone)(round % ZR_TONE_COUNT);
        lamps[0].color = lamps[1].color = lamps[2].color = (zr_vec3){1e6f, 1e6f, 1e6f};
        make_extreme_samples(&r);
        for (size_t i = 0; i < SAMPLES; i++) {
            samples.material[i] = 2 * (uint32_t)i % MATERIALS; /* flat, phong, pbr, and what is not lit */
            samples.open[i] = 1.0f;
            put3(samples.g.base, i, (zr_vec3){0.9f, 0.9f, 0.9f});
            put3(samples.g.normal, i, any_unit(&r));
        }
        samples_light(&samples, isa, &lighting);
        for (size_t i = 0; i < SAMPLES; i++) {
            const enum zr_shading shading = materials[samples.material[i]].shading;
            if (shading == ZR_SHADING_PBR || shading == ZR_SHADING_FLAT || shading == ZR_SHADING_PHONG)
                for (int k = 0; k < 3; k++)
                    assert_true(samples.out[k][i] > 0.99f);
        }
    }
}

/* Halfway between the light and the eye there is no direction then. */
TEST_EACH_ISA(light_from_straight_behind_changes_nothing)
{
    const enum zr_isa isa = isa_under_test(state);
    static const struct zr_material metal = {
        .shading = ZR_SHADING_PBR, ZR_MATERIAL_PLASTIC, .roughness = 0.5f, .metallic = 0.5f};
    static const struct zr_lamp behind = {.to_light = {0, 0, -1}, .color = {1, 1, 1}, .lights_pbr = true};
    struct zr_linear_lighting lighting = no_light(&metal);
    lighting.lights.ambient = (zr_vec3){0.5f, 0.5f, 0.5f};
    lighting.is_parallel = true;
    lighting.to_eye = (zr_vec3){0, 0, 1};
    lighting.lights.lamps = &behind;
    samples_clear(&samples);
    samples_set(&samples, 0, 0, (zr_vec3){1, 1, 1}, (zr_vec3){0, 0.6f, 0.8f}, (zr_vec3){0, 0, 0});
    samples_light(&samples, isa, &lighting);
    others = samples;
    lighting.lights.count = 1;
    samples_light(&samples, isa, &lighting);
    assert_true(samples.out[0][0] > 0.1f);
    assert_same_outs(&samples, &others, 0, 1);
}

RUN_TESTS(NULL, NULL)
