#include "sections/sectioned_view.h"

#include <string.h>

#include "base/cancel.h"
#include "scene/camera/extent_view.h"
#include "scene/camera/margins.h"
#include "scene/picture.h"
#include "sections/section_planes.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 12, CORNERS_MOST = 3 + ZR_SECTION_PLANES_MAX };

/* Corners that are left, in world space. */
struct rest {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_section_planes *planes;
    uint8_t *sides; /* per position of an instance: bit k is set if plane k keeps it */
    uint32_t count, room;
    zr_vec4 *points;
};

struct ring {
    uint32_t count;
    double at[CORNERS_MOST][3];
};

static double distance(const struct zr_section_plane *plane, const double p[3])
{
    return ((plane->normal[0] * p[0] + plane->normal[1] * p[1]) + plane->normal[2] * p[2]) + plane->offset;
}

static void add(struct rest *rest, const double p[3])
{
    if (rest->count == rest->room) {
        const uint32_t room = 1024 + 2 * rest->room;
        zr_vec4 *grown = rest->room < UINT32_MAX / 4
                             ? zr_arena_grow(rest->run->arena, rest->points, rest->count, room, sizeof *grown)
                             : NULL;
        if (!grown) return;
        rest->points = grown;
        rest->room = room;
    }
    rest->points[rest->count++] = (zr_vec4){(float)p[0], (float)p[1], (float)p[2], 1.0f};
}

static void place(const struct zr_instance *instance, zr_vec4 position, double out[3])
{
    const zr_vec3 p = zr_vec4_over_w(zr_mat4_apply(&instance->object_to_world, position));
    out[0] = (double)p.x;
    out[1] = (double)p.y;
    out[2] = (double)p.z;
}

/* ---- clipping ---- */

static void clip(struct ring *ring, const struct zr_section_plane *plane)
{
    const struct ring from = *ring;
    ring->count = 0;
    for (uint32_t i = 0; i < from.count; i++) {
        const double *a = from.at[i], *b = from.at[(i + 1) % from.count];
        const double da = distance(plane, a), db = distance(plane, b);
        if (da > 0.0) memcpy(ring->at[ring->count++], a, sizeof ring->at[0]);
        if ((da > 0.0) == (db > 0.0)) continue;
        for (int k = 0; k < 3; k++)
            ring->at[ring->count][k] = a[k] + (b[k] - a[k]) * (da / (da - db));
        ring->count++;
    }
}

static void add_ring(struct rest *rest, const struct ring *ring)
{
    for (uint32_t i = 0; i < ring->count; i++)
        add(rest, ring->at[i]);
}

/* Adds the rest of a triangle that planes cross. In a cut corner, each plane alone leaves a part. */
static void add_clipped(struct rest *rest, const struct ring *triangle)
{
    struct ring ring = *triangle;
    for (uint32_t k = 0; k < rest->planes->count; k++) {
        clip(&ring, &rest->planes->at[k]);
        if (!rest->scene->sections.is_corner) continue;
        add_ring(rest, &ring);
        ring = *triangle;
    }
    if (!rest->scene->sections.is_corner) add_ring(rest, &ring);
}

static void add_triangle(struct rest *rest, const struct zr_instance *instance, const uint32_t corners[3])
{
    const struct zr_mesh *mesh = &rest->scene->meshes[instance->mesh];
    const uint8_t a = rest->sides[corners[0]], b = rest->sides[corners[1]], c = rest->sides[corners[2]];
    struct ring ring = {.count = 3};
    if ((a & b & c) == (a | b | c)) return;
    for (int i = 0; i < 3; i++)
        place(instance, mesh->positions[corners[i]], ring.at[i]);
    add_clipped(rest, &ring);
}

/* ---- instances ---- */

static uint8_t sides_of(const struct rest *rest, const double p[3])
{
    uint8_t sides = 0;
    for (uint32_t k = 0; k < rest->planes->count; k++)
        sides |= (uint8_t)((distance(&rest->planes->at[k], p) > 0.0) << k);
    return sides;
}

static bool is_kept(const struct rest *rest, uint8_t sides)
{
    return rest->scene->sections.is_corner ? sides != 0 : sides == (1u << rest->planes->count) - 1;
}

/* Adds the positions that are kept, and finds the sides of all. False: one has no place. */
static bool add_positions(struct rest *rest, const struct zr_instance *instance)
{
    const struct zr_mesh *mesh = &rest->scene->meshes[instance->mesh];
    double p[3];
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(rest->run->cancel)) return true;
        if (!(mesh->positions[i].w > 0.0f)) return false;
        place(instance, mesh->positions[i], p);
        rest->sides[i] = sides_of(rest, p);
        if (!mesh->shown && is_kept(rest, rest->sides[i])) add(rest, p);
    }
    for (uint32_t i = 0; mesh->shown && i < mesh->shown_count; i++) {
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(rest->run->cancel)) return true;
        place(instance, mesh->shown[i], p);
        if (is_kept(rest, sides_of(rest, p))) add(rest, p);
    }
    return true;
}

