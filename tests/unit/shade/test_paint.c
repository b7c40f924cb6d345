/* Kernels of shade/paint.h by themselves: sums become bytes as one by one, and nothing beyond the window is written. */
#include "base/rgba.h"
#include "shade/paint.h"
#include "support/isas.h"
#include "support/random.h"

enum { SAMPLES = ZR_TILE_STRIDE * ZR_TILE_SIZE, UNTOUCHED = 0x1234567, NOTHING = 0x7654321 };

static struct zr_tile tile;
static float sums[4][SAMPLES];
static uint32_t ends[SAMPLES + 1], got[SAMPLES];

static void make_sums(uint64_t seed, int32_t width, int32_t height)
{
    static const float alphas[] = {0.0f, 1.0f, 1.0000001f, 0.5f, 1e-30f, 0.25f};
    struct random random = random_seeded(seed);
    tile.width = width;
    tile.height = height;
    ends[0] = 0;
    for (int i = 0; i < SAMPLES; i++) {
        for (int k = 0; k < 3; k++)
            sums[k][i] = (float)random_range(&random, -0.1, 1.1);
        sums[3][i] = alphas[random_below(&random, sizeof alphas / sizeof *alphas)];
        tile.owner[i] = random_below(&random, 2) * random_below(&random, 1000);
        ends[i + 1] = ends[i] + random_below(&random, 2);
        got[i] = UNTOUCHED;
    }
}

static uint32_t want_at(int32_t i, bool is_opaque)
{
    const float a = sums[3][i];
    const zr_vec4 c = {sums[0][i], sums[1][i], sums[2][i], a};
    if (tile.owner[i] == 0 && ends[i] == ends[i + 1]) return NOTHING;
    if (is_opaque || tile.owner[i] > 0) return zr_rgba_opaque(c);
    return zr_rgba_make(a > 0.0f ? (zr_vec4){c.x / a, c.y / a, c.z / a, a} : c);
}

TEST_EACH_ISA(sums_are_packed_as_one_by_one)
{
    const struct zr_paint *paint = zr_paint_of(isa_under_test(state));
    const float *const sum[4] = {sums[0], sums[1], sums[2], sums[3]};
    const struct zr_pixel_rows out = {.first = got, .stride = ZR_TILE_STRIDE};
    for (int32_t width = 1; width <= ZR_TILE_SIZE; width += 7)
        for (int is_opaque = 0; is_opaque <= 1; is_opaque++) {
            make_sums((uint64_t)width, width, ZR_TILE_SIZE - width / 2);
            paint->pack(&tile, sum, ends, is_opaque, NOTHING, &out);
            for (int32_t i = 0; i < SAMPLES; i++) {
                const bool within = i % ZR_TILE_STRIDE < width && i / ZR_TILE_STRIDE < tile.height;
                assert_int_equal(got[i], within ? want_at(i, is_opaque) : UNTOUCHED);
            }
        }
}

RUN_TESTS(NULL, NULL)
