/* All algorithms give the same bytes, tried on random scenes; and cover what the odd-even rule covers,
 * counted sample by sample in exact integers.
 *
 * ALGORITHM_TRIANGLES asks for so many triangles, and a fifth of it in polygons; 10 000 is the default. */
#include <stdlib.h>
#include <string.h>

#include "support/geometries.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

enum { TRIANGLES = 10000, TRIANGLES_PER_POLYGON = 5, SCENE_TRIANGLES = 1024, CORNERS = 1024 };

TEST_ARENA(1 << 28)

static uint32_t triangles_wanted(void)
{
    const char *text = getenv("ALGORITHM_TRIANGLES");
    return text ? (uint32_t)strtoul(text, NULL, 10) : TRIANGLES;
}

static uint32_t random_side(struct random *random)
{
    static const uint32_t sides[] = {1, 2, 3, 17, 63, 64, 65};
    uint32_t kind = random_below(random, 10);
    if (kind < 2) return sides[random_below(random, 7)];
    return kind < 9 ? 8 + random_below(random, 60) : 60 + random_below(random, 90);
}

/* ---- whole scenes ---- */

struct soup {
    zr_vec4 positions[3 * SCENE_TRIANGLES], colors[3 * SCENE_TRIANGLES];
    uint32_t count; /* triangles */
};

static float real(struct random *random, double low, double high)
{
    return (float)random_range(random, low, high);
}

/* From x, y (-1..1 is the window) and depth -1..1 to homogeneous clip space. */
static zr_vec4 clip_of(double x, double y, double z, double w)
{
    return (zr_vec4){(float)(x * w), (float)(y * w), (float)(z * w), (float)w};
}

static void add_triangle(struct soup *soup, zr_vec4 a, zr_vec4 b, zr_vec4 c)
{
    if (soup->count == SCENE_TRIANGLES) return;
    const zr_vec4 corners[3] = {a, b, c};
    memcpy(&soup->positions[3 * soup->count++], corners, sizeof corners);
}

/* Large and small, one through the other, in perspective, across all planes of the view volume. */
static void make_crossing(struct random *random, struct soup *soup)
{
    uint32_t count = 1 + random_below(random, 120);
    for (uint32_t t = 0; t < count; t++) {
        double cx = random_range(random, -1.2, 1.2), cy = random_range(random, -1.2, 1.2), size = t % 4 ? 0.3 : 2.0;
        zr_vec4 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = clip_of(cx + random_range(random, -size, size), cy + random_range(random, -size, size),
                           random_range(random, -1.1, 1.1), random_range(random, t % 5 ? 0.3 : -0.3, 3.0));
        add_triangle(soup, p[0], p[1], p[2]);
    }
}

/* Rings of blades, each over the next and the last over the first. */
static void make_cycles(struct random *random, struct soup *soup)
{
    static const double circle[8][2] = {{1, 0},  {0.7, 0.7},   {0, 1},  {-0.7, 0.7},
                                        {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}};
    for (int ring = 0; ring < 8; ring++) {
        double cx = random_range(random, -0.6, 0.6), cy = random_range(random, -0.6, 0.6);
        double size = random_range(random, 0.2, 0.9), near = random_range(random, -0.9, 0), far = near + 0.5;
        uint32_t step = 1 + random_below(random, 2), reach = step + 1 + random_below(random, 2);
        for (uint32_t k = 0; k < 8; k += step) {
            const double *a = circle[k], *b = circle[(k + reach) % 8];
            add_triangle(soup, clip_of(cx + size * a[0], cy + size * a[1], near, 1),
                         clip_of(cx + size * b[0], cy + size * b[1], far, 1),
                         clip_of(cx + size * b[0] + 0.2 * a[0], cy + size * b[1] + 0.2 * a[1], far, 1));
        }
    }
}

