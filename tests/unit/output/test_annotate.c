/* Marks over the picture: they lie in the window, do not overlap, and are the same by any number of threads. */
#include "overlay/annotate/annotate.h"

#include "base/team.h"
#include "overlay/annotate/length_text.h"
#include "support/files.h"
#include "support/pictures/png.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

static const char *const models[] = {
    "{\"type\": \"box\", \"size\": [3, 2, 1]}",
    "{\"type\": \"box\", \"size\": [300, 20, 10]}",
    "{\"type\": \"box\", \"size\": [0.04, 2, 0.4]}",
    "{\"type\": \"box\", \"size\": [117.25, 118.5, 3]}",
    "{\"type\": \"sphere\", \"radius\": 1.25}",
    "{\"type\": \"cylinder\", \"radius\": 0.3, \"height\": 7}",
    "{\"type\": \"cylinder\", \"radius\": 40, \"height\": 1}",
    "{\"type\": \"cone\", \"radius\": 4, \"height\": 3}",
    "{\"type\": \"torus\", \"radius\": 2, \"tube\": 0.5}",
    "{\"type\": \"box\", \"size\": [1e-4, 2e-4, 3e-4]}",
    "{\"type\": \"box\", \"size\": [12345, 23456, 3456]}",
    "{\"type\": \"cylinder\", \"radius\": 1, \"height\": 1, \"segments\": 6}",
    "{\"type\": \"extrusion\", \"points\": [[0, 0], [40, 0], [40, 8], [8, 8], [8, 25], [0, 25]], \"height\": 12}",
    "{\"type\": \"extrusion\", \"points\": [[0, 0], [9, 0], [9, 9], [6, 9], [6, 3], [3, 3], [3, 9], [0, 9]], \"height\": 60}",
    "{\"type\": \"extrusion\", \"points\": [[0, 0], [1, 0], [0, 1]], \"height\": 0.05}",
    "{\"type\": \"box\", \"size\": [1, 1, 1]}",
    "{\"type\": \"box\", \"size\": [99.9, 100, 100.1]}",
    "{\"type\": \"box\", \"size\": [0.5, 80, 0.5]}",
    "{\"type\": \"sphere\", \"radius\": 4000}",
    "{\"type\": \"cone\", \"radius\": 0.2, \"height\": 9}",
    "{\"type\": \"torus\", \"radius\": 50, \"tube\": 1}",
    "{\"type\": \"torus\", \"radius\": 3, \"tube\": 2.9}",
    "{\"type\": \"cylinder\", \"radius\": 0.05, \"height\": 0.002}",
    "{\"type\": \"cylinder\", \"radius\": 6, \"height\": 5, \"segments\": 3}",
};
enum { MODELS = sizeof models / sizeof *models };
static const char *const presets[] = {"\"isometric\"", "\"front\"",
                                      "{\"azimuthDegrees\": 35, \"elevationDegrees\": 20}"};
static const int sides[][2] = {{640, 480}, {256, 256}, {200, 400}, {900, 300}};

static struct reading *read_marked(const char *shape, const char *view, const int side[2], const char *more)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"look\": \"studio\", \"window\": {\"width\": %d, \"height\": %d}, \"view\": %s, "
             "\"meshes\": [{\"name\": \"part\", \"shape\": %s}], %s}",
             side[0], side[1], view, shape, more);
    return read_scene(text);
}

static struct zr_rect rect_of(const struct zr_mark *mark)
{
    const struct zr_type_place p = mark->place;
    return zr_layout_text_rect(p.x, p.y, zr_type_width(mark->text, p.height), p.height, 0.0);
}

static void assert_apart(const struct zr_marks *marks, const int side[2], int model, int preset)
{
    for (uint32_t i = 0; i < marks->count; i++) {
        if (marks->at[i].kind != ZR_MARK_TEXT) continue;
        const struct zr_rect a = rect_of(&marks->at[i]);
        if (a.x0 < 0 || a.y0 < 0 || a.x1 > side[0] || a.y1 > side[1])
            fail_msg("model %d, view %d, %d x %d: %s is cut off", model, preset, side[0], side[1], marks->at[i].text);
        for (uint32_t k = 0; k < marks->count; k++) {
            const struct zr_mark *other = &marks->at[k];
            if (k < i && other->kind == ZR_MARK_TEXT) {
                const struct zr_rect b = rect_of(other);
                if (a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1)
                    fail_msg("model %d, view %d, %d x %d: %s and %s overlap", model, preset, side[0], side[1],
                             marks->at[i].text, other->text);
            }
            if (other->kind != ZR_MARK_LINES) continue;
            for (uint32_t n = 1; n < other->path.ends[0]; n++) {
                const struct zr_segment line = {other->path.points[n - 1], other->path.points[n]};
                if (zr_layout_line_meets(line, a))
                    fail_msg("model %d, view %d, %d x %d: a line crosses %s", model, preset, side[0], side[1],
                             marks->at[i].text);
            }
        }
    }
}

