/* Large STL files, which are read in parts by several threads: what is in them is known, and where their faults are. */
#include <strings.h>

#include "by_teams.h"
#include "input/input.h"
#include "input/stl_text.h"
#include "support/sanitized.h"

/* ThreadSanitizer reads thirty times as slowly. */
#if IS_THREAD_SANITIZED
enum { ROUNDS = 2 };
#else
enum { ROUNDS = 12 };
#endif

enum { FACETS = 6000, FAULTS_MAX = 30, PART_BYTES = 1 << 17, HEADER_BYTES = 84, TRIANGLE_BYTES = 50 };

/* What a text says, written down while it is made. */
struct said {
    struct text text;
    size_t line; /* that is being written */
    size_t facets, faults;
    zr_vec4 position[FACETS * 3];
    char fault[FAULTS_MAX][FAULT_SIZE];
};

static void say(struct said *said, const char *words)
{
    add(&said->text, "%s", words);
    for (; *words; words++)
        said->line += *words == '\n';
}

/* Of its several spellings, mostly the first. */
static const char *one_of(const char *const words[4])
{
    const size_t which = below(30);
    return words[which < 4 ? which : 0];
}

static float say_number(struct said *said)
{
    char digits[32];
    snprintf(digits, sizeof digits, " %.*f", (int)below(9), (double)below(2000001) / 1e6 - 1.0);
    say(said, digits);
    return (float)strtod(digits, NULL);
}

/* `odd`: with a normal that nobody should write. */
static void say_facet(struct said *said, bool odd)
{
    static const char *const begins[] = {"facet normal 0 0 1\n", "  FACET Normal nan nan nan\r\n",
                                         "facet\n\nnormal\n1 2 3 ", "facet normal x vertex facet "},
                             *const loops[] = {"outer loop\n", "    outer\tloop\r\n", "OUTER\nLOOP\n", " outer loop "},
                             *const vertices[] = {"vertex", "      Vertex", "\tVERTEX\n", " vertex "},
                             *const closes[] = {"\nendloop\nendfacet\n", "\r\n  EndLoop\r\n  ENDFACET\r\n",
                                                " endloop endfacet ", " endloop\n\tendfacet \t\n"},
                             *const odds[] = {"facet normal 0 0\nendfacet\n", "facet normal 0\nendfacet\nendfacet\n",
                                              "facet normal\nendfacet\n0\nendfacet ",
                                              "facet normal solid\nendfacet\nx "};
    say(said, one_of(odd ? odds : begins));
    say(said, one_of(loops));
    for (size_t i = 0; i < 3; i++) {
        zr_vec4 *position = &said->position[said->facets * 3 + i];
        say(said, one_of(vertices));
        position->x = say_number(said);
        position->y = say_number(said);
        position->z = say_number(said);
        position->w = 1;
        say(said, i == 2 ? "" : "\n");
    }
    said->facets++;
    say(said, one_of(closes));
}

static void say_solid(struct said *said)
{
    static const char *const names[] = {"solid\n", "solid exported by 3ds Max, xxx vertex vertex vertex\n",
                                        "  SOLID endfacet facet normal 0 0 1\r\n", "solid solid endsolid\n"};
    say(said, one_of(names));
}

static void say_solid_end(struct said *said)
{
    static const char *const ends[] = {"endsolid\n", "\nEndSolid facet x\r\n", "endsolid endfacet\n", "endsolid  \n\n"};
    say(said, one_of(ends));
}

/* Places beyond the limit, behind which reading goes on. */
static void say_fault(struct said *said)
{
    say(said, "facet normal 0 0 0 outer loop\nvertex 1 2 3\nvertex 1 -1e30 2\n");
    snprintf(said->fault[said->faults++], FAULT_SIZE, "line %zu: '-1e30' in triangle %zu", said->line - 1,
             said->facets + 1);
    say(said, "vertex 0 0 0\nendloop\nendfacet\n");
    said->facets++;
}

static struct said *make(size_t faults, bool odd)
{
    struct said *said = calloc(1, sizeof *said);
    assert_non_null(said);
    said->line = 1;
    say_solid(said);
    while (said->facets < FACETS) {
        if (said->facets > FACETS / 2 && said->faults < faults && below(FACETS / FAULTS_MAX / 2) == 0)
            say_fault(said);
        else
            say_facet(said, odd && below(5) == 0);
        if (below(500)) continue;
        say_solid_end(said);
        say_solid(said);
    }
    say_solid_end(said);
    return said;
}

static void unsay(struct said *said)
{
    drop(&said->text);
    free(said);
}

