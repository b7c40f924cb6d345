/* points_file.h - input: what the readers of OFF, PCD and XYZ share: lines of numbers, and points in double precision.
 *
 * Far:    positions are doubles until the origin of a far mesh is subtracted (text/recenter.h).
 * Holes:  points that are not finite are left out; a warning counts them.
 */
#ifndef ZR_POINTS_FILE_H
#define ZR_POINTS_FILE_H

#include "base/arena.h"
#include "core.h"
#include "scene/scene_builder.h"

/* Most points, as of PLY. */
enum { ZR_POINTS_MAX = 1 << 28 };

struct zr_points {
    struct zr_scene_builder *builder;
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    struct zr_error *error;
    const char *format; /* for messages: "PCD" */
    size_t count, room;
    double (*positions)[3]; /* x of a hole, a position that is not finite, is NaN */
    zr_vec4 *colors;        /* of any scale; NULL: none */
    zr_vec3 *normals;       /* or NULL */
    bool has_colors, has_normals;
};

/* Returns what a request's reader begins with. */
struct zr_points zr_points_open(struct zr_scene_builder *builder, const struct zr_cancel *cancel,
                                const struct zr_limits *limits, struct zr_error *error, const char *format);

/* Makes room for `count` points in all. False without memory, or beyond ZR_POINTS_MAX with a fault. */
bool zr_points_reserve(struct zr_points *points, size_t count);

/* Adds a position. The caller sets its colour and normal, if the file has some, at the returned number. */
size_t zr_points_add(struct zr_points *points, const double position[3]);

/* Scales colours by `scale`, or, if it is 0, from 0..255 if one is beyond 1, and limits them to 0..1. Those whose red is
 * ZR_POINTS_NO_COLOR become white. */
#define ZR_POINTS_NO_COLOR (-1e30f)
void zr_points_scale_colors(zr_vec4 *colors, size_t count, float scale);

/* Makes the mesh of all positions, without faces, lines or points, and subtracts a far origin. NULL after a fault. */
struct zr_mesh *zr_points_make(struct zr_points *points);

/* Draws all points but holes, with a warning of these. */
enum zr_status zr_points_draw(struct zr_points *points, struct zr_mesh *mesh);

/* ---- lines of text ---- */

struct zr_points_text {
    const char *at, *end;
    size_t line;                    /* number of the line that was read last, from 1 */
    const struct zr_cancel *cancel; /* or NULL; raised, it ends the text */
    const char *newline;            /* the next one, if it is at or behind `at`, or the end */
};

/* A line without the white space around it. */
struct zr_points_line {
    const char *at, *end;
};

/* Reads the next line that is not empty, without comments (#, or // at its start). False at the end. */
bool zr_points_next(struct zr_points_text *text, struct zr_points_line *line);

/* Reads up to `most` numbers between blanks, commas and semicolons; nan and inf are numbers. Returns their count; -1 at
 * another word, which *line then begins with. Otherwise *line begins behind the numbers. */
int zr_points_numbers(struct zr_points_line *line, double *out, int most);

/* Returns the next word of a line between such separators; empty at its end. */
struct zr_points_line zr_points_word(struct zr_points_line *line);

/* True if a word is `text`, in any case. */
bool zr_points_is(const struct zr_points_line *word, const char *text);

/* Returns the status of a reader that ends with `status`: cancellation counts before faults, which it may cause. */
enum zr_status zr_points_status(const struct zr_points *points, enum zr_status status);

/* Reports a fault of a line. */
enum zr_status zr_points_fault(struct zr_points *points, size_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
