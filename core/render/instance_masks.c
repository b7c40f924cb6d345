#include "render/instance_masks.h"

#include "base/run.h"
#include "render/pass.h"
#include "render/stage.h"
#include "scene/channels.h"
#include "scene/scene_edit.h"

enum { BUCKETS = 64, NONE = 0, ROWS_PER_RANGE = 16 };

/* Pixels of one instance in one tile. */
struct block {
    struct block *next;          /* of the tile */
    struct block *of_bucket;     /* while the tile is drawn */
    uint64_t rows[ZR_TILE_SIZE]; /* from the lowest; bit k: column k */
    uint32_t instance;
};

struct drawing {
    struct zr_pass pass;
    struct zr_scene scene; /* with edited materials */
    const struct zr_cancel *cancel;
    struct zr_frame *frame;
    struct block **tiles; /* list of blocks per tile */
};

/* ---- fragments of a tile ---- */

struct marking {
    struct zr_fragment_marks marks;
    struct drawing *drawing;
    struct block **list;
    struct block *buckets[BUCKETS]; /* by instance */
    const struct zr_draw *draw;
    uint64_t lost[ZR_TILE_SIZE]; /* rows without memory */
};

static struct block *make_block(struct marking *m, uint32_t instance)
{
    struct zr_layers_pool *pool = &m->drawing->pass.layers;
    pthread_mutex_lock(&pool->lock);
    struct block *block = zr_arena_zero(pool->arena, 1, sizeof *block);
    pthread_mutex_unlock(&pool->lock);
    if (!block) return NULL;
    block->instance = instance;
    block->next = *m->list;
    *m->list = block;
    block->of_bucket = m->buckets[instance % BUCKETS];
    m->buckets[instance % BUCKETS] = block;
    return block;
}

/* Marks the instance of the owner from now on. */
static void turn(struct zr_fragment_marks *marks, uint32_t owner)
{
    struct marking *m = (struct marking *)marks; /* its first member */
    m->draw = zr_draw_next(&m->drawing->pass.geometry, m->draw, owner - 1);
    const uint32_t instance = m->draw->instance;
    struct block *block = m->buckets[instance % BUCKETS];
    while (block && block->instance != instance)
        block = block->of_bucket;
    if (!block) block = make_block(m, instance);
    marks->begin = m->draw->first + 1;
    marks->end = m->draw->first + m->draw->count + 1;
    marks->rows = block ? block->rows : m->lost;
}

/* Marks all fragments, in any order. Returns false if cancelled. */
static bool mark_all(struct marking *m, uint32_t number, struct zr_tile *tile)
{
    const struct drawing *d = m->drawing;
    struct zr_fragments fragments = {.marks = &m->marks};
    tile->fragments = &fragments;
    const bool is_done = zr_visibility_fragments(d->pass.tiles.visibility, number, ZR_ALPHA_BLEND, d->cancel, tile);
    tile->fragments = NULL;
    return is_done;
}

/* Marks masked fragments that pass, layer by layer. */
static void mark_passing(struct marking *m, struct zr_layers *layers)
{
    const struct zr_tile_source *tiles = &m->drawing->pass.tiles;
    const struct zr_tile *layer = &layers->tile;
    for (uint32_t depth = 0; depth < layers->most; depth++) {
        if (zr_is_cancelled(m->drawing->cancel)) return;
        zr_layers_show(layers, depth);
        zr_paint_of(tiles->isa)->opacity(tiles->geometry, tiles->attributes, layer, layers->front[3]);
        for (int32_t y = 0; y < layer->height; y++)
            for (int32_t x = 0; x < layer->width; x++) {
                const int32_t place = y * ZR_TILE_STRIDE + x;
                const uint32_t owner = layer->owner[place];
                if (owner == 0) continue;
                m->draw = zr_draw_next(tiles->geometry, m->draw, owner - 1);
                if (zr_passes_cutoff(m->draw->material, layers->front[3][place]))
                    zr_fragment_marks_put(&m->marks, (uint32_t)place, 1, owner);
            }
    }
}

