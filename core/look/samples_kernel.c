#include "look/samples.h"

#include <string.h>

#include "base/mutant.h"
#include "base/simd.h"
#include "raster/tile.h"

/* ---- bytes ---- */

/* Sums of the bytes of one pixel: red, green, blue, alpha; colours by their opacity. */
struct sums {
    uint32_t of[4];
};

static inline struct sums sums_of(const uint32_t *samples, uint32_t side)
{
    struct sums sums = {{0}};
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            uint8_t bytes[4];
            memcpy(bytes, &samples[y * ZR_TILE_SIZE + x], sizeof bytes);
            for (int k = 0; k < 3; k++)
                sums.of[k] += (uint32_t)bytes[k] * ZR_MUTANT(samples_not_by_opacity, bytes[3], 1u);
            sums.of[3] += bytes[3];
        }
    return sums;
}

/* Half up. */
static inline uint8_t divided(uint32_t sum, uint32_t by)
{
    return by > 0 ? (uint8_t)ZR_MUTANT(samples_rounded_down, (2 * sum + by) / (2 * by), sum / by) : 0;
}

static inline uint32_t average(const uint32_t *samples, uint32_t side)
{
    const struct sums sums = sums_of(samples, side);
    uint8_t bytes[4];
    uint32_t word;
    for (int k = 0; k < 3; k++)
        bytes[k] = divided(sums.of[k], ZR_MUTANT(samples_not_by_opacity, sums.of[3], side * side));
    bytes[3] = divided(sums.of[3], side * side);
    memcpy(&word, bytes, sizeof word);
    return word;
}

static inline bool are_alike(const uint32_t *samples, uint32_t side)
{
    uint32_t differ = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            differ |= samples[y * ZR_TILE_SIZE + x] ^ samples[0];
    return differ == 0;
}

/* Where all samples are alike, as most often, that is their average: a colour of no opacity is kept, too. */
static void bytes(const uint32_t *samples, uint32_t side, uint32_t pixels, uint32_t *out)
{
    for (uint32_t i = 0; i < pixels; i++, samples += side)
        out[i] = are_alike(samples, side) ? samples[0] : average(samples, side);
}

/* ---- light ---- */

static void light(const float *const color[3], const uint32_t *owner, uint32_t side, uint32_t pixels,
                  float *const out[4])
{
    const float share = 1.0f / (float)(side * side);
    for (uint32_t i = 0; i < pixels; i++) {
        float sums[3] = {0.0f, 0.0f, 0.0f};
        uint32_t covered = 0;
        for (uint32_t y = 0; y < side; y++)
            for (uint32_t x = 0; x < side; x++) {
                const size_t at = (size_t)y * ZR_TILE_STRIDE + i * side + x;
                for (int k = 0; k < 3; k++)
                    sums[k] += color[k][at];
                covered += owner[at] != 0;
            }
        for (int k = 0; k < 3; k++)
            out[k][i] = sums[k] * share;
        out[3][i] = (float)covered * share;
    }
}

const struct zr_averages ZR_KERNEL(zr_averages) = {bytes, light};
