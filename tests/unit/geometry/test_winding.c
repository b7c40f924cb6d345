/* Caps of sections: the non-zero rule over rings that overlap, and caps that overlap in one plane, compared with
 * winding numbers in integers. */
#include "base/arena.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 27)

enum { SIDE = 48, CORNERS_MAX = 40, RINGS_MAX = 6 };

static struct random random_state = {{RANDOM_STATE_1}};

/* A cap in clip space; its corners on the subpixel grid, from the centre of the first pixel to that of the last. */
struct cap {
    struct test_scene test;
    zr_vec4 positions[CORNERS_MAX];
    int32_t x[CORNERS_MAX], y[CORNERS_MAX];
    uint32_t offsets[2], rings[2], ring_offsets[RINGS_MAX + 1], indices[CORNERS_MAX];
};

/* Snapped coordinates to clip space: -1 is half a pixel left of the centre of pixel 0. Exact in float. */
static float clip_of(int32_t snapped)
{
    return (float)(2 * snapped + 256 - SIDE * 256) / (float)(SIDE * 256);
}

static void make_cap(struct cap *cap, uint32_t ring_count, uint32_t step)
{
    uint32_t at = 0;
    scene_of_triangles(&cap->test, SIDE, SIDE, cap->positions, 1);
    for (uint32_t r = 0; r < ring_count; r++) {
        const uint32_t count = 3 + random_below(&random_state, 4);
        for (uint32_t i = 0; i < count; i++, at++) {
            cap->x[at] = (int32_t)(step * random_below(&random_state, (SIDE - 1) * 256 / step + 1));
            cap->y[at] = (int32_t)(step * random_below(&random_state, (SIDE - 1) * 256 / step + 1));
            cap->positions[at] = (zr_vec4){clip_of(cap->x[at]), clip_of(cap->y[at]), 0.0f, 1.0f};
            cap->indices[at] = at;
        }
        cap->ring_offsets[r + 1] = at;
    }
    cap->offsets[1] = at;
    cap->rings[1] = ring_count;
    cap->test.mesh = (struct zr_mesh){.name = "cap",
                                      .position_count = at,
                                      .positions = cap->positions,
                                      .face_count = 1,
                                      .face_offsets = cap->offsets,
                                      .indices = cap->indices,
                                      .face_rings = cap->rings,
                                      .ring_offsets = cap->ring_offsets,
                                      .cap_count = 1};
}

/* Winding number of some rings at the centre of a pixel: upward edges at or left of it, less downward ones. */
static int winding_at(const struct cap *cap, uint32_t first, uint32_t end, int64_t x, int64_t y)
{
    int number = 0;
    for (uint32_t r = first; r < end; r++)
        for (uint32_t i = cap->ring_offsets[r]; i < cap->ring_offsets[r + 1]; i++) {
            const uint32_t n = i + 1 < cap->ring_offsets[r + 1] ? i + 1 : cap->ring_offsets[r];
            const bool up = cap->y[i] < cap->y[n];
            const uint32_t low = up ? i : n, high = up ? n : i;
            if (y < cap->y[low] || y >= cap->y[high]) continue;
            const int64_t rise = cap->y[high] - cap->y[low], run = cap->x[high] - cap->x[low];
            if (cap->x[low] * rise + run * (y - cap->y[low]) <= x * rise) number += up ? 1 : -1;
        }
    return number;
}

/* Corners on the grid of pixels, too, where edges and corners meet samples and one another. */
TEST_AROUND(caps_cover_the_samples_with_winding_numbers_other_than_zero, open_arena, close_arena)
{
    static struct cap cap;
    static const uint32_t steps[] = {1, 16, 128, 256, 1024};
    uint64_t twice = 0;
    for (int round = 0; round < 60; round++) {
        const uint32_t rings = 1 + random_below(&random_state, RINGS_MAX);
        make_cap(&cap, rings, steps[round % 5]);
        for (int algorithm = 0; algorithm < ZR_ALGORITHM_COUNT; algorithm++) {
            cap.test.scene.algorithm = (enum zr_algorithm)algorithm;
            const struct zr_frame *frame = scene_render(&arena, NULL, &cap.test.scene);
            for (int32_t y = 0; y < SIDE; y++)
                for (int32_t x = 0; x < SIDE; x++) {
                    const int number = winding_at(&cap, 0, rings, x * 256, y * 256);
                    const uint32_t id = frame->face_id[(SIDE - 1 - y) * SIDE + x];
                    twice += number != 0 && number % 2 == 0;
                    if ((id != 0) != (number != 0))
                        fail_msg("round %d, algorithm %d, %d %d: winding %d, id %u", round, algorithm, x, y, number,
                                 id);
                }
            zr_arena_reset(&arena, 1 << 22);
        }
    }
    assert_true(twice > 5000);
}

