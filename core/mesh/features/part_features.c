#include "mesh/features/part_features.h"

#include <string.h>

#include "mesh/edge_mesh.h"
#include "mesh/world_place.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 14 };

/* The triangles of a mesh, by part. */
struct cut_mesh {
    struct zr_edge_mesh edges;
    const uint32_t *ends;      /* per part: end of its triangles */
    const uint32_t *triangles; /* by part, ascending */
};

static bool is_due(const struct zr_cancel *cancel, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel);
}

static uint32_t part_of(const struct zr_mesh *mesh, const struct cut_mesh *cut, uint32_t triangle)
{
    return mesh->face_parts ? mesh->face_parts[cut->edges.faces[triangle]] : 0;
}

static enum zr_status cut_mesh(const struct zr_run *run, const struct zr_mesh *mesh, struct cut_mesh *cut)
{
    const enum zr_status status = zr_edge_mesh_make(run, mesh, &cut->edges);
    if (status != ZR_OK) return status;
    const uint32_t parts = zr_mesh_part_count(mesh), count = cut->edges.triangle_count;
    uint32_t *ends = zr_arena_zero(run->arena, (size_t)parts + 1, sizeof *ends);
    uint32_t *triangles = zr_arena_alloc(run->arena, count, sizeof *triangles);
    if (!ends || !triangles) return ZR_NO_MEMORY;
    for (uint32_t t = 0; t < count; t++) {
        if (is_due(run->cancel, t)) return ZR_CANCELLED;
        ends[part_of(mesh, cut, t)]++;
    }
    for (uint32_t p = 0, sum = 0; p <= parts; p++)
        ends[p] = sum += ends[p];
    for (uint32_t t = count; t-- > 0;) {
        if (is_due(run->cancel, t)) return ZR_CANCELLED;
        triangles[--ends[part_of(mesh, cut, t)]] = t;
    }
    cut->ends = ends + 1; /* begins to ends */
    cut->triangles = triangles;
    return ZR_OK;
}

/* ---- surfaces ---- */

/* Bounds of places, from the first one, and their largest coordinates before and after they were moved. */
struct extent {
    double min[3], max[3], far;
};

static void extend(struct extent *extent, zr_dvec3 p, struct zr_world_place world, const zr_mat4 *matrix)
{
    const double at[3] = {p.x, p.y, p.z}, whole[3] = {world.x, world.y, world.z};
    for (int k = 0; k < 3; k++) {
        extent->min[k] = zr_least_of(extent->min[k], at[k]);
        extent->max[k] = zr_most_of(extent->max[k], at[k]);
        extent->far = zr_most_of(extent->far, zr_most_of(fabs(whole[k]), fabs(whole[k] - (double)matrix->m[12 + k])));
    }
}

/* Makes the surface of a part. `origin` is added to its places. False without memory, if cancelled, or if a corner is
 * beyond the range of float. */
