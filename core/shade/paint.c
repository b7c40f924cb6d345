#include "shade/paint.h"

#include "base/fast.h"
#include "base/rgba.h"
#include "raster/line.h"
#include "shade/early.h"

const struct zr_paint *zr_paint_of(enum zr_isa isa)
{
    static const struct zr_paint *const table[ZR_ISA_COUNT] = ZR_KERNELS(&zr_paint);
    return table[isa];
}

/* ---- packed colours ---- */

/* Where there are fewer pixels for each colour, packing takes longer than it saves (2 % of a million triangles at
 * 1920x1080). */
enum { PIXELS_A_COLOR = 4, COLORS_A_RANGE = 4096 };

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

/* Draws of one mesh follow one another, and share what is packed. */
static bool pack_colors(struct zr_arena *arena, struct zr_team *team, struct zr_surface *surfaces, uint32_t count,
                        uint64_t pixels)
{
    const struct zr_surface *last = NULL; /* that was packed */
    for (uint32_t i = 0; i < count; i++) {
        struct zr_surface *surface = &surfaces[i];
        const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
        if (!color->values || !zr_rate_is_flat(color->rate) || surface->packed || surface->sided) continue;
        if (last && last->attributes[ZR_ATTRIBUTE_COLOR].values == color->values &&
            last->color_count == surface->color_count) {
            surface->packed = last->packed;
            continue;
        }
        if (!ZR_FAST(packed_later, (uint64_t)surface->color_count * PIXELS_A_COLOR <= pixels)) continue;
        uint32_t *out = zr_arena_alloc(arena, surface->color_count, sizeof *out);
        if (!out) return false;
        struct packing packing = {zr_rgba_pack_of(zr_team_isa(team)), color->values, out};
        zr_team_ranges(team, surface->color_count, COLORS_A_RANGE, pack_range, &packing);
        surface->packed = out;
        last = surface;
        pixels -= (uint64_t)surface->color_count * PIXELS_A_COLOR;
    }
    return true;
}

/* ---- payloads ---- */

static size_t words_of_backs(const struct zr_surface *surface)
{
    const bool wanted = surface->sided && zr_draw_is_plain(surface->draw) && !zr_surface_is_smooth(surface);
    return wanted ? (surface->draw->count - 1) / 32 + 1 : 0;
}

static void look_first(const struct zr_surface *surface, struct zr_payload *payload)
{
    const struct zr_draw *draw = surface->draw;
    const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
    const size_t word = sizeof(uint32_t);
    payload->first = (uintptr_t)draw; /* which is at hand: nothing to ask for */
    if (!color->values && !surface->packed) return;
    if (zr_surface_is_smooth(surface) || (color->rate == ZR_RATE_FIRST_VERTEX && !draw->faces)) {
        payload->first = (uintptr_t)draw->corners;
        payload->step = 3 * word;
    } else if (draw->faces) {
        payload->first = (uintptr_t)draw->faces;
        payload->step = word;
    } else if (color->rate == ZR_RATE_FIRST_CORNER) {
        payload->first = (uintptr_t)(draw->mesh->face_offsets + draw->first_face);
        payload->step = word;
    } else if (surface->packed) {
        payload->first = (uintptr_t)(surface->packed + draw->first_face);
        payload->step = word;
    } else {
        payload->first = (uintptr_t)(color->values + draw->first_face);
        payload->step = sizeof *color->values;
    }
}

enum zr_status zr_paint_prepare(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                struct zr_surfaces *surfaces, uint64_t pixels, const struct zr_payload **payloads)
{
    const uint32_t count = geometry->draw_count;
    struct zr_payload *out = zr_arena_zero(arena, (size_t)count + 1, sizeof *out);
    size_t words = 0;
    if (!out || !pack_colors(arena, team, surfaces->of_draw, count, pixels)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        words += words_of_backs(&surfaces->of_draw[i]);
    uint32_t *backs = zr_arena_zero(arena, words, sizeof *backs);
    if (!backs) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        struct zr_surface *surface = &surfaces->of_draw[i];
        words = ZR_FAST(noted_backs, words_of_backs(surface) > 0) ? words_of_backs(surface) : 0;
        out[i] = (struct zr_payload){.context = surface, .draw = surface->draw, .backs = words > 0 ? backs : NULL};
        if (ZR_FAST(early_words, zr_surface_is_painted_early(surface))) out[i].make = zr_early_of(zr_team_isa(team));
        look_first(surface, &out[i]);
        surface->backs = out[i].backs;
        backs += words;
    }
    *payloads = out;
    return ZR_OK;
}

/* ---- lines ---- */

bool zr_line_color(const struct zr_geometry *geometry, const struct zr_surface *surface, uint32_t number,
                   struct zr_plane planes[1 + ZR_VALUES_FEW], uint32_t *color)
{
    const struct zr_draw *draw = surface->draw;
    const struct zr_triangle line = zr_triangle_of(geometry, draw, number);
    const bool back = surface->sided && line.back;
    const struct zr_attribute *from = &surface->attributes[back ? ZR_ATTRIBUTE_BACK_COLOR : ZR_ATTRIBUTE_COLOR];
    const uint32_t t = number - draw->first;
    if (!zr_surface_is_smooth(surface)) {
        const uint32_t n = zr_flat_number(draw, surface->attributes[ZR_ATTRIBUTE_COLOR].rate, t);
        *color =
            surface->packed ? surface->packed[back ? surface->color_count + n : n] : zr_rgba_opaque(from->values[n]);
        return true;
    }
    const uint32_t n0 = zr_smooth_number(draw, from->rate, t, 0), n1 = zr_smooth_number(draw, from->rate, t, 1);
    const struct zr_window_vertex *v0 = &geometry->vertices[line.v[0]], *v1 = &geometry->vertices[line.v[1]];
    const zr_vec4 c0 = from->values[n0], c1 = from->values[n1];
    const struct zr_line_basis basis = zr_line_basis_make(v0, v1);
    *color = zr_rgba_opaque(c0);
    if (n0 == n1) return true;
    planes[0] = zr_line_plane_make(&basis, v0->oow, v1->oow);
    planes[1] = zr_line_plane_make(&basis, c0.x * v0->oow, c1.x * v1->oow);
    planes[2] = zr_line_plane_make(&basis, c0.y * v0->oow, c1.y * v1->oow);
    planes[3] = zr_line_plane_make(&basis, c0.z * v0->oow, c1.z * v1->oow);
    return false;
}
