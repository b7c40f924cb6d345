#include "lines/intersections.h"

#include "base/cancel.h"
#include "base/run.h"

enum { CELLS_PER_RANGE = 16, PAIRS_PER_CANCEL_CHECK = 1 << 16 };

/* Corners nearer to a plane, in pixels, lie on it. */
static const double on_plane = 1e-3;

/* ---- two triangles ---- */

struct vector {
    double x, y, z;
};

static struct vector minus(const struct zr_window_point *a, const struct zr_window_point *b)
{
    return (struct vector){a->x - b->x, a->y - b->y, a->z - b->z};
}

static struct vector cross(struct vector a, struct vector b)
{
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(struct vector a, struct vector b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/* Finds the unit normal of a triangle. False if it has none. */
static bool normal_of(const struct zr_window_point *const corners[3], struct vector *out)
{
    const struct vector n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double length = sqrt(dot(n, n));
    *out = (struct vector){n.x / length, n.y / length, n.z / length};
    return length > 0.0 && isfinite(length);
}

/* Computes the distances of the corners from the plane of `other`. False if they do not lie on both sides. */
static bool distances_of(const struct zr_window_point *const corners[3], const struct zr_window_point *other,
                         struct vector normal, double out[3])
{
    bool is_above = false, is_below = false;
    for (int k = 0; k < 3; k++) {
        const double distance = dot(minus(corners[k], other), normal);
        out[k] = fabs(distance) < on_plane ? 0.0 : distance;
        is_above = is_above || out[k] > 0.0;
        is_below = is_below || out[k] < 0.0;
    }
    return is_above && is_below;
}

/* Finds the two points of a triangle's border at distance 0. */
static int points_on_plane(const struct zr_window_point *const corners[3], const double distances[3],
                           struct zr_window_point out[2])
{
    int count = 0;
    for (int k = 0; k < 3 && count < 2; k++) {
        const int next = (k + 1) % 3;
        const struct zr_window_point *p = corners[k], *q = corners[next];
        const double from = distances[k], to = distances[next];
        if (from == 0.0) out[count++] = *p;
        if (from * to >= 0.0 || count == 2) continue;
        const double t = from / (from - to);
        out[count++] =
            (struct zr_window_point){p->x + t * (q->x - p->x), p->y + t * (q->y - p->y), p->z + t * (q->z - p->z)};
    }
    return count;
}

/* Cuts a segment in the plane of a triangle to the triangle. */
static bool cut_to(const struct zr_window_point *const corners[3], struct vector normal, struct zr_window_point ends[2])
{
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 3; k++) {
        const struct vector inward = cross(normal, minus(corners[(k + 1) % 3], corners[k]));
        const double from = dot(minus(&ends[0], corners[k]), inward), to = dot(minus(&ends[1], corners[k]), inward);
        if (from <= 0.0 && to <= 0.0) return false;
        const double t = from / (from - to);
        if (from < 0.0 && t > low) low = t;
        if (to < 0.0 && t < high) high = t;
    }
    const struct zr_window_point a = ends[0];
    const struct vector d = minus(&ends[1], &a);
    ends[0] = (struct zr_window_point){a.x + low * d.x, a.y + low * d.y, a.z + low * d.z};
    ends[1] = (struct zr_window_point){a.x + high * d.x, a.y + high * d.y, a.z + high * d.z};
    return low < high;
}

bool zr_intersection_of(const struct zr_window_point *const a[3], const struct zr_window_point *const b[3],
                        struct zr_window_point ends[2])
{
    struct vector of_a, of_b;
    double distances[3], others[3];
    if (!normal_of(b, &of_b) || !distances_of(a, b[0], of_b, distances)) return false;
    if (!normal_of(a, &of_a) || !distances_of(b, a[0], of_a, others)) return false;
    return points_on_plane(a, distances, ends) == 2 && cut_to(b, of_b, ends);
}

/* ---- one cell ---- */

struct seeking {
    const struct zr_window_mesh *mesh;
    const struct zr_cells *cells;
    const struct zr_cancel *cancel;
    uint32_t *pieces; /* by triangle */
    uint32_t *counts; /* by cell: its lines, then the number of its first one */
    struct zr_line *lines;
};

struct box {
    double low[3], high[3];
};

static struct box box_of(const struct zr_window_point *const corners[3])
{
    struct box box;
    for (int k = 0; k < 3; k++) {
        const double at[3] = {corners[k]->x, corners[k]->y, corners[k]->z};
        for (int i = 0; i < 3; i++) {
            if (k == 0 || at[i] < box.low[i]) box.low[i] = at[i];
            if (k == 0 || at[i] > box.high[i]) box.high[i] = at[i];
        }
    }
    return box;
}

static void corners_of(const struct seeking *s, uint32_t hider, const struct zr_window_point *out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = &s->mesh->points[s->mesh->corners[hider][k]];
}

static bool is_apart(const struct box *a, const struct box *b)
{
    for (int i = 0; i < 3; i++)
        if (a->low[i] > b->high[i] || b->low[i] > a->high[i]) return true;
    return false;
}

static bool share_corner(const struct seeking *s, uint32_t a, uint32_t b)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (s->mesh->corners[a][i] == s->mesh->corners[b][k]) return true;
    return false;
}

