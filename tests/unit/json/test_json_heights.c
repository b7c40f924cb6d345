/* Meshes that are grids of heights. */
#include "unit/common/json_check.h"

#include <math.h>

#include "base/run.h"
#include "shade/frame.h"
#include "support/tests.h"

static const char *with_mesh(const char *mesh)
{
    static char text[8192];
    snprintf(text, sizeof text, "{\"meshes\": [{%s}]}", mesh);
    return text;
}

static struct reading *read_mesh(const char *mesh)
{
    return read_scene(with_mesh(mesh));
}

static void assert_point(const struct zr_mesh *mesh, uint32_t number, float x, float y, float z)
{
    assert_true(number < mesh->position_count);
    const zr_vec4 *p = &mesh->positions[number];
    if (p->x != x || p->y != y || p->z != z || p->w != 1)
        fail_msg("position %u is %g %g %g %g", number, (double)p->x, (double)p->y, (double)p->z, (double)p->w);
}

static void assert_quads(const struct zr_mesh *mesh, uint32_t count, const uint32_t *corners)
{
    assert_int_equal(mesh->face_count, count);
    for (uint32_t f = 0; f <= count; f++)
        assert_int_equal(mesh->face_offsets[f], 4 * f);
    assert_memory_equal(mesh->indices, corners, 4 * (size_t)count * sizeof *corners);
}

TEST(rows_become_quads_row_by_row)
{
    struct reading *reading = read_mesh("\"heights\": [[1,2,3],[4,5,6],[7,8,9]]");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t corners[16] = {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7};
    assert_int_equal(mesh->position_count, 9);
    for (uint32_t i = 0; i < 9; i++)
        assert_point(mesh, i, (float)(i % 3), (float)(i / 3), (float)(i + 1));
    assert_quads(mesh, 4, corners);
    const struct zr_material *material = &reading->scene->materials[mesh->material];
    assert_true(material->double_sided);
    assert_int_equal(material->shading, ZR_SHADING_GOURAUD);
    reading_free(reading);
}

TEST(ranges_spread_columns_and_rows)
{
    struct reading *reading =
        read_mesh("\"heights\": {\"values\": [[0,0,0,0],[1,1,1,1]], \"x\": [-1,0.5], \"y\": [0.1,0.7]}");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_point(mesh, 0, -1, 0.1f, 0);
    assert_point(mesh, 1, -0.5f, 0.1f, 0);
    assert_point(mesh, 2, 0, 0.1f, 0);
    assert_point(mesh, 7, 0.5f, 0.7f, 1);
    reading_free(reading);
    reading = read_mesh("\"heights\": {\"values\": [[0,0],[1,1]], \"y\": [3,5]}");
    assert_point(&reading->scene->meshes[0], 3, 1, 5, 1);
    reading_free(reading);
}

