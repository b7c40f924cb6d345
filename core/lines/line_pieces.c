#include "lines/line_pieces.h"

#include "base/cancel.h"
#include "base/run.h"
#include "lines/cells.h"
#include "mesh/face_normals.h"

enum { PIECES_PER_RANGE = 64, LINES_PER_CANCEL_CHECK = 1 << 12, WEAK_PIXELS = 6 };

/* Distances of probes from a line, in pixels, and the tolerances of seams. */
static const double beside = 1.0, seam = 0.1, weak_beside = 3.0, seam_depth = 0.1, step_least = 1.0;
static const double patch_depth = 0.25;
static const float seam_cosine = 0.99756405f;   /* 4 degrees */
static const float weak_cosine = 0.86602540f;   /* 30 degrees */
static const float agreed_cosine = 0.98480775f; /* 10 degrees, as in features.c */

struct making {
    const struct zr_window_mesh *mesh;
    const struct zr_cells *cells;
    const struct zr_cancel *cancel;
    const struct zr_lines *lines;
    const struct zr_hidden_parts *hidden;
    bool with_hidden;
    struct zr_line_pieces *out; /* at: NULL while they are counted */
};

/* ---- probes ---- */

#define NO_HIDER UINT32_MAX

/* The nearest triangle at a point of the window. */
struct probe {
    uint32_t hider; /* triangle or cut piece; NO_HIDER: background */
    double depth;
};

/* The hiders of a cell. */
struct cell_hiders {
    uint32_t count;
    const struct zr_cell_entry *at;
};

