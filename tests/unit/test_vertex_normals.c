/* Normals of vertices are sums in the order of the faces, however many threads share them. */
#include "mesh/vertex_normals.h"

#include <math.h>
#include <string.h>

#include "guarded.h"
#include "mesh/face_normals.h"
#include "support/isas.h"
#include "support/random.h"

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

static void add_one_by_one(const struct zr_mesh *mesh, zr_vec3 *sums)
{
    memset(sums, 0, mesh->position_count * sizeof *sums);
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const zr_vec3 normal = zr_normal_of_face(mesh, face);
        for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++)
            sums[mesh->indices[slot]] = zr_vec3_add(sums[mesh->indices[slot]], normal);
    }
}

/* Where nobody may read beyond the mesh. */
static void check(enum zr_isa isa, struct subject *subject, const zr_vec3 *want)
{
    struct zr_mesh mesh = subject->mesh;
    struct guarded indices =
        guarded_copy(mesh.indices, (size_t)mesh.face_offsets[mesh.face_count] * sizeof *mesh.indices);
    struct guarded positions = guarded_copy(mesh.positions, mesh.position_count * sizeof *mesh.positions);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    mesh.indices = (const uint32_t *)(const void *)indices.bytes;
    mesh.positions = (const zr_vec4 *)(const void *)positions.bytes;
    for (int threads = 1; threads <= 5; threads += 2) {
        struct zr_team *team = zr_team_create_for(threads, isa);
        zr_arena_reset(&arena, 1 << 24);
        const zr_vec4 *got = zr_vertex_normals_make(&arena, team, NULL, &mesh);
        assert_non_null(got);
        for (uint32_t i = 0; i < mesh.position_count; i++) {
            const zr_vec3 unit = zr_vec3_normalize(want[i]);
            if (memcmp(&got[i], &unit, sizeof unit) != 0 || got[i].w != 0.0f)
                fail_msg("%u faces, %u positions, %d threads: %u is %a %a %a, not %a %a %a", mesh.face_count,
                         mesh.position_count, threads, i, (double)got[i].x, (double)got[i].y, (double)got[i].z,
                         (double)unit.x, (double)unit.y, (double)unit.z);
        }
        zr_team_destroy(team);
    }
    zr_arena_free(&arena);
    guarded_free(&indices);
    guarded_free(&positions);
}

static void sums_are_those_of_one_face_after_another(void **state)
{
    static struct subject subject;
    static zr_vec3 sums[POSITIONS_MOST];
    static const struct {
        uint32_t faces, positions;
    } sizes[] = {{0, 3}, {1, 3}, {7, 5}, {64, 70}, {65, 1}, {300, 64}, {4097, 2001}, {FACES, POSITIONS_MOST}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int only_triangles = 0; only_triangles < 2; only_triangles++) {
            make_subject(&subject, sizes[i].faces, sizes[i].positions, only_triangles);
            add_one_by_one(&subject.mesh, sums);
            check(isa_under_test(state), &subject, sums);
        }
}

static void larger_faces_weigh_more(void **state)
{
    (void)state;
    /* A large face towards +z and a small one towards +x share the edge 0-1. */
    const zr_vec4 p[4] = {{0, 0, 0, 1}, {0, 1, 0, 1}, {-4, 0, 0, 1}, {0, 0, -1, 1}};
    const uint32_t indices[] = {0, 1, 2, 0, 3, 1}, offsets[] = {0, 3, 6};
    struct zr_mesh mesh = {
        .position_count = 4, .positions = p, .face_count = 2, .face_offsets = offsets, .indices = indices};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    zr_vec4 *n = zr_vertex_normals_make(&arena, NULL, NULL, &mesh);
    assert_true(fabsf(n[0].z / n[0].x - 4.0f) < 1e-5f);
    assert_true(fabsf(n[0].x * n[0].x + n[0].y * n[0].y + n[0].z * n[0].z - 1.0f) < 1e-6f);
    assert_true(n[2].z == 1.0f && n[3].x == 1.0f);
    zr_arena_free(&arena);
}

static void what_was_cancelled_ends_early(void **state)
{
    (void)state;
    static struct subject subject;
    struct zr_cancel cancel = {.raised = true};
    struct zr_arena arena;
    make_subject(&subject, 10, 10, true);
    zr_arena_init(&arena, 1 << 20);
    const zr_vec4 *n = zr_vertex_normals_make(&arena, NULL, &cancel, &subject.mesh);
    for (int i = 0; i < 10; i++)
        assert_true(n[i].x == 0.0f && n[i].y == 0.0f && n[i].z == 0.0f);
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(sums_are_those_of_one_face_after_another),
        cmocka_unit_test(larger_faces_weigh_more),
        cmocka_unit_test(what_was_cancelled_ends_early),
    };
    return cmocka_run_group_tests_name("vertex_normals", tests, NULL, NULL);
}
