#include "raster/halfspace.h"

#include "base/fast.h"
#include "raster/tile_simd.h"
#include "raster/triangle_simd.h"

/* ---- rows of one triangle ---- */

/* The part of a triangle in a tile. Edges are negative outside; x0 .. y1 are samples of the tile, y1 the last row. */
struct piece {
    int32_t at[3], right[3], up[3]; /* edge functions at x0, y0, and their steps */
    const struct zr_depth *depth;
    int32_t x0, y0, x1, y1;
    uint32_t owner;
};

/* Operation on a sample: z-test, first write to an unwritten block, or adding to the lists. */
enum operation { NEAREST, FIRST, LISTED };

static inline zr_vf put(struct zr_tile *tile, size_t i, zr_vm inside, zr_vf z, uint32_t owner, enum operation op)
{
    const zr_vi owners = zr_vi_set((int32_t)owner);
    if (op == FIRST) return zr_tile_put_first_v(&tile->depth[i], &tile->owner[i], inside, z, owners);
    if (op == NEAREST) return zr_tile_put_v(&tile->depth[i], &tile->owner[i], inside, z, owners).nearest;
    zr_tile_list_v(tile, i, inside, z, owner);
    return z;
}

/* Draws ZR_LANES columns from x on, a multiple of ZR_LANES, for the given lanes. FIRST: the block is not written yet.
 * Returns each column's farthest depth in the rows of the piece. */
static inline zr_vf draw_columns(struct zr_tile *tile, const struct piece *p, int32_t x, zr_vm lanes, enum operation op)
{
    const zr_vi below_zero = zr_vi_set(-1), ramp = zr_vi_ramp(), skip = zr_vi_set(x - p->x0) + ramp;
    const zr_vi up[3] = {zr_vi_set(p->up[0]), zr_vi_set(p->up[1]), zr_vi_set(p->up[2])};
    zr_vi e[3];
    for (int k = 0; k < 3; k++)
        e[k] = zr_vi_set(p->at[k]) + zr_vi_set(p->right[k]) * skip;
    const struct zr_depth_columns columns = zr_depth_columns_of(p->depth, x);
    zr_vf fy = zr_vf_set((float)p->y0), far = zr_vf_set(0.0f);
    size_t i = (size_t)(p->y0 - tile->y) * ZR_TILE_STRIDE + (size_t)(x - tile->x);
    for (int32_t y = p->y0; y <= p->y1; y++, i += ZR_TILE_STRIDE, fy = fy + zr_vf_set(1.0f)) {
        const zr_vm inside = zr_vi_lt_where(lanes, below_zero, e[0] | e[1] | e[2]);
        const zr_vf z = zr_depth_columns_at(&columns, fy);
        far = zr_vf_max(far, put(tile, i, inside, z, p->owner, op));
        for (int k = 0; k < 3; k++)
            e[k] += up[k];
    }
    return far;
}

static inline int32_t first_lane(int32_t x)
{
    return x & ~(ZR_LANES - 1);
}

/* Returns the lanes that belong to the piece, among columns x .. x + ZR_LANES - 1. */
static inline zr_vm lanes_of(const struct piece *p, int32_t x)
{
    const zr_vi columns = zr_vi_set(x) + zr_vi_ramp();
    const zr_vm before = zr_vi_lt(columns, zr_vi_set(p->x0));
    return zr_vm_andnot(zr_vi_lt(columns, zr_vi_set(p->x1 + 1)), before);
}

/* ---- triangles of any size ---- */

/* Sets edge k for the piece's samples; returns false if it excludes all of them. An edge that excludes some has values
 * within 2^30 there after division by 256, which divides all its steps; rounding down keeps the sign. An edge that
 * excludes none becomes 0 everywhere. */
static bool cut_by(const struct zr_edge *e, struct piece *p, int k)
{
    int32_t low_x = e->a > 0 ? p->x0 : p->x1, high_x = e->a > 0 ? p->x1 : p->x0;
    int32_t low_y = e->b > 0 ? p->y0 : p->y1, high_y = e->b > 0 ? p->y1 : p->y0;
    p->at[k] = p->right[k] = p->up[k] = 0;
    if (zr_edge_at(e, high_x, high_y) <= 0) return false;
    if (zr_edge_at(e, low_x, low_y) > 0) return true;
    p->at[k] = (int32_t)((zr_edge_at(e, p->x0, p->y0) - 1) >> ZR_SUBPIXEL_BITS);
    p->right[k] = (int32_t)(e->a / ZR_SUBPIXELS);
    p->up[k] = (int32_t)(e->b / ZR_SUBPIXELS);
    return true;
}

