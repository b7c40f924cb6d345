#include "base/prefetch.h"
#include "base/simd/simd.h"
#include "base/vec3_simd.h"
#include "mesh/crease_groups.h"
#include "mesh/crease_sums.h"
#include "mesh/face_normals.h"

/* Returns atan2(y, x) for y >= 0: 0 .. pi, within 1e-6; 0 for (0, 0). Source: the Chebyshev series of the arc tangent,
 * 2 (-1)^k q^(2k+1) / (2k+1) T(2k+1) with q = sqrt 2 - 1; the terms up to T13 leave an error below 3e-7 on 0..1. */
static inline zr_vf zr_angle_v(zr_vf y, zr_vf x)
{
    static const float c[] = {0.999995623f,  -0.33316002f,   0.19796892f,   -0.131959022f,
                              0.0789998337f, -0.0331052509f, 0.00665828962f};
    const float half_turn = 3.14159265f, quarter = 1.57079633f;
    const zr_vf wide = zr_vf_abs(x), zero = zr_vf_set(0.0f);
    const zr_vf most = zr_vf_max(wide, y), least = zr_vf_min(wide, y);
    const zr_vf t = least / zr_vf_select(zr_vf_eq(most, zero), zr_vf_set(1.0f), most), square = t * t;
    zr_vf sum = zr_vf_set(c[6]);
    for (int i = 5; i >= 0; i--)
        sum = sum * square + zr_vf_set(c[i]);
    sum = sum * t;
    sum = zr_vf_select(zr_vf_lt(wide, y), zr_vf_set(quarter) - sum, sum);
    return zr_vf_select(zr_vf_lt(x, zero), zr_vf_set(half_turn) - sum, sum);
}

/* ---- corners ---- */

/* Returns a vector's direction and length, or 0 for both if it is 0 or not finite. */
static inline struct zr_vec3_v split(struct zr_vec3_v v, zr_vf *length)
{
    const zr_vf zero = zr_vf_set(0.0f);
    const struct zr_vec3_v unit = zr_normalize_v(v), none = {zero, zero, zero};
    const zr_vf along = zr_dot_v(unit, v);
    const zr_vm has_one = zr_vm_and(zr_vf_lt(zero, along), zr_vf_lt(along, zr_vf_set(__builtin_inff())));
    *length = zr_vf_select(has_one, along, zero);
    return zr_choose_v(has_one, unit, none);
}

/* Loads corner `k` of ZR_LANES triangles, one per lane. */
static inline struct zr_vec3_v load_corner(const struct zr_mesh *mesh, const uint32_t *indices, size_t k)
{
    struct zr_vec3_v v;
    zr_vf w;
#define CORNER(i) (&mesh->positions[indices[3 * (size_t)(i) + k]].x)
    ZR_LOAD4(v.x, v.y, v.z, w, CORNER);
#undef CORNER
    (void)w;
    return v;
}

/* Writes the corners of ZR_LANES triangles. At each corner, the sine times both adjacent lengths is twice the area. */
static inline void put_triangles(const struct zr_mesh *mesh, const uint32_t *indices, zr_vec4 *out)
{
    const struct zr_vec3_v a = load_corner(mesh, indices, 0), b = load_corner(mesh, indices, 1),
                           c = load_corner(mesh, indices, 2);
    const struct zr_vec3_v ab = zr_minus_v(b, a), ac = zr_minus_v(c, a), bc = zr_minus_v(c, b);
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vf area;
    const struct zr_vec3_v unit = split(zr_cross_v(ab, ac), &area);
    const zr_vf cosines[3] = {zr_dot_v(ab, ac), zero - zr_dot_v(ab, bc), zr_dot_v(ac, bc)};
    for (int k = 0; k < 3; k++) {
        zr_vec4 corners[ZR_LANES];
        const zr_vf weight = zr_vf_select(zr_vf_eq(area, zero), zero, area * zr_angle_v(area, cosines[k]));
        zr_vf_store4((float *)corners, unit.x, unit.y, unit.z, weight);
        for (int i = 0; i < ZR_LANES; i++)
            zr_four_store(&out[3 * i + k], zr_four_load(&corners[i]));
    }
}

/* Prefetch distance, in triangles. */
enum { AHEAD = 32 };

static inline void prefetch_corners(const struct zr_mesh *mesh, const uint32_t *indices)
{
    for (int k = 0; k < 3 * ZR_LANES; k++)
        zr_prefetch(&mesh->positions[indices[k]], 0, sizeof *mesh->positions);
}

