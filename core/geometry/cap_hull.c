#include "geometry/cap_hull.h"

#define C1 0.92387953251128674
#define C2 0.70710678118654752
#define C3 0.38268343236508977

static const double directions[ZR_CAP_HULL_MAX][2] = {
    {1, 0},  {C1, C3},   {C2, C2},   {C3, C1},   {0, 1},  {-C3, C1}, {-C2, C2}, {-C1, C3},
    {-1, 0}, {-C1, -C3}, {-C2, -C2}, {-C3, -C1}, {0, -1}, {C3, -C1}, {C2, -C2}, {C1, -C3}};

static void place(const struct zr_mesh *mesh, uint32_t slot, double at[3])
{
    const zr_vec3 p = zr_vec4_over_w(mesh->positions[mesh->indices[slot]]);
    at[0] = (double)p.x;
    at[1] = (double)p.y;
    at[2] = (double)p.z;
}

/* Returns the axis along which the area of the first ring is the largest. */
static int axis_of(const struct zr_mesh *mesh, const struct zr_rings *rings)
{
    double first[3], last[3], next[3], sum[3] = {0, 0, 0};
    int axis = 0;
    place(mesh, rings->offsets[0], first);
    place(mesh, rings->offsets[0] + 1, last);
    for (uint32_t slot = rings->offsets[0] + 2; slot < rings->offsets[1]; slot++) {
        place(mesh, slot, next);
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            sum[k] += (last[i] - first[i]) * (next[j] - first[j]) - (last[j] - first[j]) * (next[i] - first[i]);
        }
        for (int k = 0; k < 3; k++)
            last[k] = next[k];
    }
    for (int k = 1; k < 3; k++)
        if (fabs(sum[k]) > fabs(sum[axis])) axis = k;
    return axis;
}

uint32_t zr_cap_hull_find(const struct zr_mesh *mesh, const struct zr_rings *rings, uint32_t slots[ZR_CAP_HULL_MAX])
{
    const uint32_t begin = rings->offsets[0], end = rings->offsets[rings->count];
    const int axis = axis_of(mesh, rings);
    double most[ZR_CAP_HULL_MAX], at[3];
    uint32_t count = 0;
    for (int d = 0; d < ZR_CAP_HULL_MAX; d++)
        most[d] = -HUGE_VAL;
    for (uint32_t slot = begin; slot < end; slot++) {
        place(mesh, slot, at);
        for (int d = 0; d < ZR_CAP_HULL_MAX; d++) {
            const double along = at[(axis + 1) % 3] * directions[d][0] + at[(axis + 2) % 3] * directions[d][1];
            if (!(along > most[d])) continue;
            most[d] = along;
            slots[d] = slot;
        }
    }
    for (int d = 0; d < ZR_CAP_HULL_MAX; d++)
        if (most[d] > -HUGE_VAL && (count == 0 || (slots[d] != slots[count - 1] && slots[d] != slots[0])))
            slots[count++] = slots[d];
    return count;
}
