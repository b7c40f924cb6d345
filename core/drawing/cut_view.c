#include "drawing/cut_view.h"

#include "base/cancel.h"
#include "drawing/overall.h"
#include "overlay/type.h"

#define LETTER 5.0

enum { EDGES_PER_CANCEL_CHECK = 1 << 12 };

static double component(zr_dvec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

void zr_cut_view_choose(struct zr_placed_views *placed, const struct zr_bounds *bounds, int axis, double share)
{
    const double low = component(zr_dvec3_of(bounds->min), axis), high = component(zr_dvec3_of(bounds->max), axis);
    placed->is_cut = true;
    for (int view = 0; view < ZR_PAGE_ISOMETRIC; view++) {
        const double back = component(placed->views[view].axes.back, axis);
        if (back == 0.0) continue;
        placed->cut = (enum zr_page_view)view;
        placed->cut_place = back * (low + share * (high - low));
    }
    placed->shown = placed->cut == ZR_PAGE_FRONT ? ZR_PAGE_TOP : ZR_PAGE_FRONT;
}

enum zr_status zr_cut_view_scene(const struct zr_run *run, const struct zr_scene *scene, const struct zr_bounds *bounds,
                                 const struct zr_placed_views *placed, const struct zr_sections_cut **out)
{
    const zr_dvec3 back = placed->views[placed->cut].axes.back;
    const double size = (double)zr_diagonal_of(bounds);
    const struct zr_section_planes planes = {.count = 1,
                                             .at = {{{0.0 - back.x, 0.0 - back.y, 0.0 - back.z}, placed->cut_place}}};
    return zr_sections_make(run, scene, &planes, size, size, out);
}

/* ---- cutting line ---- */

static void add_line(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_point a, struct zr_point b)
{
    zr_plot_add_line(plot, pen, (const struct zr_point[2]){a, b}, 2);
}

/* Adds an end of the cutting line at `tip`: the line leaves it along (x, y), a unit vector, and the view looks along
 * (dx, dy). Returns its box. */
static struct zr_page_box add_end(struct zr_plot *plot, struct zr_point tip, double x, double y, double dx, double dy)
{
    const double wide = 4.0, shaft = 9.0, room = 1.2, width = zr_type_width("A", LETTER);
    const struct zr_point tail = {tip.x - shaft * dx, tip.y - shaft * dy};
    add_line(plot, ZR_PLOT_CUT, tip, (struct zr_point){tip.x + wide * x, tip.y + wide * y});
    add_line(plot, ZR_PLOT_DIMENSION, tail, tip);
    zr_plot_add_arrow(plot, tip, dx, dy);
    /* The letter is beside the tail, away from the view. */
    const struct zr_point middle = {tail.x - (room + 0.5 * LETTER) * x + 0.5 * width * dx,
                                    tail.y - (room + 0.5 * LETTER) * y + 0.5 * LETTER * dy};
    zr_plot_add_text(plot, "A", (struct zr_point){middle.x - 0.5 * width, middle.y + 0.5 * LETTER}, LETTER, false);
    const double half = 0.5 * LETTER;
    struct zr_page_box box = {fmin(tip.x, tail.x), fmin(tip.y, tail.y), fmax(tip.x, tail.x), fmax(tip.y, tail.y)};
    box.x0 = fmin(box.x0 - 1.0, middle.x - half);
    box.y0 = fmin(box.y0 - 1.0, middle.y - half);
    box.x1 = fmax(box.x1 + 1.0, middle.x + half);
    box.y1 = fmax(box.y1 + 1.0, middle.y + half);
    return box;
}

void zr_cut_view_mark(struct zr_plot *plot, const struct zr_placed_views *placed,
                      struct zr_page_box boxes[ZR_CUT_BOXES])
{
    const struct zr_page_box cut = placed->layout.views[placed->cut];
    const zr_dvec3 back = placed->views[placed->cut].axes.back;
    const struct zr_view_axes *axes = &placed->views[placed->shown].axes;
    const double right = zr_dvec3_dot(axes->right, back), up = zr_dvec3_dot(axes->up, back);
    const double dx = 0.0 - right, dy = up; /* y of the paper points down */
    const char *label = "A-A";
    const double width = zr_type_width(label, LETTER), middle = 0.5 * (cut.x0 + cut.x1);
    struct zr_point ends[2];
    zr_placed_cut_line(placed, ends);
    zr_plot_begin(plot, "section");
    const double x = right != 0.0 ? 0.0 : 1.0, y = right != 0.0 ? 1.0 : 0.0;
    zr_plot_add_straight(plot, ZR_PLOT_CENTER, ends[0], ends[1], true);
    boxes[0] = add_end(plot, ends[0], x, y, dx, dy);
    boxes[1] = add_end(plot, ends[1], 0.0 - x, 0.0 - y, dx, dy);
    zr_plot_add_text(plot, label, (struct zr_point){middle - 0.5 * width, cut.y0 - 4.0}, LETTER, false);
    boxes[2] = (struct zr_page_box){middle - 0.5 * width - 3.0, cut.y0 - 4.0 - LETTER - 1.0, middle + 0.5 * width + 3.0,
                                    cut.y0 - 3.0};
}

/* ---- hatch ---- */

/* An edge of a cap on the paper, with x + y and x - y of its ends, mirrored for hatches at 135 degrees. */
struct edge {
    double s[2], t[2];
};

struct crossing {
    double t;
    int turn;
};

struct hatching {
    const struct zr_run *run;
    struct zr_plot *plot;
    const struct zr_placed_views *placed;
    double step; /* of x + y */
    bool is_mirrored;
    uint32_t edge_count;
    struct edge *edges;
};

static struct zr_point place_of(const struct hatching *h, const struct zr_instance *instance, zr_vec4 position)
{
    double out[3], w = 0.0;
    const float *m = instance->object_to_world.m;
    const double p[4] = {(double)position.x, (double)position.y, (double)position.z, (double)position.w};
    for (int row = 0; row < 3; row++)
        out[row] = (((double)m[row] * p[0] + (double)m[4 + row] * p[1]) + (double)m[8 + row] * p[2]) +
                   (double)m[12 + row] * p[3];
    w = (((double)m[3] * p[0] + (double)m[7] * p[1]) + (double)m[11] * p[2]) + (double)m[15] * p[3];
    return zr_placed_world(h->placed, h->placed->cut, (zr_dvec3){out[0] / w, out[1] / w, out[2] / w});
}

static bool list_edges(struct hatching *h, const struct zr_instance *instance, const struct zr_mesh *mesh,
                       uint32_t face)
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const uint32_t first = rings.offsets[0], count = rings.offsets[rings.count] - first;
    h->edges = zr_arena_alloc(h->run->scratch, count, sizeof *h->edges);
    h->edge_count = 0;
    if (!h->edges) return false;
    for (uint32_t r = 0; r < rings.count; r++)
        for (uint32_t i = rings.offsets[r]; i < rings.offsets[r + 1]; i++) {
            if (i % EDGES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(h->run->cancel))
                return true; /* seen by the caller */
            const uint32_t next = i + 1 < rings.offsets[r + 1] ? i + 1 : rings.offsets[r];
            const struct zr_point a = place_of(h, instance, mesh->positions[mesh->indices[i]]),
                                  b = place_of(h, instance, mesh->positions[mesh->indices[next]]);
            const double sign = h->is_mirrored ? -1.0 : 1.0;
            h->edges[h->edge_count++] =
                (struct edge){{a.x + sign * a.y, b.x + sign * b.y}, {a.x - sign * a.y, b.x - sign * b.y}};
        }
    return true;
}

