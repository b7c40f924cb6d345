/* Normals of corners of fine meshes: without teeth where a scan has noise, and sharp where a machined part is. */
#include "mesh/crease_chains.h"
#include "mesh/face_normals.h"
#include "mesh/noise_edges.h"
#include "support/isas.h"
#include "support/tests.h"
#include "unit/common/crease_check.h"

enum { SIDE = 120, FACES = 2 * SIDE * SIDE };

/* A grid of SIDE x SIDE squares over the unit square. */
struct field {
    zr_vec4 positions[(SIDE + 1) * (SIDE + 1)];
    uint32_t offsets[FACES + 1], indices[6 * SIDE * SIDE];
    struct zr_mesh mesh;
};

static uint32_t place_at(uint32_t x, uint32_t y)
{
    return y * (SIDE + 1) + x;
}

/* Cuts each square into two triangles, or leaves it. */
static void make_field(struct field *f, bool is_cut, double (*height)(double x, double y))
{
    const uint32_t corners = is_cut ? 3 : 4, faces = is_cut ? FACES : FACES / 2;
    uint32_t *index = f->indices;
    for (uint32_t y = 0; y <= SIDE; y++)
        for (uint32_t x = 0; x <= SIDE; x++) {
            const double u = (double)x / SIDE, v = (double)y / SIDE;
            f->positions[place_at(x, y)] = (zr_vec4){(float)u, (float)v, (float)height(u, v), 1};
        }
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const uint32_t ring[4] = {place_at(x, y), place_at(x + 1, y), place_at(x + 1, y + 1), place_at(x, y + 1)};
            static const int triangles[6] = {0, 1, 2, 0, 2, 3};
            for (int i = 0; i < (is_cut ? 6 : 4); i++)
                *index++ = ring[is_cut ? triangles[i] : i];
        }
    for (uint32_t i = 0; i <= faces; i++)
        f->offsets[i] = corners * i;
    f->mesh = (struct zr_mesh){.position_count = (SIDE + 1) * (SIDE + 1),
                               .positions = f->positions,
                               .face_count = faces,
                               .face_offsets = f->offsets,
                               .indices = f->indices};
}

