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

#include "base/arena.h"
#include "base/warning_list.h"
#include "overlay/canvas.h"
#include "overlay/ticks.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Where all of it is. */
struct zr_color_bar_layout {
    const struct zr_color_scale *scale;
    int32_t dot;         /* of glyphs, pixels; all else is in proportion to it */
    int32_t line;        /* how thick the frame and the ticks are */
    struct zr_box bar;   /* the colours, inside of the frame */
    struct zr_box block; /* frame, ticks and labels */
    struct zr_box all;   /* the title and rims, too; inside of the window */
    int32_t tick_x;      /* ticks begin there, and are `tick_width` wide */
    int32_t tick_width;
    int32_t label_x;
    struct zr_ticks ticks;
    const char *title; /* NULL: none, or there is no room for it */
    int32_t title_x, title_y, title_dot;
};

/* False where the window has no room for it: its labels would be less than 7 pixels high, or too close, or it would
 * take more than half of the width. */
bool zr_color_bar_lay_out(const struct zr_color_bar *bar, const struct zr_color_scale *scale, uint32_t width,
                          uint32_t height, struct zr_color_bar_layout *out);

void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas);

/* The same of a scene: over frame->color where the scene asks for a bar and has room for it. */
void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame);

/* What is odd about the bar that the scene asks for, where the view wants the picture at all. */
void zr_color_bar_warn(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                       struct zr_warning_list *warnings);

#endif
