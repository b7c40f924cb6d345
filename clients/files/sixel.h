/* sixel.h - client: pictures for terminals that read DEC's sixels. */
#ifndef SIXEL_H
#define SIXEL_H

#include "pixels.h"

/* Writes the picture, dithered to 240 colours: 6 reds, 8 greens and 5 blues, evenly spaced. Transparent pixels are
 * blended with black. */
void sixel_write(struct bytes *out, const struct pixels *pixels);

#endif
