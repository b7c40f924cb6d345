#include "measure/align.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/trig.h"
#include "measure/surface_points.h"
#include "mesh/facts/ray_grid.h"

enum {
    COARSE = 400, /* points by which candidates are chosen */
    MEDIUM = 1000,
    FINE = 5000,
    ROUNDS = 20,
    FINE_ROUNDS = 40,
    CANDIDATES = 73,
    REFINED = 6,
    ANGLES = 36,
    UNKNOWNS = 7,
    ITEMS_PER_CANCEL_CHECK = 1 << 13
};

/* Moments that differ by this share are equal. */
#define EQUAL 0.02

/* The given place wins unless another one is better by this factor; within it, places are ambiguous. */
#define BETTER 0.95

/* Distances that are rounding errors, relative to the diagonal. */
#define ROUNDING 1e-9

/* Largest step of scaling, and range of its result, relative to sizes that are equal by moments. */
#define SCALE_STEP  0.05
#define SCALE_LEAST 0.7
#define SCALE_MOST  1.4

/* Pairs beyond this multiple of the median distance do not count. */
#define OUTLIER 2.5

struct candidate {
    struct zr_rigid motion;
    double error;
};

struct aligning {
    const struct zr_run *run;
    const struct zr_surface_tree *a;
    const struct zr_solid *b;
    int unknowns; /* of a step: 3 of turning, 3 of shifting, and 1 of scaling if that is allowed */
    struct zr_surface_point *points[3]; /* COARSE, MEDIUM and FINE ones of b */
    uint32_t counts[3];
    struct zr_surface_hit *hits; /* per point */
    uint64_t *distances, *spare;
    uint64_t steps;
    struct candidate candidates[CANDIDATES];
    uint32_t count;
};

const char *const zr_align_words[4] = {"none", "bounds", "principal", "icp"};

static bool goes_on(const struct aligning *m)
{
    return m->steps <= ZR_ALIGN_STEPS && !zr_is_cancelled(m->run->cancel);
}

/* ---- distances ---- */

/* Finds the nearest places of moved points. Returns the root of the mean square distance. */
static double find_hits(struct aligning *m, int set, const struct zr_rigid *motion)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < m->counts[set] && goes_on(m); i++) {
        m->hits[i].triangle = i > 0 ? m->hits[i - 1].triangle : 0;
        zr_surface_tree_nearest(m->a, zr_rigid_apply(motion, m->points[set][i].at), -1.0, &m->hits[i], &m->steps);
        sum += m->hits[i].square;
        memcpy(&m->distances[i], &m->hits[i].square, sizeof m->hits[i].square);
    }
    return m->counts[set] > 0 ? sqrt(sum / (double)m->counts[set]) : 0.0;
}

/* Returns the squared distance beyond which pairs do not count. */
static double find_reach(struct aligning *m, int set)
{
    double median;
    zr_ray_sort(m->distances, m->counts[set], m->spare, m->run->cancel);
    memcpy(&median, &m->distances[m->counts[set] / 2], sizeof median);
    const double least = ROUNDING * m->a->solid->diagonal;
    return zr_most_of(OUTLIER * OUTLIER * median, least * least);
}

/* ---- point to plane ---- */

/* Solves a symmetric system by elimination; directions without weight get 0. */
static void solve(int count, double a[UNKNOWNS][UNKNOWNS + 1], double out[UNKNOWNS])
{
    double most = 0.0;
    for (int k = 0; k < count; k++)
        most = zr_most_of(most, a[k][k]);
    for (int k = 0; k < count; k++) {
        if (!(a[k][k] > 1e-10 * most)) {
            for (int c = 0; c <= count; c++)
                a[k][c] = 0.0;
            for (int r = 0; r < count; r++)
                a[r][k] = 0.0;
            a[k][k] = 1.0;
        }
        for (int r = k + 1; r < count; r++) {
            const double share = a[r][k] / a[k][k];
            for (int c = k; c <= count; c++)
                a[r][c] -= share * a[k][c];
        }
    }
    for (int k = count; k-- > 0;) {
        double rest = a[k][count];
        for (int c = k + 1; c < count; c++)
            rest -= a[k][c] * out[c];
        out[k] = rest / a[k][k];
    }
}

