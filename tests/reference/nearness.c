#include "reference/nearness.h"

#include <math.h>
#include <stdlib.h>

#include "reference/generate/batches.h"
#include "scene/scene.h"

/* ---- a face in the window ---- */

/* +x, -x, +y, -y, near, far. */
static double plane_distance(const double v[4], int plane)
{
    bool far_side = plane < 4 ? plane % 2 == 0 : plane == 5;
    return far_side ? v[3] - v[plane / 2] : v[3] + v[plane / 2];
}

/* Sutherland & Hodgman 1974, all in double. The planes come in the reference's order (RULES.md, rule 3), so that
 * the fan of what is left has its diagonals where the reference's pieces meet. */
static int clip(double (*v)[4], int count)
{
    for (int plane = 0; plane < 6 && count > 0; plane++) {
        double out[NEARNESS_CORNERS_MAX + 1][4];
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const double *a = v[i], *b = v[(i + 1) % count];
            double da = plane_distance(a, plane), db = plane_distance(b, plane);
            if (da >= 0.0 && kept < NEARNESS_CORNERS_MAX) {
                for (int k = 0; k < 4; k++)
                    out[kept][k] = a[k];
                kept++;
            }
            if ((da >= 0.0) == (db >= 0.0) || kept >= NEARNESS_CORNERS_MAX) continue;
            for (int k = 0; k < 4; k++)
                out[kept][k] = a[k] + (b[k] - a[k]) * (da / (da - db));
            kept++;
        }
        for (int i = 0; i < kept; i++)
            for (int k = 0; k < 4; k++)
                v[i][k] = out[i][k];
        count = kept;
    }
    return count;
}

static void add_piece(struct nearness *n, double (*v)[4], int count, bool edges_only)
{
    count = clip(v, count);
    if (count < 3) return;
    if (n->count == n->room) {
        uint32_t room = n->room * 2 + 16;
        struct nearness_piece *wider = realloc(n->pieces, room * sizeof *wider);
        if (!wider) return;
        n->pieces = wider;
        n->room = room;
    }
    struct nearness_piece *piece = &n->pieces[n->count++];
    piece->count = count;
    piece->edges_only = edges_only;
    for (int i = 0; i < count; i++) {
        piece->corners[i][0] = (v[i][0] / v[i][3] + 1.0) * 0.5 * n->scene->views[0].width;
        piece->corners[i][1] = (v[i][1] / v[i][3] + 1.0) * 0.5 * n->scene->views[0].height;
        piece->corners[i][2] = (v[i][2] / v[i][3] + 1.0) * 0.5;
    }
}

static void take_triangle(struct nearness *n, const struct zr_instance *instance, const struct zr_mesh *mesh,
                          const uint32_t slots[3], bool edges_only)
{
    double v[NEARNESS_CORNERS_MAX + 1][4];
    for (int k = 0; k < 3; k++)
        batches_transform(n->camera, &instance->object_to_world, mesh->positions[mesh->indices[slots[k]]], v[k]);
    add_piece(n, v, 3, edges_only);
}

static void take_fan(struct nearness *n, const struct zr_instance *instance, const struct zr_mesh *mesh, uint32_t begin,
                     uint32_t end, bool edges_only)
{
    for (uint32_t i = begin + 2; i < end; i++) {
        const uint32_t fan[3] = {i - 1, i, begin}, whole[3] = {begin, begin + 1, begin + 2};
        take_triangle(n, instance, mesh, end - begin == 3 ? whole : fan, edges_only);
    }
}

static void take_face(struct nearness *n, const struct zr_instance *instance, const struct zr_mesh *mesh, uint32_t face)
{
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    uint32_t begin = rings.offsets[0];
    bool parity = batches_face_is_parity(mesh, face);
    struct batches_cut cut = {.count = 0};
    if (parity && !batches_cut_face(n->arena, mesh, face, &cut)) return;
    for (uint32_t i = 0; i < cut.count; i++) {
        const uint32_t *t = cut.triangles[i];
        take_triangle(n, instance, mesh, (const uint32_t[]){begin + t[0], begin + t[1], begin + t[2]}, false);
    }
    for (uint32_t r = 0; r < rings.count; r++)
        take_fan(n, instance, mesh, rings.offsets[r], rings.offsets[r + 1], parity);
}

static void take_owner(struct nearness *n, uint32_t owner)
{
    uint64_t first = 1;
    n->owner = owner;
    n->count = 0;
    for (uint32_t i = 0; i < n->scene->instance_count; i++) {
        const struct zr_instance *instance = &n->scene->instances[i];
        const struct zr_mesh *mesh = &n->scene->meshes[instance->mesh];
        if (owner >= first && owner - first < mesh->face_count) take_face(n, instance, mesh, (uint32_t)(owner - first));
        first += zr_mesh_ids(mesh);
    }
}

/* ---- one sample ---- */

