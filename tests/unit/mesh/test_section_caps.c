/* Caps of sections, compared with winding numbers in double: each pixel shows a cap if and only if the number of the
 * solid around its place in the plane is not 0. The variable SECTIONS gives larger windows, and adds the models of
 * DATA. */
#include <math.h>
#include <stdlib.h>

#include "base/matrix.h"
#include "scene/camera/rays.h"
#include "sections/sections.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA((size_t)1 << 29)

static struct random random_state = {{RANDOM_STATE_1}};

/* A solid seen by a fitted camera. */
static struct test_scene test;
static double diagonal;

static void begin(const struct zr_mesh *mesh, uint32_t side)
{
    static const zr_vec4 unused[3];
    zr_vec3 low = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, high = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    scene_of_triangles(&test, side, side, unused, 1);
    test.mesh = *mesh;
    test.mesh.face_materials = NULL;
    test.mesh.material = 0;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const zr_vec3 p = zr_vec4_over_w(mesh->positions[i]);
        low = (zr_vec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
        high = (zr_vec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
    }
    const zr_vec3 across = zr_vec3_sub(high, low);
    diagonal = sqrt((double)zr_vec3_dot(across, across));
}

static void random_view(int round)
{
    struct zr_view *view = &test.scene.views[0];
    view->pose = ZR_POSE_DIRECTION;
    view->up = (zr_vec3){0.1f, 1, 0};
    view->direction = (zr_vec3){(float)random_range(&random_state, -1, 1), (float)random_range(&random_state, -1, 1),
                                (float)random_range(&random_state, -1, 1)};
    view->projection = round % 2 ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    view->yfov_radians = round % 2 ? 0.6f : 0.0f;
}

/* ---- winding numbers ---- */

/* Winding number of the mesh around a point, by the signed crossings of a ray. */
static int winding_of(const struct zr_mesh *mesh, const double o[3])
{
    static const double d[3] = {0.3713906763541037, 0.5570860145311556, 0.7427813527082074};
    int number = 0;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const struct zr_rings rings = zr_mesh_rings(mesh, face);
        for (uint32_t r = 0; r < rings.count; r++)
            for (uint32_t i = rings.offsets[r] + 2; i < rings.offsets[r + 1]; i++) {
                const uint32_t at[3] = {rings.offsets[r], i - 1, i};
                double v[3][3], e[2][3], p[3], q[3], s[3];
                for (int k = 0; k < 3; k++) {
                    const zr_vec4 c = mesh->positions[mesh->indices[at[k]]];
                    v[k][0] = (double)c.x, v[k][1] = (double)c.y, v[k][2] = (double)c.z;
                }
                for (int k = 0; k < 3; k++) {
                    e[0][k] = v[1][k] - v[0][k];
                    e[1][k] = v[2][k] - v[0][k];
                    s[k] = o[k] - v[0][k];
                }
                for (int k = 0; k < 3; k++) {
                    p[k] = d[(k + 1) % 3] * e[1][(k + 2) % 3] - d[(k + 2) % 3] * e[1][(k + 1) % 3];
                    q[k] = s[(k + 1) % 3] * e[0][(k + 2) % 3] - s[(k + 2) % 3] * e[0][(k + 1) % 3];
                }
                const double det = e[0][0] * p[0] + e[0][1] * p[1] + e[0][2] * p[2];
                if (det == 0.0) continue;
                const double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det,
                             w = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det,
                             t = (e[1][0] * q[0] + e[1][1] * q[1] + e[1][2] * q[2]) / det;
                if (u >= 0.0 && w >= 0.0 && u + w <= 1.0 && t > 0.0) number += det > 0.0 ? 1 : -1;
            }
    }
    return number;
}

/* ---- rays ---- */

/* Steps along rays, in diagonals: behind faces that lie in the plane, and within which a surface is the same place. */
#define BEHIND 1e-9
#define NEAR   1e-6

