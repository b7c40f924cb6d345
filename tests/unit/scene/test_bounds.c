/* Bounds are those of each point alone, whatever is looked at together. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "scene/camera/camera_parts.h"
#include "scene/camera/resolved_view.h"
#include "scene/looks.h"
#include "support/isas.h"
#include "support/pictures/look.h"
#include "support/random.h"
#include "unit/common/guarded.h"

/* More in all than one thread takes at once. */
enum { POINTS_MOST = 20000, POINTS_MOSTLY = 200, MESHES = 3, INSTANCES = 9 };

static struct random numbers = {{RANDOM_STATE_1}};

static float any(void)
{
    return (float)random_below(&numbers, 2000001) / 1000000.0f - 1.0f;
}

/* How a mesh's points are: most meshes have none that are odd, since few of one kind are what could be passed over. */
struct kind {
    uint32_t odd_in; /* one of so many, 0: none */
    float w;         /* of those */
    float value;     /* of one of their coordinates; 1: any */
};

static zr_vec4 make_point(const struct kind *kind)
{
    const bool odd = kind->odd_in > 0 && random_below(&numbers, kind->odd_in) == 0;
    float at[3] = {any(), any(), any()};
    if (odd && kind->value != 1.0f) at[random_below(&numbers, 3)] = kind->value;
    return (zr_vec4){at[0], at[1], at[2], odd ? kind->w : 1.0f};
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
    s->scene = (struct zr_scene){.picture = zr_look_textbook()->picture,
                                 .meshes = s->meshes,
                                 .mesh_count = MESHES,
                                 .instances = s->instances,
                                 .instance_count = 1 + random_below(&numbers, INSTANCES)};
    for (int m = 0; m < MESHES; m++) {
        const struct kind *kind = &kinds[random_below(&numbers, sizeof kinds / sizeof kinds[0])];
        const uint32_t most = random_below(&numbers, 100) ? POINTS_MOSTLY : POINTS_MOST;
        s->meshes[m] = (struct zr_mesh){.positions = s->points[m], .position_count = 1 + random_below(&numbers, most)};
        for (uint32_t i = 0; i < s->meshes[m].position_count; i++)
            s->points[m][i] = make_point(kind);
    }
    for (int i = 0; i < INSTANCES; i++) {
        struct zr_instance *instance = &s->instances[i];
        *instance = (struct zr_instance){.mesh = random_below(&numbers, MESHES), .object_to_world = zr_mat4_identity()};
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

TEST_EACH_ISA(bounds_hold_every_point_that_has_a_place)
{
    static struct subject subject;
    struct zr_team *teams[] = {zr_team_create_for(1, isa_under_test(state)),
                               zr_team_create_for(3, isa_under_test(state))};
    int empty = 0;
    for (int round = 0; round < 2000; round++) {
        make_subject(&subject);
        const struct zr_bounds want = bounds_one_by_one(&subject.scene),
                               got = zr_bounds_of(&subject.scene, teams[round % 2], NULL);
        assert_int_equal(got.valid, want.valid);
        empty += !want.valid;
        if (want.valid &&
            (memcmp(&got.min, &want.min, sizeof want.min) || memcmp(&got.max, &want.max, sizeof want.max)))
            fail_msg("round %d: %a %a %a to %a %a %a, not %a %a %a to %a %a %a", round, (double)got.min.x,
                     (double)got.min.y, (double)got.min.z, (double)got.max.x, (double)got.max.y, (double)got.max.z,
                     (double)want.min.x, (double)want.min.y, (double)want.min.z, (double)want.max.x, (double)want.max.y,
                     (double)want.max.z);
    }
    assert_true(empty > 0 && empty < 1000);
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
}

static void raise_one_by_one(const struct zr_axes *axes, const struct zr_opening *o, zr_vec4 p,
                             double most[ZR_MEASURES])
{
    const zr_dvec3 q = zr_dvec3_sub((zr_dvec3){(double)p.x, (double)p.y, (double)p.z}, axes->eye);
    const double y = zr_dvec3_dot(q, axes->up), z = zr_dvec3_dot(q, axes->back),
                 x = zr_dvec3_dot(q, axes->right) - o->shear * y;
    const double reached[] = {x + o->right * z, -(x + o->left * z), y + o->top * z, -(y + o->bottom * z), z};
    for (int k = 0; k < 5; k++)
        if (reached[k] > most[k]) most[k] = reached[k];
}

/* With all digits that a double has, so that each order of operations has its own sum. */
static double fine(void)
{
    return (double)any() / 3.0;
}

static zr_dvec3 fine_vector(void)
{
    return (zr_dvec3){fine(), fine(), fine()};
}

/* True where the kernel says that it has looked at all of them. */
static bool check_slopes(zr_fit_slopes_fn *kernel, const zr_vec4 *points, uint32_t count)
{
    const struct zr_axes axes = {fine_vector(), fine_vector(), fine_vector(), fine_vector()};
    const struct zr_opening opening = {fine(), fine(), fine(), fine(), fine()};
    double want[ZR_MEASURES], got[ZR_MEASURES];
    for (int k = 0; k < ZR_MEASURES; k++)
        want[k] = got[k] = random_below(&numbers, 4) ? -HUGE_VAL : (double)any();
    struct guarded guarded = guarded_copy(points, count * sizeof *points);
    const double before[] = {got[0], got[1], got[2], got[3], got[4], got[5]};
    const bool looked = kernel(&axes, &opening, (const zr_vec4 *)(const void *)guarded.bytes, count, got);
    guarded_free(&guarded);
    for (uint32_t i = 0; looked && i < count; i++)
        raise_one_by_one(&axes, &opening, points[i], want);
    assert_memory_equal(got, looked ? want : before, sizeof got);
    return looked;
}

static bool are_plain(const zr_vec4 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!isfinite(points[i].x) || !isfinite(points[i].y) || !isfinite(points[i].z) || points[i].w != 1.0f)
            return false;
    return true;
}

TEST_EACH_ISA(slopes_reach_as_far_as_points_do)
{
    static struct subject subject;
    zr_fit_slopes_fn *kernel = zr_fit_slopes_of(isa_under_test(state));
    int plain = 0, odd = 0;
    for (int round = 0; round < 3000; round++) {
        make_subject(&subject);
        const struct zr_mesh *mesh = &subject.meshes[0];
        const uint32_t count = mesh->position_count < POINTS_MOSTLY ? mesh->position_count : POINTS_MOSTLY;
        const bool looked = check_slopes(kernel, mesh->positions, count), could = are_plain(mesh->positions, count);
        assert_true(!looked || could);
        assert_true(looked || !could || count < 16); /* too few for a vector */
        plain += looked;
        odd += !looked;
    }
    assert_true(plain > 300 && odd > 300);
}

static void make_view(struct zr_scene *scene)
{
    static const enum zr_projection projections[] = {ZR_PROJECTION_PERSPECTIVE, ZR_PROJECTION_ORTHOGRAPHIC,
                                                     ZR_PROJECTION_INTRINSICS};
    scene->views[0].width = 64 + random_below(&numbers, 64);
    scene->views[0].height = 64;
    scene_look(scene, (struct zr_view){.pose = random_below(&numbers, 2) ? ZR_POSE_PRESET : ZR_POSE_ORBIT,
                                       .preset = (enum zr_preset)random_below(&numbers, ZR_PRESET_COUNT),
                                       .up = {0, 1, 0},
                                       .has_target = random_below(&numbers, 2),
                                       .azimuth_degrees = 100.0 * fine(),
                                       .elevation_degrees = 100.0 * fine(),
                                       .projection = projections[random_below(&numbers, 3)],
                                       .yfov_radians = 0.8f,
                                       .intrinsics = {.fx = 70, .fy = 60, .cx = 30, .cy = 33, .skew = 5.0 * fine()},
                                       .fit_to_mesh = random_below(&numbers, 2),
                                       .fit_mesh = random_below(&numbers, MESHES)});
}

static enum zr_status see(struct zr_team *team, const struct zr_scene *scene, struct zr_camera *camera)
{
    struct zr_error error = {.count = 0};
    const struct zr_bounds bounds = zr_bounds_of(scene, team, NULL);
    return zr_camera_resolve(&(struct zr_run){.team = team, .error = &error}, scene, &scene->views[0], &bounds, camera);
}

TEST(view_of_nothing_that_has_a_place_is_finite)
{
    static const zr_vec4 points[] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    const struct zr_mesh mesh = {.positions = points, .position_count = 3};
    const struct zr_instance instance = {.object_to_world = zr_mat4_identity()};
    struct zr_scene scene = {.picture = zr_look_textbook()->picture,
                             .meshes = &mesh,
                             .mesh_count = 1,
                             .instances = &instance,
                             .instance_count = 1};
    for (int round = 0; round < 100; round++) {
        struct zr_camera camera;
        make_view(&scene);
        scene.views[0].fit_mesh = 0;
        const enum zr_status status = see(NULL, &scene, &camera);
        assert_true(status == ZR_OK || (scene.views[0].has_target && status == ZR_BAD_SCENE));
        for (int i = 0; i < 16 && status == ZR_OK; i++)
            assert_true(isfinite(camera.world_to_eye.m[i]) && isfinite(camera.projection.m[i]));
    }
}

TEST(walk_that_is_cancelled_ends)
{
    static const zr_vec4 point = {1, 2, 3, 1};
    const struct zr_mesh mesh = {.positions = &point, .position_count = 1};
    const struct zr_instance instance = {.object_to_world = zr_mat4_identity()};
    const struct zr_scene scene = {.picture = zr_look_textbook()->picture,
                                   .meshes = &mesh,
                                   .mesh_count = 1,
                                   .instances = &instance,
                                   .instance_count = 1};
    const struct zr_cancel cancel = {.raised = true};
    assert_true(zr_bounds_of(&scene, NULL, NULL).valid);
    assert_false(zr_bounds_of(&scene, NULL, &cancel).valid);
}

RUN_TESTS(NULL, NULL)
