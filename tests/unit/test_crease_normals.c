/* Normals of corners: against sums in double over corners that are compared one by one, whatever the instruction set
 * and the number of threads. */
#include "crease_check.h"
#include "guarded.h"
#include "support/isas.h"

enum { FACES_MOST = 6000, CORNERS_MOST = 6 * FACES_MOST, PLACES_MOST = 2000 };

struct subject {
    struct zr_mesh mesh;
    zr_vec4 positions[CORNERS_MOST];
    uint32_t places[CORNERS_MOST]; /* which of the true ones each position is at */
    uint32_t offsets[FACES_MOST + 1], indices[CORNERS_MOST], rings[FACES_MOST + 1], ring_offsets[2 * FACES_MOST + 1];
};

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
    zr_arena_reset(&arena, ARENA_BYTES);
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
        zr_arena_reset(&arena, ARENA_BYTES);
    }
    zr_team_destroy(teams[0]);
    zr_team_destroy(teams[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(normals_are_sums_over_faces_within_the_angle),
        TEST_EACH_ISA(odd_numbers_give_units_or_zeros),
        cmocka_unit_test_setup(size_does_not_matter, empty_arena),
    };
    return cmocka_run_group_tests_name("crease_normals", tests, open_arena, close_arena);
}