/* Adds a pair: the point p shall lie in the plane through `at` with the normal n. */
static void add_pair(struct zr_world_place p, struct zr_world_place at, struct zr_world_place n,
                     struct zr_world_place center, double size, int count, double system[UNKNOWNS][UNKNOWNS + 1])
{
    const struct zr_world_place arm = {(p.x - center.x) / size, (p.y - center.y) / size, (p.z - center.z) / size},
                                lever = zr_world_place_cross(arm, n);
    const double row[UNKNOWNS] = {lever.x, lever.y, lever.z, n.x, n.y, n.z, zr_world_place_dot(arm, n)},
                 gap = zr_world_place_dot(zr_world_place_minus(at, p), n) / size;
    for (int r = 0; r < count; r++) {
        for (int c = 0; c < count; c++)
            system[r][c] += row[r] * row[c];
        system[r][count] += row[r] * gap;
    }
}

/* Improves a motion by one round. Returns how far it moves, relative to the diagonal. */
static double improve(struct aligning *m, int set, bool takes_all, struct zr_rigid *motion)
{
    double system[UNKNOWNS][UNKNOWNS + 1] = {{0}}, step[UNKNOWNS] = {0};
    const struct zr_solid *solid = m->a->solid;
    const int count = set == 2 ? m->unknowns : UNKNOWNS - 1; /* smaller is nearer from a wrong place */
    const struct zr_world_place center = {0.5 * (solid->min[0] + solid->max[0]), 0.5 * (solid->min[1] + solid->max[1]),
                                          0.5 * (solid->min[2] + solid->max[2])};
    find_hits(m, set, motion);
    const double reach = takes_all ? HUGE_VAL : find_reach(m, set);
    for (uint32_t i = 0; i < m->counts[set] && goes_on(m); i++) {
        if (m->hits[i].square > reach) continue;
        add_pair(zr_rigid_apply(motion, m->points[set][i].at), m->hits[i].at,
                 zr_surface_normal(solid, m->hits[i].triangle), center, solid->diagonal, count, system);
    }
    if (!goes_on(m)) return 0.0;
    solve(count, system, step);
    const double shift[3] = {step[3] * solid->diagonal, step[4] * solid->diagonal, step[5] * solid->diagonal};
    const struct zr_rigid more = zr_rigid_of_step(center, step, shift);
    step[6] = zr_most_of(-SCALE_STEP, zr_least_of(step[6], SCALE_STEP));
    const struct zr_rigid scaling = zr_rigid_scaling(center, 1.0 + step[6]);
    *motion = zr_rigid_after(motion, &more);
    if (count == UNKNOWNS) *motion = zr_rigid_after(motion, &scaling);
    double moved = 0.0;
    for (int k = 0; k < UNKNOWNS; k++)
        moved = zr_most_of(moved, fabs(step[k]));
    return moved;
}

/* The first `rounds_of_all` rounds take distant pairs, too: they come from far. */
static void refine(struct aligning *m, int set, int rounds_of_all, struct candidate *candidate)
{
    for (int round = 0; round < (set == 2 ? FINE_ROUNDS : ROUNDS) && goes_on(m); round++)
        if (improve(m, set, round < rounds_of_all, &candidate->motion) < 1e-15) break;
    candidate->error = find_hits(m, set, &candidate->motion);
}

/* ---- candidates ---- */

static void add(struct aligning *m, const struct zr_rigid *motion)
{
    if (m->count == CANDIDATES || !goes_on(m)) return;
    m->candidates[m->count++] = (struct candidate){*motion, find_hits(m, 0, motion)};
}

