#include "support/simd_check.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/random.h"
#include "support/simd_kernel.h"

/* ---- operands ---- */

static const float odd_floats[] = {NAN,       -NAN,       INFINITY,  -INFINITY,  0.0f,           -0.0f,
                                   0x1p-149f, -0x1p-149f, 0x1p-130f, -0x1p-130f, 0x1p-126f,      FLT_MAX,
                                   -FLT_MAX,  1.0f,       -1.0f,     0.5f,       -1.5f,          2.5f,
                                   3.0f,      255.0f,     0x1p-64f,  0x1p64f,    0x1.fffffep-1f, 16777216.0f};
static const float odd_small[] = {0.0f,       -0.0f,       0.5f,           -0.5f,      1.5f,        -1.5f,
                                  2.5f,       -2.5f,       0x1.fffffep-2f, 0x1p-149f,  254.5f,      255.5f,
                                  2097151.5f, -2097151.5f, 2097150.5f,     4194303.5f, -4194303.5f, 4194303.0f};
static const int32_t odd_ints[] = {0,     1,      -1,       2,         255,       -256,     65535,
                                   65536, -65537, 16777217, -16777219, INT32_MAX, INT32_MIN};

#define COUNT_OF(array) ((uint32_t)(sizeof(array) / sizeof *(array)))

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t random_bits(struct random *random)
{
    return (uint32_t)(random_next(random) >> 32);
}

/* Makes pairs without a half of -32768. */
static int32_t random_pair(struct random *random)
{
    static const int16_t odd_halves[] = {0, 1, -1, 255, -256, 32767, -32767};
    int16_t halves[2];
    for (int i = 0; i < 2; i++)
        halves[i] = random_below(random, 4) == 0 ? odd_halves[random_below(random, COUNT_OF(odd_halves))]
                                                 : (int16_t)((int32_t)random_below(random, 65535) - 32767);
    int32_t pair;
    memcpy(&pair, halves, sizeof pair);
    return pair;
}

/* All pairs of odd ones first, then any. */
static void make_inputs(struct random *random, struct simd_inputs *in)
{
    _Static_assert(sizeof odd_floats / 4 * sizeof odd_floats / 4 < SIMD_COUNT, "all pairs have room");
    for (uint32_t k = 0; k < SIMD_COUNT; k++) {
        const uint32_t floats = COUNT_OF(odd_floats), ints = COUNT_OF(odd_ints);
        in->a[k] = k < floats * floats ? odd_floats[k % floats] : float_of(random_bits(random));
        in->b[k] = k < floats * floats ? odd_floats[k / floats] : float_of(random_bits(random));
        in->i[k] = k < ints * ints ? odd_ints[k % ints] : (int32_t)random_bits(random);
        in->j[k] = k < ints * ints ? odd_ints[k / ints] : (int32_t)random_bits(random);
        if (k % 8 == 7) in->j[k] = in->i[k];
        in->small[k] = k < COUNT_OF(odd_small) ? odd_small[k] : (float)random_range(random, -4194303.0, 4194303.0);
        if (k % 3 == 2) in->small[k] = truncf(in->small[k] / 4) + 0.5f;
        uint32_t density = random_below(random, 4);
        in->m[k] = k % 64 < 16 ? 0 : k % 64 < 32 ? 1 : density > 1;
        in->n[k] = (int32_t)random_below(random, 2);
        in->order[k] = random_below(random, SIMD_COUNT);
        in->first[k] = random_below(random, 17);
        in->p[k] = random_pair(random);
        in->q[k] = random_pair(random);
    }
    for (uint32_t k = 0; k < COUNT_OF(in->corners); k++)
        in->corners[k] = random_below(random, SIMD_COUNT);
    for (uint32_t k = 0; k < SIMD_COUNT; k++)
        in->doubles[k] = (double)float_of(random_bits(random)) * (1.0 + 0x1p-40);
    for (uint32_t k = 0; k < COUNT_OF(in->places); k++)
        in->places[k] = float_of(random_bits(random));
}

/* ---- what plain C makes of them ---- */

