#include "mesh/crease_normals.h"

#include <stdatomic.h>

#include "base/run.h"
#include "base/trig.h"
#include "mesh/blended_normals.h"
#include "mesh/crease_chains.h"
#include "mesh/crease_fans.h"
#include "mesh/crease_sums.h"
#include "mesh/weld.h"
#include "mesh/weld_input.h"

enum { FACES_PER_RANGE = 1 << 11, VERTICES_PER_RANGE = 1 << 10, SLOTS_PER_CANCEL_CHECK = 1 << 16 };

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
    bool has_bent;    /* fans are wanted */
    uint8_t *bent;    /* by vertex; NULL: no fans */
    float cosine;     /* of the crease angle, with a tolerance */
    zr_vec4 *corners;
    atomic_size_t distinct; /* normals, as zr_crease_mark_equal counts them */
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

/* Averages the corners of each group of one vertex. Corners of group 0 keep the normals of their faces. Returns the sum
 * of zr_crease_mark_equal. */
static size_t sum_groups(const struct creasing *c, uint32_t *slots, uint32_t count)
{
    size_t distinct = 0;
    sort_by_groups(c, slots, count);
    for (uint32_t first = 0, end; first < count; first = end) {
        const uint32_t group = c->groups[slots[first]];
        for (end = first; end < count && c->groups[slots[end]] == group; end++)
            ;
        const uint32_t own = end - first;
        const struct zr_vertex_corners of = {&own, slots + first, NULL};
        distinct += group != 0 ? zr_crease_sums_of(c->isa)(&of, 0, 1, LEAST_OF_GROUPS, c->corners)
                               : zr_crease_mark_equal(slots + first, own, c->corners);
    }
    return distinct;
}

static void sum_groups_of_vertices(void *context, size_t begin, size_t end)
{
    struct creasing *c = context;
    const uint32_t *ends = c->counts + (size_t)(c->chunk_count - 1) * c->vertex_count;
    size_t distinct = 0;
    if (zr_is_cancelled(c->cancel)) return;
    for (size_t vertex = begin; vertex < end; vertex++) {
        const uint32_t first = vertex == 0 ? 0 : ends[vertex - 1];
        distinct += sum_groups(c, c->slots + first, ends[vertex] - first);
    }
    atomic_fetch_add_explicit(&c->distinct, distinct, memory_order_relaxed);
}

/* ---- sums ---- */

/* After the sort, the last chunk's counts are the ends of the vertices' lists. */
static struct zr_vertex_corners corners_of(const struct creasing *c)
{
    return (struct zr_vertex_corners){c->counts + (size_t)(c->chunk_count - 1) * c->vertex_count, c->slots, c->bent};
}

static void make_sums(void *context, size_t begin, size_t end)
{
    struct creasing *c = context;
    const struct zr_vertex_corners of = corners_of(c);
    if (zr_is_cancelled(c->cancel)) return;
    const size_t distinct = zr_crease_sums_of(c->isa)(&of, begin, end, c->cosine, c->corners);
    atomic_fetch_add_explicit(&c->distinct, distinct, memory_order_relaxed);
}

/* ---- equal normals ---- */

/* Moves the normals that are the first of equal ones to the front, and numbers all corners. False if cancelled. A first
 * corner comes before those that have its number. The numbers overwrite the slots. */
