/* What must hold for every scene, tried on random ones. */
#include <math.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"

TEST_ARENA(1 << 28)

/* A grid over the whole window and beyond, its inner points moved at random, each cell
 * cut along a random diagonal: every pixel is covered, by exactly one triangle. */
static uint32_t make_mesh(struct random *random, int cells, float jitter, zr_vec4 *out)
{
    zr_vec4 points[17][17];
    for (int y = 0; y <= cells; y++)
        for (int x = 0; x <= cells; x++) {
            bool border = x == 0 || y == 0 || x == cells || y == cells;
            double dx = border ? 0 : random_range(random, -(double)jitter, (double)jitter);
            double dy = border ? 0 : random_range(random, -(double)jitter, (double)jitter);
            float step = 2.0f / (float)cells;
            points[y][x] = (zr_vec4){-1 + step * ((float)x + (float)dx), -1 + step * ((float)y + (float)dy), 0, 1};
        }
    uint32_t count = 0;
    for (int y = 0; y < cells; y++)
        for (int x = 0; x < cells; x++) {
            zr_vec4 a = points[y][x], b = points[y][x + 1], c = points[y + 1][x + 1], d = points[y + 1][x];
            const zr_vec4 one[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            memcpy(out + 3 * count, random_below(random, 2) ? one : other, sizeof one);
            count += 2;
        }
    return count;
}

static void triangles_that_share_an_edge_cover_each_pixel_exactly_once(void **state)
{
    (void)state;
    struct random random = random_seeded(11);
    static zr_vec4 positions[16 * 16 * 6];
    static struct test_scene test;
    for (int round = 0; round < 30; round++) {
        uint32_t width = 40 + random_below(&random, 90), height = 40 + random_below(&random, 90);
        int cells = 2 + (int)random_below(&random, 6);
        uint32_t triangles = make_mesh(&random, cells, round % 3 ? 0.3f : 0.0f, positions);
        static uint8_t covered[130 * 130];
        memset(covered, 0, sizeof covered);
        for (uint32_t t = 0; t < triangles; t++) { /* each alone, so that none hides another */
            scene_of_triangles(&test, width, height, positions + 3 * t, 1);
            const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
            for (uint32_t i = 0; i < width * height; i++)
                covered[i] = (uint8_t)(covered[i] + (frame->face_id[i] != 0));
            zr_arena_reset(&arena, 1 << 28);
        }
        for (uint32_t i = 0; i < width * height; i++)
            assert_int_equal(covered[i], 1);
    }
}

/* Overlapping, intersecting, near and far, in perspective, with colours. */
static uint32_t make_soup(struct random *random, zr_vec4 *positions, zr_vec4 *colors)
{
    enum { TRIANGLES = 3000 };
    for (int t = 0; t < TRIANGLES; t++) {
        double cx = random_range(random, -1.2, 1.2), cy = random_range(random, -1.2, 1.2), size = t % 20 ? 0.1 : 2.0;
        for (int k = 0; k < 3; k++) {
            double w = random_range(random, 0.3, 3.0);
            positions[3 * t + k] = (zr_vec4){(float)((cx + random_range(random, -size, size)) * w),
                                             (float)((cy + random_range(random, -size, size)) * w),
                                             (float)(random_range(random, -1.1, 1.1) * w), (float)w};
            colors[3 * t + k] = (zr_vec4){(float)random_range(random, 0, 1), (float)random_range(random, 0, 1),
                                          (float)random_range(random, 0, 1), 1};
        }
    }
    return TRIANGLES;
}

static void any_number_of_threads_gives_the_same_bytes(void **state)
{
    (void)state;
    struct random random = random_seeded(23);
    static zr_vec4 positions[9000], colors[9000];
    static struct test_scene test;
    const uint32_t sizes[3][2] = {{640, 480}, {333, 517}, {65, 1}};
    for (int s = 0; s < 3; s++) {
        uint32_t triangles = make_soup(&random, positions, colors);
        scene_of_triangles(&test, sizes[s][0], sizes[s][1], positions, triangles);
        test.mesh.colors = colors;
        size_t pixels = (size_t)sizes[s][0] * sizes[s][1];
        const struct zr_frame *one = scene_render(&arena, NULL, &test.scene);
        const int threads[] = {1, 2, 7};
        for (int t = 0; t < 3; t++) {
            struct zr_team *team = zr_team_create(threads[t]);
            const struct zr_frame *many = scene_render(&arena, team, &test.scene);
            assert_memory_equal(one->color, many->color, pixels * 4);
            assert_memory_equal(one->depth, many->depth, pixels * 4);
            assert_memory_equal(one->window_depth, many->window_depth, pixels * 4);
            assert_memory_equal(one->face_id, many->face_id, pixels * 4);
            zr_team_destroy(team);
        }
        zr_arena_reset(&arena, 1 << 28);
    }
}

/* In a window of 128 pixels with coordinates in 1/256 pixel every step is exact, so a
 * move by whole pixels must move the picture and change nothing else. */
static void whole_pixel_translation_moves_the_picture_and_changes_nothing(void **state)
{
    (void)state;
    enum { SIZE = 128, TRIANGLES = 60 };
    struct random random = random_seeded(31);
    static zr_vec4 here[3 * TRIANGLES], there[3 * TRIANGLES];
    static struct test_scene test;
    for (int round = 0; round < 100; round++) {
        int dx = (int)random_below(&random, 61) - 30, dy = (int)random_below(&random, 61) - 30;
        for (int i = 0; i < 3 * TRIANGLES; i++) {
            float x = (float)(32 * 256 + (int)random_below(&random, 64 * 256)) / 256.0f;
            float y = (float)(32 * 256 + (int)random_below(&random, 64 * 256)) / 256.0f;
            float z = (float)random_below(&random, 3) * 0.25f; /* flat layers: planes without rounding */
            z = i % 3 ? here[i - 1].z : z;
            here[i] = (zr_vec4){x / 64 - 1, y / 64 - 1, z, 1};
            there[i] = (zr_vec4){(x + (float)dx) / 64 - 1, (y + (float)dy) / 64 - 1, z, 1};
        }
        scene_of_triangles(&test, SIZE, SIZE, here, TRIANGLES);
        const struct zr_frame *a = scene_render(&arena, NULL, &test.scene);
        test.mesh.positions = there;
        const struct zr_frame *b = scene_render(&arena, NULL, &test.scene);
        for (int y = 30; y < SIZE - 30; y++)
            for (int x = 30; x < SIZE - 30; x++) {
                int from = y * SIZE + x, to = (y - dy) * SIZE + x + dx;
                assert_int_equal(a->face_id[from], b->face_id[to]);
                assert_true(a->window_depth[from] == b->window_depth[to]);
            }
        zr_arena_reset(&arena, 1 << 28);
    }
}

static void every_channel_tells_of_the_same_samples(void **state)
{
    (void)state;
    struct random random = random_seeded(47);
    static zr_vec4 positions[9000], colors[9000], face_colors[3000];
    static struct test_scene test;
    uint32_t triangles = make_soup(&random, positions, colors);
    for (uint32_t t = 0; t < triangles; t++)
        face_colors[t] = (zr_vec4){(float)(t & 255) / 255.0f, (float)(t >> 8) / 255.0f, 1, 1};
    scene_of_triangles(&test, 320, 240, positions, triangles);
    test.mesh.face_colors = face_colors;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    int seen = 0;
    for (int i = 0; i < 320 * 240; i++) {
        bool there = frame->face_id[i] != 0;
        seen += there;
        assert_int_equal(there, frame->window_depth[i] < 1.0f);
        assert_int_equal(there, isfinite(frame->depth[i]) != 0);
        uint32_t id = frame->color[4 * i] + 256u * frame->color[4 * i + 1] + 1;
        assert_int_equal(frame->face_id[i], there ? id : 0);
    }
    assert_true(seen > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(triangles_that_share_an_edge_cover_each_pixel_exactly_once, open_arena,
                                        close_arena),
        cmocka_unit_test_setup_teardown(any_number_of_threads_gives_the_same_bytes, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(whole_pixel_translation_moves_the_picture_and_changes_nothing, open_arena,
                                        close_arena),
        cmocka_unit_test_setup_teardown(every_channel_tells_of_the_same_samples, open_arena, close_arena),
    };
    return cmocka_run_group_tests_name("properties", tests, NULL, NULL);
}