static void assert_triangles(const struct zr_mesh *mesh, const zr_vec4 *positions, size_t triangles)
{
    assert_int_equal(mesh->face_count, triangles);
    assert_int_equal(mesh->position_count, 3 * triangles);
    assert_memory_equal(mesh->positions, positions, 3 * triangles * sizeof *positions);
    for (size_t i = 0; i <= triangles; i++)
        assert_int_equal(mesh->face_offsets[i], 3 * i);
    for (size_t i = 0; i < 3 * triangles; i++)
        assert_int_equal(mesh->indices[i], i);
}

static void all_that_a_file_says_is_read_by_every_team(void **state)
{
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        struct said *said = make(0, round & 1);
        struct reading *reading = read_by_all(ZR_FORMAT_STL, &said->text);
        assert_read(reading);
        assert_triangles(&reading->scene->meshes[0], said->position, said->facets);
        reading_free(reading);
        unsay(said);
    }
}

static void faults_are_told_in_their_order_with_their_lines(void **state)
{
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        struct said *said = make(round & 2 ? FAULTS_MAX : 4, round & 1);
        struct reading *reading = read_by_all(ZR_FORMAT_STL, &said->text);
        assert_faults(reading, said->fault, said->faults);
        reading_free(reading);
        unsay(said);
    }
}

static void every_team_has_the_same_complaints(void **state)
{
    (void)state;
    static const char bytes[] = "0123456789.e-+ \n\tnxvd#\f";
    struct said *said = make(0, true);
    const size_t refused = count_spoilt(ZR_FORMAT_STL, &said->text, bytes, 3 * ROUNDS, ZR_BAD_SYNTAX);
    assert_in_range(refused, ROUNDS, 3 * ROUNDS);
    unsay(said);
}

/* The name makes room for triangles that are not there; then whole parts; then parts that end in a normal. What was
 * read until there is moved together, and what comes behind is read to its place. */
static void gaps_before_a_part_that_is_read_again_are_closed(void **state)
{
    (void)state;
    enum { TRIANGLES = 16000 };
    static zr_vec4 positions[3 * TRIANGLES];
    struct text text = {0};
    add(&text, "solid x xxx xxx xxx xxx xxx\n");
    for (size_t i = 0; i < TRIANGLES; i++) {
        if (i < TRIANGLES / 2)
            add(&text, "facet normal 0 0 1\n");
        else
            add(&text, "facet normal 0 %0400d\nendfacet\n", 0);
        add(&text, "outer loop\nvertex %zu 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n", i);
        positions[3 * i] = (zr_vec4){(float)i, 0, 0, 1};
        positions[3 * i + 1] = (zr_vec4){0, 1, 0, 1};
        positions[3 * i + 2] = (zr_vec4){0, 0, 1, 1};
    }
    add(&text, "endsolid\n");
    struct zr_arena arena;
    size_t count, whole = 0, odd = 0;
    zr_arena_init(&arena, CEILING);
    const struct zr_part *parts =
        zr_parts_cut(&arena, text.bytes, text.bytes + text.size, PART_BYTES, zr_stl_cut, &count);
    for (size_t i = 0; i + 1 < count; i++) {
        whole += odd == 0 && *parts[i].end == 'f';
        odd += *parts[i].end == 'o';
    }
    assert_true(whole > 2 && odd > 0);
    zr_arena_free(&arena);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_read(reading);
    assert_triangles(&reading->scene->meshes[0], positions, TRIANGLES);
    reading_free(reading);
    drop(&text);
}

static void a_text_is_cut_behind_lines_that_end_facets(void **state)
{
    (void)state;
    struct said *said = make(0, false);
    struct zr_arena arena;
    size_t count;
    zr_arena_init(&arena, CEILING);
    const struct zr_part *parts = cut_text(&arena, &said->text, PART_BYTES, PART_BYTES + 2048, zr_stl_cut, &count);
    for (size_t i = 0; i + 1 < count; i++) {
        const char *line = parts[i].end - 1;
        while (line[-1] != '\n')
            line--;
        const size_t blanks = strspn(line, " \t");
        assert_int_equal(strncasecmp(line + blanks, "endfacet", 8), 0);
        assert_int_equal(strspn(line + blanks + 8, " \t\r\n") >= 1, 1);
    }
    zr_arena_free(&arena);
    unsay(said);
}

