#include "lines/chains.h"

#include "base/cancel.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 14, ROUNDS = 8, SHORT_CHAIN = 2 };
enum { CREASE = ZR_FEATURE_WEAK | ZR_FEATURE_STRONG | ZR_FEATURE_CONVEX | ZR_FEATURE_MORE };

#define NO_LINK UINT32_MAX

/* Creases of this share of the diagonal stay lines in any window: they are edges of parts, and no noise of scans. */
static const double long_share = 1.0 / 64.0;

/* Cosine of a tenth of a degree: between the triangles of a plane. */
static const float flat_cosine = 0.99999848f;

/* Cosine of 50 degrees. */
static const double turn_cosine = 0.64278760968653933;

/* A crease. End 0 is its lower vertex. The end k of crease c has the number 2 c + k. */
struct crease {
    uint32_t edge, vertices[2]; /* of all instances */
    uint32_t links[2];          /* number of the end that each end goes on at */
    uint8_t features;
    bool is_seen, is_kept;
    bool is_of_plane; /* beside it is a plane of several triangles */
};

struct chaining {
    const struct zr_window_mesh *mesh;
    const struct zr_cancel *cancel;
    const struct zr_drawn_instance *of; /* of the edge that is looked at */
    uint8_t *features;
    uint32_t count;
    struct crease *creases;
    uint32_t *ends;    /* by vertex, and one more: end of its list; then its begin */
    uint32_t *listed;  /* numbers of ends, by vertex */
    bool *is_touched;  /* by vertex: a line that stays ends there */
    uint32_t *borders; /* by vertex: borders that end there */
};

static bool is_due(const struct chaining *c, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(c->cancel);
}

/* ---- lists of vertices ---- */

/* Calls for each edge with one of the bits. */
static void each_edge(struct chaining *c, unsigned bits, void (*use)(struct chaining *, uint32_t, const uint32_t *))
{
    for (uint32_t i = 0; i < c->mesh->instance_count; i++) {
        const struct zr_drawn_instance *of = &c->mesh->instances[i];
        for (uint32_t e = 0; e < of->table->edge_count; e++) {
            if (is_due(c, e)) return;
            if (!(c->features[of->first_edge + e] & bits)) continue;
            const struct zr_mesh_edge *edge = &of->table->edges[e];
            c->of = of;
            use(c, of->first_edge + e,
                (const uint32_t[2]){of->first_vertex + edge->low, of->first_vertex + edge->high});
        }
    }
}

static void count_crease(struct chaining *c, uint32_t edge, const uint32_t vertices[2])
{
    (void)edge;
    c->count++;
    c->ends[vertices[0]]++;
    c->ends[vertices[1]]++;
}

/* True if another edge of a triangle leads to one of the same plane. */
static bool is_in_plane(const struct chaining *c, uint32_t triangle, uint32_t edge)
{
    const struct zr_edge_mesh *table = c->of->table;
    const float(*normals)[3] = c->mesh->normals + c->of->first_triangle, *a = normals[triangle];
    for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; side++) {
        const uint32_t other = table->side_edges[side];
        if (other == edge || zr_edge_side_count(table, other) != 2) continue;
        const uint32_t *sides = table->sides + table->edges[other].first_side;
        const float *b = normals[sides[sides[0] == side] / 3];
        if (fabsf((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) >= flat_cosine) return true;
    }
    return false;
}

static bool is_of_plane(const struct chaining *c, uint32_t edge)
{
    const struct zr_edge_mesh *table = c->of->table;
    const uint32_t *sides = table->sides + table->edges[edge].first_side, count = zr_edge_side_count(table, edge);
    return count == 2 && (is_in_plane(c, sides[0] / 3, edge) || is_in_plane(c, sides[1] / 3, edge));
}

static void add_crease(struct chaining *c, uint32_t edge, const uint32_t vertices[2])
{
    c->creases[c->count++] = (struct crease){.edge = edge,
                                             .vertices = {vertices[0], vertices[1]},
                                             .links = {NO_LINK, NO_LINK},
                                             .features = c->features[edge],
                                             .is_of_plane = is_of_plane(c, edge - c->of->first_edge)};
}