/* Adds the motion that turns axes of b to those of a by `turn`, which is in the frame of the axes. */
static void add_turn(struct aligning *m, const struct zr_moments moments[2], double axes[2][3][3],
                     const double turn[3][3])
{
    struct zr_rigid motion = {.shift = {0, 0, 0}};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                for (int j = 0; j < 3; j++)
                    motion.turn[r][c] += axes[0][r][k] * turn[k][j] * axes[1][c][j];
    const struct zr_world_place at = zr_rigid_apply(&motion, moments[1].center);
    motion.shift[0] = moments[0].center.x - at.x;
    motion.shift[1] = moments[0].center.y - at.y;
    motion.shift[2] = moments[0].center.z - at.z;
    add(m, &motion);
}

/* Returns the determinant of a matrix. */
static double determinant(const double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Adds the turns, or the reflections, of a cube; `plain`: those that keep each axis. */
static void add_cube(struct aligning *m, const struct zr_moments moments[2], double axes[2][3][3], bool plain,
                     double sign)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
    for (int i = 0; i < (plain ? 1 : 6); i++)
        for (int signs = 0; signs < 8; signs++) {
            double turn[3][3] = {{0}};
            for (int k = 0; k < 3; k++)
                turn[k][orders[i][k]] = signs >> k & 1 ? -1.0 : 1.0;
            if (determinant((const double(*)[3])turn) * sign > 0.0)
                add_turn(m, moments, axes, (const double(*)[3])turn);
        }
}

/* Adds turns around an axis, both ways up. */
static void add_angles(struct aligning *m, const struct zr_moments moments[2], double axes[2][3][3], int axis,
                       double sign)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < ANGLES; i++)
        for (int up = 0; up < 2; up++) {
            double s, c, turn[3][3] = {{0}};
            zr_sine_cosine(360.0 * i / ANGLES, &s, &c);
            const double way = up ? 1.0 : -1.0, side = way * sign;
            turn[axis][axis] = way;
            turn[u][u] = c;
            turn[u][v] = -s * side;
            turn[v][u] = s;
            turn[v][v] = c * side;
            add_turn(m, moments, axes, (const double(*)[3])turn);
        }
}

/* Adds all turns that the moments allow; `sign` -1: reflections. */
static void add_principal(struct aligning *m, double sign)
{
    const struct zr_moments moments[2] = {zr_moments_of(m->a->solid, m->run->cancel),
                                          zr_moments_of(m->b, m->run->cancel)};
    double values[2][3], axes[2][3][3];
    for (int i = 0; i < 2; i++)
        zr_eigen_find((const double(*)[3])moments[i].second, values[i], axes[i]);
    const double most = values[0][2];
    const bool low = values[0][1] - values[0][0] < EQUAL * most, high = most - values[0][1] < EQUAL * most;
    if (low && high)
        add_cube(m, moments, axes, false, sign);
    else if (low || high)
        add_angles(m, moments, axes, low ? 2 : 0, sign);
    else
        add_cube(m, moments, axes, true, sign);
}

static void add_bounds(struct aligning *m)
{
    struct zr_rigid motion = zr_rigid_none();
    for (int k = 0; k < 3; k++)
        motion.shift[k] = 0.5 * ((m->a->solid->min[k] + m->a->solid->max[k]) - (m->b->min[k] + m->b->max[k]));
    add(m, &motion);
}

/* ---- choice ---- */

/* Sorts the candidates behind the first `kept` by their errors; equal ones keep their order. */
static void sort(struct aligning *m, uint32_t kept)
{
    for (uint32_t i = kept + 1; i < m->count; i++)
        for (uint32_t k = i; k > kept && m->candidates[k].error < m->candidates[k - 1].error; k--) {
            const struct candidate other = m->candidates[k];
            m->candidates[k] = m->candidates[k - 1];
            m->candidates[k - 1] = other;
        }
}

