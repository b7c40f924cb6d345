/* Orders of the values of Draco meshes: walks over the faces, depth first or by the degree of prediction (Cohen-Or and
 * others, Multi-way geometry encoding, 2002). */
#include "input/codecs/draco_mesh.h"

enum { PRIORITIES = 3 };

/* Corners that the walk will visit; the last one is next. */
struct stack {
    uint32_t count, *corners;
};

struct walk {
    struct zr_draco *draco;
    const struct zr_draco_corners *of;
    struct zr_draco_order *out;
    bool *is_visited; /* per face */
    struct stack stacks[PRIORITIES];
    uint32_t best;    /* no stack before it has corners */
    uint8_t *degrees; /* per vertex: 0, or 1 if a face predicts it */
};

static inline bool is_visited(const struct walk *walk, uint32_t corner)
{
    return corner == ZR_DRACO_NONE || walk->is_visited[corner / 3];
}

/* Adds the vertex of a corner to the order, unless it is there. Returns true if it is new. */
static inline bool reach(struct walk *walk, uint32_t corner)
{
    uint32_t *value = &walk->out->values[walk->of->vertices[corner]];
    if (*value != ZR_DRACO_NONE) return false;
    *value = walk->out->count;
    walk->out->corners[walk->out->count++] = corner;
    return true;
}

static inline void push(struct stack *stack, uint32_t corner)
{
    stack->corners[stack->count++] = corner;
}

static inline uint32_t left_of(const struct walk *walk, uint32_t corner)
{
    return walk->of->opposites[zr_draco_previous(corner)];
}

static inline uint32_t right_of(const struct walk *walk, uint32_t corner)
{
    return walk->of->opposites[zr_draco_next(corner)];
}

/* ---- depth first ---- */

/* Visits faces from a corner until no neighbour is left. At a choice, the left one goes to the stack. False if
 * cancelled.
 */
static bool follow(struct walk *walk, uint32_t corner)
{
    while (!is_visited(walk, corner)) {
        if (zr_draco_stops(walk->draco)) return false;
        walk->is_visited[corner / 3] = true;
        const uint32_t right = right_of(walk, corner), left = left_of(walk, corner);
        const uint32_t vertex = walk->of->vertices[corner];
        const bool is_inner = reach(walk, corner) && zr_draco_left(walk->of, walk->of->first[vertex]) != ZR_DRACO_NONE;
        if (is_inner || is_visited(walk, left)) {
            corner = right;
        } else if (is_visited(walk, right)) {
            corner = left;
        } else {
            push(&walk->stacks[0], left);
            corner = right;
        }
    }
    return true;
}

static bool walk_depth_first(struct walk *walk)
{
    struct stack *stack = &walk->stacks[0];
    for (uint32_t start = 0; start < walk->of->corner_count; start += 3) {
        if (zr_draco_stops(walk->draco)) return false;
        if (walk->is_visited[start / 3]) continue;
        reach(walk, start + 1);
        reach(walk, start + 2);
        push(stack, start);
        while (stack->count > 0)
            if (!follow(walk, stack->corners[--stack->count])) return false;
    }
    return true;
}

/* ---- by degree ---- */

/* Returns 0 for a reached vertex, 1 for one with two faces or more that predict it, else 2. */
static uint32_t find_priority(struct walk *walk, uint32_t corner)
{
    const uint32_t vertex = walk->of->vertices[corner];
    if (walk->out->values[vertex] != ZR_DRACO_NONE) return 0;
    if (walk->degrees[vertex] > 0) return 1;
    walk->degrees[vertex] = 1;
    return 2;
}

static void push_by(struct walk *walk, uint32_t corner, uint32_t priority)
{
    push(&walk->stacks[priority], corner);
    if (priority < walk->best) walk->best = priority;
}

/* Visits a face. Returns the corner that is next for sure, or NONE. */
static uint32_t visit(struct walk *walk, uint32_t corner)
{
    const uint32_t right = right_of(walk, corner), left = left_of(walk, corner);
    walk->is_visited[corner / 3] = true;
    reach(walk, corner);
    const bool is_right_visited = is_visited(walk, right);
    if (!is_visited(walk, left)) {
        const uint32_t priority = find_priority(walk, left);
        if (is_right_visited && priority <= walk->best) return left;
        push_by(walk, left, priority);
    }
    if (!is_right_visited) {
        const uint32_t priority = find_priority(walk, right);
        if (priority <= walk->best) return right;
        push_by(walk, right, priority);
    }
    return ZR_DRACO_NONE;
}

static uint32_t pop(struct walk *walk)
{
    for (uint32_t i = walk->best; i < PRIORITIES; i++)
        if (walk->stacks[i].count > 0) {
            walk->best = i;
            return walk->stacks[i].corners[--walk->stacks[i].count];
        }
    return ZR_DRACO_NONE;
}

static bool walk_by_degree(struct walk *walk)
{
    for (uint32_t start = 0; start < walk->of->corner_count; start += 3) {
        if (zr_draco_stops(walk->draco)) return false;
        if (walk->is_visited[start / 3]) continue;
        walk->best = 0;
        push(&walk->stacks[0], start);
        reach(walk, start + 1);
        reach(walk, start + 2);
        reach(walk, start);
        for (uint32_t corner = pop(walk); corner != ZR_DRACO_NONE; corner = pop(walk)) {
            if (walk->is_visited[corner / 3]) continue;
            for (; corner != ZR_DRACO_NONE; corner = visit(walk, corner))
                if (zr_draco_stops(walk->draco)) return false;
        }
    }
    return true;
}

/* ---- all ---- */

static bool allocate(struct walk *walk, bool by_degree)
{
    struct zr_draco *draco = walk->draco;
    const struct zr_draco_corners *of = walk->of;
    *walk->out = (struct zr_draco_order){.of = of,
                                         .corners = zr_draco_numbers(draco, of->vertex_count),
                                         .values = zr_draco_nones(draco, of->vertex_count),
                                         .of_point = zr_draco_nones(draco, draco->mesh->point_count)};
    for (int i = 0; i < (by_degree ? PRIORITIES : 1); i++)
        walk->stacks[i].corners = zr_draco_numbers(draco, of->corner_count + 1);
    walk->is_visited = zr_arena_zero(&draco->scratch, draco->mesh->face_count, sizeof *walk->is_visited);
    if (by_degree) walk->degrees = zr_arena_zero(&draco->scratch, of->vertex_count, sizeof *walk->degrees);
    return walk->out->values && walk->out->of_point && zr_arena_ok(&draco->scratch);
}

/* Finds the value of each point. */
static bool map_points(struct zr_draco *draco, struct zr_draco_order *out)
{
    for (uint32_t c = 0; c < out->of->corner_count; c++) {
        const uint32_t value = out->values[out->of->vertices[c]];
        if (value >= out->count) return false;
        out->of_point[draco->points[c]] = value;
        if (zr_draco_stops(draco)) return false;
    }
    for (uint32_t i = 0; i < draco->mesh->point_count; i++)
        if (out->of_point[i] >= out->count || zr_draco_stops(draco)) return false;
    return true;
}

bool zr_draco_make_order(struct zr_draco *draco, const struct zr_draco_corners *of, bool by_degree,
                         struct zr_draco_order *out)
{
    struct walk walk = {.draco = draco, .of = of, .out = out};
    return allocate(&walk, by_degree) && (by_degree ? walk_by_degree(&walk) : walk_depth_first(&walk)) &&
           map_points(draco, out);
}
