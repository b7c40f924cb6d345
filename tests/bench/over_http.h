/* over_http.h - bench: a drawing, sent to a real daemon as JSON and received as a picture. */
#ifndef ZR_BENCH_OVER_HTTP_H
#define ZR_BENCH_OVER_HTTP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "reference/drawing.h"
#include "server/client.h"

/* Milliseconds, as the daemon told them in Server-Timing; `total` as seen from here. */
struct http_times {
    double total, parse, queue, render, encode;
};

/* The drawing as scene JSON, every float in full: unlit smooth colours, both sides drawn,
 * outputs color and windowDepth. NULL where memory is short; free it. */
char *scene_json(const struct drawing *drawing);

/* POSTs `json` and takes the answer apart. rgba and depth (row 0 on top) are malloc'd;
 * either pointer may be NULL. False, explained on stderr, on anything but a good answer. */
bool render_over_http(const struct daemon *daemon, const char *json, uint32_t width, uint32_t height, uint8_t **rgba,
                      float **depth, struct http_times *times);

#endif
