/* Large OBJ files, which are read in parts by several threads: what is in them is known, and where their faults are. */
#include "by_teams.h"
#include "input/input.h"
#include "input/obj_text.h"
#include "support/sanitized.h"

/* ThreadSanitizer reads thirty times as slowly. */
#if IS_THREAD_SANITIZED
enum { ROUNDS = 2 };
#else
enum { ROUNDS = 12 };
#endif

enum { STATEMENTS = 60000, FAULTS_MAX = 30, VERTICES = 4, CORNERS_MAX = 9, PART_BYTES = 1 << 16 };

/* Where in a file there are colours, or corners with normals. */
enum where { NOWHERE, ANYWHERE, FIRST_HALF, SECOND_HALF, WHERES };

/* What a text says, written down while it is made. */
struct said {
    struct text text;
    size_t line; /* of the next statement */
    size_t positions, normals, faces, corners;
    enum where normals_where, colors_where;
    bool second_half, color_given, normal_given, normal_missing;
    zr_vec4 position[STATEMENTS + VERTICES], color[STATEMENTS + VERTICES];
    zr_vec3 normal[STATEMENTS + VERTICES];
    uint32_t end[STATEMENTS], index[STATEMENTS * CORNERS_MAX], normal_index[STATEMENTS * CORNERS_MAX];
    size_t faults;
    char fault[FAULTS_MAX][FAULT_SIZE];
};

/* Blanks, which a backslash may lead over a line's end. */
static void say_blank(struct said *said)
{
    static const char *const blanks[] = {"  ", "\t", " \\\n", "\\\r\n ", " \f"};
    const size_t which = below(40);
    add(&said->text, "%s", which < 5 ? blanks[which] : " ");
    said->line += which == 2 || which == 3;
}

static void end_statement(struct said *said)
{
    static const char *const ends[] = {"\r\n", " # 1 2 3\n", "\n\n", "\n# a path C:\\\n", " #\\\r\n"};
    const size_t which = below(30);
    add(&said->text, "%s", which < 5 ? ends[which] : "\n");
    said->line += which == 2 || which == 3 ? 2 : 1;
}

static float say_number(struct said *said, double low)
{
    const double value = low + (1.0 - low) * (double)below(1000001) / 1e6;
    char digits[32];
    snprintf(digits, sizeof digits, "%.*f", (int)below(9), value);
    say_blank(said);
    add(&said->text, "%s", digits);
    return (float)strtod(digits, NULL);
}

static bool is_there(const struct said *said, enum where where)
{
    return where == ANYWHERE || where == (said->second_half ? SECOND_HALF : FIRST_HALF);
}

static void say_position(struct said *said)
{
    zr_vec4 *position = &said->position[said->positions], *color = &said->color[said->positions];
    add(&said->text, "v");
    position->x = say_number(said, -1);
    position->y = say_number(said, -1);
    position->z = say_number(said, -1);
    position->w = 1;
    *color = (zr_vec4){1, 1, 1, 1};
    if (is_there(said, said->colors_where) && below(50)) {
        said->color_given = true;
        color->x = say_number(said, 0);
        color->y = say_number(said, 0);
        color->z = say_number(said, 0);
    }
    said->positions++;
    end_statement(said);
}

static void say_normal(struct said *said)
{
    zr_vec3 *normal = &said->normal[said->normals++];
    add(&said->text, "vn");
    normal->x = say_number(said, -1);
    normal->y = say_number(said, -1);
    normal->z = say_number(said, -1);
    end_statement(said);
}

/* Of those so far, counted from the first or from the last. */
static uint32_t say_index(struct said *said, size_t so_far)
{
    const uint32_t index = (uint32_t)below(so_far);
    if (below(3))
        add(&said->text, "%u", index + 1);
    else
        add(&said->text, "-%zu", so_far - index);
    return index;
}

static void say_face(struct said *said)
{
    const size_t corners = 3 + below(below(9) ? 2 : CORNERS_MAX - 2);
    add(&said->text, "f");
    for (size_t i = 0; i < corners; i++, said->corners++) {
        say_blank(said);
        said->index[said->corners] = say_index(said, said->positions);
        said->normal_index[said->corners] = UINT32_MAX;
        if (is_there(said, said->normals_where) && (said->normals_where != ANYWHERE || below(100))) {
            add(&said->text, "/%s/", below(2) ? "7" : "");
            said->normal_index[said->corners] = say_index(said, said->normals);
            said->normal_given = true;
        } else {
            said->normal_missing = true;
        }
    }
    said->end[said->faces++] = (uint32_t)said->corners;
    end_statement(said);
}

