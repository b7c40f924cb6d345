/* Meshes cut open by planes: volumes of both sides, closed meshes stay closed, corners keep their attributes. */
#include "sections/sectioned.h"

#include <math.h>

#include "base/run.h"
#include "mesh/facts/closed_parts.h"
#include "support/random.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

static struct random random_state = {{RANDOM_STATE_1}};

static struct zr_sectioned cut_mesh(const struct zr_mesh *mesh, const struct zr_section_cut *cut)
{
    struct zr_sectioned out;
    const uint8_t parts[] = {ZR_SLICE_CLOSED};
    assert_int_equal(zr_sectioned_make(&(struct zr_run){.arena = &arena}, mesh, parts, cut, &out), ZR_OK);
    return out;
}

static struct zr_slice_plane plane_of(double x, double y, double z, double offset)
{
    const double length = sqrt(x * x + y * y + z * z);
    return (struct zr_slice_plane){{x / length, y / length, z / length}, offset, 1e-12};
}

static struct zr_slice_plane random_plane(void)
{
    double n[3];
    for (int k = 0; k < 3; k++)
        n[k] = random_range(&random_state, -1, 1);
    return plane_of(n[0], n[1], n[2], random_range(&random_state, -0.8, 0.8));
}

/* Each plane the other way round, and what some of them keep instead of what all keep. */
static struct zr_section_cut opposite(const struct zr_section_cut *cut)
{
    struct zr_section_cut other = *cut;
    other.is_corner = !cut->is_corner;
    for (uint32_t k = 0; k < cut->plane_count; k++) {
        for (int i = 0; i < 3; i++)
            other.planes[k].normal[i] = -cut->planes[k].normal[i];
        other.planes[k].offset = -cut->planes[k].offset;
    }
    return other;
}

static double cap_area(const struct zr_mesh *mesh)
{
    double area = 0.0;
    for (uint32_t face = mesh->face_count - mesh->cap_count; face < mesh->face_count; face++) {
        const struct zr_rings rings = zr_mesh_rings(mesh, face);
        double sum[3] = {0, 0, 0};
        for (uint32_t r = 0; r < rings.count; r++)
            for (uint32_t i = rings.offsets[r]; i < rings.offsets[r + 1]; i++) {
                const uint32_t next = i + 1 < rings.offsets[r + 1] ? i + 1 : rings.offsets[r];
                const zr_vec4 p = mesh->positions[mesh->indices[i]], q = mesh->positions[mesh->indices[next]];
                sum[0] += 0.5 * ((double)p.y * (double)q.z - (double)p.z * (double)q.y);
                sum[1] += 0.5 * ((double)p.z * (double)q.x - (double)p.x * (double)q.z);
                sum[2] += 0.5 * ((double)p.x * (double)q.y - (double)p.y * (double)q.x);
            }
        area += sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    }
    return area;
}

/* `exactly`: no face lies in a plane, so both sides have the same caps. */
static void assert_both_sides(const struct zr_mesh *mesh, const struct zr_section_cut *cut, bool exactly,
                              const char *name)
{
    const struct zr_section_cut other = opposite(cut);
    const struct zr_sectioned kept = cut_mesh(mesh, cut), gone = cut_mesh(mesh, &other);
    /* Caps point outwards, even if the mesh is inside out: only one side of its boundary counts. */
    const double sign = solid_volume(mesh) < 0.0 ? -1.0 : 1.0, whole = sign * solid_volume(mesh);
    const double a = sign * solid_volume(&kept.mesh), b = sign * solid_volume(&gone.mesh);
    if (sign > 0.0 && fabs(a + b - whole) > 4e-6) fail_msg("%s: %.9g + %.9g, not %.9g", name, a, b, whole);
    if (exactly && fabs(cap_area(&kept.mesh) - cap_area(&gone.mesh)) > 2e-5)
        fail_msg("%s: caps of %.9g and %.9g", name, cap_area(&kept.mesh), cap_area(&gone.mesh));
    uint8_t closed = 1;
    assert_true(zr_closed_parts_find(&(struct zr_run){.arena = &arena}, &kept.mesh, &closed, NULL));
    if (!closed && kept.mesh.face_count > 0 && sign > 0.0) fail_msg("%s: the kept side is open", name);
}

