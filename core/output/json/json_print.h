/* json_print.h - output: prints JSON value by value, without blanks.
 *
 *     zr_print_begin(&print, NULL, '{');
 *     zr_print_count(&print, "faces", 12);
 *     zr_print_end(&print, '}');                    {"faces":12}
 *
 * Each value of an object has a key; keys are ASCII and printed as they are. Values of lists have the key NULL. The
 * text is the same for every LC_NUMERIC. A failed allocation is recorded in the buffer's arena.
 */
#ifndef ZR_JSON_PRINT_H
#define ZR_JSON_PRINT_H

#include <stdint.h>

#include "base/vec.h"
#include "output/bytes/buffer.h"

struct zr_print {
    struct zr_buffer *out;
    bool needs_comma; /* a value precedes in the open object or list */
};

/* Open and close an object or a list. */
void zr_print_begin(struct zr_print *print, const char *key, char bracket);
void zr_print_end(struct zr_print *print, char bracket);

/* Escapes quotes, backslashes and control characters; other bytes of the UTF-8 text stay as they are. */
void zr_print_string(struct zr_print *print, const char *key, const char *text);

void zr_print_bool(struct zr_print *print, const char *key, bool value);
void zr_print_count(struct zr_print *print, const char *key, uint64_t count);
void zr_print_integer(struct zr_print *print, const char *key, int64_t value);

/* Prints the shortest of the decimals with 6 to 9 digits that reads back as the same float, as "%g" formats it. The
 * value is finite. */
void zr_print_float(struct zr_print *print, const char *key, float value);

/* Prints a double with 6 to 17 digits. */
void zr_print_double(struct zr_print *print, const char *key, double value);

/* Prints a text that is a JSON value. */
void zr_print_json(struct zr_print *print, const char *key, const char *json);

/* Prints the members of a text that is an object, "{...}", into the open object. */
void zr_print_members(struct zr_print *print, const char *object);

/* Prints null. */
void zr_print_null(struct zr_print *print, const char *key);

/* Print lists of numbers. */
void zr_print_doubles(struct zr_print *print, const char *key, const double *values, int count);
void zr_print_floats(struct zr_print *print, const char *key, const float *values, int count);
void zr_print_vec3(struct zr_print *print, const char *key, zr_vec3 v);

/* Prints a place plus `moved`, three numbers, in doubles; NULL: as zr_print_vec3. */
void zr_print_place(struct zr_print *print, const char *key, zr_vec3 v, const double *moved);

#endif
