#include "raster/bins.h"

#include "base/prefetch.h"
#include "base/run.h"
#include "geometry/face.h"
#include "geometry/geometry.h"

enum { TRIANGLES_PER_RANGE = 4096, BYTES_AT_ONCE = 1 << 16 };
_Static_assert(TRIANGLES_PER_RANGE < 1 << ZR_BIN_OWNER_BITS, "owners of a range fit a fragment");
_Static_assert(TRIANGLES_PER_RANGE % 32 == 0, "no two threads write to one word of a draw's backs");

/* ---- lists ---- */

/* Returns memory for `size` bytes. If there is none, returns NULL and marks the binner as failed. */
static void *take(struct zr_binner *binner, size_t size)
{
    struct zr_bins *bins = binner->bins;
    if (binner->failed) return NULL;
    size = (size + 15) & ~(size_t)15;
    if ((size_t)(binner->free_end - binner->free) < size) {
        pthread_mutex_lock(&bins->arena_lock);
        binner->free = zr_arena_alloc(bins->arena, BYTES_AT_ONCE, 1);
        pthread_mutex_unlock(&bins->arena_lock);
        binner->failed = !binner->free;
        if (binner->failed) return NULL;
        binner->free_end = binner->free + BYTES_AT_ONCE;
    }
    void *taken = binner->free;
    binner->free += size;
    return taken;
}
_Static_assert(sizeof(void *) < 8 || sizeof(struct zr_bin_numbers) == 256, "fills a block of 256 bytes");

struct zr_bin_head *zr_binner_block(struct zr_binner *binner, struct zr_bin *bin, size_t size)
{
    struct zr_bin_head *block = take(binner, size);
    if (!block) return NULL;
    /* Prefetches the next block before it is written (a twentieth of a million triangles' time). */
    zr_prefetch_written(binner->free, 0, size);
    block->next = NULL;
    block->used = 0;
    bin->block_count++;
    if (bin->last)
        bin->last->next = block;
    else
        bin->first = block;
    bin->last = block;
    return block;
}

/* ---- triangles that are not small ---- */

void zr_binner_add_flat(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number)
{
    if (draw->counted) return;
    if (zr_face_is_degenerate(draw->mesh, zr_draw_face(draw, number - draw->first))) {
        binner->counts.degenerate_polygons++;
        binner->counts.triangles--; /* counted when the draw was made */
    } else {
        binner->counts.zero_area++;
    }
}

static bool faces_away(const struct zr_draw *draw, const struct zr_triangle *triangle)
{
    return !draw->counted && triangle->back && !draw->material->double_sided;
}

static bool cut_to_window(const struct zr_bins *bins, int32_t box[4])
{
    if (box[0] < 0) box[0] = 0;
    if (box[1] < 0) box[1] = 0;
    if (box[2] >= (int32_t)bins->width) box[2] = (int32_t)bins->width - 1;
    if (box[3] >= (int32_t)bins->height) box[3] = (int32_t)bins->height - 1;
    return box[0] <= box[2] && box[1] <= box[3];
}

static void add_wide(struct zr_binner *binner, struct zr_bin *bin, const struct zr_wide *wide)
{
    struct zr_bin_wides *block =
        (struct zr_bin_wides *)zr_binner_room(binner, bin, ZR_BIN_WIDE_PER_BLOCK - 1, sizeof *block);
    if (block) block->items[block->head.used++] = wide;
}

void zr_binner_add_spanning(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number)
{
    const struct zr_bins *bins = binner->bins;
    const struct zr_prepaint *prepaint = zr_binner_prepaint(binner, draw);
    const struct zr_window_vertex *vertices = bins->geometry->vertices;
    const struct zr_triangle triangle = zr_triangle_of(bins->geometry, draw, number);
    int32_t box[4];
    if (zr_window_area(&vertices[triangle.v[0]], &vertices[triangle.v[1]], &vertices[triangle.v[2]]) == 0) {
        zr_binner_add_flat(binner, draw, number);
        return;
    }
    if (faces_away(draw, &triangle)) {
        binner->counts.culled++;
        return;
    }
    binner->counts.drawn_whole += !draw->counted;
    if (prepaint && prepaint->backs) zr_prepaint_add_backs(prepaint, number - draw->first, triangle.back);
    zr_setup_box(vertices, &triangle, box);
    if (!cut_to_window(bins, box)) return;
    struct zr_wide *wide = take(binner, sizeof *wide);
    if (!wide) return;
    *wide = (struct zr_wide){zr_setup_make(vertices, &triangle), number + 1};
    for (int k = 0; k < 4; k++)
        box[k] /= ZR_TILE_SIZE;
    if ((box[2] - box[0] + 1) * (box[3] - box[1] + 1) > ZR_BIN_TILES) {
        add_wide(binner, &binner->large, wide);
        return;
    }
    for (int32_t y = box[1]; y <= box[3]; y++)
        for (int32_t x = box[0]; x <= box[2]; x++)
            add_wide(binner, &binner->tiles[(size_t)y * bins->columns + (size_t)x].wide, wide);
}

/* ---- threads ---- */