/* Depth of a triangle's plane over a cell. */
struct plane {
    double middle; /* depth over the middle of the cell */
    double slope_x, slope_y;
};

static struct plane plane_over(const struct zr_window_point *const corners[3], double x, double y)
{
    const struct zr_window_point *at = corners[0];
    const struct vector n = cross(minus(corners[1], at), minus(corners[2], at));
    const double slope_x = -n.x / n.z, slope_y = -n.y / n.z;
    return (struct plane){at->z + (slope_x * (x - at->x) + slope_y * (y - at->y)), slope_x, slope_y};
}

/* True if the line of two planes passes a cell by, also where it is moved by `on_plane` and by rounding. */
static bool passes_by(const struct plane *a, const struct plane *b)
{
    const double half = 0.5 * ZR_CELL_PIXELS,
                 steep = (fabs(a->slope_x) + fabs(a->slope_y)) + (fabs(b->slope_x) + fabs(b->slope_y));
    const double reach = half * (fabs(a->slope_x - b->slope_x) + fabs(a->slope_y - b->slope_y));
    const double slack = 4.0 * on_plane * (1.0 + steep) + 1e-9 * (fabs(a->middle) + fabs(b->middle));
    return fabs(a->middle - b->middle) > reach + slack;
}

/* Finds the line of two hiders. False if there is none, or if another cell makes it. */
static bool line_of(const struct seeking *s, uint32_t a, uint32_t b, uint32_t cell, struct zr_line *line)
{
    const struct zr_window_point *first[3], *second[3];
    corners_of(s, a, first);
    corners_of(s, b, second);
    if (!zr_intersection_of(first, second, line->ends) || !zr_line_cut(&s->mesh->view, line->ends)) return false;
    const uint32_t column = zr_cell_at(0.5 * (line->ends[0].x + line->ends[1].x), s->cells->columns),
                   row = zr_cell_at(0.5 * (line->ends[0].y + line->ends[1].y), s->cells->rows);
    line->kind = ZR_LINE_INTERSECTION;
    line->is_sharp = line->is_weak = line->is_cut = line->is_smooth = false;
    line->triangles[0] = zr_hider_source(s->mesh, a);
    line->triangles[1] = zr_hider_source(s->mesh, b);
    return row * s->cells->columns + column == cell;
}

static bool has_two_pieces(const struct seeking *s, const struct zr_cell_entry *entries, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        if (s->pieces[zr_hider_source(s->mesh, entries[i].hider)] !=
            s->pieces[zr_hider_source(s->mesh, entries[0].hider)])
            return true;
    return false;
}

