/* parameter_list.h - input: the parameters of a query as an array (parameter_rows.h). */
#ifndef ZR_PARAMETER_LIST_H
#define ZR_PARAMETER_LIST_H

#include <stddef.h>

#include "core.h"
#include "input/query/parameter_values.h"

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
