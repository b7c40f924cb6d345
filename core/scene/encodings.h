/* encodings.h - scene: encodings of outputs, one row each.
 *
 * Words, file endings, media types, options of outputs, limits, predicted cost, messages and help follow from the rows.
 * A new encoding is a row here, its name in the rows of the channels that have it (channels.h), its file in output/ and
 * its case in request/encode.c.
 */
#ifndef ZR_ENCODINGS_H
#define ZR_ENCODINGS_H

#include <stdbool.h>
#include <stdint.h>

/* Properties: options of an output that the encoding has, and whether the ending of a file name selects it.
 * FOR_AGENTS: the answers of tools (server/mcp) may have it. */
enum {
    ZR_ENCODING_HAS_SCALE = 1,
    ZR_ENCODING_HAS_QUALITY = 2,
    ZR_ENCODING_HAS_LOSSLESS = 4,
    ZR_ENCODING_HAS_MAX_BYTES = 8,
    ZR_ENCODING_BY_ENDING = 16,
    ZR_ENCODING_FOR_AGENTS = 32,
    ZR_ENCODING_HAS_DPI = 64
};

/* ROW(ID, word, ending, another spelling of the ending or "", media type, noun for messages, properties, greatest side
 * in pixels or 0, kind of cost per pixel beside that of its words (ZR_COST_*, cost/cost.h) or NONE, meaning for
 * people) */
#define ZR_ENCODING_ROWS(ROW)                                                                                          \
    ROW(PNG, "png", "png", "", "image/png", "a PNG",                                                                   \
        ZR_ENCODING_HAS_MAX_BYTES | ZR_ENCODING_HAS_DPI | ZR_ENCODING_FOR_AGENTS, 0, PNG_PIXEL, "PNG, without loss")   \
    ROW(PNG16, "png16", "png", "", "image/png", "a PNG",                                                               \
        ZR_ENCODING_HAS_SCALE | ZR_ENCODING_HAS_MAX_BYTES | ZR_ENCODING_HAS_DPI, 0, PNG_PIXEL,                         \
        "PNG of 16 bits per pixel: depth / scale, rounded")                                                            \
    ROW(PNG32, "png32", "png", "", "image/png", "a PNG", ZR_ENCODING_HAS_DPI, 0, PNG_PIXEL,                            \
        "PNG that is always RGBA, without a palette")                                                                  \
    ROW(NPY, "npy", "npy", "", "application/x-npy", "an array (NPY)", 0, 0, NONE, "array of NumPy, float32 or uint32") \
    ROW(JSON, "json", "json", "", "application/json", "JSON", ZR_ENCODING_BY_ENDING, 0, NONE, "JSON text")             \
    ROW(SVG, "svg", "svg", "", "image/svg+xml", "an SVG", ZR_ENCODING_BY_ENDING, 0, NONE,                              \
        "lines of the mesh as paths, without pixels")                                                                  \
    ROW(TIFF, "tiff", "tiff", "tif", "image/tiff", "a TIFF", ZR_ENCODING_BY_ENDING, 0, NONE,                           \
        "TIFF of float32, uncompressed")                                                                               \
    ROW(APNG, "apng", "apng", "", "image/apng", "an animated PNG", ZR_ENCODING_BY_ENDING, 0, NONE,                     \
        "animated PNG of several views")                                                                               \
    ROW(PFM, "pfm", "pfm", "", "image/x-portable-floatmap", "a float map (PFM)", ZR_ENCODING_BY_ENDING, 0, NONE,       \
        "float32, bottom row first")                                                                                   \
    ROW(JPEG, "jpeg", "jpg", "jpeg", "image/jpeg", "a JPEG",                                                           \
        ZR_ENCODING_HAS_QUALITY | ZR_ENCODING_HAS_MAX_BYTES | ZR_ENCODING_HAS_DPI | ZR_ENCODING_BY_ENDING |            \
            ZR_ENCODING_FOR_AGENTS,                                                                                    \
        65500, JPEG_PIXEL, "JPEG, of a given quality")                                                                 \
    ROW(WEBP, "webp", "webp", "", "image/webp", "a WebP",                                                              \
        ZR_ENCODING_HAS_QUALITY | ZR_ENCODING_HAS_LOSSLESS | ZR_ENCODING_HAS_MAX_BYTES | ZR_ENCODING_BY_ENDING |       \
            ZR_ENCODING_FOR_AGENTS,                                                                                    \
        16383, WEBP_PIXEL, "WebP, of a given quality or without loss; animated for a turntable")                       \
    ROW(ZIP, "zip", "zip", "", "application/zip", "a ZIP archive of several outputs", 0, 0, NONE,                      \
        "archive of one PNG per mask")                                                                                 \
    ROW(GIF, "gif", "gif", "", "image/gif", "a GIF", ZR_ENCODING_BY_ENDING, 65535, GIF_PIXEL,                          \
        "GIF of at most 256 colours; animated for a turntable")

#define ZR_ENCODING_LISTED(ID, word, ...) word ", "
#define ZR_ENCODING_LIST                  ZR_ENCODING_ROWS(ZR_ENCODING_LISTED)

enum zr_encoding {
#define ZR_ENCODING_ENUM(ID, ...) ZR_ENCODING_##ID,
    ZR_ENCODING_ROWS(ZR_ENCODING_ENUM)
#undef ZR_ENCODING_ENUM
        ZR_ENCODING_COUNT
};

struct zr_encoding_row {
    const char *word, *ending, *spelling, *type, *noun;
    unsigned properties; /* sum of ZR_ENCODING_* */
    uint32_t side_max;   /* pixels; 0: any */
    const char *text;
};
extern const struct zr_encoding_row zr_encoding_rows[ZR_ENCODING_COUNT];

static inline bool zr_encoding_has(enum zr_encoding encoding, unsigned property)
{
    return (zr_encoding_rows[encoding].properties & property) != 0;
}

/* Bytes of the pixels of a TIFF, whose offsets have 32 bits. */
#define ZR_TIFF_BYTES_MAX UINT64_C(0xffff0000)

#endif