static void put_all_triangles(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *corners)
{
    const uint32_t *indices = mesh->indices + 3 * (size_t)first;
    const size_t left = mesh->face_count - first;
    zr_vec4 *out = corners + 3 * (size_t)first;
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES) {
        if (i + AHEAD + ZR_LANES <= left) prefetch_corners(mesh, indices + 3 * (i + AHEAD));
        put_triangles(mesh, indices + 3 * i, out + 3 * i);
    }
    if (i == count) return;
    /* The remaining triangles, fewer than a group. */
    uint32_t last_indices[3 * ZR_LANES];
    zr_vec4 last[3 * ZR_LANES];
    for (size_t k = 0; k < 3 * ZR_LANES; k++)
        last_indices[k] = indices[3 * i + k % (3 * (count - i))];
    put_triangles(mesh, last_indices, last);
    memcpy(out + 3 * i, last, 3 * (count - i) * sizeof *out);
}

/* Loads the positions of corners, one per lane. */
static inline struct zr_vec3_v load_positions(const struct zr_mesh *mesh, const uint32_t slots[ZR_LANES])
{
    struct zr_vec3_v v;
    zr_vf w;
#define CORNER(i) (&mesh->positions[mesh->indices[slots[i]]].x)
    ZR_LOAD4(v.x, v.y, v.z, w, CORNER);
#undef CORNER
    (void)w;
    return v;
}

/* Returns the angles of ZR_LANES consecutive corners of a ring; lanes beyond its end are undefined. */
static inline zr_vf ring_angles(const struct zr_mesh *mesh, uint32_t begin, uint32_t end, uint32_t first)
{
    uint32_t slots[ZR_LANES], before[ZR_LANES], behind[ZR_LANES];
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        const uint32_t slot = first + i < end ? first + i : end - 1;
        slots[i] = slot;
        before[i] = slot == begin ? end - 1 : slot - 1;
        behind[i] = slot + 1 == end ? begin : slot + 1;
    }
    const struct zr_vec3_v p = load_positions(mesh, slots), a = zr_minus_v(load_positions(mesh, before), p),
                           b = zr_minus_v(load_positions(mesh, behind), p);
    zr_vf sine;
    split(zr_cross_v(b, a), &sine);
    return zr_angle_v(sine, zr_dot_v(b, a));
}

static void put_polygon(const struct zr_mesh *mesh, uint32_t face, zr_vec4 *corners)
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const zr_vec3 normal = zr_normal_of_face(mesh, face);
    zr_vec3 unit = zr_vec3_normalize(normal);
    float area = zr_vec3_dot(unit, normal);
    if (!(area > 0.0f && area < __builtin_inff())) {
        unit = (zr_vec3){0, 0, 0};
        area = 0.0f;
    }
    for (uint32_t ring = 0; ring < rings.count; ring++) {
        const uint32_t begin = rings.offsets[ring], end = rings.offsets[ring + 1];
        for (uint32_t first = begin; first < end; first += ZR_LANES) {
            float angles[ZR_LANES];
            zr_vf_store(angles, ring_angles(mesh, begin, end, first));
            for (uint32_t i = 0; i < ZR_LANES && first + i < end; i++)
                corners[first + i] = (zr_vec4){unit.x, unit.y, unit.z, area > 0.0f ? area * angles[i] : 0.0f};
        }
    }
}

void ZR_KERNEL(zr_crease_corners)(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *corners)
{
    if (mesh->face_offsets[mesh->face_count] == 3 * (uint64_t)mesh->face_count) {
        put_all_triangles(mesh, first, count, corners);
        return;
    }
    for (uint32_t face = first; face < first + count; face++)
        put_polygon(mesh, face, corners);
}

/* ---- sums ---- */

/* Sets *is_bent if some sources do not count in all lanes. */
static inline struct zr_vec3_v sum_of(struct zr_vec3_v unit, const struct zr_crease_source *sources, uint32_t count,
                                      float cosine, bool *is_bent)
{
    const zr_vf zero = zr_vf_set(0.0f);
    const zr_vm has_no_unit = zr_vf_eq(zr_dot_v(unit, unit), zero);
    const zr_vf least = zr_vf_select(has_no_unit, zr_vf_set(-4.0f), zr_vf_set(cosine));
    struct zr_vec3_v sum = {zero, zero, zero};
    zr_vm all = ZR_ALL_LANES;
    for (uint32_t j = 0; j < count; j++) {
        const zr_vec4 *n = &sources[j].normal, *s = &sources[j].sum;
        const struct zr_vec3_v other = {zr_vf_set(n->x), zr_vf_set(n->y), zr_vf_set(n->z)};
        const zr_vm within = zr_vf_le(least, zr_dot_v(unit, other));
        all = zr_vm_and(all, within);
        sum.x = sum.x + zr_vf_select(within, zr_vf_set(s->x), zero);
        sum.y = sum.y + zr_vf_select(within, zr_vf_set(s->y), zero);
        sum.z = sum.z + zr_vf_select(within, zr_vf_set(s->z), zero);
    }
    *is_bent = zr_vm_bits(all) != ZR_ALL_BITS;
    return sum;
}

