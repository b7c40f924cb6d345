/* Binary STL whose vertices are in common: one position each, if the outputs are the same as with three per triangle.
 */
#include "unit/common/by_teams.h"

#include "input/stl/stl_weld.h"
#include "support/tests.h"

enum { HEADER_BYTES = 84, TRIANGLE_BYTES = 50, SIDE = 60, PLACES = (SIDE + 1) * (SIDE + 1), FACES = 2 * SIDE * SIDE };

/* A hilly square. */
static zr_vec4 soup[3 * FACES];

static zr_vec4 place_at(uint32_t x, uint32_t y)
{
    const float u = (float)x / SIDE - 0.5f, v = (float)y / SIDE - 0.5f;
    return (zr_vec4){u, v, 0.1f * sinf(9 * u) * cosf(7 * v), 1};
}

static void make_soup(void)
{
    static const uint32_t corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (uint32_t square = 0; square < SIDE * SIDE; square++)
        for (uint32_t k = 0; k < 6; k++)
            soup[6 * square + k] = place_at(square % SIDE + corners[k][0], square / SIDE + corners[k][1]);
}

static void put_bytes(struct text *text, const void *bytes, size_t size)
{
    put(text, bytes, size);
}

static struct text text_of_soup(uint32_t triangles)
{
    struct text text = {0};
    put(&text, (char[HEADER_BYTES - 4]){0}, HEADER_BYTES - 4);
    put_bytes(&text, &triangles, sizeof triangles);
    for (uint32_t t = 0; t < triangles; t++) {
        put_bytes(&text, (float[3]){0}, 12);
        for (uint32_t k = 0; k < 3; k++)
            put_bytes(&text, &soup[3 * t + k], 12);
        put(&text, "\0", 2);
    }
    return text;
}

static struct reading *read_so(struct zr_request request, const struct text *text)
{
    request.format = ZR_FORMAT_STL;
    struct reading *reading = read_request(request, text->bytes, text->size, zr_limits_default(), CEILING);
    assert_read(reading);
    return reading;
}

static void assert_is_soup(const struct zr_mesh *mesh)
{
    assert_int_equal(mesh->face_count, FACES);
    for (uint32_t i = 0; i < 3 * FACES; i++)
        assert_memory_equal(&mesh->positions[mesh->indices[i]], &soup[i], sizeof *soup);
}

/* ---- files with shared positions ---- */

TEST(equal_vertices_are_one_position)
{
    make_soup();
    struct text text = text_of_soup(FACES);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->position_count, PLACES);
    assert_is_soup(mesh);
    uint32_t seen = 0;
    for (uint32_t i = 0; i < 3 * FACES; i++) { /* numbered in the order of the file */
        assert_true(mesh->indices[i] <= seen);
        seen += mesh->indices[i] == seen;
    }
    reading_free(reading);
    drop(&text);
}

TEST(zeros_of_different_signs_stay_apart)
{
    make_soup();
    soup[0].x = soup[3].x = 0.0f;
    soup[9].x = -0.0f;
    soup[9].y = soup[0].y;
    soup[9].z = soup[0].z;
    struct text text = text_of_soup(FACES);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_is_soup(&reading->scene->meshes[0]);
    assert_int_not_equal(reading->scene->meshes[0].indices[0], reading->scene->meshes[0].indices[9]);
    reading_free(reading);
    drop(&text);
}

TEST(far_vertices_are_moved_as_before)
{
    make_soup();
    for (uint32_t i = 0; i < 3 * FACES; i++)
        soup[i].x = soup[i].x * 64.0f + 1048576.0f;
    struct text text = text_of_soup(FACES);
    struct reading *shared = read_by_all(ZR_FORMAT_STL, &text);
    struct reading *apart = read_so((struct zr_request){.look = "textbook"}, &text);
    const struct zr_mesh *a = &shared->scene->meshes[0], *b = &apart->scene->meshes[0];
    assert_non_null(apart->scene->origin);
    assert_memory_equal(shared->scene->origin, apart->scene->origin, 3 * sizeof(double));
    assert_true(a->position_count < b->position_count);
    for (uint32_t i = 0; i < 3 * FACES; i++)
        assert_memory_equal(&a->positions[a->indices[i]], &b->positions[i], sizeof *soup);
    reading_free(shared);
    reading_free(apart);
    drop(&text);
}

/* ---- files without ---- */

TEST(outputs_that_depend_on_common_positions_have_three_per_triangle)
{
    static const struct zr_request requests[] = {
        {.look = "textbook"}, {.channel = "normals"}, {.channel = "color,info"}, {.section = "x:0.5"},
        {.colors = "x"},      {.colors = "parts"},    {.creaseDegrees = "180"}};
    make_soup();
    struct text text = text_of_soup(FACES);
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        struct zr_request request = requests[i];
        struct reading *reading = read_so(request, &text);
        assert_int_equal(reading->scene->meshes[0].position_count, 3 * FACES);
        reading_free(reading);
    }
    drop(&text);
}