/* Classification of ZR_LANES blocks before any sample is tested. */
struct blocks {
    zr_vm open;   /* some samples may be visible */
    zr_vm whole;  /* open, and inside the piece's box */
    zr_vm filled; /* whole, and not cut by an edge */
    zr_vf far;    /* farthest depth of the triangle in the block */
};

/* Classifies ZR_LANES blocks from `first` on. Edges and depth are monotone, so their extremes are at block corners. A
 * block at the border of the piece is cut to it first, which keeps the edges in the range of cut_by. */
static inline struct blocks classify_blocks(const struct zr_tile *tile, const struct piece *p, int first)
{
    const zr_vi number = zr_vi_set(first) + zr_vi_ramp();
    const zr_vi x = (number & zr_vi_set(ZR_BLOCK_COLUMNS - 1)) * zr_vi_set(ZR_BLOCK_WIDTH) + zr_vi_set(tile->x);
    const zr_vi y = (number >> 2) * zr_vi_set(ZR_BLOCK_HEIGHT) + zr_vi_set(tile->y);
    const zr_vi x0 = zr_vi_max(x, zr_vi_set(p->x0)),
                x1 = zr_vi_min(x + zr_vi_set(ZR_BLOCK_WIDTH - 1), zr_vi_set(p->x1));
    const zr_vi y0 = zr_vi_max(y, zr_vi_set(p->y0)),
                y1 = zr_vi_min(y + zr_vi_set(ZR_BLOCK_HEIGHT - 1), zr_vi_set(p->y1));
    const zr_vi zero = zr_vi_set(0);
    struct blocks out;
    zr_vm cut = zr_vi_lt(zero, zero); /* by some edge; defined for whole blocks only */
    zr_vi most = zero;
    for (int k = 0; k < 3; k++) {
        if ((p->right[k] | p->up[k]) == 0) continue;
        const zr_vi right = zr_vi_set(p->right[k]), up = zr_vi_set(p->up[k]), at = zr_vi_set(p->at[k]);
        const zr_vi left = (x0 - zr_vi_set(p->x0)) * right, far_right = (x1 - zr_vi_set(p->x0)) * right;
        const zr_vi low = (y0 - zr_vi_set(p->y0)) * up, high = (y1 - zr_vi_set(p->y0)) * up;
        cut = zr_vm_or(cut, zr_vi_lt(at + zr_vi_min(left, far_right) + zr_vi_min(low, high), zero));
        most |= at + zr_vi_max(left, far_right) + zr_vi_max(low, high);
    }
    const zr_vf fx0 = zr_vf_of(x0), fx1 = zr_vf_of(x1), fy0 = zr_vf_of(y0), fy1 = zr_vf_of(y1);
    const struct zr_plane *of = &p->depth->plane;
    const struct zr_plane_v plane = {zr_vf_set(of->a0), zr_vf_set(of->dadx), zr_vf_set(of->dady)};
    const zr_vf offset = zr_vf_set(p->depth->offset);
    const struct zr_range_v range = zr_plane_range_v(&plane, fx0, fy0, fx1, fy1);
    const zr_vf near = zr_depth_clamp_v(range.near + offset);
    out.far = zr_depth_clamp_v(range.far + offset);
    const zr_vm touched = zr_vm_and(zr_vi_lt(x0, x1 + zr_vi_set(1)), zr_vi_lt(y0, y1 + zr_vi_set(1)));
    const zr_vm outside = zr_vi_lt(most, zero), behind = zr_vf_lt(zr_vf_load(tile->block_far + first), near);
    out.open = zr_vm_andnot(touched, outside);
    if (ZR_FAST(hidden_blocks, zr_vm_any(behind))) out.open = zr_vm_andnot(out.open, behind);
    const zr_vm whole =
        zr_vm_and(zr_vi_eq(x1 - x0, zr_vi_set(ZR_BLOCK_WIDTH - 1)), zr_vi_eq(y1 - y0, zr_vi_set(ZR_BLOCK_HEIGHT - 1)));
    out.whole = zr_vm_and(out.open, whole);
    out.filled = zr_vm_andnot(out.whole, cut);
    return out;
}
_Static_assert(ZR_BLOCK_COLUMNS == 1 << 2 && ZR_BLOCKS % ZR_LANES == 0,
               "rows of blocks are a shift, lanes divide them");