/* Returns the lines that an edge crosses: first and end, of those at whole steps. */
static void lines_of(const struct hatching *h, const struct edge *edge, double *first, double *end)
{
    const double low = fmin(edge->s[0], edge->s[1]), high = fmax(edge->s[0], edge->s[1]);
    *first = ceil(low / h->step);
    *end = ceil(high / h->step);
}

/* Restores the heap of crossings below `root`: the largest t is on top. */
static void sink(struct crossing *all, uint32_t root, uint32_t count)
{
    const struct crossing moved = all[root];
    for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && all[child + 1].t > all[child].t) child++;
        if (!(all[child].t > moved.t)) break;
        all[root] = all[child];
    }
    all[root] = moved;
}

/* Sorts by t, in bounded time. Crossings of equal t may come in any order: no length lies between them. */
static void sort(struct crossing *all, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;)
        sink(all, i, count);
    for (uint32_t end = count; end > 1; end--) {
        const struct crossing last = all[end - 1];
        all[end - 1] = all[0];
        all[0] = last;
        sink(all, 0, end - 1);
    }
}

static void add_stroke(const struct hatching *h, double s, double from, double to)
{
    const double least = 0.05, sign = h->is_mirrored ? -1.0 : 1.0;
    if (to - from < least) return;
    const struct zr_point a = {0.5 * (s + from), sign * 0.5 * (s - from)}, b = {0.5 * (s + to), sign * 0.5 * (s - to)};
    add_line(h->plot, ZR_PLOT_HATCH, a, b);
}

