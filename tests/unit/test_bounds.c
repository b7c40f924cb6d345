/* Bounds are those of each point alone, whatever is looked at together. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "scene/camera.h"
#include "support/cmocka_all.h"
#include "support/random.h"

enum { POINTS_MOST = 200, MESHES = 3, INSTANCES = 5 };

static struct random numbers = {{RANDOM_STATE_1}};

static float any(void)
{
    return (float)random_below(&numbers, 2000001) / 1000000.0f - 1.0f;
}

/* How a mesh's points are: most meshes have none that are odd, since few of one kind are what could be passed over. */
struct kind {
    uint32_t odd_in; /* one of so many, 0: none */
    float w;         /* of those */
    float x;         /* of those; 1: any */
};

static zr_vec4 make_point(const struct kind *kind)
{
    const bool odd = kind->odd_in > 0 && random_below(&numbers, kind->odd_in) == 0;
    const float x = any(), y = any(), z = any();
    return (zr_vec4){odd && kind->x != 1.0f ? kind->x : x, y, z, odd ? kind->w : 1.0f};
}

struct subject {
    struct zr_scene scene;
    struct zr_mesh meshes[MESHES];
    struct zr_instance instances[INSTANCES];
    zr_vec4 points[MESHES][POINTS_MOST];
};

static void make_subject(struct subject *s)
{
    static const struct kind kinds[] = {{0, 1, 1},     {9, 1, NAN},     {9, 1, INFINITY}, {9, 1, -INFINITY},
                                        {2, 1, -0.0f}, {9, 2.5f, 1},    {9, 0.5f, 1},     {3, -1.5f, 1},
                                        {5, 0, 1},     {40, 1e-40f, 1}, {9, NAN, 1},      {1, 0, 1},
                                        {0, 1, 1},     {0, 1, 1},       {0, 1, 1}};
    s->scene = (struct zr_scene){
        .meshes = s->meshes, .mesh_count = MESHES, .instances = s->instances, .instance_count = INSTANCES};
    for (int m = 0; m < MESHES; m++) {
        const struct kind *kind = &kinds[random_below(&numbers, sizeof kinds / sizeof kinds[0])];
        s->meshes[m] =
            (struct zr_mesh){.positions = s->points[m], .position_count = 1 + random_below(&numbers, POINTS_MOST)};
        for (uint32_t i = 0; i < s->meshes[m].position_count; i++)
            s->points[m][i] = make_point(kind);
    }
    for (int i = 0; i < INSTANCES; i++) {
        struct zr_instance *instance = &s->instances[i];
        *instance = (struct zr_instance){random_below(&numbers, MESHES), zr_mat4_identity()};
        for (int k = 0; random_below(&numbers, 2) && k < 12; k++)
            instance->object_to_world.m[k % 3 + k / 3 * 4] = any() * 10.0f;
    }
}

static void include(float *min, float *max, double value)
{
    if ((float)value < *min) *min = (float)value;
    if ((float)value > *max) *max = (float)value;
}

static struct zr_bounds bounds_one_by_one(const struct zr_scene *scene)
{
    struct zr_bounds b = {false, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        for (uint32_t k = 0; k < mesh->position_count; k++) {
            const zr_vec4 p = zr_mat4_apply(&scene->instances[i].object_to_world, mesh->positions[k]);
            const double w = (double)p.w, x = (double)p.x / w, y = (double)p.y / w, z = (double)p.z / w;
            if (p.w == 0.0f ||
                !(fabs(x) <= (double)FLT_MAX && fabs(y) <= (double)FLT_MAX && fabs(z) <= (double)FLT_MAX))
                continue;
            b.valid = true;
            include(&b.min.x, &b.max.x, x);
            include(&b.min.y, &b.max.y, y);
            include(&b.min.z, &b.max.z, z);
        }
    }
    return b;
}

static void bounds_hold_every_point_that_has_a_place(void **state)
{
    (void)state;
    static struct subject subject;
    int empty = 0;
    for (int round = 0; round < 5000; round++) {
        make_subject(&subject);
        const struct zr_bounds want = bounds_one_by_one(&subject.scene), got = zr_bounds_of(&subject.scene, NULL);
        assert_int_equal(got.valid, want.valid);
        empty += !want.valid;
        if (want.valid &&
            (memcmp(&got.min, &want.min, sizeof want.min) || memcmp(&got.max, &want.max, sizeof want.max)))
            fail_msg("round %d: %a %a %a to %a %a %a, not %a %a %a to %a %a %a", round, (double)got.min.x,
                     (double)got.min.y, (double)got.min.z, (double)got.max.x, (double)got.max.y, (double)got.max.z,
                     (double)want.min.x, (double)want.min.y, (double)want.min.z, (double)want.max.x, (double)want.max.y,
                     (double)want.max.z);
    }
    assert_true(empty > 0 && empty < 2500);
}

/* Of points that all lie in a plane of the axes, whichever zero they are written with. */
static void zeros_of_bounds_have_no_sign(void **state)
{
    (void)state;
    static const zr_vec4 points[2][3] = {{{0.0f, 1, -0.0f, 1}, {-0.0f, 2, -0.0f, 1}, {0.0f, 3, -0.0f, 1}},
                                         {{-0.0f, 1, 0.0f, 2}, {0.0f, 2, -0.0f, 1}, {-0.0f, 3, -0.0f, 1}}};
    for (int i = 0; i < 2; i++) {
        const struct zr_mesh mesh = {.positions = points[i], .position_count = 3};
        const struct zr_instance instance = {0, zr_mat4_identity()};
        const struct zr_scene scene = {.meshes = &mesh, .mesh_count = 1, .instances = &instance, .instance_count = 1};
        const struct zr_bounds b = zr_bounds_of(&scene, NULL);
        assert_true(b.valid && b.min.x == 0.0f && b.max.z == 0.0f && b.max.y == 3.0f);
        assert_false(signbit(b.min.x) || signbit(b.max.x) || signbit(b.min.z) || signbit(b.max.z));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold_every_point_that_has_a_place),
        cmocka_unit_test(zeros_of_bounds_have_no_sign),
    };
    return cmocka_run_group_tests_name("bounds", tests, NULL, NULL);
}
