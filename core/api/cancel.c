#include "api/cancel.h"

#include <stdlib.h>

zraster_cancel *zraster_cancel_new(void)
{
    zraster_cancel *cancel = calloc(1, sizeof *cancel);
    if (!cancel) return NULL;
    atomic_init(&cancel->flag.raised, false);
    atomic_init(&cancel->users, 1);
    return cancel;
}

zraster_cancel *zr_cancel_use(zraster_cancel *cancel)
{
    if (cancel) atomic_fetch_add_explicit(&cancel->users, 1, memory_order_relaxed);
    return cancel;
}

/* Safe in signal handlers: the flag is lock-free. */
void zraster_cancel_raise(zraster_cancel *cancel)
{
    if (cancel) atomic_store_explicit(&cancel->flag.raised, true, memory_order_relaxed);
}

_Static_assert(ATOMIC_BOOL_LOCK_FREE == 2, "signal handlers may raise a cancel");

void zraster_cancel_free(zraster_cancel *cancel)
{
    if (cancel && atomic_fetch_sub_explicit(&cancel->users, 1, memory_order_acq_rel) == 1) free(cancel);
}
