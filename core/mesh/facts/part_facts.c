#include "mesh/facts/part_facts.h"

#include "base/cancel.h"
#include "base/run.h"
#include "mesh/facts/closed_parts.h"
#include "mesh/facts/least_wall.h"
#include "mesh/facts/overlap.h"
#include "mesh/world_place.h"

/* Faces by part, and closed parts; made once per mesh. */
struct sorted_mesh {
    const uint32_t *faces; /* NULL: all faces in order */
    const uint32_t *ends;  /* per part: end of its faces; NULL: one part */
    uint8_t *closed;       /* per part; NULL: not made yet */
    struct zr_shells *shells;
};

/* Sums over the faces of a task. */
struct sums {
    double area, volume, color[3], plain_color[3]; /* color: times the area */
    double moment[3];                              /* of the volume around the apex */
    double min[3], max[3];
    uint64_t triangles, faces;
    bool is_lost;    /* a corner of a face is not finite */
    bool has_excess; /* of a part: is taken off (mesh/facts/overlap.h) */
    double volume_error;
};

struct task {
    uint32_t part; /* index into the list of parts */
    uint32_t begin, end;
    struct sums sums;
};

struct measuring {
    const struct zr_scene *scene;
    const struct zr_part_list *parts;
    const struct zr_cancel *cancel;
    const struct sorted_mesh *meshes;
    struct task *tasks;
};

/* ---- faces ---- */

static void extend(struct sums *sums, struct zr_world_place p)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        if (at[k] < sums->min[k]) sums->min[k] = at[k];
        if (at[k] > sums->max[k]) sums->max[k] = at[k];
    }
}

/* Sums of one ring: twice its area vector, twice its triangles' areas, six times the volume of its pyramid, and 24
 * times the moment of that volume around the apex. */
struct fan {
    struct zr_world_place area, moment;
    double areas, volume;
    bool turns_both_ways;
};

/* Adds a fan to the sums. False if a corner is not finite. */
static bool sum_fan(const zr_mat4 *m, const struct zr_mesh *mesh, uint32_t begin, uint32_t end,
                    struct zr_world_place apex, struct sums *sums, struct fan *fan)
{
    const uint32_t *corners = mesh->indices;
    struct zr_world_place first, last, next;
    *fan = (struct fan){.areas = 0.0};
    if (!zr_world_place_of(m, mesh->positions[corners[begin]], &first)) return false;
    if (!zr_world_place_of(m, mesh->positions[corners[begin + 1]], &last)) return false;
    extend(sums, first);
    extend(sums, last);
    for (uint32_t i = begin + 2; i < end; i++, last = next) {
        if (!zr_world_place_of(m, mesh->positions[corners[i]], &next)) return false;
        extend(sums, next);
        const struct zr_world_place area =
            zr_world_place_cross(zr_world_place_minus(last, first), zr_world_place_minus(next, first));
        fan->turns_both_ways = fan->turns_both_ways || zr_world_place_dot(area, fan->area) < 0.0;
        fan->area = (struct zr_world_place){fan->area.x + area.x, fan->area.y + area.y, fan->area.z + area.z};
        fan->areas += sqrt(zr_world_place_dot(area, area));
        const double volume = zr_world_place_dot(zr_world_place_minus(first, apex), area);
        fan->volume += volume;
        fan->moment.x += volume * (((first.x - apex.x) + (last.x - apex.x)) + (next.x - apex.x));
        fan->moment.y += volume * (((first.y - apex.y) + (last.y - apex.y)) + (next.y - apex.y));
        fan->moment.z += volume * (((first.z - apex.z) + (last.z - apex.z)) + (next.z - apex.z));
    }
    if (fan->turns_both_ways) fan->areas = sqrt(zr_world_place_dot(fan->area, fan->area));
    return true;
}

