/* Bare meshes of points only: the size of the points, and the edges that the looks omit. */
#include "base/team.h"
#include "input/query/cloud.h"
#include "render_request.h"
#include "scene/looks.h"
#include "scene/parsed_picture.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA((size_t)1 << 29)

/* A scene of one mesh of points, in its own axes. */
struct cloud {
    struct zr_scene scene;
    struct zr_parsed_picture picture;
    struct zr_scene_builder builder;
    struct zr_instance instance;
    struct zr_material material;
    struct zr_mesh mesh;
    zr_vec4 *positions;
    uint32_t *points;
};

static void open_cloud(struct cloud *cloud, uint32_t count)
{
    cloud->positions = zr_arena_alloc(&arena, count, sizeof *cloud->positions);
    cloud->points = zr_arena_alloc(&arena, count, sizeof *cloud->points);
    assert_true(cloud->positions && cloud->points);
    for (uint32_t i = 0; i < count; i++)
        cloud->points[i] = i;
    cloud->mesh = (struct zr_mesh){.name = "",
                                   .position_count = count,
                                   .positions = cloud->positions,
                                   .point_count = count,
                                   .points = cloud->points};
    cloud->instance = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    cloud->scene = (struct zr_scene){.look = zr_look_find("blueprint"),
                                     .mesh_count = 1,
                                     .meshes = &cloud->mesh,
                                     .instance_count = 1,
                                     .instances = &cloud->instance};
    cloud->picture = (struct zr_parsed_picture){.merged = *cloud->scene.look->picture};
    cloud->scene.picture = &cloud->picture.merged;
    cloud->scene.views[0] = (struct zr_view){.width = 640, .height = 480};
    cloud->builder = (struct zr_scene_builder){
        .arena = &arena, .scene = &cloud->scene, .meshes = &cloud->mesh, .materials = &cloud->material};
}

/* side x side points with a distance of 1, on a plane. */
static void open_plane(struct cloud *cloud, uint32_t side, float distance)
{
    open_cloud(cloud, side * side);
    for (uint32_t i = 0; i < side * side; i++)
        cloud->positions[i] = (zr_vec4){distance * (float)(i % side), 7, distance * (float)(i / side), 1};
}

