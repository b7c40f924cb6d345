#include "input/outputs.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "input/number.h"
#include "input/text.h"

#define NAME(ID, NAME, ...) NAME,
static const char *const channels[] = {ZR_CHANNEL_ROWS(NAME) "texcoord", "coverage", "overdraw"};
static const char *const encodings[] = {"png", "png16", "npy", "json", "pfm", "tiff"};
static const char *const spaces[] = {"camera", "world", "object"};

const struct zr_names zr_channel_names = ZR_NAMES(ZR_CHANNEL_COUNT, channels);
const struct zr_names zr_encoding_names = ZR_NAMES(ZR_ENCODING_COUNT, encodings);
const struct zr_names zr_space_names = ZR_NAMES(ZR_SPACE_COUNT, spaces);

struct zr_names_text zr_channel_encodings_join(enum zr_channel channel)
{
    const struct zr_channel_row *row = &zr_channel_rows[channel];
    const char *words[ZR_ENCODING_COUNT];
    for (int i = 0; i < row->encoding_count; i++)
        words[i] = encodings[row->encodings[i]];
    return zr_names_join(&(struct zr_names){row->encoding_count, row->encoding_count, words});
}

bool zr_outputs_clash(const struct zr_output *a, const struct zr_output *b)
{
    bool both_png = (a->encoding == ZR_ENCODING_PNG || a->encoding == ZR_ENCODING_PNG16) &&
                    (b->encoding == ZR_ENCODING_PNG || b->encoding == ZR_ENCODING_PNG16);
    return a->channel == b->channel && (a->encoding == b->encoding || both_png);
}

static enum zr_status read_scale(const char *text, struct zr_output *output, struct zr_error *error)
{
    double value;
    const char *end = text + strlen(text);
    if (output->encoding != ZR_ENCODING_PNG16)
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "query parameter scale: only the encoding png16 has one");
    if (zr_number_read(text, end, &value) != end || !(value <= (double)FLT_MAX) || !((float)value > 0.0f))
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "query parameter scale: %s is not a number greater than 0",
                            zr_quote(text, strlen(text)).text);
    output->scale = (float)value;
    return ZR_OK;
}

enum zr_status zr_output_of_query(const struct zr_request *request, struct zr_output *output, struct zr_error *error)
{
    *output = (struct zr_output){.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    if (request->channel) {
        int channel = zr_names_of_query("channel", &zr_channel_names, request->channel, error);
        if (channel < 0) return ZR_BAD_REQUEST;
        output->channel = (enum zr_channel)channel;
        output->encoding = zr_channel_rows[channel].encodings[0];
    }
    if (request->encoding) {
        int encoding = zr_names_find(&zr_encoding_names, request->encoding);
        if (encoding < 0 || encoding >= zr_encoding_names.count ||
            !zr_channel_has(output->channel, (enum zr_encoding)encoding))
            return zr_error_add(error, ZR_BAD_REQUEST, NULL,
                                "query parameter encoding: %s is not one that the channel %s has; allowed: %s",
                                zr_quote(request->encoding, strlen(request->encoding)).text, channels[output->channel],
                                zr_channel_encodings_join(output->channel).text);
        output->encoding = (enum zr_encoding)encoding;
    }
    return request->scale ? read_scale(request->scale, output, error) : ZR_OK;
}
