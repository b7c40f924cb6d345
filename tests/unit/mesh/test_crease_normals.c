/* Normals of corners: of any size, and of numbers that are none. */
#include "support/isas.h"
#include "unit/common/crease_check.h"
#include "unit/common/guarded.h"

enum { FACES_MOST = 6000, CORNERS_MOST = 6 * FACES_MOST, PLACES_MOST = 2000 };

struct subject {
    struct zr_mesh mesh;
    zr_vec4 positions[CORNERS_MOST];
    uint32_t places[CORNERS_MOST]; /* which of the true ones each position is at */
    uint32_t offsets[FACES_MOST + 1], indices[CORNERS_MOST], rings[FACES_MOST + 1], ring_offsets[2 * FACES_MOST + 1];
};

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

/* ---- odd numbers ---- */

TEST_AROUND(size_does_not_matter, empty_arena, NULL)
{
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

TEST_EACH_ISA(odd_numbers_give_units_or_zeros)
{
    static struct subject subject;
    static const float odd[] = {0, -0.0f, 1, -1, 1e15f, -1e15f, 1e-30f, -1e-30f, 1e-42f, 3e38f, -3e38f, 2, 0.5f};
    const uint32_t kinds = sizeof odd / sizeof odd[0];
    const enum zr_isa isa = isa_under_test(state); /* or the test is skipped */
    struct zr_team *teams[2] = {zr_team_create_for(1, ZR_ISA_SCALAR), zr_team_create_for(3, isa)};
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

RUN_TESTS(open_arena, close_arena)
