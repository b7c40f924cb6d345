/* The hierarchy of nodes as JSON has it. */
#include "unit/common/json_check.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/run.h"
#include "scene/parts/nodes.h"
#include "shade/frame.h"
#include "support/tests.h"

#define MESHES                                                                                                         \
    "\"meshes\": [{\"name\": \"a\", " POSITIONS ", \"faces\": [[0,1,2]]}, {\"name\": \"b\", " POSITIONS                \
    ", \"faces\": [[0,1,2],[2,1,3]]}, {\"name\": \"twin\", " POSITIONS                                                 \
    ", \"faces\": []}, {\"name\": \"twin\", " POSITIONS ", \"faces\": []}]"

static const char *with_nodes(const char *nodes, const char *rest)
{
    static char text[8192];
    snprintf(text, sizeof text, "{" MESHES ", \"nodes\": [%s]%s}", nodes, rest);
    return text;
}

static void assert_matrix(const struct zr_scene *scene, uint32_t instance, zr_mat4 want)
{
    const zr_mat4 *got = &scene->instances[instance].object_to_world;
    for (int i = 0; i < 16; i++)
        if (got->m[i] != want.m[i])
            fail_msg("entry %d of instance %u is %.9g, not %.9g", i, instance, (double)got->m[i], (double)want.m[i]);
}

TEST(nodes_place_meshes_and_polygons_come_last)
{
    struct reading *reading = read_scene(
        with_nodes("{\"name\": \"arm\", \"mesh\": \"b\", \"translation\": [1,2,3], \"children\": [\"hand\", 2]},"
                   "{\"mesh\": 0}, {\"name\": \"hand\", \"mesh\": 0, \"scale\": [2,2,2]}, {\"children\": [\"arm\"]}",
                   ", " POLYGONS));
    const struct zr_scene *scene = reading->scene;
    const uint32_t meshes[5] = {0, 1, 0, 0, 4};
    assert_int_equal(scene->mesh_count, 5);
    assert_int_equal(scene->instance_count, 5);
    for (uint32_t i = 0; i < 5; i++)
        assert_int_equal(scene->instances[i].mesh, meshes[i]);
    const zr_mat4 arm = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}},
                  hand = {{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1}};
    assert_matrix(scene, 0, zr_mat4_identity());
    assert_matrix(scene, 1, arm);
    assert_matrix(scene, 2, hand);
    assert_matrix(scene, 3, hand);
    assert_matrix(scene, 4, zr_mat4_identity());
    assert_int_equal(scene->warning_count, 1);
    assert_string_equal(scene->warnings[0], "2 of 4 meshes are placed by no node and are not drawn");
    reading_free(reading);
}

TEST(instances_have_the_names_of_their_nodes)
{
    struct reading *reading =
        read_scene(with_nodes("{\"name\": \"left\", \"mesh\": 0}, {\"name\": \"\", \"mesh\": 0}, {\"mesh\": 0},"
                              "{\"name\": \"right\", \"children\": [4]}, {\"name\": \"wheel\", \"mesh\": 0}",
                              ", " POLYGONS));
    const struct zr_scene *scene = reading->scene;
    static const char *const names[] = {"left", NULL, NULL, "wheel", NULL};
    assert_int_equal(scene->instance_count, 5);
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(scene->instances[i].node != NULL, names[i] != NULL);
        if (names[i]) assert_string_equal(scene->instances[i].node, names[i]);
    }
    reading_free(reading);
}

