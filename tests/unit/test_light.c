/* Lighting and normals of many at once are those of one. */
#include <math.h>
#include <string.h>

#include "guarded.h"
#include "light_one.h"
#include "mesh/face_normals.h"
#include "shade/lights/light.h"
#include "support/isas.h"
#include "support/random.h"

enum { MOST = 150, LIGHTS = 3 };

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

struct lit_points {
    struct zr_lights lighting;
    struct zr_normal_matrix to_eye;
    struct zr_lamp lamps[LIGHTS];
    zr_vec4 normals[MOST], bases[MOST];
};

static void make_points(struct lit_points *p, uint32_t lights)
{
    zr_mat4 matrix;
    for (int i = 0; i < 16; i++)
        matrix.m[i] = (float)random_below(&numbers, 2001) / 1000.0f - 1.0f;
    p->to_eye = zr_normal_matrix_make(&matrix);
    p->lighting = (struct zr_lights){.ambient = {0.1f, 0.0f, 0.3f}, .count = lights, .lamps = p->lamps};
    for (uint32_t i = 0; i < LIGHTS; i++) {
        const zr_vec4 color = any_color();
        p->lamps[i] =
            (struct zr_lamp){.to_light = zr_vec3_normalize((zr_vec3){color.y - 0.5f, color.z - 0.4f, color.w - 0.3f}),
                             .color = {color.x, color.y, color.z}};
    }
    for (int i = 0; i < MOST; i++) {
        const zr_vec3 n = any_vector();
        p->normals[i] = (zr_vec4){n.x, n.y, n.z, NAN};
        p->bases[i] = any_color();
    }
}

static void assert_same(const zr_vec4 *got, const zr_vec4 *want, const struct lit_points *p, int i, const char *side)
{
    if (memcmp(got, want, sizeof *got) == 0) return;
    const zr_vec4 *n = &p->normals[i];
    fail_msg("%s of point %d, normal %a %a %a: %a %a %a %a, not %a %a %a %a", side, i, (double)n->x, (double)n->y,
             (double)n->z, (double)got->x, (double)got->y, (double)got->z, (double)got->w, (double)want->x,
             (double)want->y, (double)want->z, (double)want->w);
}

/* All in their own pages, so that nothing beyond is read or written; backs apart, and none. */
static void check_lighting(enum zr_isa isa, const struct lit_points *p, int count)
{
    const size_t size = (size_t)count * sizeof(zr_vec4);
    struct guarded normals = guarded_copy(p->normals, size), bases = guarded_copy(p->bases, size),
                   front = guarded_copy(p->bases, size), back = guarded_copy(p->bases, size),
                   only = guarded_copy(p->bases, size);
    const zr_vec4 *n = (const zr_vec4 *)(const void *)normals.bytes, *b = (const zr_vec4 *)(const void *)bases.bytes;
    zr_vec4 *fronts = (zr_vec4 *)(void *)front.bytes, *backs = (zr_vec4 *)(void *)back.bytes,
            *onlys = (zr_vec4 *)(void *)only.bytes;
    zr_light_of(isa)(&p->lighting, &p->to_eye, n, b, (size_t)count, fronts, backs);
    zr_light_of(isa)(&p->lighting, &p->to_eye, n, b, (size_t)count, onlys, onlys);
    for (int i = 0; i < count; i++) {
        zr_vec4 want_front, want_back;
        const zr_vec3 normal = {p->normals[i].x, p->normals[i].y, p->normals[i].z};
        light_one(&p->lighting, &p->to_eye, normal, p->bases[i], &want_front, &want_back);
        assert_same(&fronts[i], &want_front, p, i, "front");
        assert_same(&backs[i], &want_back, p, i, "back");
        assert_same(&onlys[i], &want_front, p, i, "front alone");
    }
    guarded_free(&normals);
    guarded_free(&bases);
    guarded_free(&front);
    guarded_free(&back);
    guarded_free(&only);
}

static void points_are_lit_as_one_is(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    static struct lit_points points;
    for (int round = 0; round < 20; round++)
        for (int count = 0; count <= MOST; count++) {
            make_points(&points, (uint32_t)(round % (LIGHTS + 1)));
            check_lighting(isa, &points, count);
        }
}

/* ---- normals ---- */

enum { POSITIONS = 50 };

static bool is_same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void triangles_have_the_normals_of_faces(void **state)
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
static void normals_that_are_kept_are_those_of_the_face(void **state)
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(points_are_lit_as_one_is),
        TEST_EACH_ISA(triangles_have_the_normals_of_faces),
        TEST_EACH_ISA(normals_that_are_kept_are_those_of_the_face),
    };
    return cmocka_run_group_tests_name("light", tests, NULL, NULL);
}