/* Returns the product of the colours of the face's material, the face, and the mean of its corners. */
static void color_of(const struct zr_scene *scene, const struct zr_mesh *mesh, uint32_t face, double color[3])
{
    const struct zr_material *material = zr_material_of_face(scene, mesh, face);
    const zr_vec4 *own = mesh->face_colors ? &mesh->face_colors[face] : NULL;
    const uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    double sum[3] = {0, 0, 0};
    color[0] = (double)material->base_color.x * (own ? (double)own->x : 1.0);
    color[1] = (double)material->base_color.y * (own ? (double)own->y : 1.0);
    color[2] = (double)material->base_color.z * (own ? (double)own->z : 1.0);
    if (!mesh->colors || material->uniform_color) return;
    for (uint32_t i = begin; i < end; i++) {
        const zr_vec4 *at = &mesh->colors[mesh->indices[i]];
        sum[0] += (double)at->x;
        sum[1] += (double)at->y;
        sum[2] += (double)at->z;
    }
    for (int k = 0; k < 3; k++)
        color[k] *= sum[k] / (double)(end - begin);
}

static void add_face(const struct measuring *m, const zr_mat4 *matrix, const struct zr_mesh *mesh, uint32_t face,
                     struct zr_world_place apex, struct sums *sums)
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    double area = 0.0, volume = 0.0, moment[3] = {0, 0, 0}, color[3];
    color_of(m->scene, mesh, face, color);
    sums->faces++;
    sums->triangles += rings.offsets[rings.count] - rings.offsets[0] + 2 * (uint64_t)(rings.count - 1) - 2;
    for (int k = 0; k < 3; k++)
        sums->plain_color[k] += color[k];
    for (uint32_t r = 0; r < rings.count; r++) {
        struct fan fan;
        if (!sum_fan(matrix, mesh, rings.offsets[r], rings.offsets[r + 1], apex, sums, &fan)) {
            sums->is_lost = true;
            return;
        }
        area += r > 0 ? -fan.areas : fan.areas;
        const double sign = r > 0 && zr_ring_turns_as_first(mesh, &rings, r) ? -1.0 : 1.0;
        volume += sign * fan.volume;
        moment[0] += sign * fan.moment.x;
        moment[1] += sign * fan.moment.y;
        moment[2] += sign * fan.moment.z;
    }
    area = area > 0.0 ? 0.5 * area : 0.0;
    sums->area += area;
    sums->volume += volume / 6.0;
    for (int k = 0; k < 3; k++) {
        sums->color[k] += area * color[k];
        sums->moment[k] += moment[k] / 24.0;
    }
}

/* ---- tasks ---- */

static uint32_t face_of(const struct sorted_mesh *sorted, uint32_t number)
{
    return sorted->faces ? sorted->faces[number] : number;
}

/* Returns the first face of a part in the sorted order. */
static uint32_t begin_of(const struct sorted_mesh *sorted, uint32_t part)
{
    return sorted->ends && part > 0 ? sorted->ends[part - 1] : 0;
}

static uint32_t end_of(const struct sorted_mesh *sorted, const struct zr_mesh *mesh, uint32_t part)
{
    return sorted->ends ? sorted->ends[part] : mesh->face_count;
}

static void clear(struct sums *sums)
{
    *sums = (struct sums){.area = 0.0};
    for (int k = 0; k < 3; k++) {
        sums->min[k] = HUGE_VAL;
        sums->max[k] = -HUGE_VAL;
    }
}

/* Returns the apex of the pyramids of a part with faces: the first corner of its first face. */
static struct zr_world_place apex_of(const struct measuring *m, const struct zr_part *part)
{
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const struct sorted_mesh *sorted = &m->meshes[part->mesh];
    const zr_mat4 *matrix = &m->scene->instances[part->instance].object_to_world;
    const uint32_t first = face_of(sorted, begin_of(sorted, part->number));
    struct zr_world_place apex;
    if (!zr_world_place_of(matrix, mesh->positions[mesh->indices[mesh->face_offsets[first]]], &apex))
        return (struct zr_world_place){0, 0, 0};
    return apex;
}