static bool make_surface(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_mesh *mesh,
                         const struct cut_mesh *cut, uint32_t part, const zr_mat4 *matrix, bool is_turned,
                         struct zr_surface *out, zr_dvec3 *origin)
{
    const uint32_t begin = part > 0 ? cut->ends[part - 1] : 0, count = cut->ends[part] - begin;
    uint32_t(*corners)[3] = zr_arena_alloc(arena, count, sizeof *corners);
    uint32_t *numbers = zr_arena_alloc(arena, cut->edges.vertex_count, sizeof *numbers);
    zr_dvec3 *places =
        zr_arena_alloc(arena, 3 * (size_t)count < cut->edges.vertex_count ? 3 * (size_t)count : cut->edges.vertex_count,
                       sizeof *places);
    struct extent extent = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0.0};
    struct zr_world_place world;
    if (!zr_arena_ok(arena)) return false;
    *out = (struct zr_surface){.places = places, .corners = (const uint32_t(*)[3])corners, .triangle_count = count};
    for (uint32_t i = 0; i < count; i++) { /* forget what other parts used */
        if (is_due(cancel, i)) return false;
        for (int k = 0; k < 3; k++)
            numbers[cut->edges.corners[3 * (size_t)cut->triangles[begin + i] + (size_t)k]] = UINT32_MAX;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (is_due(cancel, i)) return false;
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = cut->edges.corners[3 * (size_t)cut->triangles[begin + i] + (size_t)k];
            if (numbers[vertex] == UINT32_MAX) {
                if (!zr_world_place_of(matrix, mesh->positions[cut->edges.positions[vertex]], &world)) return false;
                const zr_dvec3 place = {world.x, world.y, world.z};
                if (out->place_count == 0) *origin = place;
                places[out->place_count] = zr_dvec3_sub(place, *origin);
                extend(&extent, places[out->place_count], world, matrix);
                numbers[vertex] = out->place_count++;
            }
            corners[i][is_turned ? 2 - k : k] = numbers[vertex];
        }
    }
    double square = 0.0;
    for (int k = 0; k < 3 && count > 0; k++)
        square += (extent.max[k] - extent.min[k]) * (extent.max[k] - extent.min[k]);
    out->size = sqrt(square);
    out->noise = zr_most_of(1e-7 * out->size, (double)FLT_EPSILON * extent.far);
    return true;
}

/* ---- parts ---- */

/* The parts of one instance of a mesh. */
struct finding {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_part_list *parts;
    const struct zr_part_facts *facts;
    struct zr_part_features *features;
};

/* Copies a list, beside scratch that is open. */
static void *keep_list(struct zr_arena *arena, struct zr_arena *scratch, const void *list, size_t count, size_t size)
{
    void *kept = zr_arena_alloc_beside(arena, scratch, count, size);
    if (kept && count > 0) memcpy(kept, list, count * size);
    return kept;
}

/* Copies all lists. False without memory. */
static bool keep(struct zr_arena *arena, struct zr_arena *scratch, struct zr_part_features *f)
{
    struct zr_holes *holes = &f->holes;
    holes->holes = keep_list(arena, scratch, holes->holes, holes->hole_count, sizeof *holes->holes);
    holes->bosses = keep_list(arena, scratch, holes->bosses, holes->boss_count, sizeof *holes->bosses);
    holes->fillets = keep_list(arena, scratch, holes->fillets, holes->fillet_count, sizeof *holes->fillets);
    f->planes.at = keep_list(arena, scratch, f->planes.at, f->planes.count, sizeof *f->planes.at);
    f->borders.at = keep_list(arena, scratch, f->borders.at, f->borders.count, sizeof *f->borders.at);
    return holes->holes && holes->bosses && holes->fillets && f->planes.at && f->borders.at;
}

/* Features of a surface, found by two threads: holes, and the rest. */
struct halves {
    const struct zr_surface *surface;
    const struct zr_facets *facets;
    const struct zr_seeds *seeds;
    struct zr_arena *arenas[2];
    struct zr_feature_work works[2];
    struct zr_part_features *out;
};

static void find_rest(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                      const struct zr_facets *facets, struct zr_part_features *out)
{
    if (!zr_planes_find(arena, work, facets, &out->planes)) out->planes.count = 0;
    if (!zr_borders_find(arena, work, facets, &out->borders)) out->borders.count = 0;
    out->tunnels = zr_tunnels_count(arena, work, facets);
    if (!zr_symmetry_begin(work, surface, &out->symmetry)) return;
    out->cylinder = zr_bounding_cylinder_find(work, surface, out->symmetry.directions, out->symmetry.direction_count);
    out->has_symmetry = zr_symmetry_find(arena, work, surface, &out->symmetry);
}

static void find_half(void *context, size_t begin, size_t end)
{
    struct halves *h = context;
    for (size_t i = begin; i < end; i++) {
        if (i == 0)
            h->out->is_omitted = !zr_holes_find(h->arenas[0], &h->works[0], h->facets, h->seeds, &h->out->holes);
        else
            find_rest(h->arenas[1], &h->works[1], h->surface, h->facets, h->out);
    }
}

