#include "base/mutant.h"
#include "effects/pixel_scale_simd.h"
#include "effects/surfaces.h"

enum {
    SIDE = ZR_SURFACES_SIDE,
    SAMPLES = SIDE * SIDE,
    COLUMNS = ZR_SURFACES_COLUMNS,
    BITS_WORDS = ZR_SAMPLES_ROOM / 32 + 2
};

/* The cosine of 6 degrees, and the largest difference of base colours in a surface. */
#define LEAST_COSINE    ZR_MUTANT(joins_to_20_degrees, 0.99452190f, 0.93969262f)
#define COLOR_TOLERANCE (1.0f / 64.0f)

/* Pixels between a point and the plane of a surface: 1.5 samples, at which samples become a silhouette (edges.h). */
#define MOST_AWAY 0.375f

/* ---- primitives of a pixel ---- */

/* Sample i of a pixel, of its column i % SIDE and row i / SIDE, is bit i of a mask. Returns those of an owner. */
static inline uint32_t owned_by(const uint32_t *owners, uint32_t owner)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < SAMPLES; i += ZR_LANES) {
        const uint32_t *at = owners + i / SIDE * ZR_TILE_STRIDE + i % SIDE;
        bits |= zr_vm_bits(zr_vi_eq(zr_vi_load_patch(at, ZR_TILE_STRIDE), zr_vi_set((int32_t)owner))) << i;
    }
    return bits;
}

/* A pixel: place of its first sample in the tile, and that sample in the window. */
struct pixel {
    uint32_t at;
    float x, y;
};

static inline void find_in_pixel(const uint32_t *owners, const struct pixel *pixel, struct zr_surfaces *out)
{
    struct zr_sample_list *list = &out->list;
    const uint32_t *own = owners + pixel->at, lead = list->count;
    uint32_t left = owned_by(own, 0) ^ 0xFFFFu;
    while (left) {
        const uint32_t middle = zr_surface_nearest_of(left),
                       owner = own[middle / SIDE * ZR_TILE_STRIDE + middle % SIDE];
        const uint32_t same = owned_by(own, owner), count = (uint32_t)__builtin_popcount(same), i = list->count++;
        const struct zr_surface_middle at = zr_surface_middle_of(same);
        list->x[i] = pixel->x + at.x;
        list->y[i] = pixel->y + at.y;
        list->owner[i] = owner;
        out->samples[i] = count;
        out->lead[i] = lead;
        left &= ~same;
    }
}

void ZR_KERNEL(zr_surfaces_find)(const uint32_t *owners, const struct zr_tile *tile, int32_t from,
                                 struct zr_surfaces *out)
{
    out->columns = tile->width / SIDE;
    out->list.count = 0;
    int32_t y = from;
    for (; y < tile->height / SIDE && out->list.count + ZR_SURFACES_PER_ROW <= ZR_SAMPLES_LISTED; y++)
        for (int32_t x = 0; x < out->columns; x++) {
            out->first[(y - from) * out->columns + x] = out->list.count;
            const struct pixel pixel = {(uint32_t)(y * SIDE * ZR_TILE_STRIDE + x * SIDE), (float)(tile->x + x * SIDE),
                                        (float)(tile->y + y * SIDE)};
            find_in_pixel(owners, &pixel, out);
        }
    out->rows = y - from;
    out->first[out->rows * out->columns] = out->list.count;
    for (uint32_t i = out->list.count; i < out->list.count + ZR_LANES; i++)
        out->lead[i] = i;
}

/* ---- surfaces that join ---- */

/* Normal and point of ZR_LANES surfaces. */
struct place_v {
    struct zr_vec3_v normal, point;
};

/* Returns which surfaces join by their places. Symmetric to the last bit. */
static inline zr_vm are_beside(const struct zr_surface_rule *rule, const struct place_v *a, const struct place_v *b)
{
    const struct zr_vec3_v between = zr_minus_v(b->point, a->point);
    const zr_vf away = zr_vf_min(zr_vf_abs(zr_dot_v(between, a->normal)), zr_vf_abs(zr_dot_v(between, b->normal)));
    const zr_vf depth =
        zr_vf_max(zr_pixel_scale_w_v(&rule->scale, a->point), zr_pixel_scale_w_v(&rule->scale, b->point));
    const zr_vm is_straight = zr_vf_le(zr_vf_set(LEAST_COSINE), zr_dot_v(a->normal, b->normal));
    return zr_vm_and(is_straight, zr_vf_le(away, depth * zr_vf_set(MOST_AWAY / rule->scale.scale)));
}

static inline zr_vf load(const float *plane, zr_vi at)
{
    return zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, plane, at));
}

static inline struct zr_vec3_v gather3(const float (*planes)[ZR_SAMPLES_ROOM], zr_vi at)
{
    return (struct zr_vec3_v){load(planes[0], at), load(planes[1], at), load(planes[2], at)};
}

static inline struct zr_vec3_v load3(const float (*planes)[ZR_SAMPLES_ROOM], uint32_t at)
{
    return (struct zr_vec3_v){zr_vf_load(planes[0] + at), zr_vf_load(planes[1] + at), zr_vf_load(planes[2] + at)};
}

