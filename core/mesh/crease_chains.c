#include "mesh/crease_chains.h"

enum { CHAIN_EDGES = 12, LINKS_MOST = 32, ITEMS_PER_CANCEL_CHECK = 1 << 12 };

#define SMALL_CHAIN 0.05f       /* of D */
#define TURN_COSINE 0.76604444f /* of 40 degrees */

/* Sums of a chain, at the number of its first edge. */
struct chain {
    float length;
    uint32_t edges;
    bool is_ring;
};

static bool is_due(const struct zr_cancel *cancel, uint32_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel);
}

/* ---- lists of vertices ---- */

static bool list_ends(struct zr_arena *arena, const struct zr_cancel *cancel, struct zr_steep_edges *edges)
{
    uint32_t *starts = zr_arena_zero(arena, (size_t)edges->vertex_count + 1, sizeof *starts);
    uint32_t *listed = zr_arena_alloc(arena, edges->count, 2 * sizeof *listed);
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t i = 0; i < 2 * edges->count; i++)
        starts[edges->of[i / 2].ends[i % 2]]++;
    for (uint32_t v = 0, sum = 0; v <= edges->vertex_count; v++)
        starts[v] = sum += starts[v];
    for (uint32_t i = 2 * edges->count; i-- > 0 && !is_due(cancel, i);)
        listed[--starts[edges->of[i / 2].ends[i % 2]]] = i;
    edges->starts = starts;
    edges->listed = listed;
    return true;
}

/* ---- chains: a forest whose roots are the lowest edges ---- */

static uint32_t root_of(struct zr_steep_edge *edges, uint32_t i)
{
    while (edges[i].chain != i)
        i = edges[i].chain = edges[edges[i].chain].chain;
    return i;
}

/* Joins the chains of two edges. A chain that is joined to itself is a ring. */
static void join(struct zr_steep_edge *edges, uint32_t a, uint32_t b)
{
    const uint32_t first = root_of(edges, a), second = root_of(edges, b);
    if (first == second) edges[a].closes_ring = true;
    edges[first < second ? second : first].chain = first < second ? first : second;
}

/* Returns the direction from an end into its edge. */
static zr_vec3 direction_of(const struct zr_steep_edge *edges, const zr_vec4 *positions, uint32_t end)
{
    const struct zr_steep_edge *edge = &edges[end / 2];
    const zr_vec4 from = positions[edge->positions[end % 2]], to = positions[edge->positions[1 - end % 2]];
    return zr_vec3_normalize((zr_vec3){to.x - from.x, to.y - from.y, to.z - from.z});
}

/* Returns the number of the direction that goes on most straightly behind direction i; `count`: none. */
static uint32_t straightest(const zr_vec3 *directions, uint32_t count, uint32_t i)
{
    float most = TURN_COSINE;
    uint32_t best = count;
    for (uint32_t j = 0; j < count; j++) {
        const float cosine = -zr_vec3_dot(directions[i], directions[j]);
        if (j == i || !(cosine > most)) continue;
        most = cosine;
        best = j;
    }
    return best;
}

static void link_at(struct zr_steep_edge *edges, const zr_vec4 *positions, const uint32_t *ends, uint32_t count)
{
    zr_vec3 directions[LINKS_MOST];
    uint32_t best[LINKS_MOST + 1] = {0};
    if (count < 2 || count > LINKS_MOST) return;
    for (uint32_t i = 0; i < count; i++)
        directions[i] = direction_of(edges, positions, ends[i]);
    for (uint32_t i = 0; i < count; i++)
        best[i] = straightest(directions, count, i);
    for (uint32_t i = 0; i < count; i++)
        if (best[i] < count && best[i] > i && best[best[i]] == i) join(edges, ends[i] / 2, ends[best[i]] / 2);
}

static void judge(struct zr_steep_edges *edges, struct chain *chains, float diagonal)
{
    for (uint32_t i = 0; i < edges->count; i++) {
        struct chain *chain = &chains[root_of(edges->of, i)];
        chain->length += edges->of[i].length;
        chain->edges++;
        chain->is_ring |= edges->of[i].closes_ring;
    }
    for (uint32_t i = 0; i < edges->count; i++) {
        struct zr_steep_edge *edge = &edges->of[i];
        const struct chain *chain = &chains[root_of(edges->of, i)];
        edge->is_crease = !(edge->has_gentle_face && edge->length < ZR_SMALL_EDGE * diagonal &&
                            chain->length < SMALL_CHAIN * diagonal && chain->edges < CHAIN_EDGES && !chain->is_ring);
    }
}

bool zr_crease_chains_find(struct zr_arena *arena, const struct zr_cancel *cancel, const zr_vec4 *positions,
                           float diagonal, struct zr_steep_edges *edges)
{
    struct chain *chains = zr_arena_zero(arena, edges->count, sizeof *chains);
    if (!chains || !list_ends(arena, cancel, edges)) return false;
    if (zr_is_cancelled(cancel)) return true;
    for (uint32_t i = 0; i < edges->count; i++)
        edges->of[i].chain = i;
    for (uint32_t v = 0; v < edges->vertex_count && !is_due(cancel, v); v++)
        link_at(edges->of, positions, edges->listed + edges->starts[v], edges->starts[v + 1] - edges->starts[v]);
    if (!zr_is_cancelled(cancel)) judge(edges, chains, diagonal);
    return true;
}