TEST(marks_lie_in_the_window_and_do_not_overlap)
{
    uint32_t texts = 0, left_out = 0;
    for (int m = 0; m < MODELS; m++)
        for (int p = 0; p < 3; p++)
            for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
                struct reading *reading =
                    read_marked(models[m], presets[p], sides[s],
                                "\"title\": \"part.stl\", \"annotate\": [\"box\", \"title\", \"triad\", \"scale\", "
                                "\"labels\"], \"dimensions\": [{\"from\": [0, 0, 0], \"to\": [1, 1, 1]}]");
                const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
                assert_non_null(frame->annotations);
                assert_apart(&frame->annotations->marks, sides[s], m, p);
                for (uint32_t i = 0; i < frame->annotations->marks.count; i++)
                    texts += frame->annotations->marks.at[i].kind == ZR_MARK_TEXT;
                left_out += frame->annotations->left_out_count;
                reading_free(reading);
            }
    print_message("%u texts, %u left out\n", texts, left_out);
    assert_true(texts > 1000);
}

TEST(many_parts_have_numbers_and_a_table)
{
    enum { PARTS = 48 };
    static const int side[] = {640, 480};
    static char text[8192];
    size_t used =
        (size_t)snprintf(text, sizeof text,
                         "{\"look\": \"technical\", \"window\": {\"width\": 640, \"height\": 480}, \"annotate\": "
                         "[\"labels\", \"triad\", \"scale\"], \"view\": {\"azimuthDegrees\": 30, "
                         "\"elevationDegrees\": 50}, \"meshes\": [{\"name\": \"b\", \"shape\": {\"type\": "
                         "\"box\", \"size\": 1.2}}], \"nodes\": [");
    for (int i = 0; i < PARTS; i++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "%s{\"name\": \"bracket-%d\", \"mesh\": \"b\", \"translation\": [%d, 0, %d]}",
                                 i ? "," : "", i, 2 * (i % 8), 2 * (i / 8));
    snprintf(text + used, sizeof text - used, "]}");
    struct reading *reading = read_scene(text);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    assert_int_equal(frame->annotations->numbered_count, PARTS);
    assert_int_equal(frame->annotations->numbered[PARTS - 1].number, PARTS);
    assert_string_equal(frame->annotations->numbered[0].name, "bracket-0");
    assert_true(frame->annotations->left_out_count <= 2); /* which overlap their neighbours */
    assert_apart(&frame->annotations->marks, side, 0, 0);
    reading_free(reading);
}

/* Marks lie beside the model, in columns that hold nothing else. */
TEST(files_have_the_marks_of_the_frame)
{
    struct reading *reading = read_scene("{\"window\": {\"width\": 256, \"height\": 256}, \"annotate\": [\"box\", "
                                         "\"title\", \"triad\"], \"title\": \"cube\", "
                                         "\"meshes\": [{\"shape\": {\"type\": \"box\", \"size\": 1}}]}");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const struct zr_answer answer = scene_encode(&reading->arena, NULL, reading->scene);
    uint32_t width, height;
    uint8_t *pixels = png_memory_read(answer.bytes, answer.size, PNG_AS_RGBA, &width, &height);
    assert_non_null(pixels);
    assert_memory_equal(pixels, frame->color, 4 * 256 * 256);
    free(pixels);
    reading_free(reading);
}

