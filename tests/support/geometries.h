/* geometries.h - support: what the rasterizer takes, made by hand, and drawn by each algorithm.
 *
 * Space:  snapped coordinates: 1/256 pixel, from the centre of pixel 0, 0.
 */
#ifndef ZR_TEST_GEOMETRIES_H
#define ZR_TEST_GEOMETRIES_H

#include "raster/binned_scene.h"
#include "raster/whole_window.h"

enum { TEST_RECORDS_MAX = 4096, TEST_SHAPES_MAX = 512, TEST_EDGES_MAX = 16384 };

/* Points into itself: do not copy. */
struct test_geometry {
    struct zr_geometry geometry;
    struct zr_window_vertex vertices[3 * TEST_RECORDS_MAX];
    struct zr_draw draws[TEST_RECORDS_MAX];
    uint32_t corners[3 * TEST_RECORDS_MAX], faces[TEST_RECORDS_MAX], traits[TEST_RECORDS_MAX];
    struct zr_shape shapes[TEST_SHAPES_MAX];
    struct zr_grid_edge edges[TEST_EDGES_MAX];
    bool in_shape;
    uint32_t first_of_shape; /* triangle, of the shape under way */
};

struct test_corner {
    int32_t x, y;
    float z;
};

void geometry_clear(struct test_geometry *test);

/* Adds a triangle, turned the way that the rasterizer wants it. False where it has no area. */
bool geometry_add_triangle(struct test_geometry *test, const struct test_corner corners[3]);

/* Begins a shape: rings and records that are added then belong to it, until it is ended. */
void geometry_begin_shape(struct test_geometry *test);
void geometry_add_ring(struct test_geometry *test, const struct test_corner *corners, uint32_t count);
/* True where it has a record; else it is taken away again. */
bool geometry_end_shape(struct test_geometry *test);

/* A draw of `count` primitives of one kind, by their vertices, three each. */
struct zr_draw draw_of(enum zr_draw_kind kind, const uint32_t *corners, uint32_t count);

/* Draws by any algorithm, production's too, into samples that start at depth 1. Fails the running test
 * where that does not work. */
struct zr_samples geometry_draw(struct zr_arena *arena, const struct test_geometry *test, enum zr_algorithm algorithm,
                                uint32_t width, uint32_t height);

/* Whether the sample is inside of the edges by the odd-even rule, counted edge by edge. */
bool edges_hold(const struct zr_grid_edge *edges, uint32_t count, int32_t x, int32_t y);

/* The first sample where two differ in depth (bit by bit) or owner; width * height: none. */
size_t samples_differ_at(const struct zr_samples *a, const struct zr_samples *b);

extern const char *const algorithm_words[ZR_ALGORITHM_COUNT];

#endif
