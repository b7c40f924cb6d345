/* mutant.h - base: mutants, which break a rule on purpose, to prove that tests find the fault.
 *
 *     return ZR_MUTANT(older_mesa, half_to_even(v), half_away(v));
 *
 * is half_to_even(v). In a build with `make MUTANTS=1`, programs can switch to half_away(v) while they run; `make
 * tests` puts this build into build/mutant, with the machine's own instruction set alone. Every build compiles both
 * expressions. A rule that the code applies at several places has its mutant at each of them.
 *
 * To add a mutant, add its name to the list below, and a row to tests/reference/mutants.txt with the differences that
 * it must make. Its folder of core is in `mutant_rooms` of the Makefile.
 */
#ifndef ZR_MUTANT_H
#define ZR_MUTANT_H

#include <stdbool.h>
#include <stdint.h>

/* The wrong rule in short, with its number in tests/reference/RULES.md. */
/* clang-format off */
#define ZR_EACH_MUTANT(row)                                                                                           \
    row(sums_from_the_right)        /* 1, 4-term sums */                                                              \
    row(product_less_a_term)        /* 1, P M */                                                                      \
    row(guard_band)                 /* 2 */                                                                           \
    row(one_outside_rejects)        /* 2 */                                                                           \
    row(clipped_from_inside)        /* 3, which end is interpolated from */                                           \
    row(near_plane_first)           /* 3, order of planes */                                                          \
    row(nine_corners)               /* 3, room */                                                                     \
    row(fused)                      /* 3, multiply-add without rounding in between */                                 \
    row(divided_by_w)               /* 4 */                                                                           \
    row(coarse_grid)                /* 5, 4 bits */                                                                   \
    row(ties_up)                    /* 5, not to even */                                                              \
    row(swaps_corner_2)             /* 6 */                                                                           \
    row(areas_in_32_bits)           /* 6 */                                                                           \
    row(top_edges_kept)             /* 7, instead of bottom ones */                                                   \
    row(all_edges_kept)             /* 7 */                                                                           \
    row(planes_from_the_grid)       /* 8, snapped corners */                                                          \
    row(depth_below_0)              /* 8, not clamped */                                                              \
    row(later_wins_ties)            /* 8, of equal depths */                                                          \
    row(farther_wins)               /* 8 */                                                                           \
    row(colors_over_no_w)           /* 9, not divided by 1/w */                                                       \
    row(bytes_rounded_down)         /* 9 */                                                                           \
    row(fans_from_the_first)        /* 10 */                                                                          \
    row(culls_fronts)               /* 11 */                                                                          \
    row(older_mesa)                 /* 12, 21, 28, lines, fog and points of Mesa 22.3 */                              \
    row(no_diamonds)                /* 12, ends that do not move */                                                   \
    row(line_depth_along)           /* 12, planes */                                                                  \
    row(line_ends_clipped_apart)    /* 13 */                                                                          \
    row(outlines_turned)            /* 14 */                                                                          \
    row(outlines_of_the_fan)        /* 14 */                                                                          \
    row(outlines_of_backs)          /* 14 */                                                                          \
    row(no_depth_offset)            /* 15 */                                                                          \
    row(layers_front_first)         /* 30, blended from the nearest to the farthest */                                \
    row(layers_hidden_at_equal)     /* 30, blended faces at the depth of opaque ones */                                  \
    row(xray_cubed)                 /* 30, opacities of x-rays */                                                     \
    row(right_edges_inside)         /* odd-even rule */                                                               \
    row(holes_filled)               /* odd-even rule */                                                               \
    row(last_triangle_decides)      /* odd-even rule: depth */                                                        \
    row(corners_behind_divided)     /* which faces are convex */                                                      \
    row(ids_of_the_first_instance)  /* owner of a pixel */                                                            \
    row(lit_beyond_1)               /* 16, vertices' colours not clamped before they are cut */                       \
    row(lit_from_behind)            /* 16, surfaces that face away from a light are lit, too */                       \
    row(half_not_unit)              /* highlights: the half vector is not normalised */                               \
    row(backs_keep_normals)         /* shading per pixel: backs have the normals of fronts */                         \
    row(falls_off_by_distance)      /* 29, not by its square */                                                       \
    row(range_of_2nd_power)         /* 29, the window of a range */                                                   \
    row(cone_not_squared)           /* 29, of spots */                                                                \
    row(fog_turned)                 /* 21: far is clear, and near is not */                                           \
    row(distance_is_depth)          /* channels: not the length of the ray */                                         \
    row(positions_of_the_camera)    /* channels: camera space, for every requested space */                           \
    row(shares_of_turned_corners)   /* channels: the corners that rule 6 exchanges are not exchanged back */          \
    row(instances_from_0)           /* channels: the first instance has the clear value */                            \
    row(samples_rounded_down)       /* samples, not half up */                                                        \
    row(samples_not_by_opacity)     /* samples: transparent ones weigh as much as opaque ones */                      \
    row(wide_lines_off_middle)      /* 12, their first side is as far from the middle as that of a line of width 1 */ \
    row(line_width_rounded_early)   /* 22, before the scaling to samples */                                           \
    row(point_sizes_half_up)        /* 28 */                                                                          \
    row(even_points_lean)           /* 28, to the corner below them on the left */                                    \
    row(points_cut_by_depth_alone)  /* 28, whose middle is beside the window */                                       \
    row(colors_not_decoded)         /* 23, colours are lit without decoding to linear light */                        \
    row(gradient_turned)            /* 23, backgrounds */                                                             \
    row(joins_to_20_degrees)        /* 23a */                                                                         \
    row(joined_keep_first_values)   /* 23a, no mean */                                                                \
    row(primitives_at_middle)       /* 23a, values at the middle of the pixel */                                      \
    row(steep_at_middle)            /* 23b, opacity at the middle alone */                                            \
    row(shares_by_surfaces)         /* 23a, not by samples */                                                         \
    row(hemisphere_turned)          /* 24, the sky is below */                                                        \
    row(gooch_linear)               /* 24, no power of 1.5 */                                                         \
    row(bounces_once)               /* 25, without the multiple reflections of rough metals */                        \
    row(coat_adds_light)            /* 25, the surface below keeps all its light */                                   \
    row(sheen_adds_light)           /* 25, the surface below keeps all its light */                                   \
    row(open_beyond_1)              /* 25, unoccluded white gets 1.0001 of the light from all around */               \
    row(fresnel_of_4th_power)       /* 25, of lamps */                                                                \
    row(environment_not_blurred)    /* 26, as mirrors show it */                                                      \
    row(environment_not_turned)     /* 26, it moves with the camera */                                                \
    row(environment_far)            /* 26, infinitely far away */                                                     \
    row(near_as_mirrored)           /* 26, E moves as far as what mirrors show */                                     \
    row(dither_from_above)          /* 23, rows of the pattern count from the highest */                              \
    row(dithered_surfaces)          /* 23, not the background alone */                                                \
    row(xray_upright)               /* 30, walls on the left are no denser */                                         \
    row(texels_from_corners)        /* 31, interpolation between the corners of texels, not between their centres */  \
    row(levels_half_off)            /* 31, which level */                                                             \
    row(tone_keeps_hue)             /* 27, bright colours do not fade to white */                                     \
    row(upside_down)                /* the picture */                                                                  \
    row(ggx_from_behind)            /* 25, a highlight where N.H is not above 0 */                                     \
    row(fog_z_other_way)            /* 21, z is summed from its other end */
/* clang-format on */

#ifdef ZR_MUTANTS
#define ZR_MUTANT_ITEM(name) ZR_MUTANT_##name,
enum zr_mutant { ZR_EACH_MUTANT(ZR_MUTANT_ITEM) ZR_MUTANT_COUNT };
extern uint64_t zr_mutants_chosen[ZR_MUTANT_COUNT / 64 + 1]; /* a bit each */
#define ZR_MUTANT(name, right, wrong)                                                                                  \
    (zr_mutants_chosen[ZR_MUTANT_##name / 64] >> (ZR_MUTANT_##name % 64) & 1 ? (wrong) : (right))
#else
#define ZR_MUTANT(name, right, wrong) (true ? (right) : (wrong))
#endif

/* Switches a mutant on or off. No thread may render meanwhile. False if this build has no mutant of that name. */
bool zr_mutant_set(const char *name, bool on);

/* The name of mutant `number`, from 0 on; NULL if there is none. */
const char *zr_mutant_name(int number);

#endif