/* Finds the lines that the cell makes. Returns their number; writes them if `out` is not NULL. */
static uint32_t seek(const struct seeking *s, uint32_t cell, struct zr_line *out)
{
    const struct zr_cell_entry *entries = s->cells->entries + s->cells->firsts[cell];
    const uint32_t count = s->cells->firsts[cell + 1] - s->cells->firsts[cell];
    const double x = zr_cell_border(cell % s->cells->columns) + 0.5 * ZR_CELL_PIXELS,
                 y = zr_cell_border(cell / s->cells->columns) + 0.5 * ZR_CELL_PIXELS;
    uint32_t found = 0, unchecked = 0;
    if (!has_two_pieces(s, entries, count)) return 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_window_point *first[3], *second[3];
        corners_of(s, entries[i].hider, first);
        const struct box box = box_of(first);
        const struct plane plane = plane_over(first, x, y);
        const uint32_t piece = s->pieces[zr_hider_source(s->mesh, entries[i].hider)];
        if ((unchecked += count) > PAIRS_PER_CANCEL_CHECK) {
            if (zr_is_cancelled(s->cancel)) return found;
            unchecked = 0;
        }
        for (uint32_t k = i + 1; k < count && !zr_cell_ends(&entries[k], box.high[2], count); k++) {
            struct zr_line line;
            if (zr_boxes_are_apart(&entries[i].box, &entries[k].box)) continue;
            if (s->pieces[zr_hider_source(s->mesh, entries[k].hider)] == piece) continue;
            corners_of(s, entries[k].hider, second);
            const struct box other = box_of(second);
            if (is_apart(&box, &other)) continue;
            const struct plane behind = plane_over(second, x, y);
            if (passes_by(&plane, &behind) || share_corner(s, entries[i].hider, entries[k].hider) ||
                !line_of(s, entries[i].hider, entries[k].hider, cell, &line))
                continue;
            if (out) out[found] = line;
            found++;
        }
    }
    return found;
}

/* ---- all cells ---- */

static void count_range(void *context, size_t begin, size_t end)
{
    const struct seeking *s = context;
    for (size_t cell = begin; cell < end; cell++)
        s->counts[cell] = zr_is_cancelled(s->cancel) ? 0 : seek(s, (uint32_t)cell, NULL);
}

static void make_range(void *context, size_t begin, size_t end)
{
    const struct seeking *s = context;
    for (size_t cell = begin; cell < end && !zr_is_cancelled(s->cancel); cell++)
        if (s->counts[cell + 1] > s->counts[cell]) seek(s, (uint32_t)cell, s->lines + s->counts[cell]);
}

static void set_pieces(const struct seeking *s)
{
    for (uint32_t i = 0; i < s->mesh->instance_count; i++) {
        const struct zr_drawn_instance *of = &s->mesh->instances[i];
        for (uint32_t t = 0; t < of->table->triangle_count; t++)
            s->pieces[of->first_triangle + t] = of->first_piece + of->table->pieces[t];
    }
}

/* Sums the counts. False if there are more lines than 32 bits count. */
static bool sum_counts(const struct seeking *s, size_t cells)
{
    uint64_t sum = 0;
    for (size_t cell = 0; cell <= cells; cell++) {
        const uint32_t own = cell < cells ? s->counts[cell] : 0;
        s->counts[cell] = (uint32_t)sum;
        sum += own;
    }
    return sum < UINT32_MAX;
}

enum zr_status zr_intersections_add(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                    const struct zr_cells *cells, struct zr_lines *lines)
{
    const size_t cell_count = (size_t)cells->columns * cells->rows;
    struct seeking s = {.mesh = mesh, .cells = cells, .cancel = run->cancel};
    if (mesh->piece_count < 2) return ZR_OK;
    s.pieces = zr_arena_alloc(run->arena, mesh->triangle_count, sizeof *s.pieces);
    s.counts = zr_arena_alloc(run->arena, cell_count + 1, sizeof *s.counts);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    set_pieces(&s);
    zr_team_ranges(run->team, cell_count, CELLS_PER_RANGE, count_range, &s);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!sum_counts(&s, cell_count)) return ZR_NO_MEMORY;
    const uint32_t more = s.counts[cell_count];
    struct zr_line *grown =
        zr_arena_grow(run->arena, lines->at, lines->count, (size_t)lines->count + more, sizeof *grown);
    if (!grown) return ZR_NO_MEMORY;
    s.lines = grown + lines->count;
    zr_team_ranges(run->team, cell_count, CELLS_PER_RANGE, make_range, &s);
    lines->at = grown;
    lines->count += more;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
