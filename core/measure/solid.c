#include "measure/solid.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "mesh/edge_mesh.h"
#include "scene/parts/part_list.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 13 };

/* All instances as one mesh. */
struct joining {
    const struct zr_run *run;
    struct zr_arena *scratch;
    const struct zr_scene *scene;
    struct zr_world_place *places; /* per position */
    zr_vec4 *positions;            /* the same, rounded, relative to the middle */
    uint32_t *offsets, *rings, *ring_offsets, *indices;
    uint32_t *parts; /* per face */
    uint32_t position_count, face_count, ring_count, corner_count;
    bool is_lost; /* a face has a corner beyond the range of float */
};

static bool is_due(const struct zr_run *run, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel);
}

static bool is_turned(const struct zr_scene *scene)
{
    return scene->file.up && strcmp(scene->file.up, "z") == 0;
}

/* Returns a place in the file. Readers turn files whose z points up, and subtract the origin. */
static struct zr_world_place place_in_file(const struct zr_scene *scene, struct zr_world_place at)
{
    if (is_turned(scene)) at = (struct zr_world_place){at.x, -at.z, at.y};
    if (!scene->origin) return at;
    return (struct zr_world_place){at.x + scene->origin[0], at.y + scene->origin[1], at.z + scene->origin[2]};
}

/* ---- joining instances ---- */

static bool make_room(struct joining *j, struct zr_arena *arena)
{
    uint64_t positions = 0, faces = 0, rings = 0, corners = 0;
    for (uint32_t i = 0; i < j->scene->instance_count; i++) {
        const struct zr_mesh *mesh = &j->scene->meshes[j->scene->instances[i].mesh];
        if (mesh->face_count == 0) continue;
        positions += mesh->position_count;
        faces += mesh->face_count;
        rings += mesh->face_rings ? mesh->face_rings[mesh->face_count] : mesh->face_count;
        corners += mesh->face_offsets[mesh->face_count];
    }
    if (positions > UINT32_MAX || rings + corners > UINT32_MAX / 4) return zr_arena_charge(arena, SIZE_MAX); /* fails */
    j->places = zr_arena_alloc_beside(arena, j->scratch, positions, sizeof *j->places);
    j->positions = zr_arena_alloc(j->scratch, positions, sizeof *j->positions);
    j->offsets = zr_arena_alloc(j->scratch, faces + 1, sizeof *j->offsets);
    j->rings = zr_arena_alloc(j->scratch, faces + 1, sizeof *j->rings);
    j->parts = zr_arena_alloc(j->scratch, faces, sizeof *j->parts);
    j->ring_offsets = zr_arena_alloc(j->scratch, rings + 1, sizeof *j->ring_offsets);
    j->indices = zr_arena_alloc(j->scratch, corners, sizeof *j->indices);
    return zr_arena_ok(arena) && zr_arena_ok(j->scratch);
}

/* Adds the rings of a face, turned round if the instance is mirrored. */
static void add_face(struct joining *j, const struct zr_mesh *mesh, uint32_t face, bool is_mirrored, uint32_t part)
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const uint32_t first = j->position_count;
    for (uint32_t i = rings.offsets[0]; i < rings.offsets[rings.count]; i++)
        if (isnan(j->places[first + mesh->indices[i]].x)) {
            j->is_lost = true;
            return;
        }
    j->offsets[j->face_count] = j->corner_count;
    j->rings[j->face_count] = j->ring_count;
    j->parts[j->face_count++] = part;
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t begin = rings.offsets[r], end = rings.offsets[r + 1];
        j->ring_offsets[j->ring_count++] = j->corner_count;
        for (uint32_t i = begin; i < end; i++)
            j->indices[j->corner_count++] = first + mesh->indices[is_mirrored ? end - 1 - (i - begin) : i];
    }
}

/* Adds an instance, whose parts have numbers from `part` on. */
static void add_instance(struct joining *j, const struct zr_instance *instance, uint32_t part)
{
    const struct zr_mesh *mesh = &j->scene->meshes[instance->mesh];
    const bool is_mirrored = zr_mat4_is_mirror(&instance->object_to_world);
    struct zr_world_place *places = j->places + j->position_count;
    for (uint32_t i = 0; i < mesh->position_count && !is_due(j->run, i); i++) {
        struct zr_world_place at;
        if (zr_world_place_of(&instance->object_to_world, mesh->positions[i], &at))
            places[i] = place_in_file(j->scene, at);
        else
            places[i].x = (double)NAN;
    }
    for (uint32_t f = 0; f < mesh->face_count && !is_due(j->run, f); f++)
        if (!zr_material_of_face(j->scene, mesh, f)->is_hidden)
            add_face(j, mesh, f, is_mirrored, part + (mesh->face_parts ? mesh->face_parts[f] : 0));
    j->position_count += mesh->position_count;
}

