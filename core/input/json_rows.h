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

static inline const char *zr_row_number(const char *at, const char *end, double low, double high, float *out)
{
    double value;
    if (at == end) return NULL;
    const char *behind = zr_number_quick(at, end, &value);
    if (!behind) behind = zr_number_read_json(at, end, &value);
    if (!behind || !(value >= low && value <= high)) return NULL;
    *out = (float)value;
    return behind;
}

/* At least one number and at most `most`, their count in *count. */
static inline const char *zr_row_numbers(const char *at, const char *end, double low, double high, int most, float *out,
                                         int *count)
{
    if (at == end || *at != '[') return NULL;
    for (int i = 0; i < most; i++) {
        at = zr_row_number(zr_row_skip_space(at + 1, end), end, low, high, &out[i]);
        if (!at) return NULL;
        at = zr_row_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == ']') {
            *count = i + 1;
            return at + 1;
        }
        if (*at != ',') return NULL;
    }
    return NULL;
}

static inline const char *zr_row_vec3(const char *at, const char *end, double limit, zr_vec3 *out)
{
    float v[3];
    int count = 0;
    at = zr_row_numbers(at, end, -limit, limit, 3, v, &count);
    if (!at || count != 3) return NULL;
    *out = (zr_vec3){v[0], v[1], v[2]};
    return at;
}

/* Three or four numbers; the fourth is 1 where it is not given. */
static inline const char *zr_row_vec4(const char *at, const char *end, double low, double high, zr_vec4 *out)
{
    float v[4];
    int count = 0;
    v[3] = 1.0f;
    at = zr_row_numbers(at, end, low, high, 4, v, &count);
    if (!at || count < 3) return NULL;
    *out = (zr_vec4){v[0], v[1], v[2], v[3]};
    return at;
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
