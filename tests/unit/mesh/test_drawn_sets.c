/* Which edges drawings have: the same ones in windows of all sizes, and those that a judge of each edge against each
 * triangle sees. DRAWN_SETS=1 compares all models of ZRASTER_DATA in eight windows. */
#include <math.h>
#include <stdlib.h>

#include "base/run.h"
#include "lines/drawing.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1u << 31)

/* ---- drawings ---- */

static const zr_vec3 directions[6] = {{0, 0, -1}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {-1, -1, -1}};

/* How a model is drawn. */
struct way {
    uint32_t direction, width, height;
    bool is_perspective, has_hidden;
};

struct drawn {
    struct way way;
    double scale; /* pixels per unit, of orthographic views */
    struct zr_drawing drawing;
};

static struct drawn draw(const struct zr_scene *scene, const struct way *way)
{
    const struct zr_bounds bounds = zr_bounds_of(scene, NULL, NULL);
    const zr_vec3 direction = directions[way->direction];
    struct zr_view view = scene->views[0];
    struct zr_camera camera;
    struct zr_error error = {0};
    struct drawn drawn = {.way = *way};
    view.width = way->width;
    view.height = way->height;
    view.pose = ZR_POSE_DIRECTION;
    view.direction = direction;
    view.up = direction.x == 0.0f && direction.z == 0.0f ? (zr_vec3){0, 0, -1} : (zr_vec3){0, 1, 0};
    if (!way->is_perspective) view.projection = ZR_PROJECTION_ORTHOGRAPHIC;
    assert_int_equal(zr_camera_resolve(&(struct zr_run){.error = &error}, scene, &view, &bounds, &camera), ZR_OK);
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = &bounds,
                                         .width = way->width,
                                         .height = way->height,
                                         .rule = {.crease_degrees = 30},
                                         .has_hidden = way->has_hidden};
    assert_int_equal(zr_drawing_make(&(struct zr_run){.arena = &arena}, &desc, &drawn.drawing), ZR_OK);
    drawn.scale = 0.5 * (double)way->width * (double)camera.projection.m[0];
    return drawn;
}

/* ---- pages: the segments of a drawing by squares of 8 pixels of a window ---- */

enum { SQUARE = 8, MARGIN = 16 };

enum { VISIBLE = 1, HIDDEN = 2 };

struct page {
    int columns, rows;
    uint32_t *firsts, *segments; /* numbers of points: a segment ends there */
    const uint8_t *kinds;        /* by number; 0: no segment ends there */
    uint32_t point_count;
    double (*points)[2];
};

static int square_at(double value, int count)
{
    const int at = (int)floor((value + MARGIN) / SQUARE);
    return at < 0 ? 0 : at >= count ? count - 1 : at;
}

/* Counts or lists the squares of a segment's box. */
static void list(const struct page *page, uint32_t segment, bool writes)
{
    const double *p = page->points[segment - 1], *q = page->points[segment];
    const int left = square_at(fmin(p[0], q[0]) - 2, page->columns),
              right = square_at(fmax(p[0], q[0]) + 2, page->columns);
    const int low = square_at(fmin(p[1], q[1]) - 2, page->rows), high = square_at(fmax(p[1], q[1]) + 2, page->rows);
    const double dx = q[0] - p[0], dy = q[1] - p[1], length = hypot(dx, dy);
    for (int y = low; y <= high; y++)
        for (int x = left; x <= right; x++) {
            const double cx = (x + 0.5) * SQUARE - MARGIN - p[0], cy = (y + 0.5) * SQUARE - MARGIN - p[1];
            const bool is_edge = x == 0 || y == 0 || x == page->columns - 1 || y == page->rows - 1;
            if (!is_edge && fabs(dx * cy - dy * cx) > length * (SQUARE + 2)) continue;
            uint32_t *first = &page->firsts[y * page->columns + x];
            if (writes)
                page->segments[--*first] = segment;
            else
                ++*first;
        }
}

