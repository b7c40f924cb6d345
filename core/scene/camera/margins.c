#include "scene/camera/margins.h"

#include <math.h>

/* Room in heights of capitals. */
static const double title_room = 4.6, corner_room = 4.6, edge_room = 1.0, offset = 2.6, line_room = 1.8,
                    number_room = 3.2, letter_room = 0.8, leader_room = 3.0, triad_width = 7.7, scale_height = 4.0,
                     bar_room = 9.0, note_room = 3.0;

/* Offset of dimensions as a share of the shorter side, at least; largest room for labels as a share of the width. */
static const double offset_share = 0.055, label_share = 0.36, most_share = 0.36;

/* Letters of a label if their number is unknown. */
enum { LETTERS_ASSUMED = 10 };

double zr_margin_letters(double width, double height)
{
    const double side = fmin(width, height) / 480.0, root = sqrt(side);
    return fmax(7.0, floor(11.0 * root * sqrt(root) + 0.5));
}

bool zr_view_has_room(const struct zr_view *view)
{
    return view->annotate.bar_room != ZR_BAR_NO_ROOM || zr_annotate_fits(&view->annotate, view->width, view->height);
}

bool zr_view_fits_corners(const struct zr_view *view)
{
    return zr_annotate_fits(&view->annotate, view->width, view->height) &&
           zr_annotate_has(&view->annotate, ZR_ANNOTATE_BOX);
}

static double larger_share(double padding, double room, double side)
{
    return fmin(fmax(padding, room / side), most_share);
}

struct zr_margins zr_view_margins(const struct zr_view *view)
{
    const struct zr_annotate *annotate = &view->annotate;
    const double width = (double)view->width, height = (double)view->height, padding = (double)view->fit_padding;
    const double h = zr_margin_letters(width, height);
    const bool has_lines = zr_annotate_has(annotate, ZR_ANNOTATE_BOX) || annotate->dimension_count > 0;
    const bool has_triad = zr_annotate_has(annotate, ZR_ANNOTATE_TRIAD),
               has_scale = zr_annotate_has(annotate, ZR_ANNOTATE_SCALE);
    const double lines = has_lines ? fmax(offset * h, offset_share * fmin(width, height)) : 0.0;
    const double bar_left = annotate->bar_room == ZR_BAR_ROOM_LEFT ? bar_room * h : 0.0,
                 bar_right = annotate->bar_room == ZR_BAR_ROOM_RIGHT ? bar_room * h : 0.0;
    const struct zr_margins plain = {larger_share(padding, bar_left, width), larger_share(padding, bar_right, width),
                                     padding, padding};
    if (!zr_annotate_fits(annotate, view->width, view->height)) return plain;
    double left = edge_room * h + lines + (has_lines ? number_room * h : 0.0), right = left;
    double top = edge_room * h + lines + (has_lines ? line_room * h : 0.0), bottom = top;
    if (zr_annotate_has(annotate, ZR_ANNOTATE_TITLE)) top = fmax(top, title_room * h);
    if (has_triad || has_scale) bottom = fmax(bottom, corner_room * h);
    if (has_triad && has_lines) left = fmax(left, triad_width * h);
    if (has_scale && has_lines) bottom = fmax(bottom, scale_height * h + lines + 0.5 * line_room * h);
    if (zr_annotate_has(annotate, ZR_ANNOTATE_HOLES)) {
        left += note_room * h;
        right += note_room * h;
        top = fmax(top, title_room * h);
        bottom += line_room * h;
    }
    if (zr_annotate_has(annotate, ZR_ANNOTATE_LABELS)) {
        const uint32_t letters = annotate->label_letters ? annotate->label_letters : LETTERS_ASSUMED;
        right += fmin((letter_room * (double)letters + leader_room) * h, label_share * width);
    }
    left += bar_left;
    right += bar_right;
    const struct zr_margins all = {larger_share(padding, left, width), larger_share(padding, right, width),
                                   larger_share(padding, top, height), larger_share(padding, bottom, height)};
    return all;
}
