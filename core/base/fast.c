#include "base/fast.h"

#include <stddef.h>

#ifdef ZR_MUTANTS
#include <stdatomic.h>
#include <string.h>

static bool forbidden[ZR_FAST_COUNT];
static atomic_uint_fast64_t counts[ZR_FAST_COUNT];

#define ZR_FAST_NAME(name) #name,
static const char *const names[] = {ZR_EACH_FAST(ZR_FAST_NAME)};

bool zr_fast_take(enum zr_fast fast)
{
    if (forbidden[fast]) return false;
    atomic_fetch_add_explicit(&counts[fast], 1, memory_order_relaxed);
    return true;
}

bool zr_fast_forbid(const char *name)
{
    for (int i = 0; i < ZR_FAST_COUNT; i++)
        if (strcmp(name, names[i]) == 0) return forbidden[i] = true;
    return false;
}

const char *zr_fast_name(int number, uint64_t *taken)
{
    if (number >= ZR_FAST_COUNT) return NULL;
    *taken = counts[number];
    return names[number];
}
#else
bool zr_fast_forbid(const char *name)
{
    (void)name;
    return false;
}

const char *zr_fast_name(int number, uint64_t *taken)
{
    (void)number;
    *taken = 0;
    return NULL;
}
#endif
