/* prepaint.h - raster: early colours: per-sample words that the shading stage adds. raster/ stores them and does not
 * interpret them.
 *
 * A kernel of the shading stage computes the words while a triangle's corners are loaded, for as many triangles as it
 * has lanes. The words are stored beside the owner ids, so that shading finds these samples done. */
#ifndef ZR_PREPAINT_H
#define ZR_PREPAINT_H

#include "geometry/draw.h"

struct zr_prepaint;

/* Computes `count` words. numbers: triangles of the draw. corners: [corner][x, y, 1/w][triangle] in the order of the
 * mesh. Bit i of `turned`: triangle i needs two corners swapped (rule 6). triangles: the triangle of each sample (NULL:
 * sample i is of triangle i). x, y: window positions of the samples. Reads and writes whole vectors beyond the last
 * sample. A word is never 0. */
typedef void zr_prepaint_fn(const struct zr_prepaint *prepaint, const uint32_t *numbers, uint32_t turned,
                            const float *corners, const uint32_t *triangles, const float *x, const float *y,
                            uint32_t count, uint32_t *words);

/* Callbacks and data of one draw. */
struct zr_prepaint {
    zr_prepaint_fn *make; /* computes words when tiny and small triangles are drawn; NULL: none */
    const void *context;  /* data of `make` */
    const struct zr_draw *draw;
    /* Bit t % 32 of backs[t / 32]: visible triangle t shows its back; set during binning. NULL: not recorded. */
    uint32_t *backs;
    /* Address that shading reads first for triangle 0; triangle t is `step` * t bytes after it. Prefetched when
     * fragments are drawn. */
    uintptr_t first;
    size_t step;
};

/* Adds the bits of triangles t and following, all in one word. */
static inline void zr_prepaint_add_backs(const struct zr_prepaint *prepaint, uint32_t t, uint32_t backs)
{
    prepaint->backs[t / 32] |= backs << t % 32;
}

#endif
