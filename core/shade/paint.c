#include "shade/paint.h"

#include <string.h>

#include "base/fast.h"
#include "base/rgba.h"
#include "base/run.h"

/* ---- packed colours ---- */

/* With fewer pixels per colour, packing takes longer than it saves (2 % of a million triangles at 1920x1080). */
enum { PIXELS_PER_COLOR = 4, COLORS_PER_RANGE = 4096 };

struct packing {
    zr_rgba_pack_fn *pack;
    const zr_vec4 *colors;
    uint32_t *out;
};

static void pack_range(void *context, size_t begin, size_t end)
{
    const struct packing *p = context;
    p->pack(p->colors + begin, end - begin, p->out + begin);
}

/* Packs the colours of flat draws. Consecutive draws of one mesh share them. */
static bool pack_colors(struct zr_arena *arena, struct zr_team *team, struct zr_draw_attributes *attributes,
                        uint32_t count, uint64_t pixels)
{
    const struct zr_draw_attributes *last = NULL; /* last packed draw */
    for (uint32_t i = 0; i < count; i++) {
        struct zr_draw_attributes *of_draw = &attributes[i];
        const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
        if (!color->values || !zr_rate_is_flat(color->rate) || of_draw->packed || of_draw->two_sided_colors ||
            of_draw->is_per_pixel)
            continue;
        if (last && last->attributes[ZR_ATTRIBUTE_COLOR].values == color->values &&
            last->color_count == of_draw->color_count) {
            of_draw->packed = last->packed;
            continue;
        }
        if (!ZR_FAST(packed_later, (uint64_t)of_draw->color_count * PIXELS_PER_COLOR <= pixels)) continue;
        uint32_t *out = zr_arena_alloc(arena, of_draw->color_count, sizeof *out);
        if (!out) return false;
        struct packing packing = {zr_rgba_pack_of(zr_team_isa(team)), color->values, out};
        zr_team_ranges(team, of_draw->color_count, COLORS_PER_RANGE, pack_range, &packing);
        of_draw->packed = out;
        last = of_draw;
        pixels -= (uint64_t)of_draw->color_count * PIXELS_PER_COLOR;
    }
    return true;
}

/* ---- prepaint ---- */

static size_t back_word_count(const struct zr_draw_attributes *of_draw)
{
    const bool wanted = of_draw->two_sided_colors && zr_draw_is_plain(of_draw->draw) && !zr_draw_is_smooth(of_draw);
    return wanted ? (of_draw->draw->count - 1) / 32 + 1 : 0;
}

static void set_prefetch(const struct zr_draw_attributes *of_draw, struct zr_prepaint *prepaint)
{
    const struct zr_draw *draw = of_draw->draw;
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    const size_t word = sizeof(uint32_t);
    prepaint->first = (uintptr_t)draw; /* already in the cache: nothing to prefetch */
    if (!color->values && !of_draw->packed) return;
    if (zr_draw_is_smooth(of_draw) || (color->rate == ZR_RATE_FIRST_VERTEX && !draw->faces)) {
        prepaint->first = (uintptr_t)draw->corners;
        prepaint->step = 3 * word;
    } else if (draw->faces) {
        prepaint->first = (uintptr_t)draw->faces;
        prepaint->step = word;
    } else if (color->rate == ZR_RATE_FIRST_CORNER) {
        prepaint->first = (uintptr_t)(draw->mesh->face_offsets + draw->first_face);
        prepaint->step = word;
    } else if (of_draw->packed) {
        prepaint->first = (uintptr_t)(of_draw->packed + draw->first_face);
        prepaint->step = word;
    } else {
        prepaint->first = (uintptr_t)(color->values + draw->first_face);
        prepaint->step = sizeof *color->values;
    }
}

enum zr_status zr_paint_prepare(const struct zr_run *run, const struct zr_geometry *geometry,
                                struct zr_scene_attributes *attributes, uint64_t pixels,
                                const struct zr_prepaint **prepaints)
{
    const uint32_t count = geometry->draw_count;
    struct zr_prepaint *out = zr_arena_zero(run->arena, (size_t)count + 1, sizeof *out);
    size_t words = 0;
    if (!out || !pack_colors(run->arena, run->team, attributes->of_draw, count, pixels)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        words += back_word_count(&attributes->of_draw[i]);
    uint32_t *backs = zr_arena_zero(run->arena, words, sizeof *backs);
    if (!backs) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        struct zr_draw_attributes *of_draw = &attributes->of_draw[i];
        words = ZR_FAST(noted_backs, back_word_count(of_draw) > 0) ? back_word_count(of_draw) : 0;
        out[i] = (struct zr_prepaint){.context = of_draw, .draw = of_draw->draw, .backs = words > 0 ? backs : NULL};
        if (ZR_FAST(early_words, zr_draw_is_painted_early(of_draw))) out[i].make = zr_early_of(zr_team_isa(run->team));
        set_prefetch(of_draw, &out[i]);
        of_draw->backs = out[i].backs;
        backs += words;
    }
    *prepaints = out;
    return ZR_OK;
}
