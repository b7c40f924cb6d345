/* Surfaces of pixels: which primitives join, by pixels made for each limit, and by the rule in double, pixel by
 * pixel. */
#include <math.h>
#include <string.h>

#include "effects/surfaces.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/surface_rule.h"

enum { SIDE = ZR_SURFACES_SIDE, PRIMITIVES = 5000, PIXELS_PER_UNIT = 20 };

/* A plane through the ray of a place, in samples. Lines have the normal 0. */
struct primitive {
    zr_vec3 base, normal, through;
    uint32_t material;
};

static struct primitive primitives[PRIMITIVES + 1]; /* by owner */
static uint32_t owners[ZR_TILE_STRIDE * ZR_TILE_SIZE];
static struct zr_tile tile;
static struct zr_surface_rule rule;
static struct zr_surfaces surfaces, plain;

static void begin(int32_t width, int32_t height, bool is_parallel)
{
    rule.scale =
        (struct zr_pixel_scale){PIXELS_PER_UNIT, {0, 0, is_parallel ? 0.0f : -1.0f}, is_parallel ? 1.0f : 0.0f};
    tile = (struct zr_tile){.x = 3 * ZR_TILE_SIZE, .y = ZR_TILE_SIZE, .width = width, .height = height};
    memset(owners, 0, sizeof owners);
}

/* ---- values at a place ---- */

static zr_vec3 ray_of(float x, float y)
{
    const float unit = 1.0f / (SIDE * PIXELS_PER_UNIT);
    return (zr_vec3){(x - 200.0f) * unit, (y - 100.0f) * unit, -1.0f};
}

/* Rays begin at the eye, or, in parallel, at z = 0. */
static zr_vec3 point_at(const struct primitive *p, float x, float y)
{
    const zr_vec3 ray = ray_of(x, y), n = p->normal;
    if (n.z == 0.0f) return p->through;
    if (rule.scale.offset == 0.0f) return zr_vec3_scale(ray, zr_vec3_dot(p->through, n) / zr_vec3_dot(ray, n));
    const float z = p->through.z - (n.x * (ray.x - p->through.x) + n.y * (ray.y - p->through.y)) / n.z;
    return (zr_vec3){ray.x, ray.y, z};
}

static zr_vec3 middle_of_ray(float x, float y, float depth)
{
    const zr_vec3 ray = ray_of(x, y);
    const float along = rule.scale.offset == 0.0f ? depth : 1.0f;
    return (zr_vec3){ray.x * along, ray.y * along, -depth};
}

static void put3(float (*planes)[ZR_SAMPLES_ROOM], uint32_t i, zr_vec3 v)
{
    planes[0][i] = v.x;
    planes[1][i] = v.y;
    planes[2][i] = v.z;
}

/* Values behind the last are any. */
static void put_values(struct zr_surfaces *s)
{
    for (uint32_t i = 0; i < ZR_SAMPLES_ROOM; i++) {
        const bool is_listed = i < s->list.count;
        const struct primitive *p = &primitives[is_listed ? s->list.owner[i] : 0];
        const zr_vec3 any = {NAN, NAN, NAN};
        put3(s->floats, i, is_listed ? p->base : any);
        put3(s->floats + 3, i, is_listed ? p->normal : any);
        put3(s->floats + 6, i, is_listed ? point_at(p, s->list.x[i], s->list.y[i]) : any);
        s->material[i] = p->material;
    }
}

static void find_and_join(enum zr_isa isa, int32_t from, struct zr_surfaces *s)
{
    zr_surfaces_find_of(isa)(owners, &tile, from, s);
    put_values(s);
    zr_surfaces_join_of(isa)(&rule, s);
}

/* ---- one pixel by the rule ---- */

static void want_pixel(int32_t x, int32_t y, struct surface_pixel *pixel)
{
    static float values[SURFACE_SAMPLES][9];
    struct surface_sample samples[SURFACE_SAMPLES];
    for (int32_t i = 0; i < SURFACE_SAMPLES; i++) {
        const int32_t column = x * SIDE + i % SIDE, row = y * SIDE + i / SIDE;
        const uint32_t owner = owners[row * ZR_TILE_STRIDE + column];
        const struct primitive *p = &primitives[owner];
        const zr_vec3 point = point_at(p, (float)(tile.x + column), (float)(tile.y + row)), *const from[] = {&p->base,
                                                                                                             &p->normal,
                                                                                                             &point};
        for (int k = 0; k < 3; k++)
            memcpy(values[i] + 3 * k, from[k], 3 * sizeof(float));
        samples[i] = (struct surface_sample){owner,         p->material,
                                             values[i],     values[i] + 3,
                                             values[i] + 6, rule.scale.offset == 0.0f ? -1.0 / (double)point.z : 1.0};
    }
    surface_pixel_find(samples, PIXELS_PER_UNIT, pixel);
}

