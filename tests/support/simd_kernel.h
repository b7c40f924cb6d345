/* simd_kernel.h - support: every operation of base/simd/simd.h on arrays, compiled for each instruction set as kernels
 * are.
 *
 * Element k of each result is the operation on element k of its operands.
 */
#ifndef ZR_TEST_SIMD_KERNEL_H
#define ZR_TEST_SIMD_KERNEL_H

#include <stdint.h>

#include "base/isa.h"

enum { SIMD_COUNT = 2048, SIMD_APART = 5, SIMD_HALF = SIMD_COUNT / 2, SIMD_STRIDE = 19 };

/* The first word misaligns all arrays, since operations must not need alignment. */
struct simd_inputs {
    _Alignas(64) uint32_t out_of_line;
    float a[SIMD_COUNT], b[SIMD_COUNT];
    float small[SIMD_COUNT]; /* below 2^22 in magnitude */
    int32_t i[SIMD_COUNT], j[SIMD_COUNT];
    int32_t m[SIMD_COUNT], n[SIMD_COUNT]; /* masks: 0 or 1 */
    uint32_t order[SIMD_COUNT];           /* 0 .. SIMD_COUNT - 1, indices of places */
    uint32_t first[SIMD_COUNT];           /* 0 .. 16: lane 0 of a vector holds its value, cut to ZR_LANES */
    float places[SIMD_COUNT * SIMD_APART];
    uint32_t corners[3 * SIMD_COUNT];     /* 0 .. SIMD_COUNT - 1, indices of fours of places */
    int32_t p[SIMD_COUNT], q[SIMD_COUNT]; /* pairs; no half is -32768 */
    double doubles[SIMD_COUNT];
};

/* Results of four bytes each, listed in a table of simd_check.c. */
struct simd_results {
    _Alignas(64) uint32_t out_of_line;
    float vf_set[SIMD_COUNT], vf_load[SIMD_COUNT], vf_ramp[SIMD_COUNT]; /* set: lane 0 of a, all over its vector */
    float vf_add[SIMD_COUNT], vf_sub[SIMD_COUNT], vf_mul[SIMD_COUNT], vf_div[SIMD_COUNT];
    float vf_min[SIMD_COUNT], vf_max[SIMD_COUNT], vf_abs[SIMD_COUNT], vf_sqrt[SIMD_COUNT], vf_of[SIMD_COUNT];
    float vf_select[SIMD_COUNT]; /* a where m, else b */
    int32_t vf_lt[SIMD_COUNT], vf_le[SIMD_COUNT], vf_eq[SIMD_COUNT];
    int32_t vf_lt_where[SIMD_COUNT], vf_eq_where[SIMD_COUNT], vi_lt_where[SIMD_COUNT]; /* m */
    int32_t vi_set[SIMD_COUNT], vi_ramp[SIMD_COUNT];
    int32_t vi_add[SIMD_COUNT], vi_sub[SIMD_COUNT], vi_mul[SIMD_COUNT];
    int32_t vi_and[SIMD_COUNT], vi_or[SIMD_COUNT], vi_xor[SIMD_COUNT];
    int32_t vi_left_1[SIMD_COUNT], vi_left_16[SIMD_COUNT], vi_right_6[SIMD_COUNT], vi_right_31[SIMD_COUNT];
    int32_t vi_min[SIMD_COUNT], vi_max[SIMD_COUNT], vi_round[SIMD_COUNT], vi_bits_of[SIMD_COUNT];
    int32_t vi_select[SIMD_COUNT], vi_store_first[SIMD_COUNT], vi_store_where[SIMD_COUNT]; /* i, else j */
    float vf_bits[SIMD_COUNT];                                                             /* of i */
    _Alignas(64) int32_t vi_stream[SIMD_COUNT];
    int32_t vi_lt[SIMD_COUNT], vi_eq[SIMD_COUNT];
    int32_t vm_and[SIMD_COUNT], vm_or[SIMD_COUNT], vm_andnot[SIMD_COUNT], vm_of[SIMD_COUNT]; /* of m and n; of m */
    int32_t vm_any[SIMD_COUNT];                                                              /* of the vector's m */
    float load4[4][SIMD_COUNT];
    float vf_store4[4 * SIMD_COUNT];                    /* what load4 loaded */
    _Alignas(64) float vf_stream_fours[4 * SIMD_COUNT]; /* places from 4 k + 1 on, bits of x exclusively or w's */
    float vf_store_fours[4 * SIMD_COUNT];               /* the same */
    int32_t vi_store4[4 * SIMD_COUNT];                  /* i, j, i + j, i - j */
    int32_t load_corners[3][3][SIMD_COUNT]; /* pairs of bits 0 .. 15, 16 .. 31, and 15 .. 31, which saturate */
    int32_t vp_add[SIMD_COUNT], vp_sub[SIMD_COUNT], vp_left_8[SIMD_COUNT], vp_right_8[SIMD_COUNT];
    int32_t vp_min[SIMD_COUNT], vp_max[SIMD_COUNT], vp_cross[SIMD_COUNT]; /* of p and q */
    int32_t vi_later[3][SIMD_COUNT];                                      /* i, 1, 3 and 4 lanes later; 0 before that */
    int32_t vi_load_patch[SIMD_COUNT];                                    /* of i, from k modulo SIMD_HALF on */
    int32_t vi_rows_of_patches[4][SIMD_COUNT];                            /* rows of i, from there on */
    float vf_gather_fours[3][SIMD_COUNT]; /* x, y, z of fours of places, by the first of corners */
    int32_t vi_gather[SIMD_COUNT];        /* places[order], 0 where not m */
    float vf_pick[SIMD_COUNT];            /* a, of lane order % lanes of the same vector */
    int32_t vi_compress[SIMD_COUNT];      /* of i and m; 0 in a vector's lanes behind those */
    int32_t vi_compressed[SIMD_COUNT];    /* how many */
    int32_t vi_list_bits[SIMD_COUNT];     /* of m, from order of a vector's lane 0 on; 0 behind those */
    int32_t vi_listed[SIMD_COUNT];
    /* In double, as floats. lost: what a product of floats would lose. set: lane 0 of all ZR_DOUBLES. */
    float vd_sqrt[SIMD_COUNT], vd_select_zero[SIMD_COUNT];
    float vd_set[SIMD_COUNT], vd_min[SIMD_COUNT], vd_max[SIMD_COUNT], vd_lost[SIMD_COUNT], vd_div[SIMD_COUNT];
    float vd_store[SIMD_COUNT], vd_gather[SIMD_COUNT]; /* doubles[order] */
    int32_t strayed[SIMD_COUNT];                       /* not 0: a store_first wrote beside its lanes */
    int32_t lanes, doubles;
};

typedef void simd_run_fn(const struct simd_inputs *in, struct simd_results *out);

ZR_KERNEL_TABLE(simd_run_fn, simd_run)

#endif
