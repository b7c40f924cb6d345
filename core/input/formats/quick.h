/* quick.h - input: ends reading beyond a limit of struct zr_quick (core.h). */
#ifndef ZR_QUICK_H
#define ZR_QUICK_H

#include "base/status.h"
#include "core.h"

/* Marks the limits as exceeded. Returns ZR_CANCELLED. */
static inline enum zr_status zr_quick_exceed(struct zr_quick *quick, struct zr_error *error)
{
    quick->is_exceeded = true;
    return zr_error_add(error, ZR_CANCELLED, NULL, "reading was stopped");
}

#endif
