#include "render/layers/layers.h"

#include <string.h>

#include "base/mutant.h"
#include "raster/halfspace.h"

/* ---- the pool ---- */

struct zr_layers *zr_layers_take(struct zr_layers_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    struct zr_layers *layers = pool->free;
    if (layers) {
        pool->free = layers->next;
    } else {
        layers = zr_arena_alloc(pool->arena, 1, sizeof *layers);
        if (layers) layers->fragments = (struct zr_fragments){.ends = NULL};
        if (layers) layers->walk = NULL;
    }
    pthread_mutex_unlock(&pool->lock);
    return layers;
}

void zr_layers_give(struct zr_layers_pool *pool, struct zr_layers *layers)
{
    pthread_mutex_lock(&pool->lock);
    layers->next = pool->free;
    pool->free = layers;
    pthread_mutex_unlock(&pool->lock);
}

/* ---- lists of a tile ---- */

static uint32_t place_of(int32_t x, int32_t y)
{
    return (uint32_t)(y * ZR_TILE_STRIDE + x);
}

static bool put_all(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode,
                    const struct zr_cancel *cancel, struct zr_tile *tile, struct zr_fragments *fragments)
{
    tile->fragments = fragments;
    const bool complete = zr_visibility_fragments(tiles->visibility, number, mode, cancel, tile);
    tile->fragments = NULL;
    return complete;
}

static bool put_twice(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode,
                      const struct zr_cancel *cancel, struct zr_tile *tile, struct zr_fragments *fragments)
{
    struct zr_layers_pool *pool = tiles->layers;
    return zr_fragments_begin(pool->arena, &pool->lock, ZR_LAYER_FLOATS, fragments) &&
           put_all(tiles, number, mode, cancel, tile, fragments) &&
           zr_fragments_prefix_sum(pool->arena, &pool->lock, fragments) &&
           put_all(tiles, number, mode, cancel, tile, fragments);
}

/* Moves the opaque samples back by one float, so that fragments of equal depth are in front of them. Uncovered samples
 * stay: nothing is drawn at the far plane. Saves the depths in `kept`. */
static void let_equal_pass(struct zr_tile *tile, float *kept)
{
    memcpy(kept, tile->depth, sizeof tile->depth);
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const uint32_t i = place_of(x, y);
            const float depth = zr_fragment_depth(zr_fragment_key(tile->depth[i], 0) + (UINT64_C(1) << 32));
            if (tile->depth[i] < 1.0f) tile->depth[i] = ZR_MUTANT(layers_hidden_at_equal, depth, tile->depth[i]);
        }
}

bool zr_layers_put_blended(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                           struct zr_tile *tile, struct zr_fragments *fragments)
{
    float kept[ZR_LAYER_FLOATS];
    const bool shows_any = zr_paint_of(tiles->isa)->count(tile) > 0;
    if (shows_any) let_equal_pass(tile, kept);
    const bool is_complete = put_all(tiles, number, ZR_ALPHA_BLEND, cancel, tile, fragments);
    if (shows_any) memcpy(tile->depth, kept, sizeof tile->depth);
    return is_complete;
}

bool zr_layers_find(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode,
                    const struct zr_cancel *cancel, struct zr_tile *tile, struct zr_layers *layers)
{
    struct zr_fragments *fragments = &layers->fragments;
    if (mode == ZR_ALPHA_BLEND) let_equal_pass(tile, layers->tile.depth);
    const bool is_listed = put_twice(tiles, number, mode, cancel, tile, fragments);
    if (mode == ZR_ALPHA_BLEND) memcpy(tile->depth, layers->tile.depth, sizeof tile->depth);
    if (!is_listed) return false;
    zr_fragments_sort(cancel, fragments);
    layers->most = 0;
    for (uint32_t i = 0; i < fragments->places; i++) {
        const uint32_t count = fragments->ends[i + 1] - fragments->ends[i];
        if (count > layers->most) layers->most = count;
    }
    struct zr_tile *layer = &layers->tile;
    layer->x = tile->x;
    layer->y = tile->y;
    layer->width = tile->width;
    layer->height = tile->height;
    layer->fragments = NULL;
    layer->is_empty = layer->has_block_owners = layer->has_early_color = false;
    layer->unwritten = 0;
    return true;
}

