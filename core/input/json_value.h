/* json_value.h - input: the next value of a text -> a checked value, or a complaint with a JSON Pointer to it; and the
 * tables of fields by which objects are read.
 *
 * Every reader takes one value, right or wrong, and returns false after reporting ZR_BAD_SCENE, so that whoever calls
 * it may go on with what else is there and report up to ZR_ERROR_ITEMS faults at once. *out is untouched then. Where
 * memory fails, a value may stay unread: reading stops at the next item or member.
 */
#ifndef ZR_JSON_VALUE_H
#define ZR_JSON_VALUE_H

#include <stdint.h>

#include "base/vec.h"
#include "input/json.h"
#include "input/names.h"

/* Where a reader is: a chain of links on the stack, written out (RFC 6901) only
 * when something is wrong. `key` is NULL for an item of a list. */
struct zr_json_path {
    const struct zr_json_path *parent; /* NULL: the root */
    const char *key;
    size_t index;
};

#define ZR_JSON_KEY(parent, key)    (&(const struct zr_json_path){(parent), (key), 0})
#define ZR_JSON_ITEM(parent, index) (&(const struct zr_json_path){(parent), NULL, (index)})

/* ---- complaints ---- */

/* Reports ZR_BAD_SCENE at `path` (NULL: the root); returns false. Once the arena has failed nothing is reported: what
 * could not be kept looks as if the scene lacked it. Of a part that is read ahead it is the end. */
bool zr_json_fault(struct zr_json *json, const struct zr_json_path *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Reports that `what` was expected and the next value found, and skips it; returns false. */
bool zr_json_expect(struct zr_json *json, const struct zr_json_path *path, const char *what);

/* ---- objects ---- */

struct zr_json_field;
struct zr_json_object;
typedef bool zr_json_read_fn(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                             void *out);

/* One key of an object. */
struct zr_json_field {
    const char *key;
    zr_json_read_fn *read; /* NULL: of a later version */
    size_t offset;         /* of what is read, in what the object fills */
    double low, high;      /* of a number */
    const struct zr_names *words;
    const struct zr_json_object *object; /* of the value, or of the items of a list; NULL: it has none */
    bool required;                       /* those that are come first in their table */
    const char *unit, *otherwise, *text; /* for people: the unit, what holds where the key is not given, what it is */
};

/* All keys of a kind of object, up to 64; the first is one that is read. */
struct zr_json_object {
    const char *name;
    size_t count;
    const struct zr_json_field *fields;
};
#define ZR_JSON_OBJECT_OF(name, fields)                                                                                \
    {                                                                                                                  \
        (name), sizeof(fields) / sizeof((fields)[0]), (fields)                                                         \
    }

/* Reads an object into *out, in the order of the text; *given gets a bit for each field that is there. Unknown,
 * unsupported, repeated and missing keys are reported, and what is known is still read: false only where the next
 * value is no object. */
bool zr_json_fields(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                    void *out, uint64_t *given);

static inline bool zr_json_gives(uint64_t given, int field)
{
    return given >> field & 1u;
}

/* ---- values, as fields or without one: `field` may be NULL where nothing is said of it ---- */

/* const char *: where the value begins. It is skipped, and read later. */
zr_json_read_fn zr_json_place;

/* double, float: finite numbers, field->low <= value <= field->high. */
zr_json_read_fn zr_json_number, zr_json_float;
bool zr_json_number_in(struct zr_json *json, const struct zr_json_path *path, double low, double high, double *out);

/* float. A length, which is no place: magnitude <= 1000 * coordinate_max, so that scenes of the full size can be seen
 * whole; a length > 0, still > 0 as a float; a place along an axis: magnitude <= coordinate_max. */
zr_json_read_fn zr_json_length, zr_json_positive, zr_json_coordinate;

/* uint32_t: a whole number, 0..UINT32_MAX. */
zr_json_read_fn zr_json_whole;

/* A whole number below `count`, which is UINT32_MAX where nobody knows it yet; `of` names what is counted
 * ("positions"). */
bool zr_json_index(struct zr_json *json, const struct zr_json_path *path, uint32_t count, const char *of,
                   uint32_t *out);

/* Of a number that is none. */
bool zr_json_bad_index(struct zr_json *json, const struct zr_json_path *path, double value, uint32_t count,
                       const char *of);

zr_json_read_fn zr_json_bool;   /* bool */
zr_json_read_fn zr_json_flag;   /* int: 0 or 1 */
zr_json_read_fn zr_json_string; /* const char *, in the arena */
zr_json_read_fn zr_json_choice; /* int: the index of one of field->words, below its count */

zr_json_read_fn zr_json_vec3;     /* zr_vec3 */
zr_json_read_fn zr_json_vec4;     /* zr_vec4 */
zr_json_read_fn zr_json_position; /* zr_vec4: three coordinates, and w = 1; or four */

/* zr_vec4: [r,g,b] or [r,g,b,a] of 0..1, or what zr_color_of_text reads; alpha 1 where not given. */
zr_json_read_fn zr_json_color;

zr_json_read_fn zr_json_mat4;   /* zr_mat4: four rows of four numbers, or sixteen numbers column by column */
zr_json_read_fn zr_json_affine; /* zr_mat4 that keeps points points: its bottom row is 0 0 0 1 */

/* `least` to `most` numbers, each within low..high; *count of them were there. */
bool zr_json_numbers(struct zr_json *json, const struct zr_json_path *path, size_t least, size_t most, double low,
                     double high, double *out, size_t *count);

/* A matrix of so many rows and columns, magnitudes up to `limit`, in the order of the text: rows, or, where it is not
 * *nested, all numbers in one list. */
bool zr_json_square(struct zr_json *json, const struct zr_json_path *path, size_t side, double limit, double *out,
                    bool *nested);

/* A list; reported where the next value is something else. */
bool zr_json_list(struct zr_json *json, const struct zr_json_path *path);

/* How many items the list has that is next, which stays the next value; fewer where reading stops. */
bool zr_json_count(struct zr_json *json, const struct zr_json_path *path, size_t *count);

#endif
