/* Picks: the surface at a pixel, those behind it, its feature, and the way to the next pick. */
#include <math.h>

#include "base/team.h"
#include "measure/part_distance.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

/* A view along -z: pixel x, y of 200 x 200 is at ((x + 0.5) / 20 - 5, 5 - (y + 0.5) / 20). */
#define VIEW                                                                                                           \
    "\"window\": {\"width\": 200, \"height\": 200}, \"view\": {\"eye\": [0, 0, 20], \"target\": [0, 0, 0], "           \
    "\"orthographic\": {\"xmag\": 5, \"ymag\": 5}}, \"outputs\": [{\"channel\": \"info\"}], "

static struct reading *read_view(const char *rest)
{
    char text[4096];
    snprintf(text, sizeof text, "{" VIEW "%s}", rest);
    return read_scene(text);
}

static struct zr_answer answer_of(struct reading *reading)
{
    return scene_encode(&reading->arena, NULL, reading->scene);
}

static void assert_has(const struct zr_answer *answer, const char *text)
{
    if (!strstr(answer->bytes, text)) fail_msg("%s is not in %s", text, (const char *)answer->bytes);
}

static void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= 1e-12)) fail_msg("%.17g for %.17g", a, b);
}

#define BOX "\"meshes\": [{\"name\": \"plate\", \"shape\": {\"type\": \"box\", \"size\": [6, 4, 2]}}], "

TEST(a_pick_has_its_part_face_point_and_normal)
{
    struct reading *reading = read_view(BOX "\"picks\": [[120, 80], [0, 0]]");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    assert_int_equal(frame->picks.count, 2);
    const struct zr_pick *pick = &frame->picks.at[0];
    assert_true(pick->is_hit && !frame->picks.at[1].is_hit);
    assert_int_equal(pick->at.face_id, frame->face_id[80 * 200 + 120]);
    assert_near(pick->at.point[2], 1.0);
    assert_true(fabs(pick->at.point[0] - 1.025) < 1e-6 && fabs(pick->at.point[1] - 0.975) < 1e-6);
    assert_near(pick->at.normal[2], 1.0);
    assert_true(pick->at.depth == 19.0f);
    assert_int_equal(pick->behind_count, 1);
    assert_near(pick->behind[0].point[2], -1.0);
    assert_near(pick->behind[0].normal[2], -1.0);
    assert_int_equal(pick->at.part, 0);
    reading_free(reading);
}

TEST(info_lists_picks_and_what_is_between)
{
    struct reading *reading = read_view(BOX "\"picks\": [[100, 100], [0, 0], [120, 100], [120, 60]]");
    const struct zr_answer answer = answer_of(reading);
    assert_has(&answer, "\"picks\":[{\"pixel\":[100,100],\"part\":\"plate\",\"instanceId\":1,\"faceId\":");
    assert_has(&answer, ",\"feature\":{\"kind\":\"plane\",\"number\":");
    assert_has(&answer, ",\"normal\":[0,0,1],\"depth\":19,\"behind\":[{\"part\":\"plate\"");
    assert_has(&answer, "\"distance\":2}]}");
    assert_has(&answer, "{\"pixel\":[0,0],\"part\":null,\"behind\":[]}");
    assert_has(&answer, "\"between\":[{\"from\":2,\"to\":3,\"distance\":2");
    assert_has(&answer, "\"alongNormal\":0,\"angleDegrees\":0}]");
    assert_null(strstr(answer.bytes, "\"features\"")); /* which only their own key asks for */
    reading_free(reading);
}

/* Two planes at right angles: a step of boxes seen from a corner. */
TEST(normals_of_two_picks_have_an_angle)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 200, \"height\": 200}, \"view\": {\"eye\": [20, 0, 20], \"target\": [0, 0, "
        "0], \"orthographic\": {\"xmag\": 5, \"ymag\": 5}}, \"outputs\": [{\"channel\": \"info\"}], "
        "\"meshes\": [{\"shape\": {\"type\": \"box\", \"size\": 4}}], \"picks\": [[80, 100], [120, 100]]}");
    const struct zr_answer answer = answer_of(reading);
    assert_has(&answer, "\"angleDegrees\":90}]");
    reading_free(reading);
}