/* Splits the rings of the cap into two caps of one plane, and places the mesh twice, once as its mirror image. */
static void make_caps(struct cap *cap, uint32_t rings, uint32_t first_rings, struct zr_instance instances[2])
{
    static const uint32_t planes[2] = {3, 3};
    static uint32_t offsets[3], face_rings[3];
    struct zr_mesh *mesh = &cap->test.mesh;
    memcpy(offsets, (const uint32_t[3]){0, cap->ring_offsets[first_rings], cap->ring_offsets[rings]}, sizeof offsets);
    memcpy(face_rings, (const uint32_t[3]){0, first_rings, rings}, sizeof face_rings);
    mesh->face_count = mesh->cap_count = 2;
    mesh->cap_planes = planes;
    mesh->face_offsets = offsets;
    mesh->face_rings = face_rings;
    instances[0] = instances[1] = cap->test.instance;
    instances[1].object_to_world.m[0] = -1.0f;
    cap->test.scene.instances = instances;
    cap->test.scene.instance_count = 2;
}

/* A slope in depth, so that the depths of triangles in one plane differ by rounding. */
static void tilt(struct cap *cap)
{
    for (uint32_t i = 0; i < cap->test.mesh.position_count; i++)
        cap->positions[i].z = 0.3f * cap->positions[i].x - 0.2f * cap->positions[i].y;
}

static void mirror(struct cap *cap)
{
    for (uint32_t i = 0; i < cap->test.mesh.position_count; i++)
        cap->x[i] = (SIDE - 1) * 256 - cap->x[i];
}

/* Lists the first cap that covers each pixel. Returns how many pixels have several. */
static uint64_t list_owners(struct cap *cap, uint32_t first_rings, uint32_t rings, uint32_t owners[SIDE][SIDE])
{
    uint64_t several = 0;
    memset(owners, 0, SIDE * sizeof *owners);
    for (uint32_t id = 1; id <= 4; id++) {
        const uint32_t first = id % 2 ? 0 : first_rings, end = id % 2 ? first_rings : rings;
        if (id == 3) mirror(cap);
        for (int32_t y = 0; y < SIDE; y++)
            for (int32_t x = 0; x < SIDE; x++) {
                if (winding_at(cap, first, end, x * 256, y * 256) == 0) continue;
                several += owners[y][x] != 0;
                if (owners[y][x] == 0) owners[y][x] = id;
            }
    }
    return several;
}

TEST_AROUND(a_sample_shows_the_first_cap_of_its_plane, open_arena, close_arena)
{
    static struct cap cap;
    static const uint32_t steps[] = {1, 16, 128, 256};
    struct zr_instance instances[2];
    static uint32_t owners[SIDE][SIDE];
    uint64_t several = 0;
    for (int round = 0; round < 40; round++) {
        const uint32_t rings = 2 + random_below(&random_state, RINGS_MAX - 1);
        const uint32_t first_rings = 1 + random_below(&random_state, rings - 1);
        make_cap(&cap, rings, steps[round % 4]);
        make_caps(&cap, rings, first_rings, instances);
        tilt(&cap);
        several += list_owners(&cap, first_rings, rings, owners);
        for (int algorithm = 0; algorithm < ZR_ALGORITHM_COUNT; algorithm++) {
            cap.test.scene.algorithm = (enum zr_algorithm)algorithm;
            const struct zr_frame *frame = scene_render(&arena, NULL, &cap.test.scene);
            for (int32_t y = 0; y < SIDE; y++)
                for (int32_t x = 0; x < SIDE; x++) {
                    const uint32_t id = frame->face_id[(SIDE - 1 - y) * SIDE + x];
                    if (id != owners[y][x])
                        fail_msg("round %d, algorithm %d, %d %d: id %u, not %u", round, algorithm, x, y, id,
                                 owners[y][x]);
                }
            zr_arena_reset(&arena, 1 << 22);
        }
    }
    assert_true(several > 5000);
}

RUN_TESTS(NULL, NULL)
