/* Faults in the large lists of a scene: wherever one is, the pointer to it. */
#include <time.h>

#include "base/team.h"
#include "support/tests.h"
#include "unit/common/json_texts.h"

struct list_case {
    const char *before, *item, *after; /* the text around a list, and a good item of it */
    const char *pointer;               /* of the list */
    const char *bad, *inner, *detail;  /* a bad item, where in it, and what is said */
};

static const struct list_case cases[] = {
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,2e6]", "/2",
     "2000000 is outside of -1000000 to 1000000"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1]", "",
     "expected 3 or 4 numbers, found 2"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,2,3,4]", "",
     "expected 3 or 4 numbers, found 5"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,null,2]", "/1",
     "expected a number, found null"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "7", "",
     "expected a list of numbers, found a number"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,1e999]", "/2",
     "a number too large"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[[1],2,3]", "/0",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "{\"x\":1}", "",
     "expected a list of numbers, found an object"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,\n[1],2]", "/1",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0, [1],2]", "/1",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[ [1],[2],[3]]",
     "/0", "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,{},[1]]", "/1",
     "expected a number, found an object"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0 ,[1],[[]]]",
     "/1", "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,\"],[\"]",
     "/2", "expected a number, found a string"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,\n[1],2],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0, [1],2],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[ [1],[2],[3]],[0,1,0]]}",
     "/vertices/1/0", "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,{},[1]],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found an object"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0 ,[1],[[]]],[0,1,0]]}",
     "/vertices/1/1", "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,1,\"],[\"],[0,1,0]]}",
     "/vertices/1/2", "expected a number, found a string"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1,4]", "/2",
     "index 4 of 4 positions; they count from 0"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,-1,2]", "/1",
     "index -1 of 4"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1.5,2]", "/1",
     "not a whole number"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,123456789012,2]", "/1",
     "index 123456789012 of 4"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1]", "",
     "a face of 2 corners"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[]", "", "a face of 0 corners"},
    {"{\"meshes\":[{" POSITIONS ",\"lines\":[", "[3,1]", "]}]}", "/meshes/0/lines", "[0,1,2]", "",
     "a line of 3 ends; it has two"},
    {"{\"meshes\":[{" POSITIONS ",\"lines\":[", "[3,1]", "]}]}", "/meshes/0/lines", "[0,\"1\"]", "/1",
     "expected an index, found a string"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "[1,2]", "",
     "2 values, but the first row has 3"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "[1,2,true]", "/2",
     "expected a number, found a boolean"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "5", "",
     "expected a list, found a number"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", CORNERS ",\"color\":[0,0,2]}", "/color/2",
     "2 is outside of 0 to 1"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[1,0,0],[0,1,9e9]]}", "/vertices/2/2",
     "outside of -1000000 to 1000000"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[1,0,0]]}", "/vertices",
     "a polygon of 2 vertices"},
    {"{\"polygons\":[", CORNERS ",\"normals\":[[0,0,1],[0,0,1],[0,0,1]]}", "]}", "/polygons",
     CORNERS ",\"normals\":[[0,0,1],[0,0,1]]}", "/normals", "2 items for 3 vertices"},
    {"{\"polygons\":[", CORNERS ",\"colors\":[\"#123456\",[0,0,1],[0,0,1,1]]}", "]}", "/polygons",
     CORNERS ",\"colors\":[[0,0,1],[0,0,1],\"rot\"]}", "/colors/2", "'rot' is not a colour"},
    {"{\"polygons\":[", CORNERS ",\"doubleSided\":true}", "]}", "/polygons", CORNERS ",\"doubleSided\":1}",
     "/doubleSided", "expected true or false, found a number"},
    {"{\"polygons\":[", CORNERS ",\"holes\":[[[0,0,0],[0,0,0],[0,0,0]]]}", "]}", "/polygons",
     CORNERS ",\"holes\":[[[0,0,0],[0,0,0],[0,0]]]}", "/holes/0/2", "expected 3 or 4 numbers, found 2"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", CORNERS "," TRIANGLE "}", "/vertices", "given twice"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "null", "", "expected an object, found null"},
};

static struct text list_with(const struct list_case *list, size_t count, size_t place)
{
    struct text text = {0};
    add(&text, "%s", list->before);
    for (size_t i = 0; i < count; i++)
        add(&text, "%s%s", i ? "," : "", i == place ? list->bad : list->item);
    add(&text, "%s", list->after);
    return text;
}

TEST(fault_anywhere_in_a_list_has_its_pointer)
{
    /* The last in several parts, for several threads. */
    static const size_t counts[] = {4, 5000, 40000}, none = SIZE_MAX;
    struct zr_team *team = zr_team_create(3);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t c = 0; c < 3; c++) {
            size_t count = counts[c];
            const size_t places[] = {none, 0, count / 2, count - 1};
            bool no_shape = strstr(cases[i].detail, "the first row"); /* what comes first is right */
            for (size_t p = 0; p < 4; p++) {
                if (no_shape && places[p] == 0) continue;
                struct text text = list_with(&cases[i], count, places[p]);
                struct reading *reading =
                    read_by_team(c == 2 ? team : NULL, (struct zr_request){.format = ZR_FORMAT_JSON}, text.bytes,
                                 text.size, zr_limits_default(), (size_t)1 << 28);
                char pointer[128];
                snprintf(pointer, sizeof pointer, "%s/%zu%s", cases[i].pointer, places[p], cases[i].inner);
                if (places[p] == none)
                    assert_read(reading);
                else
                    assert_complaint(reading, ZR_BAD_SCENE, pointer, cases[i].detail);
                reading_free(reading);
                drop(&text);
            }
        }
    zr_team_destroy(team);
}

