/* fast.h - base: fast ways, special cases beside the general way that give the same bytes sooner.
 *
 *     if (ZR_FAST(packed_colors, zr_colors_can_be_packed(scene, mesh))) ...
 *
 * is that condition in every build but `make MUTANTS=1` (mutant.h), whose programs may switch fast ways off and count
 * how often each was taken. tests/reference/fast.txt has a case for each: with it on it must run, with it off the same
 * pictures must be equal to the reference's. What one earns is measured against a build without it:
 *
 *     make BUILD=build/without CPPFLAGS=-DZR_WITHOUT=stamps build/without/zraster-bench build/without/zrasterd
 *     make bench ARGS='--against build/without'
 *
 * One stays only if it earns a tenth of the time of something that users meet.
 */
#ifndef ZR_FAST_H
#define ZR_FAST_H

#include <stdbool.h>
#include <stdint.h>

/* What time is lost where it is not taken: on a Zen 5 with AVX-512, each against the build with all of them. */
/* clang-format off */
#define ZR_EACH_FAST(row)                                                                                             \
    /* geometry: a mesh that is wholly in view is one draw, its faces not looked at: bunny 512x512 +2..11 % */        \
    row(whole_meshes)                                                                                                 \
    /* raster: tiny triangles are drawn as they are sorted: 1.1 M triangles +60..88 % */                              \
    row(tiny_fragments)                                                                                               \
    /* raster: small triangles sample by sample, many at once: bunny 512x512 flat +12..14 % */                        \
    row(stamps)                                                                                                       \
    /* raster: blocks that are nearer already are passed over: 80 000 polygons +65..98 % */                           \
    row(hidden_blocks)                                                                                                \
    /* raster: blocks that a triangle has alone are not written: cube +66..99 %, fills +61..75 % */                   \
    row(owned_blocks)                                                                                                 \
    /* raster: large triangles by depth, until the rest is hidden: fill front to back +430 % */                       \
    row(nearest_first)                                                                                                \
    /* shade: tiny and small triangles in colour as they are drawn: bunny 512x512 Gouraud +37 % */                    \
    row(early_words)                                                                                                  \
    /* shade: the colours that the mesh has, not copied: 16 bytes a vertex, and no time */                            \
    row(given_colors)                                                                                                 \
    /* shade: meshes in one colour are lit without telling faces apart: lit million +16 % */                          \
    row(alike_points)                                                                                                 \
    /* shade: flat colours are made as bytes: lit flat bunny 1080p +77 %, once */                                     \
    row(packed_colors)                                                                                                \
    /* shade: few flat colours are packed for many pixels: bunny 1080p flat +11..16 % */                              \
    row(packed_later)                                                                                                 \
    /* shade: which flat triangles show backs is noted while sorted: lit flat +44..75 % */                            \
    row(noted_backs)                                                                                                  \
    /* shade: frames are written by non-temporal stores: 1080p +18..28 %, fills +33..75 % */                                          \
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

/* Switches one off. Not while another thread renders. False where this build has no such switch. */
bool zr_fast_forbid(const char *name);

/* The name of the fast way of that number, from 0 on, and how often it was taken; NULL: this build has no more. */
const char *zr_fast_name(int number, uint64_t *taken);

#endif