TEST(only_the_color_channel_has_marks)
{
    static const int side[] = {240, 200};
    static const char outputs[] = "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": "
                                  "\"faceId\"}, {\"channel\": \"normals\"}]";
    char on[512];
    snprintf(on, sizeof on, "\"annotate\": [\"triad\"], %s", outputs);
    static const char view[] = "{\"eye\": [3, 4, 5], \"target\": [0, 0, 0]}";
    struct reading *a = read_marked(models[0], view, side, outputs), *b = read_marked(models[0], view, side, on);
    const struct zr_frame *plain = scene_render(&a->arena, NULL, a->scene);
    const struct zr_frame *marked = scene_render(&b->arena, NULL, b->scene);
    assert_null(plain->annotations);
    assert_memory_not_equal(plain->color, marked->color, 4 * 240 * 200);
    for (int c = ZR_CHANNEL_COLOR + 1; c < ZR_CHANNEL_COUNT; c++)
        if (plain->channels[c])
            assert_memory_equal(plain->channels[c], marked->channels[c], 4 * 240 * 200 * zr_channel_rows[c].words);
    reading_free(a);
    reading_free(b);
}

TEST(small_windows_have_no_marks_but_a_list)
{
    static const int side[] = {199, 300};
    struct reading *reading = read_marked(models[0], presets[0], side, "\"annotate\": [\"box\", \"title\"]");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    assert_int_equal(frame->annotations->marks.count, 0);
    assert_int_equal(frame->annotations->left_out_count, 2);
    assert_string_equal(frame->annotations->left_out[0].what, "box");
    reading_free(reading);
}

/* Reads the drilled plate of tests/scenes, from another side and in another window. */
static struct reading *read_plate(const char *view, int width, int height)
{
    static char text[1 << 16];
    size_t size;
    char *scene = file_read("tests/scenes/annotate-holes.json", &size);
    assert_non_null(scene);
    snprintf(text, sizeof text, "{\"view\": %s, \"window\": {\"width\": %d, \"height\": %d}, %s", view, width, height,
             strstr(scene, "\"look\""));
    free(scene);
    return read_scene(text);
}

static const struct zr_mark *mark_of(const struct zr_marks *marks, const char *text)
{
    for (uint32_t i = 0; i < marks->count; i++)
        if (marks->at[i].kind == ZR_MARK_TEXT && strcmp(marks->at[i].text, text) == 0) return &marks->at[i];
    return NULL;
}

static double side_of(struct zr_point a, struct zr_point b, struct zr_point p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* Leaders have three points, other lines two. */
static void assert_no_leader_crosses(const struct zr_marks *marks, const char *view)
{
    for (uint32_t i = 0; i < marks->count; i++)
        for (uint32_t k = 0; k < marks->count; k++) {
            if (i == k || marks->at[i].kind != ZR_MARK_LINES || marks->at[k].kind != ZR_MARK_LINES) continue;
            if (marks->at[i].path.ends[0] != 3 || marks->at[k].path.ends[0] > 3) continue;
            const struct zr_point *a = marks->at[i].path.points, *b = marks->at[k].path.points;
            for (uint32_t n = 1; n < marks->at[k].path.ends[0]; n++)
                if (side_of(a[0], a[1], b[n - 1]) * side_of(a[0], a[1], b[n]) < -1.0 &&
                    side_of(b[n - 1], b[n], a[0]) * side_of(b[n - 1], b[n], a[1]) < -1.0)
                    fail_msg("view %s: leader %u (%g %g to %g %g) crosses line %u (%g %g to %g %g)", view, i, a[0].x,
                             a[0].y, a[1].x, a[1].y, k, b[n - 1].x, b[n - 1].y, b[n].x, b[n].y);
        }
}

TEST(groups_of_equal_holes_have_one_note_each)
{
    static const char *const texts[] = {"6\xc3\x97 \xc3\xb8"
                                        "0.6 through",
                                        "\xc3\xb8"
                                        "1.4 through",
                                        "\xc3\xb8"
                                        "1 depth 0.25"};
    static const char *const views[] = {"\"isometric\"", "\"top\"",
                                        "{\"azimuthDegrees\": 30, \"elevationDegrees\": 40}"};
    static const int windows[][2] = {{640, 480}, {320, 240}, {480, 480}, {1200, 500}};
    for (size_t v = 0; v < sizeof views / sizeof *views; v++)
        for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
            struct reading *reading = read_plate(views[v], windows[w][0], windows[w][1]);
            const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
            const struct zr_marks *marks = &frame->annotations->marks;
            assert_apart(marks, windows[w], 0, (int)v);
            assert_no_leader_crosses(marks, views[v]);
            for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
                if (!mark_of(marks, texts[i])) fail_msg("view %s, %d pixels: no %s", views[v], windows[w][0], texts[i]);
            reading_free(reading);
        }
}

