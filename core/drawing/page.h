/* page.h - drawing: the paper, the scale, and the places of the views.
 *
 * Space:  millimetres, as plot.h.
 * Paper:  A4 upright or A3 across (ISO 5457): a frame 20 mm from the left edge and 10 mm from the others, centring
 *         marks, and a title block of 180 x 36 mm at the lower right.
 * Scale:  1:n or n:1 with n = 1, 2 or 5 times a power of ten (ISO 5455): the largest one at which all views fit.
 * Views:  third angle: the top view above the front, the right view to the right of the front. First angle: the top
 *         view below the front, the right view to the left of it. The isometric view takes the fourth corner, in the
 *         same scale. Rows and columns are as large as the larger view in them. */
#ifndef ZR_PAGE_H
#define ZR_PAGE_H

#include <stdbool.h>
#include <stdint.h>

enum zr_page_size { ZR_PAGE_A4, ZR_PAGE_A3, ZR_PAGE_SIZES };
enum zr_page_view { ZR_PAGE_FRONT, ZR_PAGE_TOP, ZR_PAGE_RIGHT, ZR_PAGE_ISOMETRIC, ZR_PAGE_VIEWS };

extern const char *const zr_page_names[ZR_PAGE_SIZES];      /* "A4" */
extern const char *const zr_page_view_names[ZR_PAGE_VIEWS]; /* "front" */

#define ZR_PAGE_TITLE_WIDTH  180.0
#define ZR_PAGE_TITLE_HEIGHT 36.0

#define ZR_PAGE_CUT_ROOM   12.0 /* of an end of the cutting line of a section */
#define ZR_PAGE_NOTE_FIRST 7.0  /* the lowest shelf of notes above a view, and their distance */
#define ZR_PAGE_NOTE_ROW   6.0
#define ZR_PAGE_LABEL      9.0 /* of the label above a section */

struct zr_page_box {
    double x0, y0, x1, y1;
};

struct zr_page {
    enum zr_page_size size;
    double width, height;
    struct zr_page_box frame, title;
    bool is_first_angle;
};

/* Millimetres per millimetre of the model, as the quotient of two whole numbers. */
struct zr_page_scale {
    double paper, model; /* 1 and 2: half of the size */
};

static inline double zr_page_factor(struct zr_page_scale scale)
{
    return scale.paper / scale.model;
}

/* Sizes that the layout needs. */
struct zr_page_request {
    double sizes[ZR_PAGE_VIEWS][2];     /* width and height of each view, millimetres of the model */
    uint32_t notes[ZR_PAGE_VIEWS];      /* rows of notes above each view */
    bool has_label[ZR_PAGE_VIEWS];      /* "A-A" above it, or an end of the cutting line */
    bool has_cut_below, has_cut_beside; /* an end of it lies between a view and its dimension line */
    struct zr_page_scale asked;         /* .paper 0: the largest one that fits */
};

struct zr_page_layout {
    struct zr_page_scale scale;
    struct zr_page_box views[ZR_PAGE_VIEWS]; /* on the paper, exactly as large as the view */
};

struct zr_page zr_page_make(enum zr_page_size size, bool is_first_angle);

/* Places the views. False: they do not fit at the scale that is asked for, or at any. `largest` then has the largest
 * scale that fits, or .paper 0. */
bool zr_page_lay_out(const struct zr_page *page, const struct zr_page_request *request, struct zr_page_layout *out,
                     struct zr_page_scale *largest);

/* Writes "1:2" or "10:1". */
enum { ZR_PAGE_SCALE_SIZE = 32 };
void zr_page_scale_write(struct zr_page_scale scale, char out[ZR_PAGE_SCALE_SIZE]);

/* Reads "1:2", "10:1", also with other whole numbers up to 1e9. False: it is none. */
bool zr_page_scale_read(const char *text, struct zr_page_scale *out);

#endif
