/* preset.h - checks the query of a preset before a request uses it. */
#ifndef ZRASTERD_PRESET_H
#define ZRASTERD_PRESET_H

#include <stdbool.h>

#include "base/status.h"
#include "core.h"

enum { PRESET_QUERY_MAX = 2048 }; /* bytes */

/* Returns true if the query is right for some body: a model or a scene. Else *error has the fault. Parameters
 * that depend on the file are not checked: camera, animation, member, and all values beside `frames`. `query` has up to
 * PRESET_QUERY_MAX bytes. */
bool preset_check(const char *query, const struct zr_limits *limits, struct zr_error *error);

#endif