/* Moves a drawing to the window of another one: both have the same middle. */
static struct page page_of(const struct drawn *from, const struct drawn *to)
{
    const struct zr_polylines *lines = &from->drawing.polylines;
    const double scale = to->scale / from->scale;
    struct page page = {.columns = (int)(to->way.width + 2 * MARGIN) / SQUARE + 1,
                        .rows = (int)(to->way.height + 2 * MARGIN) / SQUARE + 1};
    const size_t squares = (size_t)page.columns * (size_t)page.rows;
    uint8_t *kinds = zr_arena_zero(&arena, lines->point_count, sizeof *kinds);
    page.points = zr_arena_alloc(&arena, lines->point_count, sizeof *page.points);
    page.firsts = zr_arena_zero(&arena, squares + 1, sizeof *page.firsts);
    page.kinds = kinds;
    page.point_count = lines->point_count;
    for (uint32_t i = 0; i < lines->point_count; i++) {
        page.points[i][0] = (lines->points[i][0] - 0.5 * from->way.width) * scale + 0.5 * to->way.width;
        page.points[i][1] = (lines->points[i][1] - 0.5 * from->way.height) * scale + 0.5 * to->way.height;
    }
    for (int writes = 0; writes < 2; writes++) {
        for (uint32_t i = 0; i < lines->count; i++)
            for (uint32_t k = lines->at[i].first + 1; k < lines->at[i].first + lines->at[i].count; k++) {
                kinds[k] = lines->at[i].class == ZR_STROKE_HIDDEN ? HIDDEN : VISIBLE;
                list(&page, k, writes);
            }
        uint32_t sum = 0;
        for (size_t s = 0; s <= squares && !writes; s++)
            page.firsts[s] = sum += page.firsts[s];
        if (!writes) page.segments = zr_arena_alloc(&arena, sum, sizeof *page.segments);
    }
    return page;
}

static double distance_of(const double p[2], const double q[2], double x, double y)
{
    const double dx = q[0] - p[0], dy = q[1] - p[1], square = dx * dx + dy * dy;
    const double t = square > 0.0 ? ((x - p[0]) * dx + (y - p[1]) * dy) / square : 0.0, in = t < 0.0   ? 0.0
                                                                                             : t > 1.0 ? 1.0
                                                                                                       : t;
    return hypot(x - p[0] - in * dx, y - p[1] - in * dy);
}

/* True if a segment of the kinds is near a point. */
static bool has_line(const struct page *page, unsigned kinds, double x, double y, double near)
{
    const uint32_t *first = &page->firsts[square_at(y, page->rows) * page->columns + square_at(x, page->columns)];
    for (uint32_t i = first[0]; i < first[1]; i++) {
        const uint32_t k = page->segments[i];
        if (kinds & page->kinds[k] && distance_of(page->points[k - 1], page->points[k], x, y) <= near) return true;
    }
    return false;
}

/* ---- the same edges in all windows ---- */

/* What only one of two drawings has, of its straight segments of at least 12 pixels of the smaller window. */
struct difference {
    double longest, at[2]; /* the longest run, and where it ends */
    double missing, length;
};

static void find_missing(const struct page *of, const struct page *in, struct difference *out)
{
    const double step = 0.5, least = 12.0, near = 1.0;
    for (uint32_t k = 1; k < of->point_count; k++) {
        const double *p = of->points[k - 1], *q = of->points[k], length = hypot(q[0] - p[0], q[1] - p[1]);
        double run = 0.0;
        if (of->kinds[k] == 0 || length < least) continue;
        for (double at = 0.0; at <= length; at += step) {
            const double x = p[0] + (q[0] - p[0]) * at / length, y = p[1] + (q[1] - p[1]) * at / length;
            run = has_line(in, VISIBLE | of->kinds[k], x, y, near) ? 0.0 : run + step;
            out->missing += run > 0.0 ? step : 0.0;
            out->length += step;
            if (run <= out->longest) continue;
            *out = (struct difference){run, {x, y}, out->missing, out->length};
        }
    }
}

/* Compares the drawings of two windows. */
static struct difference difference_of(const struct zr_scene *scene, const struct way *small, const struct way *large)
{
    const struct drawn a = draw(scene, small), b = draw(scene, large);
    const struct page page_a = page_of(&a, &a), page_b = page_of(&b, &a);
    struct difference difference = {0};
    find_missing(&page_a, &page_b, &difference);
    find_missing(&page_b, &page_a, &difference);
    return difference;
}

