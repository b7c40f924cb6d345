#include "memory.h"

#include <stdlib.h>

#include <cjson/cJSON.h>

static _Thread_local bool has_failed;

static void *allocate(size_t size)
{
    void *memory = malloc(size);
    has_failed |= !memory;
    return memory;
}

void mcp_memory_watch(void)
{
    cJSON_Hooks hooks = {.malloc_fn = allocate, .free_fn = free};
    cJSON_InitHooks(&hooks);
}

void mcp_memory_clear(void)
{
    has_failed = false;
}

bool mcp_memory_has_failed(void)
{
    return has_failed;
}
