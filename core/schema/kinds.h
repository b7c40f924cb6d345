/* kinds.h - schema: kinds of values that several keys share, as JSON Schema. */
#ifndef ZR_CONTRACT_KINDS_H
#define ZR_CONTRACT_KINDS_H

#include "core.h"
#include "input/json/json_value.h"
#include "output/json/json_print.h"

/* Number of the kinds, and the name of kind i. */
extern const size_t zr_kind_count;
const char *zr_kind_name(size_t i);

/* Prints the schema of kind i as a member of the open object. */
void zr_kind_print(struct zr_print *print, size_t i, const struct zr_limits *limits);

/* Returns the name of the kind that a shared reader reads, or NULL. */
const char *zr_kind_of(zr_json_read_fn *read);

#endif
