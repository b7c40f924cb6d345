/* json_value.h - input: reads the next value with checks, and objects by tables of fields.
 *
 * Readers: take one value, right or wrong. On a fault they report ZR_BAD_SCENE with a JSON Pointer, leave *out
 *          unchanged and return false. The caller may continue, so that up to ZR_ERROR_ITEMS faults are reported at
 *          once. The comment of a reader begins with the type of *out.
 * Memory:  if the arena fails, a value may stay unread; reading stops at the next item or member.
 */
#ifndef ZR_JSON_VALUE_H
#define ZR_JSON_VALUE_H

#include <stdint.h>

#include "base/vec.h"
#include "input/json/json_table.h"

/* Reports that `what` was expected and the next value found, skips that value and returns false. */
bool zr_json_expect(struct zr_json *json, const struct zr_json_path *path, const char *what);

/* ---- objects ---- */

/* Reads an object into *out, in the order of the text, and sets bit i of *given if field i is present. Reports unknown,
 * unsupported, repeated and missing keys and broken rules, and still reads the others. False only if the next value is
 * no object. */
bool zr_json_fields(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                    void *out, uint64_t *given);

/* ---- values; `field` is path->field ---- */

/* const char *: the first byte of the value, which is skipped for a later reader. */
zr_json_read_fn zr_json_value_start;

/* double, float: finite numbers, field->low <= value <= field->high. */
zr_json_read_fn zr_json_number, zr_json_float;
bool zr_json_number_in(struct zr_json *json, const struct zr_json_path *path, double low, double high, double *out);

/* float.
 * Length: magnitude <= 1000 * coordinate_max, enough for a camera that shows a scene of the full size.
 * Positive: a length > 0, also after rounding to float.
 * Coordinate: magnitude <= coordinate_max. */
enum { ZR_JSON_LENGTHS_PER_COORDINATE = 1000 };
zr_json_read_fn zr_json_length, zr_json_positive, zr_json_coordinate;

/* uint32_t: an integer, 0..UINT32_MAX. */
zr_json_read_fn zr_json_whole;

/* Reads an integer below `count`, which is UINT32_MAX if the count is not known yet. `of` names the counted things
 * ("positions"). */
bool zr_json_index(struct zr_json *json, const struct zr_json_path *path, uint32_t count, const char *of,
                   uint32_t *out);

/* Checks a number as zr_json_number_in and zr_json_index do. */
bool zr_json_check_range(struct zr_json *json, const struct zr_json_path *path, double low, double high, double value);
bool zr_json_check_index(struct zr_json *json, const struct zr_json_path *path, double value, uint32_t count,
                         const char *of);

/* Reports an index that is no integer below `count`; returns false. */
bool zr_json_bad_index(struct zr_json *json, const struct zr_json_path *path, double value, uint32_t count,
                       const char *of);

zr_json_read_fn zr_json_bool;   /* bool */
zr_json_read_fn zr_json_flag;   /* int: 0 or 1 */
zr_json_read_fn zr_json_string; /* const char *, in the arena */
zr_json_read_fn zr_json_choice; /* int: the index of a supported word of field->words */
bool zr_json_choice_of(struct zr_json *json, const struct zr_json_path *path, const struct zr_names *words, int *out);

zr_json_read_fn zr_json_float2;   /* float[2], from field->low to field->high */
zr_json_read_fn zr_json_vec3;     /* zr_vec3 */
zr_json_read_fn zr_json_vec4;     /* zr_vec4 */
zr_json_read_fn zr_json_position; /* zr_vec4: three coordinates with w = 1, or four; minus json->move */
zr_json_read_fn zr_json_doubles3; /* double[3]: coordinates */
zr_json_read_fn zr_json_place3;   /* double[3]: a place, within zr_recenter_limit, as in files */
zr_json_read_fn zr_json_place;    /* zr_vec3: a place in world space, minus the origin of json->far */

/* zr_vec4: [r,g,b] or [r,g,b,a], each 0..1, or a text for zr_color_of_text; the default of alpha is 1. */
zr_json_read_fn zr_json_color;
zr_json_read_fn zr_json_opaque; /* colour with an alpha of 1 */

/* A list of `least` to `most` numbers, each within low..high. */
struct zr_json_row {
    size_t least, most;
    double low, high;
};

/* Reads such a list. *count: its length; `count` may be NULL if least == most. */
bool zr_json_numbers(struct zr_json *json, const struct zr_json_path *path, struct zr_json_row row, double *out,
                     size_t *count);

/* True if the next value is a list; else reports it. */
bool zr_json_list(struct zr_json *json, const struct zr_json_path *path);

/* Counts the items of the next value, a list, without consuming it. False if it is no list or reading stops. */
bool zr_json_count(struct zr_json *json, const struct zr_json_path *path, size_t *count);

/* Makes a zeroed array for the items of the next value, a list of at most `most` things of `size` bytes each, and enters
 * the list. NULL if it is no list, has more of them ("9 lights; up to 8 are allowed"), or there is no memory. */
void *zr_json_enter_list(struct zr_json *json, const struct zr_json_path *path, const char *things, size_t most,
                         size_t size, size_t *count);

#endif
