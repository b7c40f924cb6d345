/* outputs.h - input: which channels there are, and in which encodings.
 *
 * Shared by the scene's "outputs" and the query's parameters.
 */
#ifndef ZR_OUTPUTS_H
#define ZR_OUTPUTS_H

#include <stdbool.h>

#include "base/status.h"
#include "input/names.h"
#include "scene/scene.h"
#include "zraster.h"

extern const struct zr_names zr_channel_names;  /* enum zr_channel */
extern const struct zr_names zr_encoding_names; /* enum zr_encoding */
extern const struct zr_names zr_space_names;    /* enum zr_space */

/* The encodings of a channel as words, for a message. */
struct zr_names_text zr_channel_encodings_join(enum zr_channel channel);

/* Would both get the same file name in an archive (channel.extension)? */
bool zr_outputs_clash(const struct zr_output *a, const struct zr_output *b);

#endif
