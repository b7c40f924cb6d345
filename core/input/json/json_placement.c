#include "input/json/json_placement.h"

#include <inttypes.h>

uint64_t zr_json_visits_max(const struct zr_json *json, uint32_t count)
{
    return (uint64_t)ZR_NODE_VISITS_PER_INSTANCE * json->limits->instances_max + count;
}

bool zr_json_check_placement(struct zr_json *json, const struct zr_json_path *path, uint32_t count,
                             const char *children, const struct zr_placement *placement)
{
    const struct zr_json_path *node = ZR_JSON_ITEM(path, placement->node);
    switch (placement->fault) {
    case ZR_NODES_GOOD:
        return true;
    case ZR_NODES_CYCLE:
        return zr_json_fault(json, ZR_JSON_ITEM(ZR_JSON_KEY(node, children), placement->child),
                             "a cycle: this child is the node itself, or has it for a descendant");
    case ZR_NODES_TOO_DEEP:
        return zr_json_fault(json, node, "nested too deep: below this node are more than the limit of %d levels",
                             (int)ZR_NODES_DEPTH_MAX - 1);
    case ZR_NODES_TOO_MANY:
        return zr_json_fault(json, path, "the nodes place more than the limit of %u instances of meshes",
                             json->limits->instances_max);
    case ZR_NODES_TOO_MANY_VISITS:
        return zr_json_fault(json, path,
                             "shared nodes are visited %" PRIu64
                             " times, once for each way from a root to a mesh; up to "
                             "%" PRIu64 " visits are allowed, %d for each of the %u instances of the limit",
                             placement->visits, zr_json_visits_max(json, count), (int)ZR_NODE_VISITS_PER_INSTANCE,
                             json->limits->instances_max);
    case ZR_NODES_OUT_OF_RANGE:
        return zr_json_fault(json, node, "the matrix to world space has an entry beyond %g", (double)ZR_MATRIX_MAX);
    }
    return false;
}
