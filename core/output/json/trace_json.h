/* trace_json.h - output: prints the channel trace, the steps of a hidden-surface algorithm. */
#ifndef ZR_TRACE_JSON_H
#define ZR_TRACE_JSON_H

#include "base/cancel.h"
#include "base/status.h"
#include "output/bytes/buffer.h"
#include "raster/textbook/trace.h"

/* Prints all values of the trace. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_trace_json_write(const struct zr_trace *trace, const struct zr_cancel *cancel, struct zr_buffer *out);

#endif