static void add_instances(struct joining *j)
{
    uint32_t part = 0;
    for (uint32_t i = 0; i < j->scene->instance_count && !zr_is_cancelled(j->run->cancel); i++) {
        const struct zr_mesh *mesh = &j->scene->meshes[j->scene->instances[i].mesh];
        if (mesh->face_count > 0) add_instance(j, &j->scene->instances[i], part);
        part += zr_mesh_part_count(mesh);
    }
    j->offsets[j->face_count] = j->ring_offsets[j->ring_count] = j->corner_count;
    j->rings[j->face_count] = j->ring_count;
}

static void extend(struct zr_solid *solid, struct zr_world_place p)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        solid->min[k] = zr_least_of(solid->min[k], at[k]);
        solid->max[k] = zr_most_of(solid->max[k], at[k]);
    }
}

/* Finds the box, and makes places relative to the middle. */
static void find_middle(struct joining *j, const struct zr_world_place *middle, struct zr_solid *out)
{
    for (int k = 0; k < 3; k++) {
        out->min[k] = HUGE_VAL;
        out->max[k] = -HUGE_VAL;
    }
    for (uint32_t i = 0; i < j->corner_count && !is_due(j->run, i); i++)
        extend(out, j->places[j->indices[i]]);
    if (j->corner_count == 0) memset(out->min, 0, sizeof out->min), memset(out->max, 0, sizeof out->max);
    if (middle)
        out->middle = *middle;
    else
        out->middle = (struct zr_world_place){0.5 * (out->min[0] + out->max[0]), 0.5 * (out->min[1] + out->max[1]),
                                              0.5 * (out->min[2] + out->max[2])};
    const double from[3] = {out->middle.x, out->middle.y, out->middle.z};
    double squares = 0.0;
    for (int k = 0; k < 3; k++) {
        out->min[k] -= from[k];
        out->max[k] -= from[k];
        squares += (out->max[k] - out->min[k]) * (out->max[k] - out->min[k]);
    }
    out->diagonal = sqrt(squares);
    for (uint32_t i = 0; i < j->position_count && !is_due(j->run, i); i++) {
        struct zr_world_place *at = &j->places[i];
        *at = zr_world_place_minus(*at, out->middle);
        j->positions[i] = isnan(at->x) ? (zr_vec4){0, 0, 0, 0} : (zr_vec4){(float)at->x, (float)at->y, (float)at->z, 1};
    }
    out->places = j->places;
    out->place_count = j->position_count;
}

/* ---- facts ---- */

static void measure(const struct zr_run *run, const struct zr_edge_mesh *edges, double *volumes, struct zr_solid *out)
{
    for (uint32_t t = 0; t < out->count && !is_due(run, t); t++) {
        struct zr_world_place p[3];
        zr_solid_places(out, t, p);
        const struct zr_world_place n =
            zr_world_place_cross(zr_world_place_minus(p[1], p[0]), zr_world_place_minus(p[2], p[0]));
        const double volume = zr_world_place_dot(p[0], n); /* six times */
        out->area += sqrt(zr_world_place_dot(n, n));
        out->volume += volume;
        volumes[edges->pieces[t]] += volume;
    }
    out->area /= 2.0;
    out->volume /= 6.0;
}

/* Counts the edges that are odd, and marks their pieces as open. Returns the number of edges that have not two
 * triangles. */
static uint32_t find_odd_edges(const struct zr_run *run, const struct zr_edge_mesh *edges, uint8_t *is_open,
                               struct zr_solid *out)
{
    uint32_t uneven = 0;
    for (uint32_t e = 0; e < edges->edge_count && !is_due(run, e); e++) {
        const uint32_t first = edges->edges[e].first_side, count = zr_edge_side_count(edges, e);
        int64_t upward = 0;
        for (uint32_t i = 0; i < count && !is_due(run, i + 1); i++)
            upward += zr_side_is_upward(edges, edges->sides[first + i]) ? 1 : -1;
        uneven += count != 2;
        if (upward == 0) continue;
        out->odd_edges++;
        for (uint32_t i = 0; i < count; i++)
            is_open[edges->pieces[edges->sides[first + i] / 3]] = 1;
    }
    return uneven;
}

/* A piece has the Euler characteristic 2 - 2 genus; so all pieces together have vertices - edges + triangles. */
static void count_surfaces(const struct zr_edge_mesh *edges, const uint8_t *is_open, const double *volumes,
                           uint32_t uneven, struct zr_solid *out)
{
    for (uint32_t i = 0; i < edges->piece_count; i++)
        *(is_open[i] ? &out->open : volumes[i] < 0.0 ? &out->inward : &out->outward) += 1;
    const int64_t euler = (int64_t)edges->vertex_count - (int64_t)edges->edge_count + (int64_t)edges->triangle_count;
    const int64_t twice = 2 * (int64_t)edges->piece_count - euler;
    out->has_handles = out->is_closed && uneven == 0 && twice >= 0 && twice % 2 == 0;
    out->handles = out->has_handles ? twice / 2 : 0;
}

