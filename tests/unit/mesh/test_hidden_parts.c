/* Hidden parts of lines, compared with each line against each triangle, without cells. Also what makes the lines:
 * chains of creases, and intersections of pieces. */
#include "base/run.h"
#include "lines/chains.h"
#include "lines/hidden_parts.h"
#include "lines/intersections.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1u << 30)

/* ---- lines of a model, and their hidden parts ---- */

struct drawing {
    struct drawn_model model;
    struct zr_cells cells;
    struct zr_lines lines;
    struct zr_hidden_parts hidden;
};

static struct drawing draw_scene(const struct zr_scene *scene, struct zr_team *team, uint32_t width, uint32_t height)
{
    const struct zr_feature_rule rule = {.crease_degrees = 30, .keeps_noise = true};
    struct drawing d = {.model = model_in_window(&arena, team, scene, width, height)};
    const struct zr_window_mesh *mesh = &d.model.mesh;
    uint8_t *features = zr_features_find(&(struct zr_run){.arena = &arena, .team = team}, mesh, &rule);
    assert_int_equal(zr_chains_keep(&arena, NULL, mesh, features), ZR_OK);
    assert_int_equal(zr_lines_make(&arena, NULL, mesh, features, &d.lines), ZR_OK);
    assert_int_equal(zr_cells_make(&(struct zr_run){.arena = &arena, .team = team}, mesh, &d.cells), ZR_OK);
    assert_int_equal(zr_intersections_add(&(struct zr_run){.arena = &arena, .team = team}, mesh, &d.cells, &d.lines),
                     ZR_OK);
    assert_int_equal(
        zr_hidden_parts_find(&(struct zr_run){.arena = &arena, .team = team}, mesh, &d.cells, &d.lines, &d.hidden),
        ZR_OK);
    return d;
}

static struct drawing draw_text(const char *text)
{
    return draw_scene(model_of_text(&arena, text, text[0] == '{' ? NULL : "technical"), NULL, 400, 300);
}

static uint32_t count_kind(const struct drawing *d, enum zr_line_kind kind)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < d->lines.count; i++)
        count += d->lines.at[i].kind == kind;
    return count;
}

/* Returns the hidden length of all lines, in pixels. */
static double hidden_pixels(const struct drawing *d)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < d->lines.count; i++) {
        const struct zr_window_point *p = d->lines.at[i].ends;
        const double length = sqrt((p[1].x - p[0].x) * (p[1].x - p[0].x) + (p[1].y - p[0].y) * (p[1].y - p[0].y));
        for (uint32_t k = d->hidden.firsts[i]; k < d->hidden.firsts[i + 1]; k++)
            sum += length * (d->hidden.parts[k].end - d->hidden.parts[k].begin);
    }
    return sum;
}

/* ---- by brute force: barycentric coordinates at both ends, which are linear between them ---- */

enum { PARTS_MOST = 4096 };

struct brute {
    uint32_t count;
    struct zr_part_of_line parts[PARTS_MOST];
};

static void barycentric(const struct zr_window_point *const c[3], const struct zr_window_point *p, double out[3])
{
    const double area = (c[1]->x - c[0]->x) * (c[2]->y - c[0]->y) - (c[2]->x - c[0]->x) * (c[1]->y - c[0]->y);
    out[1] = ((p->x - c[0]->x) * (c[2]->y - c[0]->y) - (c[2]->x - c[0]->x) * (p->y - c[0]->y)) / area;
    out[2] = ((c[1]->x - c[0]->x) * (p->y - c[0]->y) - (p->x - c[0]->x) * (c[1]->y - c[0]->y)) / area;
    out[0] = 1.0 - out[1] - out[2];
}

/* Returns how far the line is behind the plane of the triangle, beyond the limit. */
static double behind(const struct zr_window_point *const c[3], const struct zr_window_point *p)
{
    const struct zr_window_point right = {p->x + 1.0, p->y, p->z}, up = {p->x, p->y + 1.0, p->z};
    double at[3], at_right[3], at_up[3], z = 0.0, z_right = 0.0, z_up = 0.0;
    barycentric(c, p, at);
    barycentric(c, &right, at_right);
    barycentric(c, &up, at_up);
    for (int k = 0; k < 3; k++) {
        z += at[k] * c[k]->z;
        z_right += at_right[k] * c[k]->z;
        z_up += at_up[k] * c[k]->z;
    }
    return p->z - z - (0.01 + 0.02 * hypot(z_right - z, z_up - z));
}

