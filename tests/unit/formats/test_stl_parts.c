/* STL in parts of any size, read by several threads. */
#define ZR_STL_PART_BYTES part_bytes
#include "unit/common/part_texts.h"

#include "input/stl/stl_text.c"
#include "support/tests.h"

enum { HEADER_BYTES = 84, TRIANGLE_BYTES = 50 };

#define VERTICES "vertex 0 0 0\nvertex 1 -0.5 0\n  Vertex 0 1e-1 2\n"
#define LOOP     "outer loop\n" VERTICES "endloop\n"
static const char begin[] = "solid exported by 3ds Max, xxx vertex vertex vertex\n";
static const char *const pieces[] = {
    "facet normal 0 0 1\n" LOOP "endfacet\n",
    "  FACET Normal nan nan nan\r\n  OUTER\nLOOP\r\n" VERTICES "EndLoop\r\n ENDFACET\r\n",
    "facet\n\nnormal\n1 2 3 " LOOP "endfacet \t\n",
    "facet normal x vertex facet outer\tloop " VERTICES " endloop endfacet ",
    "facet normal 0 0 1\n" LOOP "endfacet\nfacet normal 0 0 1\n" LOOP "endfacet\n",
    /* with a normal that nobody should write */
    "facet normal 0 0\nendfacet\n" LOOP "endfacet\n", "facet normal 0\nendfacet\nendfacet\n" LOOP "endfacet\n",
    "facet normal\nendfacet\n0\nendfacet " LOOP "endfacet\n", "facet normal solid\nendfacet\nx " LOOP "endfacet\n",
    /* solids */
    "endsolid\nsolid\n", "\nEndSolid facet x\r\n  SOLID endfacet facet normal 0 0 1\r\n",
    "endsolid endfacet\nsolid solid endsolid\n", "\n", " \t\n",
    /* a place beyond the limit, behind which reading goes on */
    "facet normal 0 0 0 outer loop\nvertex 1 2 3\nvertex 1 -1e30 2\nvertex 0 0 0\nendloop\nendfacet\n"};
enum { PIECES = sizeof pieces / sizeof *pieces };

/* Invalid STL that many programs draw. */
static const char *const odd_pieces[] = {
    "facet normal 0 0 1\n" LOOP "endfacet\n",
    "  FACET Normal nan nan nan\r\n  OUTER\nLOOP\r\n" VERTICES "EndLoop\r\n ENDFACET\r\n",
    "facet normal 0 0 1 2\nouter loop x\nvertex 0 0 0 red\n" VERTICES "endloop 1\nendfacet 2\n",
    "facet normal 0 0 1\nouter loop\n" VERTICES VERTICES "endloop\nendfacet\n",
    "facet\n" LOOP "endfacet\n",
    "facet normal\n" LOOP "endfacet\n",
    "# endfacet\n",
    "endsolid\n",
    "solid\n",
    "// a\n\n",
    "color 1 0 0\n",
    "units mm\nendsolid 1\n",
    "facet normal 0 0 1\nouter loop\n" VERTICES "end loop\nend facet\n",
    "facet normal endfacet\nendfacet\nendfacet\n" LOOP "endfacet\n",
    "end solid x\nsolid endfacet\n",
    "\n"};
enum { ODD_PIECES = sizeof odd_pieces / sizeof *odd_pieces };

TEST(any_text_is_the_same_in_parts)
{
    check_texts(ZR_FORMAT_STL, begin, pieces, PIECES - 1, "endsolid\n");
}

TEST(odd_text_is_the_same_in_parts)
{
    check_texts(ZR_FORMAT_STL, begin, odd_pieces, ODD_PIECES, "");
}

TEST(faults_are_the_same_in_their_order_with_their_lines)
{
    size_t good = 0;
    for (int i = 0; i < TEXTS / 4; i++) {
        struct text text = {0};
        put(&text, begin, sizeof begin - 1);
        for (size_t k = 0; k < PIECES_MOST; k++) {
            const char *piece = pieces[below(5) ? below(PIECES) : PIECES - 1];
            put(&text, piece, strlen(piece));
        }
        put(&text, "endsolid\n", 9);
        check_text(ZR_FORMAT_STL, &text, &good);
        drop(&text);
    }
    assert_true(good < TEXTS / 8);
}

TEST(text_takes_little_more_memory_than_its_triangles)
{
    enum { FACETS = 6000 };
    struct text text = {0};
    put(&text, begin, sizeof begin - 1);
    for (int i = 0; i < FACETS; i++)
        put(&text, pieces[0], strlen(pieces[0]));
    put(&text, "endsolid\n", 9);
    part_bytes = 1 << 17;
    struct reading *reading = read_by(NULL, ZR_FORMAT_STL, &text);
    assert_read(reading);
    const size_t arrays = FACETS * (3 * sizeof(zr_vec4) + 4 * sizeof(uint32_t));
    assert_in_range(reading->arena.peak, arrays, arrays + arrays / 50 + 4096);
    check_cancelled(ZR_FORMAT_STL, &text);
    reading_free(reading);
    drop(&text);
}

/* ---- binary ---- */

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

TEST(binary_of_any_size_is_read_by_every_team)
{
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

TEST(triangles_of_binary_that_are_not_finite_are_left_out)
{
    enum { TRIANGLES = 40000, HOLES = 30, SECOND_Y = 28 };
    static zr_vec4 positions[3 * TRIANGLES];
    const float nowhere = -INFINITY;
    struct text text = make_binary(TRIANGLES, positions);
    for (size_t i = HOLES; i-- > 0;) {
        const size_t bad = TRIANGLES / 2 + 619 * i;
        memcpy(text.bytes + HEADER_BYTES + TRIANGLE_BYTES * bad + SECOND_Y, &nowhere, sizeof nowhere);
        memmove(positions + 3 * bad, positions + 3 * (bad + 1), 3 * (TRIANGLES - 1 - bad) * sizeof *positions);
    }
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_read(reading);
    assert_triangles(&reading->scene->meshes[0], positions, TRIANGLES - HOLES);
    reading_free(reading);
    drop(&text);
}

TEST(cancelled_reader_of_binary_says_so)
{
    enum { TRIANGLES = 20000 };
    static zr_vec4 positions[3 * TRIANGLES];
    struct text binary = make_binary(TRIANGLES, positions);
    check_cancelled(ZR_FORMAT_STL, &binary);
    drop(&binary);
}

RUN_TESTS(start_teams, end_teams)
