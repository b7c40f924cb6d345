/* Large lists that several threads read: the same scenes, the same complaints. */
#include <string.h>

#include "support/sanitized.h"
#include "support/tests.h"
#include "unit/common/by_teams.h"
#include "unit/common/json_texts.h"

/* ThreadSanitizer makes texts thirty times as slowly. */
#if IS_THREAD_SANITIZED
enum { ROUNDS = 3 };
static const enum spelling spellings_end = LINES;
#else
enum { ROUNDS = 40 };
static const enum spelling spellings_end = SPELLINGS;
#endif

/* With looks that change here and there, and one colour that is not opaque. */
static void add_plain_polygons(struct text *text, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const size_t vertices = 3 + below(3), look = i * 8 / count;
        add(text, "%s{\"vertices\":[", i ? "," : "");
        add_places(text, vertices, 4);
        add(text, "]");
        if (look & 1) add(text, ",\"color\":[0.25,%g,1%s]", (double)below(100) / 99, i == count / 5 ? ",0.5" : "");
        if (look & 2) add(text, ",\"material\":\"m%zu\"", look & 1);
        if (look == 4) {
            add(text, ",\"normals\":[");
            add_places(text, vertices, 3);
            add(text, "]");
        }
        add(text, "}");
    }
}

/* Colours without strings, few holes in heights and none in polygons. */
static struct text make_plain_scene(size_t count)
{
    struct text text = {0};
    add(&text, "{\"materials\":[{\"name\":\"m0\"},{\"name\":\"m1\",\"shading\":\"unlit\"}],"
               "\"meshes\":[{\"positions\":[");
    add_places(&text, count, 4);
    add(&text, "],\"faces\":[[0,1,2]],\"colors\":[[1,1,1]");
    for (size_t i = 1; i < count; i++)
        add(&text, ",[0.%zu,%g,1]", below(100000), (double)below(9999) / 9999);
    add(&text, "]},{\"heights\":[");
    for (size_t row = 0; row < count / 50; row++) {
        for (size_t column = 0; column < 150; column++)
            if (column == 77 && row % 37 == 36)
                add(&text, ",null");
            else
                add(&text, "%s%.7g", column ? "," : row ? ",[" : "[", any_place());
        add(&text, "]");
    }
    add(&text, "]}],\"polygons\":[");
    add_plain_polygons(&text, count);
    add(&text, "]}");
    return text;
}

TEST(every_team_reads_the_same_scene)
{
    for (int plain = 0; plain < 2; plain++) {
        struct text text = plain ? make_plain_scene(9000) : make_scene(9000);
        for (enum spelling spelling = AS_IT_IS; spelling < spellings_end; spelling++) {
            struct text other = respell(text.bytes, spelling);
            struct reading *alone = read_by_all(ZR_FORMAT_JSON, &other);
            assert_read(alone);
            reading_free(alone);
            drop(&other);
        }
        drop(&text);
    }
}

/* A byte here and there that is another one, or a piece that is not there. */
TEST(every_team_has_the_same_complaints)
{
    static const char bytes[] = "[]{},:\"0123456789.e-+ \n\\tn";
    size_t refused = 0;
    for (size_t i = 0; i < ROUNDS; i++) {
        struct text text = i & 1 ? make_plain_scene(7000) : make_scene(6000);
        for (size_t k = 0; k <= below(3); k++)
            text.bytes[below(text.size)] = bytes[below(sizeof bytes - 1)];
        if (below(3) == 0) {
            const size_t gap = below(text.size / 2), from = below(text.size - gap);
            memmove(text.bytes + from, text.bytes + from + gap, text.size - from - gap);
            text.size -= gap;
        }
        struct reading *alone = read_by_all(ZR_FORMAT_JSON, &text);
        refused += alone->status != ZR_OK;
        reading_free(alone);
        drop(&text);
    }
    assert_in_range(refused, ROUNDS / 4, ROUNDS);
}

/* A row that is longer than all that one thread reads ahead, and marks in it. */
TEST(rows_of_any_length_are_read)
{
    static const size_t columns[] = {2, 3000, 60000, 300000};
    for (size_t i = 0; i < 4; i++) {
        struct text text = {0};
        add(&text, "{\"meshes\":[{\"heights\":[");
        for (size_t row = 0; row < 600000 / columns[i]; row++) {
            for (size_t column = 0; column < columns[i]; column++)
                add(&text, "%s%zu", column ? "," : row ? ",[" : "[", below(9));
            add(&text, "]");
        }
        add(&text, "]}]}");
        struct reading *alone = read_by_all(ZR_FORMAT_JSON, &text);
        assert_read(alone);
        reading_free(alone);
        drop(&text);
    }
}

/* Too deep an item in a list of which parts are read ahead: nobody goes on in it for ever. */
TEST(too_deep_an_item_ends_every_team)
{
    static const char *const lists[] = {"positions", "normals", "colors", "faces", "lines", "heights"};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        for (size_t deep = 0; deep < 30000; deep += 9999) {
            struct text text = {0};
            add(&text, "{\"meshes\":[{\"%s\":[[0,1,0]", lists[i]);
            for (size_t k = 0; k < 30000; k++) {
                if (k != deep) add(&text, ",[0,1,0]");
                for (size_t level = 0; k == deep && level < 100; level++)
                    add(&text, level ? "[" : ",[");
            }
            struct reading *alone = read_by_all(ZR_FORMAT_JSON, &text);
            assert_complaint(alone, ZR_BAD_SCENE, "", "nested deeper than 64 levels");
            reading_free(alone);
            drop(&text);
        }
}

/* What the first row is, no part can know by itself. */
TEST(heights_that_begin_oddly_have_the_same_complaints)
{
    for (size_t rows = 60; rows < 76; rows++) {
        struct text text = {0};
        add(&text, "{\"meshes\":[{\"heights\":[\"");
        for (size_t k = 0; k < 20; k++)
            add(&text, "%01000d", 0);
        add(&text, "\"");
        for (size_t k = 0; k < rows + 240; k++)
            add(&text, k < rows ? ",[1,2,3%1000s]" : ",[1,2,3,4%1000s]", "");
        add(&text, "]}]}");
        struct reading *alone = read_by_all(ZR_FORMAT_JSON, &text);
        assert_complaint(alone, ZR_BAD_SCENE, "/meshes/0/heights/0", "expected a list, found a string");
        assert_true(alone->error.count >= ZR_ERROR_ITEMS);
        reading_free(alone);
        drop(&text);
    }
}

RUN_TESTS(start_teams, end_teams)
