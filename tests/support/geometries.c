#include "support/geometries.h"

#include <string.h>

#include "base/run.h"
#include "support/cmocka_all.h"

const char *const algorithm_words[ZR_ALGORITHM_COUNT] = {"halfspace", "edgelist", "trapezoid", "scanline", "painter"};

void geometry_clear(struct test_geometry *test)
{
    test->geometry = (struct zr_geometry){
        .vertices = test->vertices, .draws = test->draws, .shapes = test->shapes, .edges = test->edges};
    test->draws[0] = (struct zr_draw){.count = 0};
    test->in_shape = false;
}

struct zr_draw draw_of(enum zr_draw_kind kind, const uint32_t *corners, uint32_t count)
{
    static const struct zr_material material = {.double_sided = true};
    return (struct zr_draw){.kind = kind, .counted = true, .material = &material, .corners = corners, .count = count};
}

static uint32_t add_vertex(struct test_geometry *test, struct test_corner corner)
{
    uint32_t number = test->geometry.vertex_count++;
    test->vertices[number] = (struct zr_window_vertex){.x = (float)corner.x / ZR_SUBPIXELS + 0.5f,
                                                       .y = (float)corner.y / ZR_SUBPIXELS + 0.5f,
                                                       .z = corner.z,
                                                       .oow = 1};
    return number;
}

/* To the last draw, where that is of the same kind. */
static void append(struct test_geometry *test, uint32_t number)
{
    struct zr_geometry *geometry = &test->geometry;
    const enum zr_draw_kind kind = test->in_shape ? ZR_DRAW_SHAPES : ZR_DRAW_TRIANGLES;
    geometry->primitive_count++;
    if (geometry->draw_count > 0 && test->draws[geometry->draw_count - 1].kind == kind) {
        test->draws[geometry->draw_count - 1].count++;
        return;
    }
    struct zr_draw *draw = &test->draws[geometry->draw_count++];
    *draw = draw_of(kind, test->corners + 3 * number, 1);
    draw->first = number;
    draw->faces = test->faces + number;
    draw->traits = test->in_shape ? test->traits + number : NULL;
}

bool geometry_add_triangle(struct test_geometry *test, const struct test_corner corners[3])
{
    int64_t dx01 = corners[0].x - corners[1].x, dy01 = corners[0].y - corners[1].y, dx20 = corners[2].x - corners[0].x,
            dy20 = corners[2].y - corners[0].y;
    int64_t area = dx01 * dy20 - dx20 * dy01;
    if (area == 0) return false;
    const uint32_t number = test->geometry.primitive_count;
    assert_true(number < TEST_RECORDS_MAX);
    for (int k = 0; k < 3; k++)
        test->corners[3 * number + (uint32_t)k] = add_vertex(test, corners[area > 0 ? k : 2 - k]);
    test->faces[number] = number;
    test->traits[number] = test->in_shape ? 2 * (test->geometry.shape_count - 1) : 0;
    append(test, number);
    return true;
}

void geometry_begin_shape(struct test_geometry *test)
{
    assert_true(test->geometry.shape_count < TEST_SHAPES_MAX);
    test->in_shape = true;
    test->first_of_shape = test->geometry.primitive_count;
    test->shapes[test->geometry.shape_count++] = (struct zr_shape){.first_edge = test->geometry.edge_count,
                                                                   .min_x = INT32_MAX,
                                                                   .min_y = INT32_MAX,
                                                                   .max_x = INT32_MIN,
                                                                   .max_y = INT32_MIN};
}

