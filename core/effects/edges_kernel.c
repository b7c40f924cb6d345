#include "effects/edge_marks.h"
#include "effects/pixel_scale_simd.h"

struct pair {
    const struct zr_edge_line *a, *b;
};

static inline struct zr_vec3_v load3(const float *const v[3], int32_t at)
{
    return (struct zr_vec3_v){zr_vf_load(v[0] + at), zr_vf_load(v[1] + at), zr_vf_load(v[2] + at)};
}

/* Compares ZR_LANES pairs, all covered. Symmetric in a and b to the last bit: differences only change their sign. */
static inline void compare_faces(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                                 const struct zr_edge_line *b, int32_t at, zr_vm *apart, zr_vm *bent)
{
    const struct zr_vec3_v n1 = load3(a->normal, at), n2 = load3(b->normal, at);
    const struct zr_vec3_v p1 = load3(a->point, at), p2 = load3(b->point, at), between = zr_minus_v(p2, p1);
    const zr_vf zero = zr_vf_set(0.0f);
    const zr_vm are_faces = zr_vm_and(zr_vf_lt(zero, zr_dot_v(n1, n1)), zr_vf_lt(zero, zr_dot_v(n2, n2)));
    const zr_vf distance = zr_vf_min(zr_vf_abs(zr_dot_v(between, n1)), zr_vf_abs(zr_dot_v(between, n2)));
    const zr_vf depth = zr_vf_max(zr_pixel_scale_w_v(&rule->scale, p1), zr_pixel_scale_w_v(&rule->scale, p2));
    *apart = zr_vm_and(are_faces, zr_vf_lt(depth * zr_vf_set(rule->limit), distance));
    *bent = zr_vm_and(are_faces, zr_vf_lt(zr_dot_v(n1, n2), zr_vf_set(rule->cosine)));
}

/* Compares those of ZR_LANES pairs from `at` on that are in `both`, whose samples are covered. */
static inline void compare(const struct zr_edge_rule *rule, const struct pair *lines, int32_t at, uint64_t both,
                           struct zr_edge_bits *bits)
{
    const struct zr_edge_line *a = lines->a, *b = lines->b;
    const uint32_t here = (uint32_t)(both >> at) & (uint32_t)ZR_ALL_BITS;
    if (!here) return;
    zr_vm apart, bent;
    compare_faces(rule, a, b, at, &apart, &bent);
    uint32_t steps = zr_vm_bits(apart) & here;
    if (steps && rule->faces) steps = zr_edge_faces_apart(rule, a, b, at, steps);
    if (rule->caps) {
        const zr_vm same = zr_vi_eq(zr_vi_load(a->owner + at), zr_vi_load(b->owner + at));
        const uint32_t pairs = here & ~zr_vm_bits(same);
        if (pairs) steps |= zr_edge_caps_apart(rule, a, b, at, pairs);
    }
    bits->silhouettes |= (uint64_t)steps << at;
    bits->creases |= (uint64_t)(zr_vm_bits(bent) & here & ~steps) << at;
}

/* Copy of a line with fewer samples than lanes, padded with uncovered samples. */
struct short_line {
    uint32_t owner[ZR_LANES];
    float vectors[6][ZR_LANES];
};

static inline struct zr_edge_line copy_line(const struct zr_edge_line *line, int32_t count, struct short_line *copy)
{
    memset(copy, 0, sizeof *copy);
    struct zr_edge_line out = {.owner = copy->owner};
    memcpy(copy->owner, line->owner, (size_t)count * sizeof *copy->owner);
    for (int k = 0; k < 3; k++) {
        memcpy(copy->vectors[k], line->normal[k], (size_t)count * sizeof(float));
        memcpy(copy->vectors[3 + k], line->point[k], (size_t)count * sizeof(float));
        out.normal[k] = copy->vectors[k];
        out.point[k] = copy->vectors[3 + k];
    }
    return out;
}

