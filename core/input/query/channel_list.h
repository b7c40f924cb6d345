/* channel_list.h - input: the parameter channel as a list, "color,depth", with the other parameters of outputs. */
#ifndef ZR_CHANNEL_LIST_H
#define ZR_CHANNEL_LIST_H

#include "base/arena.h"
#include "core.h"
#include "scene/channels.h"

/* Returns the number of channels, at least 1. */
size_t zr_channel_list_count(const struct zr_request *request);

/* Returns the text of an output parameter ("channel", "encoding", "scale", "quality" and so on) for the channel
 * `number` of the list; NULL if it is not given or belongs to other channels. An encoding belongs to channels that have
 * it, a scale to those with png16, a quality to those with jpeg or webp, x and y to fragments. A parameter of no listed
 * channel belongs to the first, which refuses it. The text is in the arena; NULL also without memory. */
const char *zr_channel_list_text(const struct zr_request *request, struct zr_arena *arena, size_t number,
                                 const char *parameter, const char *text);

/* A JSON Pointer into outputs, with another number. */
struct zr_output_pointer {
    char text[120];
};
struct zr_output_pointer zr_output_pointer(const char *pointer, size_t number);

#endif
