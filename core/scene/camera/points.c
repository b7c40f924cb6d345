#include "scene/camera/points.h"

#include <string.h>

#include "scene/camera/camera.h"

/* Least points of a claim, a fraction of a millisecond of work; claims per thread. */
enum { POINTS_PER_RANGE = 1 << 14, RANGES_PER_THREAD = 8 };

/* Points per call of `measure`. */
enum { POINTS_AT_ONCE = 256 };

/* Maxima of one thread, padded to separate cache lines. */
struct found {
    double most[ZR_MEASURES];
    char apart[128 - ZR_MEASURES * sizeof(double)];
};

struct search {
    const struct zr_points *points;
    zr_points_measure_fn *measure;
    const void *context;
    struct found *found; /* one per thread */
};

static bool is_selected(const struct zr_points *points, uint32_t mesh)
{
    const struct zr_view *view = points->view;
    const uint32_t *owners = points->scene->mesh_owners;
    return !points->fitted_only || !view->fit_to_mesh || view->fit_mesh == (owners ? owners[mesh] : mesh);
}

static bool shows_some(const struct zr_points *points, const struct zr_mesh *mesh)
{
    return mesh->shown && !points->with_hidden;
}

static uint32_t shown_count(const struct zr_points *points, const struct zr_mesh *mesh)
{
    return shows_some(points, mesh) ? mesh->shown_count : mesh->position_count;
}

static size_t count_points(const struct zr_points *points)
{
    const struct zr_scene *scene = points->scene;
    size_t count = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const uint32_t mesh = scene->instances[i].mesh;
        if (is_selected(points, mesh)) count += shown_count(points, &scene->meshes[mesh]);
    }
    return count;
}

/* zr_mat4_apply for many points, in the same order of sums, by columns of the matrix. */
static void transform_all(const zr_mat4 *m, const zr_vec4 *positions, uint32_t count, zr_vec4 *out)
{
    const zr_four x = zr_four_load(m->m), y = zr_four_load(m->m + 4), z = zr_four_load(m->m + 8),
                  w = zr_four_load(m->m + 12);
    for (uint32_t i = 0; i < count; i++) {
        const zr_vec4 *v = &positions[i];
        zr_four_store(&out[i], ((x * v->x + y * v->y) + z * v->z) + w * v->w);
    }
}

/* Searches points begin..end-1 of an instance. Most scenes are one mesh with an identity matrix: to skip the transform
 * saves a tenth of the time of an STL of 70 000 triangles at 640x480. */
static void search_instance(const struct search *search, const struct zr_instance *instance, size_t begin, size_t end,
                            double most[ZR_MEASURES])
{
    const struct zr_points *points = search->points;
    const struct zr_mesh *mesh = &points->scene->meshes[instance->mesh];
    const zr_vec4 *positions = shows_some(points, mesh) ? mesh->shown : mesh->positions;
    const zr_mat4 identity = zr_mat4_identity(), *to_eye = points->world_to_eye;
    const zr_mat4 matrix = to_eye ? zr_mat4_mul(to_eye, &instance->object_to_world) : instance->object_to_world;
    const bool moves = memcmp(&matrix, &identity, sizeof identity) != 0;
    zr_vec4 moved[POINTS_AT_ONCE];
    for (size_t first = begin; first < end && !zr_is_cancelled(points->cancel); first += POINTS_AT_ONCE) {
        const uint32_t count = end - first < POINTS_AT_ONCE ? (uint32_t)(end - first) : POINTS_AT_ONCE;
        if (moves) transform_all(&matrix, positions + first, count, moved);
        search->measure(search->context, zr_team_isa(points->team), moves ? moved : positions + first, count, most);
    }
}

/* Searches a range of points, which are numbered over all selected instances. */
static void search_range(void *context, int worker, size_t begin, size_t end)
{
    const struct search *search = context;
    const struct zr_scene *scene = search->points->scene;
    size_t first = 0;
    for (uint32_t i = 0; i < scene->instance_count && first < end; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        if (!is_selected(search->points, instance->mesh)) continue;
        const size_t after = first + shown_count(search->points, &scene->meshes[instance->mesh]);
        if (after > begin)
            search_instance(search, instance, begin > first ? begin - first : 0, (end < after ? end : after) - first,
                            search->found[worker].most);
        first = after;
    }
}

/* Measures the corners of the bounds. */
static void search_corners(const struct zr_points *points, zr_points_measure_fn *measure, const void *context,
                           double most[ZR_MEASURES])
{
    const zr_vec3 ends[2] = {points->corners->min, points->corners->max};
    zr_vec4 corners[8];
    for (int i = 0; i < 8; i++)
        corners[i] = (zr_vec4){ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z, 1.0f};
    if (points->world_to_eye) transform_all(points->world_to_eye, corners, 8, corners);
    for (int k = 0; k < ZR_MEASURES; k++)
        most[k] = -HUGE_VAL;
    measure(context, zr_team_isa(points->team), corners, 8, most);
    for (int k = 0; k < ZR_MEASURES; k++)
        most[k] += 0.0; /* makes -0 positive */
}

void zr_points_most(const struct zr_points *points, zr_points_measure_fn *measure, const void *context,
                    double most[ZR_MEASURES])
{
    if (points->corners) {
        search_corners(points, measure, context, most);
        return;
    }
    struct found found[ZR_TEAM_MAX];
    struct search search = {points, measure, context, found};
    const size_t count = count_points(points), threads = (size_t)zr_team_size(points->team);
    /* Few ranges: each call of search_range skips instances from the first one on. */
    size_t range = threads > 1 ? count / (threads * RANGES_PER_THREAD) : count;
    if (range < POINTS_PER_RANGE) range = POINTS_PER_RANGE;
    for (size_t t = 0; t < threads; t++)
        for (int k = 0; k < ZR_MEASURES; k++)
            found[t].most[k] = -HUGE_VAL;
    zr_team_shares(points->team, count, range, search_range, &search);
    for (int k = 0; k < ZR_MEASURES; k++) {
        most[k] = -HUGE_VAL;
        for (size_t t = 0; t < threads; t++)
            zr_raise(&most[k], found[t].most[k]);
        most[k] += 0.0; /* makes -0 positive */
    }
}
