/* Large lists that several threads read: the same scenes, the same complaints. */
#include <string.h>

#include "by_teams.h"
#include "input/json_text.h"
#include "input/json_walk.h"
#include "json_texts.h"
#include "support/sanitized.h"

/* ThreadSanitizer makes texts thirty times as slowly. */
#if IS_THREAD_SANITIZED
enum { ROUNDS = 3 };
static const enum spelling spellings_end = LINES;
#else
enum { ROUNDS = 40 };
static const enum spelling spellings_end = SPELLINGS;
#endif

/* ---- marks ---- */

/* What is before each mark, counted one by one. */
static void assert_marks(const struct zr_json_list *list)
{
    const char *at = list->at;
    size_t rows = 0, commas = 0;
    for (size_t i = 0; i < list->mark_count; i++) {
        const struct zr_json_mark *mark = &list->marks[i];
        assert_true(mark->at >= at + ZR_JSON_MARK_BYTES && mark->at < list->end);
        for (; at < mark->at; at++) {
            rows += *at == ']';
            commas += *at == ',';
        }
        assert_int_equal(*at, ',');
        assert_int_equal(mark->items, rows);
        assert_int_equal(mark->numbers, commas + 1);
    }
}

static void marks_have_counts_of_all_before_them(void **state)
{
    (void)state;
    struct text text = make_scene(20000);
    for (enum spelling spelling = AS_IT_IS; spelling < spellings_end; spelling++) {
        struct text other = respell(text.bytes, spelling);
        const char *end = other.bytes + other.size;
        struct zr_arena arena;
        struct zr_json_lists lists = {0};
        zr_arena_init(&arena, CEILING);
        static const char *const keys[] = {"\"positions\"", "\"lines\"", "\"colors\""};
        for (size_t k = 0; k < 3; k++) {
            const char *key = strstr(other.bytes, keys[k]);
            if (!key) continue; /* it is escaped */
            const char *at = strchr(key, '[');
            assert_non_null(zr_json_list_add(&arena, &lists, at, end, false, 3));
            const struct zr_json_list *list = &lists.list[lists.count - 1];
            assert_marks(list);
            if (k < 2) /* colours are strings, too */
                assert_true(list->mark_count + 1 >= (size_t)(list->end - list->at) / (ZR_JSON_MARK_BYTES + 8192));
            else
                assert_int_equal(list->mark_count, 0);
        }
        assert_true(lists.count > 0 || spelling == ESCAPED_KEYS);
        zr_arena_free(&arena);
        drop(&other);
    }
    drop(&text);
}

/* Its brackets do not say how many items there are. */
static void list_with_anything_else_than_rows_has_no_marks(void **state)
{
    (void)state;
    static const char *const odd[] = {"\"],[\"", "[[1],0]", "7", "{}"};
    for (size_t i = 0; i < 4; i++) {
        struct text text = {0};
        add(&text, "[[0,0]");
        for (size_t k = 0; k < 50000; k++)
            add(&text, ",[%zu,0]", k);
        add(&text, ",%s,[1,2]]", odd[i]);
        struct zr_arena arena;
        struct zr_json_lists lists = {0};
        zr_arena_init(&arena, CEILING);
        assert_non_null(zr_json_list_add(&arena, &lists, text.bytes, text.bytes + text.size, false, 2));
        assert_int_equal(lists.list[0].items, 50003);
        assert_int_equal(lists.list[0].mark_count, 0);
        zr_arena_free(&arena);
        drop(&text);
    }
}

