#include "mesh/crease_groups.h"

static uint32_t step_of(float along, float largest)
{
    const float half = ZR_CREASE_GROUPS_PER_SIDE / 2;
    const uint32_t step = (uint32_t)((along / largest + 1.0f) * half);
    return step < ZR_CREASE_GROUPS_PER_SIDE ? step : ZR_CREASE_GROUPS_PER_SIDE - 1;
}

/* Returns the square, on the sides of a cube, through which a direction points. */
static uint32_t group_of(const zr_vec4 *n)
{
    const float at[5] = {n->x, n->y, n->z, n->x, n->y};
    int axis = fabsf(n->y) > fabsf(n->x) ? 1 : 0;
    if (fabsf(n->z) > fabsf(at[axis])) axis = 2;
    const uint32_t side = 2 * (uint32_t)axis + (at[axis] < 0.0f);
    const float largest = fabsf(at[axis]);
    return (side * ZR_CREASE_GROUPS_PER_SIDE + step_of(at[axis + 1], largest)) * ZR_CREASE_GROUPS_PER_SIDE +
           step_of(at[axis + 2], largest);
}

uint32_t zr_crease_groups(const zr_vec4 *corners, const uint32_t *slots, uint32_t count,
                          struct zr_crease_source groups[ZR_CREASE_GROUPS])
{
    zr_vec3 sums[ZR_CREASE_GROUPS] = {{0, 0, 0}};
    for (uint32_t i = 0; i < count; i++) {
        const zr_vec4 *corner = &corners[slots[i]];
        if (!(corner->w > 0.0f)) continue;
        zr_vec3 *sum = &sums[group_of(corner)];
        *sum = zr_vec3_add(*sum, zr_vec3_scale((zr_vec3){corner->x, corner->y, corner->z}, corner->w));
    }
    uint32_t group_count = 0;
    for (uint32_t g = 0; g < ZR_CREASE_GROUPS; g++) {
        const zr_vec3 sum = sums[g], unit = zr_vec3_normalize(sum);
        if (sum.x == 0.0f && sum.y == 0.0f && sum.z == 0.0f) continue;
        groups[group_count++] = (struct zr_crease_source){{unit.x, unit.y, unit.z, 0}, {sum.x, sum.y, sum.z, 0}};
    }
    return group_count;
}
