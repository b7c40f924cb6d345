/* Lines of a mesh before visibility: borders, contours and creases, counted beside those of vtkFeatureEdges. */
#include "base/run.h"
#include "lines/features.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1u << 30)

static const struct zr_feature_rule usual = {.crease_degrees = 30, .keeps_noise = true},
                                    smooth = {.crease_degrees = 30};

static uint8_t *find(const struct drawn_model *model, struct zr_team *team, const struct zr_feature_rule *rule)
{
    uint8_t *features = zr_features_find(&(struct zr_run){.arena = &arena, .team = team}, &model->mesh, rule);
    assert_non_null(features);
    return features;
}

static uint32_t count(const struct drawn_model *model, const uint8_t *features, unsigned mask, unsigned want)
{
    uint32_t found = 0;
    for (uint32_t e = 0; e < model->mesh.edge_count; e++)
        found += (features[e] & mask) == want;
    return found;
}

static struct drawn_model draw(const char *text)
{
    return model_in_window(&arena, NULL, model_of_text(&arena, text, NULL), 100, 100);
}

/* ---- small bodies ---- */

TEST(all_edges_of_a_cube_are_strong_convex_creases_and_six_are_its_outline)
{
    const struct drawn_model cube = draw(CUBE_CORNERS CUBE_SIDES CUBE_TOP);
    const uint8_t *features = find(&cube, NULL, &usual);
    const unsigned crease = ZR_FEATURE_WEAK | ZR_FEATURE_STRONG | ZR_FEATURE_CONVEX;
    assert_int_equal(count(&cube, features, crease, crease), 12);
    assert_int_equal(count(&cube, features, ZR_FEATURE_CONTOUR, ZR_FEATURE_CONTOUR), 6);
}

TEST(a_face_wound_against_the_others_changes_nothing)
{
    const struct drawn_model cube = draw(CUBE_CORNERS CUBE_SIDES "f 8 7 6 5\n");
    const uint8_t *features = find(&cube, NULL, &usual);
    assert_int_equal(count(&cube, features, ZR_FEATURE_STRONG, ZR_FEATURE_STRONG), 12);
    assert_int_equal(count(&cube, features, ZR_FEATURE_CONTOUR, ZR_FEATURE_CONTOUR), 6);
    assert_int_equal(count(&cube, features, ZR_FEATURE_CONVEX, ZR_FEATURE_CONVEX), 12);
}

TEST(an_open_box_has_borders)
{
    const struct drawn_model box = draw(CUBE_CORNERS CUBE_SIDES);
    assert_int_equal(count(&box, find(&box, NULL, &usual), ZR_FEATURE_BORDER, ZR_FEATURE_BORDER), 4);
}

/* A flat strip of which the last quad is bent up by 45 degrees, more or less. */
#define STRIP(z) "v 0 0 0\nv 1 0 0\nv 2 0 " z "\nv 0 1 0\nv 1 1 0\nv 2 1 " z "\nf 1 2 5 4\nf 2 3 6 5\n"

TEST(the_angle_decides_between_none_weak_and_strong)
{
    const struct drawn_model flat = draw(STRIP("0.5")), weak = draw(STRIP("0.7")), strong = draw(STRIP("1.1"));
    const unsigned mask = ZR_FEATURE_WEAK | ZR_FEATURE_STRONG | ZR_FEATURE_CONVEX;
    assert_int_equal(count(&flat, find(&flat, NULL, &usual), mask, 0), flat.mesh.edge_count);
    assert_int_equal(count(&weak, find(&weak, NULL, &usual), mask, ZR_FEATURE_WEAK), 1);
    assert_int_equal(count(&strong, find(&strong, NULL, &usual), mask, ZR_FEATURE_WEAK | ZR_FEATURE_STRONG), 1);
}

