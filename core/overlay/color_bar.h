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

#include "base/arena.h"
#include "base/warning_list.h"
#include "overlay/canvas.h"
#include "overlay/ticks.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Returns the scale of the scene's bar: that of the bar's mesh, else of the first instance with one. NULL: none. */
const struct zr_color_scale *zr_color_bar_scale(const struct zr_scene *scene);

/* Positions and sizes of the parts, in pixels. */
struct zr_color_bar_layout {
    const struct zr_color_scale *scale;
    int32_t letters;     /* height of capitals in labels; all other sizes are shares of it */
    int32_t line;        /* thickness of frame and ticks */
    int32_t halo;        /* width of outlines */
    struct zr_box bar;   /* the colours, without the frame */
    struct zr_box block; /* frame, ticks and labels */
    struct zr_box all;   /* block, title and outlines; inside the window */
    int32_t tick_x;      /* left end of ticks */
    int32_t tick_width;
    int32_t label_x; /* left end of labels' ink */
    struct zr_ticks ticks;
    const char *title;                       /* NULL: none, or no room for it */
    int32_t title_x, title_y, title_letters; /* left end of ink; base line's row; height of capitals */
};

/* Places the parts in a window of width x height pixels. False if the window has no room: labels would be less than 7
 * pixels high or too close, or the bar would take more than half of the width. */
bool zr_color_bar_lay_out(const struct zr_color_bar *bar, const struct zr_color_scale *scale, uint32_t width,
                          uint32_t height, struct zr_color_bar_layout *out);

/* Adds warnings about the scene's colour bar, if the view has an output color. */
void zr_color_bar_warn(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                       struct zr_warning_list *warnings);

/* Draws a bar that is laid out. */
void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas);

/* Draws the bar of a scene over frame->color, if the scene has one and the window has room for it. */
void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame);

#endif
