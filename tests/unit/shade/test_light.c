/* Normals of many faces at once are those of one. */
#include <math.h>
#include <string.h>

#include "mesh/face_normals.h"
#include "support/isas.h"
#include "support/random.h"
#include "unit/common/guarded.h"

enum { MOST = 150 };

static struct random numbers = {{RANDOM_STATE_1}};

/* Of any size, and often one that is odd. */
static float any_float(void)
{
    static const float odd[] = {0.0f,   -0.0f, 1.0f,   1e-20f, 1e-38f,   1e-45f,
                                -1e20f, 3e38f, -1e15f, NAN,    INFINITY, -INFINITY};
    const float value = (float)random_below(&numbers, 2000001) / 1000000.0f - 1.0f;
    return random_below(&numbers, 8) == 0 ? odd[random_below(&numbers, sizeof odd / sizeof odd[0])] : value;
}

static zr_vec3 any_vector(void)
{
    static const float sizes[] = {1.0f, 1.0f, 1e-18f, 1e-25f, 1e-42f, 1e17f, 1e30f};
    const float size = sizes[random_below(&numbers, sizeof sizes / sizeof sizes[0])];
    const float x = any_float(), y = any_float(), z = any_float();
    return (zr_vec3){x * size, y * size, z * size};
}

static zr_vec4 any_color(void)
{
    zr_vec4 color;
    float *component = &color.x;
    for (int i = 0; i < 4; i++)
        component[i] = (float)random_below(&numbers, 256) / 255.0f;
    return color;
}

enum { POSITIONS = 50 };

static bool is_same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

TEST_EACH_ISA(triangles_have_the_normals_of_faces)
{
    const enum zr_isa isa = isa_under_test(state);
    zr_vec4 positions[POSITIONS];
    uint32_t indices[3 * MOST], offsets[MOST + 1];
    for (int i = 0; i <= MOST; i++)
        offsets[i] = 3 * (uint32_t)i;
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < POSITIONS; i++) {
            static const float w[] = {1.0f, 0.0f, -0.0f, 2.0f, -0.3f, NAN};
            const zr_vec3 v = any_vector();
            positions[i] = (zr_vec4){v.x, v.y, v.z, round % 2 ? 1.0f : w[random_below(&numbers, 6)]};
        }
        for (int i = 0; i < 3 * MOST; i++)
            indices[i] = random_below(&numbers, POSITIONS);
        const struct zr_mesh mesh = {.position_count = POSITIONS,
                                     .positions = positions,
                                     .face_count = MOST,
                                     .face_offsets = offsets,
                                     .indices = indices};
        const uint32_t first = random_below(&numbers, MOST), count = random_below(&numbers, MOST - first + 1);
        zr_vec4 blank[MOST] = {{0, 0, 0, 0}};
        struct guarded room = guarded_copy(blank, count * sizeof *blank);
        const zr_vec4 *got = (const zr_vec4 *)(const void *)room.bytes;
        zr_triangle_normals_of(isa)(&mesh, first, count, (zr_vec4 *)(void *)room.bytes);
        for (uint32_t i = 0; i < count; i++) {
            const zr_vec3 want = zr_normal_of_face(&mesh, first + i);
            if (!is_same(got[i].x, want.x) || !is_same(got[i].y, want.y) || !is_same(got[i].z, want.z) ||
                !is_same(got[i].w, 0.0f))
                fail_msg("face %u: %a %a %a, not %a %a %a", first + i, (double)got[i].x, (double)got[i].y,
                         (double)got[i].z, (double)want.x, (double)want.y, (double)want.z);
        }
        guarded_free(&room);
    }
}

/* Asked for in any order, of meshes of triangles and of others. */
TEST_EACH_ISA(normals_that_are_kept_are_those_of_the_face)
{
    const enum zr_isa isa = isa_under_test(state);
    enum { FACES = 3 * ZR_NORMALS_AT_ONCE + 1 };
    zr_vec4 positions[POSITIONS];
    uint32_t indices[4 * FACES], offsets[FACES + 1];
    for (int i = 0; i < POSITIONS; i++)
        positions[i] = any_color();
    for (int i = 0; i < 4 * FACES; i++)
        indices[i] = random_below(&numbers, POSITIONS);
    for (uint32_t corners = 3; corners <= 4; corners++) {
        for (uint32_t i = 0; i <= FACES; i++)
            offsets[i] = corners * i;
        struct guarded guarded = guarded_copy(indices, (size_t)corners * FACES * sizeof *indices);
        const struct zr_mesh mesh = {.position_count = POSITIONS,
                                     .positions = positions,
                                     .face_count = FACES,
                                     .face_offsets = offsets,
                                     .indices = (const uint32_t *)(const void *)guarded.bytes};
        struct zr_face_normals normals;
        zr_face_normals_begin(&normals, isa, &mesh);
        for (int i = 0; i < 3 * FACES; i++) {
            const uint32_t face = i < FACES ? (uint32_t)i : random_below(&numbers, FACES);
            const zr_vec3 got = zr_face_normal(&normals, face), want = zr_normal_of_face(&mesh, face);
            if (!is_same(got.x, want.x) || !is_same(got.y, want.y) || !is_same(got.z, want.z))
                fail_msg("face %u, corners %u", face, corners);
        }
        guarded_free(&guarded);
    }
}

RUN_TESTS(NULL, NULL)