TEST(transformations_are_those_of_gltf)
{
    struct reading *reading =
        read_scene(with_nodes("{\"mesh\": 0, \"matrix\": [1,2,3,0, 4,5,6,0, 7,8,9,0, 10,11,12,1]},"
                              "{\"mesh\": 0, \"matrix\": [[1,4,7,10],[2,5,8,11],[3,6,9,12],[0,0,0,1]]},"
                              "{\"mesh\": 0, \"translation\": [5,6,7], \"rotation\": [0,0,1,1], \"scale\": [2,3,-4]},"
                              "{\"mesh\": 0, \"rotation\": [-0.5,-0.5,-0.5,-0.5]},"
                              "{\"mesh\": 0, \"rotation\": [0.6,0,0,0.8]}, {\"mesh\": 0, \"scale\": [1,0,1]}",
                              ""));
    const zr_mat4 given = {{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1}};
    assert_matrix(reading->scene, 0, given);
    assert_matrix(reading->scene, 1, given);
    /* A quarter turn about z after the scale: x to y, y to -x. */
    assert_matrix(reading->scene, 2, (zr_mat4){{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 5, 6, 7, 1}});
    /* A third of a turn about (1, 1, 1): x to y, y to z, z to x. */
    assert_matrix(reading->scene, 3, (zr_mat4){{0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1}});
    /* cos = 0.8^2 - 0.6^2, sin = 2 * 0.8 * 0.6, about x. */
    const float *turn = reading->scene->instances[4].object_to_world.m;
    assert_true(turn[0] == 1 && fabsf(turn[5] - 0.28f) < 1e-7f && fabsf(turn[6] - 0.96f) < 1e-7f);
    assert_true(fabsf(turn[9] + 0.96f) < 1e-7f && fabsf(turn[10] - 0.28f) < 1e-7f);
    assert_matrix(reading->scene, 5, (zr_mat4){{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    reading_free(reading);
}

TEST(without_nodes_every_mesh_is_drawn_once)
{
    struct reading *reading = read_scene("{" MESHES ", " POLYGONS "}");
    assert_int_equal(reading->scene->instance_count, 5);
    assert_int_equal(reading->scene->instances[4].mesh, 4);
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
}

TEST(nodes_without_meshes_leave_the_polygons)
{
    struct reading *reading = read_scene("{\"nodes\": [{\"children\": [1]}, {}], " POLYGONS "}");
    assert_int_equal(reading->scene->instance_count, 1);
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
    reading = read_scene(with_nodes("", ", " POLYGONS));
    assert_int_equal(reading->scene->instance_count, 1);
    assert_string_equal(reading->scene->warnings[0], "4 of 4 meshes are placed by no node and are not drawn");
    reading_free(reading);
}

TEST(names_that_nothing_refers_to_need_not_be_unique)
{
    struct reading *reading =
        read_scene(with_nodes("{\"name\": \"n\", \"mesh\": 0}, {\"name\": \"n\", \"mesh\": 1}", ""));
    assert_int_equal(reading->scene->instance_count, 2);
    reading_free(reading);
}

/* Nodes of which each has the next for a child, `times` times, and the last a mesh. */
static char *chain_scene(int length, int times)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "{" MESHES ", \"nodes\": [");
    for (int i = 0; i + 1 < length; i++) {
        fprintf(out, "{\"children\": [%d", i + 1);
        for (int k = 1; k < times; k++)
            fprintf(out, ", %d", i + 1);
        fprintf(out, "]},");
    }
    fprintf(out, "{\"mesh\": 1}]}");
    fclose(out);
    return text;
}

TEST(hierarchies_beyond_the_limits_are_refused_by_name)
{
    char *text = chain_scene(41, 2);
    free(text);
    text = chain_scene(100000, 1);
    free(text);
    text = chain_scene(ZR_NODES_DEPTH_MAX, 1);
    struct reading *reading = read_scene(text);
    assert_int_equal(reading->scene->instance_count, 1);
    reading_free(reading);
    free(text);
    text = chain_scene(13, 2);
    struct zr_limits limits = zr_limits_default();
    limits.instances_max = 4095;
    reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text, strlen(text), limits, (size_t)1 << 28);
    assert_complaint(reading, ZR_BAD_SCENE, "/nodes", "limit of 4095 instances");
    reading_free(reading);
    free(text);
}

/* 99 856 instances, each below 250 nodes: two times 316 children, and then a chain. */
TEST(shared_nodes_below_one_another_are_refused)
{
    enum { TIMES = 316, LINKS = 247, SIZE = 1 << 14 };
    char *text = malloc(SIZE);
    assert_non_null(text);
    int used = snprintf(text, SIZE, "{" MESHES ", \"nodes\": [");
    for (int k = 0; k < 2; k++) {
        used += snprintf(text + used, SIZE - (size_t)used, "{\"children\": [%d", k + 1);
        for (int i = 1; i < TIMES; i++)
            used += snprintf(text + used, SIZE - (size_t)used, ",%d", k + 1);
        used += snprintf(text + used, SIZE - (size_t)used, "]},");
    }
    for (int k = 2; k < 2 + LINKS; k++)
        used += snprintf(text + used, SIZE - (size_t)used, "{\"children\": [%d]},", k + 1);
    snprintf(text + used, SIZE - (size_t)used, "{\"mesh\": 0}]}");
    refuses_scene(text, "/nodes", "shared nodes are visited 24764605 times");
    free(text);
}