struct values_v {
    struct zr_vec3_v base;
    struct place_v place;
    zr_vi material;
};

static inline struct values_v values_of(const struct zr_surfaces *s, zr_vi at)
{
    return (struct values_v){gather3(s->floats, at),
                             {gather3(s->floats + 3, at), gather3(s->floats + 6, at)},
                             zr_vi_gather(ZR_ALL_LANES, s->material, at)};
}

static inline struct values_v values_at(const struct zr_surfaces *s, uint32_t at)
{
    return (struct values_v){
        load3(s->floats, at), {load3(s->floats + 3, at), load3(s->floats + 6, at)}, zr_vi_load(s->material + at)};
}

/* Returns the lanes whose surfaces, with the values `b`, join their surfaces `lead`. */
static inline uint32_t that_join(const struct zr_surface_rule *rule, const struct zr_surfaces *s,
                                 const struct values_v *b, zr_vi lead)
{
    const struct values_v a = values_of(s, lead);
    const struct zr_vec3_v colors = zr_minus_v(b->base, a.base);
    const zr_vf most = zr_vf_set(COLOR_TOLERANCE);
    const zr_vm of_color =
        zr_vm_and(zr_vm_and(zr_vf_le(zr_vf_abs(colors.x), most), zr_vf_le(zr_vf_abs(colors.y), most)),
                  zr_vf_le(zr_vf_abs(colors.z), most));
    const zr_vm alike = zr_vm_and(of_color, zr_vi_eq(a.material, b->material));
    return zr_vm_bits(zr_vm_and(alike, are_beside(rule, &a.place, &b->place)));
}

/* Sets a bit for each surface that joins the first of its pixel. Returns false if all pixels have one at most. */
static inline bool join_leads(const struct zr_surface_rule *rule, const struct zr_surfaces *s, uint32_t *bits)
{
    bool has_others = false;
    memset(bits, 0, BITS_WORDS * sizeof *bits);
    for (uint32_t i = 0; i < s->list.count; i += ZR_LANES) {
        const zr_vi lead = zr_vi_load(s->lead + i);
        if (zr_vm_bits(zr_vi_eq(lead, zr_vi_set((int32_t)i) + zr_vi_ramp())) == ZR_ALL_BITS) continue;
        const struct values_v values = values_at(s, i);
        bits[i / 32] |= that_join(rule, s, &values, lead) << i % 32;
        has_others = true;
    }
    return has_others;
}

/* ---- pixels ---- */

/* Surfaces of a pixel that have not joined another one yet. */
struct open {
    uint32_t count, at[SAMPLES];
};

enum { VALUES = 11 }; /* that have a mean: base colour, normal, point, place */

static inline float *values_row(struct zr_surfaces *s, int k)
{
    return k < 9 ? s->floats[k] : k == 9 ? s->list.x : s->list.y;
}

static inline void move(struct zr_surfaces *s, uint32_t from, uint32_t to)
{
    if (from == to) return;
    for (int k = 0; k < VALUES; k++)
        values_row(s, k)[to] = values_row(s, k)[from];
    s->samples[to] = s->samples[from];
    s->list.owner[to] = s->list.owner[from];
    s->material[to] = s->material[from];
}

/* Writes means from sums over samples. The mean of normals becomes a unit vector. */
static inline void put_means(struct zr_surfaces *s, float sum[VALUES], uint32_t samples, uint32_t to)
{
    float *n = sum + 3;
    const float over = (float)samples / __builtin_sqrtf((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] *= over;
    for (int k = 0; k < VALUES; k++)
        values_row(s, k)[to] = sum[k] / (float)samples;
    s->samples[to] = samples;
}

/* Joins those that remain to the first of them, as `joined` has it, a bit each, and leaves the others. The result is
 * surface `to`, which may be the first. */
static inline void take_first(struct zr_surfaces *s, uint32_t joined, struct open *open, uint32_t to)
{
    const uint32_t all = open->count, first = open->at[0];
    float sum[VALUES], count = (float)s->samples[first];
    uint32_t samples = s->samples[first];
    for (int k = 0; k < VALUES; k++)
        sum[k] = values_row(s, k)[first] * count;
    open->count = 0;
    for (uint32_t i = 1; i < all; i++) {
        const uint32_t at = open->at[i];
        if (!(joined >> i & 1)) {
            open->at[open->count++] = at;
            continue;
        }
        count = (float)s->samples[at];
        samples += s->samples[at];
        for (int k = 0; k < VALUES; k++)
            sum[k] += values_row(s, k)[ZR_MUTANT(joined_keep_first_values, at, first)] * count;
    }
    move(s, first, to);
    if (open->count + 1 < all) put_means(s, sum, samples, to);
}

static inline uint32_t joined_to_first(const struct zr_surface_rule *rule, const struct zr_surfaces *s,
                                       const struct open *open)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < open->count; i += ZR_LANES) {
        uint32_t at[ZR_LANES];
        for (uint32_t lane = 0; lane < ZR_LANES; lane++)
            at[lane] = open->at[i + lane < open->count ? i + lane : 0];
        const struct values_v values = values_of(s, zr_vi_load(at));
        bits |= that_join(rule, s, &values, zr_vi_set((int32_t)open->at[0])) << i;
    }
    return bits;
}

