/* json_rows.h - input: rows of numbers, from the text of a large list straight into the scene's arrays.
 *
 * Each function reads the value at `at` and returns where it ends; NULL where it is not what it should be, in
 * form or in range, or not in plain form. What is wrong then, if anything, is for json_value.h to say.
 * What they take is JSON. All are inlined into the loops over lists: a call for each row costs a tenth.
 */
#ifndef ZR_JSON_ROWS_H
#define ZR_JSON_ROWS_H

#include "base/vec.h"
#include "input/json_list.h"
#include "input/json_value.h"
#include "input/number.h"
#include "input/number_quick.h"

static inline const char *zr_row_skip_space(const char *at, const char *end)
{
    return at < end && (unsigned char)*at <= ' ' ? zr_json_skip_space(at, end) : at;
}

/* Left to themselves, compilers call these for each number. */
#define ZR_INLINED static inline __attribute__((always_inline))

/* A number of whatever form, and the space behind it. */
const char *zr_row_number(const char *at, const char *end, double low, double high, float *out);

/* The number behind `at`, which is '[' or ','; returns at the ',' or ']' that follows. */
ZR_INLINED const char *zr_row_next(const char *at, const char *end, double low, double high, float *out)
{
    at++;
#ifdef __SSE2__
    if (end - at >= ZR_QUICKER_BYTES + 1) {
        double value;
        if (*at == ' ') at++;
        const char *behind = zr_number_quicker(at, &value);
        if (behind && (*behind == ',' || *behind == ']') && value >= low && value <= high) {
            *out = (float)value;
            return behind;
        }
    }
#endif
    at = zr_row_number(zr_row_skip_space(at, end), end, low, high, out);
    return at && at < end && (*at == ',' || *at == ']') ? at : NULL;
}

/* Three numbers at the front of a row; returns at the ',' or ']' that follows. One after the other, since floats
 * that are put into an array and taken out as a vector wait for each other in memory: 2 ns a row. */
ZR_INLINED const char *zr_row_three(const char *at, const char *end, double low, double high, zr_vec3 *out)
{
    float x = 0.0f, y = 0.0f, z = 0.0f;
    if (at == end || *at != '[') return NULL;
    at = zr_row_next(at, end, low, high, &x);
    if (!at || *at != ',') return NULL;
    at = zr_row_next(at, end, low, high, &y);
    if (!at || *at != ',') return NULL;
    at = zr_row_next(at, end, low, high, &z);
    *out = (zr_vec3){x, y, z};
    return at;
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
    while (length <= 9 && end - at > (ptrdiff_t)(length + 1) && at[length] != '"')
        length++;
    length--;
    return zr_json_hex_color(at + 1, length, out) && end - at > (ptrdiff_t)(length + 1) && at[length + 1] == '"'
               ? at + length + 2
               : NULL;
}

/* A whole number below `count`; in the form 1.0 or 1e3 it is one too. */
static inline const char *zr_row_index(const char *at, const char *end, uint32_t count, uint32_t *out)
{
    uint64_t word = zr_eight_bytes(at, end);
    unsigned digits = zr_count_digits(word);
    char behind = digits < 8 ? zr_byte_behind(word, digits) : '.';
    if (digits == 0 || (digits > 1 && (char)word == '0') || behind == '.' || behind == 'e' || behind == 'E') {
        double value;
        at = zr_number_read_json(at, end, &value);
        if (!at || !(value >= 0.0 && value < (double)count) || (double)(uint32_t)value != value) return NULL;
        *out = (uint32_t)value;
        return at;
    }
    *out = zr_digits_value(word, digits);
    return *out < count ? at + digits : NULL;
}

/* At least one index and at most `most`; *used of them. */
static inline const char *zr_row_indices(const char *at, const char *end, uint32_t count, size_t most, uint32_t *out,
                                         size_t *used)
{
    if (at == end || *at != '[') return NULL;
    for (size_t i = 0; i < most; i++) {
        at = zr_row_index(zr_row_skip_space(at + 1, end), end, count, &out[i]);
        if (!at) return NULL;
        at = zr_row_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == ']') {
            *used = i + 1;
            return at + 1;
        }
        if (*at != ',') return NULL;
    }
    return NULL;
}

#endif
