/* parameters.h - client: parameters of the query. Each one is an option: doubleSided is --double-sided. */
#ifndef PARAMETERS_H
#define PARAMETERS_H

#include <stdbool.h>

#include "parameter_rows.h"

enum parameter {
#define PARAMETER_ENUM(name, ...) PARAMETER_##name,
    ZR_PARAMETER_ROWS(PARAMETER_ENUM)
#undef PARAMETER_ENUM
        PARAMETER_COUNT
};
struct parameter_row {
    const char *name;
    const char *pointer; /* of the key of a scene; under /query: there is none */
    bool of_mesh;        /* for meshes only */
    const char *value;   /* placeholder; in brackets: may be omitted, which means true */
    const char *help;
};
extern const struct parameter_row parameter_rows[PARAMETER_COUNT];

char parameter_letter(enum parameter parameter); /* 0: none */

struct command;

/* Returns true if a command has the option of a parameter. */
bool options_has_parameter(const struct command *command, enum parameter parameter);

#endif