TEST(a_crease_of_exactly_the_angle_is_smooth)
{
    const struct drawn_model bent = draw(STRIP("1"));
    const struct zr_feature_rule at = {.crease_degrees = 45, .keeps_noise = true},
                                 below = {.crease_degrees = 44, .keeps_noise = true};
    assert_int_equal(count(&bent, find(&bent, NULL, &at), ZR_FEATURE_WEAK, ZR_FEATURE_WEAK), 0);
    assert_int_equal(count(&bent, find(&bent, NULL, &below), ZR_FEATURE_WEAK, ZR_FEATURE_WEAK), 1);
}

TEST(normals_of_the_file_make_edges_smooth_unless_ignored)
{
    const struct drawn_model bent = draw("v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 1\nvn 0 0 1\n"
                                         "f 1//1 2//1 5//1 4//1\nf 2//1 3//1 6//1 5//1\n");
    const struct zr_feature_rule ignores = {.crease_degrees = 30, .ignores_normals = true, .keeps_noise = true};
    assert_int_equal(count(&bent, find(&bent, NULL, &usual), ZR_FEATURE_WEAK, ZR_FEATURE_WEAK), 0);
    assert_int_equal(count(&bent, find(&bent, NULL, &ignores), ZR_FEATURE_WEAK, ZR_FEATURE_WEAK), 1);
}

/* Two quads in a plane, and a third one in front of them or behind, for the usual isometric view from (1, 1, 1). */
#define PLANE "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"

TEST(a_face_behind_a_plane_makes_no_line_and_one_before_it_does)
{
    const struct drawn_model behind = draw(PLANE "v 1 0 -1\nv 1 1 -1\nf 1 2 5 4\nf 2 3 6 5\nf 2 7 8 5\n");
    const struct drawn_model before = draw(PLANE "v 1 0 1\nv 1 1 1\nf 1 2 5 4\nf 2 3 6 5\nf 2 7 8 5\n");
    assert_int_equal(count(&behind, find(&behind, NULL, &usual), ZR_FEATURE_MORE, ZR_FEATURE_MORE), 0);
    assert_int_equal(count(&before, find(&before, NULL, &usual), ZR_FEATURE_MORE, ZR_FEATURE_MORE), 1);
}

/* Two quads that bend by 20 degrees at an edge, twice, wound both ways. Seen from (1, 1, 1), both
 * lie below the edge in the window in the first row, and one above it in the second. */
static uint32_t count_of_four(const struct drawn_model *model, unsigned mask)
{
    const uint8_t *features = find(model, NULL, &usual);
    uint32_t found = 0;
    for (uint32_t e = 0; e < model->mesh.edge_count; e++)
        found += zr_edge_side_count(&model->tables[0], e) == 4 && features[e] & mask;
    return found;
}

TEST(edges_of_doubled_faces_are_contours_where_all_faces_lie_on_one_side)
{
    static const char faces[] = "f 1 2 4 3\nf 3 4 2 1\nf 1 5 6 2\nf 2 6 5 1\n";
    char text[512];
    static const struct {
        const char *corners;
        uint32_t contours;
    } rows[] = {{"v -.497 -.497 -.71\nv .503 -1.497 -.71\n", 1}, {"v -.568 -.568 -.1\nv .432 -1.568 -.1\n", 0}};
    for (size_t i = 0; i < 2; i++) {
        snprintf(text, sizeof text, "v 0 0 0\nv 1 -1 0\nv .639 .639 .427\nv 1.639 -.361 .427\n%s%s", rows[i].corners,
                 faces);
        const struct drawn_model ridge = draw(text);
        assert_int_equal(count_of_four(&ridge, ZR_FEATURE_CONTOUR), rows[i].contours);
    }
}

TEST(culled_faces_leave_borders)
{
    const struct drawn_model cube =
        draw("{\"view\": {\"preset\": \"isometric\"}, \"materials\": [{\"name\": \"m\", \"doubleSided\": false}], "
             "\"meshes\": [{\"material\": \"m\", \"positions\": "
             "[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "
             "\"faces\": [[0,3,2,1],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7],[4,5,6,7]]}]}");
    const uint8_t *features = find(&cube, NULL, &usual);
    assert_int_equal(count(&cube, features, ZR_FEATURE_BORDER, ZR_FEATURE_BORDER), 6);
    assert_int_equal(count(&cube, features, ZR_FEATURE_STRONG, ZR_FEATURE_STRONG), 3);
}

