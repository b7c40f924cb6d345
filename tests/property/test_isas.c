/* Any instruction set, and any number of threads, gives the bytes that plain C gives on one thread. */
#include <math.h>
#include <string.h>

#include "support/isas.h"
#include "support/pictures/gallery.h"
#include "support/scenes.h"
#include "support/test_arena.h"

static const size_t ceiling = (size_t)1 << 29;
TEST_ARENA(ceiling)

static void assert_same(const struct zr_frame *want, const struct zr_frame *got, const char *scene, int threads)
{
    size_t pixels = (size_t)want->width * want->height, covered = 0;
    for (size_t i = 0; i < pixels; i++)
        covered += got->face_id[i] > 0;
    if (!got->base) assert_int_equal(got->covered_pixels, covered);
    assert_int_equal(got->covered_pixels, want->covered_pixels);
    assert_true(got->deepest == want->deepest);
    assert_memory_equal(got->spans, want->spans, want->height * sizeof *want->spans);
    for (int c = 0; c < GALLERY_CHANNELS; c++) {
        const uint32_t *w = gallery_channel(want, c), *g = gallery_channel(got, c);
        if (g == NULL && c == 0) continue; /* colours, which were not wanted */
        if (memcmp(w, g, 4 * pixels) == 0) continue;
        size_t i = 0;
        while (w[i] == g[i])
            i++;
        fail_msg("%s, %u x %u, %d threads: %s at %zu, %zu is %08x, not %08x", scene, want->width, want->height, threads,
                 gallery_channels[c], i % want->width, i / want->width, g[i], w[i]);
    }
}

TEST_EACH_ISA(every_scene_in_every_window_has_the_bytes_of_plain_c)
{
    enum zr_isa isa = isa_under_test(state);
    static const int threads[] = {1, 7, 2};
    struct zr_team *plain = zr_team_create_for(1, ZR_ISA_SCALAR), *teams[3];
    for (int t = 0; t < 3; t++)
        teams[t] = zr_team_create_for(threads[t], isa);
    for (int number = 0; number < GALLERY_SCENES; number++)
        for (int w = 0; w < GALLERY_WINDOWS; w++) {
            const uint32_t *size = gallery_windows[w];
            const struct zr_scene *scene = gallery_scene(&arena, number, size[0], size[1]);
            assert_non_null(scene);
            const struct zr_frame *want = scene_render(&arena, plain, scene);
            struct zr_scene uncolored = *scene;
            assert_int_equal(scene->views[0].outputs[0].channel, ZR_CHANNEL_COLOR);
            uncolored.views[0].outputs++;
            uncolored.views[0].output_count--;
            for (int t = 0; t < 3; t++) {
                const struct zr_frame *got = scene_render(&arena, teams[t], scene);
                assert_non_null(got->color);
                assert_same(want, got, gallery_names[number], threads[t]);
            }
            assert_same(want, scene_render(&arena, teams[2], &uncolored), gallery_names[number], threads[2]);
            zr_arena_reset(&arena, ceiling);
        }
    for (int t = 0; t < 3; t++)
        zr_team_destroy(teams[t]);
    zr_team_destroy(plain);
}

/* The same picture, but the corners of its mesh are so far apart, and so many, that vertices are written past the
 * caches; and it is drawn twice at one place, the second time from vertices that begin in the middle of a line of the
 * cache. */
