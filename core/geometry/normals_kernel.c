#include "base/simd.h"
#include "geometry/normals.h"

/* Corners of ZR_LANES triangles, one a lane. */
struct corner_v {
    zr_vf x, y, z;
};

/* Corner `k` of each. */
static inline struct corner_v load_corner(const struct zr_mesh *mesh, const uint32_t *indices, size_t k)
{
    zr_vf x, y, z, w;
#define CORNER(i) (&mesh->positions[indices[3 * (size_t)(i) + k]].x)
    ZR_LOAD4(x, y, z, w, CORNER);
#undef CORNER
    const zr_vf one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    if (zr_vm_bits(zr_vf_eq(w, one)) == ZR_ALL_BITS) return (struct corner_v){x, y, z};
    w = zr_vf_select(zr_vf_eq(w, zero), one, w); /* a direction */
    return (struct corner_v){x / w, y / w, z / w};
}

static inline struct corner_v minus(struct corner_v a, struct corner_v b)
{
    return (struct corner_v){a.x - b.x, a.y - b.y, a.z - b.z};
}

/* As zr_normal_of_face: there a sum of one. */
static inline void put_normals(const struct zr_mesh *mesh, const uint32_t *indices, zr_vec4 *out)
{
    const struct corner_v origin = load_corner(mesh, indices, 0);
    const struct corner_v a = minus(load_corner(mesh, indices, 1), origin),
                          b = minus(load_corner(mesh, indices, 2), origin);
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vf_store4((float *)out, zero + (a.y * b.z - a.z * b.y), zero + (a.z * b.x - a.x * b.z),
                 zero + (a.x * b.y - a.y * b.x), zero);
}

void ZR_KERNEL(zr_triangle_normals)(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *out)
{
    const uint32_t *indices = mesh->indices + 3 * (size_t)first;
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES)
        put_normals(mesh, indices + 3 * i, out + i);
    if (i == count) return;
    /* What is left of a group. */
    uint32_t last_indices[3 * ZR_LANES] = {0};
    zr_vec4 last[ZR_LANES];
    memcpy(last_indices, indices + 3 * i, 3 * (count - i) * sizeof *indices);
    put_normals(mesh, last_indices, last);
    memcpy(out + i, last, (count - i) * sizeof *out);
}
