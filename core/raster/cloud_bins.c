#include "raster/cloud_bins.h"

#include "base/prefetch.h"
#include "geometry/transform.h"
#include "raster/depth.h"
#include "raster/point.h"

/* Points of a thread's range, and of one block of it: the block's positions and vertices stay in the first-level
 * cache. */
enum { POINTS_PER_RANGE = 4096, POINTS_AT_ONCE = 256 };

/* Bytes of a chain's first block, of its largest ones, and of memory taken at once. Blocks double in size, so that at
 * most half of their memory is unused. */
enum { BLOCK_AT_FIRST = 256, BLOCK_MOST = 4096, BYTES_AT_ONCE = 1 << 16 };

/* Points and pixels put between two checks for cancellation: less than a millisecond. */
enum { WORK_PER_CANCEL_CHECK = 1 << 18 };

enum { TILE_SHIFT = 6 };
_Static_assert(1 << TILE_SHIFT == ZR_TILE_SIZE, "the smallest cells are tiles");

/* ---- lists ---- */

/* Returns memory for a block of up to `size` bytes, and its size. If there is none, returns NULL and marks the binner
 * as failed. */
static void *take(struct zr_cloud_binner *binner, size_t *size)
{
    struct zr_cloud_bins *bins = binner->bins;
    const size_t left = (size_t)(binner->free_end - binner->free);
    if (binner->failed) return NULL;
    if (left < BLOCK_AT_FIRST) {
        pthread_mutex_lock(&bins->arena_lock);
        binner->free = zr_arena_alloc(bins->arena, BYTES_AT_ONCE, 1);
        pthread_mutex_unlock(&bins->arena_lock);
        binner->failed = !binner->free;
        binner->free_end = binner->failed ? NULL : binner->free + BYTES_AT_ONCE;
        if (binner->failed) return NULL;
    } else if (left < *size) {
        *size = left;
    }
    void *taken = binner->free;
    binner->free += *size;
    return taken;
}

/* Returns the bytes of a block with this room. */
static size_t bytes_of(uint32_t room)
{
    return sizeof(struct zr_cloud_block) + room * sizeof(struct zr_cloud_record);
}

/* Appends a block for points of that size and shape to the chain. Without memory, returns NULL. */
static struct zr_cloud_block *add_block(struct zr_cloud_binner *binner, struct zr_cloud_chain *chain, int32_t width,
                                        int32_t cut)
{
    size_t size = chain->last ? 2 * bytes_of(chain->last->room) / BLOCK_AT_FIRST * BLOCK_AT_FIRST : 0;
    if (size < BLOCK_AT_FIRST) size = BLOCK_AT_FIRST;
    if (size > BLOCK_MOST) size = BLOCK_MOST;
    struct zr_cloud_block *block = take(binner, &size);
    if (!block) return NULL;
    block->next = NULL;
    block->used = 0;
    block->room = (uint32_t)((size - sizeof *block) / sizeof *block->records);
    block->width = width;
    block->cut = cut;
    if (chain->last)
        chain->last->next = block;
    else
        chain->first = block;
    chain->last = block;
    return block;
}

/* ---- binning ---- */

/* A range of one cloud, the unit of work of a thread. */
struct share {
    const struct zr_draw *draw;
    uint32_t begin, end;
};

/* How a cloud is binned. */
struct sizing {
    int32_t width, cut;
    const struct zr_cloud_grid *grid;
};

static int grid_for(int32_t width)
{
    int grid = 0;
    for (int32_t side = ZR_TILE_SIZE; grid < ZR_CLOUD_GRIDS - 1 && side < width; side *= 4)
        grid++;
    return grid;
}

static struct sizing sizing_of(const struct zr_cloud_bins *bins, const struct zr_draw *draw)
{
    const int32_t width = zr_point_width(draw->mesh->point_size, bins->geometry->window.point_scale);
    return (struct sizing){width, zr_point_cut(draw->mesh, width), &bins->grids[grid_for(width)]};
}

/* Lists the point in a cell. Without memory, the binner is marked as failed. */
static inline void add_to_cell(struct zr_cloud_binner *binner, const struct sizing *sizing, size_t cell,
                               const struct zr_cloud_record *record)
{
    struct zr_cloud_chain *chain = &binner->cells[cell];
    struct zr_cloud_block *block = chain->last;
    if (!block || block->used == block->room || block->width != sizing->width || block->cut != sizing->cut)
        block = add_block(binner, chain, sizing->width, sizing->cut);
    if (block) block->records[block->used++] = *record;
}

