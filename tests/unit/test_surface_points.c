/* Channels of points: position in its three spaces, distance, barycentrics, instanceId, frontFacing; each is held
 * against another.
 */
#include <math.h>
#include <string.h>

#include "input_check.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/scenes.h"

enum { TRIANGLES = 60, SIDE = 96 };

static char *append(char *to, const char *format, ...) __attribute__((format(printf, 2, 3)));
static char *append(char *to, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    to += vsprintf(to, format, list);
    va_end(list);
    return to;
}

/* Triangles of one mesh, placed as it is and mirrored, some cut by the view volume. */
static const char *scene_text(const char *view, bool is_two_sided)
{
    static char text[1 << 16];
    struct random random = random_seeded(5);
    char *at = append(text, "{\"version\": 1, \"window\": {\"width\": %d, \"height\": %d}, \"view\": {%s},", SIDE,
                      SIDE - 9, view);
    at = append(at,
                " \"nodes\": [{\"mesh\": 0}, {\"mesh\": 0, \"translation\": [0.3, 0.1, -0.4], \"scale\": [-1, 1, 0.5],"
                " \"rotation\": [0.1, 0.2, 0.3, 0.9]}], \"meshes\": [{\"positions\": [");
    for (int i = 0; i < 9 * TRIANGLES; i++)
        at = append(at, "%s%s%.4f", i % 3 ? "" : i ? "], [" : "[", i % 3 ? ", " : "", random_range(&random, -1.2, 1.2));
    at = append(at, "]], \"faces\": [");
    for (int i = 0; i < TRIANGLES; i++)
        at = append(at, "%s[%d, %d, %d]", i ? ", " : "", 3 * i, 3 * i + 1, 3 * i + 2);
    append(at, "], \"doubleSided\": %s}]}", is_two_sided ? "true" : "false");
    return text;
}

static const struct zr_frame *render(struct reading *reading, struct zr_team *team, enum zr_space space)
{
    static struct zr_output outputs[] = {{.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_DISTANCE, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_INSTANCE_ID, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_BARYCENTRICS, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_POSITION, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_NORMALS, .encoding = ZR_ENCODING_NPY},
                                         {.channel = ZR_CHANNEL_FRONT_FACING, .encoding = ZR_ENCODING_NPY}};
    struct zr_scene scene = *reading->scene;
    outputs[5].space = space;
    outputs[6].space = space == ZR_SPACE_WORLD ? ZR_SPACE_WORLD : ZR_SPACE_CAMERA;
    scene.views[0].outputs = outputs;
    scene.views[0].output_count = sizeof outputs / sizeof *outputs;
    return scene_render(&reading->arena, team, &scene);
}

static zr_vec4 point_of(const float *position)
{
    return (zr_vec4){position[0], position[1], position[2], 1};
}

static void assert_near(zr_vec4 got, zr_vec4 want, float most)
{
    if (fabsf(got.x - want.x) > most || fabsf(got.y - want.y) > most || fabsf(got.z - want.z) > most)
        fail_msg("%.7g, %.7g, %.7g is not %.7g, %.7g, %.7g", (double)got.x, (double)got.y, (double)got.z,
                 (double)want.x, (double)want.y, (double)want.z);
}

/* Of a face that is flat: square to its sides, and towards who sees it. */
static void assert_normal(const struct zr_frame *frames[], size_t pixel, const zr_vec4 corners[3], zr_vec4 eye,
                          bool is_parallel)
{
    const float *n = (const float *)frames[ZR_SPACE_CAMERA]->channels[ZR_CHANNEL_NORMALS] + 3 * pixel;
    const float *in_world = (const float *)frames[ZR_SPACE_WORLD]->channels[ZR_CHANNEL_NORMALS] + 3 * pixel;
    const zr_mat4 *view = &frames[0]->camera.world_to_eye;
    const zr_vec4 turned = zr_mat4_apply(view, (zr_vec4){in_world[0], in_world[1], in_world[2], 0});
    assert_true(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0f) < 1e-5f);
    assert_near(turned, (zr_vec4){n[0], n[1], n[2], 0}, 1e-5f);
    for (int k = 1; k < 3; k++) {
        const zr_vec3 side = {corners[k].x - corners[0].x, corners[k].y - corners[0].y, corners[k].z - corners[0].z};
        const float length = sqrtf(side.x * side.x + side.y * side.y + side.z * side.z);
        assert_true(fabsf(side.x * n[0] + side.y * n[1] + side.z * n[2]) < 1e-4f * length);
    }
    const float towards = is_parallel ? n[2] : -(eye.x * n[0] + eye.y * n[1] + eye.z * n[2]);
    assert_true(towards > -0.05f); /* at silhouettes, where the sample lies a hair outside */
}

