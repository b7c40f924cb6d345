#include "lines/ink.h"
#include "base/run.h"

enum { ROWS_PER_RANGE = 16 };

struct laying {
    const struct zr_cancel *cancel;
    const float *opacity;
    float color[3]; /* 0..255 */
    uint32_t width, height;
    uint8_t *pixels;
};

static void lay_pixel(const struct laying *l, float ink, uint8_t *pixel)
{
    const float below = (float)pixel[3] * (1.0f / 255.0f) * (1.0f - ink), alpha = ink + below;
    const float share = pixel[3] == 255 ? ink : ink / alpha;
    for (int k = 0; k < 3; k++) {
        const float own = (float)pixel[k];
        pixel[k] = (uint8_t)(own + (l->color[k] - own) * share + 0.5f);
    }
    if (pixel[3] != 255) pixel[3] = (uint8_t)(alpha * 255.0f + 0.5f);
}

static void lay_rows(void *context, size_t begin, size_t end)
{
    const struct laying *l = context;
    for (size_t y = begin; y < end && !zr_is_cancelled(l->cancel); y++) {
        const float *opacity = l->opacity + y * l->width;
        uint8_t *row = l->pixels + 4 * (l->height - 1 - y) * l->width;
        for (size_t x = 0; x < l->width; x++)
            if (opacity[x] > 0.0f) lay_pixel(l, opacity[x], row + 4 * x);
    }
}

void zr_ink_lay(const struct zr_run *run, const float *opacity, zr_vec3 color, uint32_t width, uint32_t height,
                uint8_t *pixels)
{
    struct laying laying = {.cancel = run->cancel,
                            .opacity = opacity,
                            .color = {255.0f * color.x, 255.0f * color.y, 255.0f * color.z},
                            .width = width,
                            .height = height,
                            .pixels = pixels};
    zr_team_ranges(run->team, height, ROWS_PER_RANGE, lay_rows, &laying);
}