/* Compares a model in each of the windows with the last one. */
static void compare_windows(const char *name, const char *text, const uint32_t (*windows)[2], uint32_t count)
{
    const double run_most = 2.0;
    for (uint32_t way = 0; way < 6 * 2; way++)
        for (uint32_t i = 0; i + 1 < count; i++) {
            zr_arena_free(&arena);
            zr_arena_init(&arena, 1u << 31);
            const struct zr_scene *scene =
                text ? model_of_text(&arena, text, "technical") : model_of_file(&arena, name, "technical");
            if (!scene) return;
            struct way small = {way / 2, windows[i][0], windows[i][1], false, way % 2};
            struct way large = small;
            large.width = windows[count - 1][0];
            large.height = windows[count - 1][1];
            const struct difference d = difference_of(scene, &small, &large);
            if (d.longest > run_most)
                fail_msg("%s, direction %u, %u x %u%s: %.1f pixels are missing at %.1f %.1f; %.1f of %.0f in all", name,
                         small.direction, small.width, small.height, small.has_hidden ? ", hidden" : "", d.longest,
                         d.at[0], d.at[1], d.missing, d.length);
        }
}

/* A plate with a rib that ends 0.02 above it, a step of 0.004, and a small bevel. */
static const char plate[] =
    "v -1.5 0 -1\nv 1.5 0 -1\nv 1.5 0.22 -1\nv -1.5 0.22 -1\nv -1.5 0 1\nv 1.5 0 1\nv 1.5 0.22 1\nv -1.5 0.22 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"
    "v 0.6 0.1 -0.1\nv 1.3 0.1 -0.1\nv 1.3 0.24 -0.1\nv 0.72 0.9 -0.1\n"
    "v 0.6 0.1 0.1\nv 1.3 0.1 0.1\nv 1.3 0.24 0.1\nv 0.72 0.9 0.1\n"
    "f 9 12 11 10\nf 13 14 15 16\nf 9 10 14 13\nf 12 16 15 11\nf 9 13 16 12\nf 10 11 15 14\n"
    "v -1.2 0.1 -0.5\nv -0.6 0.1 -0.5\nv -0.6 0.224 -0.5\nv -1.2 0.224 -0.5\n"
    "v -1.2 0.1 0.5\nv -0.6 0.1 0.5\nv -0.6 0.224 0.5\nv -1.2 0.224 0.5\n"
    "f 17 20 19 18\nf 21 22 23 24\nf 17 18 22 21\nf 20 24 23 19\nf 17 21 24 20\nf 18 19 23 22\n";

/* Upright prisms of 3 to 6 corners, turned anyhow, each in a cube of its own. */
static const char *prisms(uint64_t seed)
{
    static char text[1 << 14];
    struct random numbers = random_seeded(seed);
    size_t used = 0;
    int first = 1;
    for (int i = 0; i < 12; i++) {
        const int corners = 3 + (int)random_below(&numbers, 4);
        const double a = random_range(&numbers, 0, 6.28), b = random_range(&numbers, 0, 6.28),
                     radius = random_range(&numbers, 0.1, 0.33), half = random_range(&numbers, 0.02, 0.33);
        for (int k = 0; k < 2 * corners; k++) {
            const double turn = a + 6.283185307179586 * (k % corners) / corners, up = k < corners ? -half : half;
            const double x = radius * cos(turn), y = radius * sin(turn) * cos(b) - up * sin(b),
                         z = radius * sin(turn) * sin(b) + up * cos(b);
            used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %.6f\n", x + i % 3, y + i / 3 % 2,
                                     z + i / 6);
        }
        for (int k = 0; k < corners; k++) {
            const int next = (k + 1) % corners;
            used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", first + k, first + next,
                                     first + corners + next, first + corners + k);
        }
        for (int side = 0; side < 2; side++) {
            used += (size_t)snprintf(text + used, sizeof text - used, "f");
            for (int k = 0; k < corners; k++)
                used += (size_t)snprintf(text + used, sizeof text - used, " %d",
                                         first + (side ? corners + k : corners - 1 - k));
            used += (size_t)snprintf(text + used, sizeof text - used, "\n");
        }
        first += 2 * corners;
    }
    return text;
}

