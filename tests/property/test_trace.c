/* The channel trace, played back from its JSON alone, gives the picture: of every scene of tests/scenes and
 * clients/examples that fits, of scenes of lectures and of random ones; by every algorithm, thread count and
 * instruction set. The picture is production's, so this compares the plain half-space algorithm with the kernels, too.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "raster/textbook/trace.h"
#include "render_request.h"
#include "scene/validate.h"
#include "support/files.h"
#include "support/geometries.h"
#include "support/pictures/replay.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

enum { RANDOM_SCENES = 150, TEXT_SIZE = 1 << 16 };

static struct zr_arena arena;
static struct zr_error faults;
static struct replay replay, replays[ZR_ALGORITHM_COUNT];
static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY},
                                           {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                           {.channel = ZR_CHANNEL_TRACE, .encoding = ZR_ENCODING_JSON}};

static const struct zr_scene *read_text(const char *text, size_t size)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = size};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    faults.count = 0;
    if (zr_scene_read(&(struct zr_run){.arena = &arena, .error = &faults}, &request, &limits, &scene) != ZR_OK)
        fail_msg("%s %s: %.200s", faults.items[0].pointer, faults.items[0].detail, text);
    return scene;
}

/* Returns the text of a trace; NULL with a fault. */
static const char *trace_of(struct zr_scene *scene, struct zr_team *team)
{
    const struct zr_frame *frame;
    struct zr_answer answer;
    scene->views[0].outputs = &outputs[2];
    scene->views[0].output_count = 1;
    faults.count = 0;
    if (zr_render(&(struct zr_run){.arena = &arena, .team = team, .error = &faults}, scene, NULL, &frame) != ZR_OK)
        return NULL;
    assert_int_equal(
        zr_encode(&(struct zr_run){.arena = &arena, .team = team, .error = &faults}, scene, frame, &answer), ZR_OK);
    assert_string_equal(answer.content_type, "application/json");
    char *text = zr_arena_alloc(&arena, answer.size + 1, 1);
    assert_non_null(text);
    memcpy(text, answer.bytes, answer.size);
    text[answer.size] = 0;
    return text;
}

/* Plays back the traces of all algorithms. Returns false if the scene is beyond the bounds of a trace. */
static bool check(const char *name, const struct zr_scene *scene, struct zr_team *team)
{
    struct zr_scene drawn = *scene;
    drawn.algorithm = ZR_ALGORITHM_HALFSPACE;
    drawn.views[0].outputs = outputs;
    drawn.views[0].output_count = 2;
    const struct zr_frame *want = scene_render(&arena, NULL, &drawn);
    const size_t pixels = (size_t)want->width * want->height;
    memset(replays, 0, sizeof replays);
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        char label[200];
        snprintf(label, sizeof label, "%s by %s", name, algorithm_words[a]);
        drawn.algorithm = (enum zr_algorithm)a;
        const char *text = trace_of(&drawn, NULL);
        if (!text && a == 0 && strstr(faults.items[0].detail, "limited to 64 primitives")) return false;
        if (!text && a == ZR_ALGORITHM_PAINTER && strstr(faults.items[0].detail, "limited to 20000 steps")) continue;
        if (!text) fail_msg("%s: %s", label, faults.items[0].detail);
        replay_trace(label, text, &replay);
        replays[a] = replay;
        assert_true(replay.width == want->width && replay.height == want->height);
        if (memcmp(replay.face_id, want->face_id, pixels * 4) != 0) fail_msg("%s: other faces", label);
        if (replay.has_depth && memcmp(replay.depth, want->window_depth, pixels * 4) != 0)
            fail_msg("%s: another depth", label);
        if (team) assert_string_equal(trace_of(&drawn, team), text);
    }
    return true;
}

/* ---- files ---- */

static int played;

static void check_file(const char *path, void *team)
{
    const struct zr_limits limits = zr_limits_default();
    size_t size;
    char *bytes = file_read(path, &size);
    zr_arena_init(&arena, (size_t)1 << 31);
    struct zr_scene drawn = *read_text(bytes, size);
    struct zr_view *view = &drawn.views[0];
    view->width = view->width < ZR_TRACE_SIDE_MAX ? view->width : ZR_TRACE_SIDE_MAX;
    view->height = view->height < ZR_TRACE_SIDE_MAX ? view->height : ZR_TRACE_SIDE_MAX;
    view->outputs = &outputs[2];
    view->output_count = 1;
    faults.count = 0;
    if (zr_scene_validate(&drawn, &limits, &faults) == ZR_OK) played += check(path, &drawn, team);
    zr_arena_free(&arena);
    free(bytes);
}

