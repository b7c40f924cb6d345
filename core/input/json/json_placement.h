/* json_placement.h - input: reports faults of a hierarchy (scene/parts/nodes.h) at paths of the JSON that describes it. */
#ifndef ZR_JSON_PLACEMENT_H
#define ZR_JSON_PLACEMENT_H

#include "input/json/json_value.h"
#include "scene/parts/nodes.h"

/* Returns the largest number of visits for a hierarchy of `count` nodes. */
uint64_t zr_json_visits_max(const struct zr_json *json, uint32_t count);

/* Returns true for a placement without a fault; otherwise adds the fault.
 * `path` leads to the list of `count` nodes. `children`: key of a node's children. */
bool zr_json_check_placement(struct zr_json *json, const struct zr_json_path *path, uint32_t count,
                             const char *children, const struct zr_placement *placement);

#endif