/* Hatches the inside by the non-zero rule. */
static enum zr_status hatch_edges(struct hatching *h)
{
    enum { LINES_MOST = 100000 };
    double low = HUGE_VAL, high = -HUGE_VAL, first, end;
    for (uint32_t i = 0; i < h->edge_count; i++) {
        lines_of(h, &h->edges[i], &first, &end);
        low = fmin(low, first);
        high = fmax(high, end);
    }
    if (!(high > low) || high - low > LINES_MOST) return ZR_OK;
    const uint32_t count = (uint32_t)(high - low);
    uint32_t *begins = zr_arena_zero(h->run->scratch, (size_t)count + 2, sizeof *begins);
    if (!begins) return ZR_NO_MEMORY;
    uint64_t total = 0;
    for (uint32_t i = 0; i < h->edge_count; i++) {
        lines_of(h, &h->edges[i], &first, &end);
        if (i % EDGES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(h->run->cancel)) return ZR_CANCELLED;
        total += (uint64_t)(end - first);
        for (double line = first; line < end; line++)
            begins[(uint32_t)(line - low) + 2]++;
    }
    for (uint32_t line = 0; line < count; line++)
        begins[line + 2] += begins[line + 1];
    struct crossing *all = total < UINT32_MAX / 2 ? zr_arena_alloc(h->run->scratch, total, sizeof *all) : NULL;
    if (!all) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < h->edge_count; i++) {
        const struct edge *edge = &h->edges[i];
        lines_of(h, edge, &first, &end);
        if (i % EDGES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(h->run->cancel)) return ZR_CANCELLED;
        for (double line = first; line < end; line++) {
            const double share = (line * h->step - edge->s[0]) / (edge->s[1] - edge->s[0]);
            all[begins[(uint32_t)(line - low) + 1]++] =
                (struct crossing){edge->t[0] + share * (edge->t[1] - edge->t[0]), edge->s[1] > edge->s[0] ? 1 : -1};
        }
    }
    for (uint32_t line = 0; line < count; line++) {
        struct crossing *own = all + begins[line];
        const uint32_t crossings = begins[line + 1] - begins[line];
        int winding = 0;
        double from = 0.0;
        if (zr_is_cancelled(h->run->cancel)) return ZR_CANCELLED;
        sort(own, crossings);
        for (uint32_t i = 0; i < crossings; i++) {
            if (winding == 0) from = own[i].t;
            winding += own[i].turn;
            if (winding == 0) add_stroke(h, (low + line) * h->step, from, own[i].t);
        }
    }
    return ZR_OK;
}

enum zr_status zr_cut_view_hatch(const struct zr_run *run, struct zr_plot *plot, const struct zr_placed_views *placed,
                                 const struct zr_scene *cut)
{
    static const double pitches[] = {3.0, 2.5, 3.5};
    struct hatching h = {.run = run, .plot = plot, .placed = placed};
    uint32_t part = 0;
    enum zr_status status = ZR_OK;
    for (uint32_t i = 0; status == ZR_OK && i < cut->instance_count; i++) {
        const struct zr_mesh *mesh = &cut->meshes[cut->instances[i].mesh];
        for (uint32_t face = mesh->face_count - mesh->cap_count; status == ZR_OK && face < mesh->face_count; face++) {
            h.step = sqrt(2.0) * pitches[part / 2 % 3];
            h.is_mirrored = part++ % 2 == 1;
            status = list_edges(&h, &cut->instances[i], mesh, face) ? hatch_edges(&h) : ZR_NO_MEMORY;
        }
    }
    return status;
}
