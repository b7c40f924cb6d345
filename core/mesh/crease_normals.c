#include "mesh/crease_normals.h"

#include "base/run.h"
#include "base/trig.h"
#include "mesh/blended_normals.h"
#include "mesh/crease_chains.h"
#include "mesh/crease_fans.h"
#include "mesh/crease_sums.h"
#include "mesh/weld.h"
#include "mesh/weld_input.h"

enum { FACES_PER_RANGE = 1 << 11, VERTICES_PER_RANGE = 1 << 10 };

/* Corners are sorted in chunks, one thread per chunk: more chunks take more memory. */
enum { CHUNKS_MOST = 4, CORNERS_PER_CHUNK = 1 << 14 };

/* Below every cosine: all faces of a group are averaged. */
#define LEAST_OF_GROUPS (-4.0f)

struct creasing {
    const struct zr_cancel *cancel;
    struct zr_mesh mesh; /* with positions replaced by those of zr_weld_input */
    enum zr_isa isa;
    const uint32_t *vertices; /* vertex of each position; NULL: its own number */
    uint32_t vertex_count, corner_count, chunk_count;
    uint32_t *counts; /* vertex_count per chunk; later the slot of the next corner of each vertex */
    uint32_t *slots;
    uint32_t *groups; /* smoothing group of each corner, or NULL */
    uint8_t *bent;    /* by vertex; NULL: no fans */
    float cosine;     /* of the crease angle, with a tolerance */
    zr_vec4 *corners;
};

static void make_corners(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    if (!zr_is_cancelled(c->cancel)) zr_crease_corners_of(c->isa)(&c->mesh, (uint32_t)begin, end - begin, c->corners);
}

/* ---- corners by vertex: a counting sort that keeps the order of the chunks ---- */

static uint32_t vertex_at(const struct creasing *c, size_t slot)
{
    const uint32_t position = c->mesh.indices[slot];
    return c->vertices ? c->vertices[position] : position;
}

static size_t chunk_begin(const struct creasing *c, size_t chunk)
{
    return chunk * c->corner_count / c->chunk_count;
}

static void count_chunks(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    for (size_t chunk = begin; chunk < end; chunk++) {
        uint32_t *counts = c->counts + chunk * c->vertex_count;
        memset(counts, 0, c->vertex_count * sizeof *counts);
        const size_t last = chunk_begin(c, chunk + 1);
        for (size_t slot = chunk_begin(c, chunk); slot < last; slot++)
            counts[vertex_at(c, slot)]++;
    }
}

static void sum_counts(const struct creasing *c)
{
    uint32_t sum = 0;
    for (size_t vertex = 0; vertex < c->vertex_count; vertex++)
        for (uint32_t *count = c->counts + vertex; count < c->counts + (size_t)c->chunk_count * c->vertex_count;
             count += c->vertex_count) {
            const uint32_t own = *count;
            *count = sum;
            sum += own;
        }
}

static void fill_chunks(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    for (size_t chunk = begin; chunk < end; chunk++) {
        uint32_t *next = c->counts + chunk * c->vertex_count;
        const size_t last = chunk_begin(c, chunk + 1);
        for (size_t slot = chunk_begin(c, chunk); slot < last; slot++)
            c->slots[next[vertex_at(c, slot)]++] = (uint32_t)slot;
    }
}

/* ---- smoothing groups ---- */

static void expand_groups(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    for (size_t face = begin; face < end; face++)
        for (uint32_t slot = c->mesh.face_offsets[face]; slot < c->mesh.face_offsets[face + 1]; slot++)
            c->groups[slot] = c->mesh.face_groups[face];
}

/* True if slot a precedes slot b: by groups, then in the order of slots. */
static bool is_before(const struct creasing *c, uint32_t a, uint32_t b)
{
    return c->groups[a] != c->groups[b] ? c->groups[a] < c->groups[b] : a < b;
}

