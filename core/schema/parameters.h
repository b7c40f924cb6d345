/* parameters.h - schema: parameters of a query, as OpenAPI, from their rows (parameter_rows.h) and the keys that they
 * set. */
#ifndef ZR_CONTRACT_PARAMETERS_H
#define ZR_CONTRACT_PARAMETERS_H

#include "core.h"
#include "output/json/json_print.h"

/* Prints the list "parameters" as a member of the open object. */
void zr_parameters_print(struct zr_print *print, const struct zr_limits *limits);

#endif