/* A hilly sheet seen from the side: every edge shared, and it hides itself. Coarse, or fine. */
static void make_mesh(struct random *random, struct soup *soup)
{
    enum { COARSE = 12, FINE = 22 };
    const int cells = random_below(random, 2) ? COARSE : FINE;
    const double far = 0.1 * COARSE / cells;
    zr_vec4 p[FINE + 1][FINE + 1];
    for (int y = 0; y <= cells; y++)
        for (int x = 0; x <= cells; x++)
            p[y][x] = clip_of(-0.95 + 1.9 * x / cells + random_range(random, -0.06, 0.06),
                              -0.5 + 1.0 * y / cells + random_range(random, -0.4, 0.4),
                              -0.8 + 1.6 * y / cells + random_range(random, -0.1, 0.1), 0.5 + far * y);
    for (int y = 0; y < cells; y++)
        for (int x = 0; x < cells; x++) {
            add_triangle(soup, p[y][x], p[y][x + 1], p[y + 1][x + 1]);
            add_triangle(soup, p[y][x], p[y + 1][x + 1], p[y + 1][x]);
        }
}

/* Copies at the very same depth, in other colours: only the order tells them apart. */
static void make_duplicates(struct random *random, struct soup *soup)
{
    make_crossing(random, soup);
    uint32_t count = soup->count < 20 ? soup->count : 20;
    for (uint32_t t = 0; t < count; t++) {
        const zr_vec4 *p = &soup->positions[3 * t];
        add_triangle(soup, p[0], p[1], p[2]);
        if (t % 2) add_triangle(soup, p[1], p[0], p[2]);
    }
    for (int layer = 0; layer < 12; layer++) { /* in few planes that face the viewer */
        double z = 0.25 * random_below(random, 3);
        add_triangle(soup, clip_of(random_range(random, -1, 1), random_range(random, -1, 1), z, 1),
                     clip_of(random_range(random, -1, 1), random_range(random, -1, 1), z, 1),
                     clip_of(random_range(random, -1, 1), random_range(random, -1, 1), z, 1));
    }
}

/* Corners on samples, or halfway between two: in windows of 64 pixels most edges meet samples. */
static void make_aligned(struct random *random, struct soup *soup)
{
    uint32_t count = 10 + random_below(random, 100), step = 1 + random_below(random, 2);
    for (uint32_t t = 0; t < count; t++) {
        zr_vec4 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = clip_of((random_below(random, 64 * step) / (double)step + 0.5) / 32 - 1,
                           (random_below(random, 64 * step) / (double)step + 0.5) / 32 - 1,
                           random_below(random, 5) * 0.25 - 0.5, 1);
        add_triangle(soup, p[0], p[1], p[2]);
    }
}

static void make_slivers(struct random *random, struct soup *soup)
{
    uint32_t count = 10 + random_below(random, 100);
    for (uint32_t t = 0; t < count; t++) {
        double x = random_range(random, -1, 1), y = random_range(random, -1, 1), x1 = random_range(random, -1, 1),
               y1 = random_range(random, -1, 1), thin = t % 2 ? 0.02 : 0.0005;
        add_triangle(soup, clip_of(x, y, random_range(random, -1, 1), 1),
                     clip_of(x1, y1, random_range(random, -1, 1), 1),
                     clip_of(x1 + random_range(random, -thin, thin), y1 + random_range(random, -thin, thin),
                             random_range(random, -1, 1), random_range(random, 0.9, 1.1)));
    }
}

static void assert_same_frames(const struct zr_frame *a, const struct zr_frame *b, size_t pixels, const char *word)
{
    if (memcmp(a->face_id, b->face_id, pixels * 4) != 0) fail_msg("%s: other polygons are seen", word);
    if (memcmp(a->window_depth, b->window_depth, pixels * 4) != 0) fail_msg("%s: another windowDepth", word);
    if (memcmp(a->depth, b->depth, pixels * 4) != 0) fail_msg("%s: another depth", word);
    if (memcmp(a->color, b->color, pixels * 4) != 0) fail_msg("%s: another color", word);
}

