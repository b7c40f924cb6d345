#include "input/outputs.h"

#include <stdio.h>
#include <string.h>

#define NAME(ID, NAME, ...) NAME,
static const char *const channels[] = {ZR_CHANNEL_ROWS(NAME) "coverage", "overdraw"};
static const char *const encodings[] = {"png",  "png16", "png32", "npy",  "json", "svg",
                                        "tiff", "apng",  "pfm",   "jpeg", "webp", "zip"};
static const char *const spaces[] = {"camera", "world", "object", "nocs"};

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
