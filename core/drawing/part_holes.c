#include "drawing/part_holes.h"

#include "mesh/features/part_features.h"

enum { PARTS_MAX = 1000 };

static struct zr_part_hole hole_of(const struct zr_hole *hole)
{
    struct zr_part_hole out = {.hole = *hole, .radius = 0.5 * hole->diameter};
    double depth = hole->depth;
    for (uint32_t i = 0; i < hole->step_count; i++) {
        depth += hole->steps[i].depth;
        if (0.5 * hole->steps[i].diameter > out.radius) out.radius = 0.5 * hole->steps[i].diameter;
    }
    out.ends[0] = hole->at;
    out.ends[1] = zr_dvec3_add_scaled(hole->at, hole->axis, depth);
    return out;
}

static enum zr_status find_features(const struct zr_run *run, const struct zr_scene *scene,
                                    const struct zr_part_list *parts, struct zr_part_facts *facts,
                                    struct zr_part_features *features)
{
    enum zr_status status = zr_part_facts_find(run, scene, parts, facts);
    if (status == ZR_OK) status = zr_part_features_find(run, scene, parts, facts, features);
    return status;
}

enum zr_status zr_part_holes_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_part_holes *out,
                                  struct zr_arena *texts, struct zr_warning_list *warnings)
{
    const struct zr_part_list parts = zr_part_list_make(run->arena, scene, PARTS_MAX);
    struct zr_part_facts *facts = zr_arena_alloc(run->arena, parts.count, sizeof *facts);
    struct zr_part_features *features = zr_arena_alloc(run->arena, parts.count, sizeof *features);
    uint32_t total = 0, omitted = 0;
    *out = (struct zr_part_holes){.at = zr_arena_alloc(run->arena, ZR_PART_HOLES_MAX, sizeof *out->at)};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    const enum zr_status status = find_features(run, scene, &parts, facts, features);
    for (uint32_t p = 0; status == ZR_OK && p < parts.count; p++) {
        const struct zr_holes *holes = &features[p].holes;
        if (facts[p].is_hidden) continue;
        omitted += features[p].is_omitted;
        if (features[p].is_omitted) continue;
        total += holes->hole_count;
        for (uint32_t i = 0; i < holes->hole_count && out->count < ZR_PART_HOLES_MAX; i++)
            out->at[out->count++] = hole_of(&holes->holes[i]);
    }
    if (omitted > 0 || parts.count < parts.total)
        zr_warning_list_add(texts, warnings, "holes were not searched in %llu parts, which are too large or too many",
                            (unsigned long long)(omitted + (parts.total - parts.count)));
    if (total > out->count)
        zr_warning_list_add(texts, warnings, "%u holes beyond the first %u have no marks", total - out->count,
                            out->count);
    return status;
}