static int32_t wrap(uint32_t bits)
{
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* To the nearest, ties to even, in exact double. */
static int32_t nearest(float value)
{
    double below = floor((double)value), above = below + 1.0, left = (double)value - below,
           right = above - (double)value;
    if (left != right) return (int32_t)(left < right ? below : above);
    return (int32_t)(fmod(below, 2.0) == 0.0 ? below : above);
}

static void want_floats(const struct simd_inputs *in, struct simd_results *want, int k)
{
    const float a = in->a[k], b = in->b[k];
    want->vf_set[k] = in->a[k - k % want->lanes];
    want->vf_ramp[k] = (float)(k % want->lanes);
    want->vf_load[k] = a;
    want->vf_add[k] = a + b;
    want->vf_sub[k] = a - b;
    want->vf_mul[k] = a * b;
    want->vf_div[k] = a / b;
    want->vf_min[k] = a < b ? a : b;
    want->vf_max[k] = a > b ? a : b;
    want->vf_abs[k] = fabsf(a);
    want->vf_sqrt[k] = sqrtf(a);
    want->vf_of[k] = (float)in->i[k];
    want->vf_select[k] = in->m[k] ? a : b;
    want->vf_lt[k] = a < b;
    want->vf_le[k] = a <= b;
    want->vf_eq[k] = a == b;
    want->vf_lt_where[k] = in->m[k] && a < b;
    want->vf_eq_where[k] = in->m[k] && a == b;
    want->vf_bits[k] = float_of((uint32_t)in->i[k]);
    for (int c = 0; c < 4; c++)
        want->load4[c][k] = want->vf_store4[4 * k + c] = in->places[SIMD_APART * in->order[k] + (uint32_t)c];
    uint32_t four[4];
    memcpy(four, in->places + 4 * k + 1, sizeof four);
    four[0] ^= four[3];
    memcpy(want->vf_store_fours + 4 * k, four, sizeof four);
    memcpy(want->vf_stream_fours + 4 * k, four, sizeof four);
}

static void want_ints(const struct simd_inputs *in, struct simd_results *want, int k)
{
    const int32_t i = in->i[k], j = in->j[k];
    const uint32_t u = (uint32_t)i, v = (uint32_t)j;
    want->vi_set[k] = in->i[k - k % want->lanes];
    want->vi_ramp[k] = k % want->lanes;
    want->vi_add[k] = wrap(u + v);
    want->vi_sub[k] = wrap(u - v);
    want->vi_mul[k] = wrap(u * v);
    want->vi_and[k] = i & j;
    want->vi_or[k] = i | j;
    want->vi_xor[k] = i ^ j;
    want->vi_left_1[k] = wrap(u << 1);
    want->vi_left_16[k] = wrap(u << 16);
    want->vi_right_6[k] = (int32_t)floor(i / 64.0);
    want->vi_right_31[k] = i < 0 ? -1 : 0;
    want->vi_min[k] = i < j ? i : j;
    want->vi_max[k] = i > j ? i : j;
    want->vi_round[k] = nearest(in->small[k]);
    memcpy(&want->vi_bits_of[k], &in->a[k], sizeof(int32_t));
    want->vi_select[k] = want->vi_store_where[k] = in->m[k] ? i : j;
    want->vi_lt[k] = i < j;
    want->vi_eq[k] = i == j;
    want->vi_lt_where[k] = in->m[k] && i < j;
    want->vi_store_first[k] = (uint32_t)(k % want->lanes) < in->first[k - k % want->lanes] ? i : j;
    want->vi_stream[k] = i;
    const int32_t four[4] = {i, j, wrap(u + v), wrap(u - v)};
    memcpy(want->vi_store4 + 4 * k, four, sizeof four);
    want->vm_of[k] = in->m[k];
    want->vm_and[k] = in->m[k] && in->n[k];
    want->vm_or[k] = in->m[k] || in->n[k];
    want->vm_andnot[k] = in->m[k] && !in->n[k];
    for (int group = k - k % want->lanes, l = 0; l < want->lanes; l++)
        if (in->m[group + l]) want->vm_any[k] = 1;
}

/* Patches are of four columns where they have four words. */
static void want_patches(const struct simd_inputs *in, struct simd_results *want, int k)
{
    static const int later[3] = {1, 3, 4};
    const int lane = k % want->lanes, columns = want->lanes < 4 ? want->lanes : 4;
    const int row = lane / columns, column = lane % columns;
    for (int i = 0; i < 3; i++)
        want->vi_later[i][k] = lane < later[i] ? 0 : in->i[k - later[i]];
    want->vi_load_patch[k] = in->i[(k - lane) % SIMD_HALF + row * SIMD_STRIDE + column];
    for (int i = 0; i < want->lanes / columns; i++)
        want->vi_rows_of_patches[i][k] = in->i[(k - lane) % SIMD_HALF + i * SIMD_STRIDE + lane];
}

static int32_t pair_of(int32_t x, int32_t y)
{
    return wrap((uint32_t)x % 65536u + (uint32_t)y % 65536u * 65536u);
}

static int32_t in_units(int32_t value, double unit)
{
    return (int32_t)floor(value / unit);
}

static int32_t low_half(int32_t pair)
{
    const int32_t half = (int32_t)((uint32_t)pair % 65536u);
    return half < 32768 ? half : half - 65536;
}

static int32_t saturated(int32_t value)
{
    return value < -32768 ? -32768 : value > 32767 ? 32767 : value;
}

static void want_pairs(const struct simd_inputs *in, struct simd_results *want, int k)
{
    const int32_t p[2] = {low_half(in->p[k]), in_units(in->p[k], 65536.0)};
    const int32_t q[2] = {low_half(in->q[k]), in_units(in->q[k], 65536.0)};
    want->vp_add[k] = pair_of(p[0] + q[0], p[1] + q[1]);
    want->vp_sub[k] = pair_of(p[0] - q[0], p[1] - q[1]);
    want->vp_left_8[k] = pair_of(p[0] * 256, p[1] * 256);
    want->vp_right_8[k] = pair_of(in_units(p[0], 256.0), in_units(p[1], 256.0));
    want->vp_min[k] = pair_of(p[0] < q[0] ? p[0] : q[0], p[1] < q[1] ? p[1] : q[1]);
    want->vp_max[k] = pair_of(p[0] > q[0] ? p[0] : q[0], p[1] > q[1] ? p[1] : q[1]);
    want->vp_cross[k] = p[0] * q[1] - p[1] * q[0];
}

static void want_gathers(const struct simd_inputs *in, struct simd_results *want, int k)
{
    const int lane = k % want->lanes;
    want->vf_pick[k] = in->a[k - lane + (int)in->order[k] % want->lanes];
    if (in->m[k]) memcpy(&want->vi_gather[k], &in->places[in->order[k]], sizeof(int32_t));
    for (uint32_t c = 0; c < 3; c++)
        want->vf_gather_fours[c][k] = in->places[4 * in->corners[k] + c];
    for (int c = 0; c < 3; c++) {
        int32_t xy[2];
        memcpy(xy, in->places + 4 * in->corners[3 * k + c], sizeof xy);
        want->load_corners[0][c][k] = pair_of(xy[0] & 0xffff, xy[1] & 0xffff);
        want->load_corners[1][c][k] = pair_of(in_units(xy[0], 65536.0), in_units(xy[1], 65536.0));
        want->load_corners[2][c][k] = pair_of(saturated(in_units(xy[0], 32768.0)), saturated(in_units(xy[1], 32768.0)));
    }
    const int group = k - k % want->lanes;
    for (int l = 0, before = 0; l < want->lanes; before += in->m[group + l++])
        if (in->m[group + l]) {
            want->vi_listed[k] = ++want->vi_compressed[k];
            if (before != k - group) continue;
            want->vi_compress[k] = in->i[group + l];
            want->vi_list_bits[k] = (int32_t)in->order[group] + l;
        }
}

static void want_doubles(const struct simd_inputs *in, struct simd_results *want, int k)
{
    const double a = (double)in->a[k], b = (double)in->b[k];
    want->vd_set[k] = in->a[k - k % want->doubles];
    want->vd_min[k] = a < b ? in->a[k] : in->b[k];
    want->vd_max[k] = a > b ? in->a[k] : in->b[k];
    want->vd_sqrt[k] = (float)sqrt(a);
    want->vd_select_zero[k] = (float)(b == 0.0 ? a - b : a);
    want->vd_lost[k] = (float)(a * b - (double)(in->a[k] * in->b[k]));
    want->vd_div[k] = (float)((a + 1.0) / b);
    want->vd_store[k] = (float)(a - b);
    want->vd_gather[k] = (float)in->doubles[in->order[k]];
}

/* ---- the comparison ---- */

struct result {
    const char *name;
    size_t offset, count;
    bool any_nan; /* arithmetic: one NaN is as good as another */
};

#define RESULT(name, any_nan)                                                                                          \
    {                                                                                                                  \
#name, offsetof(struct simd_results, name), COUNT_OF(((struct simd_results *)0)->name), any_nan                \
    }
#define EXACT(name) RESULT(name, false)

static const struct result results[] = {EXACT(vf_set),
                                        EXACT(vf_load),
                                        EXACT(vf_ramp),
                                        RESULT(vf_add, true),
                                        RESULT(vf_sub, true),
                                        RESULT(vf_mul, true),
                                        RESULT(vf_div, true),
                                        EXACT(vf_min),
                                        EXACT(vf_max),
                                        EXACT(vf_abs),
                                        RESULT(vf_sqrt, true),
                                        EXACT(vf_of),
                                        EXACT(vf_select),
                                        EXACT(vf_lt),
                                        EXACT(vf_le),
                                        EXACT(vf_eq),
                                        EXACT(vi_set),
                                        EXACT(vi_ramp),
                                        EXACT(vi_add),
                                        EXACT(vi_sub),
                                        EXACT(vi_mul),
                                        EXACT(vi_and),
                                        EXACT(vi_or),
                                        EXACT(vi_xor),
                                        EXACT(vi_left_1),
                                        EXACT(vi_left_16),
                                        EXACT(vi_right_6),
                                        EXACT(vi_right_31),
                                        EXACT(vi_min),
                                        EXACT(vi_max),
                                        EXACT(vi_round),
                                        EXACT(vi_bits_of),
                                        EXACT(vi_select),
                                        EXACT(vi_lt),
                                        EXACT(vi_eq),
                                        EXACT(vm_and),
                                        EXACT(vm_or),
                                        EXACT(vm_andnot),
                                        EXACT(vm_of),
                                        EXACT(vm_any),
                                        EXACT(load4[0]),
                                        EXACT(load4[1]),
                                        EXACT(load4[2]),
                                        EXACT(load4[3]),
                                        EXACT(vf_store4),
                                        EXACT(vf_store_fours),
                                        EXACT(vf_stream_fours),
                                        EXACT(strayed),
                                        RESULT(vd_set, true),
                                        RESULT(vd_min, true),
                                        RESULT(vd_max, true),
                                        RESULT(vd_sqrt, true),
                                        RESULT(vd_select_zero, true),
                                        RESULT(vd_lost, true),
                                        RESULT(vd_div, true),
                                        RESULT(vd_store, true),
                                        RESULT(vd_gather, true),
                                        EXACT(vf_lt_where),
                                        EXACT(vf_eq_where),
                                        EXACT(vi_lt_where),
                                        EXACT(vi_store_first),
                                        EXACT(vi_store_where),
                                        EXACT(vf_bits),
                                        EXACT(vi_stream),
                                        EXACT(vi_store4),
                                        EXACT(vi_later[0]),
                                        EXACT(vi_later[1]),
                                        EXACT(vi_later[2]),
                                        EXACT(vi_load_patch),
                                        EXACT(vi_rows_of_patches),
                                        EXACT(vi_gather),
                                        EXACT(vf_gather_fours[0]),
                                        EXACT(vf_gather_fours[1]),
                                        EXACT(vf_gather_fours[2]),
                                        EXACT(vf_pick),
                                        EXACT(vi_compress),
                                        EXACT(vi_compressed),
                                        EXACT(vi_list_bits),
                                        EXACT(vi_listed),
                                        EXACT(load_corners[0][0]),
                                        EXACT(load_corners[0][1]),
                                        EXACT(load_corners[0][2]),
                                        EXACT(load_corners[1][0]),
                                        EXACT(load_corners[1][1]),
                                        EXACT(load_corners[1][2]),
                                        EXACT(load_corners[2][0]),
                                        EXACT(load_corners[2][1]),
                                        EXACT(load_corners[2][2]),
                                        EXACT(vp_add),
                                        EXACT(vp_sub),
                                        EXACT(vp_left_8),
                                        EXACT(vp_right_8),
                                        EXACT(vp_min),
                                        EXACT(vp_max),
                                        EXACT(vp_cross)};

static uint32_t word_at(const struct simd_results *all, const struct result *result, size_t k)
{
    uint32_t bits;
    memcpy(&bits, (const char *)all + result->offset + 4 * k, sizeof bits);
    return bits;
}

static bool is_same(const struct result *result, uint32_t got, uint32_t want)
{
    return got == want || (result->any_nan && isnan(float_of(got)) && isnan(float_of(want)));
}

bool simd_check(enum zr_isa isa, uint64_t seed, char *message, size_t size)
{
    static struct simd_inputs in;
    static struct simd_results got, want;
    struct random random = random_seeded(seed);
    make_inputs(&random, &in);
    memset(&got, 0x55, sizeof got);
    memset(got.strayed, 0, sizeof got.strayed);
    memset(got.vi_rows_of_patches, 0, sizeof got.vi_rows_of_patches);
    memset(&want, 0, sizeof want);
    simd_run_of(isa)(&in, &got);
    want.lanes = got.lanes;
    want.doubles = got.doubles;
    for (int k = 0; k < SIMD_COUNT; k++) {
        want_floats(&in, &want, k);
        want_ints(&in, &want, k);
        want_pairs(&in, &want, k);
        want_gathers(&in, &want, k);
        want_patches(&in, &want, k);
        want_doubles(&in, &want, k);
    }
    for (size_t r = 0; r < COUNT_OF(results); r++)
        for (size_t k = 0; k < results[r].count; k++) {
            uint32_t g = word_at(&got, &results[r], k), w = word_at(&want, &results[r], k);
            if (is_same(&results[r], g, w)) continue;
            size_t o = k % SIMD_COUNT;
            snprintf(message, size, "%s: %s gives %08x, not %08x, of a %a, b %a, small %a, i %d, j %d, m %d, n %d",
                     zr_isa_name(isa), results[r].name, g, w, (double)in.a[o], (double)in.b[o], (double)in.small[o],
                     in.i[o], in.j[o], in.m[o], in.n[o]);
            return false;
        }
    return true;
}