TEST(holes_that_are_not_seen_have_no_note)
{
    struct reading *reading = read_plate("{\"azimuthDegrees\": 200, \"elevationDegrees\": -40}", 640, 480);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    bool is_listed = false;
    assert_null(mark_of(&frame->annotations->marks, "\xc3\xb8"
                                                    "1 depth 0.25")); /* it opens at the top */
    assert_non_null(mark_of(&frame->annotations->marks, "\xc3\xb8"
                                                        "1.4 through"));
    for (uint32_t i = 0; i < frame->annotations->left_out_count; i++)
        is_listed = is_listed || strcmp(frame->annotations->left_out[i].why, "not seen") == 0;
    assert_true(is_listed);
    reading_free(reading);
}

TEST(notes_are_the_same_by_any_number_of_threads)
{
    struct zr_team *team = zr_team_create(3);
    struct reading *a = read_plate("\"isometric\"", 320, 240), *b = read_plate("\"isometric\"", 320, 240);
    const struct zr_frame *one = scene_render(&a->arena, NULL, a->scene);
    const struct zr_frame *three = scene_render(&b->arena, team, b->scene);
    assert_memory_equal(one->color, three->color, 4 * 320 * 240);
    reading_free(a);
    reading_free(b);
    zr_team_destroy(team);
}

TEST(leaders_of_labels_cross_no_dimension)
{
    static const char *const views[] = {"\"isometric\"", "\"front\"", "\"right\"",
                                        "{\"azimuthDegrees\": -40, \"elevationDegrees\": 20}",
                                        "{\"azimuthDegrees\": 70, \"elevationDegrees\": 50}"};
    for (size_t v = 0; v < sizeof views / sizeof *views; v++)
        for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
            static char text[4096];
            snprintf(text, sizeof text,
                     "{\"window\": {\"width\": %d, \"height\": %d}, \"view\": %s, \"annotate\": [\"box\", \"title\", "
                     "\"triad\", \"labels\"], \"dimensions\": [{\"from\": [-20, -10, 15], \"to\": [16, -6, 14]}], "
                     "\"meshes\": [{\"name\": \"base\", \"shape\": {\"type\": \"box\", \"size\": [40, 5, 30]}}, "
                     "{\"name\": \"post\", \"shape\": {\"type\": \"cylinder\", \"radius\": 6, \"height\": 30}}, "
                     "{\"name\": \"foot\", \"shape\": {\"type\": \"box\", \"size\": [6, 4, 6]}}], \"nodes\": "
                     "[{\"mesh\": \"base\"}, {\"mesh\": \"post\", \"translation\": [8, 8, 0]}, {\"mesh\": \"foot\", "
                     "\"translation\": [-16, -4, 11]}, {\"mesh\": \"foot\", \"translation\": [16, -4, 11]}]}",
                     sides[s][0], sides[s][1], views[v]);
            struct reading *reading = read_scene(text);
            const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
            assert_no_leader_crosses(&frame->annotations->marks, views[v]);
            if (s == 0) assert_non_null(mark_of(&frame->annotations->marks, "post"));
            reading_free(reading);
        }
}