/* Returns the largest angle, in degrees, between normals of two corners at one vertex. */
static double widest(const struct field *f, const zr_vec4 *normals)
{
    static zr_vec4 first[(SIDE + 1) * (SIDE + 1)][8];
    static uint32_t counts[(SIDE + 1) * (SIDE + 1)];
    double least = 1.0;
    memset(counts, 0, sizeof counts);
    for (uint32_t slot = 0; slot < f->offsets[f->mesh.face_count]; slot++) {
        const uint32_t place = f->indices[slot];
        for (uint32_t i = 0; i < counts[place]; i++) {
            const zr_vec4 a = first[place][i], b = normals[slot];
            const double cosine = (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
            if (cosine < least) least = cosine;
        }
        first[place][counts[place]++] = normals[slot];
    }
    return acos(least) * 57.29577951308232;
}

/* ---- scans ---- */

/* Noise as of a scanner: some edges bend by 35 to 50 degrees. */
static double noise(double x, double y)
{
    (void)x;
    (void)y;
    return random_range(&numbers, -0.0016, 0.0016);
}

TEST_AROUND(noise_makes_no_teeth, empty_arena, NULL)
{
    static struct field field;
    for (int is_cut = 0; is_cut < 2; is_cut++) {
        make_field(&field, is_cut, noise);
        assert_true(widest(&field, make(NULL, &field.mesh, 35)) < 15);
    }
}

TEST_AROUND(other_angles_are_exact, empty_arena, NULL)
{
    static struct field field;
    make_field(&field, true, noise);
    assert_true(widest(&field, make(NULL, &field.mesh, 19)) > 19);
    assert_true(widest(&field, make(NULL, &field.mesh, 0)) > 35);
}

TEST_EACH_ISA(threads_and_lanes_give_the_same_scan)
{
    static struct field field;
    const enum zr_isa isa = isa_under_test(state); /* or the test is skipped */
    struct zr_team *teams[2] = {zr_team_create_for(1, ZR_ISA_SCALAR), zr_team_create_for(3, isa)};
    make_field(&field, true, noise);
    const zr_vec4 *a = make(teams[0], &field.mesh, 35), *b = make(teams[1], &field.mesh, 35);
    assert_memory_equal(a, b, 3 * FACES * sizeof *a);
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
    zr_arena_reset(&arena, ARENA_BYTES);
}

TEST_AROUND(cancelled_scans_end_early, empty_arena, NULL)
{
    static struct field field;
    const struct zr_cancel cancel = {.raised = true};
    make_field(&field, true, noise);
    assert_non_null(zr_crease_normals_make(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &field.mesh, 35));
}

TEST_AROUND(a_scan_without_memory_has_none, empty_arena, NULL)
{
    static struct field field;
    struct zr_arena small;
    const size_t corners = 3 * FACES * sizeof(zr_vec4);
    make_field(&field, true, noise);
    for (size_t bytes = corners; bytes < 2 * corners; bytes += corners / 16) {
        zr_arena_init(&small, bytes);
        const bool is_made = zr_crease_normals_make(&(struct zr_run){.arena = &small}, &field.mesh, 35) != NULL;
        assert_true(is_made == zr_arena_ok(&small));
        zr_arena_free(&small);
    }
}

/* ---- machined parts ---- */

static const double cell = 1.0 / SIDE;

/* A step whose face rises by 45 degrees. */
static double chamfer(double x, double y)
{
    (void)y;
    return fmin(fmax(x - 0.5, 0.0), cell);
}

/* A row of teeth, steep on all sides. */
static double knurl(double x, double y)
{
    (void)y;
    return (int)(x * SIDE + 0.5) % 2 * cell;
}

/* A boss with a chamfer, small enough to be noise by its lengths. */
static double boss(double x, double y)
{
    return fmin(fmax(3.0 * cell - fmax(fabs(x - 0.5), fabs(y - 0.5)), 0.0), cell);
}

/* Each corner has the normal of its face. */
static void assert_sharp(const struct field *f)
{
    const zr_vec4 *normals = make(NULL, &f->mesh, 35);
    for (uint32_t face = 0; face < f->mesh.face_count; face++) {
        const zr_vec3 own = zr_vec3_normalize(zr_normal_of_face(&f->mesh, face));
        for (uint32_t slot = f->offsets[face]; slot < f->offsets[face + 1]; slot++)
            assert_near(normals[slot], (double)own.x, (double)own.y, (double)own.z, 1e-5);
    }
}

TEST_AROUND(machined_parts_stay_sharp, empty_arena, NULL)
{
    static struct field field;
    double (*const heights[])(double, double) = {chamfer, knurl, boss};
    for (int i = 0; i < 3; i++)
        for (int is_cut = i == 2; is_cut < 2; is_cut++) {
            make_field(&field, is_cut, heights[i]);
            assert_sharp(&field);
        }
}

/* ---- chains ---- */

/* Returns the number of creases among the first `count` edges of a ring of 11 that is small beside the mesh. */
static uint32_t creases_of_arc(uint32_t count, float diagonal)
{
    enum { ALL = 11 };
    zr_vec4 positions[ALL];
    struct zr_steep_edge edges[ALL];
    struct zr_steep_edges steep = {.of = edges, .count = count, .vertex_count = ALL};
    uint32_t creases = 0;
    for (uint32_t i = 0; i < ALL; i++) {
        const double angle = 6.283185307179586 * i / ALL;
        const uint32_t next = (i + 1) % ALL;
        positions[i] = (zr_vec4){(float)cos(angle), (float)sin(angle), 0, 1};
        edges[i] = (struct zr_steep_edge){
            .ends = {i, next}, .positions = {i, next}, .length = 0.5634651f, .has_gentle_face = true};
    }
    assert_true(zr_crease_chains_find(&arena, NULL, positions, diagonal, &steep));
    for (uint32_t i = 0; i < count; i++)
        creases += edges[i].is_crease;
    return creases;
}

TEST_AROUND(short_chains_are_noise_and_rings_are_creases, empty_arena, NULL)
{
    assert_int_equal(creases_of_arc(10, 1000), 0);
    assert_int_equal(creases_of_arc(10, 100), 10); /* longer than D / 20 */
    assert_int_equal(creases_of_arc(10, 40), 10);  /* edges longer than D / 80 */
    assert_int_equal(creases_of_arc(11, 1000), 11);
}

/* ---- edges of drawings ---- */

/* Returns the number of noisy edges. */
static uint32_t count_noise(const struct field *f, float degrees)
{
    const struct zr_run run = {.arena = &arena};
    struct zr_edge_mesh table;
    uint32_t count = 0;
    assert_int_equal(zr_edge_mesh_make(&run, &f->mesh, &table), ZR_OK);
    const uint8_t *noise = zr_noise_edges_find(&run, &f->mesh, &table, degrees);
    for (uint32_t e = 0; noise && e < table.edge_count; e++)
        count += noise[e];
    return count;
}

TEST_AROUND(edges_of_scans_are_noise, empty_arena, NULL)
{
    static struct field field;
    for (int is_cut = 0; is_cut < 2; is_cut++) {
        make_field(&field, is_cut, noise);
        assert_true(count_noise(&field, 30) > 100);
        assert_int_equal(count_noise(&field, 19), 0);
    }
}

TEST_AROUND(edges_of_machined_parts_are_none, empty_arena, NULL)
{
    static struct field field;
    double (*const heights[])(double, double) = {chamfer, knurl, boss};
    for (int i = 0; i < 3; i++) {
        make_field(&field, true, heights[i]);
        assert_int_equal(count_noise(&field, 30), 0);
    }
}

RUN_TESTS(open_arena, close_arena)