static void run_task(const struct measuring *m, struct task *task)
{
    const struct zr_part *part = &m->parts->at[task->part];
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const struct sorted_mesh *sorted = &m->meshes[part->mesh];
    const zr_mat4 *matrix = &m->scene->instances[part->instance].object_to_world;
    const struct zr_world_place apex = apex_of(m, part);
    clear(&task->sums);
    for (uint32_t i = task->begin; i < task->end; i++)
        add_face(m, matrix, mesh, face_of(sorted, i), apex, &task->sums);
}

static void run_range(void *context, size_t begin, size_t end)
{
    const struct measuring *m = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(m->cancel); i++)
        run_task(m, &m->tasks[i]);
}

/* Lists the tasks of all parts; with `tasks` NULL, counts them. */
static size_t list_tasks(const struct measuring *m, struct task *tasks)
{
    size_t count = 0;
    for (uint32_t p = 0; p < m->parts->count; p++) {
        const struct zr_part *part = &m->parts->at[p];
        const struct sorted_mesh *sorted = &m->meshes[part->mesh];
        const uint32_t end = end_of(sorted, &m->scene->meshes[part->mesh], part->number);
        for (uint32_t at = begin_of(sorted, part->number), left; at < end; at += left, count++) {
            left = end - at < ZR_FACES_PER_TASK ? end - at : ZR_FACES_PER_TASK;
            if (tasks) tasks[count] = (struct task){.part = p, .begin = at, .end = at + left};
        }
    }
    return count;
}

/* ---- meshes ---- */

