/* models.h - unit: meshes by formulas, as scenes that are measured. */
#ifndef ZR_TEST_MODELS_H
#define ZR_TEST_MODELS_H

#include <math.h>

#include "measure/solid.h"
#include "support/scenes.h"
#include "support/tests.h"

#define assert_near(value, truth, most)                                                                                \
    do {                                                                                                               \
        const double value_ = (value), truth_ = (truth);                                                               \
        if (!(fabs(value_ - truth_) <= (most))) fail_msg("%s is %.12g, not %.12g", #value, value_, truth_);            \
    } while (0)

static const double model_pi = 3.14159265358979323846;

/* A mesh that grows. */
struct model {
    struct zr_mesh mesh;
    zr_vec4 *positions;
    uint32_t *offsets, *indices;
};

static inline struct model model_begin(struct zr_arena *arena, uint32_t positions, uint32_t faces)
{
    struct model m = {.positions = zr_arena_alloc(arena, positions, sizeof *m.positions),
                      .offsets = zr_arena_zero(arena, faces + 1, sizeof *m.offsets),
                      .indices = zr_arena_alloc(arena, 4 * (size_t)faces, sizeof *m.indices)};
    assert_non_null(m.indices);
    m.mesh =
        (struct zr_mesh){.name = "model", .positions = m.positions, .face_offsets = m.offsets, .indices = m.indices};
    return m;
}

static inline void model_place(struct model *m, double x, double y, double z)
{
    m->positions[m->mesh.position_count++] = (zr_vec4){(float)x, (float)y, (float)z, 1};
}

static inline void model_face(struct model *m, uint32_t corners, const uint32_t *at)
{
    const uint32_t begin = m->offsets[m->mesh.face_count];
    memcpy(m->indices + begin, at, corners * sizeof *at);
    m->offsets[++m->mesh.face_count] = begin + corners;
}

static inline void model_add_box(struct model *m, const double low[3], const double size[3])
{
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const uint32_t first = m->mesh.position_count;
    for (int i = 0; i < 8; i++)
        model_place(m, low[0] + size[0] * (i & 1), low[1] + size[1] * (i >> 1 & 1), low[2] + size[2] * (i >> 2));
    for (int f = 0; f < 6; f++) {
        uint32_t at[4];
        for (int k = 0; k < 4; k++)
            at[k] = first + faces[f][k];
        model_face(m, 4, at);
    }
}

static inline struct model model_box(struct zr_arena *arena, const double low[3], const double size[3])
{
    struct model m = model_begin(arena, 8, 6);
    model_add_box(&m, low, size);
    return m;
}

/* A torus around z, of tall x wide quads; with radius 0 and 2 (tall even), the upper half is a sphere's profile. */
static inline struct model model_torus(struct zr_arena *arena, double radius, double tube, uint32_t around,
                                       uint32_t across)
{
    struct model m = model_begin(arena, around * across, around * across);
    for (uint32_t i = 0; i < around * across; i++) {
        const double u = 2 * model_pi * (i / across) / around, v = 2 * model_pi * (i % across) / across,
                     r = radius + tube * cos(v);
        model_place(&m, r * cos(u), r * sin(u), tube * sin(v));
    }
    for (uint32_t i = 0; i < around; i++)
        for (uint32_t k = 0; k < across; k++) {
            const uint32_t next = (i + 1) % around, up = (k + 1) % across;
            model_face(&m, 4,
                       (const uint32_t[4]){i * across + k, next * across + k, next * across + up, i * across + up});
        }
    return m;
}

/* A solid of revolution around an axis, 0 to 2, with `count` pairs of radius and height, from pole to pole. */
static inline struct model model_lathe(struct zr_arena *arena, const double (*profile)[2], uint32_t count,
                                       uint32_t around, int axis, const double middle[3])
{
    struct model m = model_begin(arena, (count - 2) * around + 2, (count - 1) * around);
    const uint32_t first = 1, last = 1 + (count - 2) * around;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < (i == 0 || i + 1 == count ? 1 : around); k++) {
            const double angle = 2 * model_pi * k / around;
            double at[3];
            at[axis] = middle[axis] + profile[i][1];
            at[(axis + 1) % 3] = middle[(axis + 1) % 3] + profile[i][0] * cos(angle);
            at[(axis + 2) % 3] = middle[(axis + 2) % 3] + profile[i][0] * sin(angle);
            model_place(&m, at[0], at[1], at[2]);
        }
    for (uint32_t k = 0; k < around; k++) {
        const uint32_t next = (k + 1) % around;
        model_face(&m, 3, (const uint32_t[3]){0, first + next, first + k});
        for (uint32_t i = 0; i + 3 < count; i++)
            model_face(&m, 4,
                       (const uint32_t[4]){first + i * around + k, first + i * around + next,
                                           first + (i + 1) * around + next, first + (i + 1) * around + k});
        const uint32_t ring = first + (count - 3) * around;
        model_face(&m, 3, (const uint32_t[3]){ring + k, ring + next, last});
    }
    return m;
}

