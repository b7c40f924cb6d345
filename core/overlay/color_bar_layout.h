/* color_bar_layout.h - overlay: selects the scale of a colour bar and places its parts, without a picture.
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

/* Returns the scale of the scene's bar: that of the bar's mesh, else of the first instance with one. NULL: none. */
const struct zr_color_scale *zr_color_bar_scale(const struct zr_scene *scene);

/* Positions and sizes of the parts, in pixels. */
struct zr_color_bar_layout {
    const struct zr_color_scale *scale;
    int32_t dot;         /* size of a dot of glyphs; the unit of all other sizes */
    int32_t line;        /* thickness of frame and ticks */
    struct zr_box bar;   /* the colours, without the frame */
    struct zr_box block; /* frame, ticks and labels */
    struct zr_box all;   /* block, title and outlines; inside the window */
    int32_t tick_x;      /* left end of ticks */
    int32_t tick_width;
    int32_t label_x; /* left end of labels */
    struct zr_ticks ticks;
    const char *title;                   /* NULL: none, or no room for it */
    int32_t title_x, title_y, title_dot; /* upper left corner; size of a dot */
};

/* Places the parts in a window of width x height pixels. False if the window has no room: labels would be less than 7
 * pixels high or too close, or the bar would take more than half of the width. */
bool zr_color_bar_lay_out(const struct zr_color_bar *bar, const struct zr_color_scale *scale, uint32_t width,
                          uint32_t height, struct zr_color_bar_layout *out);

/* Adds warnings about the scene's colour bar, if the view has an output color. */
void zr_color_bar_warn(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                       struct zr_warning_list *warnings);

#endif