/* Reading stops there, and what would follow is not measured against the half of it. */
TEST(last_fault_that_is_kept_is_the_last_complaint)
{
    struct text text = {0};
    add(&text, "{\"meshes\":[{" POSITIONS ",\"faces\":[[0,1]");
    for (int i = 1; i < ZR_ERROR_ITEMS; i++)
        add(&text, ",[0,1]");
    add(&text, "],\"faceColors\":[[0,0,0]");
    for (int i = 1; i < ZR_ERROR_ITEMS; i++)
        add(&text, ",[0,0,0]");
    add(&text, "]}]}");
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    assert_complaint(reading, ZR_BAD_SCENE, "/meshes/0/faces/0", "a face of 2 corners");
    assert_int_equal(reading->error.count, ZR_ERROR_ITEMS);
    reading_free(reading);
    drop(&text);
}

TEST(bad_syntax_in_a_list_comes_before_other_faults)
{
    static const char *const bad[] = {
        "[1,2,3",           "[1,2,03]",  "[1,2,3.]", "[1,2,+3]",  "[1,2,.5]", "[1,2,3,]", "[1 2,3]",
        "[1,2,3}",          "[1,2,\"a]", "[1,2,3]]", "[1,2,3],",  "",         "[1,,3]",   "[1,2,3]x",
        "[1,2,3],,[1,2,3]", "[1,2,1e]",  "[1,2,-]",  "[1,2,nul]", "{\"a\":}", "\"\x80\"", "\"\n\""};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t b = 0; b < sizeof bad / sizeof *bad; b++)
            for (size_t place = 0; place < 3; place++) {
                struct list_case list = cases[i];
                list.bad = bad[b];
                struct text text = list_with(&list, 3, place), faulty = {0};
                add(&faulty, "{\"nodez\":1,\"shading\":7,%s", text.bytes + 1);
                for (size_t k = 0; k < 2; k++) {
                    const struct text *body = k ? &faulty : &text;
                    struct reading *reading = read_bytes(ZR_FORMAT_JSON, body->bytes, body->size);
                    if (reading->status != ZR_BAD_SYNTAX) fail_msg("%s: status %d", body->bytes, reading->status);
                    assert_int_equal(reading->error.count, 1);
                    assert_non_null(strstr(reading->error.items[0].detail, "line "));
                    reading_free(reading);
                }
                drop(&faulty);
                drop(&text);
            }
}

TEST(text_cut_short_anywhere_is_bad_syntax)
{
    struct text text = make_scene(12);
    for (size_t size = 0; size < text.size; size++) {
        struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, size);
        assert_int_equal(reading->status, ZR_BAD_SYNTAX);
        reading_free(reading);
    }
    drop(&text);
}

TEST(indices_before_their_positions_have_the_same_complaints)
{
    static const char *const words[] = {"expected an index, found a string", "index -1",
                                        "index 2.5 is not a whole number"};
    struct reading *first = read_text(ZR_FORMAT_JSON, "{\"meshes\":[{" POSITIONS ",\"faces\":[[\"0\",-1,2.5]]}]}"),
                   *last = read_text(ZR_FORMAT_JSON, "{\"meshes\":[{\"faces\":[[\"0\",-1,2.5]]," POSITIONS "}]}");
    for (int i = 0; i < 3; i++) {
        assert_string_equal(first->error.items[i].pointer, last->error.items[i].pointer);
        assert_non_null(strstr(first->error.items[i].detail, words[i]));
        assert_non_null(strstr(last->error.items[i].detail, words[i]));
    }
    reading_free(first);
    reading_free(last);
}

TEST(each_polygon_is_judged_by_itself)
{
    struct reading *reading =
        read_text(ZR_FORMAT_JSON, "{\"nodez\":1,\"polygons\":[" CORNERS ",\"colors\":[\"red\",\"red\",\"red\"]},"
                                  "{\"vertices\":[[0,0,0],[1,0]],\"colors\":[\"red\"]}," CORNERS
                                  ",\"colors\":[\"red\"]}," CORNERS ",\"normals\":[[0,0,1],[0,0,1]]}," CORNERS "}]}");
    static const char *const pointers[] = {"/nodez", "/polygons/1/vertices/1", "/polygons/1/vertices",
                                           "/polygons/2/colors", "/polygons/3/normals"};
    assert_int_equal(reading->error.count, 5);
    for (int i = 0; i < 5; i++)
        assert_string_equal(reading->error.items[i].pointer, pointers[i]);
    assert_string_equal(reading->error.items[3].detail, "1 items for 3 vertices; the counts must be equal");
    assert_string_equal(reading->error.items[4].detail, "2 items for 3 vertices; the counts must be equal");
    reading_free(reading);
}

/* A suggestion for each of thousands, out of thousands, would take minutes. */
TEST(thousands_of_unknown_materials_are_told_at_once)
{
    struct text text = {0};
    add(&text, "{\"materials\":[");
    for (size_t i = 0; i < 20000; i++)
        add(&text, "%s{\"name\":\"abcdabcdabcdabcdabcdabcdabcd%08zu\"}", i ? "," : "", i);
    add(&text, "],\"polygons\":[");
    for (size_t i = 0; i < 20000; i++)
        add(&text, "%s" CORNERS ",\"material\":\"abcdabcdabcdabcdabcdabcdabce%08zu\"}", i ? "," : "", i + 50000);
    add(&text, "]}");
    const clock_t begin = clock();
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    const double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    assert_complaint(reading, ZR_BAD_SCENE, "/polygons/0/material", "no material has the name");
    assert_int_equal(reading->error.count, ZR_ERROR_ITEMS);
    assert_true(seconds < 30); /* 0.2 s; it was 40 minutes */
    reading_free(reading);
    drop(&text);
}

RUN_TESTS(NULL, NULL)
