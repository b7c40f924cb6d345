#include "mesh/facts/ring_area.h"

static void place_of(const struct zr_mesh *mesh, uint32_t slot, double place[3])
{
    const zr_vec3 at = zr_vec4_over_w(mesh->positions[mesh->indices[slot]]);
    place[0] = (double)at.x;
    place[1] = (double)at.y;
    place[2] = (double)at.z;
}

struct zr_ring_area zr_ring_area_of(const struct zr_mesh *mesh, uint32_t begin, uint32_t end)
{
    struct zr_ring_area ring = {.area = {0, 0, 0}};
    const double *o = ring.first;
    place_of(mesh, begin, ring.first);
    for (uint32_t i = begin + 1; i + 1 < end; i++) {
        double p[3], q[3];
        place_of(mesh, i, p);
        place_of(mesh, i + 1, q);
        const double a[3] = {p[0] - o[0], p[1] - o[1], p[2] - o[2]}, b[3] = {q[0] - o[0], q[1] - o[1], q[2] - o[2]};
        ring.area[0] += a[1] * b[2] - a[2] * b[1];
        ring.area[1] += a[2] * b[0] - a[0] * b[2];
        ring.area[2] += a[0] * b[1] - a[1] * b[0];
    }
    return ring;
}
