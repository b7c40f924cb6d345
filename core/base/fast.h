/* fast.h - base: fast paths, which give the same bytes as the general path in less time.
 *
 *     if (ZR_FAST(packed_colors, zr_colors_can_be_packed(scene, mesh))) ...
 *
 * ZR_FAST(name, condition) is the condition. In a build with `make MUTANTS=1` (mutant.h), programs can switch a fast
 * path off and count its uses. tests/reference/fast.txt has a case for each fast path: the path must be taken, and the
 * pictures must equal the reference's with the path on and off. This measures the time that one saves:
 *
 *     make BUILD=build/without CPPFLAGS=-DZR_WITHOUT=stamps build/without/zraster-bench build/without/zrasterd
 *     make bench ARGS='--against build/without'
 *
 * A fast path stays only if it saves a tenth of the time of a picture that users ask for.
 */
#ifndef ZR_FAST_H
#define ZR_FAST_H

#include <stdbool.h>
#include <stdint.h>

/* Percent: additional time without it, on a Zen 5 with AVX-512, all others on. */
/* clang-format off */
#define ZR_EACH_FAST(row)                                                                                             \
    /* geometry: a mesh inside the view volume is one draw, without tests of its faces: bunny 512x512 +2..11 % */    \
    row(whole_meshes)                                                                                                 \
    /* raster: tiny triangles are drawn while they are binned: 1.1 M triangles +60..88 % */                           \
    row(tiny_fragments)                                                                                               \
    /* raster: small triangles are drawn sample by sample, one per lane: bunny 512x512 flat +12..14 % */              \
    row(stamps)                                                                                                       \
    /* raster: blocks whose pixels are all nearer are skipped: 80 000 polygons +65..98 % */                           \
    row(hidden_blocks)                                                                                                \
    /* raster: a block that one triangle covers stores its owner alone: cube +66..99 %, fills +61..75 % */            \
    row(owned_blocks)                                                                                                 \
    /* raster: large triangles are drawn nearest first, until the rest is hidden: fill front to back +430 % */        \
    row(nearest_first)                                                                                                \
    /* shade: tiny and small triangles are shaded while they are drawn: bunny 512x512 Gouraud +37 % */                \
    row(early_words)                                                                                                  \
    /* shade: given vertex colours are not copied: 16 bytes per vertex, no time */                                    \
    row(given_colors)                                                                                                 \
    /* shade: meshes of one colour are lit without tests of each face: lit million +16 % */                          \
    row(alike_points)                                                                                                 \
    /* shade: flat colours are converted to bytes once per face: lit flat bunny 1080p +77 % */                        \
    row(packed_colors)                                                                                                \
    /* shade: colours are packed if many pixels share few of them: bunny 1080p flat +11..16 % */                      \
    row(packed_later)                                                                                                 \
    /* shade: binning records which flat triangles show their back: lit flat +44..75 % */                             \
    row(noted_backs)                                                                                                  \
    /* shade: frames are written by non-temporal stores: 1080p +18..28 %, fills +33..75 % */                          \
    row(streamed)
/* clang-format on */

#define ZR_FAST_ITEM(name) ZR_FAST_##name,
enum zr_fast { ZR_EACH_FAST(ZR_FAST_ITEM) ZR_FAST_COUNT };
#define ZR_FAST_OF(name)    ZR_FAST_NAMED(name)
#define ZR_FAST_NAMED(name) ZR_FAST_##name

#ifdef ZR_MUTANTS
bool zr_fast_take(enum zr_fast fast);
#define ZR_FAST(name, condition) ((condition) && zr_fast_take(ZR_FAST_##name))
#elif defined ZR_WITHOUT
#define ZR_FAST(name, condition) ((condition) && ZR_FAST_##name != ZR_FAST_OF(ZR_WITHOUT))
#else
#define ZR_FAST(name, condition) (condition)
#endif

/* Switches a fast path off. No thread may render meanwhile. False if this build has no switch of that name. */
bool zr_fast_forbid(const char *name);

/* The name of fast path `number`, from 0 on, and its uses so far; NULL if there is none. */
const char *zr_fast_name(int number, uint64_t *taken);

#endif