/* Returns the part of the piece within a block. */
static inline struct piece part_of(const struct zr_tile *tile, const struct piece *p, int block)
{
    struct piece part = *p;
    const int32_t x = tile->x + block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
    const int32_t y = tile->y + block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    if (x > p->x0) part.x0 = x;
    if (y > p->y0) part.y0 = y;
    if (x + ZR_BLOCK_WIDTH - 1 < p->x1) part.x1 = x + ZR_BLOCK_WIDTH - 1;
    if (y + ZR_BLOCK_HEIGHT - 1 < p->y1) part.y1 = y + ZR_BLOCK_HEIGHT - 1;
    for (int k = 0; k < 3; k++)
        part.at[k] += (part.x0 - p->x0) * p->right[k] + (part.y0 - p->y0) * p->up[k];
    return part;
}

/* Draws a block that is entirely covered and may be partly visible. */
static inline void fill_block(struct zr_tile *tile, const struct piece *p, int block)
{
    const zr_vi owner = zr_vi_set((int32_t)p->owner);
    const int32_t column = block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, row = block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    for (int32_t v = 0; v < ZR_BLOCK_WIDTH; v += ZR_LANES) {
        const struct zr_depth_columns columns = zr_depth_columns_of(p->depth, tile->x + column + v);
        size_t i = zr_block_first(block) + (size_t)v;
        zr_vf fy = zr_vf_set((float)(tile->y + row));
        for (int32_t y = 0; y < ZR_BLOCK_HEIGHT; y++, i += ZR_TILE_STRIDE, fy = fy + zr_vf_set(1.0f))
            zr_tile_put_v(&tile->depth[i], &tile->owner[i], ZR_ALL_LANES, zr_depth_columns_at(&columns, fy), owner);
    }
}

static inline float farthest_of(zr_vf depths)
{
    float each[ZR_LANES];
    zr_vf_store(each, depths);
    for (int half = ZR_LANES / 2; half > 0; half /= 2)
        for (int i = 0; i < half; i++)
            each[i] = each[i] > each[i + half] ? each[i] : each[i + half];
    return each[0];
}

static inline void bound_block(struct zr_tile *tile, int block, zr_vf far)
{
    if (!zr_vm_any(zr_vf_le(zr_vf_set(1.0f), far))) tile->block_far[block] = farthest_of(far);
}

/* Draws the piece within a block. Triangles that share an edge may cover the block together: then it gets a bound as
 * well (a fifth of the time of large triangles that clipping divides). */
static inline void draw_in_block(struct zr_tile *tile, const struct piece *p, int block, enum operation op)
{
    const struct piece part = part_of(tile, p, block);
    const int32_t begin = first_lane(part.x0);
    zr_vf far = zr_vf_set(0.0f);
    for (int32_t x = begin; x <= part.x1; x += ZR_LANES)
        far = zr_vf_max(far, draw_columns(tile, &part, x, lanes_of(&part, x), op));
    const bool all =
        part.y1 - part.y0 == ZR_BLOCK_HEIGHT - 1 && first_lane(part.x1) - begin == ZR_BLOCK_WIDTH - ZR_LANES;
    if (all) bound_block(tile, block, far);
}

/* Updates the tile's bound from those of all blocks. */
static inline void bound_tile(struct zr_tile *tile)
{
    zr_vf far = zr_vf_load(tile->block_far);
    for (int first = ZR_LANES; first < ZR_BLOCKS; first += ZR_LANES)
        far = zr_vf_max(far, zr_vf_load(tile->block_far + first));
    if (!zr_vm_any(zr_vf_le(zr_vf_set(tile->far), far))) tile->far = farthest_of(far);
}

/* Writes the unwritten ones of these blocks (one bit each), so that single samples can be drawn. */
static inline void write_blocks(struct zr_tile *tile, uint32_t blocks)
{
    for (uint32_t bits = blocks & tile->unwritten; bits; bits &= bits - 1)
        zr_block_write(tile, zr_lowest_bit(bits));
    tile->unwritten &= ~blocks;
}

/* Draws the triangle to the blocks `shared`, bits relative to `first`. fresh: blocks not written yet. */
static inline void draw_shared(struct zr_tile *tile, const struct piece *p, int first, const struct blocks *blocks,
                               uint32_t shared, uint32_t fresh)
{
    const uint32_t filled = zr_vm_bits(blocks->filled);
    for (uint32_t bits = shared; bits; bits &= bits - 1) {
        const uint32_t bit = bits & -bits;
        const int block = first + zr_lowest_bit(bits);
        if (fresh & bit)
            draw_in_block(tile, p, block, FIRST);
        else if (filled & bit)
            fill_block(tile, p, block);
        else
            draw_in_block(tile, p, block, NEAREST);
    }
}

/* Processes the blocks first .. first + ZR_LANES - 1: records the triangle as the owner of blocks that it fills alone,
 * and draws it to the others. Returns false if it is visible in none. */
