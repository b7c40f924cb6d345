/* options.h - api: structs that begin with struct_size, from callers of older and newer headers. */
#ifndef ZR_LIBRARY_OPTIONS_H
#define ZR_LIBRARY_OPTIONS_H

#include "api/zraster.h"
#include "base/status.h"

/* Copies a caller's struct; members after its struct_size become 0. Options may be NULL: all become 0. Fails with
 * ZR_BAD_REQUEST for a struct_size of 0, and for a larger struct whose further members are not 0. */
enum zr_status zr_options_read(const struct zraster_options *given, struct zraster_options *out,
                               struct zr_error *error);
enum zr_status zr_request_struct_read(const struct zraster_request *given, struct zraster_request *out,
                                      struct zr_error *error);

#endif
