/* chains.h - lines: keeps the creases that form lines, by hysteresis.
 *
 * Space:  lengths in fine pixels (window_view.h); turns in eye space.
 * How:    creases are linked at vertices, the straightest pair first, if they turn by at most 50 degrees and are both
 *         convex or both concave. A chain stays if it has a crease of 1/64 of the diagonal of the bounds, a strong
 *         crease and 12 pixels, or 72 pixels. Strong chains of one or two edges stay as well if both ends touch a
 *         border or a crease that stays; up to 8 rounds.
 * Free:   an end is free if no border and no other crease that stays ends there: the surface becomes smooth. Chains
 *         without a strong crease go if an end is free, others if both are; up to 8 rounds. Rings have no ends, and
 *         creases beside planes stay: they are edges of machined parts.
 * Exact:  the same for any number of threads. */
#ifndef ZR_CHAINS_H
#define ZR_CHAINS_H

#include "lines/features.h"

enum {
    ZR_CHAIN_STRONG_PIXELS = 12,
    ZR_CHAIN_WEAK_PIXELS = 72,
    ZR_CHAIN_LINKS_MOST = 32 /* creases at a vertex; if there are more, none of them are linked */
};

/* Removes the crease bits of the edges that do not stay. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_chains_keep(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_window_mesh *mesh,
                              uint8_t *features);

#endif
