/* Large STL files, which are read in parts by several threads: what is in them is known, and where their faults are. */
#include "by_teams.h"

/* ThreadSanitizer reads thirty times as slowly. */
#ifdef __SANITIZE_THREAD__
enum { ROUNDS = 2 };
#else
enum { ROUNDS = 12 };
#endif

enum { FACETS = 6000, FAULTS_MAX = 4, HEADER_BYTES = 84, TRIANGLE_BYTES = 50 };

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
        if (said->faults < faults && below(FACETS / FAULTS_MAX) == 0)
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
        struct said *said = make(FAULTS_MAX, round & 1);
        struct reading *reading = read_by_all(ZR_FORMAT_STL, &said->text);
        assert_faults(reading, said->fault, said->faults);
        reading_free(reading);
        unsay(said);
    }
}

/* A byte that is another one, anywhere, or an end too early. */
static void every_team_has_the_same_complaints(void **state)
{
    (void)state;
    static const char bytes[] = "0123456789.e-+ \n\tnxvd#\f";
    struct said *said = make(1, true);
    const size_t size = said->text.size;
    size_t refused = 0;
    for (int round = 0; round < 3 * ROUNDS; round++) {
        char *byte = &said->text.bytes[below(size)];
        const char was = *byte;
        *byte = bytes[below(sizeof bytes - 1)];
        said->text.size = below(2) ? size : below(size);
        struct reading *reading = read_by_all(ZR_FORMAT_STL, &said->text);
        refused += reading->status == ZR_BAD_SYNTAX;
        reading_free(reading);
        *byte = was;
    }
    assert_in_range(refused, ROUNDS, 3 * ROUNDS);
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
    static const size_t bad[2] = {TRIANGLES / 3, TRIANGLES - 1};
    const float nowhere = -INFINITY;
    struct text text = make_binary(TRIANGLES, positions);
    for (size_t i = 0; i < 2; i++)
        memcpy(text.bytes + HEADER_BYTES + TRIANGLE_BYTES * bad[i] + SECOND_Y, &nowhere, sizeof nowhere);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    char faults[2][FAULT_SIZE];
    for (size_t i = 0; i < 2; i++)
        snprintf(faults[i], FAULT_SIZE, "triangle %zu of 40000, vertex 2: (", bad[i] + 1);
    assert_faults(reading, faults, 2);
    reading_free(reading);
    drop(&text);
}

static void cancelled_reading_says_so(void **state)
{
    (void)state;
    struct said *said = make(0, false);
    static zr_vec4 positions[3 * 20000];
    struct text binary = make_binary(20000, positions);
    struct zr_cancel cancel;
    atomic_init(&cancel.raised, true);
    const struct zr_request request = {.format = ZR_FORMAT_STL, .cancel = &cancel};
    for (int i = 0; i < 4; i++) {
        const struct text *text = i & 1 ? &said->text : &binary;
        struct reading *reading =
            read_by_team(i & 2 ? teams[1] : NULL, request, text->bytes, text->size, zr_limits_default(), CEILING);
        assert_complaint(reading, ZR_CANCELLED, "", "stopped");
        reading_free(reading);
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
        cmocka_unit_test(text_takes_little_more_memory_than_its_triangles),
        cmocka_unit_test(binary_of_any_size_is_read_by_every_team),
        cmocka_unit_test(places_of_binary_that_are_none_are_told_with_their_triangles),
        cmocka_unit_test(cancelled_reading_says_so),
    };
    return cmocka_run_group_tests_name("stl_parts", tests, start_teams, end_teams);
}