static void limit(double from, double to, double *begin, double *end)
{
    const double t = from / (from - to);
    if (from <= 0.0 && to <= 0.0) *end = -1.0;
    if (from < 0.0 && to > 0.0) *begin = fmax(*begin, t);
    if (from > 0.0 && to < 0.0) *end = fmin(*end, t);
}

static int by_begin(const void *a, const void *b)
{
    const double x = ((const struct zr_part_of_line *)a)->begin, y = ((const struct zr_part_of_line *)b)->begin;
    return (x > y) - (x < y);
}

/* Joins sorted parts over gaps, and drops short ones, as hidden_parts.h has it. */
static void close_gaps(struct brute *brute, double gap)
{
    uint32_t made = 0;
    for (uint32_t i = 0; i < brute->count; i++) {
        struct zr_part_of_line *last = &brute->parts[made - (made > 0)];
        if (made > 0 && brute->parts[i].begin < last->end + gap)
            last->end = fmax(last->end, brute->parts[i].end);
        else
            brute->parts[made++] = brute->parts[i];
    }
    brute->count = 0;
    for (uint32_t i = 0; i < made; i++) {
        const struct zr_part_of_line part = brute->parts[i];
        if (part.begin <= 0.0 || part.end >= 1.0 || part.end - part.begin >= gap) brute->parts[brute->count++] = part;
    }
}

static void find_brutally(const struct zr_window_mesh *mesh, const struct zr_line *line, struct brute *brute)
{
    const struct zr_window_point *p = &line->ends[0], *q = &line->ends[1];
    brute->count = 0;
    for (uint32_t h = 0; h < mesh->triangle_count + mesh->cut_count; h++) {
        const uint32_t source = zr_hider_source(mesh, h), *corners = mesh->corners[h];
        const struct zr_window_point *c[3] = {&mesh->points[corners[0]], &mesh->points[corners[1]],
                                              &mesh->points[corners[2]]};
        double begin = 0.0, end = 1.0, from[3], to[3];
        if (!(mesh->traits[h] & ZR_TRIANGLE_HIDES) || source == line->triangles[0] || source == line->triangles[1])
            continue;
        barycentric(c, p, from);
        barycentric(c, q, to);
        const double area = fabs((c[1]->x - c[0]->x) * (c[2]->y - c[0]->y) - (c[2]->x - c[0]->x) * (c[1]->y - c[0]->y));
        for (int k = 0; k < 3; k++) {
            const struct zr_window_point *a = c[(k + 1) % 3], *b = c[(k + 2) % 3];
            const double rim = 1e-6 * (fabs(b->x - a->x) + fabs(b->y - a->y)) / area;
            limit(from[k] + rim, to[k] + rim, &begin, &end);
        }
        if (begin < end) limit(behind(c, p), behind(c, q), &begin, &end);
        if (begin < end && brute->count < PARTS_MOST)
            brute->parts[brute->count++] = (struct zr_part_of_line){begin, end};
    }
    qsort(brute->parts, brute->count, sizeof *brute->parts, by_begin);
    close_gaps(brute, 0.6 / hypot(q->x - p->x, q->y - p->y));
}

/* Compares each `step`-th line. Prints and returns the largest distance of two ends, in pixels. */
static double compare(const struct drawing *d, uint32_t step, const char *name)
{
    static struct brute brute;
    double worst = 0.0;
    uint32_t parts = 0;
    for (uint32_t i = 0; i < d->lines.count; i += step) {
        const struct zr_line *line = &d->lines.at[i];
        const struct zr_part_of_line *own = d->hidden.parts + d->hidden.firsts[i];
        const double length = hypot(line->ends[1].x - line->ends[0].x, line->ends[1].y - line->ends[0].y);
        find_brutally(&d->model.mesh, line, &brute);
        if (brute.count != d->hidden.firsts[i + 1] - d->hidden.firsts[i])
            fail_msg("%s: line %u has %u hidden parts, not %u", name, i, d->hidden.firsts[i + 1] - d->hidden.firsts[i],
                     brute.count);
        for (uint32_t k = 0; k < brute.count; k++) {
            worst = fmax(worst, length * fabs(own[k].begin - brute.parts[k].begin));
            worst = fmax(worst, length * fabs(own[k].end - brute.parts[k].end));
        }
        parts += brute.count;
    }
    print_message("%s: %u lines, %u hidden parts, ends within %.2g pixel\n", name, d->lines.count, parts, worst);
    return worst;
}

