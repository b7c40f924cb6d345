#include "base/memory_error.h"

#include <stdint.h>
#include <stdio.h>

enum zr_status zr_memory_error_add(struct zr_error *error, const struct zr_arena *arena, const char *step,
                                   const char *more)
{
    char limit[120];
    if (arena->whole > arena->ceiling)
        snprintf(limit, sizeof limit, "the %zu bytes that a view may use, of the %zu bytes of a request",
                 arena->ceiling, arena->whole);
    else
        snprintf(limit, sizeof limit, "the %zu bytes that a request may use", arena->ceiling);
    if (arena->failed && arena->wanted == 0)
        return zr_error_add(error, ZR_NO_MEMORY, NULL, "%s needs more memory than the system has", step);
    if (arena->wanted > arena->ceiling && arena->wanted < SIZE_MAX)
        return zr_error_add(error, ZR_NO_MEMORY, NULL, "%s needs at least %zu bytes, more than %s%s", step,
                            arena->wanted, limit, more);
    return zr_error_add(error, ZR_NO_MEMORY, NULL, "%s needs more than %s%s", step, limit, more);
}
