/* core/views: each view of a request equals the view drawn alone, byte for byte; wrong views are refused before any is
 * drawn. Their joined files: test_view_files.c. */
#include <math.h>

#include "base/run.h"
#include "output/npy.h"
#include "unit/common/views_check.h"

/* ---- lists ---- */

TEST_AROUND(items_equal_scenes_with_their_keys, open_arena, close_arena)
{
    static const char *const items[] = {
        "\"view\": {\"preset\": \"top\"}",
        "\"view\": {\"eye\": [5,4,3], \"target\": [1,0,0], \"perspective\": {\"yfovDegrees\": 30}}",
        "\"view\": {\"azimuthDegrees\": 30, \"elevationDegrees\": -20}, \"window\": {\"width\": 33, \"height\": 47}",
        "\"look\": \"technical\"",
        "\"look\": \"studio\", \"background\": \"#ff000080\"",
        "\"hide\": \"m\"",
        "\"isolate\": [\"m\"], \"edges\": true",
        "\"ghost\": \"n\", \"highlight\": \"m\"",
        "\"explode\": 1.5",
        "\"sections\": {\"planes\": [{\"axis\": \"x\"}]}",
        ("\"window\": {\"width\": 220, \"height\": 200}, \"annotate\": [\"box\", \"holes\"], \"title\": \"part\", "
         "\"dimensions\": [{\"from\": [0, 0, 0], \"to\": [3, 0, 0]}]"),
        "\"picks\": [[40, 30], [1, 2]]"};
    enum { COUNT = sizeof items / sizeof *items };
    static const char outputs[] = "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, "
                                  "{\"channel\": \"info\"}, {\"channel\": \"normals\", \"encoding\": \"png\"}]";
    char text[4096], name[64];
    int used = snprintf(text, sizeof text, SCENE ", %s, \"views\": [", outputs);
    for (int i = 0; i < COUNT; i++)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, "%s{\"name\": \"v%d\", %s}", i ? ", " : "", i, items[i]);
    snprintf(text + used, sizeof text - (size_t)used, "]}");
    struct zr_views views;
    const struct zr_files files = draw(text, &views);
    assert_int_equal(files.count, COUNT * 4);
    for (int i = 0; i < COUNT; i++) {
        struct zr_files alone;
        const char *base = strstr(items[i], "\"window\"") ? "{" GEOMETRY : SCENE;
        snprintf(text, sizeof text, "%s, %s, %s}", base, outputs, items[i]);
        draw_alone(text, &alone);
        for (uint32_t k = 0; k < 4; k++) {
            snprintf(name, sizeof name, "v%d.%s", i, alone.entries[k].name);
            assert_same(file_of(&files, name), &alone.entries[k], name);
        }
    }
}

TEST_AROUND(poses_move_nodes, open_arena, close_arena)
{
#define MATRIX "[0,1,0,0, -1,0,0,0, 0,0,1,0, 0.5,0,0,1]"
    static const char scene[] = SCENE ", \"views\": [{\"poses\": {\"n\": " MATRIX "}}]}";
    static const char moved[] =
        "{\"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[3,0,0],[0,2,0],[0,0,1]], \"faces\": "
        "[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}, {\"name\": \"b\", \"positions\": [[1,1,1],[2,1,1],[1,2,2]], \"faces\": "
        "[[0,1,2]]}], \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\", \"matrix\": " MATRIX "}, {\"mesh\": \"b\"}], "
        "\"window\": {\"width\": 80, \"height\": 60}}";
    struct zr_views views;
    struct zr_files alone;
    const struct zr_files files = draw(scene, &views);
    draw_alone(moved, &alone);
    assert_same(file_of(&files, "0001.color.png"), &alone.entries[0], "poses");
}

