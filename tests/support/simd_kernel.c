#include "support/simd_kernel.h"

#include "base/simd/simd.h"

_Static_assert(SIMD_COUNT % ZR_LANES == 0, "nothing is left of the last group");

static zr_vm mask_of(const int32_t *truths)
{
    uint32_t bits = 0;
    for (int i = 0; i < ZR_LANES; i++)
        bits |= (uint32_t)truths[i] << i;
    return zr_vm_of(bits);
}

static void keep(zr_vm m, int32_t *truths)
{
    uint32_t bits = zr_vm_bits(m);
    for (int i = 0; i < ZR_LANES; i++)
        truths[i] = (int32_t)(bits >> i & 1u);
    if (bits & ~(uint32_t)ZR_ALL_BITS) truths[0] = -1; /* of lanes that there are not */
}

static void run_floats(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vf a = zr_vf_load(in->a + k), b = zr_vf_load(in->b + k);
    zr_vf_store(out->vf_set + k, zr_vf_set(in->a[k]));
    zr_vf_store(out->vf_load + k, a);
    zr_vf_store(out->vf_ramp + k, zr_vf_ramp());
    zr_vf_store(out->vf_add + k, a + b);
    zr_vf_store(out->vf_sub + k, a - b);
    zr_vf_store(out->vf_mul + k, a * b);
    zr_vf_store(out->vf_div + k, a / b);
    zr_vf_store(out->vf_min + k, zr_vf_min(a, b));
    zr_vf_store(out->vf_max + k, zr_vf_max(a, b));
    zr_vf_store(out->vf_abs + k, zr_vf_abs(a));
    zr_vf_store(out->vf_sqrt + k, zr_vf_sqrt(a));
    zr_vf_store(out->vf_of + k, zr_vf_of(zr_vi_load(in->i + k)));
    zr_vf_store(out->vf_select + k, zr_vf_select(mask_of(in->m + k), a, b));
    keep(zr_vf_lt(a, b), out->vf_lt + k);
    keep(zr_vf_le(a, b), out->vf_le + k);
    keep(zr_vf_eq(a, b), out->vf_eq + k);
    keep(zr_vf_lt_where(mask_of(in->m + k), a, b), out->vf_lt_where + k);
    keep(zr_vf_eq_where(mask_of(in->m + k), a, b), out->vf_eq_where + k);
    zr_vf_store(out->vf_bits + k, zr_vf_bits(zr_vi_load(in->i + k)));
}

static void run_ints(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vi i = zr_vi_load(in->i + k), j = zr_vi_load(in->j + k);
    zr_vi_store(out->vi_set + k, zr_vi_set(in->i[k]));
    zr_vi_store(out->vi_ramp + k, zr_vi_ramp());
    zr_vi_store(out->vi_add + k, i + j);
    zr_vi_store(out->vi_sub + k, i - j);
    zr_vi_store(out->vi_mul + k, i * j);
    zr_vi_store(out->vi_and + k, i & j);
    zr_vi_store(out->vi_or + k, i | j);
    zr_vi_store(out->vi_xor + k, i ^ j);
    zr_vi_store(out->vi_left_1 + k, i << 1);
    zr_vi_store(out->vi_left_16 + k, i << 16);
    zr_vi_store(out->vi_right_6 + k, i >> 6);
    zr_vi_store(out->vi_right_31 + k, i >> 31);
    zr_vi_store(out->vi_min + k, zr_vi_min(i, j));
    zr_vi_store(out->vi_max + k, zr_vi_max(i, j));
    zr_vi_store(out->vi_round + k, zr_vi_round(zr_vf_load(in->small + k)));
    zr_vi_store(out->vi_bits_of + k, zr_vi_bits_of(zr_vf_load(in->a + k)));
    zr_vi_store(out->vi_select + k, zr_vi_select(mask_of(in->m + k), i, j));
    zr_vi_store(out->vi_store_where + k, j);
    zr_vi_store_where(out->vi_store_where + k, mask_of(in->m + k), i);
    keep(zr_vi_lt(i, j), out->vi_lt + k);
    keep(zr_vi_eq(i, j), out->vi_eq + k);
    keep(zr_vi_lt_where(mask_of(in->m + k), i, j), out->vi_lt_where + k);
    zr_vi_stream(out->vi_stream + k, i);
    zr_vi_store4(out->vi_store4 + 4 * k, i, j, i + j, i - j);
}

