/* cancel.h - base: a flag that ends a request early. */
#ifndef ZR_CANCEL_H
#define ZR_CANCEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* May be raised by any thread at any time; the current step then soon returns ZR_CANCELLED. */
struct zr_cancel {
    atomic_bool raised;
    const struct zr_cancel *parent; /* or NULL; raising it raises this flag as well */
};

static inline bool zr_is_cancelled(const struct zr_cancel *cancel)
{
    for (; cancel; cancel = cancel->parent)
        if (atomic_load_explicit(&cancel->raised, memory_order_relaxed)) return true;
    return false;
}

#endif