/* True if two motions differ by less than a degree and a thousandth of the diagonal. */
static bool is_near(const struct aligning *m, const struct zr_rigid *a, const struct zr_rigid *b)
{
    const struct zr_solid *solid = m->b;
    const struct zr_world_place middle = {0.5 * (solid->min[0] + solid->max[0]), 0.5 * (solid->min[1] + solid->max[1]),
                                          0.5 * (solid->min[2] + solid->max[2])};
    const struct zr_world_place way = zr_world_place_minus(zr_rigid_apply(a, middle), zr_rigid_apply(b, middle));
    double most = 0.0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            most = zr_most_of(most, fabs(a->turn[r][c] - b->turn[r][c]));
    return most < 0.017 && zr_world_place_dot(way, way) < 1e-6 * solid->diagonal * solid->diagonal;
}

/* Lists the other motions that are as good as the best one. */
static void list_ambiguous(const struct aligning *m, uint32_t count, double limit, struct zr_alignment *out)
{
    for (uint32_t i = 0; i < count && out->ambiguous_count < ZR_ALIGN_AMBIGUOUS_MAX; i++) {
        const struct candidate *c = &m->candidates[i];
        bool is_new = c->error <= limit && !is_near(m, &c->motion, &out->motion);
        for (uint32_t k = 0; k < out->ambiguous_count; k++)
            is_new = is_new && !is_near(m, &c->motion, &out->ambiguous[k]);
        if (is_new) out->ambiguous[out->ambiguous_count++] = c->motion;
    }
}

/* Refines the best candidates, and chooses one. Candidate 0 is the given place. `far`: number of the candidate that is
 * refined by distant pairs, too. */
static void choose(struct aligning *m, uint32_t far, struct zr_alignment *out)
{
    const double floor = ROUNDING * m->a->solid->diagonal;
    sort(m, 1);
    const uint32_t count = m->count < REFINED + 1 ? m->count : REFINED + 1;
    for (uint32_t i = 0; i < count; i++)
        refine(m, 1, i == far ? ROUNDS / 2 : 0, &m->candidates[i]);
    uint32_t best = 0;
    for (uint32_t i = 1; i < count; i++)
        if (m->candidates[i].error + floor < BETTER * (m->candidates[best].error + (best == 0 ? floor : 0.0))) best = i;
    struct candidate chosen = m->candidates[best];
    refine(m, 2, 0, &chosen);
    const double scale = zr_rigid_scale(&chosen.motion);
    if (scale < SCALE_LEAST || scale > SCALE_MOST) { /* it shrinks to a place of the surface, or away from it */
        chosen = m->candidates[best];
        chosen.error = find_hits(m, 2, &chosen.motion);
    }
    out->motion = chosen.motion;
    out->after = chosen.error;
    list_ambiguous(m, count, m->candidates[best].error / BETTER + floor, out);
}

/* Looks whether a reflection is much better. */
static void look_for_mirror(struct aligning *m, struct zr_alignment *out)
{
    if (out->after < 1e-3 * m->a->solid->diagonal) return;
    m->count = 0;
    add_principal(m, -1.0);
    sort(m, 0);
    for (uint32_t i = 0; i < m->count && i < 2; i++) {
        refine(m, 1, 0, &m->candidates[i]);
        if (m->candidates[i].error < 0.2 * out->after) out->is_mirrored = true;
    }
}

static void align(struct aligning *m, enum zr_align kind, struct zr_alignment *out)
{
    const struct zr_rigid none = zr_rigid_none();
    out->motion = none;
    out->before = out->after = find_hits(m, 2, &none);
    if (kind == ZR_ALIGN_BOUNDS) {
        add_bounds(m);
        if (m->count > 0) out->motion = m->candidates[0].motion;
        out->after = find_hits(m, 2, &out->motion);
    } else {
        add(m, &none);
        if (kind == ZR_ALIGN_PRINCIPAL)
            add_principal(m, 1.0);
        else
            add(m, &none);
        choose(m, kind == ZR_ALIGN_ICP ? 1 : UINT32_MAX, out);
        if (kind == ZR_ALIGN_PRINCIPAL) look_for_mirror(m, out);
    }
    if (m->steps > ZR_ALIGN_STEPS) *out = (struct zr_alignment){.motion = none, .is_omitted = true};
}

