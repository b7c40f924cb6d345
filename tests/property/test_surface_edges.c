/* Edges that are found only where surfaces end are those of all pairs of samples.
 *
 * A scene with a texture lights each sample and compares all pairs. So white unlit meshes are drawn twice, beside a
 * triangle out of sight that has a texture, or has none: all that is not white is ink. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "shade/frame.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

enum { SIZE = 120, PIXELS = SIZE * SIZE, ROOM = 1 << 18 };

#define WHITE                                                                                                          \
    "data:image/"                                                                                                      \
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg=="
#define PLAIN "\"shading\": \"unlit\", \"baseColorFactor\": \"#ffffff\", \"doubleSided\": true"

/* ---- meshes ---- */

struct text {
    size_t length;
    char bytes[ROOM];
};

static struct text mesh;

#define ADD(...) (mesh.length += (size_t)snprintf(mesh.bytes + mesh.length, ROOM - mesh.length, __VA_ARGS__))

/* Smooth if the crease angle is larger than 360 / columns. */
static void add_sphere(int columns, int rows, double x, double radius)
{
    const double pi = acos(-1.0);
    ADD(", {\"material\": \"plain\", \"positions\": [");
    for (int i = 0; i <= rows * columns + columns - 1; i++) {
        const double up = pi * (i / columns) / rows, around = 2.0 * pi * (i % columns) / columns;
        ADD("%s[%.6f, %.6f, %.6f]", i ? ", " : "", x + radius * sin(up) * cos(around), radius * cos(up),
            radius * sin(up) * sin(around));
    }
    ADD("], \"faces\": [");
    for (int i = 0; i < rows * columns; i++) {
        const int below = i + columns, next = i % columns == columns - 1 ? i + 1 - columns : i + 1;
        ADD("%s[%d, %d, %d], [%d, %d, %d]", i ? ", " : "", i, next, below, next, next + columns, below);
    }
    ADD("]}");
}

static void add_box(double x, double y, double z, double size)
{
    ADD(", {\"material\": \"plain\", \"positions\": [");
    for (int i = 0; i < 8; i++)
        ADD("%s[%.6f, %.6f, %.6f]", i ? ", " : "", x + (i & 1) * size, y + (i >> 1 & 1) * size, z + (i >> 2) * size);
    ADD("], \"faces\": [[4,5,7,6], [1,0,2,3], [5,1,3,7], [0,4,6,2], [6,7,3,2], [0,1,5,4]]}");
}

static void cubes(void)
{
    for (int i = 0; i < 5; i++)
        add_box(-1.5 + 0.55 * i, -0.9 + 0.3 * i, -0.4 * i, 0.7 + 0.1 * i);
}

static void spheres(void)
{
    add_sphere(48, 24, -0.5, 0.9);
    add_sphere(32, 16, 0.7, 0.7);
}

static void low_spheres(void)
{
    add_sphere(8, 4, -0.6, 0.9);
    add_sphere(6, 3, 0.8, 0.8);
}

/* Cubes whose fronts lie so many pixels behind one another. A pixel is 0.0268 wide here. */
static void add_steps(double pixels)
{
    for (int i = 0; i < 8; i++)
        add_box(-1.6 + 0.4 * i, -0.8, -i * pixels * 0.0268 - 0.4, 0.4);
}

static void high_steps(void)
{
    add_steps(0.40);
}

static void low_steps(void)
{
    add_steps(0.35);
}

/* ---- pictures ---- */

static void draw(bool all_pairs, const char *creases, uint8_t *ink)
{
    static char text[ROOM + 2000];
    struct zr_error error = {.status = ZR_OK};
    struct zr_arena arena;
    const struct zr_frame *frame;
    snprintf(
        text, sizeof text,
        "{\"version\": 1, \"look\": \"studio\", \"background\": \"#ffffff\", \"samples\": 16, \"occlusion\": false, "
        "\"groundShadow\": false, \"toneMapping\": \"none\", \"creaseDegrees\": %s, "
        "\"edges\": {\"color\": \"#000000\", \"creaseDegrees\": 30}, "
        "\"window\": {\"width\": %d, \"height\": %d}, \"view\": {\"eye\": [0.6, 0.8, 6], \"target\": [0, 0, 0], "
        "\"perspective\": {\"yfovDegrees\": 30}}, \"materials\": [{\"name\": \"plain\", " PLAIN
        "}, {\"name\": \"other\", " PLAIN "%s}], \"meshes\": [{\"material\": \"other\", \"positions\": "
        "[[0,0,20], [0.1,0,20], [0,0.1,20]], \"texcoords\": [[0,0], [1,0], [0,1]], \"faces\": [[0,1,2]]}%s]}",
        creases, SIZE, SIZE, all_pairs ? ", \"baseColorTexture\": {\"uri\": \"" WHITE "\"}" : "", mesh.bytes);
    struct reading *reading = read_scene(text);
    zr_arena_init(&arena, (size_t)1 << 28);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, reading->scene, NULL, &frame),
                     ZR_OK);
    for (size_t i = 0; i < PIXELS; i++)
        ink[i] = (uint8_t)(255 - frame->color[4 * i]);
    zr_arena_free(&arena);
    reading_free(reading);
}

/* ---- comparison ---- */

/* Pairs of samples are left out only within a surface of a pixel, and between pixels whose leading surfaces join.
 * There, normals are within 6 degrees of one of them, and within 12 of each other: no crease, which is 30 or more.
 * Points are within 1.5 samples of its plane, which is no silhouette. */
static const struct {
    const char *name;
    void (*add)(void);
    const char *creases;
} scenes[] = {{"cubes", cubes, "30"},
              {"spheres", spheres, "30"},
              {"low spheres, smooth", low_spheres, "80"},
              {"low spheres, facets", low_spheres, "20"},
              {"steps of more than 1.5 samples", high_steps, "30"},
              {"steps of less than 1.5 samples", low_steps, "30"}};

TEST(edges_are_those_of_all_pairs)
{
    static uint8_t all[PIXELS], ends[PIXELS];
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        uint32_t inked = 0, less = 0, more = 0;
        mesh.length = 0;
        scenes[s].add();
        draw(true, scenes[s].creases, all);
        draw(false, scenes[s].creases, ends);
        for (size_t i = 0; i < PIXELS; i++) {
            inked += all[i] > 0;
            less += ends[i] < all[i];
            more += ends[i] > all[i];
        }
        print_message("%s: %u inked pixels, %u have less ink, %u more\n", scenes[s].name, inked, less, more);
        assert_true(inked > PIXELS / 50 && more == 0 && less == 0);
    }
}

RUN_TESTS(NULL, NULL)