static double side_of(const struct zr_window_point *a, const struct zr_window_point *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* Returns the depth of a hider's plane at a point. */
static double plane_depth(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y)
{
    const uint32_t *corners = mesh->corners[hider];
    const struct zr_window_point *a = &mesh->points[corners[0]], *b = &mesh->points[corners[1]],
                                 *c = &mesh->points[corners[2]];
    const double of_b = side_of(c, a, x, y), of_c = side_of(a, b, x, y), area = side_of(a, b, c->x, c->y);
    return a->z + (of_b * (b->z - a->z) + of_c * (c->z - a->z)) / area;
}

/* Returns true if a hider covers a point, or touches it. */
static bool hider_covers(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y)
{
    const uint32_t *corners = mesh->corners[hider];
    const struct zr_window_point *a = &mesh->points[corners[0]], *b = &mesh->points[corners[1]],
                                 *c = &mesh->points[corners[2]];
    return side_of(a, b, x, y) >= 0.0 && side_of(b, c, x, y) >= 0.0 && side_of(c, a, x, y) >= 0.0;
}

static struct cell_hiders cell_hiders_at(const struct zr_cells *cells, double x, double y)
{
    const uint32_t cell = zr_cell_at(y, cells->rows) * cells->columns + zr_cell_at(x, cells->columns);
    return (struct cell_hiders){cells->firsts[cell + 1] - cells->firsts[cell], cells->entries + cells->firsts[cell]};
}

static struct probe probe_at(const struct zr_window_mesh *mesh, const struct zr_cells *cells, double x, double y)
{
    const uint32_t column = zr_cell_at(x, cells->columns), row = zr_cell_at(y, cells->rows);
    const uint32_t cell = row * cells->columns + column;
    const uint8_t step_x = zr_box_step(x, column), step_y = zr_box_step(y, row);
    const struct zr_cell_box box = {step_x, step_y, step_x, step_y};
    struct probe nearest = {NO_HIDER, HUGE_VAL};
    const uint32_t first = cells->firsts[cell], count = cells->firsts[cell + 1] - first;
    for (uint32_t i = first; i < first + count && !zr_cell_ends(&cells->entries[i], nearest.depth, count); i++) {
        const struct zr_cell_entry *entry = &cells->entries[i];
        const uint32_t hider = entry->hider;
        if (zr_boxes_are_apart(&entry->box, &box) || !((double)entry->near < nearest.depth)) continue;
        if (!hider_covers(mesh, hider, x, y)) continue;
        const double depth = plane_depth(mesh, hider, x, y);
        if (depth < nearest.depth) nearest = (struct probe){hider, depth};
    }
    return nearest;
}

/* Returns the cosine of the angle between two hiders, both turned towards the eye. */
static float hider_cosine(const struct zr_window_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t first = zr_hider_source(mesh, a), second = zr_hider_source(mesh, b);
    const float *u = mesh->normals[first], *v = mesh->normals[second];
    const float cosine = (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2];
    return (mesh->traits[first] ^ mesh->traits[second]) & ZR_TRIANGLE_FRONT ? -cosine : cosine;
}

/* ---- cutting ---- */

static struct zr_window_point point_at(const struct zr_line *line, double t)
{
    const struct zr_window_point *p = &line->ends[0], *q = &line->ends[1];
    if (t <= 0.0) return *p;
    if (t >= 1.0) return *q;
    return (struct zr_window_point){p->x + t * (q->x - p->x), p->y + t * (q->y - p->y), p->z + t * (q->z - p->z)};
}

static double length_of(const struct zr_line *line)
{
    const double x = line->ends[1].x - line->ends[0].x, y = line->ends[1].y - line->ends[0].y;
    return sqrt(x * x + y * y);
}

/* Adds the pieces of the part from begin to end. */
static void add(const struct making *m, uint32_t number, double begin, double end, bool is_hidden)
{
    const struct zr_line *line = &m->lines->at[number];
    const double pixels = length_of(line) * (end - begin);
    const uint32_t count = is_hidden ? 1 : 1 + (uint32_t)(pixels / ZR_LINE_PIECE_PIXELS);
    if (!(begin < end) || (is_hidden && !m->with_hidden)) return;
    for (uint32_t i = 0; i < count; i++) {
        const double from = begin + (end - begin) * ((double)i / (double)count),
                     to = i + 1 == count ? end : begin + (end - begin) * ((double)(i + 1) / (double)count);
        if (m->out->at)
            m->out->at[m->out->count] = (struct zr_line_piece){.ends = {point_at(line, from), point_at(line, to)},
                                                               .line = number,
                                                               .kind = line->kind,
                                                               .is_sharp = line->is_sharp,
                                                               .is_cut = line->is_cut,
                                                               .is_hidden = is_hidden};
        m->out->count++;
    }
}

/* Adds the pieces of all lines. False if cancelled. */
static bool add_all(const struct making *m)
{
    for (uint32_t i = 0; i < m->lines->count; i++) {
        double from = 0.0;
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel)) return false;
        for (uint32_t k = m->hidden->firsts[i]; k < m->hidden->firsts[i + 1]; k++) {
            const struct zr_part_of_line *part = &m->hidden->parts[k];
            add(m, i, from, part->begin, false);
            add(m, i, part->begin, part->end, true);
            from = part->end;
        }
        add(m, i, from, 1.0, false);
    }
    return true;
}

/* ---- probes ---- */

/* The middle of a piece, and the unit vector to its left. */
struct middle {
    double x, y, z, left_x, left_y;
};

static struct middle middle_of(const struct zr_line_piece *piece)
{
    const struct zr_window_point *p = &piece->ends[0], *q = &piece->ends[1];
    const double length = zr_line_piece_length(piece);
    return (struct middle){.x = 0.5 * (p->x + q->x),
                           .y = 0.5 * (p->y + q->y),
                           .z = 0.5 * (p->z + q->z),
                           .left_x = length > 0.0 ? (p->y - q->y) / length : 0.0,
                           .left_y = length > 0.0 ? (q->x - p->x) / length : 0.0};
}

static struct probe probe(const struct making *m, const struct middle *at, double left)
{
    return probe_at(m->mesh, m->cells, at->x + left * at->left_x, at->y + left * at->left_y);
}

/* True if two hiders lie in one plane where the line is. */
static bool is_one_plane(const struct making *m, const struct middle *at, uint32_t a, uint32_t b)
{
    if (a == NO_HIDER || b == NO_HIDER || hider_cosine(m->mesh, a, b) < seam_cosine) return false;
    return fabs(plane_depth(m->mesh, a, at->x, at->y) - plane_depth(m->mesh, b, at->x, at->y)) < seam_depth;
}