TEST(few_triangles_and_different_vertices_have_three_per_triangle)
{
    make_soup();
    struct text few = text_of_soup(4000);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &few);
    assert_int_equal(reading->scene->meshes[0].position_count, 3 * 4000);
    reading_free(reading);
    drop(&few);
    for (uint32_t i = 0; i < 3 * FACES; i++)
        soup[i].x += (float)(i / 6);
    struct text different = text_of_soup(FACES);
    reading = read_by_all(ZR_FORMAT_STL, &different);
    assert_int_equal(reading->scene->meshes[0].position_count, 3 * FACES);
    assert_is_soup(&reading->scene->meshes[0]);
    reading_free(reading);
    drop(&different);
}

/* Places whose hashes are all small: a table would be searched place by place. */
TEST(hashes_that_were_made_to_collide_are_given_up)
{
    enum { ALIKE = 3000, SHARE = 64 };
    static zr_vec4 alike[ALIKE];
    uint32_t found = 0;
    for (uint32_t i = 0; found < ALIKE; i++) {
        const zr_vec4 place = {(float)i, 1, 2, 1};
        uint32_t words[3];
        memcpy(words, &place, sizeof words);
        if (zr_stl_hash(words) < UINT32_MAX / SHARE) alike[found++] = place;
    }
    for (uint32_t i = 0; i < 3 * FACES; i++)
        soup[i] = alike[i * 7 % ALIKE];
    struct text text = text_of_soup(FACES);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].position_count, 3 * FACES);
    assert_is_soup(&reading->scene->meshes[0]);
    reading_free(reading);
    drop(&text);
}

TEST(files_with_faults_are_read_as_before)
{
    make_soup();
    soup[3 * 5000 + 1].y = INFINITY;
    struct text text = text_of_soup(FACES);
    struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].position_count, 3 * (FACES - 1));
    reading_free(reading);
    drop(&text);
    soup[3 * 5000 + 1].y = 1e30f;
    text = text_of_soup(FACES);
    reading = read_by_all(ZR_FORMAT_STL, &text);
    assert_complaint(reading, ZR_BAD_SCENE, "", "triangle 5001 of 7200, vertex 2: ");
    reading_free(reading);
    drop(&text);
}

/* ---- pictures ---- */

/* Draws a scene into an arena of its own. */
static struct zr_answer draw(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_error error = {0};
    const struct zr_frame *frame;
    struct zr_answer answer;
    zr_arena_init(arena, CEILING);
    const struct zr_run run = {.arena = arena, .scratch = arena, .team = teams[0], .error = &error};
    assert_int_equal(zr_render(&run, scene, NULL, &frame), ZR_OK);
    assert_int_equal(zr_encode(&run, scene, frame, &answer), ZR_OK);
    return answer;
}

static void assert_same_as_soup(const struct zr_scene *scene)
{
    static uint32_t indices[3 * FACES];
    struct zr_arena arenas[2];
    struct zr_mesh mesh = scene->meshes[0];
    struct zr_scene apart = *scene;
    for (uint32_t i = 0; i < 3 * FACES; i++)
        indices[i] = i;
    assert_int_equal(mesh.position_count, PLACES);
    mesh.position_count = 3 * FACES;
    mesh.positions = soup;
    mesh.indices = indices;
    apart.meshes = &mesh;
    const struct zr_answer a = draw(&arenas[0], scene), b = draw(&arenas[1], &apart);
    assert_int_equal(a.size, b.size);
    assert_memory_equal(a.bytes, b.bytes, a.size);
    for (int i = 0; i < 2; i++)
        zr_arena_free(&arenas[i]);
}

TEST(pictures_are_those_of_three_positions_per_triangle)
{
    static const char *const looks[] = {"studio", "technical", "clay", "blueprint", "xray", "metal"};
    static const struct zr_request views[] = {
        {.shading = "gouraud"}, {.projection = "perspective", .eye = "0.1,0.2,0.15", .target = "0.4,0.3,0"}};
    make_soup();
    struct text text = text_of_soup(FACES);
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
        for (size_t k = 0; k < 2; k++) {
            struct zr_request request = views[k];
            request.look = looks[i];
            request.width = request.height = "120";
            struct reading *reading = read_so(request, &text);
            assert_same_as_soup(reading->scene);
            reading_free(reading);
        }
    drop(&text);
}

RUN_TESTS(start_teams, end_teams)
