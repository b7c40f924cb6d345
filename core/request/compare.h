/* compare.h - request: compares two scenes that were read, and makes the answer. */
#ifndef ZR_COMPARE_H
#define ZR_COMPARE_H

#include "base/run.h"
#include "base/status.h"
#include "scene/scene.h"

struct zr_compare_answer {
    const char *json; /* ends with a line feed and a zero */
    size_t size;
    bool is_same;
};

/* Compares (measure/comparison.h). `query` may be NULL; its parameters are separated by "&":
 *   tolerance=LENGTH   both are the same if no place is farther from the other surface; at least 0
 *   precision=quick    fewer rays and points; else "full"
 *   align=none         b is moved before: bounds, principal or icp (measure/align.h)
 * Answer and scratch are in the arena. Fails with ZR_BAD_REQUEST for other parameters, or as zr_comparison_make. */
enum zr_status zr_compare(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                          const char *query, struct zr_compare_answer *answer);

#endif