static void draw_tile(struct drawing *d, uint32_t number, struct zr_tile *tile)
{
    const struct zr_tile_source *tiles = &d->pass.tiles;
    const bool is_filled = tiles->any_blended && zr_visibility_has_any(tiles->visibility, number, ZR_ALPHA_BLEND);
    const bool is_masked = tiles->any_masked && zr_visibility_has_any(tiles->visibility, number, ZR_ALPHA_MASK);
    struct marking marking = {.marks = {.turn = turn, .stride = ZR_TILE_STRIDE},
                              .drawing = d,
                              .list = &d->tiles[number],
                              .draw = &d->pass.geometry.draws[0]};
    if (!is_filled && !is_masked) return;
    if (!zr_visibility_tile(tiles->visibility, number, d->cancel, tile)) return;
    if (tile->is_empty) zr_tile_begin(tile, NULL, 0, 0);
    if (is_filled && !mark_all(&marking, number, tile)) return;
    struct zr_layers *layers = is_masked ? zr_layers_take(tiles->layers) : NULL;
    if (!layers) return;
    if (zr_layers_find(tiles, number, ZR_ALPHA_MASK, d->cancel, tile, layers)) mark_passing(&marking, layers);
    zr_layers_give(tiles->layers, layers);
}

static void draw_range(void *context, size_t begin, size_t end)
{
    struct zr_tile tile;
    for (size_t number = begin; number < end; number++)
        draw_tile(context, (uint32_t)number, &tile);
}