TEST(points_placed_beyond_the_memory_are_refused_before_they_are_walked)
{
    char *text = chain_scene(17, 2); /* 65536 times 4 points of 24 bytes, and the instances themselves */
    for (int mib = 10; mib <= 16; mib += 6) {
        struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text, strlen(text),
                                               zr_limits_default(), (size_t)mib << 20);
        assert_int_equal(reading->status, mib == 10 ? ZR_NO_MEMORY : ZR_OK);
        reading_free(reading);
    }
    free(text);
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    const char *text = with_nodes("{\"name\": \"n\", \"mesh\": \"a\", \"children\": [\"m\"]}, {\"name\": \"m\", "
                                  "\"mesh\": 1}",
                                  "");
    assert_true(smallest_ceiling((struct zr_request){.channel = "depth"}, text, strlen(text), 65536) > 1024);
}

/* ---- pictures ---- */

#define CUBE "\"view\": {\"preset\": \"isometric\"}, " CUBE_ANYHOW
#define CUBE_ANYHOW                                                                                                    \
    "\"window\": {\"width\": 64, \"height\": 64}, \"meshes\": "                                                        \
    "[{\"positions\": "                                                                                                \
    "[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]], \"faces\": [[1,3,7,5],"            \
    "[0,4,6,2],[2,6,7,3],[0,1,5,4],[4,5,7,6],[0,2,3,1]]}], \"outputs\": [{\"channel\": \"faceId\"}]"

/* A bit for each face that is seen, face 1 the lowest. */
static unsigned faces_seen(const char *text)
{
    struct reading *reading = read_scene(text);
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame), ZR_OK);
    unsigned seen = 0;
    for (int i = 0; i < 64 * 64; i++)
        seen |= 1u << frame->face_id[i];
    reading_free(reading);
    return seen >> 1;
}

TEST(mirrored_cube_shows_its_outside)
{
    enum { RIGHT = 1, LEFT = 2, TOP = 4, NEAR = 16 };
    assert_int_equal(faces_seen("{" CUBE "}"), RIGHT | TOP | NEAR);
    assert_int_equal(faces_seen("{" CUBE ", \"nodes\": [{\"mesh\": 0}]}"), RIGHT | TOP | NEAR);
    assert_int_equal(faces_seen("{" CUBE ", \"nodes\": [{\"mesh\": 0, \"scale\": [-1,1,1]}]}"), LEFT | TOP | NEAR);
    assert_int_equal(
        faces_seen("{" CUBE
                   ", \"nodes\": [{\"scale\": [1,1,-1], \"children\": [1]}, {\"mesh\": 0, \"scale\": [1,1,-1]}]}"),
        RIGHT | TOP | NEAR);
}

/* A camera in a mirror sees the faces that it would see without. */
TEST(mirrored_camera_sees_the_outside)
{
    enum { RIGHT = 1, LEFT = 2, TOP = 4, BOTTOM = 8, NEAR = 16 };
#define SEEN_BY(pose) ", \"view\": {" pose ", \"perspective\": {\"yfovDegrees\": 45}}}"
    assert_int_equal(
        faces_seen("{" CUBE_ANYHOW SEEN_BY("\"worldToCamera\": [[-1,0,0,2],[0,1,0,-2],[0,0,1,-6],[0,0,0,1]]")),
        RIGHT | TOP | NEAR);
    assert_int_equal(
        faces_seen("{" CUBE_ANYHOW SEEN_BY("\"cameraToWorld\": [[1,0,0,-2],[0,-1,0,-2],[0,0,1,6],[0,0,0,1]]")),
        LEFT | BOTTOM | NEAR);
    assert_int_equal(faces_seen("{" CUBE_ANYHOW ", \"nodes\": [{\"mesh\": 0, \"scale\": [-1,1,1]}]" SEEN_BY(
                         "\"worldToCamera\": [[-1,0,0,2],[0,1,0,-2],[0,0,1,-6],[0,0,0,1]]")),
                     LEFT | TOP | NEAR);
#undef SEEN_BY
}

RUN_TESTS(NULL, NULL)