TEST(traces_of_scene_files_give_their_pictures)
{
    struct zr_team *team = zr_team_create(3);
    assert_true(files_each("tests/scenes", ".json", check_file, team) > 30);
    assert_true(files_each("clients/examples", ".json", check_file, team) > 0);
    print_message("%d scene files are played back\n", played);
    assert_int_equal(played, 78);
    zr_team_destroy(team);
}

/* ---- lectures ---- */

#define HEAD                                                                                                           \
    "{\"window\": {\"width\": 32, \"height\": 24}, \"view\": {\"worldToCamera\": [1,0,0,0, 0,1,0,0, 0,0,1,0, "         \
    "0,0,-5,1], \"orthographic\": {\"xmag\": 1.2, \"ymag\": 0.9}, \"znear\": 1, \"zfar\": 9}, \"polygons\": ["

static const char crossing[] =
    HEAD "{\"vertices\": [[-1,-0.7,-1], [1,-0.5,1], [0.1,0.8,0]], \"doubleSided\": true},"
         "{\"vertices\": [[-0.8,0.6,1], [0.3,-0.8,0], [0.9,0.7,-1]], \"doubleSided\": true}]}";
/* Each is near at its wide end, over the far end of the one before. */
static const char ring[] =
    HEAD "{\"vertices\": [[-0.99,-0.38,0.5], [-0.99,-0.82,0.5], [1.02,-0.6,-0.5]], \"doubleSided\": true},"
         "{\"vertices\": [[0.73,-0.82,0.5], [1.1,-0.59,0.5], [-0.09,0.8,-0.5]], \"doubleSided\": true},"
         "{\"vertices\": [[0.25,0.66,0.5], [-0.12,0.88,0.5], [-0.93,-0.73,-0.5]], \"doubleSided\": true}]}";
static const char star[] =
    HEAD "{\"vertices\": [[0,0.85,0], [-0.2,0.2,0], [-0.9,0.2,0], [-0.35,-0.2,0], [-0.55,-0.8,0], "
         "[0,-0.4,0], [0.55,-0.8,0], [0.35,-0.2,0], [0.9,0.2,0], [0.2,0.2,0]], "
         "\"doubleSided\": true}]}";

static void check_lecture(const char *name, const char *text)
{
    const struct zr_scene *scene = read_text(text, strlen(text));
    if (!check(name, scene, NULL)) fail_msg("%s is refused", name);
}

TEST(two_crossing_triangles_are_decided_where_they_cut_and_the_painter_cuts_one)
{
    zr_arena_init(&arena, (size_t)1 << 28);
    check_lecture("two crossing triangles", crossing);
    assert_int_equal(replays[ZR_ALGORITHM_EDGELIST].primitives, 2);
    assert_true(replays[ZR_ALGORITHM_EDGELIST].lost > 10);
    assert_true(replays[ZR_ALGORITHM_PAINTER].cuts == 1 && replays[ZR_ALGORITHM_PAINTER].cycles == 0);
    assert_true(replays[ZR_ALGORITHM_HALFSPACE].inner_tiles > 3);
    zr_arena_free(&arena);
}

TEST(a_ring_of_three_that_overlap_is_cut_by_the_painter)
{
    zr_arena_init(&arena, (size_t)1 << 28);
    check_lecture("a ring of three", ring);
    assert_true(replays[ZR_ALGORITHM_PAINTER].cuts == 1 && replays[ZR_ALGORITHM_PAINTER].cycles == 1);
    assert_int_equal(replays[ZR_ALGORITHM_PAINTER].primitives, 3);
    zr_arena_free(&arena);
}

TEST(a_concave_star_is_one_polygon)
{
    zr_arena_init(&arena, (size_t)1 << 28);
    check_lecture("a concave star", star);
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++)
        assert_true(replays[a].primitives == 1 && replays[a].polygons == 1);
    zr_arena_free(&arena);
}

/* ---- random scenes ---- */

