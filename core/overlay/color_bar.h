/* color_bar.h - overlay, last step: draws a colour scale with its numbers over the finished picture.
 *
 * Space:  pixels of the window, (0, 0) at the top left corner. Colours are written as they are, after tone mapping.
 * Rule:   the bar is `bar.height` rows of the map's own colours: the row r rows above the lowest has the colour of low
 *         + (high - low) * r / (rows - 1). A tick is at the row nearest to its number.
 * Ink:    frame, ticks and texts are black or white, whichever contrasts more with the median of the background, and
 *         have an outline in the median colour. They are legible on every background.
 *
 * Only the channel color shows it. One thread draws it, and nothing is allocated. */
#ifndef ZR_COLOR_BAR_H
#define ZR_COLOR_BAR_H

#include "overlay/canvas.h"
#include "overlay/color_bar_layout.h"
#include "shade/frame.h"

/* Draws a bar that is laid out. */
void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas);

/* Draws the bar of a scene over frame->color, if the scene has one and the window has room for it. */
void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame);

#endif
