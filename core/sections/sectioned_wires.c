#include "sections/sectioned_wires.h"
#include "base/run.h"

enum { WIRES_PER_CANCEL_CHECK = 1 << 13, PIECES_MOST = 2 };

struct cutting {
    const struct zr_mesh *mesh;
    const struct zr_slice_plane *planes;
    uint32_t plane_count;
    bool is_corner;
    struct zr_wires *wires;
};

/* Part of a line, from `from` to `to`, both 0..1. */
struct interval {
    double from, to;
};

/* Narrows the interval to the kept side of a plane, or to the other side. False: nothing is left. */
static bool narrow(struct interval *in, double from, double to, bool kept)
{
    const bool has_from = (from > 0.0) == kept, has_to = (to > 0.0) == kept;
    const double t = from != to ? from / (from - to) : 0.0;
    if (!has_from && !has_to) return false;
    if (!has_from && t > in->from) in->from = t;
    if (!has_to && t < in->to) in->to = t;
    return in->from < in->to;
}

/* Returns the number of pieces that are kept. */
static int cut_line(const struct cutting *c, uint32_t line, struct interval pieces[PIECES_MOST])
{
    const uint32_t *ends = c->mesh->lines + 2 * (size_t)line;
    const struct interval whole = {0.0, 1.0};
    struct interval inner = whole;
    int count = 0;
    for (uint32_t k = 0; k < c->plane_count; k++) {
        const double from = zr_slice_distance(&c->planes[k], c->mesh->positions[ends[0]]),
                     to = zr_slice_distance(&c->planes[k], c->mesh->positions[ends[1]]);
        if (narrow(&inner, from, to, !c->is_corner)) continue;
        pieces[0] = whole;
        return c->is_corner ? 1 : 0;
    }
    if (!c->is_corner) {
        pieces[0] = inner;
        return 1;
    }
    if (inner.from > 0.0) pieces[count++] = (struct interval){0.0, inner.from};
    if (inner.to < 1.0) pieces[count++] = (struct interval){inner.to, 1.0};
    return count;
}

static uint32_t end_at(const struct cutting *c, uint32_t line, double t)
{
    const uint32_t *ends = c->mesh->lines + 2 * (size_t)line;
    struct zr_wires *wires = c->wires;
    if (t == 0.0) return ends[0];
    if (t == 1.0) return ends[1];
    wires->ends[wires->end_count] = (struct zr_mesh_blend){ends[0], ends[1], t};
    return c->mesh->position_count + wires->end_count++;
}

static bool cut_lines(const struct cutting *c, const struct zr_cancel *cancel)
{
    struct zr_wires *wires = c->wires;
    struct interval pieces[PIECES_MOST];
    for (uint32_t line = 0; line < c->mesh->line_count; line++) {
        if (line % WIRES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        const int count = cut_line(c, line, pieces);
        for (int i = 0; i < count; i++) {
            wires->lines[2 * wires->line_count] = end_at(c, line, pieces[i].from);
            wires->lines[2 * wires->line_count + 1] = end_at(c, line, pieces[i].to);
            wires->line_numbers[wires->line_count++] = line;
        }
    }
    return true;
}

static bool is_kept(const struct cutting *c, uint32_t position)
{
    for (uint32_t k = 0; k < c->plane_count; k++)
        if ((zr_slice_distance(&c->planes[k], c->mesh->positions[position]) > 0.0) == c->is_corner) return c->is_corner;
    return !c->is_corner;
}

static bool cut_points(const struct cutting *c, const struct zr_cancel *cancel)
{
    struct zr_wires *wires = c->wires;
    for (uint32_t point = 0; point < c->mesh->point_count; point++) {
        if (point % WIRES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        if (!is_kept(c, zr_mesh_point(c->mesh, point))) continue;
        wires->points[wires->point_count] = zr_mesh_point(c->mesh, point);
        wires->point_numbers[wires->point_count++] = point;
    }
    return true;
}

enum zr_status zr_wires_cut(const struct zr_run *run, const struct zr_mesh *mesh, const struct zr_slice_plane *planes,
                            uint32_t plane_count, bool is_corner, struct zr_wires *wires)
{
    const struct cutting c = {mesh, planes, plane_count, is_corner, wires};
    const size_t lines = PIECES_MOST * (size_t)mesh->line_count;
    *wires =
        (struct zr_wires){.lines = zr_arena_alloc(run->arena, 2 * lines, sizeof *wires->lines),
                          .line_numbers = zr_arena_alloc(run->arena, lines, sizeof *wires->line_numbers),
                          .points = zr_arena_alloc(run->arena, mesh->point_count, sizeof *wires->points),
                          .point_numbers = zr_arena_alloc(run->arena, mesh->point_count, sizeof *wires->point_numbers),
                          .ends = zr_arena_alloc(run->arena, lines, sizeof *wires->ends)};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    return cut_lines(&c, run->cancel) && cut_points(&c, run->cancel) ? ZR_OK : ZR_CANCELLED;
}

void zr_wires_put(const struct zr_wires *wires, const struct zr_mesh *mesh, uint32_t first_end, uint32_t *numbers,
                  struct zr_mesh *out)
{
    for (uint32_t i = 0; i < 2 * wires->line_count; i++)
        if (wires->lines[i] >= mesh->position_count) wires->lines[i] += first_end - mesh->position_count;
    for (uint32_t i = 0; i < wires->line_count; i++)
        *numbers++ = mesh->face_count + wires->line_numbers[i];
    for (uint32_t i = 0; i < wires->point_count; i++)
        *numbers++ = mesh->face_count + mesh->line_count + wires->point_numbers[i];
    out->line_count = wires->line_count;
    out->lines = wires->lines;
    out->point_count = wires->point_count;
    out->points = wires->points;
}
