/* png.h - output: encodes pixels as PNG, by libpng.
 *
 * Row 0 is the top. There are no time stamps. The same pixels give the same bytes for any team and memory address
 * (idat.h). The bytes may differ between versions of libpng, zlib or ISA-L, and between processors for which ISA-L
 * compresses differently: ARM, and x86-64 without SSE4.2. WebAssembly has the bytes of x86-64. The pixels never differ.
 *
 * The request decides between RGB and RGBA, not the contents: a picture with a transparent background stays RGBA even
 * if geometry covers all of it, so that compositing scripts get a constant format. A picture of up to 256 colours gets
 * a palette for either kind (with alpha if needed), unless it is refused; every reader decodes the same RGB or RGBA.
 *
 * ZR_COMPRESS_FAST is compressed here (idat.h), in strips that a team shares, and libpng writes the file.
 * ZR_COMPRESS_SMALL is compressed by libpng: 10 to 20 % smaller for ten to thirty times the time. */
#ifndef ZR_PNG_H
#define ZR_PNG_H

#include "base/column_span.h"
#include "core.h"
#include "output/bytes/buffer.h"
#include "output/bytes/rows.h"
#include "scene/scene.h"

enum zr_png_kind {
    ZR_PNG_RGB,   /* from RGBA, 4 bytes per pixel; alpha is dropped */
    ZR_PNG_RGBA,  /* from RGBA, 4 bytes per pixel */
    ZR_PNG_GREY16 /* from uint16_t in native byte order */
};

struct zr_png {
    enum zr_png_kind kind;
    uint32_t width, height;
    const void *pixels;                 /* NULL: use `rows` */
    struct zr_rows rows;                /* ZR_PNG_GREY16 only */
    const struct zr_column_span *spans; /* per row: all pixels outside of it are equal, over all rows. NULL: unknown */
    const char *text;                   /* ASCII comment stored in the file; NULL: none */
    enum zr_compress compress;
    bool is_srgb;        /* chunk sRGB */
    float dpi;           /* pixels per inch, chunk pHYs; 0: none */
    bool has_no_palette; /* RGB and RGBA stay so, even with few colours: for frames of one file, too */
};

/* Appends the file to `out`. Returns ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL. `team` may be NULL (one
 * thread). */
enum zr_status zr_png_write(const struct zr_png *image, struct zr_team *team, const struct zr_cancel *cancel,
                            struct zr_buffer *out);

#endif
