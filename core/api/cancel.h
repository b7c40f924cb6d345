/* cancel.h - api: a cancel with a count of its users. */
#ifndef ZR_LIBRARY_CANCEL_H
#define ZR_LIBRARY_CANCEL_H

#include <stdatomic.h>

#include "api/zraster.h"
#include "base/cancel.h"

struct zraster_cancel {
    struct zr_cancel flag;
    atomic_uint users; /* the caller, and pictures that may be encoded; the last one frees it */
};

/* Adds a user and returns `cancel`; both may be NULL. zraster_cancel_free removes one. */
zraster_cancel *zr_cancel_use(zraster_cancel *cancel);

static inline const struct zr_cancel *zr_cancel_flag(const zraster_cancel *cancel)
{
    return cancel ? &cancel->flag : NULL;
}

#endif