static inline void add(struct zr_cloud_binner *binner, const struct sizing *sizing,
                       const struct zr_window_vertex *vertex, uint32_t owner)
{
    const int32_t last_x = (int32_t)binner->bins->width - 1, last_y = (int32_t)binner->bins->height - 1;
    const int shift = sizing->grid->shift;
    const float depth = zr_depth_clamp(vertex->z);
    int32_t box[4];
    zr_point_box_at(vertex, sizing->width, box);
    /* Clipping rounds: a point may lie slightly outside the window. */
    if (box[2] < 0 || box[3] < 0 || box[0] > last_x || box[1] > last_y) return;
    const int32_t x0 = (box[0] > 0 ? box[0] : 0) >> shift, x1 = (box[2] < last_x ? box[2] : last_x) >> shift;
    const int32_t y0 = (box[1] > 0 ? box[1] : 0) >> shift, y1 = (box[3] < last_y ? box[3] : last_y) >> shift;
    for (int32_t y = y0; y <= y1; y++)
        for (int32_t x = x0; x <= x1; x++) {
            const struct zr_cloud_record record = {owner, depth, (int16_t)(box[0] - (x << shift)),
                                                   (int16_t)(box[1] - (y << shift))};
            add_to_cell(binner, sizing, sizing->grid->first + (size_t)y * sizing->grid->columns + (size_t)x, &record);
        }
}

static void bin_share(struct zr_cloud_binner *binner, zr_transform_fn *transform, const struct share *share)
{
    const struct zr_draw *draw = share->draw;
    const struct zr_geometry *geometry = binner->bins->geometry;
    const struct zr_source_instance *instance = &geometry->instances[draw->instance];
    const struct zr_viewport viewport = zr_viewport_make(geometry->window.width, geometry->window.height);
    const struct sizing sizing = sizing_of(binner->bins, draw);
    for (uint32_t begin = share->begin; begin < share->end; begin += POINTS_AT_ONCE) {
        const uint32_t count = share->end - begin < POINTS_AT_ONCE ? share->end - begin : POINTS_AT_ONCE;
        zr_vec4 positions[POINTS_AT_ONCE];
        struct zr_window_vertex vertices[POINTS_AT_ONCE];
        uint8_t outcodes[POINTS_AT_ONCE];
        for (uint32_t i = 0; i < count; i++)
            positions[i] = draw->mesh->positions[zr_mesh_point(draw->mesh, begin + i)];
        transform(&instance->to_clip, &viewport, positions, count, vertices, outcodes, false);
        for (uint32_t i = 0; i < count; i++) {
            const unsigned code = zr_outcode_of_point(outcodes[i]);
            binner->counts.outside_points += code != 0;
            binner->counts.unplaced += code == ZR_OUTCODE_UNPLACED;
            if (code == 0) add(binner, &sizing, &vertices[i], draw->first + begin + i + 1);
        }
        binner->counts.points += count;
    }
}

/* ---- threads ---- */

struct binning {
    struct zr_cloud_bins *bins;
    const struct zr_cancel *cancel;
    zr_transform_fn *transform;
    size_t share_count;
    struct share *shares;
};

static void bin_shares(void *context, int worker, size_t begin, size_t end)
{
    const struct binning *b = context;
    struct zr_cloud_binner *binner = &b->bins->workers[worker];
    for (size_t i = begin; i < end; i++) {
        if (zr_is_cancelled(b->cancel) || binner->failed) return;
        bin_share(binner, b->transform, &b->shares[i]);
    }
}

static bool is_wanted(const struct zr_cloud_bins *bins, const struct zr_draw *draw)
{
    return zr_draw_is_cloud(draw) && zr_draw_mode(draw) == bins->mode;
}

/* Lists the ranges of all clouds, and the grids that they need. */
static bool make_shares(struct binning *b)
{
    struct zr_cloud_bins *bins = b->bins;
    const struct zr_geometry *geometry = bins->geometry;
    size_t count = 0;
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        if (is_wanted(bins, &geometry->draws[i])) count += (geometry->draws[i].count - 1) / POINTS_PER_RANGE + 1;
    if (count == 0) return true;
    b->shares = zr_arena_alloc(bins->arena, count, sizeof *b->shares);
    if (!b->shares) return false;
    for (uint32_t i = 0; i < geometry->draw_count; i++) {
        const struct zr_draw *draw = &geometry->draws[i];
        if (!is_wanted(bins, draw)) continue;
        const int32_t width = zr_point_width(draw->mesh->point_size, geometry->window.point_scale);
        const int grid = grid_for(width);
        bins->grids[grid].shift = TILE_SHIFT + 2 * grid;
        for (uint32_t begin = 0; begin < draw->count; begin += POINTS_PER_RANGE) {
            const uint32_t left = draw->count - begin;
            const uint32_t end = begin + (left < POINTS_PER_RANGE ? left : POINTS_PER_RANGE);
            b->shares[b->share_count++] = (struct share){draw, begin, end};
        }
    }
    return true;
}

static bool make_workers(struct zr_cloud_bins *bins)
{
    size_t cells = 0;
    for (int i = 0; i < ZR_CLOUD_GRIDS; i++) {
        struct zr_cloud_grid *grid = &bins->grids[i];
        if (grid->shift == 0) continue;
        const uint32_t rows = ((bins->height - 1) >> grid->shift) + 1;
        grid->columns = ((bins->width - 1) >> grid->shift) + 1;
        grid->first = cells;
        cells += (size_t)grid->columns * rows;
    }
    bins->workers = zr_arena_zero(bins->arena, (size_t)bins->worker_count, sizeof *bins->workers);
    for (int i = 0; bins->workers && i < bins->worker_count; i++) {
        bins->workers[i].bins = bins;
        bins->workers[i].cells = zr_arena_zero(bins->arena, cells, sizeof *bins->workers[i].cells);
    }
    return zr_arena_ok(bins->arena);
}

