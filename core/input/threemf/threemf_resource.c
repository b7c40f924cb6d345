/* Resources of 3MF by their ids, and groups of colours. */
#include <string.h>

#include "input/threemf/threemf_file.h"

/* Returns the first position at or after this part and id in the sorted order. */
static uint32_t position_of(const struct zr_threemf *file, uint32_t part, uint32_t id)
{
    const struct zr_threemf_resource *resources = file->resources.items;
    const uint32_t *order = file->order.items;
    uint32_t low = 0, high = file->order.count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct zr_threemf_resource *at = &resources[order[middle]];
        if (at->part < part || (at->part == part && at->id < id))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

struct zr_threemf_resource *zr_threemf_find(const struct zr_threemf *file, uint32_t part, uint32_t id)
{
    const uint32_t position = position_of(file, part, id);
    if (position == file->order.count) return NULL;
    struct zr_threemf_resource *found = &zr_threemf_resources(file)[((const uint32_t *)file->order.items)[position]];
    return found->part == part && found->id == id ? found : NULL;
}

/* If ids ascend, as they mostly do, the new one is appended and nothing moves. */
struct zr_threemf_resource *zr_threemf_add(struct zr_threemf *file, enum zr_threemf_kind kind)
{
    uint32_t id = 0;
    if (!zr_threemf_count(file, "id", true, &id)) return NULL;
    if (zr_threemf_find(file, file->part, id)) {
        zr_threemf_fault(file, file->tag.at, "the id %u occurs twice", id);
        return NULL;
    }
    if (file->resources.count == ZR_THREEMF_RESOURCES_MAX) {
        zr_threemf_fault(file, file->tag.at, "more than %d resources", ZR_THREEMF_RESOURCES_MAX);
        file->is_stopped = true;
        return NULL;
    }
    const uint32_t position = position_of(file, file->part, id);
    struct zr_threemf_resource *made = zr_threemf_list_add(file->arena, &file->resources, sizeof *made);
    if (!made || !zr_threemf_list_add(file->arena, &file->order, sizeof(uint32_t))) return NULL;
    uint32_t *at = (uint32_t *)file->order.items + position;
    memmove(at + 1, at, (file->order.count - 1 - position) * sizeof *at);
    *at = file->resources.count - 1;
    *made = (struct zr_threemf_resource){.part = file->part,
                                         .id = id,
                                         .kind = kind,
                                         .at = file->tag.at,
                                         .name = "",
                                         .mesh = ZR_THREEMF_NONE,
                                         .material = ZR_THREEMF_NONE,
                                         .first_node = ZR_THREEMF_NONE};
    return made;
}

void zr_threemf_read_colors(struct zr_threemf *file, enum zr_threemf_space space, const char *child,
                            const char *attribute)
{
    struct zr_threemf_list colors = {0};
    const size_t depth = file->xml.depth;
    struct zr_threemf_resource *group = zr_threemf_add(file, ZR_THREEMF_COLORS);
    if (!group) return;
    while (zr_threemf_child(file, depth)) {
        uint32_t *color =
            zr_threemf_is(file, space, child) ? zr_threemf_list_add(file->arena, &colors, sizeof *color) : NULL;
        if (color) zr_threemf_color(file, attribute, color);
    }
    group->colors = colors.items;
    group->color_count = colors.count;
    group->is_base = space == ZR_THREEMF_SPACE_CORE;
}
