#include "shade/paint.h"

#include <string.h>

#include "base/fast.h"
#include "base/rgba.h"
#include "raster/line.h"
#include "shade/early.h"

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
static bool pack_colors(struct zr_arena *arena, struct zr_team *team, struct zr_draw_attributes *surfaces,
                        uint32_t count, uint64_t pixels)
{
    const struct zr_draw_attributes *last = NULL; /* that was packed */
    for (uint32_t i = 0; i < count; i++) {
        struct zr_draw_attributes *surface = &surfaces[i];
        const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
        if (!color->values || !zr_rate_is_flat(color->rate) || surface->packed || surface->sided ||
            surface->is_per_pixel)
            continue;
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

static size_t words_of_backs(const struct zr_draw_attributes *surface)
{
    const bool wanted = surface->sided && zr_draw_is_plain(surface->draw) && !zr_draw_is_smooth(surface);
    return wanted ? (surface->draw->count - 1) / 32 + 1 : 0;
}

static void look_first(const struct zr_draw_attributes *surface, struct zr_prepaint *payload)
{
    const struct zr_draw *draw = surface->draw;
    const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
    const size_t word = sizeof(uint32_t);
    payload->first = (uintptr_t)draw; /* which is at hand: nothing to ask for */
    if (!color->values && !surface->packed) return;
    if (zr_draw_is_smooth(surface) || (color->rate == ZR_RATE_FIRST_VERTEX && !draw->faces)) {
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
                                struct zr_scene_attributes *surfaces, uint64_t pixels,
                                const struct zr_prepaint **payloads)
{
    const uint32_t count = geometry->draw_count;
    struct zr_prepaint *out = zr_arena_zero(arena, (size_t)count + 1, sizeof *out);
    size_t words = 0;
    if (!out || !pack_colors(arena, team, surfaces->of_draw, count, pixels)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        words += words_of_backs(&surfaces->of_draw[i]);
    uint32_t *backs = zr_arena_zero(arena, words, sizeof *backs);
    if (!backs) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        struct zr_draw_attributes *surface = &surfaces->of_draw[i];
        words = ZR_FAST(noted_backs, words_of_backs(surface) > 0) ? words_of_backs(surface) : 0;
        out[i] = (struct zr_prepaint){.context = surface, .draw = surface->draw, .backs = words > 0 ? backs : NULL};
        if (ZR_FAST(early_words, zr_draw_is_painted_early(surface))) out[i].make = zr_early_of(zr_team_isa(team));
        look_first(surface, &out[i]);
        surface->backs = out[i].backs;
        backs += words;
    }
    *payloads = out;
    return ZR_OK;
}

/* ---- lines ---- */

/* Of a value of its two ends, over w. */
static struct zr_plane line_plane(const struct zr_line_basis *basis, const struct zr_window_vertex *const v[2],
                                  float p0, float p1)
{
    return zr_line_plane_make(basis, p0 * v[0]->oow, p1 * v[1]->oow);
}

/* Where the colours of a line stand. */
struct line_colors {
    struct zr_triangle line;
    bool back;
    uint32_t ends[2];
    const zr_vec4 *values;
};

static struct line_colors line_colors_of(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface,
                                         uint32_t number)
{
    const struct zr_draw *draw = surface->draw;
    const struct zr_triangle line = zr_triangle_of(geometry, draw, number);
    const bool back = surface->sided && line.back, smooth = zr_draw_is_smooth(surface);
    const enum zr_rate rate = surface->attributes[ZR_ATTRIBUTE_COLOR].rate;
    const uint32_t t = number - draw->first;
    const uint32_t n0 = smooth ? zr_smooth_number(draw, rate, t, 0) : zr_flat_number(draw, rate, t);
    const uint32_t n1 = smooth ? zr_smooth_number(draw, rate, t, 1) : n0;
    return (struct line_colors){
        line, back, {n0, n1}, surface->attributes[back ? ZR_ATTRIBUTE_BACK_COLOR : ZR_ATTRIBUTE_COLOR].values};
}

/* True where both ends are alike. */
static bool line_floats(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                        const struct line_colors *colors, struct zr_plane planes[ZR_FLOAT_PLANES])
{
    const struct zr_draw *draw = surface->draw;
    const zr_vec4 *points = surface->attributes[ZR_ATTRIBUTE_POINT].values;
    const uint32_t t = number - draw->first;
    const struct zr_window_vertex *const v[2] = {&geometry->vertices[colors->line.v[0]],
                                                 &geometry->vertices[colors->line.v[1]]};
    const struct zr_line_basis basis = zr_line_basis_make(v[0], v[1]);
    const zr_vec4 c0 = colors->values[colors->ends[0]], c1 = colors->values[colors->ends[1]];
    const float from[4] = {c0.x, c0.y, c0.z, c0.w}, to[4] = {c1.x, c1.y, c1.z, c1.w};
    static const int at[4] = {1, 2, 3, ZR_OPACITY_PLANE};
    const bool flat = colors->ends[0] == colors->ends[1];
    memset(planes, 0, ZR_FLOAT_PLANES * sizeof *planes);
    planes[0] = line_plane(&basis, v, 1.0f, 1.0f);
    for (int k = 0; k < 4; k++)
        planes[at[k]] = flat ? (struct zr_plane){from[k], 0, 0} : line_plane(&basis, v, from[k], to[k]);
    if (points)
        planes[1 + ZR_VALUES_LATE] =
            line_plane(&basis, v, points[zr_draw_corner(draw, t, 0)].w, points[zr_draw_corner(draw, t, 1)].w);
    return flat;
}

bool zr_line_floats(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                    struct zr_plane planes[ZR_FLOAT_PLANES])
{
    const struct line_colors colors = line_colors_of(geometry, surface, number);
    return line_floats(geometry, surface, number, &colors, planes);
}

bool zr_line_color(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                   bool needs_planes, struct zr_plane planes[1 + ZR_VALUES_MOST], uint32_t *color)
{
    const struct line_colors colors = line_colors_of(geometry, surface, number);
    struct zr_plane all[ZR_FLOAT_PLANES];
    if (surface->packed && !needs_planes) {
        *color = surface->packed[colors.back ? surface->color_count + colors.ends[0] : colors.ends[0]];
        return true;
    }
    const bool flat = line_floats(geometry, surface, number, &colors, all);
    *color = zr_rgba_opaque(colors.values[colors.ends[0]]);
    memcpy(planes, all, (1 + ZR_VALUES_MOST) * sizeof *planes);
    return flat;
}

void zr_line_sample(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                    struct zr_plane planes[1 + ZR_VALUES_LATE])
{
    const struct zr_draw *draw = surface->draw;
    const struct zr_triangle line = zr_triangle_of(geometry, draw, number);
    const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
    const zr_vec4 *points = surface->attributes[ZR_ATTRIBUTE_POINT].values;
    const struct zr_window_vertex *const v[2] = {&geometry->vertices[line.v[0]], &geometry->vertices[line.v[1]]};
    const struct zr_line_basis basis = zr_line_basis_make(v[0], v[1]);
    const uint32_t t = number - draw->first;
    const bool flat = zr_rate_is_flat(color->rate);
    const zr_vec4 *ends[2][2]; /* colour and point of each */
    for (uint32_t k = 0; k < 2; k++) {
        const uint32_t n = flat ? zr_flat_number(draw, color->rate, t) : zr_smooth_number(draw, color->rate, t, k);
        ends[k][0] = &color->values[n];
        ends[k][1] = &points[zr_draw_corner(draw, t, k)];
    }
    memset(planes, 0, (1 + ZR_VALUES_LATE) * sizeof *planes);
    planes[0] = line_plane(&basis, v, 1.0f, 1.0f);
    for (int i = 0; i < 2; i++) {
        struct zr_plane *out = planes + 1 + 6 * i;
        out[0] = line_plane(&basis, v, ends[0][i]->x, ends[1][i]->x);
        out[1] = line_plane(&basis, v, ends[0][i]->y, ends[1][i]->y);
        out[2] = line_plane(&basis, v, ends[0][i]->z, ends[1][i]->z);
    }
}