static void assert_equals_brute_force(const struct zr_scene *scene, uint32_t step, const char *name)
{
    const struct drawing d = draw_scene(scene, NULL, 640, 480);
    assert_true(compare(&d, step, name) <= 1e-6);
}

/* Boxes on one another, and turned ones through them. */
static const char *boxes(void)
{
    static char text[1 << 14];
    size_t used = 0;
    struct random numbers = random_seeded(3);
    for (int i = 0; i < 12; i++) {
        const float x = (float)(i % 3) * 0.9f, y = (float)(i / 3), z = (float)random_below(&numbers, 100) / 100.0f;
        for (int k = 0; k < 8; k++)
            used += (size_t)snprintf(text + used, sizeof text - used, "v %g %g %g\n", (double)(x + (float)(k & 1)),
                                     (double)(y + (float)(k >> 1 & 1)), (double)(z + 0.7f * (float)(k >> 2)));
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\n"
                                 "f -7 -5 -1 -3\n");
    }
    return text;
}

static const char *torus(void)
{
    enum { AROUND = 48, ACROSS = 24 };
    static char text[1 << 17];
    size_t used = 0;
    for (int i = 0; i < AROUND * ACROSS; i++) {
        const double a = 6.283185307179586 * (i / ACROSS) / AROUND, b = 6.283185307179586 * (i % ACROSS) / ACROSS;
        const double r = 2.0 + cos(b);
        used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %.6f\n", r * cos(a), sin(b), r * sin(a));
    }
    for (int i = 0; i < AROUND * ACROSS; i++) {
        const int row = i / ACROSS, next = (row + 1) % AROUND, k = i % ACROSS, l = (k + 1) % ACROSS;
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", 1 + row * ACROSS + k,
                                 1 + row * ACROSS + l, 1 + next * ACROSS + l, 1 + next * ACROSS + k);
    }
    return text;
}

TEST(hidden_parts_equal_brute_force)
{
    static const char *const looks[] = {"technical", "studio"}; /* orthographic, perspective */
    static const char *const names[] = {"parts/cube.obj", "parts/gear.obj", "parts/housing.obj", "parts/plate.obj"};
    for (int l = 0; l < 2; l++) {
        assert_equals_brute_force(model_of_text(&arena, boxes(), looks[l]), 1, "boxes");
        assert_equals_brute_force(model_of_text(&arena, torus(), looks[l]), 1, "torus");
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            const struct zr_scene *scene = model_of_file(&arena, names[i], looks[l]);
            if (scene) assert_equals_brute_force(scene, 7, names[i]);
        }
        const struct zr_scene *bunny = model_of_file(&arena, "stanford-bunny.obj", looks[l]);
        if (bunny) assert_equals_brute_force(bunny, 197, "bunny");
    }
}

TEST(a_camera_within_the_boxes_cuts_them)
{
    char text[1 << 12];
    snprintf(text, sizeof text,
             "{\"look\": \"studio\", \"view\": {\"eye\": [0.5, 0.5, 0.5], \"target\": [3, 1.2, 0.8], "
             "\"znear\": 0.3, \"zfar\": 3}, \"meshes\": [");
    for (int i = 0; i < 9; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "%s{\"positions\": [[%d,0,0],[%d,0,0],[%d,%d,0],[%d,0,1],[%d,1,1]], "
                 "\"faces\": [[0,1,2],[0,3,4],[1,2,4],[2,3,4],[0,3,2]]}",
                 i ? "," : "", i / 3, i / 3 + 1, i / 3, 1 + i % 3, i / 3 + 1, i / 3);
    strcat(text, "]}");
    const struct drawing d = draw_text(text);
    assert_true(d.model.mesh.cut_count > 0);
    assert_true(compare(&d, 1, "cut") <= 1e-6);
}

TEST(threads_find_the_same_parts)
{
    struct zr_team *team = zr_team_create(4);
    const struct zr_scene *scene = model_of_text(&arena, boxes(), "technical");
    const struct drawing one = draw_scene(scene, NULL, 640, 480), four = draw_scene(scene, team, 640, 480);
    assert_int_equal(one.lines.count, four.lines.count);
    assert_memory_equal(one.hidden.firsts, four.hidden.firsts, (one.lines.count + 1) * sizeof *one.hidden.firsts);
    assert_memory_equal(one.hidden.parts, four.hidden.parts,
                        one.hidden.firsts[one.lines.count] * sizeof *one.hidden.parts);
    zr_team_destroy(team);
}

