/* dfg.h - shade: the share of uniform ambient light that a GGX surface reflects: F0 A + B.
 *
 * Table:  row i has roughness i / 31, column j the cosine N.V = (j / 31)^2; each has A and B. Look-up is bilinear. With
 *         height-correlated Smith and Schlick's Fresnel term. tests/unit/shade/test_split_sum.c integrates every entry anew
 *         and prints the table.
 * Source: Karis, "Real Shading in Unreal Engine 4", 2013. His polynomial is for another Smith term: with this one, A
 *         would be wrong by up to 0.36.
 */
#ifndef ZR_DFG_H
#define ZR_DFG_H

enum { ZR_DFG_SIDE = 32 };

extern const float zr_dfg_table[ZR_DFG_SIDE][2][ZR_DFG_SIDE]; /* A of a row's columns, then B */

#endif