static void run_masks(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vm m = mask_of(in->m + k), n = mask_of(in->n + k);
    keep(m, out->vm_of + k);
    keep(zr_vm_and(m, n), out->vm_and + k);
    keep(zr_vm_or(m, n), out->vm_or + k);
    keep(zr_vm_andnot(m, n), out->vm_andnot + k);
    keep(zr_vm_any(m) ? ZR_ALL_LANES : zr_vm_of(0), out->vm_any + k);
}

/* Stores into the middle of three vectors; the others must not change. */
static void run_store_first(const struct simd_inputs *in, struct simd_results *out, int k)
{
    enum { BYTES = 4 * ZR_LANES };
    int32_t ints[3 * ZR_LANES];
    for (int i = 0; i < 3; i++)
        memcpy(ints + i * ZR_LANES, in->j + k, BYTES);
    zr_vi_store_first(ints + ZR_LANES, zr_vi_load(in->i + k), in->first[k] < ZR_LANES ? in->first[k] : ZR_LANES);
    memcpy(out->vi_store_first + k, ints + ZR_LANES, BYTES);
    out->strayed[k] = memcmp(ints, in->j + k, BYTES) != 0 || memcmp(ints + 2 * ZR_LANES, in->j + k, BYTES) != 0;
}

static void run_places(const struct simd_inputs *in, struct simd_results *out, int k)
{
    zr_vf x, y, z, w;
#define PLACE(i) (in->places + SIMD_APART * in->order[k + (i)])
    ZR_LOAD4(x, y, z, w, PLACE);
    zr_vf_store(out->load4[0] + k, x);
    zr_vf_store(out->load4[1] + k, y);
    zr_vf_store(out->load4[2] + k, z);
    zr_vf_store(out->load4[3] + k, w);
    zr_vf_store4(out->vf_store4 + 4 * k, x, y, z, w);
#undef PLACE
    zr_vf_load_fours(in->places + 4 * k + 1, &x, &y, &z, &w);
    const zr_vf mixed = zr_vf_bits(zr_vi_bits_of(x) ^ zr_vi_bits_of(w));
    zr_vf_store_fours(out->vf_store_fours + 4 * k, mixed, y, z, w);
    zr_vf_stream_fours(out->vf_stream_fours + 4 * k, mixed, y, z, w);
}

static void run_patches(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vi i = zr_vi_load(in->i + k), lane = zr_vi_ramp();
    zr_vi_store(out->vi_later[0] + k, zr_vi_select(zr_vi_lt(lane, zr_vi_set(1)), zr_vi_set(0), zr_vi_later(i, 1)));
    zr_vi_store(out->vi_later[1] + k, zr_vi_select(zr_vi_lt(lane, zr_vi_set(3)), zr_vi_set(0), zr_vi_later(i, 3)));
    zr_vi_store(out->vi_later[2] + k, zr_vi_select(zr_vi_lt(lane, zr_vi_set(4)), zr_vi_set(0), zr_vi_later(i, 4)));
    zr_vi_store(out->vi_load_patch + k, zr_vi_load_patch((const uint32_t *)in->i + k % SIMD_HALF, SIMD_STRIDE));
    zr_vi patches[ZR_PATCH_ROWS];
    for (int p = 0; p < ZR_PATCH_ROWS; p++)
        patches[p] = zr_vi_load_patch((const uint32_t *)in->i + k % SIMD_HALF + p * ZR_PATCH_COLUMNS, SIMD_STRIDE);
    zr_vi_rows_of_patches(patches);
    for (int row = 0; row < ZR_PATCH_ROWS; row++)
        zr_vi_store(out->vi_rows_of_patches[row] + k, patches[row]);
}