/* Leaves out holes, since the work is stopped or memory is exhausted. */
static void omit(struct zr_part_features *out, const struct zr_feature_work *work)
{
    out->is_omitted = true;
    out->limit = work->steps > work->steps_most ? ZR_FEATURE_LIMIT_STEPS : ZR_FEATURE_LIMIT_MEMORY;
}

/* Finds the features of a surface. Lists are in the arena. The rest has memory of its own, of a fixed size, so that it
 * is found or left out whatever the number of threads. */
static void find_of_surface(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                            const struct zr_surface *surface, uint64_t steps, struct zr_part_features *out)
{
    const struct zr_feature_work whole = {.cancel = cancel, .steps_most = steps};
    struct halves halves = {.surface = surface, .works = {whole, whole}, .out = out};
    struct zr_facets facets;
    struct zr_seeds seeds;
    struct zr_arena rest;
    const size_t count = surface->triangle_count, most = ZR_FEATURE_BYTES_OF_REST_LEAST;
    const size_t size = (ZR_FEATURE_BYTES_OF_REST * count + (count < most / 32 ? 32 * count : most) + most) &
                        ~(size_t)(ZR_ARENA_ALIGN - 1);
    if (!zr_facets_make(arena, &halves.works[0], surface, &facets) ||
        !zr_seeds_find(arena, team, &halves.works[0], &facets, &seeds)) {
        omit(out, &halves.works[0]);
        return;
    }
    void *room = zr_arena_alloc(arena, size, 1);
    if (!room) return;
    zr_arena_init_within(&rest, room, size);
    halves.facets = &facets;
    halves.seeds = &seeds;
    halves.arenas[0] = arena;
    halves.arenas[1] = &rest;
    zr_team_ranges(team, 2, 1, find_half, &halves);
    if (rest.failed && rest.wanted == 0) arena->failed = true; /* the system has no memory */
    if (out->is_omitted) {
        omit(out, &halves.works[0]);
        out->holes = (struct zr_holes){.hole_count = 0};
    }
}

/* Moves places of a part from its origin to world space. The lists are in memory of this step. */
static void place(struct zr_part_features *f, zr_dvec3 origin)
{
    struct zr_hole *holes[] = {(struct zr_hole *)(uintptr_t)f->holes.holes,
                               (struct zr_hole *)(uintptr_t)f->holes.bosses};
    const uint32_t counts[] = {f->holes.hole_count, f->holes.boss_count};
    struct zr_plane *planes = (struct zr_plane *)(uintptr_t)f->planes.at;
    struct zr_border *borders = (struct zr_border *)(uintptr_t)f->borders.at;
    for (int k = 0; k < 2; k++)
        for (uint32_t i = 0; i < counts[k]; i++) {
            holes[k][i].at = zr_dvec3_add_scaled(holes[k][i].at, origin, 1.0);
            holes[k][i].pattern.center = zr_dvec3_add_scaled(holes[k][i].pattern.center, origin, 1.0);
        }
    for (uint32_t i = 0; i < f->planes.count; i++)
        planes[i].offset += zr_dvec3_dot(planes[i].normal, origin);
    for (uint32_t i = 0; i < f->borders.count; i++)
        borders[i].center = zr_dvec3_add_scaled(borders[i].center, origin, 1.0);
    f->cylinder.at = zr_dvec3_add_scaled(f->cylinder.at, origin, 1.0);
    f->symmetry.center = zr_dvec3_add_scaled(f->symmetry.center, origin, 1.0);
}