/* Joins the surfaces begin .. end - 1 of a pixel; the results are surfaces from `count` on, which is at most begin.
 * `joined`: those that join the first. Returns the new count. */
static inline uint32_t join_pixel(const struct zr_surface_rule *rule, struct zr_surfaces *s, const uint32_t range[2],
                                  uint32_t joined, uint32_t count)
{
    struct open open;
    open.count = range[1] - range[0];
    for (uint32_t i = 0; i < open.count; i++)
        open.at[i] = range[0] + i;
    while (open.count > 1) {
        take_first(s, joined, &open, count++);
        if (open.count > 1) joined = joined_to_first(rule, s, &open);
    }
    if (open.count == 1) move(s, open.at[0], count++);
    return count;
}

/* Returns bits first .. first + SAMPLES - 1. */
static inline uint32_t bits_from(const uint32_t *bits, uint32_t first)
{
    const uint64_t two = bits[first / 32] | (uint64_t)bits[first / 32 + 1] << 32;
    return (uint32_t)(two >> first % 32) & 0xFFFFu;
}

void ZR_KERNEL(zr_surfaces_join)(const struct zr_surface_rule *rule, struct zr_surfaces *s)
{
    const uint32_t pixels = (uint32_t)(s->rows * s->columns);
    uint32_t bits[BITS_WORDS], count = 0;
    if (!join_leads(rule, s, bits)) return;
    for (uint32_t i = 0, begin = 0; i < pixels; i++) {
        const uint32_t range[2] = {begin, s->first[i + 1]};
        s->first[i] = count;
        count = join_pixel(rule, s, range, bits_from(bits, begin), count);
        begin = range[1];
    }
    s->first[pixels] = s->list.count = count;
}

/* ---- where surfaces end ---- */

static inline struct place_v place_at(const struct zr_surface_pixels *pixels, int32_t at)
{
    const float(*f)[ZR_SURFACES_PIXELS + 16] = pixels->floats;
    return (struct place_v){{zr_vf_load(f[0] + at), zr_vf_load(f[1] + at), zr_vf_load(f[2] + at)},
                            {zr_vf_load(f[3] + at), zr_vf_load(f[4] + at), zr_vf_load(f[5] + at)}};
}

/* Returns the lanes at which the surfaces of pixels `a` and `b` do not join. */
static inline uint32_t apart(const struct zr_surface_rule *rule, const struct zr_surface_pixels *pixels, int32_t a,
                             int32_t b)
{
    const struct place_v here = place_at(pixels, a), there = place_at(pixels, b);
    const zr_vm same = zr_vi_eq(zr_vi_load(pixels->owner + a), zr_vi_load(pixels->owner + b));
    return zr_vm_bits(zr_vm_or(same, are_beside(rule, &here, &there))) ^ (uint32_t)ZR_ALL_BITS;
}

static inline uint32_t parted(const struct zr_surface_rule *rule, const struct zr_surface_pixels *pixels, int32_t a,
                              int32_t b)
{
    uint32_t bits = 0;
    for (int32_t x = 0; x < COLUMNS; x += ZR_LANES)
        bits |= apart(rule, pixels, a + x, b + x) << x;
    return bits;
}

static inline uint32_t split_pixels(const struct zr_surface_pixels *pixels, int32_t at)
{
    uint32_t bits = 0;
    for (int32_t x = 0; x < pixels->columns; x++)
        bits |= (uint32_t)pixels->is_split[at + x] << x;
    return bits;
}

/* Returns the word of samples for a row of pixels: those of `mask`, bit 0 the leftmost of SIDE. */
static inline uint64_t samples_of(uint32_t pixels, uint64_t mask)
{
    uint64_t out = 0;
    for (; pixels; pixels &= pixels - 1)
        out |= mask << (SIDE * zr_lowest_bit(pixels));
    return out;
}

void ZR_KERNEL(zr_surfaces_ends)(const struct zr_surface_rule *rule, const struct zr_surface_pixels *pixels,
                                 struct zr_sample_pairs *out)
{
    const uint32_t all = (1u << pixels->columns) - 1;
    uint64_t below = 0; /* pairs of the topmost samples of the row of pixels below */
    for (int32_t y = 0; y < pixels->rows; y++) {
        const int32_t at = y * COLUMNS;
        const uint32_t split = split_pixels(pixels, at), along = parted(rule, pixels, at, at + 1) & all >> 1;
        const uint64_t whole = samples_of(split, 0xF);
        if (y > 0) out->upwards[y * SIDE - 1] = below | whole;
        for (int32_t row = y * SIDE; row < (y + 1) * SIDE; row++) {
            out->along[row] = whole | whole >> 1 | samples_of(along, 0x8);
            out->upwards[row] = whole;
        }
        below = whole;
        if (y + 1 < pixels->rows) below |= samples_of(parted(rule, pixels, at, at + COLUMNS) & all, 0xF);
    }
}
