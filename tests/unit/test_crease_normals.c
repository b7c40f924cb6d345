/* Normals of corners: against sums in double over corners that are compared one by one, whatever the instruction set
 * and the number of threads. */
#include "shade/crease_normals.h"

#include <math.h>
#include <string.h>

#include "guarded.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/test_arena.h"

TEST_ARENA((size_t)1 << 28)

enum { FACES_MOST = 6000, CORNERS_MOST = 6 * FACES_MOST, PLACES_MOST = 2000 };

static struct random numbers = {{RANDOM_STATE_1}};

struct subject {
    struct zr_mesh mesh;
    zr_vec4 positions[CORNERS_MOST];
    uint32_t places[CORNERS_MOST]; /* which of the true ones each position is at */
    uint32_t offsets[FACES_MOST + 1], indices[CORNERS_MOST], rings[FACES_MOST + 1], ring_offsets[2 * FACES_MOST + 1];
};

static const zr_vec4 *make(struct zr_team *team, const struct zr_mesh *mesh, float degrees)
{
    const zr_vec4 *normals = zr_crease_normals_make(&arena, team, NULL, mesh, degrees);
    assert_non_null(normals);
    return normals;
}

static void assert_unit_or_zero(zr_vec4 n)
{
    const double square = (double)n.x * (double)n.x + (double)n.y * (double)n.y + (double)n.z * (double)n.z;
    assert_true(n.w == 0.0f && (square == 0.0 || fabs(square - 1.0) < 1e-5));
}

static void assert_near(zr_vec4 n, double x, double y, double z, double error)
{
    if (fabs((double)n.x - x) > error || fabs((double)n.y - y) > error || fabs((double)n.z - z) > error || n.w != 0.0f)
        fail_msg("%g %g %g %g, not %g %g %g", (double)n.x, (double)n.y, (double)n.z, (double)n.w, x, y, z);
}

/* ---- a reference ---- */

struct wide {
    double x, y, z;
};

