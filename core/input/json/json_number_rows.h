/* json_number_rows.h - input: reads rows of numbers from the text straight into the scene's arrays.
 *
 * Each function reads the value at `at` and returns the byte after it. NULL if its form or range is wrong, or its form
 * is unusual; the caller then uses the reader of json_value.h, which reports faults. They accept only valid JSON. All
 * are inlined into the loops over lists: a call per row costs a tenth.
 */
#ifndef ZR_JSON_NUMBER_ROWS_H
#define ZR_JSON_NUMBER_ROWS_H

#include "base/inlined.h"
#include "base/vec.h"
#include "input/json/json_list.h"
#include "input/json/json_value.h"
#include "input/text/color_text.h"
#include "input/text/number.h"

static inline const char *zr_numbers_skip_space(const char *at, const char *end)
{
    return at < end && (unsigned char)*at <= ' ' ? zr_json_skip_space(at, end) : at;
}

#ifdef __SSE2__
/* Reads the number after `at` in its usual form and returns the byte after it, or NULL. May read ZR_QUICKER_BYTES + 2
 * bytes. */
ZR_INLINED const char *zr_numbers_quicker(const char *at, double low, double high, float *out)
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

/* Reads the number after `at`, a '[' or ',', in any form. Returns the ',' or ']' that follows it. */
const char *zr_numbers_any_next(const char *at, const char *end, double low, double high, float *out);

/* zr_numbers_any_next, with the usual form inlined. */
ZR_INLINED const char *zr_numbers_next(const char *at, const char *end, double low, double high, float *out)
{
#ifdef __SSE2__
    if (end - at >= ZR_QUICKER_BYTES + 2) {
        const char *behind = zr_numbers_quicker(at, low, high, out);
        if (behind && (*behind == ',' || *behind == ']')) return behind;
    }
#endif
    return zr_numbers_any_next(at, end, low, high, out);
}

/* Reads three numbers in any form after `at`, a '['. Returns the ',' or ']' that follows. */
const char *zr_numbers_any_three(const char *at, const char *end, double low, double high, zr_vec3 *out);

/* zr_numbers_any_three, with the usual form inlined. Three variables instead of an array: a vector load behind three float
 * stores stalls (store forwarding), 3 ns per row. */
ZR_INLINED const char *zr_numbers_three(const char *at, const char *end, double low, double high, zr_vec3 *out)
{
    if (at == end || *at != '[') return NULL;
#ifdef __SSE2__
    float x, y, z;
    const char *next = at;
    if (end - at >= 3 * ZR_QUICKER_BYTES && (next = zr_numbers_quicker(next, low, high, &x)) && *next == ',' &&
        (next = zr_numbers_quicker(next, low, high, &y)) && *next == ',' &&
        (next = zr_numbers_quicker(next, low, high, &z)) && (*next == ']' || *next == ',')) {
        *out = (zr_vec3){x, y, z};
        return next;
    }
#endif
    return zr_numbers_any_three(at, end, low, high, out);
}

ZR_INLINED const char *zr_numbers_vec3(const char *at, const char *end, double limit, zr_vec3 *out)
{
    at = zr_numbers_three(at, end, -limit, limit, out);
    return at && *at == ']' ? at + 1 : NULL;
}

/* Reads three or four numbers; the default of the fourth is 1. */
ZR_INLINED const char *zr_numbers_vec4(const char *at, const char *end, double low, double high, zr_vec4 *out)
{
    zr_vec3 v;
    float w = 1.0f;
    at = zr_numbers_three(at, end, low, high, &v);
    if (at && *at == ',') {
        at = zr_numbers_next(at, end, low, high, &w);
        if (at && *at != ']') return NULL;
    }
    if (!at) return NULL;
    *out = (zr_vec4){v.x, v.y, v.z, w};
    return at + 1;
}

static inline const char *zr_numbers_position(const char *at, const char *end, double limit, zr_vec4 *out)
{
    return zr_numbers_vec4(at, end, -limit, limit, out);
}

static inline const char *zr_numbers_color(const char *at, const char *end, zr_vec4 *out)
{
    if (at == end || *at != '"') return zr_numbers_vec4(at, end, 0.0, 1.0, out);
    size_t length = 1;
    while (length <= ZR_COLOR_NAME_MAX && end - at > (ptrdiff_t)(length + 1) && at[length] != '"')
        length++;
    length--;
    return zr_color_of_text(at + 1, length, out) && end - at > (ptrdiff_t)(length + 1) && at[length + 1] == '"'
               ? at + length + 2
               : NULL;
}

/* Reads 1..most indices below `count`; *used: how many. `at` is the '['. */
const char *zr_numbers_any_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                                   size_t *used);

/* zr_numbers_any_indices, inlined for short rows without spaces: saves a tenth of reading a mesh. */
ZR_INLINED const char *zr_numbers_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                                          size_t *used)
{
    if (at == end || *at != '[') return NULL;
#ifdef __SSE2__
    if (end - at >= ZR_QUICK_ROW_BYTES) {
        const char *behind = zr_number_quick_row(at, ',', 0, count, most, out, used);
        if (behind && *behind == ']') return behind + 1;
    }
#endif
    return zr_numbers_any_indices(at, end, count, most, out, used);
}

/* ---- lists of rows ---- */

/* Append items of a list to an array, a struct zr_growing, as struct zr_json_list says. Unusual and wrong items go
 * through the readers of json_value.h. */
typedef void zr_rows_read_fn(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until);
zr_rows_read_fn zr_rows_read_positions, zr_rows_read_colors; /* zr_vec4 */
zr_rows_read_fn zr_rows_read_vec3s;                          /* zr_vec3 */
zr_rows_read_fn zr_rows_read_texcoords;                      /* float[2] */
zr_rows_read_fn zr_rows_read_tangents;                       /* zr_vec4, with w = 1 or -1 */

/* Reports a w other than 1 and -1; returns false then. */
bool zr_tangent_check(struct zr_json *json, const struct zr_json_path *path, const zr_vec4 *tangent);

#endif
