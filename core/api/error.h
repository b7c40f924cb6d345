/* error.h - api: faults of a call, for its caller. */
#ifndef ZR_LIBRARY_ERROR_H
#define ZR_LIBRARY_ERROR_H

#include "api/zraster.h"
#include "base/status.h"

/* Ends a call: sets *out, unless `out` is NULL, to NULL for ZR_OK, else to a copy of the faults, or to a static error
 * if there is no memory for one. Returns the status for the caller. `faults` may have none. */
zraster_status zr_error_give(enum zr_status status, const struct zr_error *faults, zraster_error **out);

#endif
