#include "shade/nocs.h"

#include <math.h>

enum { POSITIONS_PER_CANCEL_CHECK = 1 << 15 };

static struct zr_nocs nocs_of(const struct zr_mesh *drawn, const struct zr_cancel *cancel)
{
    const struct zr_mesh *mesh = drawn->source ? drawn->source->mesh : drawn;
    double min[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, max[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, square = 0.0;
    struct zr_nocs out = {.per_unit = 0.0};
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        if (i % POSITIONS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return out;
        const zr_vec4 *p = &mesh->positions[i];
        const double at[3] = {(double)p->x / (double)p->w, (double)p->y / (double)p->w, (double)p->z / (double)p->w};
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) continue; /* at infinity */
        for (int k = 0; k < 3; k++) {
            if (at[k] < min[k]) min[k] = at[k];
            if (at[k] > max[k]) max[k] = at[k];
        }
    }
    for (int k = 0; k < 3 && min[k] <= max[k]; k++) {
        out.middle[k] = 0.5 * (min[k] + max[k]);
        square += (max[k] - min[k]) * (max[k] - min[k]);
    }
    if (square > 0.0) out.per_unit = 1.0 / sqrt(square);
    return out;
}

const struct zr_nocs_list *zr_nocs_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_cancel *cancel)
{
    struct zr_nocs_list *list = zr_arena_alloc(arena, 1, sizeof *list);
    struct zr_nocs *each = zr_arena_zero(arena, scene->mesh_count, sizeof *each);
    bool *has = zr_arena_zero(arena, scene->mesh_count, sizeof *has);
    if (!list || !each || !has) return NULL;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const uint32_t mesh = scene->instances[i].mesh;
        if (zr_is_cancelled(cancel)) return NULL;
        if (!has[mesh]) each[mesh] = nocs_of(&scene->meshes[mesh], cancel);
        has[mesh] = true;
    }
    *list = (struct zr_nocs_list){scene->meshes, each};
    return list;
}
