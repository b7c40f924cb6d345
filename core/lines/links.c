#include "lines/links.h"

enum { ENDS_PER_CANCEL_CHECK = 1 << 12 };

/* Ends are nodes within 1/32 pixel; the grid has cells of twice that. */
static const double reach = ZR_NODE_PIXELS, cell_pixels = 2.0 * ZR_NODE_PIXELS;

/* Cosine of 80 degrees. */
static const double turn_cosine = 0.17364817766693041;

struct linking {
    const struct zr_segment *segments;
    const struct zr_cancel *cancel;
    uint32_t end_count;
    uint32_t slot_count; /* of the hash table, a power of two */
    uint32_t *slots;     /* first node of each chain, plus 1 */
    uint32_t *nexts;     /* by node: the next one in its chain, plus 1 */
    uint32_t *firsts;    /* by node: its first end */
    uint32_t *nodes;     /* by end */
    uint32_t node_count;
    uint32_t *begins; /* by node, and one more: its ends in `listed` */
    uint32_t *listed;
    uint32_t *ends;
};

static const struct zr_window_point *point_of(const struct linking *l, uint32_t end)
{
    return &l->segments[end / 2].ends[end % 2];
}

/* ---- nodes ---- */

static uint32_t hash_of(const struct linking *l, int64_t x, int64_t y)
{
    uint64_t h = (uint64_t)x * 0x9e3779b97f4a7c15u ^ (uint64_t)y * 0xc2b2ae3d27d4eb4fu;
    h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
    return (uint32_t)(h >> 32) & (l->slot_count - 1);
}

/* Returns the lowest node of a cell that is near the point; ZR_NO_END if there is none. */
static uint32_t find_in_cell(const struct linking *l, const struct zr_window_point *p, int64_t x, int64_t y)
{
    uint32_t found = ZR_NO_END;
    for (uint32_t n = l->slots[hash_of(l, x, y)]; n != 0; n = l->nexts[n - 1]) {
        const struct zr_window_point *q = point_of(l, l->firsts[n - 1]);
        const double dx = q->x - p->x, dy = q->y - p->y;
        if (dx * dx + dy * dy <= reach * reach && n - 1 < found) found = n - 1;
    }
    return found;
}

static uint32_t find_node(const struct linking *l, const struct zr_window_point *p, int64_t x, int64_t y)
{
    uint32_t found = ZR_NO_END;
    for (int64_t dy = -1; dy <= 1; dy++)
        for (int64_t dx = -1; dx <= 1; dx++) {
            const uint32_t node = find_in_cell(l, p, x + dx, y + dy);
            if (node < found) found = node;
        }
    return found;
}

static void make_nodes(struct linking *l)
{
    for (uint32_t end = 0; end < l->end_count; end++) {
        if (end % ENDS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(l->cancel)) return;
        const struct zr_window_point *p = point_of(l, end);
        const int64_t x = (int64_t)floor(p->x / cell_pixels), y = (int64_t)floor(p->y / cell_pixels);
        uint32_t node = find_node(l, p, x, y);
        if (node == ZR_NO_END) {
            uint32_t *slot = &l->slots[hash_of(l, x, y)];
            node = l->node_count++;
            l->firsts[node] = end;
            l->nexts[node] = *slot;
            *slot = node + 1;
        }
        l->nodes[end] = node;
        l->begins[node]++;
    }
    for (uint32_t n = 0, sum = 0; n <= l->node_count; n++)
        l->begins[n] = sum += n < l->node_count ? l->begins[n] : 0;
    for (uint32_t end = l->end_count; end-- > 0;)
        l->listed[--l->begins[l->nodes[end]]] = end;
}

/* ---- links of a node ---- */

/* Writes the unit vector from an end into its segment; 0 for one without length. */
static void direction_of(const struct linking *l, uint32_t end, double out[2])
{
    const struct zr_window_point *p = point_of(l, end), *q = point_of(l, end ^ 1u);
    const double x = q->x - p->x, y = q->y - p->y, length = sqrt(x * x + y * y);
    out[0] = length > 0.0 ? x / length : 0.0;
    out[1] = length > 0.0 ? y / length : 0.0;
}