TEST(a_pick_behind_the_wall_of_a_solid_follows_the_solid)
{
    /* a plate with a cavity: front, wall of the cavity, its other wall, back */
    static const char solid[] =
        "\"meshes\": [{\"name\": \"body\", \"shape\": {\"type\": \"box\", \"size\": [6, 4, 4]}}, {\"name\": \"tool\", "
        "\"shape\": {\"type\": \"box\", \"size\": [4, 2, 2]}}, {\"name\": \"other\", \"shape\": {\"type\": \"box\", "
        "\"size\": [1, 1, 1]}}], \"csg\": {\"difference\": [\"body\", {\"union\": [\"tool\", \"other\"]}]}, \"picks\": "
        "[[100, 100], [155, 100]]";
    struct reading *reading = read_view(solid);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    static const double z[] = {2, 1, -1, -2};
    static const char *const parts[] = {"body", "tool", "tool", "body"};
    const struct zr_pick *pick = &frame->picks.at[0];
    assert_int_equal(pick->behind_count, 3); /* not the faces of `other` inside of the cavity */
    for (uint32_t i = 0; i < 4; i++) {
        const struct zr_picked *picked = i == 0 ? &pick->at : &pick->behind[i - 1];
        assert_near(picked->point[2], z[i]);
        assert_string_equal(frame->parts.list.at[picked->part].name, parts[i]);
    }
    assert_int_equal(frame->picks.at[1].behind_count, 1); /* beside the cavity */
    reading_free(reading);
}

TEST(a_pick_in_the_cavity_that_is_cut_open_names_the_tool)
{
    struct reading *reading = read_view(
        "\"meshes\": [{\"name\": \"body\", \"shape\": {\"type\": \"box\", \"size\": [6, 4, 2]}}, {\"name\": \"tool\", "
        "\"shape\": {\"type\": \"box\", \"size\": [2, 2, 2]}}], \"nodes\": [{\"mesh\": \"body\"}, {\"mesh\": \"tool\", "
        "\"translation\": [0, 0, 1]}], \"csg\": {\"difference\": [\"body\", \"tool\"]}, \"picks\": [[100, 100]]");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const struct zr_pick *pick = &frame->picks.at[0];
    assert_near(pick->at.point[2], 0.0);
    assert_near(pick->at.normal[2], 1.0);
    assert_string_equal(frame->parts.list.at[pick->at.part].name, "tool");
    assert_int_equal(pick->behind_count, 1);
    reading_free(reading);
}

TEST(a_pick_on_a_cap_says_so)
{
    struct reading *reading =
        read_view(BOX "\"sections\": {\"planes\": [{\"axis\": \"z\", \"fraction\": 0.5, \"keep\": \"negative\"}]}, "
                      "\"picks\": [[100, 100]]");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const struct zr_pick *pick = &frame->picks.at[0];
    assert_true(pick->is_hit && pick->at.is_cap && pick->at.part == 0);
    assert_near(pick->at.point[2], 0.0);
    assert_int_equal(pick->at.face_id, frame->face_id[100 * 200 + 100]);
    assert_int_equal(pick->behind_count, 1);
    assert_int_equal(pick->behind[0].face_id <= 6, true); /* an id of the whole scene */
    reading_free(reading);
}

TEST(translucent_surfaces_are_picked_only_if_nothing_else_is_there)
{
    struct reading *reading = read_view(
        "\"materials\": [{\"name\": \"glass\", \"baseColorFactor\": [1, 1, 1, 0.5], \"alphaMode\": \"BLEND\"}], "
        "\"meshes\": [{\"name\": \"pane\", \"material\": \"glass\", \"shape\": {\"type\": \"box\", \"size\": [8, 8, "
        "1]}}, {\"name\": \"core\", \"shape\": {\"type\": \"box\", \"size\": 2}}], \"nodes\": [{\"mesh\": \"pane\", "
        "\"translation\": [0, 0, 4]}, {\"mesh\": \"core\"}], \"picks\": [[100, 100], [30, 30]]");
    const struct zr_answer answer = answer_of(reading);
    assert_has(&answer, "{\"pixel\":[100,100],\"part\":\"core\"");
    assert_has(&answer, "{\"pixel\":[30,30],\"part\":\"pane\"");
    reading_free(reading);
}

