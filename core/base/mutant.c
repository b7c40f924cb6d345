#include "base/mutant.h"

#ifdef ZR_MUTANTS
#include <string.h>

enum zr_mutant zr_mutant_chosen = ZR_MUTANT_NONE;

bool zr_mutant_choose(const char *name)
{
#define ZR_MUTANT_NAME(name) #name,
    static const char *const names[] = {ZR_EACH_MUTANT(ZR_MUTANT_NAME)};
    zr_mutant_chosen = ZR_MUTANT_NONE;
    if (!name) return true;
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) zr_mutant_chosen = (enum zr_mutant)(ZR_MUTANT_NONE + 1 + i);
    return zr_mutant_chosen != ZR_MUTANT_NONE;
}
#else
bool zr_mutant_choose(const char *name)
{
    return !name;
}
#endif
