#include "scene/channels.h"

#include "scene/view.h"

_Static_assert((int)ZR_CHANNEL_COUNT <= ZR_CHANNELS_MAX, "arrays have room for each channel");

#define ENCODINGS(...)                                                                                                 \
    sizeof((const enum zr_encoding[]){__VA_ARGS__}) / sizeof(enum zr_encoding), (const enum zr_encoding[])             \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }
#define CHANNEL(ID, NAME, TEXT, VALUES, WORDS, CLEAR, OF_POINTS, SPACES, ...)                                          \
    {NAME, TEXT, ZR_VALUES_##VALUES, WORDS, ZR_CLEAR_##CLEAR, OF_POINTS, SPACES, ENCODINGS(__VA_ARGS__)},

const struct zr_channel_row zr_channel_rows[ZR_CHANNEL_COUNT] = {ZR_CHANNEL_ROWS(CHANNEL)};

bool zr_channel_has(enum zr_channel channel, enum zr_encoding encoding)
{
    for (int i = 0; i < zr_channel_rows[channel].encoding_count; i++)
        if (zr_channel_rows[channel].encodings[i] == encoding) return true;
    return false;
}