static uint32_t class_of(const struct linking *l, uint32_t end)
{
    return l->segments[end / 2].class;
}

static bool may_link(const struct linking *l, uint32_t a, uint32_t b)
{
    return a / 2 != b / 2 && class_of(l, a) == class_of(l, b) && l->ends[a] == ZR_NO_END && l->ends[b] == ZR_NO_END;
}

static void link_ends(struct linking *l, uint32_t a, uint32_t b)
{
    l->ends[a] = b;
    l->ends[b] = a;
}

/* Links the straightest pair that is still free. False if there is none. */
static bool link_straightest(struct linking *l, const uint32_t *ends, const double (*directions)[2], uint32_t count)
{
    double least = -turn_cosine;
    uint32_t a = ZR_NO_END, b = ZR_NO_END;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++) {
            const double cosine = directions[i][0] * directions[k][0] + directions[i][1] * directions[k][1];
            if (cosine > least || !may_link(l, ends[i], ends[k]) || (a != ZR_NO_END && cosine == least)) continue;
            least = cosine;
            a = ends[i];
            b = ends[k];
        }
    if (a != ZR_NO_END) link_ends(l, a, b);
    return a != ZR_NO_END;
}

/* Links the two ends of a class that has no others at the node. */
static void link_only_two(struct linking *l, const uint32_t *ends, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t others = 0, other = ZR_NO_END;
        for (uint32_t k = 0; k < count; k++)
            if (k != i && class_of(l, ends[k]) == class_of(l, ends[i])) {
                others++;
                other = ends[k];
            }
        if (others == 1 && may_link(l, ends[i], other)) link_ends(l, ends[i], other);
    }
}

static void link_nodes(struct linking *l)
{
    for (uint32_t n = 0; n < l->node_count; n++) {
        const uint32_t *ends = l->listed + l->begins[n], count = l->begins[n + 1] - l->begins[n];
        double directions[ZR_NODE_ENDS_MOST][2];
        if (n % ENDS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(l->cancel)) return;
        if (count < 2 || count > ZR_NODE_ENDS_MOST) continue;
        for (uint32_t i = 0; i < count; i++)
            direction_of(l, ends[i], directions[i]);
        while (link_straightest(l, ends, (const double(*)[2])directions, count))
            ;
        link_only_two(l, ends, count);
    }
}

/* ---- all steps ---- */

enum zr_status zr_links_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_segment *segments,
                             uint32_t count, struct zr_links *out)
{
    struct linking l = {.segments = segments, .cancel = cancel, .end_count = 2 * count, .slot_count = 64};
    if (count > UINT32_MAX / 4) return ZR_NO_MEMORY;
    while (l.slot_count < l.end_count)
        l.slot_count *= 2;
    l.slots = zr_arena_zero(arena, l.slot_count, sizeof *l.slots);
    l.nexts = zr_arena_alloc(arena, l.end_count, sizeof *l.nexts);
    l.firsts = zr_arena_alloc(arena, l.end_count, sizeof *l.firsts);
    l.nodes = zr_arena_alloc(arena, l.end_count, sizeof *l.nodes);
    l.begins = zr_arena_zero(arena, (size_t)l.end_count + 1, sizeof *l.begins);
    l.listed = zr_arena_alloc(arena, l.end_count, sizeof *l.listed);
    l.ends = zr_arena_alloc(arena, l.end_count, sizeof *l.ends);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    for (uint32_t end = 0; end < l.end_count; end++)
        l.ends[end] = ZR_NO_END;
    make_nodes(&l);
    if (!zr_is_cancelled(cancel)) link_nodes(&l);
    *out = (struct zr_links){.nodes = l.nodes, .node_count = l.node_count, .ends = l.ends};
    return zr_is_cancelled(cancel) ? ZR_CANCELLED : ZR_OK;
}

uint32_t zr_links_first(const struct zr_links *links, uint32_t segment)
{
    uint32_t end = 2 * segment;
    for (;;) {
        const uint32_t before = links->ends[end];
        if (before == ZR_NO_END) return end;
        if (before / 2 == segment) return 2 * segment;
        end = before ^ 1u;
    }
}