/* Sorts the faces by part, in the order of faces. */
static void sort_faces(struct zr_arena *arena, const struct zr_mesh *mesh, const struct zr_cancel *cancel,
                       struct sorted_mesh *out)
{
    enum { FACES_PER_CANCEL_CHECK = 1 << 16 };
    uint32_t *ends = zr_arena_zero(arena, mesh->part_count, sizeof *ends);
    uint32_t *faces = zr_arena_alloc(arena, mesh->face_count, sizeof *faces);
    if (!ends || !faces) return;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        if (f % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        ends[mesh->face_parts[f]]++;
    }
    for (uint32_t p = 1; p < mesh->part_count; p++)
        ends[p] += ends[p - 1];
    for (uint32_t f = mesh->face_count; f-- > 0;) {
        if (f % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        faces[--ends[mesh->face_parts[f]]] = f;
    }
    for (uint32_t p = 0; p + 1 < mesh->part_count; p++) /* begins to ends */
        ends[p] = ends[p + 1];
    if (mesh->part_count > 0) ends[mesh->part_count - 1] = mesh->face_count;
    out->ends = ends;
    out->faces = faces;
}

static enum zr_status sort_meshes(const struct zr_run *run, const struct measuring *m, struct sorted_mesh *meshes)
{
    for (uint32_t p = 0; p < m->parts->count; p++) {
        const uint32_t number = m->parts->at[p].mesh;
        const struct zr_mesh *mesh = &m->scene->meshes[number];
        struct sorted_mesh *sorted = &meshes[number];
        if (sorted->closed) continue;
        sorted->closed = zr_arena_alloc(run->arena, zr_mesh_part_count(mesh), 1);
        sorted->shells = zr_arena_alloc(run->arena, zr_mesh_part_count(mesh), sizeof *sorted->shells);
        if (mesh->face_parts) sort_faces(run->arena, mesh, m->cancel, sorted);
        if (!zr_arena_ok(run->arena) || !zr_closed_parts_find(run, mesh, sorted->closed, sorted->shells))
            return zr_is_cancelled(m->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
        if (zr_is_cancelled(m->cancel)) return ZR_CANCELLED;
    }
    return ZR_OK;
}

/* ---- results ---- */

static void add_sums(struct sums *sum, const struct sums *more)
{
    sum->area += more->area;
    sum->volume += more->volume;
    sum->triangles += more->triangles;
    sum->faces += more->faces;
    sum->is_lost = sum->is_lost || more->is_lost;
    for (int k = 0; k < 3; k++) {
        sum->color[k] += more->color[k];
        sum->moment[k] += more->moment[k];
        sum->plain_color[k] += more->plain_color[k];
        if (more->min[k] < sum->min[k]) sum->min[k] = more->min[k];
        if (more->max[k] > sum->max[k]) sum->max[k] = more->max[k];
    }
}

/* Adds an end of a line, or a point. */
static void add_vertex(const struct zr_material *material, const zr_mat4 *matrix, const struct zr_mesh *mesh,
                       uint32_t vertex, struct sums *sums, uint64_t *count)
{
    const zr_vec4 white = {1, 1, 1, 1}, *own = mesh->colors ? &mesh->colors[vertex] : &white,
                  *base = &material->base_color;
    struct zr_world_place place;
    if (zr_world_place_of(matrix, mesh->positions[vertex], &place)) extend(sums, place);
    if (sums->faces > 0) return;
    (*count)++;
    sums->plain_color[0] += (double)own->x * (double)base->x;
    sums->plain_color[1] += (double)own->y * (double)base->y;
    sums->plain_color[2] += (double)own->z * (double)base->z;
}

/* Adds the lines and points of a mesh that is one part. Returns the number of colours in sums->plain_color. */
static uint64_t add_vertices(const struct measuring *m, const struct zr_part *part, struct sums *sums)
{
    enum { VERTICES_PER_CANCEL_CHECK = 1 << 14 };
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const struct zr_material *material = &m->scene->materials[mesh->material];
    const zr_mat4 *matrix = &m->scene->instances[part->instance].object_to_world;
    uint64_t count = 0;
    if (mesh->face_parts) return sums->faces;
    for (uint32_t i = 0; i < 2 * mesh->line_count; i++) {
        if (i % VERTICES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel)) return 1;
        add_vertex(material, matrix, mesh, mesh->lines[i], sums, &count);
    }
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        if (i % VERTICES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel)) return 1;
        add_vertex(material, matrix, mesh, zr_mesh_point(mesh, i), sums, &count);
    }
    return sums->faces + count;
}

static float clamped(double value)
{
    return value > 0.0 ? value < 1.0 ? (float)value : 1.0f : 0.0f;
}

/* All shells of a part with a lost face are open. */
static struct zr_shells shells_of(const struct zr_shells *found, bool is_lost)
{
    if (!is_lost) return *found;
    return (struct zr_shells){.open = found->outward + found->inward + found->flat + found->open};
}

/* Sets the centre of mass of a closed part with a volume. */
static void find_center(const struct measuring *m, const struct zr_part *part, const struct sums *sums,
                        struct zr_part_facts *facts)
{
    if (!facts->is_closed || sums->volume == 0.0 || sums->faces == 0) return;
    const struct zr_world_place apex = apex_of(m, part);
    facts->center[0] = (apex.x + sums->moment[0] / sums->volume) + 0.0;
    facts->center[1] = (apex.y + sums->moment[1] / sums->volume) + 0.0;
    facts->center[2] = (apex.z + sums->moment[2] / sums->volume) + 0.0;
    facts->has_center = isfinite(facts->center[0]) && isfinite(facts->center[1]) && isfinite(facts->center[2]);
}

static struct zr_wall_faces faces_of(const struct measuring *m, const struct zr_part *part)
{
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const struct sorted_mesh *sorted = &m->meshes[part->mesh];
    return (struct zr_wall_faces){.mesh = mesh,
                                  .object_to_world = &m->scene->instances[part->instance].object_to_world,
                                  .faces = sorted->faces,
                                  .begin = begin_of(sorted, part->number),
                                  .end = end_of(sorted, mesh, part->number)};
}