static bool number_normals(struct creasing *c)
{
    uint32_t *numbers = c->slots, count = 0;
    for (uint32_t slot = 0; slot < c->corner_count; slot++) {
        if (slot % SLOTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(c->cancel)) return false;
        const zr_vec4 normal = c->corners[slot];
        uint32_t first;
        memcpy(&first, &normal.w, sizeof first);
        numbers[slot] = first < slot ? numbers[first] : count;
        if (first < slot) continue;
        c->corners[count++] = normal;
    }
    c->distinct = count;
    return true;
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

/* One allocation, so that it can be trimmed to the normals. The corners replace the tables of the weld. */
struct rooms {
    size_t size, front; /* bytes of all, and of those that the weld and then the corners have */
    size_t sorting;     /* bytes of a vertex's counts and mark */
    size_t counts_size; /* bytes if they have an allocation of their own, else 0 */
    char *all, *counts;
    uint64_t *weld;
    uint32_t *vertices;
    zr_vec4 *positions;
};

static size_t aligned(size_t bytes)
{
    return (bytes + ZR_ARENA_ALIGN - 1) & ~((size_t)ZR_ARENA_ALIGN - 1);
}

/* Leaves room for the counts of a fourth as many vertices as corners: vertices of smooth meshes have six. */
static void find_rooms(struct zr_arena *arena, const struct zr_mesh_extent *extent, const struct creasing *c,
                       struct rooms *rooms)
{
    const size_t positions = c->mesh.position_count, least = c->corner_count / 4;
    rooms->sorting = c->chunk_count * sizeof(uint32_t) + 1;
    const size_t sorting = (positions < least ? positions : least) * rooms->sorting;
    const size_t front = aligned(
        larger(zr_weld_room(c->mesh.position_count) * sizeof(uint64_t), c->corner_count * sizeof(zr_vec4) + sorting));
    const size_t copied = extent->needs_copy ? positions * sizeof(zr_vec4) : 0;
    const size_t groups = c->mesh.face_groups ? c->corner_count : 0;
    rooms->front = front;
    rooms->size = front + copied + (positions + groups) * sizeof(uint32_t);
    rooms->all = zr_arena_alloc(arena, rooms->size, 1);
    if (!rooms->all) return;
    rooms->weld = (uint64_t *)(void *)rooms->all;
    rooms->positions = (zr_vec4 *)(void *)(rooms->all + front);
    rooms->vertices = (uint32_t *)(void *)(rooms->all + front + copied);
}

/* Finds the room of the counts and bent vertices: behind the corners, or a new one. */
static void place_counts(struct zr_arena *arena, struct creasing *c, struct rooms *rooms)
{
    const size_t corners = c->corner_count * sizeof(zr_vec4), size = c->vertex_count * rooms->sorting;
    const bool fits = size <= rooms->front - corners;
    rooms->counts_size = fits ? 0 : size;
    rooms->counts = fits ? rooms->all + corners : zr_arena_alloc(arena, size, 1);
    c->counts = (uint32_t *)(void *)rooms->counts;
    c->bent = c->has_bent && c->counts ? (uint8_t *)(c->counts + (size_t)c->chunk_count * c->vertex_count) : NULL;
}

static void smooth_fans(const struct zr_run *run, struct creasing *c, float diagonal)
{
    const struct zr_corner_mesh mesh = {.mesh = &c->mesh,
                                        .vertices = c->vertices,
                                        .vertex_count = c->vertex_count,
                                        .of = corners_of(c),
                                        .cosine = c->cosine,
                                        .diagonal = diagonal,
                                        .corners = c->corners};
    c->distinct += zr_crease_fans_apply(run, &mesh);
}

/* Makes the normals of c->corners, which replace the tables of the weld. */
static void make_corner_normals(const struct zr_run *run, struct creasing *c, struct rooms *rooms, float diagonal)
{
    c->corners = (zr_vec4 *)(void *)rooms->all;
    place_counts(run->arena, c, rooms);
    if (!zr_arena_ok(run->arena)) return;
    make_normals(run->team, c);
    if (c->bent && !zr_is_cancelled(run->cancel)) smooth_fans(run, c, diagonal);
    zr_arena_trim(run->arena, rooms->counts, rooms->counts_size, 0, 1);
}

/* Keeps equal normals once if that takes less memory. */
static void share_normals(struct zr_arena *arena, struct creasing *c, const struct rooms *rooms,
                          struct zr_crease_normals *out)
{
    const bool is_less = c->distinct < (size_t)c->corner_count - c->corner_count / 4;
    *out = (struct zr_crease_normals){(zr_vec4 *)(void *)rooms->all, NULL, c->corner_count};
    if (c->vertex_count > 0 && is_less && number_normals(c)) {
        out->numbers = c->slots;
        out->count = (uint32_t)c->distinct;
    }
    zr_arena_trim(arena, rooms->all, rooms->size, out->count * sizeof *out->normals, 1);
    if (!out->numbers) zr_arena_trim(arena, c->slots, c->corner_count, 0, sizeof *c->slots);
}

/* Makes those of a mesh that is not sectioned. */
static const struct zr_crease_normals *make(const struct zr_run *run, const struct zr_mesh *mesh, float degrees)
{
    const uint32_t corner_count = mesh->face_offsets[mesh->face_count];
    struct zr_crease_normals *out = zr_arena_alloc(run->arena, 1, sizeof *out);
    struct creasing c = {.cancel = run->cancel,
                         .mesh = *mesh,
                         .isa = zr_team_isa(run->team),
                         .corner_count = corner_count,
                         .chunk_count = count_chunks_of(run->team, corner_count),
                         .slots = zr_arena_alloc(run->arena, corner_count, sizeof *c.slots),
                         .cosine = least_cosine(degrees)};
    const struct zr_mesh_extent extent = zr_mesh_extent_of(run->team, mesh);
    struct rooms rooms = {0};
    find_rooms(run->arena, &extent, &c, &rooms);
    if (!zr_arena_ok(run->arena)) return NULL;
    const struct zr_weld_input input = zr_weld_input_make(run->team, mesh, &extent, rooms.positions);
    c.mesh.positions = input.at;
    c.vertex_count = zr_weld_make(run->team, run->cancel, &input, rooms.weld, rooms.vertices);
    c.vertices = c.vertex_count < input.count ? rooms.vertices : NULL;
    c.groups = mesh->face_groups ? rooms.vertices + mesh->position_count : NULL;
    /* A mesh that is a window on the faces of another lacks those around it. */
    const bool is_window = mesh->face_offsets[0] > 0;
    c.has_bent = !c.groups && !is_window && zr_crease_degrees_allow_noise(degrees);
    if (c.vertex_count > 0) make_corner_normals(run, &c, &rooms, input.diagonal);
    if (!zr_arena_ok(run->arena)) return NULL;
    share_normals(run->arena, &c, &rooms, out);
    return out;
}

const struct zr_crease_normals *zr_crease_normals_make(const struct zr_run *run, const struct zr_mesh *mesh,
                                                       float degrees)
{
    if (!mesh->source) return make(run, mesh, degrees);
    return zr_blended_corner_normals(run->arena, run->cancel, mesh, make(run, mesh->source->mesh, degrees));
}