static bool is_at(struct zr_world_place a, struct zr_world_place b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Replaces corners of one vertex at one place by the first of them, and leaves out places that no corner has. */
static bool join_places(const struct joining *j, uint32_t (*corners)[3], const uint32_t (*vertices)[3],
                        struct zr_solid *out)
{
    uint32_t *firsts = zr_arena_alloc(j->scratch, out->vertex_count, sizeof *firsts);
    uint32_t *numbers = zr_arena_zero(j->scratch, out->place_count, sizeof *numbers), count = 0;
    if (!zr_arena_ok(j->scratch)) return false;
    memset(firsts, 0xff, out->vertex_count * sizeof *firsts);
    for (uint32_t t = 0; t < out->count && !is_due(j->run, t); t++)
        for (int k = 0; k < 3; k++) {
            uint32_t *first = &firsts[vertices[t][k]];
            if (*first == UINT32_MAX) *first = corners[t][k];
            if (is_at(out->places[*first], out->places[corners[t][k]])) corners[t][k] = *first;
            numbers[corners[t][k]] = 1;
        }
    for (uint32_t i = 0; i < out->place_count && !is_due(j->run, i); i++) {
        if (!numbers[i]) continue;
        out->places[count] = out->places[i];
        numbers[i] = count++;
    }
    for (uint32_t t = 0; t < out->count && !is_due(j->run, t); t++)
        for (int k = 0; k < 3; k++)
            corners[t][k] = numbers[corners[t][k]];
    out->place_count = count;
    return true;
}

/* Copies what stays of the triangles. */
static bool take_triangles(const struct joining *j, const struct zr_edge_mesh *edges, struct zr_solid *out)
{
    struct zr_arena *arena = j->run->arena;
    const size_t count = edges->triangle_count;
    uint32_t(*corners)[3] = zr_arena_alloc_beside(arena, j->scratch, count, sizeof *corners);
    uint32_t(*vertices)[3] = zr_arena_alloc_beside(arena, j->scratch, count, sizeof *vertices);
    uint32_t *parts = zr_arena_alloc_beside(arena, j->scratch, count, sizeof *parts);
    if (!zr_arena_ok(arena)) return false;
    for (size_t t = 0; t < count && !is_due(j->run, t); t++) {
        for (size_t k = 0; k < 3; k++) {
            corners[t][k] = j->indices[edges->slots[3 * t + k]];
            vertices[t][k] = edges->corners[3 * t + k];
        }
        parts[t] = j->parts[edges->faces[t]];
    }
    out->corners = (const uint32_t(*)[3])corners;
    out->vertices = (const uint32_t(*)[3])vertices;
    out->parts = parts;
    out->count = edges->triangle_count;
    out->vertex_count = edges->vertex_count;
    return join_places(j, corners, (const uint32_t(*)[3])vertices, out);
}

static enum zr_status find_facts(const struct joining *j, struct zr_solid *out)
{
    const struct zr_run inner = zr_run_in(j->run, j->scratch);
    const bool has_holes = j->ring_count > j->face_count;
    const struct zr_mesh mesh = {.name = "",
                                 .position_count = j->position_count,
                                 .positions = j->positions,
                                 .face_count = j->face_count,
                                 .face_offsets = j->offsets,
                                 .indices = j->indices,
                                 .face_rings = has_holes ? j->rings : NULL,
                                 .ring_offsets = has_holes ? j->ring_offsets : NULL};
    struct zr_edge_mesh edges;
    const enum zr_status status = zr_edge_mesh_make(&inner, &mesh, &edges);
    if (status != ZR_OK) return status;
    uint8_t *is_open = zr_arena_zero(j->scratch, edges.piece_count, 1);
    double *volumes = zr_arena_zero(j->scratch, edges.piece_count, sizeof *volumes);
    if (!zr_arena_ok(j->scratch) || !take_triangles(j, &edges, out)) return ZR_NO_MEMORY;
    measure(j->run, &edges, volumes, out);
    const uint32_t uneven = find_odd_edges(j->run, &edges, is_open, out);
    out->is_closed = !j->is_lost && out->odd_edges == 0 && out->count > 0;
    count_surfaces(&edges, is_open, volumes, uneven, out);
    return zr_is_cancelled(j->run->cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_solid_make(const struct zr_run *run, const struct zr_scene *scene,
                             const struct zr_world_place *middle, struct zr_solid *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    struct joining j = {.run = run, .scratch = &scratch, .scene = scene};
    enum zr_status status = ZR_NO_MEMORY;
    *out = (struct zr_solid){.place_count = 0};
    if (make_room(&j, run->arena)) {
        add_instances(&j);
        find_middle(&j, middle, out);
        status = zr_is_cancelled(run->cancel) ? ZR_CANCELLED : j.face_count == 0 ? ZR_OK : find_facts(&j, out);
    }
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
