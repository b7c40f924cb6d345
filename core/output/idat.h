/* idat.h - output: pixels -> the zlib stream of a PNG, in parts that follow one another.
 *
 * A picture is cut into strips by its size alone, however many threads work on it. Each strip is filtered and deflated
 * for itself and ends on a whole byte; it is a part, and the same bytes whichever thread makes it (deflate.h).
 * Idle threads take strips as they come.
 */
#ifndef ZR_IDAT_H
#define ZR_IDAT_H

#include "output/filter.h"
#include "output/rows.h"
#include "zraster.h"

enum { ZR_IDAT_WIDTH_MAX = 1 << 20 }; /* pixels */

struct zr_idat_image {
    enum zr_layout layout;
    uint32_t width, height; /* at least 1 */
    const uint8_t *pixels;  /* rows follow one another without a gap; where it is NULL: */
    struct zr_rows rows;
    const struct zr_column_span *reaches; /* of each row: pixels outside of it are all the same. NULL: not known */
};

/* Calls take(context, bytes, size) for each part, in order, on this thread; it may leave by longjmp. ZR_OK,
 * ZR_NO_MEMORY or ZR_CANCELLED. `team` and `cancel` may be NULL. */
enum zr_status zr_idat_make(const struct zr_idat_image *image, struct zr_arena *arena, struct zr_team *team,
                            const struct zr_cancel *cancel,
                            void (*take)(void *context, const uint8_t *bytes, size_t size), void *context);

#endif
