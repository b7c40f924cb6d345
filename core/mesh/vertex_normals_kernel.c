#include "base/prefetch.h"
#include "base/vec3_simd.h"
#include "mesh/vertex_normals.h"

/* Triangles whose sums are prefetched while the block before is added. Without this, a million triangles take up to
 * half as long again. */
enum { TRIANGLES_AT_ONCE = 64, CORNERS_AT_ONCE = 3 * TRIANGLES_AT_ONCE };

_Static_assert(CORNERS_AT_ONCE % ZR_LANES == 0, "blocks are whole vectors");

/* Corners of a block that belong to one part. */
struct own {
    uint32_t count;
    uint32_t corners[CORNERS_AT_ONCE + ZR_LANES]; /* 3 t + k of triangle t */
};

static void list(const uint32_t *indices, size_t begin, size_t end, struct zr_vertex_part part, const zr_vec4 *sums,
                 struct own *own)
{
    const zr_vi bits = zr_vi_set((int32_t)((part.count - 1) * ZR_PART_VERTICES)),
                wanted = zr_vi_set((int32_t)(part.number * ZR_PART_VERTICES));
    size_t corner = begin;
    own->count = 0;
    for (; corner + ZR_LANES <= end; corner += ZR_LANES) {
        const zr_vm is_own = zr_vi_eq(zr_vi_load(indices + corner) & bits, wanted);
        own->count += zr_vi_list_bits(own->corners + own->count, zr_vm_bits(is_own), (int32_t)corner);
    }
    for (; corner < end; corner++)
        if (zr_vertex_is_of_part(indices[corner], part)) own->corners[own->count++] = (uint32_t)corner;
    for (uint32_t i = 0; i < own->count; i++)
        zr_prefetch_written(&sums[indices[own->corners[i]]], 0, sizeof *sums);
}

static void add(const uint32_t *indices, const zr_vec4 *normals, const struct own *own, zr_vec4 *sums)
{
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t corner = own->corners[i];
        zr_vec4 *sum = &sums[indices[corner]];
        zr_four_store(sum, zr_four_load(sum) + zr_four_load(&normals[corner / 3]));
    }
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

void ZR_KERNEL(zr_add_normals)(const uint32_t *indices, size_t triangles, const zr_vec4 *normals,
                               struct zr_vertex_part part, zr_vec4 *sums)
{
    const size_t corners = 3 * triangles;
    struct own own[2];
    list(indices, 0, least(CORNERS_AT_ONCE, corners), part, sums, &own[0]);
    for (size_t begin = 0, which = 0; begin < corners; begin += CORNERS_AT_ONCE, which ^= 1) {
        const size_t next = least(begin + CORNERS_AT_ONCE, corners);
        list(indices, next, least(next + CORNERS_AT_ONCE, corners), part, sums, &own[which ^ 1]);
        add(indices, normals, &own[which], sums);
    }
}

static inline void normalize_group(zr_vec4 *vectors)
{
    struct zr_vec3_v v;
    zr_vf w;
    zr_vf_load_fours((const float *)vectors, &v.x, &v.y, &v.z, &w);
    v = zr_normalize_v(v);
    zr_vf_store_fours((float *)vectors, v.x, v.y, v.z, w);
}

void ZR_KERNEL(zr_normalize)(zr_vec4 *vectors, size_t count)
{
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES)
        normalize_group(vectors + i);
    if (i == count) return;
    /* The remaining vectors, fewer than a group. */
    zr_vec4 last[ZR_LANES] = {{0, 0, 0, 0}};
    memcpy(last, vectors + i, (count - i) * sizeof *vectors);
    normalize_group(last);
    memcpy(vectors + i, last, (count - i) * sizeof *vectors);
}
