/* Averages of samples in linear light, by every instruction set: to the last bit what one sample after the other gives,
 * for every number of samples and pixels, and nothing beyond is written. */
#include "raster/tile.h"
#include "render/supersample.h"
#include "support/isas.h"
#include "support/random.h"

enum { SAMPLES = ZR_TILE_STRIDE * ZR_TILE_SIZE, ROOM = ZR_TILE_SIZE + 16 };

static _Alignas(64) float color[3][SAMPLES];
static _Alignas(64) uint32_t owner[SAMPLES];

static void make_samples(uint64_t seed)
{
    struct random random = random_seeded(seed);
    for (int i = 0; i < SAMPLES; i++) {
        for (int k = 0; k < 3; k++)
            color[k][i] = (float)random_below(&random, 1 << 24) / (float)(1 << 24);
        owner[i] = (uint32_t)random_below(&random, 3);
    }
}

static float average(const float *samples, uint32_t side)
{
    float sum = 0.0f;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            sum += samples[y * ZR_TILE_STRIDE + x];
    return sum * (1.0f / (float)(side * side));
}

static float cover(const uint32_t *owners, uint32_t side)
{
    uint32_t covered = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            covered += owners[y * ZR_TILE_STRIDE + x] != 0;
    return (float)covered * (1.0f / (float)(side * side));
}

static void check(enum zr_isa isa, uint32_t side, uint32_t pixels, uint32_t row)
{
    static const float untouched = -7.0f;
    float got[4][ROOM];
    const size_t from = (size_t)row * side * ZR_TILE_STRIDE;
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < ROOM; i++)
            got[k][i] = untouched;
    zr_averages_of(isa)->light((const float *const[3]){color[0] + from, color[1] + from, color[2] + from}, owner + from,
                               side, pixels, (float *const[4]){got[0], got[1], got[2], got[3]});
    for (uint32_t i = 0; i < ROOM; i++)
        for (int k = 0; k < 4; k++) {
            const size_t at = from + (size_t)i * side;
            const float want = i >= pixels ? untouched : k < 3 ? average(color[k] + at, side) : cover(owner + at, side);
            if (got[k][i] != want)
                fail_msg("%u x %u samples, %u pixels, row %u: value %d of pixel %u is %.9g, not %.9g", side, side,
                         pixels, row, k, i, (double)got[k][i], (double)want);
        }
}

static void light_is_averaged_sample_after_sample(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    make_samples(3);
    for (uint32_t side = 1; side <= 8; side *= 2)
        for (uint32_t pixels = 1; pixels <= ZR_TILE_SIZE / side; pixels++) {
            check(isa, side, pixels, 0);
            check(isa, side, pixels, ZR_TILE_SIZE / side - 1);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {TEST_EACH_ISA(light_is_averaged_sample_after_sample)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
