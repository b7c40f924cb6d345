/* compare.h - request: compares two scenes that were read, and makes the answer. */
#ifndef ZR_COMPARE_H
#define ZR_COMPARE_H

#include "base/run.h"
#include "base/status.h"
#include "scene/scene.h"

struct zr_kept; /* input/scene/kept.h */

struct zr_compare_answer {
    const char *json; /* ends with a line feed and a zero */
    size_t size;
    bool is_same;
    struct zr_kept *scene; /* that show= asks for; NULL: none */
};

/* Returns true if a parameter, "name=value" or more behind it, is one of zr_compare. */
bool zr_compare_has_parameter(const char *text);

/* Predicts the processor time of comparing, on the reference machine, ms: within a factor of three for usual models. */
double zr_compare_cost_ms(const struct zr_scene *a, const struct zr_scene *b, const char *query);

/* Compares (measure/comparison.h). `query` may be NULL; its parameters are separated by "&":
 *   tolerance=LENGTH   both are the same if no place is farther from the other surface; at least 0
 *   precision=quick    fewer rays and points; else "full"
 *   deviation=off      without distances between the surfaces; else "on". Both are then the same if they are closed and
 *                      share their whole volume
 *   features=off       without holes that differ; else "on"
 *   align=none         b is moved before: bounds, principal or icp (measure/align.h)
 *   rescale=on         the alignment may scale; else "off"
 *   show=difference    makes a scene, too: deviation or side (request/compare_scene.h); else "none"
 *   look=NAME          look of that scene; "studio"
 *   view=PRESET        its camera, such as front
 * The scene is in run->arena, which may be NULL without `show`; all else is in run->scratch. Fails with
 * ZR_BAD_REQUEST for other parameters, or as zr_comparison_make. */
enum zr_status zr_compare(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                          const char *query, struct zr_compare_answer *answer);

#endif
