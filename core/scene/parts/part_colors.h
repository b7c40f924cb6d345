/* part_colors.h - scene: chooses the colour of a part by its name.
 *
 * Stable: a hash of the name chooses the colour. It depends neither on the file nor on other parts. A number at the end
 *         of the name is added to the hash, so "bolt", "bolt.2" and "bolt.3", or "bolt1" and "bolt2", differ in hue.
 * Source: seven hues of Okabe and Ito, which people with any colour vision tell apart, each plain, lighter and darker.
 */
#ifndef ZR_PART_COLORS_H
#define ZR_PART_COLORS_H

#include <stdint.h>

#include "base/vec.h"

enum { ZR_PART_COLORS = 21 };

/* sRGB-encoded, opaque. */
extern const zr_vec4 zr_part_colors[ZR_PART_COLORS];

/* Returns the index of a name's colour. */
uint32_t zr_part_color_of(const char *name);

#endif