/* Returns the covered samples of the first `count` of a line. */
static inline uint64_t covered(const struct zr_edge_line *line, int32_t count)
{
    uint64_t bits = 0;
    for (int32_t at = 0; at < count; at += ZR_LANES) {
        uint32_t owners[ZR_LANES] = {0};
        const int32_t left = count - at < ZR_LANES ? count - at : ZR_LANES;
        memcpy(owners, line->owner + at, (size_t)left * sizeof *owners);
        bits |= (uint64_t)zr_vm_bits(zr_vi_lt(zr_vi_set(0), zr_vi_load(owners))) << at;
    }
    return bits;
}

/* Compares the pairs of `both`, of `count`. */
static inline struct zr_edge_bits compare_lines(const struct zr_edge_rule *rule, const struct pair *lines,
                                                int32_t count, uint64_t both)
{
    struct zr_edge_bits bits = {0, 0};
    if (!both) return bits;
    if (count >= ZR_LANES) {
        for (int32_t at = 0; at + ZR_LANES <= count; at += ZR_LANES)
            compare(rule, lines, at, both, &bits);
        /* The remaining pairs, with some that were compared before. */
        if (count % ZR_LANES) compare(rule, lines, count - ZR_LANES, both, &bits);
    } else if (count > 0) {
        struct short_line copies[2];
        const struct zr_edge_line a = copy_line(lines->a, count, &copies[0]),
                                  b = copy_line(lines->b, count, &copies[1]);
        const struct pair copied = {&a, &b};
        compare(rule, &copied, 0, both, &bits);
    }
    return bits;
}

struct zr_edge_bits ZR_KERNEL(zr_edge_pairs)(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                                             const struct zr_edge_line *b, int32_t count)
{
    const struct pair lines = {a, b};
    const uint64_t of_a = covered(a, count), of_b = covered(b, count);
    struct zr_edge_bits bits = compare_lines(rule, &lines, count, of_a & of_b);
    bits.silhouettes |= of_a ^ of_b;
    return bits;
}

static inline struct zr_edge_line line_at(const struct zr_gbuffer *tile, ptrdiff_t at)
{
    struct zr_edge_line line = {.owner = tile->owner + at};
    for (int k = 0; k < 3; k++) {
        line.normal[k] = tile->normal[k] + at;
        line.point[k] = tile->point[k] + at;
    }
    return line;
}

void ZR_KERNEL(zr_edge_tile)(const struct zr_edge_rule *rule, const struct zr_gbuffer *tile,
                             const struct zr_sample_pairs *pairs, struct zr_edge_bits *rows)
{
    const uint64_t neighbours = UINT64_MAX >> (ZR_TILE_SIZE - tile->width) >> 1;
    struct zr_edge_line row = line_at(tile, 0);
    uint64_t here = covered(&row, tile->width);
    struct zr_edge_bits from_below = {0, 0};
    for (int32_t y = 0; y < tile->height; y++) {
        const ptrdiff_t at = y * tile->stride;
        const struct zr_edge_line next = line_at(tile, at + 1), above = line_at(tile, at + tile->stride);
        struct pair lines = {&row, &next};
        struct zr_edge_bits along =
            compare_lines(rule, &lines, tile->width - 1, here & here >> 1 & pairs->along[y] & neighbours);
        along.silhouettes |= (here ^ here >> 1) & neighbours;
        struct zr_edge_bits upwards = {0, 0};
        uint64_t there = 0;
        if (y + 1 < tile->height) {
            there = covered(&above, tile->width);
            lines.b = &above;
            upwards = compare_lines(rule, &lines, tile->width, here & there & pairs->upwards[y]);
            upwards.silhouettes |= here ^ there;
        }
        rows[y].silhouettes = along.silhouettes | along.silhouettes << 1 | upwards.silhouettes | from_below.silhouettes;
        rows[y].creases = along.creases | along.creases << 1 | upwards.creases | from_below.creases;
        from_below = upwards;
        row = above;
        here = there;
    }
}
