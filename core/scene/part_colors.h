/* part_colors.h - scene: a colour for each part, by its name alone.
 *
 * Stable: a hash of the name picks the colour, so that a part has it in every file, and whatever other parts there are.
 *         A number at its end counts on, so that "bolt", "bolt.2" and "bolt.3", or "bolt1" and "bolt2", differ in hue.
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