/* Where the ray of a pixel meets the plane, world space. */
static void meet(const struct zr_rays *rays, const struct zr_matrix *to_world, double x, double y,
                 const struct zr_section *plane, double behind, double out[3])
{
#define ALONG(member, axis)                                                                                            \
    ((double)rays->member.axis + x * (double)rays->member##_x.axis + y * (double)rays->member##_y.axis)
    const double origin[4] = {ALONG(origin, x), ALONG(origin, y), ALONG(origin, z), 1.0};
    const double direction[4] = {ALONG(direction, x), ALONG(direction, y), ALONG(direction, z), 0.0};
#undef ALONG
    double o[4], d[4], across = 0.0, along = 0.0;
    zr_matrix_apply(to_world, origin, o);
    zr_matrix_apply(to_world, direction, d);
    for (int k = 0; k < 3; k++) {
        across += plane->normal[k] * (plane->point[k] - o[k]);
        along += plane->normal[k] * d[k];
    }
    for (int k = 0; k < 3; k++)
        out[k] = o[k] + (across / along + behind * diagonal) * d[k];
}

/* Returns true if the winding number changes within NEAR behind the plane, or in it within the grid to which corners
 * are snapped. */
static bool is_near_outline(const struct zr_rays *rays, const struct zr_matrix *to_world, double x, double y,
                            const struct zr_section *plane)
{
    static const double steps[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    const double snap = 1.5 / 256;
    double at[3];
    meet(rays, to_world, x, y, plane, BEHIND, at);
    const int number = winding_of(&test.mesh, at);
    meet(rays, to_world, x, y, plane, NEAR, at);
    if (winding_of(&test.mesh, at) != number) return true;
    for (int i = 0; i < 8; i++) {
        meet(rays, to_world, x + snap * steps[i][0], y + snap * steps[i][1], plane, BEHIND, at);
        if (winding_of(&test.mesh, at) != number) return true;
    }
    return false;
}

static uint64_t wrong, compared, caps;

static void compare_caps(const struct zr_frame *frame, const struct zr_section *plane, const char *name)
{
    const uint32_t first = 1 + frame->sections->first_cap_id, side = frame->width;
    struct zr_matrix to_eye = zr_matrix_of(&frame->camera.world_to_eye), to_world;
    struct zr_rays rays;
    assert_true(zr_rays_of(&frame->camera, side, side, &rays) && zr_matrix_invert(&to_eye, &to_world));
    for (uint32_t row = 0; row < side; row++)
        for (uint32_t column = 0; column < side; column++) {
            const uint32_t id = frame->face_id[row * side + column];
            const double x = column + 0.5, y = side - row - 0.5;
            double at[3];
            meet(&rays, &to_world, x, y, plane, BEHIND, at);
            const bool inside = winding_of(&test.mesh, at) != 0;
            compared++;
            caps += inside;
            if (inside == (id >= first) || is_near_outline(&rays, &to_world, x, y, plane)) continue;
            if (wrong++ < 3) print_message("%s: pixel %u, %u: id %u of %u\n", name, column, row, id, first);
        }
}

/* ---- planes ---- */

enum { PLANES = 20, IN_FACES = 6 };

static void random_plane(struct zr_section *plane)
{
    const uint32_t face = random_below(&random_state, test.mesh.face_count);
    const uint32_t *corners = test.mesh.indices + test.mesh.face_offsets[face];
    const zr_vec3 p = zr_vec4_over_w(test.mesh.positions[corners[0]]),
                  q = zr_vec4_over_w(test.mesh.positions[corners[1]]);
    const double at[2][3] = {{(double)p.x, (double)p.y, (double)p.z}, {(double)q.x, (double)q.y, (double)q.z}};
    for (int k = 0; k < 3; k++) {
        plane->normal[k] = random_range(&random_state, -1, 1);
        plane->point[k] = 0.7 * at[0][k] + 0.3 * at[1][k];
    }
}

/* Finds a face across an axis: others are planar within rounding only. Returns false if there is none. */
static bool plane_of_face(struct zr_section *plane)
{
    for (int tries = 0; tries < 200; tries++) {
        const uint32_t face = random_below(&random_state, test.mesh.face_count), begin = test.mesh.face_offsets[face];
        const zr_vec4 *first = &test.mesh.positions[test.mesh.indices[begin]];
        bool is_flat[3] = {true, true, true};
        for (uint32_t i = begin; i < test.mesh.face_offsets[face + 1]; i++) {
            const zr_vec4 *p = &test.mesh.positions[test.mesh.indices[i]];
            is_flat[0] = is_flat[0] && p->x == first->x;
            is_flat[1] = is_flat[1] && p->y == first->y;
            is_flat[2] = is_flat[2] && p->z == first->z;
        }
        if (is_flat[0] + is_flat[1] + is_flat[2] != 1) continue;
        for (int k = 0; k < 3; k++)
            plane->normal[k] = is_flat[k];
        plane->point[0] = (double)first->x, plane->point[1] = (double)first->y, plane->point[2] = (double)first->z;
        return true;
    }
    return false;
}

static void compare_solid(const struct zr_mesh *mesh, const char *name, uint32_t side)
{
    for (int round = 0; round < PLANES; round++) {
        begin(mesh, side);
        random_view(round);
        struct zr_sections *sections = &test.scene.sections;
        sections->count = 1;
        if (round < PLANES - IN_FACES || !plane_of_face(&sections->planes[0])) random_plane(&sections->planes[0]);
        compare_caps(scene_render(&arena, NULL, &test.scene), &sections->planes[0], name);
    }
}

static void report(const char *of)
{
    print_message("%s: %llu pixels, %llu of them in caps, %llu wrong\n", of, (unsigned long long)compared,
                  (unsigned long long)caps, (unsigned long long)wrong);
}

static uint32_t window_side(uint32_t otherwise)
{
    const char *text = getenv("SECTIONS");
    return text ? (uint32_t)atoi(text) : otherwise;
}

TEST_AROUND(caps_are_where_the_winding_number_is_not_zero, open_arena, close_arena)
{
    for (int i = 0; i < SOLIDS; i++) {
        const struct zr_mesh solid = solid_make(&arena, (enum solid)i);
        compare_solid(&solid, solid_names[i], window_side(20));
        zr_arena_reset(&arena, 1 << 24);
    }
    report("solids");
    assert_int_equal(wrong, 0);
    assert_true(caps > compared / 20);
}

TEST_AROUND(so_are_those_of_models, open_arena, close_arena)
{
    static const char *const names[] = {"parts/cube.obj",  "parts/gear.obj", "parts/housing.obj", "parts/openbox.obj",
                                        "parts/plate.obj", "fandisk.obj",    "spot.obj",          "cow.obj"};
    if (!getenv("SECTIONS")) skip();
    wrong = compared = caps = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct zr_scene *scene = model_of_file(&arena, names[i], NULL);
        if (!scene) skip();
        compare_solid(&scene->meshes[0], names[i], window_side(20) / 2);
        zr_arena_reset(&arena, 1 << 24);
        report(names[i]);
    }
    assert_int_equal(wrong, 0);
}

RUN_TESTS(NULL, NULL)
