/* What must hold for every scene, tried on random ones. */
#include <math.h>
#include <string.h>

#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

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

/* In a window of 128 pixels with coordinates in 1/256 pixel every step is exact, so a
 * move by whole pixels must move the picture and change nothing else. */
TEST_AROUND(whole_pixel_translation_moves_the_picture_and_changes_nothing, open_arena, close_arena)
{
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

TEST_AROUND(every_channel_tells_of_the_same_samples, open_arena, close_arena)
{
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

RUN_TESTS(NULL, NULL)