static bool make_room(struct aligning *m, struct zr_arena *scratch)
{
    static const uint32_t counts[3] = {COARSE, MEDIUM, FINE};
    for (int i = 0; i < 3; i++) {
        m->points[i] = zr_arena_alloc(scratch, counts[i], sizeof *m->points[i]);
        if (m->points[i]) m->counts[i] = zr_surface_points_place(m->b, m->run->cancel, counts[i], m->points[i]);
    }
    m->hits = zr_arena_zero(scratch, FINE, sizeof *m->hits);
    m->distances = zr_arena_alloc(scratch, FINE, sizeof *m->distances);
    m->spare = zr_arena_alloc(scratch, FINE, sizeof *m->spare);
    return zr_arena_ok(scratch);
}

enum zr_status zr_align_find(const struct zr_run *run, const struct zr_surface_tree *a, const struct zr_solid *b,
                             enum zr_align kind, bool can_scale, struct zr_alignment *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    struct aligning *m = zr_arena_zero(&scratch, 1, sizeof *m);
    *out = (struct zr_alignment){.motion = zr_rigid_none()};
    bool ok = m;
    if (m) {
        m->run = run;
        m->a = a;
        m->b = b;
        m->unknowns = can_scale && kind != ZR_ALIGN_BOUNDS ? UNKNOWNS : UNKNOWNS - 1;
        ok = make_room(m, &scratch);
        if (ok && kind != ZR_ALIGN_NONE && a->leaf_count > 0 && b->count > 0) align(m, kind, out);
    }
    zr_arena_close_scratch(&scratch, run->arena);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ok ? ZR_OK : ZR_NO_MEMORY;
}

static double trace_of(const struct zr_moments *moments)
{
    return moments->second[0][0] + moments->second[1][1] + moments->second[2][2];
}

struct zr_rigid zr_align_size(const struct zr_solid *a, const struct zr_solid *b, enum zr_align kind,
                              const struct zr_cancel *cancel)
{
    const struct zr_moments first = zr_moments_of(a, cancel), second = zr_moments_of(b, cancel);
    const double ratio =
        kind == ZR_ALIGN_BOUNDS ? a->diagonal / b->diagonal : sqrt(trace_of(&first) / trace_of(&second));
    return zr_rigid_scaling(second.center, ratio > 0.0 && ratio < HUGE_VAL ? ratio : 1.0);
}

static bool is_due(const struct zr_cancel *cancel, uint32_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel);
}

void zr_align_move(struct zr_solid *solid, const struct zr_rigid *motion, const struct zr_cancel *cancel)
{
    const double scale = zr_rigid_scale(motion);
    if (scale != 1.0) {
        solid->diagonal *= scale;
        solid->area *= scale * scale;
        solid->volume *= scale * scale * scale;
    }
    for (uint32_t i = 0; i < solid->place_count && !is_due(cancel, i); i++)
        solid->places[i] = zr_rigid_apply(motion, solid->places[i]);
    for (uint32_t t = 0; t < solid->count && !is_due(cancel, t); t++)
        for (int i = 0; i < 3; i++) {
            const struct zr_world_place p = solid->places[solid->corners[t][i]];
            const double at[3] = {p.x, p.y, p.z};
            for (int k = 0; k < 3; k++) {
                const bool is_first = t == 0 && i == 0;
                solid->min[k] = is_first ? at[k] : zr_least_of(solid->min[k], at[k]);
                solid->max[k] = is_first ? at[k] : zr_most_of(solid->max[k], at[k]);
            }
        }
}
