/* sheen.h - shade: the share of uniform ambient light that a sheen of colour 1 reflects, at most 1.
 *
 * Table:  row i has roughness i / 15, column j the cosine N.V = (j / 15)^2. Look-up is bilinear. Charlie's distribution
 *         with alpha = roughness^2 and Ashikhmin's visibility. tests/unit/shade/test_finishes.c integrates every entry.
 * Source: KHR_materials_sheen; Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
 */
#ifndef ZR_SHEEN_H
#define ZR_SHEEN_H

enum { ZR_SHEEN_SIDE = 16 };

/* Least roughness: the distribution of smoother ones has no light left. */
#define ZR_SHEEN_ROUGHNESS_LEAST 0.07f

extern const float zr_sheen_table[ZR_SHEEN_SIDE][ZR_SHEEN_SIDE];

#endif