static void say_other(struct said *said)
{
    static const char *const others[] = {"vt 0.5 1", "o f 1 2 3", "usemtl v", "s off", "", "#f", "g a \\\nf 1"};
    const size_t which = below(7);
    add(&said->text, "%s", others[which]);
    said->line += which == 6;
    end_statement(said);
}

/* Statements at fault, that reading goes on behind. */
static void say_fault(struct said *said)
{
    static const struct {
        const char *statement, *complaint;
    } faults[] = {{"f 1 2 99999999", "index 99999999 of"},
                  {"f 1 2 -99999999", "relative index -99999999"},
                  {"f 1 2", "a face of 2 corners"},
                  {"v 0 1e20 0", "'1e20' is beyond"},
                  {"v 0 0 0 1 1 2", "a colour component of 2"},
                  {"f 1//1 2//1 3//9999999", "index 9999999 of"}};
    const size_t which = below(6);
    add(&said->text, "%s\n", faults[which].statement);
    snprintf(said->fault[said->faults++], FAULT_SIZE, "line %zu: %s", said->line++, faults[which].complaint);
}

static struct said *say(enum where normals, enum where colors, size_t faults)
{
    struct said *said = calloc(1, sizeof *said);
    assert_non_null(said);
    said->line = 1;
    said->normals_where = normals;
    said->colors_where = colors;
    for (size_t i = 0; i < VERTICES; i++) {
        say_position(said);
        if (normals) say_normal(said);
    }
    for (size_t i = 0; i < STATEMENTS; i++) {
        const size_t which = below(100);
        said->second_half = i >= STATEMENTS / 2;
        if (which < 35)
            say_position(said);
        else if (which < 90)
            say_face(said);
        else if (which < 95 && normals)
            say_normal(said);
        else
            say_other(said);
        if (said->second_half && said->faults < faults && below(STATEMENTS / FAULTS_MAX / 2) == 0) say_fault(said);
    }
    return said;
}

static void unsay(struct said *said)
{
    drop(&said->text);
    free(said);
}

static void assert_normals(const struct said *said, const struct zr_mesh *mesh)
{
    if (!said->normal_given) {
        assert_null(mesh->normal_indices);
        assert_int_equal(mesh->normal_count, 0);
        return;
    }
    assert_int_equal(mesh->normal_count, said->normals + said->normal_missing);
    assert_memory_equal(mesh->normals, said->normal, said->normals * sizeof said->normal[0]);
    for (size_t i = 0; i < said->corners; i++) {
        const uint32_t want = said->normal_index[i];
        assert_int_equal(mesh->normal_indices[i], want == UINT32_MAX ? said->normals : want);
    }
}

static void assert_said(const struct said *said, const struct zr_mesh *mesh)
{
    assert_int_equal(mesh->position_count, said->positions);
    assert_int_equal(mesh->face_count, said->faces);
    assert_memory_equal(mesh->positions, said->position, said->positions * sizeof said->position[0]);
    assert_int_equal(mesh->face_offsets[0], 0);
    assert_memory_equal(mesh->face_offsets + 1, said->end, said->faces * sizeof said->end[0]);
    assert_memory_equal(mesh->indices, said->index, said->corners * sizeof said->index[0]);
    assert_int_equal(mesh->colors != NULL, said->color_given);
    if (mesh->colors) assert_memory_equal(mesh->colors, said->color, said->positions * sizeof said->color[0]);
    assert_normals(said, mesh);
}

static void all_that_a_file_says_is_read_by_every_team(void **state)
{
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        struct said *said = say((enum where)(round % WHERES), (enum where)((round + round / WHERES) % WHERES), 0);
        if (below(2)) said->text.size--; /* the last line does not end */
        struct reading *reading = read_by_all(ZR_FORMAT_OBJ, &said->text);
        assert_read(reading);
        assert_said(said, &reading->scene->meshes[0]);
        reading_free(reading);
        unsay(said);
    }
}

static void a_file_is_cut_behind_statements(void **state)
{
    (void)state;
    struct said *said = say(ANYWHERE, ANYWHERE, 0);
    struct zr_arena arena;
    size_t count;
    zr_arena_init(&arena, CEILING);
    const struct zr_part *parts = cut_text(&arena, &said->text, PART_BYTES, PART_BYTES + 1024, zr_obj_cut, &count);
    for (size_t i = 0; i + 1 < count; i++)
        assert_int_equal(parts[i].end[-1], '\n');
    zr_arena_free(&arena);
    unsay(said);
}

