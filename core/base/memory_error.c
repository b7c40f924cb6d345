#include "base/memory_error.h"

#include <stdint.h>

enum zr_status zr_memory_error_add(struct zr_error *error, const struct zr_arena *arena, const char *step,
                                   const char *more)
{
    if (arena->failed && arena->wanted == 0)
        return zr_error_add(error, ZR_NO_MEMORY, NULL, "%s needs more memory than the system has", step);
    if (arena->wanted > arena->ceiling && arena->wanted < SIZE_MAX)
        return zr_error_add(error, ZR_NO_MEMORY, NULL,
                            "%s needs at least %zu bytes, more than the %zu bytes that a request may use%s", step,
                            arena->wanted, arena->ceiling, more);
    return zr_error_add(error, ZR_NO_MEMORY, NULL, "%s needs more than the %zu bytes that a request may use%s", step,
                        arena->ceiling, more);
}
