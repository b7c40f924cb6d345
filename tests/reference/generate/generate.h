/* generate.h - reference: random pictures, by kind.
 *
 * Each kind aims at one part of the arithmetic, and has a batch size of its own:
 * few large polygons or many small ones, so that overlap does not hide them all.
 * Never made, because the rules of llvmpipe do not cover them: infinity, NaN,
 * magnitudes of 1e30 and more, denormals, the vertex (0, 0, 0, 0).
 */
#ifndef ZR_TEST_GENERATE_H
#define ZR_TEST_GENERATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "reference/drawing.h"
#include "support/random.h"

enum windows {
    WINDOWS_ANY,
    WINDOWS_BINARY, /* sizes are powers of two, so that subpixel places are exact floats */
    WINDOWS_LARGE   /* more tiles than what touches few of them may touch */
};

struct generator {
    const char *name;
    bool clips; /* must make triangles that get clipped */
    bool wires; /* outlines, lines, points or layers: for the exact comparison alone */
    enum windows windows;
    void (*fill)(struct drawing *drawing, struct random *r);
};

extern const struct generator generators[];
extern const size_t generator_count;

/* Picture number `frame` of a kind. The same arguments give the same picture,
 * whatever was made before. */
void generate(const struct generator *generator, uint64_t seed, uint64_t frame, struct drawing *drawing);

/* ---- shared by the files of generators ---- */

/* C leaves open which argument of a call is evaluated first, so no expression
 * here may draw two numbers: compilers would make different pictures. */

/* Spread evenly over powers of two: 2^low <= result < 2^(high + 1). */
double random_power(struct random *r, int low, int high);
/* The same, of either sign. */
double random_signed_power(struct random *r, int low, int high);
/* A vertex at (x, y, z) in normalized device coordinates, with its w. */
uint32_t random_vertex(struct drawing *drawing, struct random *r, double x, double y, double z, double w);
/* One anywhere in the box given. */
uint32_t random_vertex_in(struct drawing *drawing, struct random *r, const double low[3], const double high[3],
                          double w);

/* generate_sizes.c: what the renderer does in different ways by size, alone and over one another. */
void fill_tiny(struct drawing *drawing, struct random *r);
void fill_layers(struct drawing *drawing, struct random *r);
void fill_crowd(struct drawing *drawing, struct random *r);
void fill_aligned_wide(struct drawing *drawing, struct random *r);
void fill_dense(struct drawing *drawing, struct random *r);
void fill_stamps(struct drawing *drawing, struct random *r);

/* generate_solid.c: polygons, coplanar duplicates, and scenes behind matrices. */
void fill_coplanar(struct drawing *drawing, struct random *r);
void fill_polygons(struct drawing *drawing, struct random *r);
void fill_polygons_clipped(struct drawing *drawing, struct random *r);
void fill_matrix_orthographic(struct drawing *drawing, struct random *r);
void fill_matrix_perspective(struct drawing *drawing, struct random *r);
void fill_matrix_any(struct drawing *drawing, struct random *r);

/* generate_lit.c */
void fill_lit(struct drawing *drawing, struct random *r);
void fill_lamps(struct drawing *drawing, struct random *r);
void fill_spots(struct drawing *drawing, struct random *r);

/* generate_layers.c */
void fill_blended(struct drawing *drawing, struct random *r);
void fill_masked(struct drawing *drawing, struct random *r);

/* generate_shapes.c: polygons of any shape, outlines, lines and points. */
void fill_shapes(struct drawing *drawing, struct random *r);
void fill_shapes_clipped(struct drawing *drawing, struct random *r);
void fill_outlines(struct drawing *drawing, struct random *r);
void fill_outlines_clipped(struct drawing *drawing, struct random *r);
void fill_hidden_lines(struct drawing *drawing, struct random *r);
void fill_lines(struct drawing *drawing, struct random *r);
void fill_points(struct drawing *drawing, struct random *r);
void fill_points_clipped(struct drawing *drawing, struct random *r);
void fill_lines_clipped(struct drawing *drawing, struct random *r);

#endif