/* The diagonal is 480 pixels. The size of a point is 1.5 times the distance of neighbours. */
TEST_AROUND(size_follows_the_density, open_arena, close_arena)
{
    static const struct {
        uint32_t side;
        double least, most;
    } cases[] = {{1, 12, 12}, {2, 12, 12}, {20, 12, 12}, {60, 7, 9.5}, {100, 4.5, 6}, {200, 2.2, 3}, {600, 1, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 3; k++) {
            static const float distances[] = {1, 1e-6f, 1e3f};
            struct cloud cloud;
            open_plane(&cloud, cases[i].side, distances[k]);
            const double size = (double)zr_point_size_for(&arena, NULL, &cloud.scene, &cloud.scene.views[0]);
            if (!(size >= cases[i].least && size <= cases[i].most))
                fail_msg("%u points a side: %.9g pixels", cases[i].side, size);
        }
}

static float part(struct random *random, double most)
{
    return (float)random_range(random, 0, most);
}

TEST_AROUND(size_is_the_same_by_any_number_of_threads, open_arena, close_arena)
{
    struct cloud cloud;
    struct random random = random_seeded(1);
    struct zr_team *team = zr_team_create(5);
    assert_non_null(team);
    open_cloud(&cloud, 100000);
    for (uint32_t i = 0; i < cloud.mesh.position_count; i++)
        cloud.positions[i] = (zr_vec4){part(&random, 1), part(&random, 1), part(&random, 0.1), 1};
    assert_true(zr_point_size_for(&arena, team, &cloud.scene, &cloud.scene.views[0]) ==
                zr_point_size_for(&arena, NULL, &cloud.scene, &cloud.scene.views[0]));
    zr_team_destroy(team);
}

TEST_AROUND(points_have_the_size_of_their_reader_or_one_by_density, open_arena, close_arena)
{
    struct cloud cloud;
    struct zr_query query = {.given.builder = &cloud.builder};
    open_plane(&cloud, 100, 1);
    cloud.mesh.point_size = 3;
    zr_cloud_size_points(&query);
    assert_true(cloud.mesh.point_size == 3 && !cloud.mesh.points_are_round);
    cloud.mesh.point_size = 0;
    zr_cloud_size_points(&query);
    assert_true(cloud.mesh.point_size > 4 && cloud.mesh.point_size < 6 && cloud.mesh.points_are_round);
    cloud.mesh.point_size = 0;
    cloud.scene.look = zr_look_textbook();
    cloud.mesh.points_are_round = false;
    zr_cloud_size_points(&query);
    assert_true(cloud.mesh.point_size > 4 && !cloud.mesh.points_are_round);
}

TEST_AROUND(clouds_have_no_edges_but_their_ink, open_arena, close_arena)
{
    static const zr_vec4 colors[4];
    struct cloud cloud;
    struct zr_request request = {.size = 0};
    struct zr_query query = {.request = &request,
                             .given = {.scene = &cloud.scene, .picture = &cloud.picture, .builder = &cloud.builder}};
    open_plane(&cloud, 2, 1);
    assert_true(cloud.scene.picture->edges.is_on);
    assert_true(zr_cloud_take_edges(&query.given) && !cloud.scene.picture->edges.is_on);
    assert_false(zr_cloud_take_edges(&query.given)); /* none to take */
    cloud.picture.merged.edges.is_on = true;
    cloud.mesh.line_count = 1;
    assert_false(zr_cloud_take_edges(&query.given));
    cloud.mesh.line_count = 0;
    zr_picture_give(query.given.picture, ZR_PICTURE_EDGES);
    assert_false(zr_cloud_take_edges(&query.given));
    zr_cloud_draw_in_ink(&query);
    const zr_vec3 ink = cloud.scene.picture->edges.color;
    assert_true(zr_vec4_equal(cloud.material.base_color, (zr_vec4){ink.x, ink.y, ink.z, 1}));
    const struct zr_look *old = cloud.scene.look, *with_cloud = zr_look_find("technical");
    cloud.scene.look = with_cloud; /* its ink hides what lies in front; another ink that is given is kept */
    cloud.picture.merged.edges.color = with_cloud->picture->edges.color;
    zr_cloud_draw_in_ink(&query);
    assert_true(with_cloud->cloud.x > 0.3f && zr_vec4_equal(cloud.material.base_color, with_cloud->cloud));
    cloud.picture.merged.edges.color = (zr_vec3){1, 0, 0};
    zr_cloud_draw_in_ink(&query);
    assert_true(zr_vec4_equal(cloud.material.base_color, (zr_vec4){1, 0, 0, 1}));
    cloud.scene.look = old;
    cloud.material.base_color = (zr_vec4){1, 1, 1, 1};
    request.color = "white";
    zr_cloud_draw_in_ink(&query);
    request.color = NULL;
    cloud.mesh.colors = colors;
    zr_cloud_draw_in_ink(&query);
    assert_true(cloud.material.base_color.x == 1);
}

TEST_AROUND(lines_alone_have_the_looks_colour_of_lines, open_arena, close_arena)
{
    struct cloud cloud;
    struct zr_request request = {.size = 0};
    struct zr_query query = {.request = &request,
                             .given = {.scene = &cloud.scene, .picture = &cloud.picture, .builder = &cloud.builder}};
    open_plane(&cloud, 2, 1);
    const zr_vec4 own = cloud.material.base_color;
    cloud.mesh.line_count = 1;
    zr_wire_color(&query); /* this look has none */
    assert_true(zr_vec4_equal(cloud.material.base_color, own));
    cloud.scene.look = zr_look_find("clay");
    cloud.mesh.face_count = 1;
    zr_wire_color(&query);
    assert_true(zr_vec4_equal(cloud.material.base_color, own));
    cloud.mesh.face_count = 0;
    zr_wire_color(&query);
    assert_true(zr_vec4_equal(cloud.material.base_color, cloud.scene.look->wire) && cloud.scene.look->wire.w == 1);
}

RUN_TESTS(NULL, NULL)
