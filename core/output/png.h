/* png.h - output: pixels -> PNG, through libpng.
 *
 * Row 0 is the top. No time stamps. The same pixels give the same bytes, whatever the team and wherever in memory
 * (deflate.h). Another version of libpng, zlib or ISA-L, or an instruction set that ISA-L compresses otherwise for, may
 * give other bytes: of the same pixels.
 *
 * RGB or RGBA is told by who asks, not by what is seen: a picture with a transparent background stays RGBA where
 * something covers all of it, so that whoever pastes it finds what was found yesterday. A picture of up to 256 colours
 * has a palette instead (with alpha where it has some), whichever was asked for: every reader gives the same RGB or
 * RGBA.
 *
 * ZR_COMPRESS_FAST is deflated here (idat.h), in strips that a team shares, and put into the file by libpng;
 * ZR_COMPRESS_SMALL by libpng itself: 10 to 20 % less for ten to thirty times the time.
 */
#ifndef ZR_PNG_H
#define ZR_PNG_H

#include "base/column_span.h"
#include "output/buffer.h"
#include "output/rows.h"
#include "scene/scene.h"
#include "zraster.h"

enum zr_png_kind {
    ZR_PNG_RGB,   /* of RGBA, 4 bytes a pixel; alpha is left out */
    ZR_PNG_RGBA,  /* of the same */
    ZR_PNG_GREY16 /* of uint16_t in the machine's order */
};

struct zr_png {
    enum zr_png_kind kind;
    uint32_t width, height;
    const void *pixels;  /* NULL: */
    struct zr_rows rows; /* for ZR_PNG_GREY16 */
    const struct zr_column_span
        *reaches;     /* of each row: pixels outside of it are all the same, in all rows. NULL: not known */
    const char *text; /* a comment kept in the file, ASCII; NULL: none */
    enum zr_compress compress;
};

/* Appends the file to `out`. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL. `team` may be NULL (one thread). */
enum zr_status zr_png_write(const struct zr_png *image, struct zr_team *team, const struct zr_cancel *cancel,
                            struct zr_buffer *out);

#endif
