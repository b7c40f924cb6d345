/* idat.h - output: compresses pixels to the zlib stream of a PNG, in consecutive parts.
 *
 * The size of the picture alone decides how it is divided into strips. Each strip is filtered and compressed
 * independently and ends on a whole byte. It is one part, with the same bytes for any thread (zr_deflate). Idle threads
 * take the next strip. */
#ifndef ZR_IDAT_H
#define ZR_IDAT_H

#include <isa-l/igzip_lib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/run.h"
#include "core.h"
#include "output/bytes/rows.h"
#include "output/images/filter.h"

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
enum zr_status zr_idat_make(const struct zr_run *run, const struct zr_idat_image *image,
                            void (*take)(void *context, const uint8_t *bytes, size_t size), void *context);

/* ---- one part of a deflate stream, by ISA-L at level 1 ----
 *
 * Exact:  the same bytes give the same part, at any address of `stream` and the buffers. ISA-L 2.30 and 2.31 alone do
 *         not ensure this. If a stream begins within their main loop (more than 16 bytes), byte 2 enters the match
 *         table under a hash of the stream's own address. Some matches are then found at one address and not at another
 *         (igzip_icf_body_h1_gr_bt.asm, write_first_byte). */

/* ZR_DEFLATE_TAIL readable bytes must follow the input; ISA-L looks ahead by 288. `table` needs no initial value. */
enum { ZR_DEFLATE_TAIL = 512, ZR_DEFLATE_TABLE = ISAL_DEF_LVL1_DEFAULT };

/* Writes a part that refers to no data before it. The last part ends the stream; the others end on a whole byte.
 * Returns its size, or 0 if it does not fit into `room`, the size for incompressible bytes. */
size_t zr_deflate(struct isal_zstream *stream, uint8_t table[ZR_DEFLATE_TABLE], const uint8_t *bytes, size_t size,
                  bool last, uint8_t *out, size_t room);

#endif
