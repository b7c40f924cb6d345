/* layout.h - overlay: the picture to be annotated, its marks so far, and the places that they take.
 *
 * Space:  pixels of the window, y downwards, as overlay/pen.h. The world's places are projected in doubles.
 * Free:   texts lie inside the window, on background, and apart from other texts and lines; lines cross no text and no
 *         line that was placed before. Tests are made in a fixed order, so that the result is the same everywhere. */
#ifndef ZR_LAYOUT_H
#define ZR_LAYOUT_H

#include "base/dvec3.h"
#include "base/matrix.h"
#include "overlay/marks.h"
#include "shade/frame.h"

/* Corners of an upright box, pixels. */
struct zr_rect {
    double x0, y0, x1, y1;
};

struct zr_segment {
    struct zr_point from, to;
};

/* Causes, as warnings tell them apart. UNSEEN has no warning: holes on the far side of the model, and the box's axis
 * along the view. */
enum zr_left_out_cause {
    ZR_LEFT_OUT_NO_ROOM,
    ZR_LEFT_OUT_BY_VIEW,
    ZR_LEFT_OUT_UNSEEN,
    ZR_LEFT_OUT_NOT_SEARCHED,
    ZR_LEFT_OUT_MISTAKE,
    ZR_LEFT_OUT_CAUSES
};

/* A mark that is not drawn, such as dimensions/0, and the reason. Both are in the arena or literals. */
struct zr_left_out {
    const char *what, *why;
    enum zr_left_out_cause cause;
};

/* A numbered label of a part. */
struct zr_numbered_part {
    uint32_t number;
    const char *name;
};

enum { ZR_LAYOUT_RECTS = 512, ZR_LAYOUT_SEGMENTS = 1024, ZR_LEFT_OUT_MAX = 128 };

struct zr_layout {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_marks *marks;
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    const uint32_t *ids; /* per pixel: 0 on background; NULL: all is background */
    double width, height;
    double letters, line;           /* height of capitals; width of lines */
    bool is_dark;                   /* the paper is */
    uint32_t ink, dimension, paper; /* colours of texts, of dimensions and of halos */
    struct zr_matrix to_clip;       /* world to clip space */
    zr_dvec3 axes[3];               /* axes of the file, in world space */
    double eye[4];                  /* world space: a point, or with 0 as the last number the direction to the eye */
    uint32_t corner_count;          /* the first boxes: of marks in corners, and of a colour bar */
    uint32_t rect_count, segment_count, left_out_count;
    struct zr_rect rects[ZR_LAYOUT_RECTS];
    struct zr_segment segments[ZR_LAYOUT_SEGMENTS];
    struct zr_left_out left_out[ZR_LEFT_OUT_MAX];
    uint32_t causes[ZR_LEFT_OUT_CAUSES]; /* marks by cause, also those beyond the list */
};

/* Moves a place of the file to the world. A scene in JSON has its origin subtracted already. */
zr_dvec3 zr_layout_world(const struct zr_layout *layout, zr_vec3 place);

/* Projects a place of the world. False: it is not in front of the eye. */
bool zr_layout_project(const struct zr_layout *layout, zr_dvec3 place, struct zr_point *out);

/* Returns the box of a text whose ink begins at (x, y), on the base line, grown by `by`. */
struct zr_rect zr_layout_text_rect(double x, double y, double width, double height, double by);

/* True if the box lies in the window. */
bool zr_layout_is_inside(const struct zr_layout *layout, struct zr_rect rect);

/* True if the box has no pixel of the model. */
bool zr_layout_is_background(const struct zr_layout *layout, struct zr_rect rect);

/* True if the box overlaps no box and no line that was placed. */
bool zr_layout_is_apart(const struct zr_layout *layout, struct zr_rect rect);

/* True if the line lies in the window and crosses no box that was placed. */
bool zr_layout_is_line_off_rects(const struct zr_layout *layout, struct zr_segment line);

/* True if it crosses no line that was placed, either. */
bool zr_layout_is_line_free(const struct zr_layout *layout, struct zr_segment line);

/* True if the line has a point in the box. */
bool zr_layout_line_meets(struct zr_segment line, struct zr_rect rect);

/* Add a placed box or line: later marks keep clear of it. */
void zr_layout_take_rect(struct zr_layout *layout, struct zr_rect rect);
void zr_layout_take_line(struct zr_layout *layout, struct zr_segment line);

/* Lists a mark that is not drawn. Its name is copied. */
void zr_layout_leave_out(struct zr_layout *layout, const char *what, const char *why, enum zr_left_out_cause cause);

/* Returns an ink of a width in lines, with a halo or without. */
struct zr_ink zr_layout_ink(const struct zr_layout *layout, uint32_t color, double lines, bool has_halo);

/* Adds a horizontal text with its ink's left end at x. */
void zr_layout_write(struct zr_layout *layout, const char *text, double x, double y, double height, uint32_t color,
                     bool has_halo);

/* The same over the model, with a halo of the paper, whatever is below. */
void zr_layout_write_over(struct zr_layout *layout, const char *text, double x, double y, double height,
                          uint32_t color);

/* Adds a line of a width in lines. */
void zr_layout_draw(struct zr_layout *layout, struct zr_segment line, uint32_t color, double lines, bool has_halo);

#endif