/* ---- models ---- */

/* Counts of tests/reference/tables/feature_edges.py, which compares these rows with those of vtkFeatureEdges. Suzanne
 * has bent quads, of which VTK gets the triangles. */
static const struct counts {
    const char *name;
    uint32_t borders, creases, more;
} counts[] = {
    {"beetle.obj", 296, 691, 47},         {"cow.obj", 0, 1477, 0},
    {"fandisk.obj", 0, 722, 0},           {"spot.obj", 0, 284, 0},
    {"stanford-bunny.obj", 223, 1355, 0}, {"suzanne.obj", 42, 532, 0},
    {"teapot.obj", 160, 286, 0},          {"parts/cube.obj", 0, 12, 0},
    {"parts/gear.obj", 0, 848, 40},       {"parts/housing.obj", 0, 926, 56},
    {"parts/openbox.obj", 0, 500, 0},     {"parts/plate.obj", 0, 600, 0},
};

static uint32_t count_more(const struct zr_edge_mesh *table)
{
    uint32_t found = 0;
    for (uint32_t e = 0; e < table->edge_count; e++)
        found += zr_edge_side_count(table, e) > 2 && !zr_edge_is_diagonal(table, e);
    return found;
}

TEST(models_have_as_many_edges_of_each_kind_as_vtk_finds)
{
    const struct zr_feature_rule rule = {.crease_degrees = 30, .ignores_normals = true, .keeps_noise = true};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const struct zr_scene *scene = model_of_file(&arena, counts[i].name, NULL);
        if (!scene) return;
        const struct drawn_model model = model_in_window(&arena, NULL, scene, 64, 64);
        const uint8_t *features = find(&model, NULL, &rule);
        print_message("%s\n", counts[i].name);
        assert_int_equal(count(&model, features, ZR_FEATURE_BORDER, ZR_FEATURE_BORDER), counts[i].borders);
        assert_int_equal(count(&model, features, ZR_FEATURE_WEAK | ZR_FEATURE_MORE, ZR_FEATURE_WEAK),
                         counts[i].creases);
        assert_int_equal(count_more(&model.tables[0]), counts[i].more);
    }
}

/* ---- smoothing ---- */

TEST(only_creases_of_small_triangles_are_smoothed)
{
    const struct zr_scene *scene = model_of_file(&arena, "stanford-bunny.obj", NULL);
    if (!scene) return;
    const struct drawn_model small = model_in_window(&arena, NULL, scene, 64, 64),
                             large = model_in_window(&arena, NULL, scene, 16384, 16384);
    const struct drawn_model *models[] = {&small, &large};
    uint32_t weak[2];
    for (int i = 0; i < 2; i++) {
        const uint8_t *features = find(models[i], NULL, &smooth);
        weak[i] = count(models[i], features, ZR_FEATURE_WEAK, ZR_FEATURE_WEAK);
    }
    assert_int_equal(weak[1], 194); /* 1161 more are noise of the scan */
    assert_true(weak[0] < 150);
}

TEST(threads_find_the_same)
{
    const struct zr_scene *scene = model_of_file(&arena, "stanford-bunny.obj", NULL);
    if (!scene) scene = model_of_text(&arena, CUBE_CORNERS CUBE_SIDES, NULL);
    struct zr_team *team = zr_team_create(4);
    const struct drawn_model one = model_in_window(&arena, NULL, scene, 512, 512),
                             four = model_in_window(&arena, team, scene, 512, 512);
    assert_memory_equal(find(&one, NULL, &smooth), find(&four, team, &smooth), one.mesh.edge_count);
    zr_team_destroy(team);
}

RUN_TESTS(open_arena, close_arena)