TEST_AROUND(both_sides_of_a_section_add_up, open_arena, close_arena)
{
    for (int solid = 0; solid < SOLIDS; solid++)
        for (int round = 0; round < 20; round++) {
            const struct zr_mesh mesh = solid_make(&arena, (enum solid)solid);
            struct zr_section_cut cut = {.plane_count = 1 + (uint32_t)round % 3, .is_corner = round % 2};
            for (uint32_t k = 0; k < cut.plane_count; k++)
                cut.planes[k] = random_plane();
            assert_both_sides(&mesh, &cut, true, solid_names[solid]);
            zr_arena_reset(&arena, 1 << 24);
        }
}

/* Planes through corners, edges and faces. */
TEST_AROUND(planes_in_faces_and_through_corners_leave_closed_meshes, open_arena, close_arena)
{
    static const double planes[][4] = {{1, 0, 0, 1},     {1, 0, 0, -1},          {-1, 0, 0, 1},  {0, 0, 1, 0.25},
                                       {0, 0, 1, -0.25}, {1, 1, 0, 0},           {1, 1, 1, 0},   {0, 0, 1, 0},
                                       {0, 1, 0, 0},     {1, 0, 0, 0},           {0, 0, -1, -1}, {0, 1, 0, -0.25},
                                       {1, -1, 0, 0},    {0, 0, 1, (double)0.3f}};
    for (int solid = 0; solid < SOLIDS; solid++)
        for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
            const struct zr_mesh mesh = solid_make(&arena, (enum solid)solid);
            const double *p = planes[i];
            const struct zr_section_cut cut = {.plane_count = 1, .planes = {plane_of(p[0], p[1], p[2], p[3])}};
            assert_both_sides(&mesh, &cut, false, solid_names[solid]);
            zr_arena_reset(&arena, 1 << 24);
        }
}

TEST_AROUND(a_face_in_the_plane_becomes_a_cap_if_the_solid_lies_behind_it, open_arena, close_arena)
{
    const struct zr_mesh cube = solid_make(&arena, SOLID_CUBE);
    const struct zr_section_cut behind = {.plane_count = 1, .planes = {plane_of(1, 0, 0, 1)}},
                                before = {.plane_count = 1, .planes = {plane_of(1, 0, 0, -1)}};
    const struct zr_sectioned whole = cut_mesh(&cube, &behind), none = cut_mesh(&cube, &before);
    assert_int_equal(whole.mesh.face_count, 6);
    assert_int_equal(whole.mesh.cap_count, 1);
    assert_true(fabs(solid_volume(&whole.mesh) - 8.0) < 1e-9);
    assert_int_equal(none.mesh.face_count, 0);
    assert_int_equal(zr_section_side_of(&before, &cube, NULL), ZR_SECTION_GONE);
}

/* Sides of cubes, by the distance of a plane from their middle. */
TEST_AROUND(meshes_that_no_plane_crosses_stay_whole_or_go, open_arena, close_arena)
{
    static const struct {
        double first, second;
        bool is_corner;
        enum zr_section_side side;
    } cases[] = {{2, 2, false, ZR_SECTION_WHOLE}, {-2, 2, false, ZR_SECTION_GONE}, {0, 2, false, ZR_SECTION_CUT},
                 {2, -2, true, ZR_SECTION_WHOLE}, {-2, -2, true, ZR_SECTION_GONE}, {0, -2, true, ZR_SECTION_CUT}};
    const struct zr_mesh cube = solid_make(&arena, SOLID_CUBE);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_section_cut cut = {
            .plane_count = 2,
            .planes = {plane_of(1, 0, 0, cases[i].first), plane_of(0, 1, 0, cases[i].second)},
            .is_corner = cases[i].is_corner};
        assert_int_equal(zr_section_side_of(&cut, &cube, NULL), cases[i].side);
    }
}

/* ---- attributes ---- */

static zr_vec4 linear(zr_vec4 p)
{
    return (zr_vec4){p.x + 2 * p.y, p.z - p.x, 0.25f * p.y, 1.0f};
}