static struct wide minus(struct wide a, struct wide b)
{
    return (struct wide){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double dot(struct wide a, struct wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct wide cross(struct wide a, struct wide b)
{
    return (struct wide){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length(struct wide a)
{
    return sqrt(dot(a, a));
}

static struct wide place_of(const struct zr_mesh *mesh, uint32_t slot)
{
    const zr_vec4 p = mesh->positions[mesh->indices[slot]];
    const double w = p.w == 0.0f ? 1.0 : (double)p.w;
    return (struct wide){(double)p.x / w, (double)p.y / w, (double)p.z / w};
}

static struct wide units[CORNERS_MOST];
static double weights[CORNERS_MOST], areas[CORNERS_MOST]; /* twice those of faces */

static void weigh_ring(const struct zr_mesh *mesh, uint32_t begin, uint32_t end, struct wide normal)
{
    for (uint32_t slot = begin; slot < end; slot++) {
        const struct wide p = place_of(mesh, slot);
        const struct wide a = minus(place_of(mesh, slot == begin ? end - 1 : slot - 1), p);
        const struct wide b = minus(place_of(mesh, slot == end - 1 ? begin : slot + 1), p);
        const double area = length(normal);
        units[slot] = area > 0.0 ? (struct wide){normal.x / area, normal.y / area, normal.z / area} : normal;
        areas[slot] = area;
        weights[slot] = length(a) * length(b) > 0.0 ? area * atan2(length(cross(a, b)), dot(a, b)) : 0.0;
    }
}

static void weigh_corners(const struct zr_mesh *mesh)
{
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const struct zr_rings rings = zr_mesh_rings(mesh, face);
        struct wide normal = {0, 0, 0};
        for (uint32_t slot = rings.offsets[0]; slot < rings.offsets[1]; slot++) {
            const uint32_t next = slot + 1 == rings.offsets[1] ? rings.offsets[0] : slot + 1;
            const struct wide first = place_of(mesh, rings.offsets[0]);
            const struct wide turn = cross(minus(place_of(mesh, slot), first), minus(place_of(mesh, next), first));
            normal = (struct wide){normal.x + turn.x, normal.y + turn.y, normal.z + turn.z};
        }
        for (uint32_t ring = 0; ring < rings.count; ring++)
            weigh_ring(mesh, rings.offsets[ring], rings.offsets[ring + 1], normal);
    }
}

/* False where floats may see it another way: the face has hardly an area, some other is nearly at the angle, or what is
 * summed up nearly cancels. */
static bool sum_corners(const struct subject *s, uint32_t slot, double cosine, struct wide *sum)
{
    const uint32_t count = s->mesh.face_offsets[s->mesh.face_count];
    bool is_clear = areas[slot] > 1e-2;
    double total = 0.0;
    *sum = (struct wide){0, 0, 0};
    for (uint32_t other = 0; other < count; other++) {
        if (s->places[s->mesh.indices[other]] != s->places[s->mesh.indices[slot]]) continue;
        const double along = dot(units[slot], units[other]), weight = weights[other];
        is_clear = is_clear && (other == slot || fabs(along - cosine) > 1e-4);
        if (other != slot && along < cosine) continue;
        *sum = (struct wide){sum->x + weight * units[other].x, sum->y + weight * units[other].y,
                             sum->z + weight * units[other].z};
        total += weight;
    }
    return is_clear && length(*sum) > 1e-2 * total && total > 1e-2;
}

static void check_sums(const struct subject *s, float degrees, const zr_vec4 *got)
{
    const double cosine = cos((double)degrees * 3.14159265358979323846 / 180.0);
    const uint32_t count = s->mesh.face_offsets[s->mesh.face_count];
    uint32_t checked = 0, looked_at = 0;
    weigh_corners(&s->mesh);
    for (uint32_t slot = 0; slot<count; slot += count> 1000 ? 17 : 1) {
        struct wide sum;
        assert_unit_or_zero(got[slot]);
        looked_at++;
        if (!sum_corners(s, slot, cosine, &sum)) continue;
        const double size = length(sum);
        assert_near(got[slot], sum.x / size, sum.y / size, sum.z / size, 2e-4);
        checked++;
    }
    assert_true(count < 200 || 2 * checked > looked_at);
}

/* ---- meshes of all kinds ---- */

static float any(void)
{
    return (float)random_range(&numbers, -1.0, 1.0);
}

enum kind { TRIANGLES, POLYGONS, HOLES, KINDS };

static void make_faces(struct subject *s, uint32_t faces, enum kind kind)
{
    s->mesh.face_count = faces;
    for (uint32_t f = 0, ring = 0; f < faces; f++) {
        const bool has_hole = kind == HOLES && random_below(&numbers, 3) == 0;
        const uint32_t outer = kind == TRIANGLES || has_hole ? 3 : 3 + random_below(&numbers, 3);
        s->offsets[f + 1] = s->offsets[f] + outer;
        s->ring_offsets[++ring] = s->offsets[f + 1];
        if (has_hole) {
            s->offsets[f + 1] += 3;
            s->ring_offsets[ring] = s->offsets[f + 1] - 3;
            s->ring_offsets[++ring] = s->offsets[f + 1];
        }
        s->rings[f + 1] = ring;
    }
    s->mesh.face_offsets = s->offsets;
    s->mesh.face_rings = kind == HOLES ? s->rings : NULL;
    s->mesh.ring_offsets = kind == HOLES ? s->ring_offsets : NULL;
}

/* One that none of the five before has: nearly the same place twice in a face leaves nothing of its angles. */
static uint32_t other_place(const uint32_t *places, uint32_t i, uint32_t count)
{
    for (;;) {
        const uint32_t place = random_below(&numbers, count);
        uint32_t k = 1;
        while (k <= 5 && k <= i && places[i - k] != place)
            k++;
        if (k > 5 || k > i) return place;
    }
}

/* Places are on a ball; each corner is at one of them, or a little beside. */
static void make_subject(struct subject *s, uint32_t faces, uint32_t places, enum kind kind, bool is_soup)
{
    static zr_vec3 truly[PLACES_MOST];
    for (uint32_t i = 0; i < places; i++)
        truly[i] = zr_vec3_normalize((zr_vec3){any(), any(), any()});
    make_faces(s, faces, kind);
    const uint32_t corners = s->offsets[faces];
    s->mesh.position_count = is_soup ? corners : places;
    for (uint32_t i = 0; i < s->mesh.position_count; i++) {
        const uint32_t place = is_soup ? other_place(s->places, i, places) : i;
        const float off = is_soup ? 4e-7f : 0.0f, w = random_below(&numbers, 9) ? 1.0f : 0.5f + fabsf(any());
        s->places[i] = place;
        s->positions[i] =
            (zr_vec4){truly[place].x + off * any(), truly[place].y + off * any(), truly[place].z + off * any(), 1.0f};
        if (is_soup && random_below(&numbers, 2))
            s->positions[i] = (zr_vec4){truly[place].x, truly[place].y, truly[place].z, 1};
        if (kind == POLYGONS && w != 1.0f)
            s->positions[i] = (zr_vec4){s->positions[i].x * w, s->positions[i].y * w, s->positions[i].z * w, w};
    }
    for (uint32_t slot = 0; slot < corners; slot++)
        s->indices[slot] = is_soup ? slot : random_below(&numbers, places);
    s->mesh.positions = s->positions;
    s->mesh.indices = s->indices;
}

/* Where nobody may read beyond the mesh. */
static void check_everywhere(enum zr_isa isa, const struct subject *s, float degrees)
{
    struct zr_mesh mesh = s->mesh;
    const uint32_t corners = mesh.face_offsets[mesh.face_count];
    struct guarded indices = guarded_copy(mesh.indices, corners * sizeof *mesh.indices);
    struct guarded positions = guarded_copy(mesh.positions, mesh.position_count * sizeof *mesh.positions);
    struct zr_team *alone = zr_team_create_for(1, ZR_ISA_SCALAR);
    const zr_vec4 *want = make(alone, &mesh, degrees);
    check_sums(s, degrees, want);
    mesh.indices = (const uint32_t *)(const void *)indices.bytes;
    mesh.positions = (const zr_vec4 *)(const void *)positions.bytes;
    for (int threads = 1; threads <= 5; threads += 2) {
        struct zr_team *team = zr_team_create_for(threads, isa);
        const zr_vec4 *got = make(team, &mesh, degrees);
        if (corners > 0) assert_memory_equal(got, want, corners * sizeof *got);
        zr_team_destroy(team);
    }
    zr_team_destroy(alone);
    zr_arena_reset(&arena, (size_t)1 << 28);
    guarded_free(&indices);
    guarded_free(&positions);
}

static void normals_are_sums_over_faces_within_the_angle(void **state)
{
    static struct subject subject;
    static const struct {
        uint32_t faces, places;
    } sizes[] = {{0, 8}, {1, 8}, {2, 8}, {7, 8}, {33, 9}, {64, 70}, {300, 64}, {FACES_MOST, PLACES_MOST}};
    static const float angles[] = {0, 35, 90, 120, 180};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (enum kind kind = TRIANGLES; kind < KINDS; kind++)
            for (int is_soup = 0; is_soup < 2; is_soup++) {
                make_subject(&subject, sizes[i].faces, sizes[i].places, kind, is_soup);
                check_everywhere(isa_under_test(state), &subject, angles[(i + kind + (size_t)is_soup) % 5]);
            }
}

/* ---- bodies ---- */

static struct zr_mesh soup_of(const zr_vec4 *positions, uint32_t triangles)
{
    static uint32_t offsets[200001], indices[600000];
    for (uint32_t i = 0; i < 3 * triangles; i++)
        indices[i] = i;
    for (uint32_t i = 0; i <= triangles; i++)
        offsets[i] = 3 * i;
    return (struct zr_mesh){.position_count = 3 * triangles,
                            .positions = positions,
                            .face_count = triangles,
                            .face_offsets = offsets,
                            .indices = indices};
}

/* Corners by the bits of x, y, z: 1 is +1. */
static const int cube_faces[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                     {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
static const float cube_normals[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

static zr_vec4 cube_corner(int bits)
{
    return (zr_vec4){bits & 1 ? 1.0f : -1.0f, bits & 2 ? 1.0f : -1.0f, bits & 4 ? 1.0f : -1.0f, 1.0f};
}

static struct zr_mesh soup_of_cube(zr_vec4 positions[36])
{
    for (int f = 0; f < 6; f++)
        for (int i = 0; i < 6; i++) {
            static const int order[6] = {0, 1, 2, 0, 2, 3};
            positions[6 * f + i] = cube_corner(cube_faces[f][order[i]]);
        }
    return soup_of(positions, 12);
}

static void cubes_are_sharp_up_to_90_degrees(void **state)
{
    (void)state;
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    static const float angles[] = {0, 35, 89.9f, 90, 180};
    const double even = 1.0 / sqrt(3.0);
    for (int a = 0; a < 5; a++) {
        const zr_vec4 *n = make(NULL, &mesh, angles[a]);
        for (int i = 0; i < 36; i++) {
            const float *flat = cube_normals[i / 6];
            const zr_vec4 p = positions[i];
            if (a < 3)
                assert_near(n[i], (double)flat[0], (double)flat[1], (double)flat[2], 1e-7);
            else
                assert_near(n[i], even * (double)p.x, even * (double)p.y, even * (double)p.z, 1e-6);
        }
    }
}

/* Whatever cells lie between them. */
static void positions_that_nearly_agree_are_one_vertex(void **state)
{
    (void)state;
    for (int round = 0; round < 2000; round++) {
        zr_vec4 positions[36];
        const struct zr_mesh mesh = soup_of_cube(positions);
        const float x = any(), y = any(), z = any(); /* diagonal: 2 sqrt 3 */
        for (int i = 0; i < 36; i++) {
            positions[i].x += x + 9e-7f * any();
            positions[i].y += y + 9e-7f * any();
            positions[i].z += z + 9e-7f * any();
        }
        const zr_vec4 *n = make(NULL, &mesh, 180);
        for (int i = 0; i < 36; i++) {
            const double even = 1.0 / sqrt(3.0);
            assert_near(n[i], positions[i].x > x ? even : -even, positions[i].y > y ? even : -even,
                        positions[i].z > z ? even : -even, 1e-4);
        }
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
}

static void positions_farther_apart_are_not(void **state)
{
    (void)state;
    for (int round = 0; round < 200; round++) {
        zr_vec4 positions[36];
        const struct zr_mesh mesh = soup_of_cube(positions);
        const float x = any();
        for (int i = 0; i < 36; i++)
            positions[i].x += x + (i < 6 ? 5e-6f : 0.0f);
        const zr_vec4 *n = make(NULL, &mesh, 180);
        for (int i = 0; i < 6; i++)
            assert_near(n[i], 1.0, 0.0, 0.0, 1e-6);
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
}

/* A face in the plane z = 0 and one in x = 0, with corners of given angles at the origin. */
static void corners_weigh_their_angles_and_areas(void **state)
{
    (void)state;
    for (int a = 1; a < 180; a++)
        for (int b = 1; b < 180; b += 13) {
            const double unit = 3.14159265358979323846 / 180.0, s = 2.0, t = 3.0;
            const zr_vec4 positions[6] = {
                {0, 0, 0, 1}, {(float)s, 0, 0, 1}, {(float)cos(a * unit), (float)sin(a * unit), 0, 1},
                {0, 0, 0, 1}, {0, (float)t, 0, 1}, {0, (float)cos(b * unit), (float)sin(b * unit), 1}};
            const struct zr_mesh mesh = soup_of(positions, 2);
            const zr_vec4 *n = make(NULL, &mesh, 90);
            const double z = s * sin(a * unit) * a, x = t * sin(b * unit) * b, size = sqrt(x * x + z * z);
            assert_near(n[0], x / size, 0.0, z / size, 3e-6);
            assert_near(n[3], x / size, 0.0, z / size, 3e-6);
            assert_near(n[1], 0.0, 0.0, 1.0, 1e-7);
            zr_arena_reset(&arena, (size_t)1 << 28);
        }
}

/* ---- odd numbers ---- */

static void size_does_not_matter(void **state)
{
    (void)state;
    static struct subject subject;
    static zr_vec4 want[3 * 300];
    make_subject(&subject, 300, 64, TRIANGLES, false);
    memcpy(want, make(NULL, &subject.mesh, 35), sizeof want);
    static const float factors[] = {0x1p-100f, 0x1p-20f, 0x1p10f, 0x1p50f, 0x1p120f};
    for (int k = 0; k < 5; k++) {
        static zr_vec4 scaled[PLACES_MOST];
        for (int i = 0; i < 64; i++) {
            const zr_vec4 p = subject.positions[i];
            scaled[i] = (zr_vec4){p.x * factors[k], p.y * factors[k], p.z * factors[k], 1};
        }
        struct zr_mesh mesh = subject.mesh;
        mesh.positions = scaled;
        const zr_vec4 *n = make(NULL, &mesh, 35);
        for (int i = 0; i < 900; i++)
            assert_near(n[i], (double)want[i].x, (double)want[i].y, (double)want[i].z, 1e-6);
    }
}

static void odd_numbers_give_units_or_zeros(void **state)
{
    static struct subject subject;
    static const float odd[] = {0, -0.0f, 1, -1, 1e15f, -1e15f, 1e-30f, -1e-30f, 1e-42f, 3e38f, -3e38f, 2, 0.5f};
    const uint32_t kinds = sizeof odd / sizeof odd[0];
    struct zr_team *teams[2] = {zr_team_create_for(1, ZR_ISA_SCALAR), zr_team_create_for(3, isa_under_test(state))};
    for (int round = 0; round < 3000; round++) {
        const uint32_t first = random_below(&numbers, kinds), range = 1 + random_below(&numbers, kinds - first);
        make_subject(&subject, 1 + random_below(&numbers, 40), 12, (enum kind)(round % KINDS), false);
        for (uint32_t i = 0; i < 12; i++) {
            float v[4];
            for (int k = 0; k < 4; k++)
                v[k] = odd[first + random_below(&numbers, range)];
            subject.positions[i] = (zr_vec4){v[0], v[1], v[2], round & 8 ? v[3] : 1.0f};
        }
        const uint32_t corners = subject.offsets[subject.mesh.face_count];
        const float degrees = (float)random_below(&numbers, 181);
        const zr_vec4 *a = make(teams[0], &subject.mesh, degrees), *b = make(teams[1], &subject.mesh, degrees);
        for (uint32_t i = 0; i < corners; i++)
            assert_unit_or_zero(a[i]);
        assert_memory_equal(a, b, corners * sizeof *a);
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
}

static void faces_without_area_take_what_is_around(void **state)
{
    (void)state;
    const zr_vec4 positions[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1},
                                 {1, 0, 0, 1}, {5, 5, 5, 1}, {5, 5, 5, 1}, {5, 5, 5, 1}};
    const struct zr_mesh mesh = soup_of(positions, 3);
    const zr_vec4 *n = make(NULL, &mesh, 10);
    for (int i = 0; i < 6; i++)
        assert_near(n[i], 0.0, 0.0, 1.0, 1e-7);
    for (int i = 6; i < 9; i++)
        assert_near(n[i], 0.0, 0.0, 0.0, 0.0);
}

/* ---- crowds ---- */

enum { ROUND_MOST = 100000 };

/* A cone of so many faces, its tip at the origin and half as high as wide. */
static struct zr_mesh cone_of(uint32_t faces)
{
    static zr_vec4 positions[3 * ROUND_MOST];
    for (uint32_t i = 0; i < faces; i++) {
        const double a = 6.283185307179586 * i / faces, b = 6.283185307179586 * (i + 1) / faces;
        positions[3 * i] = (zr_vec4){0, 0, 0, 1};
        positions[3 * i + 1] = (zr_vec4){(float)cos(a), (float)sin(a), -0.5f, 1};
        positions[3 * i + 2] = (zr_vec4){(float)cos(b), (float)sin(b), -0.5f, 1};
    }
    return soup_of(positions, faces);
}

/* Sums over groups are those over faces, but for what is in groups that the angle leads through. */
static void tips_of_many_faces_are_smooth_along_the_side(void **state)
{
    static const uint32_t counts[] = {ZR_CREASE_EXACT, ZR_CREASE_EXACT + 1, 1001, ROUND_MOST};
    struct zr_team *teams[2] = {zr_team_create_for(1, ZR_ISA_SCALAR), zr_team_create_for(3, isa_under_test(state))};
    for (int k = 0; k < 4; k++) {
        const struct zr_mesh mesh = cone_of(counts[k]);
        const zr_vec4 *n = make(teams[0], &mesh, 35), *all = make(teams[0], &mesh, 180);
        assert_memory_equal(n, make(teams[1], &mesh, 35), 3 * (size_t)counts[k] * sizeof *n);
        /* Faces with normals (cos, sin, 2) / sqrt 5 whose turn t against this one's has 1/5 cos t + 4/5 >= cos 35. */
        const double most = acos(5.0 * cos(35.0 * 3.14159265358979323846 / 180.0) - 4.0);
        const double side = sin(most) / most, size = sqrt(side * side + 4.0);
        for (uint32_t i = 0; i < counts[k]; i++) {
            const double at = 6.283185307179586 * (i + 0.5) / counts[k];
            assert_near(n[3 * i], cos(at) * side / size, sin(at) * side / size, 2.0 / size, 0.05);
            assert_near(all[3 * i], 0.0, 0.0, 1.0, 1e-3);
        }
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
}

/* ---- ends ---- */

static void room_is_given_back(void **state)
{
    (void)state;
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    make(NULL, &mesh, 35);
    assert_int_equal(arena.used, 36 * sizeof(zr_vec4));
    assert_true(arena.peak > arena.used);
}

static void without_memory_there_are_none(void **state)
{
    (void)state;
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    struct zr_arena small;
    for (size_t bytes = 0; bytes <= 1024; bytes += 512) {
        zr_arena_init(&small, bytes);
        assert_null(zr_crease_normals_make(&small, NULL, NULL, &mesh, 35));
        zr_arena_free(&small);
    }
}

static void what_was_cancelled_ends_early(void **state)
{
    (void)state;
    const struct zr_mesh mesh = cone_of(ROUND_MOST);
    const struct zr_cancel cancel = {.raised = true};
    struct zr_team *team = zr_team_create(3);
    assert_non_null(zr_crease_normals_make(&arena, team, &cancel, &mesh, 35));
    assert_int_equal(arena.used, 3 * ROUND_MOST * sizeof(zr_vec4));
    zr_team_destroy(team);
}

int main(void)
{
#define WITH_ARENA(f) cmocka_unit_test_setup_teardown(f, open_arena, close_arena)
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(normals_are_sums_over_faces_within_the_angle),
        TEST_EACH_ISA(odd_numbers_give_units_or_zeros),
        TEST_EACH_ISA(tips_of_many_faces_are_smooth_along_the_side),
        WITH_ARENA(cubes_are_sharp_up_to_90_degrees),
        WITH_ARENA(positions_that_nearly_agree_are_one_vertex),
        WITH_ARENA(positions_farther_apart_are_not),
        WITH_ARENA(corners_weigh_their_angles_and_areas),
        WITH_ARENA(size_does_not_matter),
        WITH_ARENA(faces_without_area_take_what_is_around),
        WITH_ARENA(room_is_given_back),
        WITH_ARENA(without_memory_there_are_none),
        WITH_ARENA(what_was_cancelled_ends_early),
    };
    return cmocka_run_group_tests_name("crease_normals", tests, open_arena, close_arena);
}