static void text_takes_little_more_memory_than_its_triangles(void **state)
{
    (void)state;
    struct said *said = make(0, false);
    struct reading *reading = read_by(NULL, ZR_FORMAT_STL, &said->text);
    assert_read(reading);
    const size_t arrays = FACETS * (3 * sizeof(zr_vec4) + 4 * sizeof(uint32_t));
    assert_in_range(reading->arena.peak, arrays, arrays + arrays / 50 + 4096);
    reading_free(reading);
    unsay(said);
}

/* ---- binary ---- */

static void put_words(struct text *text, const void *words, size_t count)
{
    put(text, words, 4 * count);
}

static struct text make_binary(uint32_t triangles, zr_vec4 *positions)
{
    struct text text = {0};
    char header[HEADER_BYTES - 4] = "solid, says the header";
    put(&text, header, sizeof header);
    put_words(&text, &triangles, 1);
    for (size_t i = 0; i < triangles; i++) {
        const float normal[3] = {NAN, 0, 1};
        put_words(&text, normal, 3);
        for (size_t corner = 0; corner < 3; corner++) {
            const float v[3] = {(float)any_place(), (float)any_place(), (float)any_place()};
            positions[3 * i + corner] = (zr_vec4){v[0], v[1], v[2], 1};
            put_words(&text, v, 3);
        }
        put(&text, "ab", 2);
    }
    return text;
}

static void binary_of_any_size_is_read_by_every_team(void **state)
{
    (void)state;
    static const uint32_t counts[] = {1, 8191, 8192, 8193, 40000};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        zr_vec4 *positions = malloc(3 * counts[i] * sizeof *positions);
        assert_non_null(positions);
        struct text text = make_binary(counts[i], positions);
        struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
        assert_read(reading);
        assert_triangles(&reading->scene->meshes[0], positions, counts[i]);
        reading_free(reading);
        drop(&text);
        free(positions);
    }
}

static void places_of_binary_that_are_none_are_told_with_their_triangles(void **state)
{
    (void)state;
    enum { TRIANGLES = 40000, SECOND_Y = 28 };
    static zr_vec4 positions[3 * TRIANGLES];
    const float nowhere = -INFINITY;
    struct text text = make_binary(TRIANGLES, positions);
    char faults[FAULTS_MAX][FAULT_SIZE];
    for (size_t i = 0; i < FAULTS_MAX; i++) {
        const size_t bad = TRIANGLES / 2 + 619 * i;
        memcpy(text.bytes + HEADER_BYTES + TRIANGLE_BYTES * bad + SECOND_Y, &nowhere, sizeof nowhere);
        snprintf(faults[i], FAULT_SIZE, "triangle %zu of 40000, vertex 2: (", bad + 1);
    }
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_faults(reading, faults, FAULTS_MAX);
    reading_free(reading);
    drop(&text);
}

/* zr_scene_read would say so whatever the reader says. */
static void cancelled_reader_says_so(void **state)
{
    (void)state;
    enum { TRIANGLES = 20000 };
    static zr_vec4 positions[3 * TRIANGLES];
    struct said *said = make(0, false);
    struct text binary = make_binary(TRIANGLES, positions);
    struct zr_cancel cancel = {.raised = true};
    const struct zr_limits limits = zr_limits_default();
    for (int i = 0; i < 4; i++) {
        const struct text *text = i & 1 ? &said->text : &binary;
        const struct zr_request request = {
            .format = ZR_FORMAT_STL, .bytes = text->bytes, .size = text->size, .cancel = &cancel};
        struct zr_arena arena;
        struct zr_scene scene = {.mesh_count = 0};
        struct zr_error error = {.count = 0};
        zr_arena_init(&arena, CEILING);
        struct zr_scene_builder builder = zr_scene_builder_open(&arena, i & 2 ? teams[1] : NULL, &scene);
        assert_int_equal(zr_read_STL(&builder, &request, &limits, &error), ZR_CANCELLED);
        zr_arena_free(&arena);
    }
    drop(&binary);
    unsay(said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_a_file_says_is_read_by_every_team),
        cmocka_unit_test(faults_are_told_in_their_order_with_their_lines),
        cmocka_unit_test(every_team_has_the_same_complaints),
        cmocka_unit_test(gaps_before_a_part_that_is_read_again_are_closed),
        cmocka_unit_test(a_text_is_cut_behind_lines_that_end_facets),
        cmocka_unit_test(text_takes_little_more_memory_than_its_triangles),
        cmocka_unit_test(binary_of_any_size_is_read_by_every_team),
        cmocka_unit_test(places_of_binary_that_are_none_are_told_with_their_triangles),
        cmocka_unit_test(cancelled_reader_says_so),
    };
    return cmocka_run_group_tests_name("stl_parts", tests, start_teams, end_teams);
}