static const struct zr_scene *spread_out(const struct zr_scene *scene)
{
    enum { APART = 10 };
    const struct zr_mesh *old = &scene->meshes[0];
    const uint32_t count = old->position_count * APART + 1, corners = old->face_offsets[old->face_count];
    struct zr_scene *out = zr_arena_alloc(&arena, 1, sizeof *out);
    struct zr_mesh *mesh = zr_arena_alloc(&arena, 1, sizeof *mesh);
    struct zr_instance *instances = zr_arena_alloc(&arena, 2, sizeof *instances);
    zr_vec4 *positions = zr_arena_zero(&arena, count, sizeof *positions);
    zr_vec4 *colors = zr_arena_zero(&arena, count, sizeof *colors);
    uint32_t *indices = zr_arena_alloc(&arena, corners, sizeof *indices);
    assert_true(zr_arena_ok(&arena) && scene->mesh_count == 1 && scene->instance_count == 1 && count >= 1 << 17);
    for (uint32_t i = 0; i < old->position_count; i++) {
        positions[APART * i] = old->positions[i];
        colors[APART * i] = old->colors[i];
    }
    for (uint32_t i = 0; i < corners; i++)
        indices[i] = APART * old->indices[i];
    *mesh = *old;
    mesh->position_count = count;
    mesh->positions = positions;
    mesh->colors = colors;
    mesh->indices = indices;
    instances[0] = instances[1] = scene->instances[0];
    *out = *scene;
    out->meshes = mesh;
    out->instances = instances;
    out->instance_count = 2;
    return out;
}

TEST_EACH_ISA(so_has_a_mesh_of_many_vertices)
{
    enum zr_isa isa = isa_under_test(state);
    struct zr_team *plain = zr_team_create_for(1, ZR_ISA_SCALAR);
    for (int number = 0; number < 2; number++) { /* the soups */
        const struct zr_scene *near = gallery_scene(&arena, number, 640, 480), *far = spread_out(near);
        const struct zr_frame *want = scene_render(&arena, plain, near);
        for (int threads = 1; threads <= 3; threads++) {
            struct zr_team *team = zr_team_create_for(threads, isa);
            assert_same(want, scene_render(&arena, team, far), gallery_names[number], threads);
            zr_team_destroy(team);
        }
        zr_arena_reset(&arena, ceiling);
    }
    zr_team_destroy(plain);
}

/* A gallery that shows nothing would be the same everywhere; all but its last scene must show something. */
TEST(every_scene_shows_much_in_large_windows)
{
    for (int number = 0; number < GALLERY_SCENES - 1; number++) {
        const struct zr_scene *scene = gallery_scene(&arena, number, 640, 480);
        assert_non_null(scene);
        const struct zr_frame *frame = scene_render(&arena, NULL, scene);
        if (frame->covered_pixels < 20000) fail_msg("%s: %d pixels", gallery_names[number], (int)frame->covered_pixels);
        zr_arena_reset(&arena, ceiling);
    }
}

/* What a frame says of itself, looked up pixel by pixel. Returns how many pixels are out of reach. */
static size_t check_spans(const struct zr_frame *frame, const char *name)
{
    size_t outside = 0;
    float deepest = 0.0f;
    uint32_t nothing[GALLERY_CHANNELS] = {0};
    for (uint32_t y = 0; y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++) {
            const size_t i = (size_t)y * frame->width + x;
            if (frame->depth[i] < INFINITY && frame->depth[i] > deepest) deepest = frame->depth[i];
            if (x >= frame->spans[y].begin && x < frame->spans[y].end) continue;
            if (frame->face_id[i] != 0) fail_msg("%s: a face at %u, %u, out of reach", name, x, y);
            for (int c = 0; c < GALLERY_CHANNELS; c++) {
                const uint32_t *channel = gallery_channel(frame, c), value = channel[i];
                if (outside == 0) nothing[c] = value;
                if (value != nothing[c])
                    fail_msg("%s: %s at %u, %u, out of reach, is %08x", name, gallery_channels[c], x, y, value);
            }
            outside++;
        }
    assert_true(frame->deepest == deepest);
    return outside;
}

TEST(what_is_out_of_reach_is_nothing)
{
    size_t outside = 0;
    struct zr_team *team = zr_team_create(2);
    for (int number = 0; number < GALLERY_SCENES; number++)
        for (int w = 0; w < GALLERY_WINDOWS; w++) {
            const struct zr_scene *scene = gallery_scene(&arena, number, gallery_windows[w][0], gallery_windows[w][1]);
            assert_non_null(scene);
            outside += check_spans(scene_render(&arena, team, scene), gallery_names[number]);
            zr_arena_reset(&arena, ceiling);
        }
    zr_team_destroy(team);
    assert_true(outside > 0);
}

RUN_TESTS(open_arena, close_arena)
