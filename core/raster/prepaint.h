/* prepaint.h - raster: what raster/ carries along for those who shade what is seen, and knows nothing of.
 *
 * Words for samples go beside their owners, so that those who shade find them done. They are worked out while a
 * triangle's corners are at hand, by a kernel, for as many triangles as it has lanes.
 */
#ifndef ZR_PREPAINT_H
#define ZR_PREPAINT_H

#include "geometry/draw.h"

struct zr_prepaint;

/* numbers: of triangles of the draw; corners: [corner][x, y, 1/w][triangle] as they stand in the mesh, bit i of
 * `turned`: two of triangle i are to change places (rule 6). Samples: of which triangle each is (NULL: sample i of
 * triangle i), and where in the window; what follows the last one may be read, and written, a vector at a time. A word
 * is never 0. */
typedef void zr_prepaint_fn(const struct zr_prepaint *payload, const uint32_t *numbers, uint32_t turned,
                            const float *corners, const uint32_t *triangles, const float *x, const float *y,
                            uint32_t count, uint32_t *words);

/* Of one draw. */
struct zr_prepaint {
    zr_prepaint_fn *make; /* words of tiny and small triangles when they are drawn; NULL: none */
    const void *context;  /* of whom `make` is */
    const struct zr_draw *draw;
    /* Bit t % 32 of backs[t / 32] where triangle t shows its back, of those that are seen: noted when they are sorted.
     * NULL: not asked for. */
    uint32_t *backs;
    /* Where shading looks first for triangle 0; for each one behind it, `step` bytes farther. It is asked for from
     * memory when fragments are drawn. */
    uintptr_t first;
    size_t step;
};

/* Of triangles t and so on, a bit each, all in one word. */
static inline void zr_prepaint_add_backs(const struct zr_prepaint *payload, uint32_t t, uint32_t backs)
{
    payload->backs[t / 32] |= backs << t % 32;
}

#endif