/* With both axes that point up, and with a projection of the scene's, which stays. */
TEST_AROUND(presets_equal_views_with_them, open_arena, close_arena)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    static const char *const others[] = {"", ", \"up\": \"z\"", ", \"view\": {\"eye\": [9,9,9]}",
                                         ", \"shading\": \"gouraud\"",
                                         ", \"shading\": \"phong\", \"creaseDegrees\": 30"};
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
        char text[2048];
        struct zr_views views;
        snprintf(text, sizeof text,
                 SCENE "%s, \"views\": [\"front\", \"back\", \"left\", \"right\", \"top\", \"bottom\", \"isometric\"]}",
                 others[k]);
        const struct zr_files files = draw(text, &views);
        for (int i = 0; i < 7; i++) {
            struct zr_files alone;
            char name[64];
            if (k == 2)
                snprintf(text, sizeof text,
                         SCENE ", \"view\": {\"preset\": \"%s\", \"perspective\": {\"yfovDegrees\": 45}}}", presets[i]);
            else
                snprintf(text, sizeof text, SCENE "%s, \"view\": {\"preset\": \"%s\"}}", others[k], presets[i]);
            snprintf(name, sizeof name, "%s.color.png", presets[i]);
            draw_alone(text, &alone);
            assert_same(file_of(&files, name), &alone.entries[0], name);
        }
    }
}

static const char stl[] =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 0 2 1\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 2 1\nvertex 0 0 4\nendloop\n"
    "endfacet\nendsolid s\n";

static struct zr_request stl_request(void)
{
    return (struct zr_request){
        .format = ZR_FORMAT_STL, .bytes = stl, .size = sizeof stl - 1, .width = "80", .height = "60"};
}

TEST_AROUND(parameters_equal_those_of_one_view, open_arena, close_arena)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    struct zr_request request = stl_request();
    struct zr_views views;
    request.views = "front,back,left,right,top,bottom,isometric";
    const struct zr_files files = draw_with(NULL, request, &views);
    for (int i = 0; i < 7; i++) {
        const struct zr_scene *scene;
        struct zr_error error = {0};
        struct zr_request one = stl_request();
        char name[64];
        const struct zr_frame *frame;
        struct zr_files alone;
        one.preset = presets[i];
        assert_int_equal(zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &one, &limits, &scene),
                         ZR_OK);
        assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame), ZR_OK);
        assert_int_equal(
            zr_encode_files(&(struct zr_run){.arena = &arena, .error = &error}, scene, frame, NULL, &alone), ZR_OK);
        snprintf(name, sizeof name, "%s.color.png", presets[i]);
        assert_same(file_of(&files, name), &alone.entries[0], name);
    }
}

/* ---- turntables and orbits ---- */

/* Writes the key "view" of a view's camera. */
static void write_view(const struct zr_view *view, char *text, size_t size)
{
    int used = snprintf(text, size, "\"view\": {\"target\": [%.9g, %.9g, %.9g], \"azimuthDegrees\": %.17g, ",
                        (double)view->target.x, (double)view->target.y, (double)view->target.z, view->azimuth_degrees);
    used += snprintf(text + used, size - (size_t)used, "\"elevationDegrees\": %.17g, ", view->elevation_degrees);
    if (view->projection == ZR_PROJECTION_ORTHOGRAPHIC)
        snprintf(text + used, size - (size_t)used, "\"orthographic\": {\"xmag\": %.9g, \"ymag\": %.9g}}",
                 (double)view->xmag, (double)view->ymag);
    else
        snprintf(text + used, size - (size_t)used, "\"distance\": %.9g, \"perspective\": {\"yfovDegrees\": 40}}",
                 (double)view->distance);
}

static void check_turn(const char *keys, const char *projection, uint32_t count)
{
    char text[2048], view[400], name[64];
    struct zr_views views;
    snprintf(text, sizeof text, SCENE ", \"view\": {%s}, %s}", projection, keys);
    const struct zr_files files = draw(text, &views);
    assert_int_equal(files.count, count);
    for (uint32_t i = 0; i < count; i++) {
        struct zr_files alone;
        write_view(&scene_of_view(&views, i)->views[0], view, sizeof view);
        snprintf(text, sizeof text, SCENE ", %s}", view);
        draw_alone(text, &alone);
        snprintf(name, sizeof name, "%04u.color.png", i + 1);
        assert_same(file_of(&files, name), &alone.entries[0], name);
    }
}