static bool is_closed(const struct measuring *m, const struct zr_part *part, const struct sums *sums)
{
    return m->meshes[part->mesh].closed[part->number] && !sums->is_lost && sums->faces > 0;
}

/* Takes what shells of a closed part count too often or against one another off its sums. False without memory, or if
 * cancelled. */
static bool take_off_excess(struct zr_arena *arena, const struct measuring *m, const struct zr_part *part,
                            struct sums *sums)
{
    if (!is_closed(m, part, sums)) return true;
    const struct zr_wall_faces faces = faces_of(m, part);
    const uint64_t shared = ZR_OVERLAP_WORK / m->parts->count;
    struct zr_overlap_box box = {.apex = apex_of(m, part),
                                 .work = ZR_OVERLAP_WORK_OF_TRIANGLE * sums->triangles +
                                         (shared > ZR_OVERLAP_WORK_LEAST ? shared : ZR_OVERLAP_WORK_LEAST)};
    struct zr_overlap excess;
    memcpy(box.min, sums->min, sizeof box.min);
    memcpy(box.max, sums->max, sizeof box.max);
    if (!zr_overlap_find(arena, m->cancel, &faces, &box, &excess)) return false;
    sums->has_excess = excess.is_found;
    sums->volume -= excess.volume;
    sums->volume_error = excess.error;
    for (int k = 0; k < 3; k++)
        sums->moment[k] -= excess.moment[k];
    return true;
}

/* Finds the least wall of a closed part with a volume. */
static void find_wall(struct zr_arena *arena, const struct measuring *m, const struct zr_part *part,
                      const struct sums *sums, uint64_t *steps, struct zr_part_facts *facts)
{
    if (!facts->is_closed || sums->volume == 0.0 || sums->faces == 0) return;
    struct zr_wall_faces faces = faces_of(m, part);
    faces.is_turned = sums->volume < 0.0;
    facts->least_wall = zr_least_wall_find(arena, m->cancel, &faces, steps);
}

/* Returns the corner before another one in the ring of a face. */
static uint32_t slot_before(const struct zr_mesh *mesh, uint32_t slot)
{
    const uint32_t *ends = mesh->face_rings ? mesh->ring_offsets : mesh->face_offsets;
    uint32_t low = 0, high = mesh->face_rings ? mesh->face_rings[mesh->face_count] : mesh->face_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (ends[middle] <= slot)
            low = middle;
        else
            high = middle;
    }
    return slot > ends[low] ? slot - 1 : ends[low + 1] - 1;
}

static struct zr_edge_facts edges_of(const struct measuring *m, const struct zr_part *part, struct zr_odd_edges odd)
{
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const zr_mat4 *matrix = &m->scene->instances[part->instance].object_to_world;
    struct zr_edge_facts edges = {.count = odd.count};
    struct zr_world_place from, to;
    if (odd.count == 0) return edges;
    zr_world_place_of(matrix, mesh->positions[mesh->indices[slot_before(mesh, odd.at)]], &from);
    zr_world_place_of(matrix, mesh->positions[mesh->indices[odd.at]], &to);
    edges.at[0] = 0.5 * (from.x + to.x);
    edges.at[1] = 0.5 * (from.y + to.y);
    edges.at[2] = 0.5 * (from.z + to.z);
    return edges;
}

/* All faces of a part, or all lines and points of a mesh without faces, are hidden alike (scene/parts/part_edit.h). */
static bool is_hidden(const struct measuring *m, const struct zr_part *part)
{
    const struct zr_mesh *mesh = &m->scene->meshes[part->mesh];
    const struct sorted_mesh *sorted = &m->meshes[part->mesh];
    const uint32_t begin = begin_of(sorted, part->number);
    if (begin < end_of(sorted, mesh, part->number))
        return zr_material_of_face(m->scene, mesh, face_of(sorted, begin))->is_hidden;
    return !mesh->face_parts && m->scene->materials[mesh->material].is_hidden;
}