/* Writes one fragment to the layer; `any` false: an uncovered sample. */
static void show(struct zr_layers *layers, uint32_t place, bool any, uint64_t key)
{
    layers->tile.owner[place] = any ? zr_fragment_owner(key) : 0;
    layers->tile.depth[place] = any ? zr_fragment_depth(key) : 1.0f;
}

void zr_layers_show(struct zr_layers *layers, uint32_t depth)
{
    for (uint32_t place = 0; place < ZR_LAYER_FLOATS; place++) {
        uint32_t count;
        const uint64_t *keys = zr_fragments_of(&layers->fragments, place, &count);
        show(layers, place, depth < count, depth < count ? keys[count - 1 - depth] : 0);
    }
}

/* ---- masks ---- */

static bool has_any(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode)
{
    return tiles->layers && zr_visibility_has_any(tiles->visibility, number, mode);
}

bool zr_layers_has_blended(const struct zr_tile_source *tiles, uint32_t number)
{
    return tiles->any_blended && has_any(tiles, number, ZR_ALPHA_BLEND);
}

static bool passes(const struct zr_tile_source *tiles, uint32_t owner, float opacity)
{
    const struct zr_draw *draw = zr_draw_of(tiles->geometry, owner - 1);
    return zr_passes_cutoff(draw->material, opacity);
}

/* Moves fragments that pass to the tile, unless a nearer one has passed. */
static void pass_layer(const struct zr_tile_source *tiles, const struct zr_layers *layers, uint8_t *done,
                       struct zr_tile *tile)
{
    const struct zr_tile *layer = &layers->tile;
    for (uint32_t i = 0; i < ZR_LAYER_FLOATS; i++) {
        if (layer->owner[i] == 0 || done[i] || !passes(tiles, layer->owner[i], layers->front[3][i])) continue;
        done[i] = true;
        tile->owner[i] = layer->owner[i];
        tile->depth[i] = layer->depth[i];
        if (tile->has_early_color) tile->early_color[i] = 0;
    }
}

/* Tests layers from front to back. Returns false if some pixel has fragments but none passed. */
static bool pass_all(const struct zr_tile_source *tiles, struct zr_layers *layers, const struct zr_cancel *cancel,
                     struct zr_tile *tile)
{
    uint8_t done[ZR_LAYER_FLOATS] = {false};
    for (uint32_t at = 0; at < layers->most && !zr_is_cancelled(cancel); at++) {
        for (uint32_t place = 0; place < ZR_LAYER_FLOATS; place++) {
            uint32_t count;
            const uint64_t *keys = zr_fragments_of(&layers->fragments, place, &count);
            const bool any = at < count && !done[place];
            show(layers, place, any, any ? keys[at] : 0);
        }
        zr_paint_of(tiles->isa)->opacity(tiles->geometry, tiles->attributes, &layers->tile, layers->front[3]);
        pass_layer(tiles, layers, done, tile);
    }
    for (uint32_t place = 0; place < ZR_LAYER_FLOATS; place++)
        if (!done[place] && layers->fragments.ends[place] < layers->fragments.ends[place + 1]) return false;
    return true;
}

static void count_masked(struct zr_layers_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    pool->masked_tiles++;
    pthread_mutex_unlock(&pool->lock);
}

void zr_layers_write_all(const struct zr_tile_source *tiles, struct zr_tile *tile)
{
    if (tile->is_empty)
        zr_tile_begin(tile, NULL, 0, 0);
    else
        zr_halfspace_of(tiles->isa)->flush(tile);
    tile->has_block_owners = false;
}

