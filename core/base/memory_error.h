/* memory_error.h - base: the error of a step whose arena has failed. */
#ifndef ZR_MEMORY_ERROR_H
#define ZR_MEMORY_ERROR_H

#include "base/arena.h"
#include "base/status.h"

/* Adds "`step` needs at least N bytes, more than the M bytes that a request may use`more`", or that the system has no
 * memory. Returns ZR_NO_MEMORY. */
enum zr_status zr_memory_error_add(struct zr_error *error, const struct zr_arena *arena, const char *step,
                                   const char *more);

#endif
