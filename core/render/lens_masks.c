#include "render/lens_masks.h"

#include "base/run.h"
#include "render/instance_masks.h"

/* Side of the cells of the pinhole picture, in pixels. */
enum { CELL = 32 };

struct taking {
    const struct zr_remap *remap;
    const struct zr_instance_masks *from;
    const struct zr_cancel *cancel;
    uint32_t across;              /* cells per row of cells */
    struct zr_mask_extent *cells; /* per cell: pixels of the view that look it up */
    struct zr_instance_mask *out; /* per mask of `from` */
};

/* Adds a pixel. They come row by row. */
static void extend(struct zr_mask_extent *extent, uint32_t x, uint32_t y)
{
    if (extent->pixels == 0) *extent = (struct zr_mask_extent){0, {x, y, x + 1, y + 1}};
    if (x < extent->box[0]) extent->box[0] = x;
    if (x >= extent->box[2]) extent->box[2] = x + 1;
    extent->box[3] = y + 1;
    extent->pixels++;
}

static void find_cells(const struct taking *t)
{
    const struct zr_remap *remap = t->remap;
    struct zr_remap_pixel from;
    for (uint32_t y = 0; y < remap->height && !zr_is_cancelled(t->cancel); y++)
        for (uint32_t x = 0; x < remap->width; x++)
            if (zr_remap_nearest_pixel(remap, x, y, &from))
                extend(&t->cells[(size_t)(from.y / CELL) * t->across + from.x / CELL], x, y);
}

/* Returns a box of the view around all pixels that look up a box, x0, y0, x1, y1, of the pinhole picture. */
static struct zr_mask_extent view_box_of(const struct taking *t, const uint32_t *box)
{
    struct zr_mask_extent all = {.pixels = 0};
    for (uint32_t row = box[1] / CELL; row * CELL < box[3]; row++)
        for (uint32_t column = box[0] / CELL; column * CELL < box[2]; column++) {
            const struct zr_mask_extent *cell = &t->cells[(size_t)row * t->across + column];
            if (cell->pixels == 0) continue;
            if (all.pixels == 0) all = *cell;
            for (int i = 0; i < 2; i++) {
                if (cell->box[i] < all.box[i]) all.box[i] = cell->box[i];
                if (cell->box[2 + i] > all.box[2 + i]) all.box[2 + i] = cell->box[2 + i];
            }
        }
    return all;
}

static bool has_bit(const struct zr_instance_mask *mask, const uint64_t *bits, struct zr_remap_pixel pixel)
{
    const uint32_t *box = mask->amodal.box;
    if (pixel.x < box[0] || pixel.x >= box[2] || pixel.y < box[1] || pixel.y >= box[3]) return false;
    const uint32_t column = pixel.x - mask->left;
    return bits[(size_t)(pixel.y - box[1]) * mask->words + column / 64] >> column % 64 & 1u;
}

static void set_bit(const struct zr_instance_mask *mask, uint64_t *bits, uint32_t x, uint32_t y)
{
    const size_t column = x - mask->left;
    if (bits) bits[(size_t)(y - mask->amodal.box[1]) * mask->words + column / 64] |= UINT64_C(1) << column % 64;
}

/* Measures a mask of the view; sets its bits once they are allocated. */
static void take_mask(const struct taking *t, const struct zr_instance_mask *from, struct zr_instance_mask *out)
{
    const struct zr_mask_extent within = view_box_of(t, from->amodal.box);
    const bool is_measured = out->amodal_bits != NULL;
    struct zr_mask_extent amodal = {0}, visible = {0};
    struct zr_remap_pixel pixel;
    if (within.pixels == 0) return;
    for (uint32_t y = within.box[1]; y < within.box[3] && !zr_is_cancelled(t->cancel); y++)
        for (uint32_t x = within.box[0]; x < within.box[2]; x++) {
            if (!zr_remap_nearest_pixel(t->remap, x, y, &pixel) || !has_bit(from, from->amodal_bits, pixel)) continue;
            extend(&amodal, x, y);
            set_bit(out, out->amodal_bits, x, y);
            if (!has_bit(from, from->visible_bits, pixel)) continue;
            extend(&visible, x, y);
            set_bit(out, out->visible_bits, x, y);
        }
    if (is_measured) return;
    out->instance = from->instance;
    out->amodal = amodal;
    out->visible = visible;
}

static void take_masks(void *context, size_t begin, size_t end)
{
    const struct taking *t = context;
    for (; begin < end; begin++)
        if (!t->out[begin].amodal_bits || t->out[begin].amodal.pixels > 0)
            take_mask(t, &t->from->at[begin], &t->out[begin]);
}

enum zr_status zr_lens_masks_take(const struct zr_run *run, const struct zr_remap *remap,
                                  const struct zr_instance_masks *pinhole, struct zr_frame *frame)
{
    const uint32_t across = (remap->source_width + CELL - 1) / CELL, down = (remap->source_height + CELL - 1) / CELL;
    struct zr_instance_masks *masks = zr_arena_zero(run->arena, 1, sizeof *masks);
    struct taking t = {.remap = remap,
                       .from = pinhole,
                       .cancel = run->cancel,
                       .across = across,
                       .cells = zr_arena_zero(run->scratch, (size_t)across * down, sizeof *t.cells),
                       .out = zr_arena_zero(run->arena, pinhole->count, sizeof *t.out)};
    if (!masks || !t.cells || !t.out) return ZR_NO_MEMORY;
    find_cells(&t);
    zr_team_ranges(run->team, pinhole->count, 1, take_masks, &t);
    for (uint32_t i = 0; i < pinhole->count; i++)
        zr_instance_mask_make_bits(run->arena, &t.out[i]);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, pinhole->count, 1, take_masks, &t);
    for (uint32_t i = 0; i < pinhole->count; i++)
        if (t.out[i].amodal.pixels > 0) t.out[masks->count++] = t.out[i];
    masks->at = t.out;
    frame->masks = masks;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
