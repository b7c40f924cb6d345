/* floats.h - reference: what GLSL programs give as floats, against our arithmetic, on random triangles.
 *
 * Why:    8-bit colours hide last bits. And who compares with a program of reference_program.h must know how llvmpipe
 *         interpolates what the program gets: rules 16 to 18 of RULES.md, which are held here.
 * Parts:  a varying; gl_FragCoord; functions (glsl_math.h); the colours that the reference lights, flat, both sides.
 */
#ifndef ZR_TEST_FLOATS_H
#define ZR_TEST_FLOATS_H

#include "reference/page/report.h"

/* Draws so many triangles for each part, each in a picture of its own, and prints a line for each part, in which
 * "depth" counts the pixels where one of four floats differs. The harness's perturbations are heeded. */
enum verdict floats_check(struct harness *harness, struct report *report, uint64_t seed, uint64_t triangles,
                          struct tally *sum);

#endif