static void touch(struct chaining *c, uint32_t edge, const uint32_t vertices[2])
{
    (void)edge;
    c->is_touched[vertices[0]] = c->is_touched[vertices[1]] = true;
    c->borders[vertices[0]]++;
    c->borders[vertices[1]]++;
}

static bool list_creases(struct zr_arena *arena, struct chaining *c)
{
    c->ends = zr_arena_zero(arena, (size_t)c->mesh->vertex_count + 1, sizeof *c->ends);
    c->is_touched = zr_arena_zero(arena, c->mesh->vertex_count, sizeof *c->is_touched);
    c->borders = zr_arena_zero(arena, c->mesh->vertex_count, sizeof *c->borders);
    if (!zr_arena_ok(arena)) return false;
    each_edge(c, ZR_FEATURE_WEAK, count_crease);
    c->creases = zr_arena_alloc(arena, c->count, sizeof *c->creases);
    c->listed = zr_arena_alloc(arena, c->count, 2 * sizeof *c->listed);
    if (!zr_arena_ok(arena) || zr_is_cancelled(c->cancel)) return false;
    c->count = 0;
    each_edge(c, ZR_FEATURE_WEAK, add_crease);
    each_edge(c, ZR_FEATURE_BORDER, touch);
    for (uint32_t v = 0, sum = 0; v <= c->mesh->vertex_count; v++)
        c->ends[v] = sum += c->ends[v];
    for (uint32_t i = 2 * c->count; i-- > 0;)
        c->listed[--c->ends[c->creases[i / 2].vertices[i % 2]]] = i;
    return !zr_is_cancelled(c->cancel);
}

/* ---- links ---- */

/* Writes the unit vector away from the end into the crease; 0 if the crease has no length. */
static void direction_of(const struct chaining *c, uint32_t end, double out[3])
{
    const struct crease *crease = &c->creases[end / 2];
    const double *from = c->mesh->eyes[crease->vertices[end % 2]], *to = c->mesh->eyes[crease->vertices[1 - end % 2]];
    for (int k = 0; k < 3; k++)
        out[k] = to[k] - from[k];
    const double length = sqrt((out[0] * out[0] + out[1] * out[1]) + out[2] * out[2]);
    for (int k = 0; k < 3; k++)
        out[k] = length > 0.0 ? out[k] / length : 0.0;
}

static bool may_link(const struct chaining *c, uint32_t a, uint32_t b)
{
    const unsigned kind = ZR_FEATURE_CONVEX | ZR_FEATURE_MORE;
    const struct crease *first = &c->creases[a / 2], *second = &c->creases[b / 2];
    return first->links[a % 2] == NO_LINK && second->links[b % 2] == NO_LINK &&
           (first->features & kind) == (second->features & kind);
}

/* Links the straightest pair of the ends at a vertex that are still free. False if there is none. */
static bool link_pair(struct chaining *c, const uint32_t *ends, const double (*directions)[3], uint32_t count)
{
    double least = -turn_cosine;
    uint32_t best[2] = {NO_LINK, NO_LINK};
    for (uint32_t a = 0; a < count; a++)
        for (uint32_t b = a + 1; b < count; b++) {
            const double *u = directions[a], *v = directions[b];
            const double cosine = (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2];
            if (cosine > least || !may_link(c, ends[a], ends[b])) continue;
            if (best[0] != NO_LINK && cosine == least) continue;
            least = cosine;
            best[0] = ends[a];
            best[1] = ends[b];
        }
    if (best[0] == NO_LINK) return false;
    c->creases[best[0] / 2].links[best[0] % 2] = best[1];
    c->creases[best[1] / 2].links[best[1] % 2] = best[0];
    return true;
}

