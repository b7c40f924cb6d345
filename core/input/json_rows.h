/* json_rows.h - input: rows of numbers, from a text straight into the scene's arrays.
 *
 * Each function reads the value at `at` and returns where it ends; NULL where it is not what it should be, in
 * form or in range, or not in plain form. What is wrong then, if anything, is for json_value.h to say.
 * What they take is JSON. All are inlined into the loops over lists: a call for each row costs a tenth.
 */
#ifndef ZR_JSON_ROWS_H
#define ZR_JSON_ROWS_H

#include "base/inlined.h"
#include "base/vec.h"
#include "input/color_names.h"
#include "input/color_text.h"
#include "input/growing.h"
#include "input/json_value.h"
#include "input/number.h"
#include "input/number_quick.h"

static inline const char *zr_row_skip_space(const char *at, const char *end)
{
    return at < end && (unsigned char)*at <= ' ' ? zr_json_skip_space(at, end) : at;
}

#ifdef __SSE2__
/* The number behind `at` in its usual form; returns behind it, or NULL. ZR_QUICKER_BYTES + 2 may be read. */
ZR_INLINED const char *zr_row_quicker(const char *at, double low, double high, float *out)
{
    double value;
    at++;
    if (__builtin_expect(*at == ' ', 0)) at++;
    at = zr_number_quicker(at, &value);
    if (!at || !(value >= low && value <= high)) return NULL;
    *out = (float)value;
    return at;
}
#endif

/* The number behind `at`, which is '[' or ',', whatever its form; returns at the ',' or ']' that follows. */
const char *zr_row_any_next(const char *at, const char *end, double low, double high, float *out);

/* The same inlined for its usual form. */
ZR_INLINED const char *zr_row_next(const char *at, const char *end, double low, double high, float *out)
{
#ifdef __SSE2__
    if (end - at >= ZR_QUICKER_BYTES + 2) {
        const char *behind = zr_row_quicker(at, low, high, out);
        if (behind && (*behind == ',' || *behind == ']')) return behind;
    }
#endif
    return zr_row_any_next(at, end, low, high, out);
}

/* Three numbers behind `at`, which is '[', whatever their form; returns at the ',' or ']' that follows. */
const char *zr_row_any_three(const char *at, const char *end, double low, double high, zr_vec3 *out);

/* The same inlined for their usual form. One after the other, since floats that are put into an array and taken out as
 * a vector wait for each other in memory: 3 ns a row. */
ZR_INLINED const char *zr_row_three(const char *at, const char *end, double low, double high, zr_vec3 *out)
{
    if (at == end || *at != '[') return NULL;
#ifdef __SSE2__
    float x, y, z;
    const char *next = at;
    if (end - at >= 3 * ZR_QUICKER_BYTES && (next = zr_row_quicker(next, low, high, &x)) && *next == ',' &&
        (next = zr_row_quicker(next, low, high, &y)) && *next == ',' && (next = zr_row_quicker(next, low, high, &z)) &&
        (*next == ']' || *next == ',')) {
        *out = (zr_vec3){x, y, z};
        return next;
    }
#endif
    return zr_row_any_three(at, end, low, high, out);
}

ZR_INLINED const char *zr_row_vec3(const char *at, const char *end, double limit, zr_vec3 *out)
{
    at = zr_row_three(at, end, -limit, limit, out);
    return at && *at == ']' ? at + 1 : NULL;
}

/* Three or four numbers; the fourth is 1 where it is not given. */
ZR_INLINED const char *zr_row_vec4(const char *at, const char *end, double low, double high, zr_vec4 *out)
{
    zr_vec3 v;
    float w = 1.0f;
    at = zr_row_three(at, end, low, high, &v);
    if (at && *at == ',') {
        at = zr_row_next(at, end, low, high, &w);
        if (at && *at != ']') return NULL;
    }
    if (!at) return NULL;
    *out = (zr_vec4){v.x, v.y, v.z, w};
    return at + 1;
}

static inline const char *zr_row_position(const char *at, const char *end, double limit, zr_vec4 *out)
{
    return zr_row_vec4(at, end, -limit, limit, out);
}

static inline const char *zr_row_color(const char *at, const char *end, zr_vec4 *out)
{
    if (at == end || *at != '"') return zr_row_vec4(at, end, 0.0, 1.0, out);
    size_t length = 1;
    while (length <= ZR_COLOR_NAME_MAX && end - at > (ptrdiff_t)(length + 1) && at[length] != '"')
        length++;
    length--;
    return zr_color_of_text(at + 1, length, out) && end - at > (ptrdiff_t)(length + 1) && at[length + 1] == '"'
               ? at + length + 2
               : NULL;
}

/* At least one index and at most `most`; *used of them. */
const char *zr_row_any_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                               size_t *used);

/* The same inlined for short rows without spaces: a tenth of reading a mesh. */
ZR_INLINED const char *zr_row_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                                      size_t *used)
{
    if (at == end || *at != '[') return NULL;
#ifdef __SSE2__
    if (end - at >= ZR_QUICK_ROW_BYTES) {
        const char *behind = zr_number_quick_row(at, ',', 0, count, most, out, used);
        if (behind && *behind == ']') return behind + 1;
    }
#endif
    return zr_row_any_indices(at, end, count, most, out, used);
}

/* ---- lists of rows ---- */

/* Items of a list, from where `json` is in it up to one that begins at `until` or behind it, or to the list's end,
 * behind what the array holds. Their numbers in the path count from the array's item `first`. What is odd or wrong is
 * read by the readers of json_value.h. */
typedef void zr_rows_read_fn(struct zr_json *json, const struct zr_json_path *path, struct zr_growing *array,
                             size_t first, const char *until);
zr_rows_read_fn zr_rows_read_positions, zr_rows_read_colors; /* zr_vec4 */
zr_rows_read_fn zr_rows_read_vec3s;                          /* zr_vec3 */
zr_rows_read_fn zr_rows_read_texcoords;                      /* float[2] */
zr_rows_read_fn zr_rows_read_tangents;                       /* zr_vec4, of four numbers */

#endif