TEST(three_edges_of_a_cube_are_hidden)
{
    const struct drawing d = draw_text(CUBE_CORNERS CUBE_SIDES CUBE_TOP);
    assert_int_equal(d.lines.count, 12);
    assert_int_equal(count_kind(&d, ZR_LINE_CREASE), 12);
    const double edge =
        hypot(d.lines.at[0].ends[1].x - d.lines.at[0].ends[0].x, d.lines.at[0].ends[1].y - d.lines.at[0].ends[0].y);
    assert_true(fabs(hidden_pixels(&d) - 3.0 * edge) < 0.1);
}

/* ---- intersections ---- */

/* A horizontal and an upright square, which cross along z from 0 to `z`. */
#define FLOOR      "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 2 3 4\n"
#define WALL(x, z) "v " x " -1 0\nv " x " 1 0\nv " x " 1 " z "\nv " x " -1 " z "\nf 5 6 7 8\n"

/* Returns the point of a position of the first instance. */
static struct zr_window_point point_of(const struct drawing *d, uint32_t position)
{
    const uint32_t *positions = d->model.mesh.instances[0].table->positions;
    uint32_t v = 0;
    while (positions[v] != position)
        v++;
    return d->model.mesh.points[v];
}

TEST(two_pieces_cut_one_another_in_a_line)
{
    const struct drawing d = draw_text(FLOOR WALL("0", "0.5"));
    double length = 0.0;
    const struct zr_window_point a = point_of(&d, 0), b = point_of(&d, 3);
    for (uint32_t i = 0; i < d.lines.count; i++)
        if (d.lines.at[i].kind == ZR_LINE_INTERSECTION)
            length += hypot(d.lines.at[i].ends[1].x - d.lines.at[i].ends[0].x,
                            d.lines.at[i].ends[1].y - d.lines.at[i].ends[0].y);
    assert_true(fabs(length - 0.25 * hypot(b.x - a.x, b.y - a.y)) < 1e-6);
}

TEST(pieces_that_touch_make_no_line)
{
    const struct drawing above = draw_text(FLOOR "v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nf 5 6 7 8\n"),
                         coincident = draw_text(FLOOR "v 0 0 0\nv 3 0 0\nv 3 0 2\nv 0 0 2\nf 5 6 7 8\n");
    assert_int_equal(count_kind(&above, ZR_LINE_INTERSECTION), 0);
    assert_int_equal(count_kind(&coincident, ZR_LINE_INTERSECTION), 0);
}

/* ---- chains ---- */

/* Two strips that bend by 40 degrees (weak) or 60 degrees (strong) at a crease of `pixels`, and triangles far away, beside
 * which no crease is long. */
static uint32_t creases_of_bend(double pixels, double degrees)
{
    char text[512];
    const double s = pixels / 100.0, x = cos(degrees * 0.017453292519943295), z = sin(degrees * 0.017453292519943295);
    snprintf(text, sizeof text,
             "{\"view\": {\"preset\": \"front\", \"orthographic\": {\"xmag\": 2, \"ymag\": 1.5}}, \"meshes\": "
             "[{\"positions\": "
             "[[-1,0,0],[0,0,0],[%.9f,0,%.9f],[-1,%.9f,0],[0,%.9f,0],[%.9f,%.9f,%.9f],[50,0,0],[51,0,0],[50,1,0],[-50,"
             "0,0],[-51,0,0],[-50,1,0]], "
             "\"faces\": [[0,1,4,3],[1,2,5,4],[6,7,8],[9,10,11]]}]}",
             x, -z, s, s, x, s, -z);
    const struct drawing d = draw_text(text);
    return count_kind(&d, ZR_LINE_CREASE);
}

TEST(short_and_weak_creases_need_length)
{
    assert_int_equal(creases_of_bend(13.0, 60), 1);
    assert_int_equal(creases_of_bend(13.0, 40), 0);
    assert_int_equal(creases_of_bend(73.0, 40), 1);
    assert_int_equal(creases_of_bend(71.0, 40), 0);
}

RUN_TESTS(open_arena, close_arena)