/* A range of one draw, the unit of work of a thread. */
struct share {
    const struct zr_draw *draw;
    uint32_t begin, end;
};

struct sorting {
    struct zr_bins *bins;
    const struct zr_cancel *cancel;
    zr_binning_fn *sort;
    uint64_t triangle_count;
    uint32_t share_count;
    struct share *shares;
};

static void sort_shares(void *context, int worker, size_t begin, size_t end)
{
    const struct sorting *s = context;
    struct zr_binner *binner = &s->bins->workers[worker];
    for (size_t i = begin; i < end; i++) {
        if (zr_is_cancelled(s->cancel) || binner->failed) return;
        s->sort(binner, s->shares[i].draw, s->shares[i].begin, s->shares[i].end);
    }
}

static bool is_wanted(const struct zr_bins *bins, const struct zr_draw *draw)
{
    return zr_draw_is_plain(draw) && zr_draw_mode(draw) == bins->mode;
}

static bool make_shares(struct sorting *s)
{
    const struct zr_geometry *geometry = s->bins->geometry;
    size_t count = 0;
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        if (is_wanted(s->bins, &geometry->draws[i])) count += (geometry->draws[i].count - 1) / TRIANGLES_PER_RANGE + 1;
    s->shares = zr_arena_alloc(s->bins->arena, count, sizeof *s->shares);
    if (!s->shares) return false;
    for (uint32_t i = 0; i < geometry->draw_count; i++) {
        const struct zr_draw *draw = &geometry->draws[i];
        if (!is_wanted(s->bins, draw)) continue;
        s->bins->has_words |= s->bins->prepaints && s->bins->prepaints[i].make;
        s->triangle_count += draw->count;
        for (uint32_t begin = 0; begin < draw->count; begin += TRIANGLES_PER_RANGE) {
            uint32_t left = draw->count - begin;
            uint32_t end = begin + (left < TRIANGLES_PER_RANGE ? left : TRIANGLES_PER_RANGE);
            s->shares[s->share_count++] = (struct share){draw, begin, end};
        }
    }
    return true;
}

static bool make_workers(struct zr_bins *bins)
{
    size_t tiles = zr_tile_count(bins->width, bins->height);
    bins->workers = zr_arena_zero(bins->arena, (size_t)bins->worker_count, sizeof *bins->workers);
    for (int i = 0; bins->workers && i < bins->worker_count; i++) {
        bins->workers[i].bins = bins;
        bins->workers[i].tiles = zr_arena_zero(bins->arena, tiles, sizeof *bins->workers[i].tiles);
    }
    return zr_arena_ok(bins->arena);
}

/* Collects all threads' large triangles in one array. */
static bool gather_large(struct zr_bins *bins)
{
    size_t count = 0;
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *block = bins->workers[i].large.first; block; block = block->next)
            count += block->used;
    bins->large = zr_arena_alloc(bins->arena, count, sizeof *bins->large);
    if (!bins->large) return false;
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *block = bins->workers[i].large.first; block; block = block->next)
            for (uint32_t k = 0; k < block->used; k++)
                bins->large[bins->large_count++] = ((const struct zr_bin_wides *)block)->items[k];
    return true;
}

static enum zr_status build(struct zr_team *team, const struct zr_cancel *cancel, struct zr_bins *bins)
{
    struct sorting sorting = {.bins = bins, .cancel = cancel, .sort = zr_binning_of(zr_team_isa(team))};
    if (!make_shares(&sorting)) return ZR_NO_MEMORY;
    if (sorting.share_count == 0) return ZR_OK; /* no need to wake threads */
    bins->fragments_size = bins->has_words ? sizeof(struct zr_bin_fragments) : offsetof(struct zr_bin_fragments, words);
    /* Few triangles are binned before a thread is awake (a fifth of a cube's time on two threads). */
    if (sorting.triangle_count <= TRIANGLES_PER_RANGE) team = NULL;
    bins->worker_count = zr_team_size(team);
    if ((uint32_t)bins->worker_count > sorting.share_count) bins->worker_count = (int)sorting.share_count;
    if (!make_workers(bins)) return ZR_NO_MEMORY;
    zr_team_shares(team, sorting.share_count, 1, sort_shares, &sorting);
    for (int i = 0; i < bins->worker_count; i++) {
        if (bins->workers[i].failed) return ZR_NO_MEMORY;
        zr_counts_add(&bins->counts, &bins->workers[i].counts);
    }
    if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
    return gather_large(bins) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_bins_build(const struct zr_run *run, const struct zr_geometry *geometry, enum zr_alpha_mode mode,
                             const struct zr_prepaint *prepaints, uint32_t width, uint32_t height, struct zr_bins *bins)
{
    *bins = (struct zr_bins){.arena = run->arena,
                             .geometry = geometry,
                             .mode = mode,
                             .prepaints = prepaints,
                             .width = width,
                             .height = height,
                             .columns = zr_tile_across(width)};
    pthread_mutex_init(&bins->arena_lock, NULL);
    enum zr_status status = build(run->team, run->cancel, bins);
    pthread_mutex_destroy(&bins->arena_lock);
    return status;
}