/* True if both sides of a weak crease continue one another without a step. */
static bool is_faint(const struct making *m, const struct middle *at)
{
    const uint32_t left = probe(m, at, weak_beside).hider, right = probe(m, at, -weak_beside).hider;
    if (left == NO_HIDER || right == NO_HIDER) return false;
    if (hider_cosine(m->mesh, left, right) < weak_cosine) return false;
    const double to_left = plane_depth(m->mesh, left, at->x, at->y),
                 to_right = plane_depth(m->mesh, right, at->x, at->y);
    return fabs(to_left - to_right) < weak_beside * step_least;
}

/* Returns the face and the instance of a hider. */
static uint32_t face_of(const struct making *m, uint32_t hider, const struct zr_drawn_instance **of)
{
    const uint32_t triangle = zr_hider_source(m->mesh, hider);
    *of = &m->mesh
               ->instances[zr_drawn_instance_of(m->mesh, offsetof(struct zr_drawn_instance, first_triangle), triangle)];
    return (*of)->table->faces[triangle - (*of)->first_triangle];
}

/* Returns the first cap at a point beside a line that goes through the line; NO_HIDER: none. Where caps of several
 * parts lie in one plane, the first one is drawn (geometry/cap_samples.h). */
static uint32_t cap_beside(const struct making *m, const struct middle *at, double left)
{
    const double x = at->x + left * at->left_x, y = at->y + left * at->left_y;
    const struct zr_drawn_instance *of;
    uint32_t first = NO_HIDER;
    const struct cell_hiders in = cell_hiders_at(m->cells, x, y);
    for (uint32_t i = 0; i < in.count; i++) {
        const uint32_t hider = in.at[i].hider;
        if (first != NO_HIDER && zr_hider_source(m->mesh, hider) >= zr_hider_source(m->mesh, first)) continue;
        if (!hider_covers(m->mesh, hider, x, y)) continue;
        if (fabs(plane_depth(m->mesh, hider, at->x, at->y) - at->z) >= seam_depth) continue;
        const uint32_t face = face_of(m, hider, &of);
        if (zr_mesh_face_is_cap(of->mesh, face)) first = hider;
    }
    return first;
}

/* True if both sides of the edge of a cap show the same cap: solids overlap there. */
static bool is_inside_cap(const struct making *m, const struct middle *at)
{
    const uint32_t left = cap_beside(m, at, seam), right = cap_beside(m, at, -seam);
    const struct zr_drawn_instance *a, *b;
    if (left == NO_HIDER || right == NO_HIDER) return false;
    return face_of(m, left, &a) == face_of(m, right, &b) && a == b;
}

/* Returns the normal of the file at a point of a triangle, between those of its corners; 0 if one has none. */
static zr_vec3 given_normal_at(const struct making *m, const struct zr_drawn_instance *of, uint32_t triangle,
                               const struct middle *at)
{
    const size_t own = triangle - of->first_triangle;
    const struct zr_window_point *p[3];
    zr_vec3 sum = {0.0f, 0.0f, 0.0f};
    for (size_t k = 0; k < 3; k++)
        p[k] = &m->mesh->points[of->first_vertex + of->table->corners[3 * own + k]];
    for (size_t k = 0; k < 3; k++) {
        const struct zr_mesh *mesh = of->mesh;
        const uint32_t slot = of->table->slots[3 * own + k];
        const zr_vec3 normal = mesh->normals[mesh->normal_indices ? mesh->normal_indices[slot] : mesh->indices[slot]];
        if (zr_normal_is_zero(normal)) return normal;
        const float share =
            (float)(side_of(p[(k + 1) % 3], p[(k + 2) % 3], at->x, at->y) / side_of(p[0], p[1], p[2]->x, p[2]->y));
        sum = zr_vec3_add(sum, zr_vec3_scale(zr_vec3_normalize(normal), share));
    }
    return zr_vec3_normalize(sum);
}

/* True if a border is a seam between patches of a smooth surface that share no corners: triangles of the same instance
 * lie on both sides, without a step, and the normals of the file agree. */