static enum zr_status status_of(const struct drawing *d, const struct zr_arena *arena)
{
    if (zr_is_cancelled(d->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Opaque surfaces keep their fragments, masked ones are tested, and blended ones are left out. */
static void reveal(struct zr_material *material)
{
    if (material->alpha_mode == ZR_ALPHA_BLEND) {
        material->is_hidden = material->unfilled = true;
        material->outline = ZR_OUTLINE_NONE;
    }
    if (material->alpha_mode == ZR_ALPHA_OPAQUE) material->alpha_mode = ZR_ALPHA_BLEND;
}

static enum zr_status draw_tiles(const struct zr_run *run, const struct zr_scene *scene, struct drawing *d)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const struct zr_frame *frame = d->frame;
    const size_t count = zr_tile_count(frame->width, frame->height);
    d->tiles = zr_arena_zero(run->scratch, count, sizeof(struct block *));
    if (!d->tiles || !zr_scene_edit_materials(run->scratch, scene, reveal, &d->scene)) return ZR_NO_MEMORY;
    const struct zr_pass_desc desc = {.scene = &d->scene,
                                      .camera = &frame->camera,
                                      .window = zr_window_of(scene, frame->width, frame->height, 1),
                                      .wants = {.layers = true}};
    const enum zr_status status = zr_pass_make(&inner, &desc, &d->pass);
    if (status != ZR_OK) return status;
    if (d->pass.tiles.layers) zr_team_ranges(run->team, count, 1, draw_range, d);
    return status_of(d, run->scratch);
}

/* ---- masks of instances ---- */

struct joining {
    const struct drawing *drawing;
    uint32_t *numbers; /* 1 + number of the mask, per instance; NONE: not in the window */
    struct zr_instance_mask *masks;
    uint32_t count;
};

/* Returns the rows of a tile in the window. */
static uint32_t rows_in(const struct zr_frame *frame, uint32_t tile)
{
    const uint32_t left = frame->height - tile / zr_tile_across(frame->width) * ZR_TILE_SIZE;
    return left < ZR_TILE_SIZE ? left : ZR_TILE_SIZE;
}

static uint32_t row_of(const struct zr_frame *frame, uint32_t tile, uint32_t row)
{
    return frame->height - 1 - (tile / zr_tile_across(frame->width) * ZR_TILE_SIZE + row);
}

static uint32_t column_of(const struct zr_frame *frame, uint32_t tile)
{
    return tile % zr_tile_across(frame->width) * ZR_TILE_SIZE;
}

/* Returns the bits of a row in the window. */
static uint64_t bits_in(const struct zr_frame *frame, uint32_t tile, const struct block *block, uint32_t row)
{
    const uint32_t left = frame->width - column_of(frame, tile);
    return left < ZR_TILE_SIZE ? block->rows[row] & ((UINT64_C(1) << left) - 1) : block->rows[row];
}

static void extend(struct zr_mask_extent *extent, uint32_t column, uint32_t y, uint64_t bits)
{
    const uint32_t x0 = column + (uint32_t)__builtin_ctzll(bits), x1 = column + 64 - (uint32_t)__builtin_clzll(bits);
    if (extent->pixels == 0) *extent = (struct zr_mask_extent){0, {x0, y, x1, y + 1}};
    if (x0 < extent->box[0]) extent->box[0] = x0;
    if (y < extent->box[1]) extent->box[1] = y;
    if (x1 > extent->box[2]) extent->box[2] = x1;
    if (y + 1 > extent->box[3]) extent->box[3] = y + 1;
    extent->pixels += (uint64_t)__builtin_popcountll(bits);
}

/* Calls visit for each block of each tile. Returns false if cancelled. */
static bool walk_blocks(struct joining *j, void (*visit)(struct joining *, uint32_t tile, const struct block *block))
{
    const struct drawing *d = j->drawing;
    const size_t count = zr_tile_count(d->frame->width, d->frame->height);
    for (uint32_t tile = 0; tile < count; tile++)
        for (const struct block *block = d->tiles[tile]; block; block = block->next) {
            if (zr_is_cancelled(d->cancel)) return false;
            visit(j, tile, block);
        }
    return true;
}

static void note(struct joining *j, uint32_t tile, const struct block *block)
{
    (void)tile;
    if (j->numbers[block->instance] == NONE) j->count++;
    j->numbers[block->instance] = 1;
}

static void measure(struct joining *j, uint32_t tile, const struct block *block)
{
    const struct zr_frame *frame = j->drawing->frame;
    struct zr_instance_mask *mask = &j->masks[j->numbers[block->instance] - 1];
    for (uint32_t row = 0; row < rows_in(frame, tile); row++)
        if (bits_in(frame, tile, block, row) != 0)
            extend(&mask->amodal, column_of(frame, tile), row_of(frame, tile, row), bits_in(frame, tile, block, row));
}

static void copy(struct joining *j, uint32_t tile, const struct block *block)
{
    const struct zr_frame *frame = j->drawing->frame;
    const struct zr_instance_mask *mask = &j->masks[j->numbers[block->instance] - 1];
    uint64_t *bits = mask->amodal_bits + (column_of(frame, tile) - mask->left) / 64;
    for (uint32_t row = 0; row < rows_in(frame, tile); row++)
        if (bits_in(frame, tile, block, row) != 0)
            bits[(size_t)(row_of(frame, tile, row) - mask->amodal.box[1]) * mask->words] =
                bits_in(frame, tile, block, row);
}

/* Numbers the masks in the order of instances. */
static bool number_masks(struct joining *j, struct zr_arena *arena, uint32_t instance_count)
{
    j->masks = zr_arena_zero(arena, j->count, sizeof *j->masks);
    if (!j->masks) return false;
    uint32_t next = 0;
    for (uint32_t i = 0; i < instance_count; i++) {
        if (j->numbers[i] == NONE) continue;
        j->masks[next].instance = i;
        j->numbers[i] = ++next;
    }
    return true;
}

void zr_instance_mask_make_bits(struct zr_arena *arena, struct zr_instance_mask *mask)
{
    const uint32_t *box = mask->amodal.box;
    mask->left = box[0] / 64 * 64;
    mask->words = (box[2] - mask->left + 63) / 64;
    const size_t words = (size_t)mask->words * (box[3] - box[1]);
    mask->amodal_bits = zr_arena_zero(arena, words, sizeof(uint64_t));
    mask->visible_bits = zr_arena_zero(arena, words, sizeof(uint64_t));
}

static bool make_bits(struct joining *j, struct zr_arena *arena)
{
    for (uint32_t i = 0; i < j->count && !zr_is_cancelled(j->drawing->cancel); i++)
        zr_instance_mask_make_bits(arena, &j->masks[i]);
    return zr_arena_ok(arena);
}

/* Marks the visible pixels of some rows. */
static void mark_visible(void *context, size_t begin, size_t end)
{
    const struct joining *j = context;
    const struct zr_frame *frame = j->drawing->frame;
    for (size_t y = begin; y < end && !zr_is_cancelled(j->drawing->cancel); y++) {
        const uint32_t *ids = (const uint32_t *)frame->channels[ZR_CHANNEL_INSTANCE_ID] + y * frame->width;
        for (uint32_t x = 0; x < frame->width; x++) {
            const uint32_t number = ids[x] == 0 ? NONE : j->numbers[ids[x] - 1];
            if (number == NONE) continue;
            const struct zr_instance_mask *mask = &j->masks[number - 1];
            if (y < mask->amodal.box[1] || y >= mask->amodal.box[3] || x < mask->left) continue;
            const size_t word = (x - mask->left) / 64;
            if (word >= mask->words) continue;
            mask->visible_bits[(y - mask->amodal.box[1]) * mask->words + word] |= UINT64_C(1) << x % 64;
        }
    }
}

static void measure_visible(struct zr_instance_mask *mask)
{
    const uint64_t *bits = mask->visible_bits;
    for (uint32_t y = mask->amodal.box[1]; y < mask->amodal.box[3]; y++)
        for (uint32_t word = 0; word < mask->words; word++, bits++)
            if (*bits != 0) extend(&mask->visible, mask->left + 64 * word, y, *bits);
}

static enum zr_status join(const struct zr_run *run, const struct zr_scene *scene, struct drawing *d,
                           struct zr_instance_masks *out)
{
    struct joining j = {.drawing = d, .numbers = zr_arena_zero(run->scratch, scene->instance_count, sizeof *j.numbers)};
    if (!j.numbers) return ZR_NO_MEMORY;
    if (!walk_blocks(&j, note)) return ZR_CANCELLED;
    if (!number_masks(&j, run->arena, scene->instance_count)) return ZR_NO_MEMORY;
    if (!walk_blocks(&j, measure)) return ZR_CANCELLED;
    if (!make_bits(&j, run->arena)) return ZR_NO_MEMORY;
    if (zr_is_cancelled(d->cancel) || !walk_blocks(&j, copy)) return ZR_CANCELLED;
    zr_team_ranges(run->team, d->frame->height, ROWS_PER_RANGE, mark_visible, &j);
    for (uint32_t i = 0; i < j.count && !zr_is_cancelled(d->cancel); i++)
        measure_visible(&j.masks[i]);
    *out = (struct zr_instance_masks){j.count, j.masks};
    return status_of(d, run->arena);
}

enum zr_status zr_instance_masks_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    struct drawing *d = zr_arena_zero(run->scratch, 1, sizeof *d);
    struct zr_instance_masks *masks = zr_arena_zero(run->arena, 1, sizeof *masks);
    if (!d || !masks) return ZR_NO_MEMORY;
    d->cancel = run->cancel;
    d->frame = frame;
    enum zr_status status = ZR_OK;
    STAGE(draw_tiles(run, scene, d));
    STAGE(join(run, scene, d, masks));
    if (status == ZR_OK) frame->masks = masks;
    return status;
}
