/* schema.h - schema: JSON Schema 2020-12 of scenes, from the rows of keys (input/scene/json_objects.h).
 *
 * Values: a row's `schema`, else the kind of its reader (kinds.h), its object or its words. Bounds of numbers are those
 *         of the row; limits are the caller's. Rules of an object (struct zr_json_object) hold for its keys together.
 * Types:  an object whose keys belong to types (`of`) is a oneOf of closed objects, one for each word of its first key.
 *         The object of type "spot" of "light" is "spotLight".
 */
#ifndef ZR_SCHEMA_H
#define ZR_SCHEMA_H

#include "core.h"
#include "input/json/json_value.h"
#include "output/json/json_print.h"

/* Prints the schema of an object, or of a kind, with all that it refers to; NULL: a scene. `id`: its address, or NULL.
 * False if there is no such name, or without memory. */
bool zr_schema_print(struct zr_buffer *out, const struct zr_limits *limits, const char *name, const char *id);

/* Prints all objects and kinds as members of the open object, without examples: linters of OpenAPI misjudge those of
 * objects whose rules name keys. References begin with `refs`, "#/components/schemas/". */
void zr_schema_print_all(struct zr_print *print, const struct zr_limits *limits, const char *refs);

/* Returns the first letter of a meaning as a sentence has it: as it is in a name or a word of the contract, such as
 * "k1 to k6" or "opencv: ...". */
char zr_schema_first_letter(const char *meaning);

/* True if the schema of a row's value is known. */
bool zr_schema_has(const struct zr_json_field *field);

/* The objects, in the order of ZR_JSON_OBJECTS. */
extern const struct zr_json_object *const zr_schema_objects[];
extern const size_t zr_schema_object_count;

#endif
