/* geometries.h - support: input of the rasterizer, made by hand, and drawn by each algorithm.
 *
 * Space:  snapped coordinates: 1/256 pixel, from the centre of pixel 0, 0.
 */
#ifndef ZR_TEST_GEOMETRIES_H
#define ZR_TEST_GEOMETRIES_H

#include "raster/binned_scene.h"
#include "raster/textbook/whole_window.h"

enum { TEST_RECORDS_MAX = 4096, TEST_SHAPES_MAX = 512, TEST_EDGES_MAX = 16384 };

/* Contains pointers to itself: do not copy. */
struct test_geometry {
    struct zr_geometry geometry;
    struct zr_window_vertex vertices[3 * TEST_RECORDS_MAX];
    struct zr_draw draws[TEST_RECORDS_MAX];
    uint32_t corners[3 * TEST_RECORDS_MAX], faces[TEST_RECORDS_MAX], traits[TEST_RECORDS_MAX];
    struct zr_shape shapes[TEST_SHAPES_MAX];
    struct zr_grid_edge edges[TEST_EDGES_MAX];
    bool in_shape;
    uint32_t first_of_shape; /* first triangle of the open shape */
};

struct test_corner {
    int32_t x, y;
    float z;
};

void geometry_clear(struct test_geometry *test);

/* Adds a triangle with the winding that the rasterizer requires. False if it has no area. */
bool geometry_add_triangle(struct test_geometry *test, const struct test_corner corners[3]);

/* Begins a shape: rings and triangles added before its end belong to it. */
void geometry_begin_shape(struct test_geometry *test);
void geometry_add_ring(struct test_geometry *test, const struct test_corner *corners, uint32_t count);
/* Ends the shape. False if it has no triangle: it is then removed. */
bool geometry_end_shape(struct test_geometry *test);

/* Returns a draw of `count` primitives of one kind, by three vertices each. */
struct zr_draw draw_of(enum zr_draw_kind kind, const uint32_t *corners, uint32_t count);

/* Draws by any algorithm, halfspace included, into samples of depth 1. Fails the running test on an error. */
struct zr_samples geometry_draw(struct zr_arena *arena, const struct test_geometry *test, enum zr_algorithm algorithm,
                                uint32_t width, uint32_t height);

/* True if the sample is inside the edges by the odd-even rule; counts edge by edge. */
bool edges_hold(const struct zr_grid_edge *edges, uint32_t count, int32_t x, int32_t y);

/* Returns the first sample that differs in depth (bit by bit) or owner; width * height: none. */
size_t samples_differ_at(const struct zr_samples *a, const struct zr_samples *b);

extern const char *const algorithm_words[ZR_ALGORITHM_COUNT];

#endif
