#include "render/lens_masks.h"

#include "render/instance_masks.h"

/* Rows of the pinhole picture that a row of the view looks up. */
struct span {
    size_t first, last; /* first > last: none */
};

struct taking {
    const struct zr_remap *remap;
    const struct zr_instance_masks *from;
    const struct zr_cancel *cancel;
    struct span *spans;           /* per row of the view */
    struct zr_instance_mask *out; /* per mask of `from` */
};

static void find_spans(void *context, size_t begin, size_t end)
{
    const struct taking *t = context;
    const struct zr_remap *remap = t->remap;
    for (size_t y = begin; y < end && !zr_is_cancelled(t->cancel); y++) {
        struct span span = {SIZE_MAX, 0};
        for (uint32_t x = 0; x < remap->width; x++) {
            const size_t pixel = zr_remap_nearest_pixel(remap, remap->places[y * remap->width + x]);
            if (pixel == SIZE_MAX) continue;
            const size_t row = pixel / remap->source_width;
            if (row < span.first) span.first = row;
            if (row > span.last) span.last = row;
        }
        t->spans[y] = span;
    }
}

static bool has_bit(const struct zr_instance_mask *mask, const uint64_t *bits, size_t x, size_t y)
{
    const uint32_t *box = mask->amodal.box;
    if (x < box[0] || x >= box[2] || y < box[1] || y >= box[3]) return false;
    const size_t column = x - mask->left;
    return bits[(y - box[1]) * mask->words + column / 64] >> column % 64 & 1u;
}

static void extend(struct zr_mask_extent *extent, uint32_t x, uint32_t y)
{
    if (extent->pixels == 0) *extent = (struct zr_mask_extent){0, {x, y, x + 1, y + 1}};
    if (x < extent->box[0]) extent->box[0] = x;
    if (x >= extent->box[2]) extent->box[2] = x + 1;
    extent->box[3] = y + 1; /* rows come in order */
    extent->pixels++;
}

static void set_bit(const struct zr_instance_mask *mask, uint64_t *bits, uint32_t x, uint32_t y)
{
    const size_t column = x - mask->left;
    if (bits) bits[(size_t)(y - mask->amodal.box[1]) * mask->words + column / 64] |= UINT64_C(1) << column % 64;
}

/* Measures a mask of the view; sets its bits once they are allocated. */
static void take_mask(const struct taking *t, const struct zr_instance_mask *from, struct zr_instance_mask *out)
{
    const struct zr_remap *remap = t->remap;
    const bool is_measured = out->amodal_bits != NULL;
    struct zr_mask_extent amodal = {0}, visible = {0};
    for (uint32_t y = 0; y < remap->height && !zr_is_cancelled(t->cancel); y++) {
        const struct span *span = &t->spans[y];
        if (span->first >= from->amodal.box[3] || span->last < from->amodal.box[1] || span->first > span->last)
            continue;
        for (uint32_t x = 0; x < remap->width; x++) {
            const size_t pixel = zr_remap_nearest_pixel(remap, remap->places[(size_t)y * remap->width + x]);
            if (pixel == SIZE_MAX) continue;
            const size_t sx = pixel % remap->source_width, sy = pixel / remap->source_width;
            if (!has_bit(from, from->amodal_bits, sx, sy)) continue;
            extend(&amodal, x, y);
            set_bit(out, out->amodal_bits, x, y);
            if (!has_bit(from, from->visible_bits, sx, sy)) continue;
            extend(&visible, x, y);
            set_bit(out, out->visible_bits, x, y);
        }
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

enum zr_status zr_lens_masks_take(struct zr_arena *arena, struct zr_team *team, const struct zr_remap *remap,
                                  const struct zr_instance_masks *pinhole, const struct zr_cancel *cancel,
                                  struct zr_frame *frame)
{
    enum { ROWS_A_RANGE = 16 };
    struct zr_instance_masks *masks = zr_arena_zero(arena, 1, sizeof *masks);
    struct taking t = {.remap = remap,
                       .from = pinhole,
                       .cancel = cancel,
                       .spans = zr_arena_alloc(arena, remap->height, sizeof *t.spans),
                       .out = zr_arena_zero(arena, pinhole->count, sizeof *t.out)};
    if (!masks || !t.spans || !t.out) return ZR_NO_MEMORY;
    zr_team_ranges(team, remap->height, ROWS_A_RANGE, find_spans, &t);
    zr_team_ranges(team, pinhole->count, 1, take_masks, &t);
    for (uint32_t i = 0; i < pinhole->count; i++)
        zr_instance_mask_make_bits(arena, &t.out[i]);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    zr_team_ranges(team, pinhole->count, 1, take_masks, &t);
    for (uint32_t i = 0; i < pinhole->count; i++)
        if (t.out[i].amodal.pixels > 0) t.out[masks->count++] = t.out[i];
    masks->at = t.out;
    frame->masks = masks;
    return zr_is_cancelled(cancel) ? ZR_CANCELLED : ZR_OK;
}