static void sift(const struct creasing *c, uint32_t *slots, size_t root, size_t count)
{
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && is_before(c, slots[child], slots[child + 1])) child++;
        if (!is_before(c, slots[root], slots[child])) return;
        const uint32_t slot = slots[root];
        slots[root] = slots[child];
        slots[child] = slot;
    }
}

/* Heap sort: in place, and never quadratic. */
static void sort_by_groups(const struct creasing *c, uint32_t *slots, uint32_t count)
{
    for (size_t i = count / 2; i-- > 0;)
        sift(c, slots, i, count);
    for (size_t last = count; last-- > 1;) {
        const uint32_t slot = slots[0];
        slots[0] = slots[last];
        slots[last] = slot;
        sift(c, slots, 0, last);
    }
}

/* Averages the corners of each group of one vertex. Corners of group 0 keep the normals of their faces. */
static void sum_groups(const struct creasing *c, uint32_t *slots, uint32_t count)
{
    sort_by_groups(c, slots, count);
    for (uint32_t first = 0, end; first < count; first = end) {
        const uint32_t group = c->groups[slots[first]];
        for (end = first; end < count && c->groups[slots[end]] == group; end++)
            if (group == 0) c->corners[slots[end]].w = 0.0f;
        const uint32_t own = end - first;
        const struct zr_vertex_corners of = {&own, slots + first, NULL};
        if (group != 0) zr_crease_sums_of(c->isa)(&of, 0, 1, LEAST_OF_GROUPS, c->corners);
    }
}

static void sum_groups_of_vertices(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    const uint32_t *ends = c->counts + (size_t)(c->chunk_count - 1) * c->vertex_count;
    if (zr_is_cancelled(c->cancel)) return;
    for (size_t vertex = begin; vertex < end; vertex++) {
        const uint32_t first = vertex == 0 ? 0 : ends[vertex - 1];
        sum_groups(c, c->slots + first, ends[vertex] - first);
    }
}

/* ---- sums ---- */

/* After the sort, the last chunk's counts are the ends of the vertices' lists. */
static struct zr_vertex_corners corners_of(const struct creasing *c)
{
    return (struct zr_vertex_corners){c->counts + (size_t)(c->chunk_count - 1) * c->vertex_count, c->slots, c->bent};
}

static void make_sums(void *context, size_t begin, size_t end)
{
    const struct creasing *c = context;
    const struct zr_vertex_corners of = corners_of(c);
    if (!zr_is_cancelled(c->cancel)) zr_crease_sums_of(c->isa)(&of, begin, end, c->cosine, c->corners);
}

/* ---- the whole step ---- */