static void assert_values(const double want[3], float (*planes)[ZR_SAMPLES_ROOM], uint32_t i)
{
    for (int k = 0; k < 3; k++)
        assert_true(fabs(want[k] - (double)planes[k][i]) <= 1e-5 * fmax(1.0, fabs(want[k])));
}

static void compare_pixel(struct zr_surfaces *s, uint32_t number, const struct surface_pixel *want)
{
    const uint32_t first = s->first[number];
    assert_int_equal(s->first[number + 1] - first, want->count);
    for (uint32_t k = 0; k < want->count; k++) {
        const struct surface *surface = &want->surfaces[k];
        assert_int_equal(s->list.owner[first + k], surface->primitive);
        assert_int_equal(s->material[first + k], surface->material);
        assert_int_equal(s->samples[first + k], (uint32_t)surface->count);
        assert_values(surface->base, s->floats, first + k);
        assert_values(surface->normal, s->floats + 3, first + k);
        assert_values(surface->way, s->floats + 6, first + k);
    }
}

struct sum {
    uint32_t pixels, undecided, lists, primitives, surfaces;
};

/* All pixels of the tile, and the same bytes as those of plain code. */
static void compare_tile(enum zr_isa isa, struct sum *sum)
{
    struct surface_pixel want;
    for (int32_t from = 0; from < tile.height / SIDE; from += surfaces.rows, sum->lists++) {
        find_and_join(ZR_ISA_SCALAR, from, &plain);
        find_and_join(isa, from, &surfaces);
        const uint32_t count = surfaces.list.count, pixels = (uint32_t)(surfaces.rows * surfaces.columns);
        assert_true(surfaces.rows > 0 && surfaces.rows == plain.rows && count == plain.list.count);
        assert_memory_equal(surfaces.first, plain.first, (pixels + 1) * sizeof *plain.first);
        for (int k = 0; k < 9; k++)
            assert_memory_equal(surfaces.floats[k], plain.floats[k], count * sizeof(float));
        assert_memory_equal(surfaces.list.x, plain.list.x, count * sizeof(float));
        for (uint32_t i = 0; i < pixels; i++) {
            want_pixel((int32_t)i % surfaces.columns, from + (int32_t)i / surfaces.columns, &want);
            sum->pixels++;
            sum->undecided += want.is_undecided;
            sum->surfaces += want.count;
            if (!want.is_undecided) compare_pixel(&surfaces, i, &want);
        }
    }
}

/* ---- limits ---- */

static zr_vec3 turned(double degrees)
{
    const double angle = degrees * acos(-1.0) / 180.0;
    return (zr_vec3){(float)sin(angle), 0, (float)cos(angle)};
}

/* Two primitives share a pixel, a step and an angle apart. */
static const struct pair {
    const char *what;
    double pixels, degrees, color;
    uint32_t material;
    bool is_joined;
} pairs[] = {{"one plane", 0, 0, 0, 0, true},
             {"a step of less than 1.5 samples", 0.365, 0, 0, 0, true},
             {"a step of more than 1.5 samples", 0.385, 0, 0, 0, false},
             {"5.9 degrees", 0, 5.9, 0, 0, true},
             {"6.1 degrees", 0, 6.1, 0, 0, false},
             {"colours 1/65 apart", 0, 0, 1.0 / 65.0, 0, true},
             {"colours 1/63 apart", 0, 0, 1.0 / 63.0, 0, false},
             {"two materials", 0, 0, 0, 1, false}};

TEST_EACH_ISA(surfaces_join_within_their_limits)
{
    const enum zr_isa isa = isa_under_test(state);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const struct pair *pair = &pairs[i];
        begin(SIDE, SIDE, true);
        for (int32_t k = 0; k < SIDE * SIDE; k++)
            owners[k / SIDE * ZR_TILE_STRIDE + k % SIDE] = k % SIDE < 3 ? 1 : 2;
        const zr_vec3 middle = middle_of_ray((float)tile.x + 2.5f, (float)tile.y, 5.0f);
        primitives[1] = (struct primitive){{0.5f, 0.5f, 0.5f}, turned(0), middle, 0};
        primitives[2] =
            (struct primitive){{0.5f, (float)(0.5 + pair->color), 0.5f}, turned(pair->degrees), middle, pair->material};
        primitives[2].through.z -= (float)(pair->pixels / PIXELS_PER_UNIT);
        find_and_join(isa, 0, &surfaces);
        if (surfaces.first[1] != (pair->is_joined ? 1 : 2)) fail_msg("%s: %u surfaces", pair->what, surfaces.first[1]);
        assert_int_equal(surfaces.samples[0], pair->is_joined ? 16 : 12);
    }
}

