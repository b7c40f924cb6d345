/* outputs.h - input: names of channels, encodings and spaces, for scenes and queries. */
#ifndef ZR_OUTPUTS_H
#define ZR_OUTPUTS_H

#include <stdbool.h>

#include "base/status.h"
#include "core.h"
#include "input/text/names.h"
#include "scene/channels.h"
#include "scene/scene.h"

extern const struct zr_names zr_channel_names;  /* enum zr_channel */
extern const struct zr_names zr_encoding_names; /* enum zr_encoding */
extern const struct zr_names zr_space_names;    /* enum zr_space */

/* Meaning of each word, for people. */
extern const char *const zr_space_texts[ZR_SPACE_COUNT];

/* Lists the encodings of a channel, for a message. */
struct zr_names_text zr_channel_encodings_join(enum zr_channel channel);

/* Lists the encodings that have a property (ZR_ENCODING_*), for a message: "png, png16 and webp". */
struct zr_names_text zr_encodings_having(unsigned property);

/* True if both outputs would have the same file name in an archive (channel.extension). */
bool zr_outputs_clash(const struct zr_output *a, const struct zr_output *b);

#endif
