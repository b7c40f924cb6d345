#include "shade/paint.h"

#include "base/rgba.h"
#include "raster/line.h"
#include "shade/early.h"

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
        batch->payload = zr_batch_is_painted_early(batch) ? zr_early_of(zr_team_isa(team)) : NULL;
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
    float oow[3];
};

static struct zr_plane plane_make(const struct basis *basis, float p0, float p1, float p2)
{
    return basis->is_line ? zr_line_plane_make(&basis->line, p0, p1) : zr_plane_make(&basis->triangle, p0, p1, p2);
}

static struct basis basis_of(const struct zr_geometry *geometry, const struct zr_triangle *t)
{
    const struct zr_window_vertex *v0 = &geometry->vertices[t->v[0]], *v1 = &geometry->vertices[t->v[1]],
                                  *v2 = &geometry->vertices[t->v[2]];
    struct basis basis = {.is_line = t->line};
    if (t->line)
        basis.line = zr_line_basis_make(v0, v1);
    else
        basis.triangle = zr_plane_basis_make(v0, v1, v2);
    basis.oow[0] = v0->oow;
    basis.oow[1] = v1->oow;
    basis.oow[2] = v2->oow;
    return basis;
}

/* Planes of x, y and z of three corners' values. */
static void add_planes(const struct basis *basis, zr_vec4 a, zr_vec4 b, zr_vec4 c, struct zr_plane planes[3])
{
    const float *w = basis->oow;
    planes[0] = plane_make(basis, a.x * w[0], b.x * w[1], c.x * w[2]);
    planes[1] = plane_make(basis, a.y * w[0], b.y * w[1], c.y * w[2]);
    planes[2] = plane_make(basis, a.z * w[0], b.z * w[1], c.z * w[2]);
}

static zr_vec4 normal_of(const struct zr_record *record, int k)
{
    const zr_vec4 n = record->normals[record->n[k]];
    return record->triangle.back ? (zr_vec4){n.x * -1.0f, n.y * -1.0f, n.z * -1.0f, 0.0f} : n;
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
    const bool late = record.material && zr_material_is_shaded_late(record.material);
    struct zr_surface surface = {.flat = !late && t->c[0] == t->c[1] && t->c[1] == t->c[2]};
    if (surface.flat) {
        surface.color = zr_rgba_opaque(c0);
        return surface;
    }
    const struct basis basis = basis_of(geometry, t);
    surface.planes[0] = plane_make(&basis, basis.oow[0], basis.oow[1], basis.oow[2]);
    add_planes(&basis, c0, c1, c2, surface.planes + 1);
    if (!late) return surface;
    const zr_vec4 *points = geometry->points;
    surface.material = record.material;
    add_planes(&basis, normal_of(&record, 0), normal_of(&record, 1), normal_of(&record, 2), surface.planes + 4);
    add_planes(&basis, points[t->v[0]], points[t->v[1]], points[t->v[2]], surface.planes + 7);
    return surface;
}

struct zr_surface zr_surface_normals(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number)
{
    const struct zr_record record = zr_record_of(geometry, batch, number);
    struct zr_surface surface = {.flat = record.n[0] == record.n[1] && record.n[1] == record.n[2]};
    if (surface.flat) {
        const zr_vec4 n = normal_of(&record, 0);
        surface.planes[0].a0 = 1.0f;
        surface.planes[1].a0 = n.x;
        surface.planes[2].a0 = n.y;
        surface.planes[3].a0 = n.z;
        return surface;
    }
    const struct basis basis = basis_of(geometry, &record.triangle);
    surface.planes[0] = plane_make(&basis, basis.oow[0], basis.oow[1], basis.oow[2]);
    add_planes(&basis, normal_of(&record, 0), normal_of(&record, 1), normal_of(&record, 2), surface.planes + 1);
    return surface;
}
