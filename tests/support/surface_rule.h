/* surface_rule.h - support: rule 23a, in double: which samples of a pixel are one surface, and its values.
 *
 * Values over w and 1/w are linear in the window. So those of a primitive at the middle of its samples are the means of
 * both over the samples, divided.
 */
#ifndef ZR_TEST_SURFACE_RULE_H
#define ZR_TEST_SURFACE_RULE_H

#include <stdbool.h>
#include <stdint.h>

enum { SURFACE_SIDE = 4, SURFACE_SAMPLES = SURFACE_SIDE * SURFACE_SIDE };

/* A sample. `normal`: of the visible side, of any length; 0 of lines. `way`: from the eye. */
struct surface_sample {
    uint32_t primitive; /* 0: uncovered */
    uint32_t material;
    const float *base, *normal, *way;
    double over_w; /* 1/w */
};

/* A primitive, or those that joined it. */
struct surface {
    uint32_t primitive, material;
    uint32_t first, samples; /* the nearest to the middle of the pixel; all, a bit each */
    double count, w;         /* w: its own */
    double base[3], normal[3], way[3];
};

struct surface_pixel {
    uint32_t count;
    struct surface surfaces[SURFACE_SAMPLES];
    bool is_undecided; /* floats may decide otherwise */
};

/* Finds the surfaces of a pixel. Sample i is of column i % 4 and row i / 4, counted from the lowest. A length at a
 * point covers length * scale / w pixels. */
void surface_pixel_find(const struct surface_sample samples[SURFACE_SAMPLES], double scale,
                        struct surface_pixel *pixel);

#endif