/* True for faces that the view of the whole scene does not fit. */
static bool is_passed_over(const struct rest *rest, const struct zr_instance *instance, uint32_t face)
{
    const struct zr_scene *scene = rest->scene;
    const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
    if (!mesh->shown) return false;
    if (zr_material_of_face(scene, mesh, face)->is_hidden) return true;
    if (!scene->csg) return false;
    const uint32_t part = zr_csg_part_of(scene->csg, (uint32_t)(instance - scene->instances), mesh, face);
    return part > 0 && scene->csg->tools >> (part - 1) & 1;
}

/* Faces are cut as fans: the hull is that of their corners. */
static void add_crossings(struct rest *rest, const struct zr_instance *instance)
{
    const struct zr_mesh *mesh = &rest->scene->meshes[instance->mesh];
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t first = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
        if (is_passed_over(rest, instance, face)) continue;
        for (uint32_t i = first + 1; i + 1 < end; i++) {
            if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(rest->run->cancel)) return;
            add_triangle(rest, instance,
                         (const uint32_t[3]){mesh->indices[first], mesh->indices[i], mesh->indices[i + 1]});
        }
    }
    for (uint32_t i = 0; i < mesh->line_count; i++) {
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(rest->run->cancel)) return;
        add_triangle(rest, instance,
                     (const uint32_t[3]){mesh->lines[2 * i], mesh->lines[2 * i + 1], mesh->lines[2 * i + 1]});
    }
}

/* False: nothing is left, or a position has no place. */
static bool find_rest(struct rest *rest)
{
    const struct zr_scene *scene = rest->scene;
    uint32_t most = 1;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (scene->meshes[i].position_count > most) most = scene->meshes[i].position_count;
    rest->sides = zr_arena_alloc(rest->run->arena, most, 1);
    for (uint32_t i = 0; rest->sides && i < scene->instance_count; i++) {
        if (zr_is_cancelled(rest->run->cancel)) return false;
        if (!add_positions(rest, &scene->instances[i])) return false;
        add_crossings(rest, &scene->instances[i]);
    }
    return rest->count > 0 && zr_arena_ok(rest->run->arena);
}

/* ---- the view ---- */

static bool is_fitted(const struct zr_scene *scene, const struct zr_view *view)
{
    const bool fits = view->pose == ZR_POSE_PRESET || view->pose == ZR_POSE_DIRECTION ||
                      (view->pose == ZR_POSE_ORBIT && !(view->distance > 0.0f));
    return scene->sections.count > 0 && scene->sections.uncut_count == 0 && fits && !view->fit_to_mesh &&
           !zr_view_fits_corners(view);
}

/* Fits the view, in the direction that it has for the whole scene. False: it cannot be fitted. */
static bool fit(const struct rest *rest, const struct zr_resolved_view *whole, struct zr_camera *camera)
{
    struct zr_error ignored = {0};
    const struct zr_run run = zr_run_reporting(rest->run, &ignored);
    const struct zr_mesh mesh = {.name = "", .position_count = rest->count, .positions = rest->points};
    const struct zr_instance instance = {.object_to_world = zr_mat4_identity()};
    struct zr_scene *left = zr_arena_copy(rest->run->arena, rest->scene, sizeof *left);
    struct zr_view view = *whole->view;
    if (!left) return false;
    left->mesh_count = left->instance_count = 1;
    left->meshes = &mesh;
    left->instances = &instance;
    left->mesh_owners = NULL;
    left->has_box = false;
    zr_view_suit_extent(&view, &whole->bounds, rest->scene->picture->z_is_up);
    view.suits_extent = false;
    const struct zr_bounds bounds = zr_bounds_of(left, run.team, run.cancel);
    return zr_camera_resolve(&run, left, &view, &bounds, camera) == ZR_OK;
}

/* True if each plane keeps the side that it keeps for the whole scene. */
static bool keeps_sides(const struct rest *rest, const struct zr_resolved_view *fitted)
{
    struct zr_error ignored = {0};
    struct zr_section_planes planes;
    if (zr_section_planes_find(rest->scene, fitted, &planes, &ignored) != ZR_OK) return false;
    return memcmp(planes.at, rest->planes->at, planes.count * sizeof *planes.at) == 0;
}

enum zr_status zr_resolved_view_find(const struct zr_run *run, const struct zr_scene *scene,
                                     const struct zr_resolved_view **out)
{
    struct zr_resolved_view *whole;
    struct zr_section_planes planes;
    struct zr_error ignored = {0};
    const enum zr_status status = zr_whole_view_find(run, scene, &whole);
    *out = whole;
    if (status != ZR_OK || !is_fitted(scene, whole->view)) return status;
    if (zr_section_planes_find(scene, whole, &planes, &ignored) != ZR_OK) return ZR_OK; /* reported when it is cut */
    struct rest rest = {.run = run, .scene = scene, .planes = &planes};
    struct zr_resolved_view fitted = *whole;
    if (find_rest(&rest) && fit(&rest, whole, &fitted.camera) && keeps_sides(&rest, &fitted)) *whole = fitted;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