/* A cylinder of 24 sides with a hole of 12. */
static const char *tube(void)
{
    static char text[1 << 14];
    size_t used = 0;
    for (int k = 0; k < 48; k++) {
        const double turn = 6.283185307179586 * (k % 24) / 24, up = k < 24 ? 0 : 1.3;
        used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %.6f\nv %.6f %.6f %.6f\n", cos(turn), up,
                                 sin(turn), 0.4 * cos(turn), up, 0.4 * sin(turn));
    }
    for (int k = 0; k < 24; k++) {
        const int a = 2 * k + 1, b = 2 * ((k + 1) % 24) + 1, up = 48;
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "f %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\n", a, a + up, b + up, b,
                                 a + 1, b + 1, b + 1 + up, a + 1 + up, a, b, b + 1, a + 1, a + up, a + 1 + up,
                                 b + 1 + up, b + up);
    }
    return text;
}

TEST(windows_of_all_sizes_have_the_same_edges)
{
    static const uint32_t windows[][2] = {{200, 150}, {320, 320}, {640, 480}, {1100, 900}};
    compare_windows("plate", plate, windows, 4);
    compare_windows("prisms", prisms(5), windows, 4);
    compare_windows("tube", tube(), windows, 4);
}

TEST(windows_of_all_sizes_have_the_same_edges_of_all_models)
{
    static const char *const names[] = {"beetle.obj",     "cow.obj",           "fandisk.obj",        "spot.obj",
                                        "suzanne.obj",    "teapot.obj",        "stanford-bunny.obj", "parts/cube.obj",
                                        "parts/gear.obj", "parts/openbox.obj", "parts/housing.obj",  "parts/plate.obj"};
    static const uint32_t windows[][2] = {{160, 120}, {240, 240},  {320, 480},  {640, 480},
                                          {800, 600}, {1024, 768}, {1280, 400}, {1600, 1600}};
    if (!getenv("DRAWN_SETS")) return;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        compare_windows(names[i], NULL, windows, 8);
}

/* ---- each edge against each triangle ---- */

struct judge {
    const struct zr_window_mesh *mesh;
    const struct page *page;
    double scale;                         /* to pixels of the window */
    uint32_t seen, hidden, wrong, strays; /* samples */
};

static double side_of(const struct zr_window_point *a, const struct zr_window_point *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* True if a triangle that does not have both ends of the edge lies before a point of it. */
static bool is_behind(const struct zr_window_mesh *mesh, const uint32_t ends[2], const struct zr_window_point *p)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *c = mesh->corners[t];
        const struct zr_window_point *a = &mesh->points[c[0]], *b = &mesh->points[c[1]], *d = &mesh->points[c[2]];
        const double area = side_of(a, b, d->x, d->y), of_a = side_of(b, d, p->x, p->y) / area,
                     of_b = side_of(d, a, p->x, p->y) / area, of_d = 1.0 - of_a - of_b;
        int shared = 0;
        for (int k = 0; k < 3; k++)
            shared += c[k] == ends[0] || c[k] == ends[1];
        if (shared == 2 || !(of_a > 0.0 && of_b > 0.0 && of_d > 0.0)) continue;
        if (of_a * a->z + of_b * b->z + of_d * d->z < p->z) return true;
    }
    return false;
}

/* True if the answer of the judge does not change within half a pixel along the edge. */
static bool is_certain(const bool *behind, int count, int at, int reach)
{
    if (at < reach || at + reach >= count) return false;
    for (int i = at - reach; i <= at + reach; i++)
        if (behind[i] != behind[at]) return false;
    return true;
}

