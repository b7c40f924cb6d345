/* Resources of 3MF by their ids, and groups of colours. */
#include <string.h>

#include "input/threemf/threemf.h"

/* Returns the first position at or after this part and id in the sorted order. */
static uint32_t position_of(const struct zr_mf3 *file, uint32_t part, uint32_t id)
{
    const struct zr_mf3_resource *resources = file->resources.items;
    const uint32_t *order = file->order.items;
    uint32_t low = 0, high = file->order.count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct zr_mf3_resource *at = &resources[order[middle]];
        if (at->part < part || (at->part == part && at->id < id))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

struct zr_mf3_resource *zr_mf3_find(const struct zr_mf3 *file, uint32_t part, uint32_t id)
{
    const uint32_t position = position_of(file, part, id);
    if (position == file->order.count) return NULL;
    struct zr_mf3_resource *found = &zr_mf3_resources(file)[((const uint32_t *)file->order.items)[position]];
    return found->part == part && found->id == id ? found : NULL;
}

/* If ids ascend, as they mostly do, the new one is appended and nothing moves. */
struct zr_mf3_resource *zr_mf3_add(struct zr_mf3 *file, enum zr_mf3_kind kind)
{
    uint32_t id = 0;
    if (!zr_mf3_count(file, "id", true, &id)) return NULL;
    if (zr_mf3_find(file, file->part, id)) {
        zr_mf3_fault(file, file->tag.at, "the id %u occurs twice", id);
        return NULL;
    }
    if (file->resources.count == ZR_MF3_RESOURCES_MAX) {
        zr_mf3_fault(file, file->tag.at, "more than %d resources", ZR_MF3_RESOURCES_MAX);
        file->is_stopped = true;
        return NULL;
    }
    const uint32_t position = position_of(file, file->part, id);
    struct zr_mf3_resource *made = zr_mf3_list_add(file->arena, &file->resources, sizeof *made);
    if (!made || !zr_mf3_list_add(file->arena, &file->order, sizeof(uint32_t))) return NULL;
    uint32_t *at = (uint32_t *)file->order.items + position;
    memmove(at + 1, at, (file->order.count - 1 - position) * sizeof *at);
    *at = file->resources.count - 1;
    *made = (struct zr_mf3_resource){.part = file->part,
                                     .id = id,
                                     .kind = kind,
                                     .at = file->tag.at,
                                     .name = "",
                                     .mesh = ZR_MF3_NONE,
                                     .material = ZR_MF3_NONE,
                                     .first_node = ZR_MF3_NONE};
    return made;
}

void zr_mf3_read_colors(struct zr_mf3 *file, enum zr_mf3_space space, const char *child, const char *attribute)
{
    struct zr_mf3_list colors = {0};
    const size_t depth = file->xml.depth;
    struct zr_mf3_resource *group = zr_mf3_add(file, ZR_MF3_COLORS);
    if (!group) return;
    while (zr_mf3_child(file, depth)) {
        uint32_t *color = zr_mf3_is(file, space, child) ? zr_mf3_list_add(file->arena, &colors, sizeof *color) : NULL;
        if (color) zr_mf3_color(file, attribute, color);
    }
    group->colors = colors.items;
    group->color_count = colors.count;
    group->is_base = space == ZR_MF3_SPACE_CORE;
}