/* Most faces see-through: mixed, or many of one mode one after the other, which are one draw. */
static void make_see_through(struct random *random, struct soup *soup, struct test_scene *test)
{
    static struct zr_material materials[ZR_ALPHA_NAMES];
    static uint32_t face_materials[SCENE_TRIANGLES];
    for (int mode = 0; mode < ZR_ALPHA_NAMES; mode++) {
        materials[mode] = test->material;
        materials[mode].alpha_mode = (enum zr_alpha_mode)mode;
        materials[mode].alpha_cutoff = 0.5f;
    }
    const uint32_t run = random_below(random, 2) ? 1 : 200;
    for (uint32_t t = 0; t < soup->count; t++)
        face_materials[t] = t % run ? face_materials[t - 1] : random_below(random, ZR_ALPHA_NAMES);
    for (uint32_t i = 0; i < 3 * soup->count; i++)
        soup->colors[i].w = real(random, 0, 1);
    test->scene.materials = materials;
    test->scene.material_count = ZR_ALPHA_NAMES;
    test->mesh.face_materials = face_materials;
}

TEST_AROUND(random_scenes_give_the_same_bytes_by_every_algorithm, open_arena, close_arena)
{
    void (*const kinds[])(struct random *, struct soup *) = {make_crossing,   make_cycles,  make_mesh,
                                                             make_duplicates, make_aligned, make_slivers};
    static struct soup soup;
    static struct test_scene test;
    struct random random = random_seeded(71);
    uint32_t wanted = triangles_wanted(), drawn = 0;
    for (uint32_t round = 0; drawn < wanted; round++) {
        soup.count = 0;
        kinds[round % 6](&random, &soup);
        for (uint32_t i = 0; i < 3 * soup.count; i++)
            soup.colors[i] = (zr_vec4){real(&random, 0, 1), real(&random, 0, 1), real(&random, 0, 1), 1};
        uint32_t width = kinds[round % 6] == make_aligned ? 64 : random_side(&random),
                 height = kinds[round % 6] == make_aligned ? 64 : random_side(&random);
        scene_of_triangles(&test, width, height, soup.positions, soup.count);
        test.mesh.colors = soup.colors;
        test.material.double_sided = round % 4 != 0;
        const bool see_through = round % 5 < 2;
        if (see_through) make_see_through(&random, &soup, &test);
        const struct zr_frame *expected = scene_render(&arena, NULL, &test.scene);
        for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
            if (a == ZR_ALGORITHM_PAINTER && see_through) continue; /* it keeps no fragments */
            test.scene.algorithm = (enum zr_algorithm)a;
            const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
            assert_same_frames(expected, frame, (size_t)width * height, algorithm_words[a]);
        }
        drawn += (uint32_t)(expected->counts.drawn_whole + expected->counts.drawn_pieces);
        zr_arena_reset(&arena, 1 << 28);
    }
}

/* ---- shapes ---- */

struct ring {
    struct test_corner corners[CORNERS];
    uint32_t count;
};

static int32_t place(struct random *random, uint32_t side, int32_t grid)
{
    int32_t reach = (int32_t)side * ZR_SUBPIXELS + 2 * ZR_SUBPIXELS;
    int32_t at = (int32_t)random_below(random, (uint32_t)reach) - ZR_SUBPIXELS;
    return at / grid * grid;
}

/* Any corners: crossings without number. */
static void make_tangle(struct random *random, uint32_t width, uint32_t height, uint32_t count, struct ring *ring)
{
    static const int32_t grids[] = {1, 1, 128, 256};
    int32_t grid = grids[random_below(random, 4)];
    for (uint32_t i = 0; i < count; i++)
        ring->corners[i] = (struct test_corner){place(random, width, grid), place(random, height, grid), 0};
    ring->count = count;
}

/* Up along one side and down along the other, in teeth: concave, without crossings but for level ones. */
static void make_comb(struct random *random, uint32_t width, uint32_t height, uint32_t count, struct ring *ring)
{
    int32_t x = place(random, width, 1), thick = 64 + (int32_t)random_below(random, 512);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t up = i < count / 2 ? i : count - 1 - i;
        int32_t y = (int32_t)((uint64_t)up * height * 2 * ZR_SUBPIXELS / count);
        int32_t tooth = up % 2 ? (int32_t)random_below(random, width * ZR_SUBPIXELS / 2 + 1) : 0;
        ring->corners[i] = (struct test_corner){x + tooth + (i < count / 2 ? thick : 0), y, 0};
    }
    ring->count = count;
}