/* More of them than are told, too. */
static void faults_are_told_in_their_order_with_their_lines(void **state)
{
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        struct said *said = say(ANYWHERE, (enum where)(round % WHERES), round & 1 ? 4 : FAULTS_MAX);
        struct reading *reading = read_by_all(ZR_FORMAT_OBJ, &said->text);
        assert_faults(reading, said->fault, said->faults);
        reading_free(reading);
        unsay(said);
    }
}

static void every_team_has_the_same_complaints(void **state)
{
    (void)state;
    static const char bytes[] = "0123456789.e-+ \n\r\t/vfn#\\";
    struct said *said = say(ANYWHERE, ANYWHERE, 0);
    const size_t accepted = count_spoilt(ZR_FORMAT_OBJ, &said->text, bytes, 3 * ROUNDS, ZR_OK);
    assert_in_range(accepted, 1, 3 * ROUNDS - 1);
    unsay(said);
}

/* Behind bad syntax nothing is read, and so nothing is told of what other threads may have found there. */
static void bad_syntax_ends_reading_for_every_team(void **state)
{
    (void)state;
    struct said *said = say(NOWHERE, NOWHERE, 0);
    const size_t line = said->line;
    add(&said->text, "f 1 2 x\n");
    for (size_t i = 0; i < 30000; i++)
        add(&said->text, "f 1 2 0\n");
    struct reading *reading = read_by_all(ZR_FORMAT_OBJ, &said->text);
    char want[64];
    snprintf(want, sizeof want, "line %zu: expected a corner", line);
    assert_complaint(reading, ZR_BAD_SYNTAX, "", want);
    assert_int_equal(reading->error.count, 1);
    reading_free(reading);
    unsay(said);
}

/* Where nothing can be cut: one line, and lines that are all joined. */
static void statement_of_any_length_is_read(void **state)
{
    (void)state;
    enum { LINES = 100000 };
    for (int joined = 0; joined < 2; joined++) {
        struct text text = {0};
        add(&text, "v 0 0 0\nv 1 0 0\nv 0 1 0\ng");
        for (size_t i = 0; i < LINES; i++)
            add(&text, joined ? " any\\\n" : " any");
        add(&text, "\nf 1 2 3\nf 1 2 4\n");
        struct reading *reading = read_by_all(ZR_FORMAT_OBJ, &text);
        assert_complaint(reading, ZR_BAD_SCENE, "", joined ? "line 100006: index 4 of 3" : "line 6: index 4 of 3");
        reading_free(reading);
        drop(&text);
    }
}

/* zr_scene_read would say so whatever the reader says. */
static void cancelled_reader_says_so(void **state)
{
    (void)state;
    struct said *said = say(ANYWHERE, ANYWHERE, 0);
    struct zr_cancel cancel = {.raised = true};
    const struct zr_request request = {
        .format = ZR_FORMAT_OBJ, .bytes = said->text.bytes, .size = said->text.size, .cancel = &cancel};
    const struct zr_limits limits = zr_limits_default();
    for (int i = 0; i < 2; i++) {
        struct zr_arena arena;
        struct zr_scene scene = {.mesh_count = 0};
        struct zr_error error = {.count = 0};
        zr_arena_init(&arena, CEILING);
        struct zr_scene_builder builder = zr_scene_builder_open(&arena, i ? teams[1] : NULL, &scene);
        assert_int_equal(zr_read_OBJ(&builder, &request, &limits, &error), ZR_CANCELLED);
        assert_true(arena.peak < said->text.size / 4); /* it was cut, and no array made */
        zr_arena_free(&arena);
    }
    unsay(said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_a_file_says_is_read_by_every_team),
        cmocka_unit_test(a_file_is_cut_behind_statements),
        cmocka_unit_test(every_team_has_the_same_complaints),
        cmocka_unit_test(faults_are_told_in_their_order_with_their_lines),
        cmocka_unit_test(bad_syntax_ends_reading_for_every_team),
        cmocka_unit_test(statement_of_any_length_is_read),
        cmocka_unit_test(cancelled_reader_says_so),
    };
    return cmocka_run_group_tests_name("obj_parts", tests, start_teams, end_teams);
}