static void marks_of_polygons_have_counts_of_all_before_them(void **state)
{
    (void)state;
    struct text text = {0};
    add(&text, "[");
    for (size_t i = 0; i < 9000; i++) {
        add(&text, "%s{\"vertices\":[", i ? "," : "");
        add_places(&text, 3 + below(4), 4);
        add(&text, "],\"material\":\"m]\"}");
    }
    add(&text, "]");
    struct zr_arena arena;
    struct zr_json_lists lists = {0};
    zr_arena_init(&arena, CEILING);
    assert_non_null(zr_json_list_add(&arena, &lists, text.bytes, text.bytes + text.size, true, 2));
    const struct zr_json_list *list = &lists.list[0];
    assert_true(list->mark_count >= text.size / (ZR_JSON_MARK_BYTES + 1024));
    size_t polygons = 0, opens = 0;
    const char *at = text.bytes;
    for (size_t i = 0; i < list->mark_count; i++) {
        for (; at < list->marks[i].at; at++) {
            polygons += *at == '{';
            opens += *at == '[';
        }
        assert_int_equal(*at, ',');
        assert_int_equal(at[-1], '}');
        assert_int_equal(list->marks[i].items, polygons);
        assert_int_equal(list->marks[i].numbers, opens - 1 - polygons);
    }
    zr_arena_free(&arena);
    drop(&text);
}

/* ---- walks ---- */

struct visits {
    _Atomic uint8_t *of; /* each item */
    atomic_size_t ahead, wrong;
    size_t odd; /* an item that is not plain */
};

/* Items are [number, 0]: their own numbers. */
static void visit(struct zr_json_walk *walk, void *context)
{
    struct visits *visits = context;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        visits->wrong += walk->index >= walk->to.items || walk->number != 2 * walk->index ||
                         strtoul(walk->at + 1, NULL, 10) != walk->index;
        if (walk->index != visits->odd) {
            walk->behind = strchr(walk->at, ']') + 1;
        } else if ((item = zr_json_walk_parse(walk))) {
            visits->wrong += walk->ahead;
            zr_json_walk_drop(walk, item);
        }
        walk->number += 2;
        if (!walk->behind) continue;
        visits->of[walk->index]++;
        visits->ahead += walk->ahead;
    }
}

static void items_are_read_ahead_but_for_parts_with_an_odd_one(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    struct text text = {0};
    add(&text, "{\"meshes\":[{\"lines\":[");
    for (size_t i = 0; i < COUNT; i++)
        add(&text, "%s[%zu,0]", i ? "," : "", i);
    add(&text, "]}]}");
    const size_t odd[] = {SIZE_MAX, 0, COUNT / 2, COUNT - 1};
    for (size_t i = 0; i < 4; i++) {
        struct zr_arena arena;
        zr_arena_init(&arena, CEILING);
        struct zr_limits limits = zr_limits_default();
        struct zr_error error = {0};
        struct zr_json_text opened = {0};
        struct zr_json json = {&arena, zr_team_create(3), NULL, &limits, &error, &opened};
        cJSON *root = zr_json_text_open(&json, text.bytes, text.size);
        assert_non_null(root);
        struct visits visits = {.of = calloc(COUNT, 1), .odd = odd[i]};
        struct zr_json_list *list = &opened.lists.list[0];
        assert_true(list->mark_count > 4);
        struct zr_json_walk walk = zr_json_walk_begin(&json, NULL, list);
        assert_int_equal(zr_json_walk_all(&walk, visit, &visits), COUNT);
        assert_true(list->read);
        assert_int_equal(visits.wrong, 0);
        /* The part with the odd one is read once more, and so may be what others read meanwhile. */
        for (size_t k = 0; k < COUNT; k++)
            assert_in_range(visits.of[k], 1, odd[i] == SIZE_MAX ? 1 : 3);
        if (odd[i] == SIZE_MAX)
            assert_int_equal(visits.ahead, COUNT);
        else
            assert_true(visits.ahead > COUNT / 2);
        assert_int_equal(zr_json_text_close(&json, root), ZR_OK);
        free((void *)visits.of);
        zr_team_destroy(json.team);
        zr_arena_free(&arena);
    }
    drop(&text);
}

/* ---- scenes ---- */

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