/* Some corners said again, some ways gone there and back. */
static void repeat_corners(struct random *random, struct ring *ring)
{
    for (uint32_t i = 2; i < ring->count; i++) {
        uint32_t kind = random_below(random, 6);
        if (kind == 0) ring->corners[i] = ring->corners[i - 1];
        if (kind == 1) ring->corners[i] = ring->corners[i - 2];
    }
}

static uint32_t random_corners(struct random *random)
{
    uint32_t kind = random_below(random, 40);
    if (kind == 0) return CORNERS - random_below(random, 2);
    return kind < 5 ? 12 + random_below(random, 100) : 4 + random_below(random, 8);
}

/* Records with planes of their own, which need not meet: visibility depends on each. */
static void add_records(struct random *random, const struct ring *ring, struct test_geometry *test)
{
    uint32_t count = random_below(random, 3) ? 1 : 1 + random_below(random, 6);
    double near = random_range(random, 0.05, 0.6), deep = random_below(random, 3) ? 0.0 : 0.3;
    for (uint32_t t = 0, tries = 0; t < count && tries < 50; tries++) {
        struct test_corner corners[3];
        for (int k = 0; k < 3; k++) {
            corners[k] = ring->corners[random_below(random, ring->count)];
            corners[k].z = real(random, near, near + deep);
        }
        t += geometry_add_triangle(test, corners);
    }
}

static bool add_shape(struct random *random, uint32_t width, uint32_t height, struct test_geometry *test)
{
    static struct ring ring;
    uint32_t rings = random_below(random, 3) ? 1 : 2 + random_below(random, 3);
    geometry_begin_shape(test);
    for (uint32_t r = 0; r < rings; r++) {
        uint32_t corners = r == 0 ? random_corners(random) : 3 + random_below(random, 6);
        if (random_below(random, 2))
            make_comb(random, width, height, corners, &ring);
        else
            make_tangle(random, width, height, corners, &ring);
        if (random_below(random, 3) == 0) repeat_corners(random, &ring);
        geometry_add_ring(test, ring.corners, ring.count);
        if (r == 0) add_records(random, &ring, test);
    }
    return geometry_end_shape(test);
}

static void add_flat_triangle(struct random *random, uint32_t width, uint32_t height, struct test_geometry *test)
{
    struct ring ring;
    make_tangle(random, width, height, 3, &ring);
    for (int k = 0; k < 3; k++)
        ring.corners[k].z = real(random, 0.05, 0.9);
    geometry_add_triangle(test, ring.corners);
}

/* By the definition alone: every sample against every primitive. */
static struct zr_samples draw_by_definition(const struct test_geometry *test, uint32_t width, uint32_t height)
{
    size_t pixels = (size_t)width * height;
    struct zr_samples samples = {.width = width,
                                 .height = height,
                                 .depth = zr_arena_alloc(&arena, pixels, sizeof(float)),
                                 .owner = zr_arena_zero(&arena, pixels, sizeof(uint32_t))};
    struct zr_primitive primitive;
    for (size_t i = 0; i < pixels; i++)
        samples.depth[i] = 1.0f;
    for (uint32_t first = 0; first < test->geometry.primitive_count; first += primitive.count) {
        zr_primitive_make(&test->geometry, zr_draw_of(&test->geometry, first), first, width, height, &primitive);
        for (size_t i = 0; i < pixels; i++) {
            int32_t x = (int32_t)(i % width), y = (int32_t)(i / width);
            if (!edges_hold(zr_primitive_edges(&primitive), primitive.edge_count, x, y)) continue;
            struct zr_hit hit = zr_primitive_hit(&test->geometry, &primitive, x, y);
            if (!(hit.depth < samples.depth[i])) continue;
            samples.depth[i] = hit.depth;
            samples.owner[i] = hit.owner;
        }
    }
    return samples;
}

