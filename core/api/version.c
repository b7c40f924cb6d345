#include "version.h"

#include "api/zraster.h"

const char *zraster_version(void)
{
    return ZRASTER_VERSION;
}

uint32_t zraster_rules(void)
{
    return ZR_RULES;
}