static void every_team_reads_the_same_scene(void **state)
{
    (void)state;
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
static void every_team_has_the_same_complaints(void **state)
{
    (void)state;
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

/* What comes behind a wrong polygon is read without the places that it would have had. */
static void faults_take_as_much_memory_for_every_team(void **state)
{
    (void)state;
    struct text text = {0};
    add(&text, "{\"polygons\":[" CORNERS "},{\"vertices\":[");
    add_places(&text, 500, 3);
    add(&text, ",[0,0]]}");
    for (size_t i = 0; i < 20000; i++) /* their indices are more than the tree of the wrong one */
        add(&text, "," CORNERS "}");
    add(&text, "]}");
    struct reading *alone = read_by(NULL, ZR_FORMAT_JSON, &text);
    assert_int_equal(alone->error.count, 1);
    for (size_t i = 0; i < TEAMS; i++) {
        struct reading *shared = read_by(teams[i], ZR_FORMAT_JSON, &text);
        assert_same_reading(alone, shared);
        assert_int_equal(alone->arena.peak, shared->arena.peak);
        reading_free(shared);
    }
    reading_free(alone);
    drop(&text);
}

/* A row that is longer than all that one thread reads ahead, and marks in it. */
static void rows_of_any_length_are_read(void **state)
{
    (void)state;
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

/* ---- cancelled ---- */

static struct zr_cancel cancel;
static size_t parts_parsed, parts_until_raised;

/* For cJSON, which asks for memory for each part of what it parses. */
static void *count_malloc(size_t size)
{
    if (parts_parsed++ == parts_until_raised) atomic_store(&cancel.raised, true);
    return malloc(size);
}

static void reading_ends_soon_once_it_is_cancelled(void **state)
{
    (void)state;
    enum { PARTS_OF_AN_ITEM = 4000 }; /* the largest is a row of heights */
    struct text text = make_scene(3000), other = respell(text.bytes, LINES);
    struct zr_team *team = zr_team_create(3);
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .cancel = &cancel};
    cJSON_InitHooks(&(cJSON_Hooks){count_malloc, free});
    size_t all = SIZE_MAX;
    for (int step = -1; step < 24; step++) { /* the first is never cancelled */
        parts_until_raised = step < 0 ? SIZE_MAX : all * (size_t)step / 24;
        parts_parsed = 0;
        atomic_store(&cancel.raised, false);
        struct reading *reading =
            read_by_team(step % 2 ? team : NULL, request, other.bytes, other.size, zr_limits_default(), CEILING);
        if (step < 0) {
            assert_read(reading);
            all = parts_parsed;
            assert_true(all > 10 * PARTS_OF_AN_ITEM);
        } else {
            assert_int_equal(reading->status, ZR_CANCELLED);
            assert_int_equal(reading->error.count, 1);
            assert_non_null(strstr(reading->error.items[0].detail, "stopped"));
            assert_null(reading->scene);
            assert_true(parts_parsed < parts_until_raised + PARTS_OF_AN_ITEM);
        }
        reading_free(reading);
    }
    cJSON_InitHooks(NULL);
    zr_team_destroy(team);
    drop(&other);
    drop(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_have_counts_of_all_before_them),
        cmocka_unit_test(list_with_anything_else_than_rows_has_no_marks),
        cmocka_unit_test(marks_of_polygons_have_counts_of_all_before_them),
        cmocka_unit_test(items_are_read_ahead_but_for_parts_with_an_odd_one),
        cmocka_unit_test(every_team_reads_the_same_scene),
        cmocka_unit_test(every_team_has_the_same_complaints),
        cmocka_unit_test(faults_take_as_much_memory_for_every_team),
        cmocka_unit_test(rows_of_any_length_are_read),
        cmocka_unit_test(reading_ends_soon_once_it_is_cancelled),
    };
    return cmocka_run_group_tests_name("json_walk", tests, start_teams, end_teams);
}