static bool is_patch_seam(const struct making *m, const struct middle *at)
{
    const uint32_t left = probe(m, at, beside).hider, right = probe(m, at, -beside).hider;
    const struct zr_drawn_instance *a, *b;
    if (left >= m->mesh->triangle_count || right >= m->mesh->triangle_count) return false;
    if (fabs(plane_depth(m->mesh, left, at->x, at->y) - plane_depth(m->mesh, right, at->x, at->y)) >= patch_depth)
        return false;
    face_of(m, left, &a);
    face_of(m, right, &b);
    if (a != b || !a->mesh->normals) return false;
    return zr_vec3_dot(given_normal_at(m, a, left, at), given_normal_at(m, a, right, at)) >= agreed_cosine;
}

static bool is_seam(const struct making *m, const struct zr_line_piece *piece, const struct middle *at)
{
    const struct zr_line *line = &m->lines->at[piece->line];
    if (piece->is_cut) return is_inside_cap(m, at);
    if (line->is_smooth) return is_patch_seam(m, at);
    if (piece->kind != ZR_LINE_CREASE && piece->kind != ZR_LINE_INTERSECTION) return false;
    if (is_one_plane(m, at, probe(m, at, seam).hider, probe(m, at, -seam).hider)) return true;
    return line->is_weak && length_of(line) < WEAK_PIXELS && is_faint(m, at);
}

/* Returns 1 if the outside of a contour is to the left of it, else -1: away from its first triangle. */
static double outside_of(const struct making *m, const struct zr_line_piece *piece, const struct middle *at)
{
    const uint32_t *corners = m->mesh->corners[m->lines->at[piece->line].triangles[0]];
    double most = 0.0, farthest = 0.0; /* not fabs(most), which clang 19 gets wrong in a loop that it unrolls */
    for (int k = 0; k < 3; k++) {
        if (corners[k] < m->mesh->vertex_count && m->mesh->outside[corners[k]]) continue;
        const struct zr_window_point *p = &m->mesh->points[corners[k]];
        const double left = (p->x - at->x) * at->left_x + (p->y - at->y) * at->left_y;
        if (!(fabs(left) > farthest)) continue;
        farthest = fabs(left);
        most = left;
    }
    return most > 0.0 ? -1.0 : 1.0;
}

static float step_of(const struct probe *outer, double depth)
{
    return outer->hider == NO_HIDER ? HUGE_VALF : (float)(outer->depth - depth);
}

/* Returns the point at 9/10 of the way to an end. */
static struct middle near_end(const struct middle *at, const struct zr_window_point *end)
{
    struct middle near = *at;
    near.x += 0.9 * (end->x - at->x);
    near.y += 0.9 * (end->y - at->y);
    near.z += 0.9 * (end->z - at->z);
    return near;
}

static void judge(const struct making *m, struct zr_line_piece *piece)
{
    const struct middle at = middle_of(piece);
    const struct probe left = probe(m, &at, beside), right = probe(m, &at, -beside);
    piece->is_at_background = left.hider == NO_HIDER || right.hider == NO_HIDER;
    piece->is_dropped = is_seam(m, piece, &at);
    if (piece->kind != ZR_LINE_CONTOUR) return;
    const double outside = outside_of(m, piece, &at);
    piece->step = piece->step_most = step_of(outside > 0.0 ? &left : &right, at.z);
    for (int k = 0; k < 2 && piece->step < HUGE_VALF; k++) {
        const struct middle near = near_end(&at, &piece->ends[k]);
        const struct probe outer = probe(m, &near, outside * beside);
        const float step = step_of(&outer, near.z);
        if (step > piece->step_most && step < HUGE_VALF) piece->step_most = step;
    }
}

static void judge_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(m->cancel); i++)
        if (!m->out->at[i].is_hidden) judge(m, &m->out->at[i]);
}

enum zr_status zr_line_pieces_make(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                   const struct zr_cells *cells, const struct zr_lines *lines,
                                   const struct zr_hidden_parts *hidden, bool with_hidden, struct zr_line_pieces *out)
{
    struct making m = {mesh, cells, run->cancel, lines, hidden, with_hidden, out};
    *out = (struct zr_line_pieces){0};
    if (!add_all(&m)) return ZR_CANCELLED;
    out->at = zr_arena_alloc(run->arena, out->count, sizeof *out->at);
    if (!out->at) return ZR_NO_MEMORY;
    out->count = 0;
    if (!add_all(&m)) return ZR_CANCELLED;
    zr_team_ranges(run->team, out->count, PIECES_PER_RANGE, judge_range, &m);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