static void link_creases(struct chaining *c)
{
    for (uint32_t v = 0; v < c->mesh->vertex_count && !is_due(c, v); v++) {
        const uint32_t *ends = c->listed + c->ends[v], count = c->ends[v + 1] - c->ends[v];
        double directions[ZR_CHAIN_LINKS_MOST][3];
        if (count < 2 || count > ZR_CHAIN_LINKS_MOST) continue;
        for (uint32_t i = 0; i < count; i++)
            direction_of(c, ends[i], directions[i]);
        while (link_pair(c, ends, (const double(*)[3])directions, count))
            ;
    }
}

/* ---- chains ---- */

struct chain {
    double length;               /* pixels */
    uint32_t count, first, last; /* ends of the chain, by their numbers */
    bool is_strong, is_long;
    bool has_skin; /* some crease is beside no plane */
};

/* Returns the length in the window. A crease that crosses the near or far plane counts as long. */
static double length_of(const struct chaining *c, const struct crease *crease)
{
    if (c->mesh->outside[crease->vertices[0]] | c->mesh->outside[crease->vertices[1]]) return ZR_CHAIN_WEAK_PIXELS;
    const struct zr_window_point *a = &c->mesh->points[crease->vertices[0]], *b = &c->mesh->points[crease->vertices[1]];
    const double x = b->x - a->x, y = b->y - a->y;
    return sqrt(x * x + y * y);
}

static bool is_long(const struct chaining *c, const struct crease *crease)
{
    const double *a = c->mesh->eyes[crease->vertices[0]], *b = c->mesh->eyes[crease->vertices[1]];
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], least = long_share * c->mesh->view.diagonal;
    return (x * x + y * y) + z * z >= least * least;
}

/* Walks from an end into its crease and on, and calls for each crease. Returns the last end; in a ring, the one before
 * the first. */
static uint32_t walk(struct chaining *c, uint32_t end, struct chain *chain, bool keep)
{
    const uint32_t first = end;
    for (;;) {
        struct crease *crease = &c->creases[end / 2];
        crease->is_seen = true;
        crease->is_kept = crease->is_kept || keep;
        chain->count++;
        chain->length += length_of(c, crease);
        chain->is_strong = chain->is_strong || crease->features & ZR_FEATURE_STRONG;
        chain->is_long = chain->is_long || is_long(c, crease);
        chain->has_skin = chain->has_skin || !crease->is_of_plane;
        const uint32_t other = end ^ 1u, next = crease->links[other % 2];
        if (next == NO_LINK || next == first) return other;
        end = next;
    }
}

static void drop_chain(struct chaining *c, uint32_t end)
{
    const uint32_t first = end;
    for (;;) {
        c->creases[end / 2].is_kept = false;
        const uint32_t next = c->creases[end / 2].links[1 - end % 2];
        if (next == NO_LINK || next == first) return;
        end = next;
    }
}

/* Returns the first end of the chain of a crease; any end of a ring. */
static uint32_t first_end(const struct chaining *c, uint32_t crease)
{
    uint32_t end = 2 * crease;
    for (uint32_t steps = 0; steps < c->count; steps++) {
        const uint32_t before = c->creases[end / 2].links[end % 2];
        if (before == NO_LINK || before / 2 == crease) return end;
        end = before ^ 1u;
    }
    return end;
}

static void touch_chain(struct chaining *c, uint32_t end)
{
    const uint32_t first = end;
    for (;;) {
        const struct crease *crease = &c->creases[end / 2];
        c->is_touched[crease->vertices[0]] = c->is_touched[crease->vertices[1]] = true;
        const uint32_t next = crease->links[1 - end % 2];
        if (next == NO_LINK || next == first) return;
        end = next;
    }
}

/* Judges all chains. Lists the short strong ones that are not kept, by their first ends; returns their number. */
static uint32_t judge(struct chaining *c, uint32_t *doubtful)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->count && !is_due(c, i); i++) {
        if (c->creases[i].is_seen) continue;
        const uint32_t first = first_end(c, i);
        struct chain chain = {0}, again = {0};
        walk(c, first, &chain, false);
        const bool is_kept = chain.is_long || (chain.is_strong && chain.length >= ZR_CHAIN_STRONG_PIXELS) ||
                             chain.length >= ZR_CHAIN_WEAK_PIXELS;
        if (is_kept) {
            walk(c, first, &again, true);
            touch_chain(c, first);
        } else if (chain.is_strong && chain.count <= SHORT_CHAIN) {
            doubtful[count++] = first;
        }
    }
    return count;
}

