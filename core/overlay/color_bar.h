/* color_bar.h - overlay, last step: a scale of colours with its numbers, drawn over the finished picture.
 *
 * Space:  pixels of the window, (0, 0) at the top left corner. Colours go to pixels as they are, after tone mapping.
 * Rule:   the bar is `bar.height` rows of the map's own colours: the row that is r rows above the lowest has the
 *         colour of low + (high - low) * r / (rows - 1). A tick is at the row nearest to its number.
 * Ink:    frame, ticks and texts are black or white, whatever differs more from the median of what is behind, and have
 *         a rim in that colour: legible on everything, and the rim is seen only where something else is behind.
 * Only the channel color knows of it. One thread draws it, and nothing is allocated.
 */
#ifndef ZR_COLOR_BAR_H
#define ZR_COLOR_BAR_H

#include "overlay/canvas.h"
#include "overlay/color_bar_layout.h"
#include "shade/frame.h"

void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas);

/* The same of a scene: over frame->color where the scene asks for a bar and has room for it. */
void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame);

#endif
