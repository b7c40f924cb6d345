/* Where thin pieces of shapes lie: the samples at which the comparison knows of coverage only. */
#include "reference/generate/batches.h"

/* Twice the area of a, b and the sample's side of the edge, on the snapped grid. */
static int64_t side_of(const struct batches_thin *t, int from, int to, int64_t x, int64_t y)
{
    return ((int64_t)t->x[to] - t->x[from]) * (y - t->y[from]) - ((int64_t)t->y[to] - t->y[from]) * (x - t->x[from]);
}

void batches_mark_thin(const struct batches *batches, uint32_t width, uint32_t height, uint8_t *gaps)
{
    for (uint32_t i = 0; i < batches->thin_count; i++) {
        const struct batches_thin *t = &batches->thin[i];
        int32_t low[2] = {t->x[0], t->y[0]}, high[2] = {t->x[0], t->y[0]};
        for (int k = 1; k < 3; k++) {
            low[0] = t->x[k] < low[0] ? t->x[k] : low[0];
            low[1] = t->y[k] < low[1] ? t->y[k] : low[1];
            high[0] = t->x[k] > high[0] ? t->x[k] : high[0];
            high[1] = t->y[k] > high[1] ? t->y[k] : high[1];
        }
        for (int32_t y = (low[1] + 255) >> 8; y <= high[1] >> 8; y++)
            for (int32_t x = (low[0] + 255) >> 8; x <= high[0] >> 8; x++) {
                int64_t a = side_of(t, 0, 1, x * 256, y * 256), b = side_of(t, 1, 2, x * 256, y * 256),
                        c = side_of(t, 2, 0, x * 256, y * 256);
                bool inside = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); /* edges too */
                if (inside && x >= 0 && y >= 0 && x < (int32_t)width && y < (int32_t)height)
                    gaps[(size_t)(height - 1 - (uint32_t)y) * width + (size_t)x] = 1;
            }
    }
}
