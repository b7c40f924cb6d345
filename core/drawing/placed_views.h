/* placed_views.h - drawing: the views with their places on the paper, for marks and notes.
 *
 * Space:  world -> right and up axis of a view -> millimetres of the paper, all affine, in doubles. */
#ifndef ZR_PLACED_VIEWS_H
#define ZR_PLACED_VIEWS_H

#include "drawing/page.h"
#include "drawing/plot.h"
#include "drawing/view_lines.h"

struct zr_placed_views {
    struct zr_page page;
    struct zr_page_layout layout;
    struct zr_view_lines views[ZR_PAGE_VIEWS];
    double unit;             /* millimetres per unit of the scene */
    double sizes[3];         /* width, height, depth of the model, millimetres */
    bool has_hidden;         /* hidden lines are drawn, but not in the section */
    bool is_cut;             /* one view is the section A-A */
    enum zr_page_view cut;   /* that one */
    enum zr_page_view shown; /* view with the cutting line */
    double cut_place;        /* of the plane along the back axis of the cut view; the side below it stays */
};

/* Returns the millimetres of the paper per unit of the scene. */
static inline double zr_placed_factor(const struct zr_placed_views *placed)
{
    return placed->unit * zr_page_factor(placed->layout.scale);
}

/* Returns the place of a point that is given along right and up. */
static inline struct zr_point zr_placed_point(const struct zr_placed_views *placed, enum zr_page_view view,
                                              const double place[2])
{
    const struct zr_view_lines *of = &placed->views[view];
    const struct zr_page_box box = placed->layout.views[view];
    const double factor = zr_placed_factor(placed);
    return (struct zr_point){box.x0 + factor * (place[0] - of->low[0]), box.y1 - factor * (place[1] - of->low[1])};
}

static inline struct zr_point zr_placed_world(const struct zr_placed_views *placed, enum zr_page_view view, zr_dvec3 at)
{
    const struct zr_view_axes *axes = &placed->views[view].axes;
    return zr_placed_point(placed, view, (const double[2]){zr_dvec3_dot(axes->right, at), zr_dvec3_dot(axes->up, at)});
}

/* Sets the ends of the cutting line of the section, in the view `shown`: 5 mm beyond it. */
static inline void zr_placed_cut_line(const struct zr_placed_views *placed, struct zr_point ends[2])
{
    const double reach = 5.0;
    const struct zr_page_box box = placed->layout.views[placed->shown];
    const struct zr_view_axes *axes = &placed->views[placed->shown].axes;
    const zr_dvec3 back = placed->views[placed->cut].axes.back;
    const double right = zr_dvec3_dot(axes->right, back), up = zr_dvec3_dot(axes->up, back);
    const struct zr_point at =
        zr_placed_point(placed, placed->shown, (const double[2]){right * placed->cut_place, up * placed->cut_place});
    ends[0] = right != 0.0 ? (struct zr_point){at.x, box.y0 - reach} : (struct zr_point){box.x0 - reach, at.y};
    ends[1] = right != 0.0 ? (struct zr_point){at.x, box.y1 + reach} : (struct zr_point){box.x1 + reach, at.y};
}

#endif
