/* parameter_values.h - input: the parameters of a query as an array (parameter_rows.h); checks their values and writes
 * them as JSON. */
#ifndef ZR_PARAMETER_VALUES_H
#define ZR_PARAMETER_VALUES_H

#include "core.h"
#include "input/json/json_value.h"
#include "input/json/json_writer.h"
#include "parameter_kinds.h"

enum zr_parameter_kind {
#define KIND(ID, ...) ZR_PARAMETER_##ID,
    ZR_PARAMETER_KINDS(KIND)
#undef KIND
};

/* A parameter, and the key that it sets. */
struct zr_parameter {
    const char *name;
    enum zr_parameter_kind kind;
    const struct zr_json_field *field;
    const struct zr_limits *limits;
    struct zr_error *error;
};

/* Most bytes of JSON for a value, beside six for each byte of its text. */
enum { ZR_PARAMETER_ROOM = 512 };

/* Writes the value as JSON; false after reporting. */
bool zr_parameter_put(const struct zr_parameter *parameter, const char *text, struct zr_json_writer *json);

/* Bodies that a parameter applies to. */
enum zr_parameter_scope { ZR_PARAMETER_OF_ANY, ZR_PARAMETER_OF_MESH };

struct zr_parameter_row {
    const char *name, *pointer;
    enum zr_parameter_scope scope;
    enum zr_parameter_kind kind;
    size_t offset; /* of its text, a const char * in struct zr_request */
};

extern const struct zr_parameter_row zr_parameter_list[];
extern const int zr_parameter_count;

/* Returns the text of a parameter in a request; NULL if it is not given. */
const char *zr_parameter_text(const struct zr_request *request, const struct zr_parameter_row *row);

#endif
