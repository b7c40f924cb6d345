/* json_array.h - input: an array of numbers that stands for a list: {"asset": NAME} or {"uri": "data:..."}.
 *
 * Source: an NPY file (npy_read.h), or an array that the caller hands over (struct zr_asset).
 * Checks: those of lists, with the same messages and pointers, such as /meshes/0/faces/17/2.
 * Memory: numbers are converted or copied into the arena, then checked: a caller may write to them meanwhile. A lent
 *         array of the right type is used in place.
 * Use:    zr_json_array_open once zr_json_type is ZR_JSON_OBJECT, then one of the functions that read its numbers.
 */
#ifndef ZR_JSON_ARRAY_H
#define ZR_JSON_ARRAY_H

#include "input/json/json_list.h"
#include "input/json/json_value.h"

/* Shapes and numbers of an array that may stand for a list. */
struct zr_array_wanted {
    size_t rows;        /* 0: any number */
    size_t least, most; /* numbers per row; 1: the shape (n,), or (n, 1) */
    const char *of;     /* elements that the indices number, such as "positions"; NULL: the numbers are floats */
    uint32_t end;       /* of indices; UINT32_MAX: not known yet */
    bool is_color;      /* u1 is 0 to 255 for 0 to 1 */
    bool has_holes;     /* a float may be NaN */
    bool is_changed;    /* the scene may write to it: it is copied even if it is lent */
    bool is_place;      /* positions: those of a far scene are moved (text/recenter.h) */
    double low, high;   /* of each float */
};

struct zr_json_array {
    const struct zr_array_wanted *wanted;
    struct zr_array numbers;
    bool is_lent;
    size_t rows, columns;
};

/* Reads the next value, an object, and finds its array. False, and reported, if there is none of such a shape and type.
 * A part of a list that is read ahead ends (json_list.h). */
bool zr_json_array_open(struct zr_json *json, const struct zr_json_path *path, const struct zr_array_wanted *wanted,
                        struct zr_json_array *array);

/* Appends floats to `out`. Its items are single floats, rows, or rows with one float more, which becomes 1. False, and
 * reported, for a number out of range; the content of `out` is then undefined. */
bool zr_json_array_floats(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_array *array,
                          struct zr_growing *out);

/* Appends indices; items of `out` are whole rows or single indices. */
bool zr_json_array_indices(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_array *array,
                           struct zr_growing *out);

/* Counts bytes before they are read. If they exceed the limit of a quick reading, reports that and returns false. */
bool zr_json_has_time(struct zr_json *json, size_t bytes);

/* Opens an array and appends its floats. */
bool zr_json_array_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_array_wanted *wanted,
                        struct zr_growing *out);

/* Reads a matrix of side x side numbers, magnitudes up to `limit`, row by row. */
bool zr_json_array_square(struct zr_json *json, const struct zr_json_path *path, size_t side, double limit,
                          double *out);

#endif
