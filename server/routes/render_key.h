/* render_key.h - hash of all that determines the bytes of a picture: the scene, the parameters in one spelling
 * (input/query/query_plain.h), the versions of looks, rules, program and encoders. */
#ifndef ZRASTERD_RENDER_KEY_H
#define ZRASTERD_RENDER_KEY_H

#include "base/hash.h"
#include "core.h"

/* `scene`: the SHA-256 of its bytes, as text. False without memory. */
bool render_key(const char *scene, const struct zr_request *parameters, const struct zr_limits *limits,
                struct zr_file_hash *key);

#endif