/* Compares an edge with the page, in steps of a quarter of a pixel. */
static void judge_edge(struct judge *j, const uint32_t ends[2])
{
    enum { STEPS_MOST = 4096, REACH = 2 };
    static bool behind[STEPS_MOST];
    const struct zr_window_point *p = &j->mesh->points[ends[0]], *q = &j->mesh->points[ends[1]];
    const int steps = (int)(4.0 * j->scale * hypot(q->x - p->x, q->y - p->y));
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < steps && i < STEPS_MOST; i++) {
            const double t = (i + 0.5) / steps;
            const struct zr_window_point at = {p->x + t * (q->x - p->x), p->y + t * (q->y - p->y),
                                               p->z + t * (q->z - p->z)};
            if (pass == 0) {
                behind[i] = is_behind(j->mesh, ends, &at);
            } else if (is_certain(behind, steps, i, REACH)) {
                const unsigned kinds = behind[i] ? HIDDEN | VISIBLE : VISIBLE;
                j->seen += !behind[i];
                j->hidden += behind[i];
                j->wrong += !has_line(j->page, kinds, at.x * j->scale, at.y * j->scale, 0.1);
            }
        }
}

/* Returns true if a visible edge comes within half a pixel of a point. */
static bool has_edge(const struct judge *j, double x, double y)
{
    const struct zr_drawn_instance *of = &j->mesh->instances[0];
    for (uint32_t e = 0; e < of->table->edge_count; e++) {
        const uint32_t ends[2] = {of->table->edges[e].low, of->table->edges[e].high};
        const struct zr_window_point *p = &j->mesh->points[ends[0]], *q = &j->mesh->points[ends[1]];
        const double dx = q->x - p->x, dy = q->y - p->y, square = dx * dx + dy * dy;
        for (double along = -0.5; along <= 0.5 && !zr_edge_is_diagonal(of->table, e); along += 0.25) {
            double t = ((x - p->x) * dx + (y - p->y) * dy) / square + along / j->scale / sqrt(square);
            t = t < 1e-9 ? 1e-9 : t > 1.0 - 1e-9 ? 1.0 - 1e-9 : t;
            const struct zr_window_point at = {p->x + t * dx, p->y + t * dy, p->z + t * (q->z - p->z)};
            if (hypot(at.x - x, at.y - y) * j->scale > 0.5) continue;
            if (!is_behind(j->mesh, ends, &at)) return true;
        }
    }
    return false;
}

/* Counts samples of visible lines that no visible edge is near. */
static void judge_lines(struct judge *j)
{
    for (uint32_t k = 1; k < j->page->point_count; k++) {
        const double *p = j->page->points[k - 1], *q = j->page->points[k], length = hypot(q[0] - p[0], q[1] - p[1]);
        for (double at = 0.5; at < length && j->page->kinds[k] == VISIBLE; at += 3.0)
            j->strays += !has_edge(j, (p[0] + (q[0] - p[0]) * at / length) / j->scale,
                                   (p[1] + (q[1] - p[1]) * at / length) / j->scale);
    }
}

/* Prisms have no edges but creases, and do not touch one another. */
TEST(visible_and_hidden_intervals_are_those_of_a_judge)
{
    for (uint32_t seed = 1; seed <= 6; seed++) {
        const struct way way = {5, 640, 480, seed % 2 == 0, true};
        const struct drawn drawn = draw(model_of_text(&arena, prisms(seed), seed % 2 ? "technical" : "studio"), &way);
        const struct page page = page_of(&drawn, &drawn);
        const struct zr_window_mesh *mesh = &drawn.drawing.mesh;
        const struct zr_edge_mesh *table = mesh->instances[0].table;
        struct judge j = {.mesh = mesh, .page = &page, .scale = way.width / mesh->view.width};
        for (uint32_t e = 0; e < table->edge_count; e++)
            if (!zr_edge_is_diagonal(table, e))
                judge_edge(&j, (const uint32_t[2]){table->edges[e].low, table->edges[e].high});
        judge_lines(&j);
        print_message(
            "seed %u: %u visible and %u hidden samples, %u without a line; %u samples of lines without an edge\n", seed,
            j.seen, j.hidden, j.wrong, j.strays);
        assert_true(j.seen > 1000 && j.hidden > 1000);
        assert_true(j.wrong == 0 && j.strays == 0);
    }
}

RUN_TESTS(open_arena, close_arena)
