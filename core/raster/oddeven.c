#include "raster/oddeven.h"

#include "base/mutant.h"
#include "raster/setup.h"

_Static_assert(ZR_TILE_SIZE == 64, "a row of flags is a uint64_t");

struct flags {
    uint64_t rows[ZR_TILE_SIZE]; /* bit i: column i */
};

/* ---- coverage ---- */

/* Returns the first pixel whose centre is not left of the edge in row y. */
static int64_t crossing(const struct zr_grid_edge *e, int64_t y)
{
    int64_t rise = (int64_t)e->y1 - e->y0, run = (int64_t)e->x1 - e->x0;
    int64_t numerator = e->x0 * rise + run * (y * ZR_SUBPIXELS - e->y0), step = rise * ZR_SUBPIXELS;
    int64_t quotient = numerator / step;
    const int64_t start = quotient * step;
    return ZR_MUTANT(right_edges_inside, start < numerator, start <= numerator) ? quotient + 1 : quotient;
}

/* Flips the samples right of an edge. Most edges of a large polygon lie beside the tile: only those through it need a
 * division. */
static void flip(const struct zr_tile *tile, const struct zr_grid_edge *e, struct flags *flags)
{
    int32_t left = tile->x * ZR_SUBPIXELS, right = (tile->x + ZR_TILE_SIZE - 1) * ZR_SUBPIXELS;
    if (e->x0 > right && e->x1 > right) return;
    bool whole = e->x0 <= left && e->x1 <= left;
    int32_t begin = zr_viewport_first_centre(e->y0), end = zr_viewport_first_centre(e->y1);
    if (begin < tile->y) begin = tile->y;
    if (end > tile->y + tile->height) end = tile->y + tile->height;
    for (int32_t y = begin; y < end; y++) {
        int64_t column = whole ? 0 : crossing(e, y) - tile->x;
        if (column < ZR_TILE_SIZE) flags->rows[y - tile->y] ^= ~UINT64_C(0) << (column > 0 ? column : 0);
    }
}

static void cover(const struct zr_primitive *primitive, const struct zr_tile *tile, struct flags *flags)
{
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    uint64_t columns = tile->width < ZR_TILE_SIZE ? (UINT64_C(1) << tile->width) - 1 : ~UINT64_C(0);
    *flags = (struct flags){{0}};
    for (uint32_t i = 0; i < primitive->edge_count; i++)
        flip(tile, &edges[i], flags);
    for (int32_t row = 0; row < tile->height; row++)
        flags->rows[row] &= columns;
}

/* ---- depth ---- */

static int32_t lowest(uint64_t bits)
{
    return __builtin_ctzll(bits);
}

/* Stores the depth and owner of a single triangle at all flagged samples. */
static void put_all(const struct zr_depth *depth, uint32_t owner, const struct flags *flags, struct zr_tile *tile)
{
    for (int32_t row = 0; row < tile->height; row++)
        for (uint64_t bits = flags->rows[row]; bits; bits &= bits - 1) {
            int32_t x = tile->x + lowest(bits), y = tile->y + row;
            zr_tile_put(tile, x, y, zr_depth_at(depth, x, y), owner);
        }
}

/* Returns the bits of columns first..last of a tile, both within it. */
static uint64_t column_bits(int32_t first, int32_t last)
{
    return (~UINT64_C(0) << first) & (~UINT64_C(0) >> (ZR_TILE_SIZE - 1 - last));
}

/* Stores the depth and owner of one of a shape's triangles at the flagged samples that it covers, and clears their
 * flags. */
static void put_triangle(const struct zr_setup *setup, uint32_t owner, struct flags *flags, struct zr_tile *tile)
{
    int32_t x0 = setup->min_x > tile->x ? setup->min_x - tile->x : 0,
            x1 = setup->max_x < tile->x + tile->width ? setup->max_x - tile->x : tile->width - 1;
    int32_t y0 = setup->min_y > tile->y ? setup->min_y - tile->y : 0,
            y1 = setup->max_y < tile->y + tile->height ? setup->max_y - tile->y : tile->height - 1;
    if (x0 > x1) return;
    uint64_t columns = column_bits(x0, x1);
    for (int32_t row = y0; row <= y1; row++)
        for (uint64_t bits = flags->rows[row] & columns; bits; bits &= bits - 1) {
            int32_t column = lowest(bits), x = tile->x + column, y = tile->y + row;
            if (!zr_setup_covers(setup, x, y)) continue;
            flags->rows[row] &= ZR_MUTANT(last_triangle_decides, ~(UINT64_C(1) << column), ~UINT64_C(0));
            zr_tile_put(tile, x, y, zr_depth_at(&setup->depth, x, y), owner);
        }
}

static bool any_flag(const struct flags *flags)
{
    uint64_t any = 0;
    for (int row = 0; row < ZR_TILE_SIZE; row++)
        any |= flags->rows[row];
    return any != 0;
}

/* Stores the remaining samples, which no triangle covers since the polygon is clipped or its triangles are thin.
 * Processes runs of samples at once. */
static void put_rest(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                     const struct flags *flags, struct zr_tile *tile)
{
    struct zr_hit hits[ZR_TILE_SIZE];
    for (int32_t row = 0; row < tile->height; row++)
        for (uint64_t bits = flags->rows[row]; bits;) {
            int32_t begin = lowest(bits), count = 1;
            while (begin + count < ZR_TILE_SIZE && bits >> (begin + count) & 1u)
                count++;
            bits &= ~column_bits(begin, begin + count - 1);
            int32_t x = tile->x + begin, y = tile->y + row;
            zr_primitive_hits(geometry, primitive, y, x, x + count, hits);
            for (int32_t i = 0; i < count; i++)
                zr_tile_put(tile, x + i, y, hits[i].depth, hits[i].owner);
        }
}

void zr_oddeven_draw(const struct zr_geometry *geometry, const struct zr_primitive *primitive, struct zr_tile *tile)
{
    struct flags flags;
    cover(primitive, tile, &flags);
    if (primitive->count == 1) {
        put_all(&primitive->depth, primitive->first + 1, &flags, tile);
        return;
    }
    for (uint32_t number = primitive->first; number < primitive->first + primitive->count; number++) {
        const struct zr_triangle triangle = zr_primitive_triangle(geometry, primitive, number);
        int32_t box[4];
        zr_setup_box(geometry->vertices, &triangle, box);
        if (!zr_tile_touches(tile, box)) continue;
        struct zr_setup setup = zr_setup_make(geometry->vertices, &triangle);
        put_triangle(&setup, number + 1, &flags, tile);
        if (!any_flag(&flags)) return;
    }
    put_rest(geometry, primitive, &flags, tile);
}
