#include "mesh/features/borders.h"

#include <string.h>

struct walking {
    struct zr_feature_work *work;
    const struct zr_surface *surface;
    const uint32_t *sides; /* borders, ascending */
    uint32_t *firsts;      /* per place: the first border that begins there, as an index into `sides` */
    uint32_t *nexts;       /* per border: the next one that begins at the same place */
    bool *is_walked;
};

static uint32_t corner_of(const struct walking *w, uint32_t side, uint32_t step)
{
    return w->surface->corners[side / 3][(side % 3 + step) % 3];
}

/* Takes the first border that begins at a place and was not walked. */
static uint32_t take(const struct walking *w, uint32_t place)
{
    while (w->firsts[place] != ZR_NO_FACET) {
        const uint32_t border = w->firsts[place];
        w->firsts[place] = w->nexts[border];
        if (!w->is_walked[border]) return border;
    }
    return ZR_NO_FACET;
}

static struct zr_border walk(const struct walking *w, uint32_t border)
{
    struct zr_border out = {.edges = 0};
    const uint32_t begin = corner_of(w, w->sides[border], 0);
    uint32_t place = begin;
    for (; border != ZR_NO_FACET && zr_feature_has_steps(w->work, 1); border = take(w, place)) {
        const zr_dvec3 from = w->surface->places[corner_of(w, w->sides[border], 0)],
                       to = w->surface->places[corner_of(w, w->sides[border], 1)], edge = zr_dvec3_sub(to, from);
        const double length = sqrt(zr_dvec3_dot(edge, edge));
        w->is_walked[border] = true;
        out.center = zr_dvec3_add_scaled(zr_dvec3_add_scaled(out.center, from, 0.5 * length), to, 0.5 * length);
        out.length += length;
        out.edges++;
        place = corner_of(w, w->sides[border], 1);
        if (place == begin) break;
    }
    const double scale = out.length > 0.0 ? 1.0 / out.length : 0.0;
    out.center = (zr_dvec3){out.center.x * scale, out.center.y * scale, out.center.z * scale};
    out.is_closed = place == begin;
    return out;
}

/* Adds a loop to the list, by length. */
static void insert(struct zr_border *list, struct zr_borders *out, const struct zr_border *border)
{
    uint32_t k = out->count;
    if (out->count == ZR_BORDERS_MAX) out->omitted++;
    if (out->count == ZR_BORDERS_MAX && list[k - 1].length >= border->length) return;
    if (out->count == ZR_BORDERS_MAX)
        k--;
    else
        out->count++;
    for (; k > 0 && list[k - 1].length < border->length; k--)
        list[k] = list[k - 1];
    list[k] = *border;
}

bool zr_borders_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                     struct zr_borders *out)
{
    const struct zr_surface *surface = facets->surface;
    struct zr_border *list = zr_arena_alloc(arena, ZR_BORDERS_MAX, sizeof *list);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct walking w = {.work = work, .surface = surface, .sides = facets->borders};
    *out = (struct zr_borders){.at = list};
    w.firsts = zr_arena_alloc(&scratch, surface->place_count, sizeof *w.firsts);
    w.nexts = zr_arena_alloc(&scratch, facets->border_count, sizeof *w.nexts);
    w.is_walked = zr_arena_zero(&scratch, facets->border_count, sizeof *w.is_walked);
    const bool ok = list && zr_arena_ok(&scratch) && zr_feature_has_steps(work, surface->place_count / 16);
    if (ok) {
        memset(w.firsts, 0xff, surface->place_count * sizeof *w.firsts);
        for (uint32_t i = facets->border_count; i-- > 0 && zr_feature_has_steps(work, 1);) {
            const uint32_t place = corner_of(&w, w.sides[i], 0);
            w.nexts[i] = w.firsts[place];
            w.firsts[place] = i;
        }
        for (uint32_t i = 0; i < facets->border_count && !work->is_stopped; i++) {
            if (w.is_walked[i]) continue;
            const struct zr_border border = walk(&w, i);
            insert(list, out, &border);
        }
    }
    zr_arena_close_scratch(&scratch, arena);
    return ok && !work->is_stopped;
}