static uint32_t count_chunks_of(struct zr_team *team, uint32_t corners)
{
    const uint32_t threads = (uint32_t)zr_team_size(team);
    if (corners < CORNERS_PER_CHUNK) return 1;
    return threads < CHUNKS_MOST ? threads : CHUNKS_MOST;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Returns the cosine of the crease angle, less a tolerance. Without it, normals that differ in their last bits would
 * count as different near 0 degrees, where the cosine hardly changes. */
static float least_cosine(float degrees)
{
    double sine, cosine;
    zr_sine_cosine((double)degrees, &sine, &cosine);
    return (float)(cosine - 1e-6);
}

static void make_normals(struct zr_team *team, struct creasing *c)
{
    zr_team_ranges(team, c->mesh.face_count, FACES_PER_RANGE, make_corners, c);
    zr_team_ranges(team, c->chunk_count, 1, count_chunks, c);
    sum_counts(c);
    if (zr_is_cancelled(c->cancel)) return;
    zr_team_ranges(team, c->chunk_count, 1, fill_chunks, c);
    if (c->groups) zr_team_ranges(team, c->mesh.face_count, FACES_PER_RANGE, expand_groups, c);
    zr_team_ranges(team, c->vertex_count, VERTICES_PER_RANGE, c->groups ? sum_groups_of_vertices : make_sums, c);
}

/* One allocation, so that it can be trimmed as the newest one. Welding and sorting share `rest`. */
struct rooms {
    char *all;
    size_t size;
    zr_vec4 *positions;
    uint64_t *rest;
    uint32_t *vertices;
    uint8_t *bent;
};

static void find_rooms(struct zr_arena *arena, const struct zr_mesh_extent *extent, const struct creasing *c,
                       struct rooms *rooms)
{
    const size_t positions = c->mesh.position_count, copied = extent->needs_copy ? positions * sizeof(zr_vec4) : 0;
    const size_t welding = zr_weld_room(c->mesh.position_count) * sizeof(uint64_t);
    const size_t sorting = (c->chunk_count * positions + c->corner_count) * sizeof(uint32_t);
    const size_t rest = larger(welding, sorting + sorting % sizeof(uint64_t));
    const size_t groups = c->mesh.face_groups ? c->corner_count : 0, vertices = (positions + groups) * sizeof(uint32_t);
    rooms->size = copied + rest + vertices + positions;
    rooms->all = zr_arena_alloc(arena, rooms->size, 1);
    if (!rooms->all) return;
    rooms->positions = (zr_vec4 *)(void *)rooms->all;
    rooms->rest = (uint64_t *)(void *)(rooms->all + copied);
    rooms->vertices = (uint32_t *)(void *)(rooms->all + copied + rest);
    rooms->bent = (uint8_t *)(rooms->all + copied + rest + vertices);
}

static void smooth_fans(const struct zr_run *run, const struct creasing *c, float diagonal)
{
    const struct zr_corner_mesh mesh = {.mesh = &c->mesh,
                                        .vertices = c->vertices,
                                        .vertex_count = c->vertex_count,
                                        .of = corners_of(c),
                                        .cosine = c->cosine,
                                        .diagonal = diagonal,
                                        .corners = c->corners};
    if (c->vertex_count > 0) zr_crease_fans_apply(run, &mesh);
}

/* Makes those of a mesh that is not sectioned. */
static zr_vec4 *make(const struct zr_run *run, const struct zr_mesh *mesh, float degrees)
{
    const uint32_t corner_count = mesh->face_offsets[mesh->face_count];
    struct creasing c = {.cancel = run->cancel,
                         .mesh = *mesh,
                         .isa = zr_team_isa(run->team),
                         .corner_count = corner_count,
                         .chunk_count = count_chunks_of(run->team, corner_count),
                         .cosine = least_cosine(degrees),
                         .corners = zr_arena_alloc(run->arena, corner_count, sizeof *c.corners)};
    const struct zr_mesh_extent extent = zr_mesh_extent_of(run->team, mesh);
    struct rooms rooms = {0};
    find_rooms(run->arena, &extent, &c, &rooms);
    if (!zr_arena_ok(run->arena)) return NULL;
    const struct zr_weld_input input = zr_weld_input_make(run->team, mesh, &extent, rooms.positions);
    c.mesh.positions = input.at;
    c.vertex_count = zr_weld_make(run->team, run->cancel, &input, rooms.rest, rooms.vertices);
    c.vertices = c.vertex_count < input.count ? rooms.vertices : NULL;
    c.slots = (uint32_t *)(void *)rooms.rest;
    c.counts = c.slots + corner_count;
    c.groups = mesh->face_groups ? rooms.vertices + mesh->position_count : NULL;
    /* A mesh that is a window on the faces of another lacks those around it. */
    const bool is_window = mesh->face_offsets[0] > 0;
    c.bent = !c.groups && !is_window && zr_crease_degrees_allow_noise(degrees) ? rooms.bent : NULL;
    if (c.vertex_count > 0) make_normals(run->team, &c);
    if (c.bent && !zr_is_cancelled(run->cancel)) smooth_fans(run, &c, input.diagonal);
    zr_arena_trim(run->arena, rooms.all, rooms.size, 0, 1);
    return zr_arena_ok(run->arena) ? c.corners : NULL;
}

zr_vec4 *zr_crease_normals_make(const struct zr_run *run, const struct zr_mesh *mesh, float degrees)
{
    if (!mesh->source) return make(run, mesh, degrees);
    return zr_blended_corner_normals(run->arena, run->cancel, mesh, make(run, mesh->source->mesh, degrees));
}