TEST(dimensions_end_at_holes_and_picks_and_measure_circles_and_angles)
{
    static char text[1 << 16];
#define DIAMETER "\xc3\xb8"
    static const char *const texts[] = {"4", DIAMETER "1.4", "R0.5", "90\xc2\xb0", "D"};
    size_t size;
    char *scene = file_read("tests/scenes/annotate-holes.json", &size);
    assert_non_null(scene);
    snprintf(
        text, sizeof text,
        "{\"window\": {\"width\": 640, \"height\": 480}, \"look\": \"technical\", \"up\": \"z\", \"dimensions\": "
        "[{\"from\": {\"hole\": 0}, \"to\": {\"hole\": 0, \"index\": 3, \"part\": \"plate\"}}, {\"type\": "
        "\"diameter\", "
        "\"from\": {\"hole\": 1}}, {\"type\": \"radius\", \"from\": {\"hole\": 2}}, {\"from\": {\"pick\": [320, 230]}, "
        "\"to\": {\"hole\": 1}}, {\"type\": \"angle\", \"from\": [8, 0, 0.5], \"to\": [0, 4, 0.5], \"at\": [0, 0, "
        "0.5]}, "
        "{\"type\": \"diameter\", \"from\": [7, 3, 0.5], \"to\": [7.3, 3, 0.5], \"label\": \"D\"}, "
        "{\"from\": {\"hole\": 9}, \"to\": [0, 0, 0]}, {\"from\": {\"pick\": [0, 0]}, \"to\": [0, 0, 0]}], %s",
        strstr(scene, "\"meshes\""));
    free(scene);
    struct reading *reading = read_scene(text);
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!mark_of(&frame->annotations->marks, texts[i]))
            fail_msg("no %s: %s", texts[i], frame->annotations->left_out[0].why);
    assert_int_equal(frame->annotations->left_out_count, 2);
    assert_string_equal(frame->annotations->left_out[0].why, "no such hole");
    assert_string_equal(frame->annotations->left_out[1].why, "nothing is at the pixel");
    assert_no_leader_crosses(&frame->annotations->marks, "default");
    reading_free(reading);
}

/* A plate seen from above. */
static struct reading *read_flat(const int side[2], const char *dimensions)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"window\": {\"width\": %d, \"height\": %d}, \"look\": \"technical\", \"view\": {\"preset\": "
             "\"top\"}, \"dimensions\": [%s], \"meshes\": [{\"name\": \"plate\", \"shape\": {\"type\": \"box\", "
             "\"size\": [40, 5, 30]}}]}",
             side[0], side[1], dimensions);
    return read_scene(text);
}

TEST(oblique_dimensions_are_drawn_in_flat_views)
{
    static const int windows[][2] = {{480, 360}, {640, 480}, {1600, 1200}};
    static const char *const dimensions[] = {"{\"from\": [-15, 2.5, -10], \"to\": [15, 2.5, 10]}",
                                             "{\"from\": [-15, 2.5, 10], \"to\": [0, 2.5, -10]}",
                                             ("{\"from\": [-15, 2.5, -10], \"to\": [15, 2.5, 10]}, "
                                              "{\"from\": [-15, 2.5, 10], \"to\": [15, 2.5, -10]}")};
    for (size_t s = 0; s < sizeof windows / sizeof *windows; s++)
        for (size_t d = 0; d < sizeof dimensions / sizeof *dimensions; d++) {
            struct reading *reading = read_flat(windows[s], dimensions[d]);
            const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
            assert_int_equal(frame->annotations->left_out_count, 0);
            assert_non_null(mark_of(&frame->annotations->marks, d == 1 ? "25" : "36.06"));
            assert_apart(&frame->annotations->marks, windows[s], 0, 0);
            reading_free(reading);
        }
}

TEST(dimensions_that_are_not_drawn_are_warned_of)
{
    static const int large[2] = {480, 360}, small[2] = {199, 360};
    static const struct {
        const int *side;
        const char *dimensions, *warnings;
    } cases[] = {
        {large, "{\"from\": [-20, 2.5, 15], \"to\": [20, 2.5, 15]}", ""},
        {large, "{\"from\": [0, 2.5, 0], \"to\": [9, 2.5, 0]}, {\"from\": {\"hole\": 9}, \"to\": [0, 0, 0]}",
         "/dimensions/1: no such hole"},
        {large, "{\"from\": {\"hole\": 0, \"part\": \"x\"}, \"to\": [0, 0, 0]}",
         "/dimensions/0: no part has this name"},
        {large, "{\"from\": {\"pick\": [0, 0]}, \"to\": [0, 0, 0]}", "/dimensions/0: nothing is at the pixel"},
        {large, "{\"from\": [1, 2, 3], \"to\": [1, 2, 3]}", "/dimensions/0: it has no length"},
        {large, "{\"from\": [1, 0, 3], \"to\": [1, 2, 3]}, {\"from\": [2, 0, 3], \"to\": [2, 2, 3]}",
         "2 marks cannot be drawn in this view: info.annotations.leftOut lists them"},
        {small, "{\"from\": [0, 2.5, 0], \"to\": [9, 2.5, 0]}",
         "1 mark found no room: info.annotations.leftOut lists it"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_flat(cases[i].side, cases[i].dimensions);
        assert_string_equal(scene_encode(&reading->arena, NULL, reading->scene).warnings, cases[i].warnings);
        reading_free(reading);
    }
}

TEST(holes_that_were_not_searched_are_listed_and_warned_of)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 320, \"height\": 240}, \"annotate\": [\"holes\"], \"csg\": {\"difference\": "
        "[\"body\", \"tool\"]}, \"meshes\": [{\"name\": \"body\", \"shape\": {\"type\": \"box\", \"size\": [4, 1, "
        "3]}}, {\"name\": \"tool\", \"shape\": {\"type\": \"cylinder\", \"radius\": 0.5, \"height\": 3}}]}");
    assert_string_equal(scene_encode(&reading->arena, NULL, reading->scene).warnings,
                        "annotate: holes were not searched in the combined solid, which has no mesh");
    reading_free(reading);
}