static void run_gathers(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vm m = mask_of(in->m + k);
    const zr_vi none = zr_vi_set(0), nowhere = zr_vi_set(INT32_MIN); /* far from everything: not to be read */
    zr_vf low[3], high[3];
    zr_vi_store(
        out->vi_gather + k,
        zr_vi_select(m, zr_vi_gather(m, in->places, zr_vi_select(m, zr_vi_load(in->order + k), nowhere)), none));
    zr_vf xyz[3];
    zr_vf_gather_fours(in->places, zr_vi_load(in->corners + k), &xyz[0], &xyz[1], &xyz[2]);
    for (int c = 0; c < 3; c++)
        zr_vf_store(out->vf_gather_fours[c] + k, xyz[c]);
    zr_vf_store(out->vf_pick + k,
                zr_vf_pick(zr_vf_load(in->a + k), zr_vi_load(in->order + k) & zr_vi_set(ZR_LANES - 1)));
    zr_load_corners(in->places, in->corners + 3 * k, low, high);
    for (int c = 0; c < 3; c++) {
        const zr_vi a = zr_vi_bits_of(low[c]), b = zr_vi_bits_of(high[c]);
        zr_vi_store(out->load_corners[0][c] + k, (zr_vi)zr_vp_pack(a << 16 >> 16, b << 16 >> 16));
        zr_vi_store(out->load_corners[1][c] + k, (zr_vi)zr_vp_pack(a >> 16, b >> 16));
        zr_vi_store(out->load_corners[2][c] + k, (zr_vi)zr_vp_pack(a >> 15, b >> 15));
    }
    int32_t room[2 * ZR_LANES];
    zr_vi_store(room + ZR_LANES, zr_vi_load(in->j + k));
    uint32_t count = zr_vi_compress(room, m, zr_vi_load(in->i + k));
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        out->vi_compress[(uint32_t)k + i] = i < count ? room[i] : 0;
        out->vi_compressed[(uint32_t)k + i] = (int32_t)count;
    }
    out->strayed[k] |= memcmp(room + ZR_LANES, in->j + k, 4 * ZR_LANES) != 0;
    count = zr_vi_list_bits(room, zr_vm_bits(m), (int32_t)in->order[k]);
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        out->vi_list_bits[(uint32_t)k + i] = i < count ? room[i] : 0;
        out->vi_listed[(uint32_t)k + i] = (int32_t)count;
    }
    out->strayed[k] |= memcmp(room + ZR_LANES, in->j + k, 4 * ZR_LANES) != 0;
}

static void run_pairs(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vp p = (zr_vp)zr_vi_load(in->p + k), q = (zr_vp)zr_vi_load(in->q + k);
    zr_vi_store(out->vp_add + k, (zr_vi)(p + q));
    zr_vi_store(out->vp_sub + k, (zr_vi)(p - q));
    zr_vi_store(out->vp_left_8 + k, (zr_vi)(p << 8));
    zr_vi_store(out->vp_right_8 + k, (zr_vi)(p >> 8));
    zr_vi_store(out->vp_min + k, (zr_vi)zr_vp_min(p, q));
    zr_vi_store(out->vp_max + k, (zr_vi)zr_vp_max(p, q));
    zr_vi_store(out->vp_cross + k, zr_vp_cross(p, q));
}

static void run_doubles(const struct simd_inputs *in, struct simd_results *out, int k)
{
    const zr_vd a = zr_vd_widen(in->a + k), b = zr_vd_widen(in->b + k);
    float products[ZR_DOUBLES];
    double stored[ZR_DOUBLES];
    for (int i = 0; i < ZR_DOUBLES; i++)
        products[i] = in->a[k + i] * in->b[k + i];
    zr_vd_store(stored, a - b);
    for (int i = 0; i < ZR_DOUBLES; i++)
        out->vd_store[k + i] = (float)stored[i];
    zr_vd_narrow(out->vd_set + k, zr_vd_set((double)in->a[k]));
    zr_vd_narrow(out->vd_min + k, zr_vd_min(a, b));
    zr_vd_narrow(out->vd_max + k, zr_vd_max(a, b));
    zr_vd_narrow(out->vd_sqrt + k, zr_vd_sqrt(a));
    zr_vd_narrow(out->vd_select_zero + k, zr_vd_select_zero(b, a - b, a));
    zr_vd_narrow(out->vd_lost + k, a * b - zr_vd_widen(products));
    zr_vd_narrow(out->vd_div + k, (a + zr_vd_set(1.0)) / b);
    zr_vd_narrow(out->vd_gather + k, zr_vd_gather(in->doubles, (const int32_t *)in->order + k));
}

void ZR_KERNEL(simd_run)(const struct simd_inputs *in, struct simd_results *out)
{
    out->lanes = ZR_LANES;
    out->doubles = ZR_DOUBLES;
    for (int k = 0; k < SIMD_COUNT; k += ZR_LANES) {
        run_floats(in, out, k);
        run_ints(in, out, k);
        run_masks(in, out, k);
        run_store_first(in, out, k);
        run_places(in, out, k);
        run_patches(in, out, k);
        run_gathers(in, out, k);
        run_pairs(in, out, k);
    }
    for (int k = 0; k < SIMD_COUNT; k += ZR_DOUBLES)
        run_doubles(in, out, k);
}
