/* stl_color.h - input: colours of facets in binary STL, in the two bytes of attributes after each triangle.
 *
 * VisCAM and SolidView: bit 15 is set if the facet has a colour, with red in bits 10 to 14, blue in bits 0 to 4.
 * Magics:  the header has "COLOR=" and four bytes, the colour of the part. Bit 15 is clear if the facet has its own
 *          colour, with red in bits 0 to 4, blue in bits 10 to 14.
 * MeshLab: as Magics, but with bit 15 set on each facet, although the colours differ.
 * Others:  many programs leave arbitrary bytes there. */
#ifndef ZR_STL_COLOR_H
#define ZR_STL_COLOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

/* Bits of a set of attributes. For the empty set, `all` is UINT16_MAX and the others are 0. */
struct zr_stl_attributes {
    uint16_t any, all; /* set in any, in all of them */
    uint16_t unmarked; /* set in any of those without bit 15 */
    uint16_t colored;  /* clear in any of those with bit 15 */
};

static inline void zr_stl_attributes_add(struct zr_stl_attributes *bits, uint16_t attribute)
{
    const uint16_t marked = (uint16_t) - (attribute >> 15);
    bits->any |= attribute;
    bits->all &= attribute;
    bits->unmarked |= attribute & (uint16_t)~marked;
    bits->colored |= (uint16_t)~attribute & marked;
}

enum zr_stl_dialect {
    ZR_STL_PLAIN,  /* no colours */
    ZR_STL_PART,   /* one colour for all facets */
    ZR_STL_VISCAM, /* this and the next ones: a colour per facet */
    ZR_STL_MAGICS,
    ZR_STL_MESHLAB
};

/* Colours of a file. */
struct zr_stl_colors {
    enum zr_stl_dialect dialect;
    zr_vec4 part; /* colour of facets without their own */
};

/* `header`: 80 bytes. */
struct zr_stl_colors zr_stl_colors_of(const char *header, const struct zr_stl_attributes *bits);

zr_vec4 zr_stl_facet_color(const struct zr_stl_colors *colors, uint16_t attribute);

#endif