static inline bool draw_blocks(struct zr_tile *tile, const struct piece *p, int first)
{
    const struct blocks blocks = classify_blocks(tile, p, first);
    const zr_vf far = zr_vf_load(tile->block_far + first), one = zr_vf_set(1.0f);
    const zr_vi owners = zr_vi_load(tile->block_owner + first);
    const zr_vm uncovered = zr_vm_and(zr_vm_of(tile->unwritten >> first & ZR_ALL_BITS), zr_vi_eq(owners, zr_vi_set(0)));
    /* nearer than 1 everywhere, in an uncovered block */
    zr_vm alone = zr_vm_and(zr_vf_lt_where(blocks.filled, blocks.far, one), uncovered);
    if (!ZR_FAST(owned_blocks, zr_vm_any(alone))) alone = zr_vm_of(0);
    const uint32_t owned = zr_vm_bits(alone);
    const uint32_t shared = zr_vm_bits(blocks.open) & ~owned, fresh = zr_vm_bits(zr_vm_and(blocks.whole, uncovered));
    write_blocks(tile, (shared & ~fresh) << first);
    tile->unwritten &= ~(shared << first);
    const zr_vi owner = zr_vi_select(alone, zr_vi_set((int32_t)p->owner), zr_vi_set(ZR_BLOCK_SHARED));
    zr_vi_store(tile->block_owner + first, zr_vi_select(blocks.open, owner, owners));
    zr_vf_store(tile->block_far + first, zr_vf_select(blocks.filled, zr_vf_min(blocks.far, far), far));
    for (uint32_t bits = owned; bits; bits &= bits - 1)
        tile->block_depth[first + zr_lowest_bit(bits)] = *p->depth;
    draw_shared(tile, p, first, &blocks, shared, fresh);
    return zr_vm_any(blocks.open);
}

/* Computes the part of the triangle in the tile; returns false if it is empty. */
static inline bool make_piece(const struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner,
                              struct piece *out)
{
    const struct piece p = {.depth = &setup->depth,
                            .x0 = setup->min_x > tile->x ? setup->min_x : tile->x,
                            .y0 = setup->min_y > tile->y ? setup->min_y : tile->y,
                            .x1 = setup->max_x < tile->x + tile->width ? setup->max_x : tile->x + tile->width - 1,
                            .y1 = setup->max_y < tile->y + tile->height ? setup->max_y : tile->y + tile->height - 1,
                            .owner = owner};
    *out = p;
    if (p.x0 > p.x1 || p.y0 > p.y1) return false;
    for (int k = 0; k < 3; k++)
        if (!cut_by(&setup->edges[k], out, k)) return false;
    return true;
}

static void draw(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner)
{
    struct piece p;
    if (!make_piece(tile, setup, owner, &p)) return;
    if (zr_depth_range_of(&setup->depth, p.x0, p.y0, p.x1, p.y1).near > tile->far) return;
    /* Skips blocks below and above the piece. */
    const int lowest = (p.y0 - tile->y) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    const int end = ((p.y1 - tile->y) / ZR_BLOCK_HEIGHT + 1) * ZR_BLOCK_COLUMNS;
    bool drawn = false;
    for (int first = lowest - lowest % ZR_LANES; first < end; first += ZR_LANES)
        drawn |= draw_blocks(tile, &p, first);
    if (drawn) bound_tile(tile);
}

static void list(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner)
{
    struct piece p;
    if (!make_piece(tile, setup, owner, &p)) return;
    for (int32_t x = first_lane(p.x0); x <= p.x1; x += ZR_LANES)
        draw_columns(tile, &p, x, lanes_of(&p, x), LISTED);
}

/* ---- tile operations ---- */

static void begin(struct zr_tile *tile)
{
    const uint32_t blocks = zr_tile_blocks(tile);
    for (int first = 0; first < ZR_BLOCKS; first += ZR_LANES) {
        const zr_vm there = zr_vm_of(blocks >> first & ZR_ALL_BITS);
        zr_vf_store(tile->block_far + first, zr_vf_select(there, zr_vf_set(1.0f), zr_vf_set(0.0f)));
    }
    memset(tile->block_owner, 0, sizeof tile->block_owner);
    tile->has_block_owners = true;
    tile->unwritten = UINT32_MAX;
    tile->far = 1.0f;
    tile->is_empty = false;
}

static void flush(struct zr_tile *tile)
{
    write_blocks(tile, UINT32_MAX);
}

const struct zr_halfspace ZR_KERNEL(zr_halfspace) = {begin, draw, list, flush};
