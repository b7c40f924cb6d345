/* From window vertices back to the mesh. */
#include "geometry/geometry.h"
#include "support/tests.h"

/* Meshes of 3, 0 and 4 positions; the first one's two triangles were cut into 4 and 5 vertices, and one of the
 * last one's: 0 1 2 | 3 4 5 6, 7 8 9 10 11 | | 12 13 14 15 | 16 17 18. */
static const zr_vec4 three[3] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}};
static const zr_vec4 four[4] = {{0, 1, 0, 1}, {1, 1, 0, 1}, {2, 1, 0, 1}, {3, 1, 0, 1}};
static const struct zr_mesh meshes[3] = {
    {.position_count = 3, .positions = three}, {.position_count = 0}, {.position_count = 4, .positions = four}};

static void assert_source(uint32_t v0, uint32_t v1, uint32_t v2, const zr_vec4 *positions, const uint32_t want[3])
{
    struct zr_source_instance instances[3] = {{.first_vertex = 0, .mesh = &meshes[0]},
                                              {.first_vertex = 12, .mesh = &meshes[1]},
                                              {.first_vertex = 12, .mesh = &meshes[2]}};
    struct zr_cut cuts[3] = {{.first_vertex = 3, .corners = {2, 1, 0}},
                             {.first_vertex = 7, .corners = {0, 2, 1}},
                             {.first_vertex = 16, .corners = {3, 1, 2}}};
    const struct zr_geometry geometry = {.instances = instances, .cut_count = 3, .cuts = cuts};
    const uint32_t instance = v0 < 12 ? 0 : 2;
    const struct zr_draw draw = {
        .instance = instance, .mesh = &meshes[instance], .first_vertex = instances[instance].first_vertex};
    struct zr_source source = zr_source_of(&geometry, &draw, (const uint32_t[3]){v0, v1, v2});
    assert_ptr_equal(source.instance->mesh->positions, positions);
    for (int k = 0; k < 3; k++)
        assert_ptr_equal(source.corners[k], &positions[want[k]]);
}

TEST(whole_triangles_have_the_positions_of_their_vertices)
{
    assert_source(0, 1, 2, three, (const uint32_t[3]){0, 1, 2});
    assert_source(2, 0, 1, three, (const uint32_t[3]){2, 0, 1});
    assert_source(12, 15, 13, four, (const uint32_t[3]){0, 3, 1});
    assert_source(15, 14, 12, four, (const uint32_t[3]){3, 2, 0});
}

TEST(pieces_have_the_corners_of_what_was_cut)
{
    assert_source(3, 4, 5, three, (const uint32_t[3]){2, 1, 0});
    assert_source(6, 5, 3, three, (const uint32_t[3]){2, 1, 0});
    assert_source(7, 8, 9, three, (const uint32_t[3]){0, 2, 1});
    assert_source(11, 10, 7, three, (const uint32_t[3]){0, 2, 1});
    assert_source(16, 17, 18, four, (const uint32_t[3]){3, 1, 2});
    assert_source(18, 17, 16, four, (const uint32_t[3]){3, 1, 2});
}

TEST(matrices_lead_to_clip_and_eye_space)
{
    struct zr_camera camera = {.world_to_eye = zr_mat4_identity(), .projection = zr_mat4_identity()};
    zr_mat4 object_to_world = zr_mat4_identity();
    object_to_world.m[12] = 3;
    camera.world_to_eye.m[14] = -5;
    camera.projection = (zr_mat4){{2, 0, 0, 0, 0, 4, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0}};
    struct zr_source_instance at = zr_source_instance_make(&camera, &object_to_world, &meshes[0], 7);
    const double position[4] = {1, 0.5, -2, 1}, want[ZR_SOURCE_ROWS] = {8, 2, 7, 7, 1};
    assert_int_equal(at.first_vertex, 7);
    for (int r = 0; r < ZR_SOURCE_ROWS; r++) {
        double sum = 0;
        for (int c = 0; c < 4; c++)
            sum += at.columns[c][r] * position[c];
        assert_true(sum == want[r]);
    }
}

RUN_TESTS(NULL, NULL)