static enum zr_status build(struct zr_team *team, const struct zr_cancel *cancel, struct zr_cloud_bins *bins)
{
    struct binning binning = {.bins = bins, .cancel = cancel, .transform = zr_transform_of(zr_team_isa(team))};
    if (!make_shares(&binning)) return ZR_NO_MEMORY;
    if (binning.share_count == 0) return ZR_OK;
    if (binning.share_count == 1) team = NULL; /* no need to wake threads */
    const size_t threads = (size_t)zr_team_size(team);
    bins->worker_count = (int)(threads < binning.share_count ? threads : binning.share_count);
    if (!make_workers(bins)) return ZR_NO_MEMORY;
    zr_team_shares(team, binning.share_count, 1, bin_shares, &binning);
    for (int i = 0; i < bins->worker_count; i++) {
        if (bins->workers[i].failed) return ZR_NO_MEMORY;
        zr_counts_add(&bins->counts, &bins->workers[i].counts);
    }
    return zr_is_cancelled(cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_cloud_bins_build(const struct zr_run *run, const struct zr_geometry *geometry,
                                   enum zr_alpha_mode mode, uint32_t width, uint32_t height, struct zr_cloud_bins *bins)
{
    *bins = (struct zr_cloud_bins){.arena = run->arena,
                                   .geometry = geometry,
                                   .mode = mode,
                                   .width = width,
                                   .height = height,
                                   .draw = zr_cloud_draw_of(zr_team_isa(run->team))};
    pthread_mutex_init(&bins->arena_lock, NULL);
    enum zr_status status = build(run->team, run->cancel, bins);
    pthread_mutex_destroy(&bins->arena_lock);
    return status;
}

/* ---- tiles ---- */

/* Returns the number of the grid's cell that contains the tile, and its lowest pixel. */
static size_t cell_of(const struct zr_cloud_bins *bins, const struct zr_cloud_grid *grid, uint32_t tile, int32_t *x,
                      int32_t *y)
{
    const uint32_t across = zr_tile_across(bins->width);
    const uint32_t column = tile % across >> (grid->shift - TILE_SHIFT),
                   row = tile / across >> (grid->shift - TILE_SHIFT);
    *x = (int32_t)column << grid->shift;
    *y = (int32_t)row << grid->shift;
    return grid->first + (size_t)row * grid->columns + column;
}

bool zr_cloud_bins_any(const struct zr_cloud_bins *bins, uint32_t number)
{
    for (int i = 0; i < ZR_CLOUD_GRIDS && bins->worker_count > 0; i++) {
        int32_t x, y;
        if (bins->grids[i].shift == 0) continue;
        const size_t cell = cell_of(bins, &bins->grids[i], number, &x, &y);
        for (int w = 0; w < bins->worker_count; w++)
            if (bins->workers[w].cells[cell].first) return true;
    }
    return false;
}

/* Lists the fragments of a block in the cell whose lowest pixel is x, y. Returns their number. */
static uint32_t list_block(const struct zr_cloud_block *block, int32_t x, int32_t y, struct zr_tile *tile)
{
    uint32_t pixels = 0;
    for (uint32_t i = 0; i < block->used; i++) {
        const struct zr_cloud_record *r = &block->records[i];
        const struct zr_point_shape shape = {x + r->x, y + r->y, block->width, block->cut};
        pixels += zr_point_put(&shape, r->depth, r->owner, tile);
    }
    return pixels;
}

/* Draws a chain of the cell. Adds the points and pixels to *work. */
static bool draw_chain(zr_cloud_draw_fn *draw, const struct zr_cloud_block *block, int32_t x, int32_t y,
                       const struct zr_cancel *cancel, uint64_t *work, struct zr_tile *tile)
{
    for (; block; block = block->next) {
        if (*work >= WORK_PER_CANCEL_CHECK) {
            if (zr_is_cancelled(cancel)) return false;
            *work = 0;
        }
        if (block->next) zr_prefetch(block->next, 0, bytes_of(block->room)); /* most are at least as large */
        *work += block->used + (tile->fragments ? list_block : draw)(block, x, y, tile);
    }
    return true;
}

bool zr_cloud_bins_draw(const struct zr_cloud_bins *bins, uint32_t number, const struct zr_cancel *cancel,
                        struct zr_tile *tile)
{
    uint64_t work = WORK_PER_CANCEL_CHECK;
    for (int i = 0; i < ZR_CLOUD_GRIDS && bins->worker_count > 0; i++) {
        int32_t x, y;
        if (bins->grids[i].shift == 0) continue;
        const size_t cell = cell_of(bins, &bins->grids[i], number, &x, &y);
        for (int w = 0; w < bins->worker_count; w++)
            if (!draw_chain(bins->draw, bins->workers[w].cells[cell].first, x, y, cancel, &work, tile)) return false;
    }
    return true;
}