TEST_EACH_ISA(lines_join_nothing)
{
    const enum zr_isa isa = isa_under_test(state);
    begin(SIDE, SIDE, true);
    for (int32_t k = 0; k < SIDE * SIDE; k++)
        owners[k / SIDE * ZR_TILE_STRIDE + k % SIDE] = 1 + (uint32_t)k % SIDE;
    for (int owner = 1; owner <= SIDE; owner++) /* two lines, two faces */
        primitives[owner] = (struct primitive){{0.5f, 0.5f, 0.5f},
                                               owner <= 2 ? (zr_vec3){0, 0, 0} : turned(0),
                                               middle_of_ray((float)tile.x, (float)tile.y, 5.0f),
                                               0};
    find_and_join(isa, 0, &surfaces);
    assert_int_equal(surfaces.first[1], 3);
    for (uint32_t i = 0; i < 3; i++)
        for (int k = 0; k < 9; k++)
            assert_true(surfaces.floats[k][i] == surfaces.floats[k][i]);
}

/* ---- tiles ---- */

/* Shallow facets in patches of `patch` samples, few of which are holes or lines, or of another depth. */
static void make_facets(struct random *r, int32_t patch)
{
    uint32_t owner = 0;
    for (int32_t y = 0; y < tile.height; y += patch)
        for (int32_t x = 0; x < tile.width; x += patch) {
            struct primitive *p = &primitives[++owner];
            const float grey = (float)random_range(r, 0.5, 0.52), depth = random_below(r, 8) ? 4.0f : 5.0f;
            const zr_vec3 bent = {(float)random_range(r, -0.06, 0.06), (float)random_range(r, -0.06, 0.06), 1.0f};
            *p = (struct primitive){{grey, grey, 0.5f},
                                    zr_vec3_normalize(bent),
                                    middle_of_ray((float)(tile.x + x), (float)(tile.y + y), depth),
                                    random_below(r, 8) / 7};
            if (random_below(r, 16) == 0) p->normal = (zr_vec3){0, 0, 0};
            const uint32_t shown = random_below(r, 16) ? owner : 0;
            for (int32_t k = 0; k < patch * patch; k++)
                if (x + k % patch < tile.width && y + k / patch < tile.height)
                    owners[(y + k / patch) * ZR_TILE_STRIDE + x + k % patch] = shown;
        }
}

TEST_EACH_ISA(tiles_are_as_pixel_by_pixel)
{
    static const int32_t sizes[][2] = {{64, 64}, {4, 4}, {4, 60}, {60, 8}, {36, 52}};
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(31);
    struct sum sum = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int32_t patch = 1; patch <= 3; patch++)
            for (int is_parallel = 0; is_parallel < 2; is_parallel++) {
                begin(sizes[i][0], sizes[i][1], is_parallel);
                make_facets(&r, patch);
                compare_tile(isa, &sum);
            }
    print_message("%u pixels, %u undecided, %u surfaces, %u lists\n", sum.pixels, sum.undecided, sum.surfaces,
                  sum.lists);
    assert_true(sum.undecided * 100 < sum.pixels);
    assert_true(sum.lists > 5 * 6); /* of whole tiles, primitives of their own for each sample fill several */
}

/* ---- colours ---- */

TEST(colors_are_summed_by_samples)
{
    float sums[4][ZR_SURFACES_COLUMNS];
    float *const out[4] = {sums[0], sums[1], sums[2], sums[3]};
    begin(2 * SIDE, SIDE, true);
    for (int32_t k = 0; k < SIDE; k++)
        owners[k] = 1 + (k == 3); /* three samples of one, one of another; twelve uncovered */
    primitives[1] = (struct primitive){{1, 1, 1}, turned(0), {0, 0, -5}, 0};
    primitives[2] = (struct primitive){{1, 1, 1}, turned(40), {0, 0, -5}, 0};
    find_and_join(ZR_ISA_SCALAR, 0, &surfaces);
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < 2; i++)
            surfaces.color[k][i] = surfaces.list.owner[i] == 1 ? 0.5f : 1.0f;
    zr_surfaces_put(&surfaces, 0, out);
    for (int k = 0; k < 4; k++) {
        assert_true(sums[k][0] == (k < 3 ? 2.5f / 16.0f : 4.0f / 16.0f));
        assert_true(sums[k][1] == 0.0f);
    }
}

RUN_TESTS(NULL, NULL)
