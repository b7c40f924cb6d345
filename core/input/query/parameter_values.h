/* parameter_values.h - input: checks values of parameters and writes them as JSON. */
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

#endif
