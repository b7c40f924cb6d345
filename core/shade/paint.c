#include "shade/paint.h"

#include "base/rgba.h"
#include "raster/line.h"

const struct zr_paint *zr_paint_of(enum zr_isa isa)
{
    static const struct zr_paint *const table[ZR_ISA_COUNT] = ZR_KERNELS(&zr_paint);
    return table[isa];
}

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

static size_t words_of_backs(const struct zr_batch *batch)
{
    const bool wanted = batch->sided && !batch->written && !zr_batch_is_smooth(batch);
    return wanted ? (batch->count - 1) / 32 + 1 : 0;
}

static bool make_room_for_backs(struct zr_arena *arena, struct zr_geometry *geometry)
{
    size_t words = 0;
    for (uint32_t i = 0; i < geometry->batch_count; i++)
        words += words_of_backs(&geometry->batches[i]);
    uint32_t *backs = zr_arena_zero(arena, words, sizeof *backs);
    for (uint32_t i = 0; backs && i < geometry->batch_count; i++) {
        words = words_of_backs(&geometry->batches[i]);
        if (words > 0) geometry->batches[i].backs = backs;
        backs += words;
    }
    return backs != NULL;
}

enum zr_status zr_paint_prepare(struct zr_arena *arena, struct zr_team *team, struct zr_geometry *geometry,
                                uint64_t pixels)
{
    const struct zr_batch *last = NULL; /* that was packed */
    if (!make_room_for_backs(arena, geometry)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < geometry->batch_count; i++) {
        struct zr_batch *batch = &geometry->batches[i];
        batch->painted_early = zr_batch_is_painted_early(batch);
        if (batch->written || batch->packed || zr_batch_is_smooth(batch) || batch->sided) continue;
        const size_t count = batch->color_count;
        if (last && last->front == batch->front && last->color_count == count) {
            batch->packed = last->packed;
            continue;
        }
        if (count * PIXELS_A_COLOR > pixels) continue;
        uint32_t *out = zr_arena_alloc(arena, count, sizeof *out);
        if (!out) return ZR_NO_MEMORY;
        struct packing packing = {zr_rgba_pack_of(zr_team_isa(team)), batch->front, out};
        zr_team_ranges(team, count, COLORS_A_RANGE, pack_range, &packing);
        batch->packed = out;
        last = batch;
        pixels -= count * PIXELS_A_COLOR;
    }
    return ZR_OK;
}

/* What the planes of a record have in common: of a triangle's or of a line's. */
struct basis {
    bool is_line;
    struct zr_plane_basis triangle;
    struct zr_line_basis line;
};

static struct zr_plane plane_make(const struct basis *basis, float p0, float p1, float p2)
{
    return basis->is_line ? zr_line_plane_make(&basis->line, p0, p1) : zr_plane_make(&basis->triangle, p0, p1, p2);
}

struct zr_surface zr_surface_make(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number)
{
    const struct zr_record record = zr_record_of(geometry, batch, number);
    const struct zr_triangle *t = &record.triangle;
    if (batch->packed) {
        const uint32_t side = batch->sided && t->back ? batch->color_count : 0;
        return (struct zr_surface){.flat = true, .color = batch->packed[side + t->c[0]]};
    }
    zr_vec4 c0 = record.colors[t->c[0]], c1 = record.colors[t->c[1]], c2 = record.colors[t->c[2]];
    struct zr_surface surface = {.flat = t->c[0] == t->c[1] && t->c[1] == t->c[2]};
    if (surface.flat) {
        surface.color = zr_rgba_opaque(c0);
        return surface;
    }
    const struct zr_window_vertex *v0 = &geometry->vertices[t->v[0]], *v1 = &geometry->vertices[t->v[1]],
                                  *v2 = &geometry->vertices[t->v[2]];
    struct basis basis = {.is_line = t->line};
    if (t->line)
        basis.line = zr_line_basis_make(v0, v1);
    else
        basis.triangle = zr_plane_basis_make(v0, v1, v2);
    surface.oow = plane_make(&basis, v0->oow, v1->oow, v2->oow);
    surface.red = plane_make(&basis, c0.x * v0->oow, c1.x * v1->oow, c2.x * v2->oow);
    surface.green = plane_make(&basis, c0.y * v0->oow, c1.y * v1->oow, c2.y * v2->oow);
    surface.blue = plane_make(&basis, c0.z * v0->oow, c1.z * v1->oow, c2.z * v2->oow);
    return surface;
}