static struct zr_part_facts facts_of(const struct measuring *m, const struct zr_part *part, struct sums *sums)
{
    const zr_mat4 *matrix = &m->scene->instances[part->instance].object_to_world;
    const uint64_t colors = add_vertices(m, part, sums);
    const double weight = sums->area > 0.0 ? sums->area : colors > 0 ? (double)colors : 1.0;
    const double *color = sums->area > 0.0 ? sums->color : sums->plain_color;
    const struct zr_shells *shells = &m->meshes[part->mesh].shells[part->number];
    struct zr_part_facts facts = {.is_hidden = is_hidden(m, part),
                                  .has_box = sums->min[0] <= sums->max[0],
                                  .triangles = sums->triangles,
                                  .area = sums->area,
                                  .is_closed = m->meshes[part->mesh].closed[part->number] && !sums->is_lost};
    facts.shells = shells_of(shells, sums->is_lost);
    facts.open_edges = edges_of(m, part, shells->open_edges);
    facts.flipped_edges = edges_of(m, part, shells->flipped_edges);
    facts.color = (zr_vec3){clamped(color[0] / weight), clamped(color[1] / weight), clamped(color[2] / weight)};
    if (facts.is_closed) facts.volume = zr_mat4_is_mirror(matrix) ? 0.0 - sums->volume : sums->volume + 0.0;
    facts.has_overlap = sums->has_excess;
    facts.volume_error = sums->volume_error;
    find_center(m, part, sums, &facts);
    if (!facts.has_box) return facts;
    facts.min = (zr_vec3){(float)(sums->min[0] + 0.0), (float)(sums->min[1] + 0.0), (float)(sums->min[2] + 0.0)};
    facts.max = (zr_vec3){(float)(sums->max[0] + 0.0), (float)(sums->max[1] + 0.0), (float)(sums->max[2] + 0.0)};
    return facts;
}

static enum zr_status find(const struct zr_run *run, struct measuring *m, struct zr_part_facts *facts)
{
    struct sorted_mesh *meshes = zr_arena_zero(run->arena, m->scene->mesh_count, sizeof *meshes);
    if (!meshes) return ZR_NO_MEMORY;
    m->meshes = meshes;
    const enum zr_status status = sort_meshes(run, m, meshes);
    if (status != ZR_OK) return status;
    const size_t count = list_tasks(m, NULL);
    m->tasks = zr_arena_alloc(run->arena, count, sizeof *m->tasks);
    if (!m->tasks) return ZR_NO_MEMORY;
    list_tasks(m, m->tasks);
    zr_team_ranges(run->team, count, 1, run_range, m);
    uint64_t steps = ZR_WALL_STEPS_MIN;
    for (uint32_t i = 0; i < count; i++)
        steps += ZR_WALL_STEPS * m->tasks[i].sums.triangles;
    size_t task = 0;
    for (uint32_t p = 0; p < m->parts->count && !zr_is_cancelled(m->cancel); p++) {
        struct sums sums;
        clear(&sums);
        for (; task < count && m->tasks[task].part == p; task++)
            add_sums(&sums, &m->tasks[task].sums);
        if (!take_off_excess(run->arena, m, &m->parts->at[p], &sums))
            return zr_is_cancelled(m->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
        facts[p] = facts_of(m, &m->parts->at[p], &sums);
        find_wall(run->arena, m, &m->parts->at[p], &sums, &steps, &facts[p]);
    }
    return zr_is_cancelled(m->cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_part_facts_find(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_part_list *parts, struct zr_part_facts *facts)
{
    struct measuring m = {.scene = scene, .parts = parts, .cancel = run->cancel};
    return find(run, &m, facts);
}