TEST_AROUND(made_corners_have_the_attributes_of_their_places, open_arena, close_arena)
{
    struct zr_mesh torus = solid_make(&arena, SOLID_TORUS);
    zr_vec4 *values = zr_arena_alloc(&arena, torus.position_count, sizeof *values);
    zr_vec3 *normals = zr_arena_alloc(&arena, torus.position_count, sizeof *normals);
    uint32_t *materials = zr_arena_alloc(&arena, torus.face_count, sizeof *materials);
    for (uint32_t p = 0; p < torus.position_count; p++) {
        values[p] = linear(torus.positions[p]);
        normals[p] = zr_vec3_normalize((zr_vec3){1, torus.positions[p].x, torus.positions[p].z});
    }
    for (uint32_t face = 0; face < torus.face_count; face++)
        materials[face] = face % 7;
    torus.texcoords = torus.colors = values;
    torus.normals = normals;
    torus.normal_count = torus.position_count;
    torus.face_materials = materials;
    const struct zr_section_cut cut = {.plane_count = 2, .planes = {random_plane(), random_plane()}, .is_corner = true};
    const struct zr_sectioned kept = cut_mesh(&torus, &cut);
    const struct zr_mesh *mesh = &kept.mesh;
    const uint32_t walls = mesh->face_count - mesh->cap_count;
    assert_true(mesh->cap_count > 0 && walls > 0);
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (face < walls) assert_int_equal(mesh->face_materials[face], kept.numbers[face] % 7);
        for (uint32_t i = mesh->face_offsets[face]; i < mesh->face_offsets[face + 1]; i++) {
            const zr_vec4 want = linear(mesh->positions[mesh->indices[i]]), got = mesh->texcoords[mesh->indices[i]],
                          color = mesh->colors[mesh->indices[i]];
            const zr_vec3 n = mesh->normals[mesh->normal_indices[i]];
            if (face < walls) {
                assert_true(fabsf(want.x - got.x) < 1e-5f && fabsf(want.y - got.y) < 1e-5f);
                assert_true(fabsf(want.x - color.x) < 1e-5f && fabsf(want.z - color.z) < 1e-5f);
                assert_true(zr_vec3_dot(n, n) > 0.5f);
                continue;
            }
            const struct zr_slice_plane *plane = &cut.planes[kept.caps[kept.cap_numbers[face - walls]].plane];
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)(&n.x)[k] + plane->normal[k]) < 1e-6);
        }
    }
    for (uint32_t face = walls; face < mesh->face_count; face++)
        assert_int_equal(kept.numbers[face], torus.face_count + (face - walls));
}

/* A line of length 4 along x through the origin, cut at x = -1 and x = 1. */
TEST_AROUND(lines_and_points_are_cut_too, open_arena, close_arena)
{
    static const zr_vec4 positions[] = {{-2, 0, 0, 1}, {2, 0, 0, 1}, {0, 0, 0, 1}};
    static const uint32_t lines[] = {0, 1, 1, 2}, points[] = {0, 2, 1}, no_faces[] = {0};
    const struct zr_mesh mesh = {.name = "",
                                 .position_count = 3,
                                 .positions = positions,
                                 .face_offsets = no_faces,
                                 .line_count = 2,
                                 .lines = lines,
                                 .point_count = 3,
                                 .points = points};
    struct zr_section_cut cut = {.plane_count = 2, .planes = {plane_of(1, 0, 0, 1), plane_of(-1, 0, 0, 1)}};
    const struct zr_mesh inner = cut_mesh(&mesh, &cut).mesh;
    assert_int_equal(inner.line_count, 2);
    assert_int_equal(inner.point_count, 1);
    assert_true(inner.positions[inner.lines[0]].x == -1.0f && inner.positions[inner.lines[1]].x == 1.0f);
    const struct zr_section_cut outside = opposite(&cut);
    const struct zr_sectioned outer = cut_mesh(&mesh, &outside);
    assert_int_equal(outer.mesh.line_count, 3);
    assert_int_equal(outer.mesh.point_count, 2);
    static const uint32_t numbers[] = {0, 0, 1, 2, 4};
    assert_memory_equal(outer.numbers, numbers, sizeof numbers);
}

TEST_AROUND(a_cancelled_section_stops, open_arena, close_arena)
{
    struct zr_cancel cancel = {0};
    cancel.raised = true;
    const struct zr_mesh mesh = solid_make(&arena, SOLID_TORUS);
    const struct zr_section_cut cut = {.plane_count = 1, .planes = {random_plane()}};
    const uint8_t parts[] = {ZR_SLICE_CLOSED};
    struct zr_sectioned out;
    assert_int_equal(zr_sectioned_make(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &mesh, parts, &cut, &out),
                     ZR_CANCELLED);
}

RUN_TESTS(NULL, NULL)