/* The normal is of the side that is seen, which is the front where corners go counter-clockwise around it. */
static void assert_side(const struct zr_frame *frame, size_t pixel, const zr_vec4 c[3], bool is_mirrored)
{
    const float *n = (const float *)frame->channels[ZR_CHANNEL_NORMALS] + 3 * pixel;
    const uint32_t *sides = frame->channels[ZR_CHANNEL_FRONT_FACING];
    const zr_vec3 a = {c[1].x - c[0].x, c[1].y - c[0].y, c[1].z - c[0].z};
    const zr_vec3 b = {c[2].x - c[0].x, c[2].y - c[0].y, c[2].z - c[0].z};
    const float around =
        n[0] * (a.y * b.z - a.z * b.y) + n[1] * (a.z * b.x - a.x * b.z) + n[2] * (a.x * b.y - a.y * b.x);
    assert_int_equal(sides[pixel], (around > 0.0f) != is_mirrored ? 1 : 2);
}

static void check_view(enum zr_isa isa, const char *view, bool is_parallel, bool is_two_sided)
{
    const float most = 2e-5f; /* of places as far as 10 */
    struct zr_team *team = zr_team_create_for(2, isa);
    struct reading *reading = read_text(ZR_FORMAT_JSON, scene_text(view, is_two_sided));
    const struct zr_frame *frames[ZR_SPACE_COUNT];
    for (int space = 0; space < ZR_SPACE_COUNT; space++)
        frames[space] = render(reading, team, (enum zr_space)space);
    const struct zr_frame *f = frames[0];
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    const uint32_t *instances = f->channels[ZR_CHANNEL_INSTANCE_ID];
    const float *distances = f->channels[ZR_CHANNEL_DISTANCE], *shares = f->channels[ZR_CHANNEL_BARYCENTRICS];
    const uint32_t *sides = f->channels[ZR_CHANNEL_FRONT_FACING];
    const float *positions[ZR_SPACE_COUNT];
    for (int space = 0; space < ZR_SPACE_COUNT; space++)
        positions[space] = frames[space]->channels[ZR_CHANNEL_POSITION];
    const size_t pixels = (size_t)f->width * f->height;
    uint32_t seen[3] = {0, 0, 0}, shown[3][3] = {{0}};
    for (size_t i = 0; i < pixels; i++) {
        seen[instances[i]]++;
        if (f->face_id[i] == 0) {
            assert_true(instances[i] == 0 && sides[i] == 0 && isinf(distances[i]));
            for (uint32_t k = 0; k < 3; k++)
                assert_true(positions[0][3 * i + k] == 0.0f && shares[3 * i + k] == 0.0f);
            continue;
        }
        const uint32_t face = (f->face_id[i] - 1) % TRIANGLES;
        assert_int_equal(instances[i], 1 + (f->face_id[i] - 1) / TRIANGLES);
        const zr_vec4 eye = point_of(positions[ZR_SPACE_CAMERA] + 3 * i);
        const zr_vec4 world = point_of(positions[ZR_SPACE_WORLD] + 3 * i);
        const zr_vec4 object = point_of(positions[ZR_SPACE_OBJECT] + 3 * i);
        assert_true(-eye.z == f->depth[i]); /* to the last bit */
        const float length = sqrtf(eye.x * eye.x + eye.y * eye.y + eye.z * eye.z);
        assert_true(fabsf(distances[i] - (is_parallel ? f->depth[i] : length)) <= 1e-6f * length);
        assert_near(zr_mat4_apply(&f->camera.world_to_eye, world), eye, most);
        assert_near(zr_mat4_apply(&reading->scene->instances[instances[i] - 1].object_to_world, object), world, most);
        const float *share = shares + 3 * i;
        zr_vec4 mixed = {0, 0, 0, 1}, corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            const zr_vec4 corner = mesh->positions[mesh->indices[mesh->face_offsets[face] + k]];
            const zr_mat4 *placed = &reading->scene->instances[instances[i] - 1].object_to_world;
            corners[k] = zr_mat4_apply(&f->camera.world_to_eye, zr_mat4_apply(placed, corner));
            assert_true(share[k] >= 0.0f && share[k] <= 1.0f);
            mixed = (zr_vec4){mixed.x + share[k] * corner.x, mixed.y + share[k] * corner.y,
                              mixed.z + share[k] * corner.z, 1};
        }
        assert_normal(frames, i, corners, eye, is_parallel);
        assert_side(f, i, corners, instances[i] == 2);
        shown[instances[i]][sides[i]]++;
        assert_near(mixed, object, 0.02f); /* at silhouettes, where the sample lies a hair outside */
    }
    assert_true(seen[0] > 0 && seen[1] > 300 && seen[2] > 300);
    for (int instance = 1; instance < 3; instance++)
        assert_true(shown[instance][1] > 300 && (shown[instance][2] > 300) == is_two_sided);
    zr_team_destroy(team);
    reading_free(reading);
}