TEST_AROUND(frames_of_a_turn_equal_views_of_their_cameras, open_arena, close_arena)
{
    check_turn("\"turntable\": {\"frames\": 5}", "", 5);
    check_turn("\"turntable\": {\"frames\": 4, \"elevation\": -15}", "\"perspective\": {\"yfovDegrees\": 40}", 4);
    check_turn("\"orbit\": {\"count\": 7}", "\"perspective\": {\"yfovDegrees\": 40}", 7);
    check_turn("\"orbit\": {\"count\": 3, \"distance\": 9}", "\"perspective\": {\"yfovDegrees\": 40}", 3);
    check_turn("\"turntable\": {\"frames\": 3}",
               "\"eye\": [4,5,6], \"target\": [1,1,0], \"perspective\": {\"yfovDegrees\": 40}", 3);
}

/* All frames have one scale, and no frame touches its border, which a wrong scale would make it do. */
TEST_AROUND(frames_have_one_scale_and_show_everything, open_arena, close_arena)
{
    static const char *const kinds[] = {"\"turntable\": {\"frames\": 12}", "\"orbit\": {\"count\": 30}"};
    static const char *const projections[] = {"\"perspective\": {\"yfovDegrees\": 40}", "\"orthographic\": {}"};
    for (int k = 0; k < 4; k++) {
        char text[2048];
        struct zr_views views;
        snprintf(text, sizeof text, SCENE ", \"outputs\": [{\"channel\": \"depth\"}], \"view\": {%s}, %s}",
                 projections[k / 2], kinds[k % 2]);
        const struct zr_files files = draw(text, &views);
        const float *depths = (const float *)((const char *)files.entries[0].bytes + ZR_NPY_HEADER);
        int32_t touches = 0, nearest = 1000;
        for (uint32_t v = 0; v < views.set->count; v++, depths += 80 * 60)
            for (int32_t i = 0; i < 80 * 60; i++) {
                if (isinf(depths[i])) continue;
                const int32_t x = i % 80, y = i / 80, a = x < 79 - x ? x : 79 - x, b = y < 59 - y ? y : 59 - y;
                const int32_t border = a < b ? a : b;
                touches += border == 0;
                if (border < nearest) nearest = border;
            }
        assert_int_equal(touches, 0);
        assert_in_range(nearest, 1, 6); /* padding: a twentieth of 60 or 80 pixels */
    }
}

/* ---- parts ---- */

/* The facts of each view. */
struct seen {
    uint32_t count, own, empty; /* views, those with facts of their own, those without info */
    const struct zr_part_facts *first;
};

static enum zr_status see(void *context, const struct zr_drawn_view *view, struct zr_error *error)
{
    struct seen *seen = context;
    const struct zr_part_facts *facts = view->frame->parts.facts;
    (void)error;
    if (seen->count++ == 0) seen->first = facts;
    seen->own += facts && facts != seen->first;
    seen->empty += !facts;
    return ZR_OK;
}

/* Draws views with colours and info; returns their cost. */
static struct zr_cost see_views(const char *keys, struct seen *seen)
{
    char text[2048];
    struct zr_views views;
    struct zr_error error;
    snprintf(text, sizeof text, SCENE ", \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"info\"}], %s}", keys);
    *seen = (struct seen){0};
    if (read_views(NULL, request_of(text), &views, &error) != ZR_OK) fail_msg("%s: %s", keys, error.items[0].detail);
    assert_int_equal(zr_views_draw_each(&(struct zr_run){.arena = &arena, .error = &error}, &views,
                                        (struct zr_views_taker){see, seen, 0}),
                     ZR_OK);
    return views.cost;
}