static size_t add_polygon(struct random *random, char *text, size_t size)
{
    const uint32_t corners = random_below(random, 3) ? 3 : 4 + random_below(random, 8);
    const double grid = random_below(random, 2) ? 0x1p-5 : 0x1p-14; /* coarse: corners on samples, and ties */
    size_t used = (size_t)snprintf(text, size, "{\"doubleSided\":true,\"vertices\":[");
    for (uint32_t k = 0; k < corners; k++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = grid * (double)(int)(random_range(random, -1.3, 1.3) / grid);
        used += (size_t)snprintf(text + used, size - used, "%s[%.17g,%.17g,%.17g]", k ? "," : "", p[0], p[1], p[2]);
    }
    return used + (size_t)snprintf(text + used, size - used, "]}");
}

/* Polygons of any shape, cut by the borders and by one another, seen from in front or in perspective. */
static void make_scene(struct random *random, char *text, size_t size)
{
    const uint32_t count = 1 + random_below(random, random_below(random, 4) ? 12 : 40);
    size_t used = (size_t)snprintf(
        text, size,
        "{\"window\":{\"width\":%u,\"height\":%u},\"view\":{\"eye\":[0,0,%u],\"target\":[0,0,0],%s},\"polygons\":[",
        1 + random_below(random, ZR_TRACE_SIDE_MAX), 1 + random_below(random, ZR_TRACE_SIDE_MAX),
        2 + random_below(random, 3),
        random_below(random, 2) ? "\"orthographic\":{\"xmag\":1,\"ymag\":1},\"znear\":1,\"zfar\":4"
                                : "\"perspective\":{\"yfovDegrees\":45},\"znear\":1,\"zfar\":4");
    for (uint32_t i = 0; i < count; i++) {
        if (i > 0) used += (size_t)snprintf(text + used, size - used, ",");
        used += add_polygon(random, text + used, size - used);
    }
    snprintf(text + used, size - used, "]}");
}

TEST(traces_of_random_scenes_give_their_pictures)
{
    static char text[TEXT_SIZE];
    struct random random = random_seeded(20);
    struct replay sums = {.width = 0};
    int fitting = 0, painted = 0;
    for (int i = 0; i < RANDOM_SCENES; i++) {
        char name[40];
        snprintf(name, sizeof name, "random scene %d", i);
        make_scene(&random, text, sizeof text);
        zr_arena_init(&arena, (size_t)1 << 30);
        if (check(name, read_text(text, strlen(text)), NULL)) {
            fitting++;
            painted += replays[ZR_ALGORITHM_PAINTER].steps > 0 || replays[ZR_ALGORITHM_PAINTER].primitives == 0;
            sums.lost += replays[ZR_ALGORITHM_TRAPEZOID].lost;
            sums.polygons += replays[ZR_ALGORITHM_SCANLINE].polygons;
            sums.cuts += replays[ZR_ALGORITHM_PAINTER].cuts;
            sums.cycles += replays[ZR_ALGORITHM_PAINTER].cycles;
            sums.inner_tiles += replays[ZR_ALGORITHM_HALFSPACE].inner_tiles;
        }
        zr_arena_free(&arena);
    }
    print_message("%d of %d scenes, %d by the painter: %u polygons, %u cuts, %u cycles, %u samples lost\n", fitting,
                  RANDOM_SCENES, painted, sums.polygons, sums.cuts, sums.cycles, sums.lost);
    assert_true(fitting > RANDOM_SCENES * 9 / 10 && painted > RANDOM_SCENES * 8 / 10);
    assert_true(sums.lost > 1000 && sums.polygons > 100 && sums.cuts > 100 && sums.inner_tiles > 1000);
}

/* ---- instruction sets ---- */

TEST(traces_are_the_same_by_every_instruction_set)
{
    zr_arena_init(&arena, (size_t)1 << 28);
    struct zr_scene scene = *read_text(crossing, strlen(crossing));
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        scene.algorithm = (enum zr_algorithm)a;
        const char *want = trace_of(&scene, NULL);
        assert_non_null(want);
        for (int isa = 0; isa < ZR_ISA_COUNT; isa++) {
            if (!zr_isa_is_available((enum zr_isa)isa)) continue;
            struct zr_team *team = zr_team_create_for(2, (enum zr_isa)isa);
            assert_string_equal(trace_of(&scene, team), want);
            zr_team_destroy(team);
        }
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
