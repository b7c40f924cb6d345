#include "mesh/facts/closed_parts.h"

#include <stdatomic.h>

#include "base/cancel.h"
#include "base/run.h"
#include "base/sort.h"
#include "mesh/facts/ring_area.h"
#include "mesh/facts/shells.h"
#include "mesh/weld.h"
#include "scene/parts/part_list.h"

enum { FACES_PER_CANCEL_CHECK = 1 << 14, VERTICES_PER_RANGE = 1 << 12 };

/* An occurrence of an edge, listed at its lower vertex: the higher vertex, the face, and the direction in bit 0. */
typedef uint64_t use;

struct finding {
    const struct zr_cancel *cancel;
    const struct zr_mesh *mesh;
    const uint32_t *vertices; /* per position */
    uint32_t vertex_count;
    uint32_t *ends; /* per vertex: end of its list in `uses` */
    use *uses;
    atomic_uchar *closed;
    const struct zr_shell_forest *forest; /* NULL: shells are not counted */
    struct odd *odd;                      /* with shells: per part, open and flipped edges */
};

/* Edges of a part that are used more often in one direction. */
struct odd {
    _Atomic uint32_t count;
    _Atomic uint64_t least; /* of the face and the slot of its corner where such an edge ends; UINT64_MAX: none */
};

/* An edge of welded vertices, low < high. */
struct edge {
    uint32_t low, high;
};

static uint32_t part_of(const struct finding *f, uint32_t face)
{
    return f->mesh->face_parts ? f->mesh->face_parts[face] : 0;
}

/* ---- edges ---- */

typedef void visit_fn(struct finding *f, uint32_t from, uint32_t to, uint32_t face);

static void count_edge(struct finding *f, uint32_t from, uint32_t to, uint32_t face)
{
    f->ends[from < to ? from : to]++;
    atomic_store_explicit(&f->closed[part_of(f, face)], 1, memory_order_relaxed);
    if (f->forest) zr_shell_forest_plant(f->forest, face);
}

/* Fills each list from its end, which becomes its begin. */
static void put_edge(struct finding *f, uint32_t from, uint32_t to, uint32_t face)
{
    const uint32_t low = from < to ? from : to, high = from < to ? to : from;
    f->uses[--f->ends[low]] = (use)high << 32 | (use)face << 1 | (from < to);
}

bool zr_ring_turns_as_first(const struct zr_mesh *mesh, const struct zr_rings *rings, uint32_t ring)
{
    const struct zr_ring_area first = zr_ring_area_of(mesh, rings->offsets[0], rings->offsets[1]),
                              own = zr_ring_area_of(mesh, rings->offsets[ring], rings->offsets[ring + 1]);
    return zr_ring_areas_agree(&first, &own);
}

/* True if the ring has three different vertices. */
static bool has_area(const struct finding *f, const uint32_t *corners, uint32_t count)
{
    const uint32_t first = f->vertices[corners[0]];
    uint32_t second = first;
    for (uint32_t i = 1; i < count; i++) {
        const uint32_t vertex = f->vertices[corners[i]];
        if (second == first)
            second = vertex;
        else if (vertex != first && vertex != second)
            return true;
    }
    return false;
}

static void visit_face(struct finding *f, uint32_t face, visit_fn *visit)
{
    const struct zr_mesh *mesh = f->mesh;
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const bool has_holes = rings.count > 1 && !zr_mesh_face_is_cap(mesh, face);
    struct zr_ring_area first = {.area = {0, 0, 0}}, own;
    if (has_holes) first = zr_ring_area_of(mesh, rings.offsets[0], rings.offsets[1]);
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *corners = mesh->indices + rings.offsets[r], count = rings.offsets[r + 1] - rings.offsets[r];
        if (!has_area(f, corners, count)) continue;
        if (has_holes && r > 0) own = zr_ring_area_of(mesh, rings.offsets[r], rings.offsets[r + 1]);
        const bool is_reversed = has_holes && r > 0 && zr_ring_areas_agree(&first, &own);
        uint32_t from = f->vertices[corners[count - 1]];
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t to = f->vertices[corners[i]];
            if (from != to) visit(f, is_reversed ? to : from, is_reversed ? from : to, face);
            from = to;
        }
    }
}

static void visit_faces(struct finding *f, visit_fn *visit)
{
    for (uint32_t face = 0; face < f->mesh->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(f->cancel)) return;
        visit_face(f, face, visit);
    }
}

/* ---- lists of vertices ---- */