TEST_AROUND(parts_are_measured_once_for_all_views_that_share_them, open_arena, close_arena)
{
    enum { TRIANGLES = 5, PARTS = 2 };
    struct seen seen;
    struct zr_cost cost = see_views("\"turntable\": {\"frames\": 40}", &seen);
    assert_true(seen.count == 40 && seen.first && seen.own == 0 && seen.empty == 0);
    assert_true(cost.counts[ZR_COST_FACT] == TRIANGLES && cost.counts[ZR_COST_PART] == 40 * PARTS);
    cost = see_views("\"turntable\": {\"frames\": 2}, \"sheet\": \"views\"", &seen);
    assert_true(seen.count == 2 && seen.first && seen.empty == 1);
    assert_true(cost.counts[ZR_COST_FACT] == TRIANGLES && cost.counts[ZR_COST_PART] == PARTS);
    cost = see_views("\"views\": [{\"view\": {\"preset\": \"top\"}}, \"left\", {\"hide\": \"m\"}]", &seen);
    assert_true(seen.count == 3 && seen.own == 1);
    assert_true(cost.counts[ZR_COST_FACT] == 2 * TRIANGLES);
    cost = see_views("\"views\": [{\"hide\": \"m\"}, \"left\", \"top\"]", &seen);
    assert_true(seen.count == 3 && seen.own == 2);
    assert_true(cost.counts[ZR_COST_FACT] == 2 * TRIANGLES);
}

/* ---- threads and memory ---- */

/* A view that does not fit into the share of a thread is drawn alone, so the number of threads decides nothing. */
TEST_AROUND(files_are_the_same_for_all_teams_and_little_memory, open_arena, close_arena)
{
    static const char text[] = "{" GEOMETRY ", \"look\": \"studio\", \"window\": {\"width\": 256, \"height\": 256}, "
                               "\"turntable\": {\"frames\": 7}}";
    struct zr_views views;
    const struct zr_files want = draw(text, &views);
    uint32_t refused = 0, drawn = 0;
    for (size_t memory = 4; memory <= 64; memory += 12) {
        enum zr_status first = ZR_OK;
        for (int threads = 1; threads <= 4; threads++) {
            struct zr_arena small;
            const struct zr_request request = request_of(text);
            struct zr_team *team = zr_team_create(threads);
            struct zr_error error = {0};
            struct zr_files files;
            zr_arena_init(&small, memory << 20);
            enum zr_status status = zr_views_read(&(struct zr_run){.arena = &small, .team = team, .error = &error},
                                                  &request, &limits, &views);
            if (status == ZR_OK)
                status = zr_views_plan(&(struct zr_run){.arena = &small, .team = team, .error = &error}, &views);
            if (status == ZR_OK)
                status =
                    zr_views_draw(&(struct zr_run){.arena = &small, .team = team, .error = &error}, &views, &files);
            if (threads == 1) first = status;
            assert_int_equal(status, first);
            assert_true(status == ZR_OK || (status == ZR_NO_MEMORY && !zr_arena_ok(&small)));
            refused += status != ZR_OK;
            drawn += status == ZR_OK;
            for (uint32_t i = 0; status == ZR_OK && i < want.count; i++)
                assert_same(&files.entries[i], &want.entries[i], "a frame");
            zr_arena_free(&small);
            zr_team_destroy(team);
        }
    }
    assert_true(refused > 0 && drawn > 0);
}

TEST_AROUND(a_raised_cancel_ends_the_drawing, open_arena, close_arena)
{
    struct zr_views views;
    struct zr_error error;
    struct zr_files files;
    const struct zr_cancel cancel = {.raised = true};
    assert_int_equal(read_views(NULL, request_of(SCENE ", \"turntable\": {}}"), &views, &error), ZR_OK);
    assert_int_equal(views.set->count, 36);
    assert_int_equal(
        zr_views_draw(&(struct zr_run){.arena = &arena, .cancel = &cancel, .error = &error}, &views, &files),
        ZR_CANCELLED);
}

/* ---- refusals ---- */

