/* idat.h - output: compresses pixels to the zlib stream of a PNG, in consecutive parts.
 *
 * The size of the picture alone decides how it is divided into strips. Each strip is filtered and compressed
 * independently and ends on a whole byte. It is one part, with the same bytes for any thread (deflate.h). Idle threads
 * take the next strip. */
#ifndef ZR_IDAT_H
#define ZR_IDAT_H

#include "output/filter.h"
#include "output/rows.h"
#include "zraster.h"

enum { ZR_IDAT_WIDTH_MAX = 1 << 20 }; /* pixels */

struct zr_idat_image {
    enum zr_layout layout;
    uint32_t width, height; /* at least 1 */
    const uint8_t *pixels;  /* consecutive rows without gaps; NULL: use `rows` */
    struct zr_rows rows;
    const struct zr_column_span *spans; /* per row: all pixels outside of it are equal. NULL: unknown */
};

/* Calls take(context, bytes, size) for each part, in order, on the calling thread; it may leave by longjmp. Returns
 * ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. `team` and `cancel` may be NULL. */
enum zr_status zr_idat_make(const struct zr_idat_image *image, struct zr_arena *arena, struct zr_team *team,
                            const struct zr_cancel *cancel,
                            void (*take)(void *context, const uint8_t *bytes, size_t size), void *context);

#endif