static double segment_distance(const double a[3], const double b[3], double x, double y)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
    double t = length > 0.0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length : 0.0;
    t = fmin(fmax(t, 0.0), 1.0);
    return hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

/* The plane of a piece, by Newell's method from its first corner. `noise` is what half an ulp on each
 * coordinate of a corner adds up to at the sample. */
static void measure_depth(const struct nearness_piece *piece, double x, double y, struct near *near)
{
    const double *o = piece->corners[0];
    double nx = 0, ny = 0, nz = 0, longest = 0, largest = 1;
    for (int i = 1; i < piece->count; i++) {
        const double *a = piece->corners[i - 1], *b = piece->corners[i];
        double ax = a[0] - o[0], ay = a[1] - o[1], az = a[2] - o[2];
        double bx = b[0] - o[0], by = b[1] - o[1], bz = b[2] - o[2];
        nx += ay * bz - az * by;
        ny += az * bx - ax * bz;
        nz += ax * by - ay * bx;
        longest = fmax(longest, hypot(bx, by));
        largest = fmax(largest, fmax(fabs(b[0]), fabs(b[1])));
    }
    near->slope = hypot(nx, ny) / fabs(nz);
    near->depth = o[2] - (nx * (x - o[0]) + ny * (y - o[1])) / nz;
    /* Heights over the longest side, the shortest that a corner's error is magnified by. */
    double height = fabs(nz) / fmax(longest, 1e-30), ulp = 0x1p-23;
    near->noise = ulp * (1.0 + near->slope * largest) * fmax(1.0, longest / fmax(height, 1e-30));
}

static bool is_inside(const struct nearness_piece *piece, double x, double y)
{
    int left = 0, right = 0;
    for (int i = 0; i < piece->count; i++) {
        const double *a = piece->corners[i], *b = piece->corners[(i + 1) % piece->count];
        double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        left += side > 0.0;
        right += side < 0.0;
    }
    return left == 0 || right == 0;
}

struct near nearness_at(struct nearness *nearness, uint32_t owner, uint32_t x, uint32_t row)
{
    if (nearness->owner != owner) take_owner(nearness, owner);
    double sx = x + 0.5, sy = nearness->scene->views[0].height - row - 0.5, best = HUGE_VAL;
    struct near near = {.edge_px = HUGE_VAL};
    for (uint32_t p = 0; p < nearness->count; p++) {
        const struct nearness_piece *piece = &nearness->pieces[p];
        double edge = HUGE_VAL;
        for (int i = 0; i < piece->count; i++)
            edge = fmin(edge, segment_distance(piece->corners[i], piece->corners[(i + 1) % piece->count], sx, sy));
        for (int i = 2; i < piece->count - 1; i++)
            edge = fmin(edge, segment_distance(piece->corners[0], piece->corners[i], sx, sy));
        near.edge_px = fmin(near.edge_px, edge);
        if (piece->edges_only) continue;
        bool inside = is_inside(piece, sx, sy);
        near.covered = near.covered || inside;
        double outside = inside ? 0.0 : edge;
        if (outside >= best) continue;
        best = outside;
        measure_depth(piece, sx, sy, &near);
    }
    return near;
}

/* ---- rounding ---- */

/* m·v with all magnitudes, and no cancelling. */
static void apply_magnitudes(const zr_mat4 *m, double v[4])
{
    double out[4] = {0, 0, 0, 0};
    for (int row = 0; row < 4; row++)
        for (int k = 0; k < 4; k++)
            out[row] += fabs((double)m->m[k * 4 + row]) * v[k];
    for (int row = 0; row < 4; row++)
        v[row] = out[row];
}

static void add_corner(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_instance *instance,
                       zr_vec4 p, struct rounding *rounding)
{
    double clip[4], sum[4] = {fabs((double)p.x), fabs((double)p.y), fabs((double)p.z), fabs((double)p.w)};
    batches_transform(camera, &instance->object_to_world, p, clip);
    for (int plane = 0; plane < 6; plane++)
        if (!(plane_distance(clip, plane) >= 0.0) || !(clip[3] > 0.0)) return;
    apply_magnitudes(&instance->object_to_world, sum);
    apply_magnitudes(&camera->world_to_eye, sum);
    apply_magnitudes(&camera->projection, sum);
    double half = 3.0 * 0x1p-24 * 0.5 / clip[3];
    rounding->px = fmax(rounding->px, half * fmax(sum[0] * scene->views[0].width, sum[1] * scene->views[0].height));
    rounding->depth = fmax(rounding->depth, half * (sum[2] + clip[3]));
}

struct rounding nearness_rounding(const struct zr_scene *scene, const struct zr_camera *camera)
{
    struct rounding rounding = {0, 0};
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t k = 0; k < mesh->position_count; k++)
            add_corner(scene, camera, &scene->instances[i], mesh->positions[k], &rounding);
    }
    return rounding;
}

void nearness_free(struct nearness *nearness)
{
    free(nearness->pieces);
    nearness->pieces = NULL;
}