TEST(a_pick_through_a_lens_is_the_one_in_the_middle)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 101, \"height\": 101}, \"view\": {\"eye\": [0, 0, 9], \"target\": [0, 0, 0], "
        "\"perspective\": {\"yfovDegrees\": 50}, \"distortion\": {\"model\": \"opencv\", \"k\": [-0.2]}}, \"outputs\": "
        "[{\"channel\": "
        "\"info\"}], \"meshes\": [{\"name\": \"core\", \"shape\": {\"type\": \"box\", \"size\": 2}}], \"picks\": "
        "[[50, 50]]}");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    assert_true(frame->picks.at[0].is_hit);
    assert_near(frame->picks.at[0].at.point[2], 1.0);
    assert_true(fabs(frame->picks.at[0].at.point[0]) < 0.05);
    reading_free(reading);
}

TEST(each_number_of_threads_gives_the_same_bytes)
{
    struct zr_team *team = zr_team_create(4);
    struct reading *a = read_view(BOX "\"picks\": [[120, 80], [60, 70], [70, 130]]");
    struct reading *b = read_view(BOX "\"picks\": [[120, 80], [60, 70], [70, 130]]");
    const struct zr_answer one = answer_of(a), four = scene_encode(&b->arena, team, b->scene);
    assert_int_equal(one.size, four.size);
    assert_memory_equal(one.bytes, four.bytes, one.size);
    reading_free(a);
    reading_free(b);
    zr_team_destroy(team);
}

/* ---- distances ---- */

#define BOXES                                                                                                          \
    "\"meshes\": [{\"name\": \"box\", \"shape\": {\"type\": \"box\", \"size\": 2}}, {\"name\": \"ball\", \"shape\": "  \
    "{\"type\": \"sphere\", \"radius\": 1, \"segments\": 64}}], \"nodes\": [{\"name\": \"a\", \"mesh\": \"box\"}, "    \
    "{\"name\": \"beside\", \"mesh\": \"box\", \"translation\": [3, 0.5, 0]}, {\"name\": \"across\", \"mesh\": "       \
    "\"box\", "                                                                                                        \
    "\"translation\": [1.5, 0.5, 0.5]}, {\"name\": \"on\", \"mesh\": \"box\", \"translation\": [0, 2, 0]}, "           \
    "{\"name\": "                                                                                                      \
    "\"over\", \"mesh\": \"ball\", \"translation\": [0, 0, 3.5]}, {\"name\": \"within\", \"mesh\": \"ball\", "         \
    "\"scale\": [0.3, "                                                                                                \
    "0.3, 0.3]}, {\"name\": \"same\", \"mesh\": \"box\"}, {\"name\": \"half\", \"mesh\": \"box\", "                    \
    "\"translation\": [1, 0, 0]}, {\"name\": \"corner\", \"mesh\": \"box\", \"translation\": [5, 6, 14]}]"

TEST(distances_of_parts_are_those_of_their_surfaces)
{
    static const struct {
        const char *other;
        double distance;
        bool crosses;
    } cases[] = {{"beside", 1, false}, {"across", 0, true},   {"on", 0, false},  {"over", 1.5, false},
                 {"within", 0, true},  {"corner", 13, false}, {"same", 0, true}, {"half", 0, true}}; /* 3, 4 and 12 */
    char rest[2048];
    size_t used = (size_t)snprintf(rest, sizeof rest, BOXES ", \"distances\": [");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        used += (size_t)snprintf(rest + used, sizeof rest - used, "%s[\"a\", \"%s\"]", i ? ", " : "", cases[i].other);
    snprintf(rest + used, sizeof rest - used, "]");
    struct reading *reading = read_view(rest);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_part_distance *d = &frame->distances[i];
        double square = 0.0;
        for (int k = 0; k < 3; k++)
            square += (d->places[1][k] - d->places[0][k]) * (d->places[1][k] - d->places[0][k]);
        if (!d->is_found || d->crosses != cases[i].crosses || fabs(d->distance - cases[i].distance) > 1e-12)
            fail_msg("%s: %g", cases[i].other, d->distance);
        assert_true(fabs(sqrt(square) - d->distance) < 1e-12);
    }
    reading_free(reading);
}

