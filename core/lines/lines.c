#include "lines/lines.h"

#include "base/cancel.h"

enum { EDGES_PER_CANCEL_CHECK = 1 << 14 };

static const double length_least = 1e-9;

/* ---- cuts ---- */

static struct zr_window_point between(const struct zr_window_point *a, const struct zr_window_point *b, double t)
{
    return (struct zr_window_point){a->x + t * (b->x - a->x), a->y + t * (b->y - a->y), a->z + t * (b->z - a->z)};
}

/* Keeps the part of t where from + t (to - from) >= 0. */
static bool keep_part(double from, double to, double part[2])
{
    if (from >= 0.0 && to >= 0.0) return true;
    if (!(from >= 0.0 || to >= 0.0)) return false;
    const double t = from / (from - to);
    if (from < 0.0 && t > part[0]) part[0] = t;
    if (to < 0.0 && t < part[1]) part[1] = t;
    return part[0] < part[1];
}

bool zr_line_cut(const struct zr_window_view *view, struct zr_window_point ends[2])
{
    const double margin = ZR_WINDOW_MARGIN, right = view->width + margin, top = view->height + margin;
    const struct zr_window_point a = ends[0], b = ends[1];
    double part[2] = {0.0, 1.0};
    if (!keep_part(a.x + margin, b.x + margin, part) || !keep_part(right - a.x, right - b.x, part) ||
        !keep_part(a.y + margin, b.y + margin, part) || !keep_part(top - a.y, top - b.y, part))
        return false;
    if (part[0] > 0.0) ends[0] = between(&a, &b, part[0]);
    if (part[1] < 1.0) ends[1] = between(&a, &b, part[1]);
    const double x = ends[1].x - ends[0].x, y = ends[1].y - ends[0].y;
    return x * x + y * y > length_least * length_least;
}

/* Cuts an edge of which an end is outside, in clip space. */
static bool cut_by_planes(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of,
                          const uint32_t vertices[2], struct zr_window_point ends[2])
{
    double clip[2][4], part[2] = {0.0, 1.0};
    for (int k = 0; k < 2; k++) {
        const zr_vec4 *p = &of->mesh->positions[of->table->positions[vertices[k]]];
        zr_matrix_apply(&of->to_clip, (const double[4]){(double)p->x, (double)p->y, (double)p->z, (double)p->w},
                        clip[k]);
    }
    if (!keep_part(clip[0][3] + clip[0][2], clip[1][3] + clip[1][2], part) ||
        !keep_part(clip[0][3] - clip[0][2], clip[1][3] - clip[1][2], part))
        return false;
    for (int k = 0; k < 2; k++) {
        double at[4];
        for (int i = 0; i < 4; i++)
            at[i] = clip[0][i] + part[k] * (clip[1][i] - clip[0][i]);
        if (!(at[3] > 0.0)) return false;
        ends[k] = zr_window_point_of(&mesh->view, at);
    }
    return true;
}

/* ---- one edge ---- */

/* Finds up to two present triangles of the edge; the first one faces the eye if any does. */
static void find_triangles(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t edge,
                           uint32_t out[2])
{
    const struct zr_mesh_edge *own = &of->table->edges[edge];
    uint32_t count = 0;
    out[0] = out[1] = ZR_NO_TRIANGLE;
    for (uint32_t i = own->first_side; i < own[1].first_side && count < 2; i++) {
        const uint32_t triangle = of->first_triangle + of->table->sides[i] / 3;
        if (!(mesh->traits[triangle] & ZR_TRIANGLE_ABSENT)) out[count++] = triangle;
    }
    if (count == 2 && !(mesh->traits[out[0]] & ZR_TRIANGLE_FRONT) && mesh->traits[out[1]] & ZR_TRIANGLE_FRONT) {
        const uint32_t back = out[0];
        out[0] = out[1];
        out[1] = back;
    }
}

/* Makes the line of an edge. False if none of it is in the window. */
static bool make_line(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t edge,
                      unsigned features, struct zr_line *line)
{
    const uint32_t vertices[2] = {of->table->edges[edge].low, of->table->edges[edge].high};
    const uint32_t from = of->first_vertex + vertices[0], to = of->first_vertex + vertices[1];
    *line = (struct zr_line){.kind = features & ZR_FEATURE_BORDER ? ZR_LINE_BORDER
                                     : features & ZR_FEATURE_WEAK ? ZR_LINE_CREASE
                                                                  : ZR_LINE_CONTOUR,
                             .is_sharp = features & ZR_FEATURE_CONTOUR && features & ZR_FEATURE_WEAK,
                             .is_weak = features & ZR_FEATURE_WEAK && !(features & ZR_FEATURE_STRONG),
                             .is_cut = (features & ZR_FEATURE_CUT) != 0,
                             .is_smooth = (features & ZR_FEATURE_SMOOTH) != 0};
    if (mesh->outside[from] & mesh->outside[to]) return false;
    if (mesh->outside[from] | mesh->outside[to]) {
        if (!cut_by_planes(mesh, of, vertices, line->ends)) return false;
    } else {
        line->ends[0] = mesh->points[from];
        line->ends[1] = mesh->points[to];
    }
    if (!zr_line_cut(&mesh->view, line->ends)) return false;
    find_triangles(mesh, of, edge, line->triangles);
    return true;
}

/* ---- all edges ---- */

enum zr_status zr_lines_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_window_mesh *mesh,
                             const uint8_t *features, struct zr_lines *out)
{
    const unsigned drawn = ZR_FEATURE_BORDER | ZR_FEATURE_CONTOUR | ZR_FEATURE_WEAK;
    size_t most = 0;
    for (uint32_t e = 0; e < mesh->edge_count; e++)
        most += (features[e] & drawn) != 0;
    *out = (struct zr_lines){.at = zr_arena_alloc(arena, most, sizeof *out->at)};
    if (!out->at) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < mesh->instance_count; i++) {
        const struct zr_drawn_instance *of = &mesh->instances[i];
        for (uint32_t e = 0; e < of->table->edge_count; e++) {
            if (e % EDGES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_CANCELLED;
            const unsigned own = features[of->first_edge + e];
            if (own & drawn && make_line(mesh, of, e, own, &out->at[out->count])) out->count++;
        }
    }
    zr_arena_trim(arena, out->at, most, out->count, sizeof *out->at);
    return ZR_OK;
}
