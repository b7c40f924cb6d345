/* Normals of vertices are sums in the order of the faces, however many threads share them. */
#include "mesh/vertex_normals.h"

#include <math.h>
#include <string.h>

#include "base/run.h"
#include "mesh/face_normals.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

/* More faces than are held at once. */
enum { FACES = 70001, CORNERS_MOST = 5, POSITIONS_MOST = 20000 };

static struct random numbers = {{RANDOM_STATE_1}};

static float any(void)
{
    return (float)random_below(&numbers, 2001) / 1000.0f - 1.0f;
}

struct subject {
    struct zr_mesh mesh;
    zr_vec4 positions[POSITIONS_MOST];
    uint32_t offsets[FACES + 1], indices[FACES * CORNERS_MOST];
};

static void make_subject(struct subject *s, uint32_t faces, uint32_t positions, bool only_triangles)
{
    for (uint32_t i = 0; i < positions; i++)
        s->positions[i] = (zr_vec4){any(), any(), any(), random_below(&numbers, 50) ? 1.0f : any()};
    for (uint32_t f = 0; f < faces; f++)
        s->offsets[f + 1] = s->offsets[f] + (only_triangles ? 3 : 3 + random_below(&numbers, 3));
    for (uint32_t slot = 0; slot < s->offsets[faces]; slot++)
        s->indices[slot] = random_below(&numbers, positions);
    s->mesh = (struct zr_mesh){.position_count = positions,
                               .positions = s->positions,
                               .face_count = faces,
                               .face_offsets = s->offsets,
                               .indices = s->indices};
}

TEST(larger_faces_weigh_more)
{
    /* A large face towards +z and a small one towards +x share the edge 0-1. */
    const zr_vec4 p[4] = {{0, 0, 0, 1}, {0, 1, 0, 1}, {-4, 0, 0, 1}, {0, 0, -1, 1}};
    const uint32_t indices[] = {0, 1, 2, 0, 3, 1}, offsets[] = {0, 3, 6};
    struct zr_mesh mesh = {
        .position_count = 4, .positions = p, .face_count = 2, .face_offsets = offsets, .indices = indices};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    zr_vec4 *n = zr_vertex_normals_make(&(struct zr_run){.arena = &arena}, &mesh);
    assert_true(fabsf(n[0].z / n[0].x - 4.0f) < 1e-5f);
    assert_true(fabsf(n[0].x * n[0].x + n[0].y * n[0].y + n[0].z * n[0].z - 1.0f) < 1e-6f);
    assert_true(n[2].z == 1.0f && n[3].x == 1.0f);
    zr_arena_free(&arena);
}

TEST(what_was_cancelled_ends_early)
{
    static struct subject subject;
    struct zr_cancel cancel = {.raised = true};
    struct zr_arena arena;
    make_subject(&subject, 10, 10, true);
    zr_arena_init(&arena, 1 << 20);
    const zr_vec4 *n = zr_vertex_normals_make(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &subject.mesh);
    for (int i = 0; i < 10; i++)
        assert_true(n[i].x == 0.0f && n[i].y == 0.0f && n[i].z == 0.0f);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