static enum zr_status find_of_part(const struct finding *f, struct zr_arena *arena, const struct cut_mesh *cut,
                                   uint32_t number)
{
    const struct zr_part *part = &f->parts->at[number];
    const struct zr_mesh *mesh = &f->scene->meshes[part->mesh];
    const zr_mat4 *matrix = &f->scene->instances[part->instance].object_to_world;
    const bool is_turned = (f->facts[number].is_closed && f->facts[number].volume < 0.0) != zr_mat4_is_mirror(matrix);
    struct zr_part_features *out = &f->features[number];
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct zr_surface surface;
    zr_dvec3 origin = {0, 0, 0};
    bool ok = true;
    if (make_surface(&scratch, f->run->cancel, mesh, cut, part->number, matrix, is_turned, &surface, &origin)) {
        const uint64_t steps =
            ZR_FEATURE_STEPS_MIN / f->parts->count + ZR_FEATURE_STEPS * (uint64_t)surface.triangle_count;
        out->size = surface.size;
        out->steps_most = steps;
        find_of_surface(&scratch, f->run->team, f->run->cancel, &surface, steps, out);
        out->tunnels.is_known = out->tunnels.is_known && !f->facts[number].has_overlap;
        place(out, origin);
        ok = keep(arena, &scratch, out);
    }
    ok = ok && zr_arena_ok(&scratch);
    zr_arena_close_scratch(&scratch, arena);
    if (zr_is_cancelled(f->run->cancel)) return ZR_CANCELLED;
    return ok && zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Returns an upper bound of the scratch for a mesh. */
static size_t bytes_of(const struct zr_mesh *mesh)
{
    const size_t corners = mesh->face_offsets[mesh->face_count], faces = mesh->face_count;
    const size_t rings = mesh->face_rings ? mesh->face_rings[faces] : faces;
    const size_t triangles = corners + 2 * rings > 4 * faces ? corners + 2 * rings - 4 * faces : 0;
    return ZR_FEATURE_BYTES * triangles + ZR_FEATURE_BYTES_OF_POSITION * (size_t)mesh->position_count +
           ZR_FEATURE_BYTES_LEAST;
}

/* Finds the features of the parts from `begin` to `end`, which are of one mesh. */
static enum zr_status find_of_mesh(const struct finding *f, uint32_t begin, uint32_t end)
{
    const struct zr_mesh *mesh = &f->scene->meshes[f->parts->at[begin].mesh];
    const enum zr_feature_limit limit = mesh->face_count > ZR_FEATURE_FACES_MOST        ? ZR_FEATURE_LIMIT_FACES
                                        : bytes_of(mesh) > zr_arena_left(f->run->arena) ? ZR_FEATURE_LIMIT_MEMORY
                                                                                        : ZR_FEATURE_LIMIT_NONE;
    for (uint32_t p = begin; p < end; p++)
        f->features[p] = (struct zr_part_features){.is_omitted = limit != ZR_FEATURE_LIMIT_NONE, .limit = limit};
    if (f->features[begin].is_omitted) return ZR_OK;
    struct zr_arena scratch = zr_arena_open_scratch(f->run->arena);
    const struct zr_run inner = zr_run_in(f->run, &scratch);
    struct cut_mesh cut;
    enum zr_status status = cut_mesh(&inner, mesh, &cut);
    for (uint32_t p = begin; p < end && status == ZR_OK; p++)
        status = find_of_part(f, &scratch, &cut, p);
    for (uint32_t p = begin; p < end && status == ZR_OK; p++)
        if (!keep(f->run->arena, &scratch, &f->features[p])) status = ZR_NO_MEMORY;
    zr_arena_close_scratch(&scratch, f->run->arena);
    return status;
}

enum zr_status zr_part_features_find(const struct zr_run *run, const struct zr_scene *scene,
                                     const struct zr_part_list *parts, const struct zr_part_facts *facts,
                                     struct zr_part_features *features)
{
    const struct finding f = {run, scene, parts, facts, features};
    enum zr_status status = ZR_OK;
    for (uint32_t p = 0, next; p < parts->count && status == ZR_OK; p = next) {
        for (next = p + 1; next < parts->count && parts->at[next].mesh == parts->at[p].mesh; next++) {
        }
        status = find_of_mesh(&f, p, next);
    }
    return status;
}