static void points_depths_and_shares_agree(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    check_view(isa, "\"eye\": [1.5, 1, 2.5], \"perspective\": {\"yfovDegrees\": 40}", false, false);
    check_view(isa, "\"eye\": [0.5, 0.4, 0.6], \"perspective\": {\"yfovDegrees\": 70}, \"znear\": 0.3, \"zfar\": 3",
               false, false);
    check_view(isa, "\"preset\": \"isometric\"", true, false);
    check_view(isa, "\"preset\": \"isometric\"", true, true);
    check_view(isa,
               "\"eye\": [1, 2, 3], \"intrinsics\": {\"fx\": 150, \"fy\": 140, \"cx\": 30, \"cy\": 60, \"skew\": 5}",
               false, false);
}

/* The plane z = 0, three units in front of the camera, with a corner whose w is tiny beside those of the others: none
 * of the three may be lost, whichever it is. */
static void depth_of_a_corner_with_a_tiny_w_is_that_of_its_plane(void **state)
{
    static const char *const corners[3] = {"[-1,-1,0,1]", "[1,-1,0,1]", "[0,0,0,1e-20]"};
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    for (int turn = 0; turn < 3; turn++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "{\"window\":{\"width\":16,\"height\":16},\"meshes\":[{\"positions\":[%s,%s,%s],\"faces\":[[0,1,2]]}],"
            "\"view\":{\"eye\":[0,-0.4,3],\"target\":[0,-0.4,0],\"perspective\":{\"yfovDegrees\":50},\"znear\":1,"
            "\"zfar\":9},\"outputs\":[{\"channel\":\"position\"},{\"channel\":\"depth\"},{\"channel\":\"distance\"}]}",
            corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]);
        struct reading *reading = read_text(ZR_FORMAT_JSON, text);
        assert_read(reading);
        const struct zr_frame *frame = scene_render(&reading->arena, team, reading->scene);
        const float *positions = frame->channels[ZR_CHANNEL_POSITION],
                    *distances = frame->channels[ZR_CHANNEL_DISTANCE];
        int covered = 0;
        for (int i = 0; i < 16 * 16; i++) {
            if (isinf(frame->depth[i])) continue;
            covered++;
            if (frame->depth[i] != 3.0f || positions[3 * i + 2] != -3.0f || !(fabsf(positions[3 * i]) < 1.0f) ||
                !(distances[i] >= 3.0f && distances[i] < 3.4f))
                fail_msg("turn %d, pixel %d: depth %g, distance %g", turn, i, (double)frame->depth[i],
                         (double)distances[i]);
        }
        assert_int_equal(covered, 30);
        reading_free(reading);
    }
    zr_team_destroy(team);
}