/* Traits of the normals of a vertex. */
struct sums {
    bool is_bent;  /* some sources do not count */
    bool is_equal; /* all are one normal, and marked so */
};

/* Writes the normals of ZR_LANES corners, or of `count` if that is less. If all sources count, the normals are equal,
 * and are marked with the slot `first`. */
static inline struct sums put_sums(uint32_t first, const uint32_t *slots, uint32_t count,
                                   const struct zr_crease_source *sources, uint32_t source_count, float cosine,
                                   zr_vec4 *corners)
{
    struct zr_vec3_v unit;
    zr_vf weight, length;
    zr_vec4 normals[ZR_LANES];
    bool is_bent;
#define CORNER(i) (&corners[slots[(uint32_t)(i) < count ? (uint32_t)(i) : count - 1]].x)
    ZR_LOAD4(unit.x, unit.y, unit.z, weight, CORNER);
#undef CORNER
    (void)weight;
    const struct zr_vec3_v normal = split(sum_of(unit, sources, source_count, cosine, &is_bent), &length);
    const zr_vf zero = zr_vf_set(0.0f);
    const zr_vm has_none = zr_vf_eq(length, zero);
    const struct zr_vec3_v chosen = zr_choose_v(has_none, unit, normal);
    zr_vf_store4((float *)normals, chosen.x, chosen.y, chosen.z, zr_vf_bits(zr_vi_set((int32_t)first)));
    for (uint32_t i = 0; i < ZR_LANES && i < count; i++)
        zr_four_store(&corners[slots[i]], zr_four_load(&normals[i]));
    return (struct sums){is_bent, !is_bent && zr_vm_bits(has_none) == 0};
}

static inline void join(struct sums *all, struct sums more)
{
    all->is_bent |= more.is_bent;
    all->is_equal &= more.is_equal;
}

static inline void list_sources(const zr_vec4 *corners, const uint32_t *slots, uint32_t count,
                                struct zr_crease_source *sources)
{
    for (uint32_t i = 0; i < count; i++) {
        const zr_vec4 *corner = &corners[slots[i]];
        const zr_four normal = zr_four_load(corner);
        zr_four_store(&sources[i].normal, normal);
        zr_four_store(&sources[i].sum, normal * (zr_four){corner->w, corner->w, corner->w, corner->w});
    }
}

/* Not inlined: it is rare, and its groups take 48 KB of stack. */
static __attribute__((noinline)) void put_crowd(const uint32_t *slots, uint32_t count, float cosine, zr_vec4 *corners)
{
    struct zr_crease_source groups[ZR_CREASE_GROUPS];
    const uint32_t group_count = zr_crease_groups(corners, slots, count, groups);
    for (uint32_t i = 0; i < count; i += ZR_LANES)
        put_sums(slots[0], slots + i, count - i, groups, group_count, cosine, corners);
}

/* Prefetch distance, in corners. */
enum { CORNERS_AHEAD = 64 };

size_t ZR_KERNEL(zr_crease_sums)(const struct zr_vertex_corners *of, size_t begin, size_t end, float cosine,
                                 zr_vec4 *corners)
{
    size_t distinct = 0;
    struct zr_crease_source sources[ZR_CREASE_EXACT];
    uint32_t first = begin == 0 ? 0 : of->ends[begin - 1];
    uint32_t prefetched = first;
    const uint32_t last = end == 0 ? 0 : of->ends[end - 1];
    for (size_t vertex = begin; vertex < end; vertex++) {
        const uint32_t count = of->ends[vertex] - first, *slots = of->slots + first;
        first += count;
        for (; prefetched < last && prefetched < first + CORNERS_AHEAD; prefetched++)
            zr_prefetch_written(&corners[of->slots[prefetched]], 0, sizeof *corners);
        struct sums sums = {.is_equal = true};
        if (of->bent) of->bent[vertex] = 0;
        if (count > ZR_CREASE_EXACT) {
            put_crowd(slots, count, cosine, corners);
            distinct += zr_crease_mark_equal(slots, count, corners);
            continue;
        }
        list_sources(corners, slots, count, sources);
        for (uint32_t i = 0; i < count; i += ZR_LANES)
            join(&sums, put_sums(slots[0], slots + i, count - i, sources, count, cosine, corners));
        if (!sums.is_bent || !of->bent || count > ZR_FAN_CORNERS_MOST) {
            distinct += sums.is_equal ? count > 0 : zr_crease_mark_equal(slots, count, corners);
            continue;
        }
        of->bent[vertex] = 1;
        for (uint32_t i = 0; i < count; i++)
            corners[slots[i]] = sources[i].normal;
    }
    return distinct;
}