static inline struct model model_sphere(struct zr_arena *arena, double radius, uint32_t around, const double middle[3])
{
    const uint32_t count = around / 2 + 1;
    double(*profile)[2] = zr_arena_alloc(arena, count, sizeof *profile);
    assert_non_null(profile);
    for (uint32_t i = 0; i < count; i++) {
        const double angle = model_pi * i / (count - 1);
        profile[i][0] = radius * sin(angle);
        profile[i][1] = -radius * cos(angle);
    }
    return model_lathe(arena, (const double(*)[2])profile, count, around, 2, middle);
}

static inline struct model model_cylinder(struct zr_arena *arena, double radius, double half, uint32_t around, int axis)
{
    const double profile[4][2] = {{0, -half}, {radius, -half}, {radius, half}, {0, half}}, middle[3] = {0, 0, 0};
    return model_lathe(arena, profile, 4, around, axis, middle);
}

/* The volume that its faces enclose, as fans. */
static inline double model_volume(const struct model *m)
{
    double sum = 0.0;
    for (uint32_t f = 0; f < m->mesh.face_count; f++)
        for (uint32_t i = m->offsets[f] + 1; i + 1 < m->offsets[f + 1]; i++) {
            const zr_vec4 *p[3] = {&m->positions[m->indices[m->offsets[f]]], &m->positions[m->indices[i]],
                                   &m->positions[m->indices[i + 1]]};
            const struct zr_world_place a = {(double)p[0]->x, (double)p[0]->y, (double)p[0]->z},
                                        b = {(double)p[1]->x, (double)p[1]->y, (double)p[1]->z},
                                        c = {(double)p[2]->x, (double)p[2]->y, (double)p[2]->z};
            sum += zr_world_place_dot(a, zr_world_place_cross(b, c)) / 6.0;
        }
    return sum;
}

/* A scene with one instance of a mesh. Static: valid until the next call with the same slot. */
static inline const struct zr_scene *model_scene(const struct zr_mesh *mesh, int slot)
{
    static struct {
        struct test_scene test;
        struct zr_mesh mesh;
        struct zr_instance instance;
    } placed[4];
    static const zr_vec4 corners[3] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    scene_of_triangles(&placed[slot].test, 16, 16, corners, 1);
    placed[slot].mesh = *mesh;
    placed[slot].instance = (struct zr_instance){.mesh = 0, .object_to_world = zr_mat4_identity()};
    placed[slot].test.scene.meshes = &placed[slot].mesh;
    placed[slot].test.scene.instances = &placed[slot].instance;
    placed[slot].test.scene.mesh_count = placed[slot].test.scene.instance_count = 1;
    return &placed[slot].test.scene;
}

/* Makes a solid, relative to `middle` or to its own. */
static inline struct zr_solid model_solid(const struct zr_run *run, const struct zr_mesh *mesh,
                                          const struct zr_world_place *middle)
{
    struct zr_solid solid;
    assert_int_equal(zr_solid_make(run, model_scene(mesh, 0), middle, &solid), ZR_OK);
    return solid;
}

#endif