void geometry_add_ring(struct test_geometry *test, const struct test_corner *corners, uint32_t count)
{
    struct zr_shape *shape = &test->shapes[test->geometry.shape_count - 1];
    for (uint32_t i = 0; i < count; i++) {
        const struct test_corner *a = &corners[i], *b = &corners[(i + 1) % count];
        struct zr_grid_edge edge;
        assert_true(test->geometry.edge_count < TEST_EDGES_MAX);
        if (zr_grid_edge_make(a->x, a->y, b->x, b->y, &edge)) test->edges[test->geometry.edge_count++] = edge;
        if (a->x < shape->min_x) shape->min_x = a->x;
        if (a->x > shape->max_x) shape->max_x = a->x;
        if (a->y < shape->min_y) shape->min_y = a->y;
        if (a->y > shape->max_y) shape->max_y = a->y;
    }
}

bool geometry_end_shape(struct test_geometry *test)
{
    struct zr_geometry *geometry = &test->geometry;
    struct zr_shape *shape = &test->shapes[geometry->shape_count - 1];
    shape->edge_count = geometry->edge_count - shape->first_edge;
    shape->triangle_count = geometry->primitive_count - test->first_of_shape;
    test->in_shape = false;
    if (shape->triangle_count > 0) return true;
    geometry->edge_count = shape->first_edge;
    geometry->shape_count--;
    return false;
}

static enum zr_status draw_tiles(struct zr_arena *arena, const struct zr_geometry *geometry, struct zr_samples *samples)
{
    struct zr_binned_scene visible;
    struct zr_tile tile;
    size_t pixels = (size_t)samples->width * samples->height;
    samples->depth = zr_arena_alloc(arena, pixels, sizeof *samples->depth);
    samples->owner = zr_arena_alloc(arena, pixels, sizeof *samples->owner);
    enum zr_status status = zr_binned_scene_make(&(struct zr_run){.arena = arena}, geometry, NULL, samples->width,
                                                 samples->height, NULL, &visible);
    for (uint32_t t = 0; status == ZR_OK && t < zr_tile_count(samples->width, samples->height); t++) {
        zr_visibility_tile(&visible.visibility, t, NULL, &tile);
        if (!tile.is_empty) visible.halfspace->flush(&tile);
        for (int32_t y = 0; y < tile.height; y++)
            for (int32_t x = 0; x < tile.width; x++) {
                size_t i = (size_t)(tile.y + y) * samples->width + (size_t)(tile.x + x);
                samples->depth[i] = tile.is_empty ? 1.0f : tile.depth[y * ZR_TILE_STRIDE + x];
                samples->owner[i] = tile.is_empty ? 0 : tile.owner[y * ZR_TILE_STRIDE + x];
            }
    }
    return status;
}

struct zr_samples geometry_draw(struct zr_arena *arena, const struct test_geometry *test, enum zr_algorithm algorithm,
                                uint32_t width, uint32_t height)
{
    struct zr_samples samples = {.width = width, .height = height};
    zr_visibility_fn *visibility = zr_visibility_of(algorithm);
    enum zr_status status = visibility ? zr_visibility_window(&(struct zr_run){.arena = arena}, &test->geometry,
                                                              visibility, width, height, NULL, &samples)
                                       : draw_tiles(arena, &test->geometry, &samples);
    assert_int_equal(status, ZR_OK);
    return samples;
}

bool edges_hold(const struct zr_grid_edge *edges, uint32_t count, int32_t x, int32_t y)
{
    int64_t px = (int64_t)x * 256, py = (int64_t)y * 256;
    bool inside = false;
    for (uint32_t i = 0; i < count; i++) {
        int64_t x0 = edges[i].x0, y0 = edges[i].y0, x1 = edges[i].x1, y1 = edges[i].y1;
        if (y0 <= py && py < y1 && (x1 - x0) * (py - y0) <= (px - x0) * (y1 - y0)) inside = !inside;
    }
    return inside;
}

size_t samples_differ_at(const struct zr_samples *a, const struct zr_samples *b)
{
    size_t i = 0, pixels = (size_t)a->width * a->height;
    while (i < pixels && a->owner[i] == b->owner[i] && memcmp(&a->depth[i], &b->depth[i], sizeof a->depth[i]) == 0)
        i++;
    return i;
}