TEST(an_unknown_part_has_no_distance)
{
    struct reading *reading = read_view(BOXES ", \"distances\": [[\"a\", \"bee\"]]");
    struct zr_error error = {0};
    const struct zr_frame *frame;
    const struct zr_run run = {.arena = &reading->arena, .error = &error};
    assert_int_equal(zr_render(&run, reading->scene, NULL, &frame), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/distances/0/1");
    reading_free(reading);
}

/* ---- walls ---- */

TEST(walls_are_as_thick_as_the_part_along_the_normal)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 200, \"height\": 200}, \"view\": {\"eye\": [5, 4, 20], \"target\": [0, 0, 0], "
        "\"orthographic\": {\"xmag\": 5, \"ymag\": 5}}, \"outputs\": [{\"channel\": \"wall\"}, {\"channel\": "
        "\"normals\", "
        "\"space\": \"world\"}], \"meshes\": [{\"shape\": {\"type\": \"box\", \"size\": [6, 4, 2]}}]}");
    struct zr_team *team = zr_team_create(3);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const struct zr_frame *same = scene_render(&reading->arena, team, reading->scene);
    const float *walls = frame->channels[ZR_CHANNEL_WALL], *n = frame->channels[ZR_CHANNEL_NORMALS];
    uint32_t seen = 0;
    assert_memory_equal(walls, same->channels[ZR_CHANNEL_WALL], 4 * 200 * 200);
    for (size_t i = 0; i < 200 * 200; i++, n += 3) {
        const float want = 6.0f * fabsf(n[0]) + 4.0f * fabsf(n[1]) + 2.0f * fabsf(n[2]);
        if (fabsf(walls[i] - want) > 1e-4f) fail_msg("pixel %zu: %g for %g", i, (double)walls[i], (double)want);
        seen += walls[i] > 0.0f;
    }
    assert_true(seen > 10000);
    reading_free(reading);
    zr_team_destroy(team);
}

TEST(a_sheet_has_no_wall)
{
    struct reading *reading =
        read_scene("{\"window\": {\"width\": 32, \"height\": 32}, \"outputs\": [{\"channel\": \"wall\"}], "
                   "\"polygons\": [{\"vertices\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}");
    const float *walls = scene_render(&reading->arena, NULL, reading->scene)->channels[ZR_CHANNEL_WALL];
    for (size_t i = 0; i < 32 * 32; i++)
        assert_true(walls[i] == 0.0f);
    reading_free(reading);
}

/* ---- queries ---- */

static struct reading *read_query(const char *picks)
{
    static const char model[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    return read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .channel = "info", .picks = picks}, model,
                        sizeof model - 1, zr_limits_default(), (size_t)1 << 28);
}

TEST(a_query_has_pixels_with_blanks_between_them)
{
    static const struct {
        const char *text;
        uint32_t count;
    } cases[] = {{"3,4", 1}, {" 3,4", 1}, {"3,4 5,6", 2}, {"3,4;5,6", 2}, {"3,4  5,6 ", 2}, {"0,0 639,479 1,2", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_query(cases[i].text);
        assert_read(reading);
        assert_int_equal(reading->scene->views[0].picks.count, cases[i].count);
        if (i == 2) assert_int_equal(reading->scene->views[0].picks.at[1][0], 5);
        reading_free(reading);
    }
}

TEST(other_texts_are_refused)
{
    static const char *const wrong[] = {
        "",     " ",     "3",     "3,",  ",4",   "3 4",   "3,4,5", "3,4 5",         "3,4 5,",       "-1,2",
        "3,-4", "1.5,2", "1e2,3", "a,b", "3,4x", "[3,4]", "3, 4",  "99999999999,1", "4294967296,1", "3,4|5,6"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct reading *reading = read_query(wrong[i]);
        if (reading->status != ZR_BAD_REQUEST) fail_msg("'%s' was read", wrong[i]);
        reading_free(reading);
    }
    struct reading *reading = read_query("640,3");
    assert_int_equal(reading->status, ZR_BAD_SCENE);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
