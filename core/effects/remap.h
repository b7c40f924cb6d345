/* remap.h - effects: a picture through a lens, from a pinhole picture (scene/camera/lens_plan.h).
 *
 * Space:  rows from the top, as in frames. The place of each pixel of the view is a point of the pinhole picture, whose
 *         pixels have their centres at whole numbers.
 * Data:   a pixel has the words of the nearest pixel of the pinhole picture, never a mixture.
 * Colour: a pixel is the mean of n x m places within it. The colour of a place is mixed from its four nearest pixels by
 *         bilinear weights. n and m are 1; if the lens shrinks the pinhole picture there by more than 1.5, up to 8.
 *         Colours are mixed as they are stored, in proportion to their alpha.
 * Exact:  places are rounded to 1/4096 pixel, and colours are mixed in integers.
 */
#ifndef ZR_REMAP_H
#define ZR_REMAP_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/status.h"
#include "base/team.h"
#include "scene/camera/lens_plan.h"

enum { ZR_REMAP_BITS = 12, ZR_REMAP_ONE = 1 << ZR_REMAP_BITS };

/* x and y in 1/4096 pixel; x is ZR_REMAP_NOWHERE if the pixel has no ray. */
#define ZR_REMAP_NOWHERE INT32_MIN

struct zr_remap_place {
    int32_t x, y;
};

struct zr_remap {
    uint32_t width, height;               /* of the view */
    uint32_t source_width, source_height; /* of the pinhole picture */
    const struct zr_remap_place *places;  /* width * height */
    uint64_t nowhere;                     /* pixels without a ray */
};

/* Finds the places of all pixels. ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. `team` may be NULL. */
enum zr_status zr_remap_make(const struct zr_run *run, const struct zr_lens_plan *plan, struct zr_remap *remap);

/* A pixel of the pinhole picture. */
struct zr_remap_pixel {
    uint32_t x, y;
};

/* Finds the pixel of the pinhole picture that is nearest to the place of pixel x, y of the view. False if it has no
 * ray. */
static inline bool zr_remap_nearest_pixel(const struct zr_remap *remap, uint32_t x, uint32_t y,
                                          struct zr_remap_pixel *pixel)
{
    const struct zr_remap_place place = remap->places[(size_t)y * remap->width + x];
    if (place.x == ZR_REMAP_NOWHERE) return false;
    pixel->x = (uint32_t)(place.x + ZR_REMAP_ONE / 2) >> ZR_REMAP_BITS;
    pixel->y = (uint32_t)(place.y + ZR_REMAP_ONE / 2) >> ZR_REMAP_BITS;
    return true;
}

/* Writes the pixels of a channel of `words` words per pixel. Pixels without a ray get `clear` in every word. ZR_OK or
 * ZR_CANCELLED. */
enum zr_status zr_remap_nearest(const struct zr_run *run, const struct zr_remap *remap, uint32_t words, uint32_t clear,
                                const uint32_t *source, uint32_t *out);

/* Writes the pixels of a colour, four bytes in memory: red, green, blue and alpha. ZR_OK or ZR_CANCELLED. */
enum zr_status zr_remap_color(const struct zr_run *run, const struct zr_remap *remap, uint32_t clear,
                              const uint32_t *source, uint32_t *out);

#endif