TEST_AROUND(wrong_views_are_refused_before_any_is_drawn, open_arena, close_arena)
{
    static const struct {
        const char *keys, *pointer, *detail;
    } cases[] = {
        {"\"views\": [\"front\", \"front\"]", "/views/1", "the name front, as view 0 has"},
        {"\"views\": [{}, {\"name\": \"0001\"}]", "/views/1/name", "the name 0001, as view 0 has"},
        {"\"views\": [\"top\", {\"view\": {\"eye\": [0,0,0], \"target\": [0,0,0]}}]", "/views/1/view/eye",
         "the target"},
        {"\"views\": [{\"view\": {\"eyes\": [0,0,0]}}]", "/views/0/view/eyes", "unknown key"},
        {"\"views\": [{\"look\": \"studyo\"}]", "/views/0/look", "did you mean studio?"},
        {"\"views\": [{\"poses\": {\"zz\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}}]", "/views/0/poses/zz", ""},
        {"\"views\": [{\"window\": {\"width\": 99999}}]", "/views/0/window/width", "1 to 8192"},
        {"\"views\": [{\"hide\": \"zz\"}]", "/views/0/hide", ""},
        {"\"views\": [\"front\", \"top\"], \"sections\": {\"planes\": [{\"axis\": \"z\"}]}", "/sections/planes/0",
         "in the view top: the camera sees the plane edge-on"},
        {"\"views\": [\"front\", \"top\"], \"view\": {\"perspective\": {\"yfovDegrees\": 1e-30}}", "/view",
         "in the view front: the numbers of the camera overflow"},
        {"\"views\": [\"front\", {\"view\": {\"preset\": \"top\"}, \"sections\": {\"planes\": [{\"axis\": \"z\"}]}}]",
         "/views/1/sections/planes/0", "sees the plane edge-on"},
        {"\"turntable\": {}, \"view\": {\"cameraToWorld\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}", "/turntable",
         "needs a view that can turn"},
        {"\"orbit\": {\"count\": 4096}, \"window\": {\"width\": 1024, \"height\": 1024}", "/orbit",
         "4294967296 pixels of images, more than the limit of 536870912"},
        {"\"sheet\": \"threeView\", \"window\": {\"width\": 30, \"height\": 30}", "/sheet", "have no room for 4 views"},
        {"\"sheet\": \"views\", \"views\": [{\"window\": {\"width\": 9}}]", "/views/0/window", "have one size"},
        {"\"views\": [\"front\", {\"window\": {\"width\": 9, \"height\": 9}}], \"outputs\": [{\"channel\": \"color\", "
         "\"encoding\": \"apng\"}]",
         "/views/1", "differs from view 0"},
        {"\"views\": [\"front\", {\"background\": \"#0000\"}], \"outputs\": [{\"channel\": \"color\", \"encoding\": "
         "\"apng\"}]",
         "/views/1", "whether its background is opaque"},
        {"\"turntable\": {}, \"outputs\": [{\"channel\": \"color\", \"encoding\": \"webp\", \"maxBytes\": 9999}]",
         "/outputs/0/maxBytes", "an animated webp has none"},
        {"\"turntable\": {\"seconds\": 0.5}, \"outputs\": [{\"channel\": \"color\", \"encoding\": \"gif\"}]",
         "/outputs/0/encoding", "a gif shows each frame for 0.02 seconds or more"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2048];
        struct zr_views views;
        struct zr_error error;
        struct zr_files files;
        const bool has_window =
            strstr(cases[i].keys, "\"window\": {\"width\": 1024") || strstr(cases[i].keys, "\": 30,");
        snprintf(text, sizeof text, "%s, %s}", has_window ? "{" GEOMETRY : SCENE, cases[i].keys);
        enum zr_status status = read_views(NULL, request_of(text), &views, &error);
        if (status == ZR_OK) status = zr_views_draw(&(struct zr_run){.arena = &arena, .error = &error}, &views, &files);
        if (status != ZR_BAD_SCENE || strcmp(error.items[0].pointer, cases[i].pointer) != 0 ||
            !strstr(error.items[0].detail, cases[i].detail))
            fail_msg("%s: %d at %s: %s", cases[i].keys, (int)status, error.items[0].pointer, error.items[0].detail);
    }
}

RUN_TESTS(NULL, NULL)