TEST(cells_stay_counter_clockwise_where_an_axis_runs_down)
{
    static const char *const ranges[] = {"", ", \"x\": [1,0]", ", \"y\": [1,0]", ", \"x\": [1,0], \"y\": [1,0]"};
    for (int i = 0; i < 4; i++) {
        char text[256];
        snprintf(text, sizeof text, "\"heights\": {\"values\": [[0,0,0],[0,0,0]]%s}", ranges[i]);
        struct reading *reading = read_mesh(text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        for (uint32_t f = 0; f < 2; f++) {
            const zr_vec4 *a = &mesh->positions[mesh->indices[4 * f]], *b = &mesh->positions[mesh->indices[4 * f + 1]],
                          *c = &mesh->positions[mesh->indices[4 * f + 2]];
            assert_true((b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y) > 0);
        }
        reading_free(reading);
    }
}

TEST(cells_that_touch_a_hole_are_left_out_with_all_that_is_theirs)
{
    /* 4 columns, 3 rows: the hole takes four of the six cells, and nothing is left around 0, 1, 2, 4, 6, 8, 9 but
     * the two cells on the right. */
    struct reading *reading = read_mesh(
        "\"heights\": [[0,1,2,3],[4,null,6,7],[8,9,10,11]], \"normals\": [[0,0,1],[0,1,1],[0,2,1],[0,3,1],[0,4,1],"
        "[0,5,1],[0,6,1],[0,7,1],[0,8,1],[0,9,1],[0,10,1],[0,11,1]], \"colors\": [[0,0,0],[0,0,0.1],[0,0,0.2],"
        "[0,0,0.3],[0,0,0.4],[0,0,0.5],[0,0,0.6],[0,0,0.7],[0,0,0.8],[0,0,0.9],[0,0,1],[0,1,1]], \"faceColors\": "
        "[[1,0,0],[1,0,0],[0,0.5,0],[1,0,0],[1,0,0],[0,0.25,0]]");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t corners[8] = {0, 1, 3, 2, 2, 3, 5, 4}, kept[6] = {2, 3, 6, 7, 10, 11};
    assert_int_equal(mesh->position_count, 6);
    assert_int_equal(mesh->normal_count, 6);
    assert_quads(mesh, 2, corners);
    for (uint32_t i = 0; i < 6; i++) {
        assert_point(mesh, i, (float)(kept[i] % 4), (float)(kept[i] / 4), (float)kept[i]);
        assert_true(mesh->normals[i].y == (float)kept[i]);
        assert_true(mesh->colors[i].z == (kept[i] >= 10 ? 1.0f : (float)(kept[i] * 0.1)));
    }
    assert_true(mesh->face_colors[0].y == 0.5f && mesh->face_colors[1].y == 0.25f);
    struct zr_bounds bounds = zr_bounds_of(reading->scene, NULL, NULL);
    assert_true(bounds.min.x == 2 && bounds.min.z == 2 && bounds.max.z == 11);
    reading_free(reading);
}

TEST(looks_may_be_said_otherwise)
{
    struct reading *reading = read_scene(
        "{\"shading\": \"flat\", \"materials\": [{\"name\": \"m\", \"doubleSided\": false}], \"meshes\": "
        "[{\"heights\": "
        "[[0,0],[0,1]], \"material\": \"m\"}, {\"heights\": [[0,0],[0,1]], \"doubleSided\": false, \"shading\": "
        "\"unlit\"}, {\"heights\": [[0,0],[0,1]]}, {" POSITIONS ", \"faces\": [[0,1,2]]}]}");
    const struct zr_scene *scene = reading->scene;
    const struct zr_material *m[4];
    for (int i = 0; i < 4; i++)
        m[i] = &scene->materials[scene->meshes[i].material];
    assert_true(!m[0]->double_sided && !m[1]->double_sided && m[2]->double_sided && !m[3]->double_sided);
    assert_int_equal(m[0]->shading, ZR_SHADING_FLAT);
    assert_int_equal(m[1]->shading, ZR_SHADING_UNLIT);
    assert_int_equal(m[2]->shading, ZR_SHADING_FLAT);
    reading_free(reading);
}

TEST(rows_longer_than_coordinates_reach_need_a_range)
{
    struct zr_limits limits = zr_limits_default();
    limits.coordinate_max = 2;
    const char *text = with_mesh("\"heights\": [[1,1,1,1],[1,1,1,1]]");
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text, strlen(text), limits, (size_t)1 << 20);
    assert_complaint(reading, ZR_BAD_SCENE, "/meshes/0/heights", "3 steps of 1 lead beyond 2; give x");
    reading_free(reading);
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    const char *text = with_mesh("\"heights\": [[0,1,2],[3,4,5],[6,7,null]], \"colors\": [[0,0,0],[0,0,0],[0,0,0],"
                                 "[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]], \"normals\": [[0,0,1],[0,0,1],"
                                 "[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1],[0,0,1]], \"faceColors\": "
                                 "[[0,0,0],[0,0,0],[0,0,0],[0,0,0]]");
    assert_true(smallest_ceiling((struct zr_request){.channel = "depth"}, text, strlen(text), 65536) > 1024);
}

/* ---- pictures ---- */

#define PICTURE "\"window\": {\"width\": 64, \"height\": 48}, \"outputs\": [{\"channel\": \"depth\"}], \"meshes\": "

static const struct zr_frame *render(struct reading *reading)
{
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame = NULL;
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame), ZR_OK);
    return frame;
}

TEST(tilted_plane_has_the_depth_of_the_same_polygons)
{
    struct reading *grid = read_scene(
        "{" PICTURE "[{\"heights\": {\"values\": [[1,0.75,0.5],[0.5,0.25,0]], \"x\": [-1,1], \"y\": [0,1]}}]}");
    struct reading *mesh = read_scene("{" PICTURE "[{\"doubleSided\": true, \"positions\": [[-1,0,1],[0,0,0.75],"
                                      "[1,0,0.5],[-1,1,0.5],[0,1,0.25],[1,1,0]], \"faces\": [[0,1,4,3],[1,2,5,4]]}]}");
    const struct zr_frame *a = render(grid), *b = render(mesh);
    assert_true(a->covered_pixels > 500);
    assert_memory_equal(a->depth, b->depth, (size_t)64 * 48 * sizeof(float));
    reading_free(grid);
    reading_free(mesh);
}

TEST(steep_cells_are_no_concave_polygons)
{
    /* In its mean plane this quad has a dent; above x and y it has none. */
    struct reading *reading = read_scene("{" PICTURE "[{\"heights\": [[0,-2],[-2,2]]}]}");
    const struct zr_frame *frame = render(reading);
    assert_int_equal(frame->counts.concave_polygons, 0);
    assert_int_equal(frame->counts.triangles, 2);
    reading_free(reading);
    reading = read_scene("{" PICTURE "[{\"positions\": [[0,0,0],[1,0,-2],[1,1,2],[0,1,-2]], \"faces\": [[0,1,2,3]]}]}");
    assert_int_equal(render(reading)->counts.concave_polygons, 1);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