static uint32_t vertex_of(const struct chaining *c, uint32_t end)
{
    return c->creases[end / 2].vertices[end % 2];
}

/* Keeps the doubtful chains between lines that stay. Returns the number of those that remain. */
static uint32_t keep_between(struct chaining *c, uint32_t *doubtful, uint32_t count)
{
    uint32_t left = 0, kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct chain chain = {0};
        const uint32_t first = doubtful[i], last = walk(c, first, &chain, false);
        if (c->is_touched[vertex_of(c, first)] && c->is_touched[vertex_of(c, last)]) {
            walk(c, first, &chain, true);
            kept++;
        } else {
            doubtful[left++] = first;
        }
    }
    for (uint32_t i = 0; kept > 0 && i < c->count; i++)
        if (c->creases[i].is_kept)
            c->is_touched[c->creases[i].vertices[0]] = c->is_touched[c->creases[i].vertices[1]] = true;
    return kept > 0 ? left : 0;
}

/* ---- free ends ---- */

/* Counts the ends of borders and of creases that stay, by vertex. */
static void count_ends(const struct chaining *c, uint32_t *counts)
{
    memcpy(counts, c->borders, c->mesh->vertex_count * sizeof *counts);
    for (uint32_t i = 0; i < c->count; i++) {
        if (!c->creases[i].is_kept) continue;
        counts[c->creases[i].vertices[0]]++;
        counts[c->creases[i].vertices[1]]++;
    }
}

/* True if a chain ends in smooth skin: a weak one at an end, a strong one at both. */
static bool is_free(struct chaining *c, uint32_t first, const uint32_t *counts)
{
    struct chain chain = {0};
    const uint32_t last = walk(c, first, &chain, false);
    if (c->creases[first / 2].links[first % 2] != NO_LINK || !chain.has_skin) return false; /* a ring, or of planes */
    const bool begins = counts[vertex_of(c, first)] == 1, ends = counts[vertex_of(c, last)] == 1;
    return chain.is_strong ? begins && ends : begins || ends;
}

/* Drops the chains that are free. Returns their number. */
static uint32_t drop_free(struct chaining *c, const uint32_t *counts)
{
    uint32_t dropped = 0;
    for (uint32_t i = 0; i < c->count; i++)
        c->creases[i].is_seen = false;
    for (uint32_t i = 0; i < c->count && !is_due(c, i); i++) {
        if (c->creases[i].is_seen || !c->creases[i].is_kept) continue;
        const uint32_t first = first_end(c, i);
        if (!is_free(c, first, counts)) continue;
        drop_chain(c, first);
        dropped++;
    }
    return dropped;
}

enum zr_status zr_chains_keep(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_window_mesh *mesh,
                              uint8_t *features)
{
    struct chaining c = {.mesh = mesh, .cancel = cancel, .features = features};
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    if (list_creases(&scratch, &c)) {
        uint32_t *doubtful = zr_arena_alloc(&scratch, c.count, sizeof *doubtful);
        uint32_t *counts = zr_arena_alloc(&scratch, mesh->vertex_count, sizeof *counts);
        link_creases(&c);
        uint32_t count = doubtful ? judge(&c, doubtful) : 0;
        for (int round = 0; round < ROUNDS && count > 0 && !zr_is_cancelled(cancel); round++)
            count = keep_between(&c, doubtful, count);
        for (int round = 0; counts && round < ROUNDS && !zr_is_cancelled(cancel); round++) {
            count_ends(&c, counts);
            if (drop_free(&c, counts) == 0) break;
        }
        for (uint32_t i = 0; i < c.count; i++)
            if (!c.creases[i].is_kept) features[c.creases[i].edge] &= (uint8_t)~CREASE;
    }
    zr_arena_close_scratch(&scratch, arena);
    return zr_is_cancelled(cancel) ? ZR_CANCELLED : zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}
