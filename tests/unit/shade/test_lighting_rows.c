/* Rows of G-buffers end where they end: what lies behind is looked at by kernels, and must not matter. */
#include <math.h>
#include <string.h>

#include "shade/lights/lighting.h"
#include "support/isas.h"
#include "support/tests.h"

enum { ROOM = 64 };

struct row {
    _Alignas(64) float base[3][ROOM], normal[3][ROOM], point[3][ROOM], out[3][ROOM];
    _Alignas(64) uint32_t owner[ROOM], material[ROOM];
};

/* `count` samples of material 0, and behind them what was there before. */
static void fill(struct row *row, size_t count, uint32_t owner, uint32_t material, float value)
{
    for (size_t i = 0; i < ROOM; i++) {
        row->owner[i] = i < count ? 1 : owner;
        row->material[i] = i < count ? 0 : material;
        for (int k = 0; k < 3; k++) {
            row->base[k][i] = i < count ? 0.25f * (float)k + 0.01f * (float)i : value;
            row->normal[k][i] = i < count ? (k == 2 ? 1.0f : 0.0f) : value;
            row->point[k][i] = i < count ? (k == 2 ? -3.0f : 0.1f * (float)i) : value;
        }
    }
}

static void light(struct row *row, enum zr_isa isa, size_t count)
{
    static const struct zr_material material = {.shading = ZR_SHADING_PBR, ZR_MATERIAL_PLASTIC, .roughness = 0.5f};
    struct zr_gbuffer samples = {
        .width = (int32_t)count, .height = 1, .stride = ROOM, .owner = row->owner, .material = row->material};
    struct zr_linear_lighting lighting = {.materials = &material,
                                          .lights = {.ambient = {0.5f, 0.5f, 0.5f}},
                                          .environment_intensity = 1,
                                          .eye_to_environment = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          .tone = ZR_TONE_NEUTRAL,
                                          .exposure = 1};
    lighting.has_environment = zr_environment_make(ZR_ENVIRONMENT_STUDIO, &lighting.environment);
    for (int k = 0; k < 3; k++) {
        samples.base[k] = row->base[k];
        samples.normal[k] = row->normal[k];
        samples.point[k] = row->point[k];
    }
    zr_linear_light_of(isa)(&lighting, &samples, NULL, (float *const[3]){row->out[0], row->out[1], row->out[2]});
}

TEST_EACH_ISA(what_is_behind_a_row_does_not_matter)
{
    static struct row clean, dirty;
    const enum zr_isa isa = isa_under_test(state);
    for (size_t count = 1; count < 40; count++) {
        fill(&clean, count, 0, 0, 0.0f);
        fill(&dirty, count, 0x7fffffff, 0x38101010, NAN); /* no such material */
        light(&clean, isa, count);
        light(&dirty, isa, count);
        for (int k = 0; k < 3; k++) {
            assert_true(clean.out[k][0] > 0.0f && clean.out[k][0] <= 1.0f);
            assert_memory_equal(clean.out[k], dirty.out[k], count * sizeof(float));
        }
    }
}

RUN_TESTS(NULL, NULL)
