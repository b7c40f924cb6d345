#include "ssim.h"

#include <stdlib.h>

enum { WINDOW = 11, REACH = WINDOW / 2, FIELDS = 5 }; /* fields: a, b, a a, b b, a b */

/* exp(-x^2 / 4.5) from the middle on. */
static const double weights[REACH + 1] = {
    1.0, 0.80073740291680806, 0.41111229050718745, 0.13533528323661270, 0.028565500784550377, 0.0038659201394728066};

static double weight_at(int i)
{
    double sum = weights[0];
    for (int k = 1; k <= REACH; k++)
        sum += 2 * weights[k];
    return weights[i < REACH ? REACH - i : i - REACH] / sum;
}

/* Returns the luma, 0..1, over white (BT.601). */
static double luma_of(const struct pixels *pixels, uint32_t x, uint32_t y)
{
    const double white = pixels->is_16_bit ? 65535 : 255;
    const uint16_t *at = pixels->rgba + 4 * ((size_t)y * pixels->width + x);
    const double luma = 0.299 * at[0] + 0.587 * at[1] + 0.114 * at[2], alpha = at[3] / white;
    return luma / white * alpha + (1 - alpha);
}

/* Filters a row along x into `out`, FIELDS numbers per window. */
static void filter_row(const struct pixels *a, const struct pixels *b, uint32_t y, double *lumas, double *out)
{
    for (uint32_t x = 0; x < a->width; x++) {
        lumas[2 * x] = luma_of(a, x, y);
        lumas[2 * x + 1] = luma_of(b, x, y);
    }
    for (uint32_t x = 0; x + WINDOW <= a->width; x++, out += FIELDS) {
        for (int f = 0; f < FIELDS; f++)
            out[f] = 0;
        for (int i = 0; i < WINDOW; i++) {
            const double w = weight_at(i), p = lumas[2 * (x + (uint32_t)i)], q = lumas[2 * (x + (uint32_t)i) + 1];
            out[0] += w * p;
            out[1] += w * q;
            out[2] += w * p * p;
            out[3] += w * q * q;
            out[4] += w * p * q;
        }
    }
}

/* Returns the SSIM of a window, from its rows. */
static double ssim_at(const double *rows, size_t stride, uint32_t y, size_t x)
{
    double sum[FIELDS] = {0};
    for (uint32_t i = 0; i < WINDOW; i++)
        for (int f = 0; f < FIELDS; f++)
            sum[f] += weight_at((int)i) * rows[(y + i) % WINDOW * stride + FIELDS * x + (size_t)f];
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03, products = sum[0] * sum[1],
                 squares = sum[0] * sum[0] + sum[1] * sum[1], variances = sum[2] + sum[3] - squares,
                 covariance = sum[4] - products;
    return (2 * products + c1) * (2 * covariance + c2) / ((squares + c1) * (variances + c2));
}

double ssim_of(const struct pixels *a, const struct pixels *b)
{
    if (a->width < WINDOW || a->height < WINDOW) return -2;
    const size_t windows = a->width - WINDOW + 1, stride = FIELDS * windows;
    double *rows = malloc(WINDOW * stride * sizeof *rows), *lumas = malloc(2 * (size_t)a->width * sizeof *lumas),
           sum = 0;
    for (uint32_t y = 0; rows && lumas && y < a->height; y++) {
        filter_row(a, b, y, lumas, rows + y % WINDOW * stride);
        for (size_t x = 0; y + 1 >= WINDOW && x < windows; x++)
            sum += ssim_at(rows, stride, y + 1 - WINDOW, x);
    }
    const bool ok = rows && lumas;
    free(rows);
    free(lumas);
    return ok ? sum / ((double)windows * (a->height - WINDOW + 1)) : -2;
}