/* Flattened, it has no way back to its own space: but each of its points is one of the mesh's. */
static void flattened_instance_has_the_points_of_its_mesh(void **state)
{
    (void)state;
    struct reading *reading = read_text(
        ZR_FORMAT_JSON, "{\"version\": 1, \"window\": {\"width\": 8, \"height\": 8}, \"view\": {\"preset\": \"front\"},"
                        "\"nodes\": [{\"mesh\": 0, \"scale\": [1, 1, 0]}], \"meshes\": [{\"positions\": [[0, 0, 1],"
                        "[1, 0, 2], [1, 1, 3]], \"faces\": [[0, 1, 2]]}]}");
    const struct zr_frame *frame = render(reading, NULL, ZR_SPACE_OBJECT);
    const float *positions = frame->channels[ZR_CHANNEL_POSITION];
    int seen = 0;
    for (size_t i = 0; i < 64; i++) {
        const float *p = positions + 3 * i;
        if (frame->face_id[i] == 0) continue;
        assert_true(fabsf(p[2] - (1.0f + p[0] + p[1])) < 1e-5f);
        seen++;
    }
    assert_true(seen > 10);
    reading_free(reading);
}

/* A face that is not convex, beside a line: as it is, in a mirror, and turned around. */
static void shapes_have_sides_and_lines_have_none(void **state)
{
    static const uint32_t wanted[7] = {0, 1, 0, 1, 0, 2, 0}; /* by faceId: of each instance the face, then the line */
    uint32_t seen[7] = {0};
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    struct reading *reading =
        read_text(ZR_FORMAT_JSON,
                  "{\"version\": 1, \"window\": {\"width\": 48, \"height\": 24}, \"view\": {\"preset\": \"front\"},"
                  "\"nodes\": [{\"mesh\": 0}, {\"mesh\": 0, \"translation\": [7, 0, 0], \"scale\": [-1, 1, 1]},"
                  "{\"mesh\": 0, \"translation\": [11, 0, 0], \"rotation\": [0, 1, 0, 0]}],"
                  "\"meshes\": [{\"positions\": [[0, 0, 0], [2, 1, 0], [0, 2, 0], [1, 1, 0], [3, 0, 0], [3, 2, 0]],"
                  "\"faces\": [[0, 1, 2, 3]], \"lines\": [[4, 5]], \"doubleSided\": true}]}");
    const struct zr_frame *frame = render(reading, team, ZR_SPACE_CAMERA);
    const uint32_t *sides = frame->channels[ZR_CHANNEL_FRONT_FACING];
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        seen[frame->face_id[i]]++;
        assert_int_equal(sides[i], wanted[frame->face_id[i]]);
    }
    for (int id = 0; id < 7; id++)
        assert_true(seen[id] > 3);
    zr_team_destroy(team);
    reading_free(reading);
}

/* The same view by one matrix, which has the eye somewhere else than its own space's origin. */
static void one_matrix_for_all_has_an_eye_too(void **state)
{
    (void)state;
    static const char polygon[] = "\"polygons\": [{\"vertices\": [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]}]";
    static const char start[] = "{\"version\": 1, \"window\": {\"width\": 9, \"height\": 9}, \"view\": {";
    char text[1000];
    /* P of yfov 90 degrees, near 1, far 9; the camera at z = 3. */
    snprintf(text, sizeof text, "%s\"projectionMatrix\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.25, -1, 0, 0, 1.5, 3]}, %s}",
             start, polygon);
    struct reading *one = read_text(ZR_FORMAT_JSON, text);
    snprintf(text, sizeof text,
             "%s\"eye\": [0, 0, 3], \"perspective\": {\"yfovDegrees\": 90}, \"znear\": 1, \"zfar\": 9}, %s}", start,
             polygon);
    struct reading *two = read_text(ZR_FORMAT_JSON, text);
    const float *got = render(one, NULL, ZR_SPACE_CAMERA)->channels[ZR_CHANNEL_DISTANCE];
    const float *want = render(two, NULL, ZR_SPACE_CAMERA)->channels[ZR_CHANNEL_DISTANCE];
    for (size_t i = 0; i < 81; i++)
        assert_true(fabsf(got[i] - want[i]) < 1e-5f);
    assert_true(want[40] == 3.0f);
    reading_free(one);
    reading_free(two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(points_depths_and_shares_agree),
        TEST_EACH_ISA(depth_of_a_corner_with_a_tiny_w_is_that_of_its_plane),
        cmocka_unit_test(flattened_instance_has_the_points_of_its_mesh),
        TEST_EACH_ISA(shapes_have_sides_and_lines_have_none),
        cmocka_unit_test(one_matrix_for_all_has_an_eye_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
