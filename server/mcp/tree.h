/* tree.h - mcp: members of trees of JSON; the tree may be NULL. */
#ifndef MCP_TREE_H
#define MCP_TREE_H

#include <cjson/cJSON.h>

static inline const cJSON *mcp_get(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

/* Add an item, which may be NULL. Without memory, it is deleted. */
static inline void mcp_add(cJSON *object, const char *name, cJSON *item)
{
    if (!cJSON_AddItemToObject(object, name, item)) cJSON_Delete(item);
}

static inline void mcp_append(cJSON *list, cJSON *item)
{
    if (!cJSON_AddItemToArray(list, item)) cJSON_Delete(item);
}

/* Return a number; 0 without one. */
static inline double mcp_number_of(const cJSON *object, const char *name)
{
    const cJSON *item = mcp_get(object, name);
    return item ? item->valuedouble : 0;
}

static inline double mcp_number_at(const cJSON *list, int i)
{
    const cJSON *item = cJSON_GetArrayItem(list, i);
    return item ? item->valuedouble : 0;
}

#endif