TEST(letters_without_a_glyph_are_warned_of)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 320, \"height\": 240}, \"annotate\": [\"labels\"], \"meshes\": [{\"name\": "
        "\"\u65e5\u672c\", \"shape\": {\"type\": \"box\", \"size\": [4, 1, 3]}}, {\"name\": \"Stra\u00dfe\", "
        "\"shape\": {\"type\": \"box\", \"size\": [1, 4, 1]}}]}");
    assert_string_equal(scene_encode(&reading->arena, NULL, reading->scene).warnings,
                        "annotate: 1 text has characters that have no glyph: drawn as boxes");
    reading_free(reading);
}

TEST(lengths_have_four_digits_that_count)
{
    static const struct {
        double length, largest;
        const char *unit, *text;
    } cases[] = {{3, 3, "", "3"},
                 {1.9890437, 2, "", "1.989"},
                 {0.42, 2, "", "0.42"},
                 {118.25, 118.25, "mm", "118.3 mm"},
                 {39.999996, 40, "mm", "40 mm"},
                 {0.0236, 0.05, "m", "0.0236 m"},
                 {0.00012, 2, "", "0"},
                 {12345.6, 12345.6, "", "12346"},
                 {0, 0, "", "0"},
                 {2.5e20, 2.5e20, "", "2.5e20"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[ZR_LENGTH_SIZE];
        zr_length_write(cases[i].length, cases[i].largest, cases[i].unit, text);
        assert_string_equal(text, cases[i].text);
    }
    int digit;
    assert_true(zr_length_round(0.7, &digit) == 0.5 && digit == 5);
    assert_true(zr_length_round(39, &digit) == 20.0 && digit == 2);
    assert_true(zr_length_round(1, &digit) == 1.0 && digit == 1);
}

TEST(marks_are_in_the_window_and_apart)
{
    static const char marks[] =
        "\"marks\": [{\"at\": [0, 0, 0], \"text\": \"1\"}, {\"at\": [0, 0, 0], \"text\": \"22\"}, "
        "{\"at\": [0.1, 0, 0], \"text\": \"3 H7\"}]";
    for (int m = 0; m < MODELS; m++)
        for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
            struct reading *reading = read_marked(models[m], presets[0], sides[s], marks);
            const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
            uint32_t texts = 0;
            assert_non_null(frame->annotations);
            assert_apart(&frame->annotations->marks, sides[s], m, 0);
            for (uint32_t i = 0; i < frame->annotations->marks.count; i++)
                texts += frame->annotations->marks.at[i].kind == ZR_MARK_TEXT;
            assert_int_equal(texts + frame->annotations->left_out_count, 3);
            assert_true(texts >= 2);
            reading_free(reading);
        }
}

TEST(wrong_words_and_dimensions_are_refused)
{
    static const char *const wrong[] = {"\"annotate\": [\"boxes\"]",
                                        "\"annotate\": \"box\"",
                                        "\"title\": 3",
                                        "\"marks\": [{\"at\": [0, 0, 0]}]",
                                        "\"dimensions\": [{\"from\": [0, 0, 0]}]",
                                        "\"dimensions\": [{\"from\": [0, 0, 0], \"to\": [0, 0, 1], \"along\": \"w\"}]"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[512];
        snprintf(text, sizeof text, "{\"meshes\": [{\"shape\": {\"type\": \"box\", \"size\": 1}}], %s}", wrong[i]);
        struct reading *reading = read_text(ZR_FORMAT_JSON, text);
        assert_int_equal(reading->status, ZR_BAD_SCENE);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
