#include "input/scene/outputs.h"

#include <stdio.h>
#include <string.h>

#include "scene/output.h"

/* WORD(word, meaning for people), in the order of enum zr_encoding and of enum zr_space */
#define ZR_ENCODING_WORDS(WORD)                                                                                        \
    WORD("png", "PNG, without loss")                                                                                   \
    WORD("png16", "PNG of 16 bits per pixel: depth / scale, rounded")                                                  \
    WORD("png32", "PNG that is always RGBA, without a palette")                                                        \
    WORD("npy", "array of NumPy, float32 or uint32")                                                                   \
    WORD("json", "JSON text")                                                                                          \
    WORD("svg", "lines of the mesh as paths, without pixels")                                                          \
    WORD("tiff", "TIFF of float32, uncompressed")                                                                      \
    WORD("apng", "animated PNG of several views")                                                                      \
    WORD("pfm", "float32, bottom row first")                                                                           \
    WORD("jpeg", "JPEG, of a given quality")                                                                           \
    WORD("webp", "WebP, of a given quality or without loss; animated for a turntable")                                 \
    WORD("zip", "archive of one PNG per mask")
#define ZR_SPACE_WORDS(WORD)                                                                                           \
    WORD("camera", "x right, y up, looking along -z")                                                                  \
    WORD("world", "space of the scene, after the nodes")                                                               \
    WORD("object", "the mesh's own space, before the nodes")                                                           \
    WORD("nocs", "normalized object coordinates: the box of the mesh has its centre at 0.5 and a diagonal of 1")

#define NAME(ID, NAME, ...) NAME,
static const char *const channels[] = {ZR_CHANNEL_ROWS(NAME) "coverage", "overdraw"};
#define WORD(word, text) word,
#define TEXT(word, text) text,
static const char *const encodings[] = {ZR_ENCODING_WORDS(WORD)};
static const char *const spaces[] = {ZR_SPACE_WORDS(WORD)};
const char *const zr_encoding_texts[ZR_ENCODING_COUNT] = {ZR_ENCODING_WORDS(TEXT)};
const char *const zr_space_texts[ZR_SPACE_COUNT] = {ZR_SPACE_WORDS(TEXT)};

const struct zr_names zr_channel_names = ZR_NAMES(ZR_CHANNEL_COUNT, channels);
const struct zr_names zr_encoding_names = ZR_NAMES(ZR_ENCODING_COUNT, encodings);
const struct zr_names zr_space_names = ZR_NAMES(ZR_SPACE_COUNT, spaces);

struct zr_names_text zr_channel_encodings_join(enum zr_channel channel)
{
    const struct zr_channel_row *row = &zr_channel_rows[channel];
    const char *words[ZR_ENCODING_COUNT];
    for (int i = 0; i < row->encoding_count; i++)
        words[i] = encodings[row->encodings[i]];
    return zr_names_join(&(struct zr_names){row->encoding_count, row->encoding_count, words, NULL});
}

bool zr_outputs_clash(const struct zr_output *a, const struct zr_output *b)
{
    const bool both_png = zr_encoding_is_png(a->encoding) && zr_encoding_is_png(b->encoding);
    return a->channel == b->channel && (a->encoding == b->encoding || both_png);
}