bool zr_layers_mask(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                    struct zr_tile *tile)
{
    const bool masked = tiles->any_masked && has_any(tiles, number, ZR_ALPHA_MASK);
    if (masked || zr_layers_has_blended(tiles, number)) zr_layers_write_all(tiles, tile);
    if (!masked) return true;
    struct zr_layers *layers = zr_layers_take(tiles->layers);
    if (!layers) return false;
    const bool found = zr_layers_find(tiles, number, ZR_ALPHA_MASK, cancel, tile, layers);
    if (found && !pass_all(tiles, layers, cancel, tile)) count_masked(tiles->layers);
    zr_layers_give(tiles->layers, layers);
    return found && !zr_is_cancelled(cancel);
}

/* ---- blending ---- */

/* Starts the sum with the tile's colours, or the background's times its opacity. */
static void begin_sum(const struct zr_tile_source *tiles, const struct zr_tile *tile, struct zr_layers *layers)
{
    const zr_vec4 background = tiles->scene->background;
    float *const sum[4] = {layers->sum[0], layers->sum[1], layers->sum[2], layers->sum[3]};
    const float premultiplied[4] = {background.x * background.w, background.y * background.w,
                                    background.z * background.w, background.w};
    zr_paint_of(tiles->isa)->floats(tiles->geometry, tiles->attributes, tile, sum);
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const uint32_t i = place_of(x, y);
            const bool owned = tile->owner[i] > 0; /* beyond width and height, owners are unwritten */
            for (int k = 0; k < 3; k++)
                sum[k][i] = owned ? sum[k][i] : premultiplied[k];
            sum[3][i] = owned ? 1.0f : premultiplied[3];
        }
}

static void add_layers(const struct zr_tile_source *tiles, const struct zr_cancel *cancel, struct zr_layers *layers)
{
    const struct zr_paint *paint = zr_paint_of(tiles->isa);
    float *const front[4] = {layers->front[0], layers->front[1], layers->front[2], layers->front[3]};
    float *const sum[4] = {layers->sum[0], layers->sum[1], layers->sum[2], layers->sum[3]};
    const float *const shaded[4] = {front[0], front[1], front[2], front[3]};
    for (uint32_t depth = 0; depth < layers->most && !zr_is_cancelled(cancel); depth++) {
        zr_layers_show(layers, ZR_MUTANT(layers_front_first, depth, layers->most - 1 - depth));
        paint->floats(tiles->geometry, tiles->attributes, &layers->tile, front);
        paint->blend(&layers->tile, shaded, sum);
    }
}

bool zr_layers_blend(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                     struct zr_tile *tile, bool summed, struct zr_layers **blended)
{
    *blended = NULL;
    if (!zr_layers_has_blended(tiles, number)) return true;
    struct zr_layers *layers = zr_layers_take(tiles->layers);
    if (!layers) return false;
    const bool found = zr_layers_find(tiles, number, ZR_ALPHA_BLEND, cancel, tile, layers);
    if (found && layers->most > 0) {
        if (summed) begin_sum(tiles, tile, layers);
        if (summed) add_layers(tiles, cancel, layers);
        *blended = layers;
    } else {
        zr_layers_give(tiles->layers, layers);
    }
    return found && !zr_is_cancelled(cancel);
}

/* Over an opaque background the opacity is 1, without the rounding of the sum. */
uint32_t zr_layers_put(const struct zr_tile_source *tiles, struct zr_layers *blended, const struct zr_tile *tile,
                       const struct zr_pixel_rows *out)
{
    const zr_vec4 background = tiles->scene->background;
    const float *const sum[4] = {blended->sum[0], blended->sum[1], blended->sum[2], blended->sum[3]};
    const uint32_t *ends = blended->fragments.ends;
    uint32_t uncovered = 0;
    zr_paint_of(tiles->isa)->pack(tile, sum, ends, background.w >= 1.0f, zr_rgba_make(background), out);
    for (int32_t y = 0; y < tile->height; y++)
        for (uint32_t i = place_of(0, y); i < place_of(tile->width, y); i++)
            uncovered += tile->owner[i] == 0 && ends[i] < ends[i + 1];
    zr_layers_give(tiles->layers, blended);
    return uncovered;
}
