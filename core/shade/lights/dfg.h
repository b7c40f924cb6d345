/* dfg.h - shade: how much of a uniform light around it a GGX surface reflects: F0 A + B.
 *
 * Table: row i has roughness i / 31, column j the cosine N.V = (j / 31)^2; each has A and B. Between them, bilinear.
 *        With height-correlated Smith and Schlick's Fresnel term; tests/unit/test_split_sum.c integrates every one of
 * them anew, and prints the table. Source: Karis, "Real Shading in Unreal Engine 4", 2013; his polynomial for it is of
 * another Smith term, and A is wrong by up to 0.36 with this one.
 */
#ifndef ZR_DFG_H
#define ZR_DFG_H

enum { ZR_SPLIT_SIDE = 32 };

extern const float zr_dfg_table[ZR_SPLIT_SIDE][2][ZR_SPLIT_SIDE]; /* A of a row's columns, then B */

#endif