static void assert_same_samples(const struct zr_samples *expected, const struct zr_samples *samples, const char *word)
{
    size_t i = samples_differ_at(expected, samples);
    if (i == (size_t)expected->width * expected->height) return;
    fail_msg("%s in %u x %u at %zu, %zu: owner %u at %a, not %u at %a", word, expected->width, expected->height,
             i % expected->width, i / expected->width, samples->owner[i], (double)samples->depth[i], expected->owner[i],
             (double)expected->depth[i]);
}

static struct test_geometry geometry;

/* Several together, triangles among them, against the definition. Returns its polygons. */
static uint32_t try_shapes(struct random *random)
{
    uint32_t width = random_side(random) / 2 + 1, height = random_side(random) / 2 + 1, polygons = 0;
    uint32_t shapes = 1 + random_below(random, 7);
    if (random_below(random, 8) == 0) width += 60;
    geometry_clear(&geometry);
    for (uint32_t s = 0; s < shapes; s++) {
        if (random_below(random, 4) == 0) add_flat_triangle(random, width, height, &geometry);
        polygons += add_shape(random, width, height, &geometry);
    }
    struct zr_samples expected = draw_by_definition(&geometry, width, height);
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_samples samples = geometry_draw(&arena, &geometry, (enum zr_algorithm)a, width, height);
        assert_same_samples(&expected, &samples, algorithm_words[a]);
    }
    zr_arena_reset(&arena, 1 << 28);
    return polygons;
}

TEST_AROUND(random_shapes_are_drawn_as_the_odd_even_rule_says_by_every_algorithm, open_arena, close_arena)
{
    struct random random = random_seeded(83);
    for (uint32_t drawn = 0, wanted = triangles_wanted() / TRIANGLES_PER_POLYGON; drawn < wanted;)
        drawn += try_shapes(&random);
}

/* ---- the comparison itself ---- */

TEST_AROUND(comparison_sees_one_bit_of_depth_and_one_owner, open_arena, close_arena)
{
    struct random random = random_seeded(89);
    geometry_clear(&geometry);
    for (int t = 0; t < 20; t++)
        add_flat_triangle(&random, 30, 30, &geometry);
    struct zr_samples expected = geometry_draw(&arena, &geometry, ZR_ALGORITHM_HALFSPACE, 30, 30);
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_samples samples = geometry_draw(&arena, &geometry, (enum zr_algorithm)a, 30, 30);
        assert_int_equal(samples_differ_at(&expected, &samples), 900);
        uint32_t bits;
        memcpy(&bits, &samples.depth[450], 4);
        bits ^= 1;
        memcpy(&samples.depth[450], &bits, 4);
        samples.owner[777] ^= 1;
        assert_int_equal(samples_differ_at(&expected, &samples), 450);
        samples.depth[450] = expected.depth[450];
        assert_int_equal(samples_differ_at(&expected, &samples), 777);
    }
}

/* A triangle moved by the least that its depth can be moved must be seen by all. */
TEST_AROUND(every_algorithm_sees_a_triangle_that_has_moved_in_depth, open_arena, close_arena)
{
    struct random random = random_seeded(97);
    geometry_clear(&geometry);
    for (int t = 0; t < 20; t++)
        add_flat_triangle(&random, 30, 30, &geometry);
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_samples before = geometry_draw(&arena, &geometry, (enum zr_algorithm)a, 30, 30);
        uint32_t seen = 0;
        while (before.owner[seen] == 0)
            seen++;
        struct zr_window_vertex *v = &geometry.vertices[geometry.corners[3 * (before.owner[seen] - 1)]];
        float z = v->z;
        v->z += 0x1p-10f;
        struct zr_samples after = geometry_draw(&arena, &geometry, (enum zr_algorithm)a, 30, 30);
        v->z = z;
        assert_true(samples_differ_at(&before, &after) < 900);
    }
}

RUN_TESTS(NULL, NULL)