static uint32_t face_of(use edge)
{
    return (uint32_t)(edge >> 1) & INT32_MAX;
}

/* Returns the slot of the corner of a face where an edge ends. */
static uint32_t slot_of(const struct finding *f, uint32_t face, struct edge edge)
{
    const struct zr_rings rings = zr_mesh_rings(f->mesh, face);
    for (uint32_t r = 0; r < rings.count; r++) {
        uint32_t from = f->vertices[f->mesh->indices[rings.offsets[r + 1] - 1]];
        for (uint32_t i = rings.offsets[r]; i < rings.offsets[r + 1]; i++) {
            const uint32_t to = f->vertices[f->mesh->indices[i]];
            if ((from < to ? from : to) == edge.low && (from < to ? to : from) == edge.high) return i;
            from = to;
        }
    }
    return rings.offsets[0];
}

static void note_odd(const struct finding *f, struct odd *odd, uint32_t face, struct edge edge)
{
    atomic_fetch_add_explicit(&odd->count, 1, memory_order_relaxed);
    uint64_t least = atomic_load_explicit(&odd->least, memory_order_relaxed);
    if (least >> 32 < face) return;
    const uint64_t own = (uint64_t)face << 32 | slot_of(f, face, edge);
    while (own < least && !atomic_compare_exchange_weak_explicit(&odd->least, &least, own, memory_order_relaxed,
                                                                 memory_order_relaxed)) {
    }
}

/* Marks the part and the shell if they use the edge more often in one direction. All uses are those of one part. */
static void check_edge(const struct finding *f, const use *uses, uint32_t count, struct edge edge)
{
    uint32_t upwards = 0;
    for (uint32_t i = 0; i < count; i++)
        upwards += uses[i] & 1u;
    for (uint32_t i = 1; f->forest && i < count; i++)
        zr_shell_forest_join(f->forest, face_of(uses[i - 1]), face_of(uses[i]));
    if (2 * (uint64_t)upwards == count) return;
    atomic_store_explicit(&f->closed[part_of(f, face_of(*uses))], 0, memory_order_relaxed);
    if (!f->forest) return;
    atomic_store_explicit(&f->forest->is_open[face_of(*uses)], 1, memory_order_relaxed);
    note_odd(f, &f->odd[2 * (size_t)part_of(f, face_of(*uses)) + (count % 2 == 0)], face_of(*uses), edge);
}

/* Checks the uses of one edge. With several parts, sorts them by part. */
static void check_parts(const struct finding *f, use *uses, uint32_t count, struct edge edge)
{
    if (f->mesh->face_parts) {
        for (uint32_t i = 0; i < count; i++)
            uses[i] = (use)part_of(f, face_of(uses[i])) << 32 | (uses[i] & UINT32_MAX);
        zr_sort_u64(uses, count);
    }
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && uses[next] >> 32 == uses[i] >> 32; next++) {
        }
        check_edge(f, uses + i, next - i, edge);
    }
}

static void check_list(const struct finding *f, use *uses, uint32_t count, uint32_t low)
{
    zr_sort_u64(uses, count);
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && uses[next] >> 32 == uses[i] >> 32; next++) {
        }
        check_parts(f, uses + i, next - i, (struct edge){low, (uint32_t)(uses[i] >> 32)});
    }
}

static void check_range(void *context, size_t begin, size_t end)
{
    const struct finding *f = context;
    if (zr_is_cancelled(f->cancel)) return;
    for (size_t v = begin; v < end; v++)
        check_list(f, f->uses + f->ends[v], f->ends[v + 1] - f->ends[v], (uint32_t)v);
}

/* ---- all steps ---- */

static void find(struct zr_team *team, struct finding *f)
{
    memset(f->ends, 0, ((size_t)f->vertex_count + 1) * sizeof *f->ends);
    visit_faces(f, count_edge);
    if (zr_is_cancelled(f->cancel)) return;
    for (uint32_t v = 0, sum = 0; v <= f->vertex_count; v++)
        f->ends[v] = sum += f->ends[v];
    visit_faces(f, put_edge);
    if (zr_is_cancelled(f->cancel)) return;
    zr_team_ranges(team, f->vertex_count, VERTICES_PER_RANGE, check_range, f);
}

/* Arrays in one allocation, which can be trimmed while it is the newest. Welding and the edge lists share `rest`. */
struct rooms {
    char *all;
    size_t size;
    zr_vec4 *positions;
    uint64_t *rest;
    uint32_t *vertices, *ends;
    struct odd *odd;               /* if shells are counted */
    struct zr_shell_forest forest; /* likewise */
    atomic_uchar *closed;
};

