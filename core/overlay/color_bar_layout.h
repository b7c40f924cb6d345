/* color_bar_layout.h - overlay: which scale a colour bar shows, and where its parts are: no pixel is needed for it.
 *
 * Space:  pixels of the window, (0, 0) at the top left corner.
 */
#ifndef ZR_COLOR_BAR_LAYOUT_H
#define ZR_COLOR_BAR_LAYOUT_H

#include "base/arena.h"
#include "base/warning_list.h"
#include "overlay/canvas.h"
#include "overlay/ticks.h"
#include "scene/scene.h"

/* The scale that the scene's bar shows. NULL: no mesh that is drawn has one. */
const struct zr_color_scale *zr_color_bar_scale(const struct zr_scene *scene);

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

/* What is odd about the bar that the scene asks for, where the view wants the picture at all. */
void zr_color_bar_warn(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                       struct zr_warning_list *warnings);

#endif
