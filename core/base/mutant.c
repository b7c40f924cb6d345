#include "base/mutant.h"

#include <stddef.h>

#ifdef ZR_MUTANTS
#include <string.h>

uint64_t zr_mutants_chosen[ZR_MUTANT_COUNT / 64 + 1];

#define ZR_MUTANT_NAME(name) #name,
static const char *const names[] = {ZR_EACH_MUTANT(ZR_MUTANT_NAME)};

bool zr_mutant_set(const char *name, bool on)
{
    for (int i = 0; i < ZR_MUTANT_COUNT; i++) {
        if (strcmp(name, names[i]) != 0) continue;
        const uint64_t bit = UINT64_C(1) << (i % 64);
        uint64_t *chosen = &zr_mutants_chosen[i / 64];
        *chosen = on ? *chosen | bit : *chosen & ~bit;
        return true;
    }
    return !on;
}

const char *zr_mutant_name(int number)
{
    return number < ZR_MUTANT_COUNT ? names[number] : NULL;
}
#else
bool zr_mutant_set(const char *name, bool on)
{
    (void)name;
    return !on;
}

const char *zr_mutant_name(int number)
{
    (void)number;
    return NULL;
}
#endif