static bool make_rooms(struct zr_arena *arena, const struct zr_mesh *mesh, uint32_t parts, bool has_shells,
                       const struct zr_mesh_extent *extent, struct rooms *rooms)
{
    const size_t faces = has_shells ? mesh->face_count : 0;
    const size_t positions = mesh->position_count, corners = mesh->face_offsets[mesh->face_count];
    const size_t welding = zr_weld_room(mesh->position_count), copied = extent->needs_copy ? positions : 0;
    const size_t rest = welding > corners ? welding : corners;
    const size_t odd = has_shells ? 2 * (size_t)parts : 0;
    rooms->size = odd * sizeof *rooms->odd + copied * sizeof *rooms->positions + rest * sizeof *rooms->rest +
                  positions * sizeof *rooms->vertices + (positions + 1) * sizeof *rooms->ends +
                  faces * sizeof *rooms->forest.parents + faces * sizeof *rooms->forest.is_open +
                  parts * sizeof *rooms->closed;
    rooms->all = zr_arena_alloc(arena, rooms->size, 1);
    if (!rooms->all) return false;
    rooms->positions = (zr_vec4 *)(void *)rooms->all;
    rooms->odd = (struct odd *)(void *)(rooms->positions + copied);
    rooms->rest = (uint64_t *)(void *)(rooms->odd + odd);
    rooms->vertices = (uint32_t *)(void *)(rooms->rest + rest);
    rooms->ends = rooms->vertices + positions;
    rooms->forest.mesh = mesh;
    rooms->forest.parents = (_Atomic uint32_t *)(void *)(rooms->ends + positions + 1);
    rooms->forest.is_open = (atomic_uchar *)(void *)(rooms->forest.parents + faces);
    rooms->closed = rooms->forest.is_open + faces;
    for (uint32_t p = 0; p < parts; p++)
        atomic_init(&rooms->closed[p], 0);
    for (size_t i = 0; i < odd; i++) {
        atomic_init(&rooms->odd[i].count, 0);
        atomic_init(&rooms->odd[i].least, UINT64_MAX);
    }
    return true;
}

static struct zr_odd_edges odd_edges_of(const struct odd *odd)
{
    return (struct zr_odd_edges){atomic_load_explicit(&odd->count, memory_order_relaxed),
                                 (uint32_t)atomic_load_explicit(&odd->least, memory_order_relaxed)};
}

bool zr_closed_parts_find(const struct zr_run *run, const struct zr_mesh *mesh, uint8_t *closed,
                          struct zr_shells *shells)
{
    const uint32_t parts = zr_mesh_part_count(mesh);
    memset(closed, 0, parts);
    if (shells) memset(shells, 0, parts * sizeof *shells);
    if (mesh->face_count == 0 || parts > INT32_MAX) return true;
    const struct zr_mesh_extent extent = zr_mesh_extent_of(run->team, mesh);
    struct rooms rooms;
    if (!make_rooms(run->arena, mesh, parts, shells, &extent, &rooms)) return false;
    if (shells) zr_shell_forest_clear(&rooms.forest, run->cancel);
    const struct zr_weld_input input = zr_weld_input_make(run->team, mesh, &extent, rooms.positions);
    struct finding f = {.cancel = run->cancel,
                        .mesh = mesh,
                        .vertices = rooms.vertices,
                        .ends = rooms.ends,
                        .closed = rooms.closed,
                        .forest = shells ? &rooms.forest : NULL,
                        .odd = rooms.odd};
    f.vertex_count = zr_weld_make(run->team, run->cancel, &input, rooms.rest, rooms.vertices);
    f.uses = rooms.rest;
    if (f.vertex_count > 0) find(run->team, &f);
    if (shells && !zr_is_cancelled(run->cancel))
        zr_shells_count(&rooms.forest, run->cancel, (double *)(void *)rooms.rest, shells);
    for (uint32_t p = 0; shells && p < parts; p++) {
        shells[p].open_edges = odd_edges_of(&rooms.odd[2 * (size_t)p]);
        shells[p].flipped_edges = odd_edges_of(&rooms.odd[2 * (size_t)p + 1]);
    }
    for (uint32_t p = 0; p < parts; p++)
        closed[p] = atomic_load_explicit(&rooms.closed[p], memory_order_relaxed);
    zr_arena_trim(run->arena, rooms.all, rooms.size, 0, 1);
    return true;
}
