#include "bench/simulator_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/texels.h"
#include "bench/versus/stock_png.h"
#include "support/input/base64.h"
#include "support/random.h"

enum { IMAGE_SIDE = 256, SEGMENTS = 16, BALL_ROWS = 12, COLUMNS = 8, SEED = 3 };

static const double PI = 3.14159265358979323846;

/* ---- meshes ---- */

enum { VERTICES_MAX = 256, TRIANGLES_MAX = 512 };

struct solid {
    const char *name, *material;
    int vertex_count, triangle_count;
    double positions[VERTICES_MAX][3], normals[VERTICES_MAX][3], texcoords[VERTICES_MAX][2];
    int triangles[TRIANGLES_MAX][3];
};

static void add_triangle(struct solid *solid, int a, int b, int c)
{
    int *triangle = solid->triangles[solid->triangle_count++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

static void add_vertex(struct solid *solid, const double position[3], const double normal[3], double u, double v)
{
    const int i = solid->vertex_count++;
    for (int k = 0; k < 3; k++) {
        solid->positions[i][k] = position[k];
        solid->normals[i][k] = normal[k];
    }
    solid->texcoords[i][0] = u;
    solid->texcoords[i][1] = v;
}

/* A point of an outline that is turned around y: how far from the axis, how high, and the same of its normal. */
struct profile {
    double radius, height, normal_radius, normal_height;
};

/* A band between two points of the outline, from above. What has no width on the axis is no triangle. */
static void add_band(struct solid *solid, struct profile above, struct profile below, double v0, double v1)
{
    const struct profile rows[2] = {above, below};
    const int first = solid->vertex_count;
    for (int i = 0; i <= SEGMENTS; i++)
        for (int row = 0; row < 2; row++) {
            const double angle = 2 * PI * (i % SEGMENTS) / SEGMENTS, c = cos(angle), s = sin(angle);
            const struct profile *p = &rows[row];
            add_vertex(solid, (double[]){p->radius * c, p->height, -p->radius * s},
                       (double[]){p->normal_radius * c, p->normal_height, -p->normal_radius * s}, 2.0 * i / SEGMENTS,
                       row == 0 ? v0 : v1);
        }
    for (int i = 0, a = first; i < SEGMENTS; i++, a += 2) {
        if (below.radius > 0) add_triangle(solid, a, a + 1, a + 3);
        if (above.radius > 0) add_triangle(solid, a, a + 3, a + 2);
    }
}

static void make_cylinder(struct solid *solid)
{
    *solid = (struct solid){.name = "cylinder", .material = "stripes"};
    add_band(solid, (struct profile){0, 1, 0, 1}, (struct profile){1, 1, 0, 1}, 0, 0.25);
    add_band(solid, (struct profile){1, 1, 1, 0}, (struct profile){1, -1, 1, 0}, 0.25, 0.75);
    add_band(solid, (struct profile){1, -1, 0, -1}, (struct profile){0, -1, 0, -1}, 0.75, 1);
}

/* A grid, closed around y. */
static void make_ball(struct solid *solid)
{
    *solid = (struct solid){.name = "ball", .material = "clouds"};
    for (int row = 0; row <= BALL_ROWS; row++)
        for (int i = 0; i <= SEGMENTS; i++) {
            const double angle = 2 * PI * (i % SEGMENTS) / SEGMENTS, down = PI * row / BALL_ROWS;
            const double radius = row % BALL_ROWS == 0 ? 0 : sin(down);
            const double place[3] = {radius * cos(angle), cos(down), -radius * sin(angle)};
            add_vertex(solid, place, place, 2.0 * i / SEGMENTS, (double)row / BALL_ROWS);
        }
    for (int row = 0; row < BALL_ROWS; row++)
        for (int i = 0; i < SEGMENTS; i++) {
            const int a = row * (SEGMENTS + 1) + i, below = a + SEGMENTS + 1;
            if (row < BALL_ROWS - 1) add_triangle(solid, a, below, below + 1);
            if (row > 0) add_triangle(solid, a, below + 1, a + 1);
        }
}

/* Around the middle, `along` leading to the right and `up` up on it. */
static void add_square(struct solid *solid, const double middle[3], const double along[3], const double up[3],
                       const double normal[3], double repeats)
{
    const int first = solid->vertex_count;
    for (int i = 0; i < 4; i++) {
        const double x = i == 1 || i == 2 ? 1 : -1, y = i >= 2 ? 1 : -1;
        double place[3];
        for (int k = 0; k < 3; k++)
            place[k] = middle[k] + x * along[k] + y * up[k];
        add_vertex(solid, place, normal, repeats * (x + 1) / 2, repeats * (1 - y) / 2);
    }
    add_triangle(solid, first, first + 1, first + 2);
    add_triangle(solid, first, first + 2, first + 3);
}

static void make_box(struct solid *solid)
{
    *solid = (struct solid){.name = "box", .material = "stripes"};
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2;
        double normal[3] = {0}, along[3] = {0}, up[3] = {0};
        normal[axis] = side % 2 ? -1 : 1;
        along[(axis + 1) % 3] = normal[axis];
        up[(axis + 2) % 3] = 1;
        add_square(solid, normal, along, up, normal, 1);
    }
}

static void make_ground(struct solid *solid)
{
    *solid = (struct solid){.name = "ground", .material = "squares"};
    add_square(solid, (double[]){0, 0, 0}, (double[]){10, 0, 0}, (double[]){0, 0, -10}, (double[]){0, 1, 0}, 4);
}

/* ---- JSON ---- */

static void print_rows(FILE *out, const char *key, const double *values, int rows, int width)
{
    fprintf(out, ",\"%s\":[", key);
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < width; k++)
            fprintf(out, "%s%.6g%s", k == 0 ? i ? ",[" : "[" : ",", values[width * i + k], k == width - 1 ? "]" : "");
    fputs("]", out);
}

static void print_solid(FILE *out, const struct solid *solid)
{
    fprintf(out, "{\"name\":\"%s\",\"material\":\"%s\"", solid->name, solid->material);
    print_rows(out, "positions", solid->positions[0], solid->vertex_count, 3);
    print_rows(out, "normals", solid->normals[0], solid->vertex_count, 3);
    print_rows(out, "texcoords", solid->texcoords[0], solid->vertex_count, 2);
    fputs(",\"faces\":[", out);
    for (int i = 0; i < solid->triangle_count; i++)
        fprintf(out, "%s[%d,%d,%d]", i ? "," : "", solid->triangles[i][0], solid->triangles[i][1],
                solid->triangles[i][2]);
    fputs("]}", out);
}

static bool print_material(FILE *out, const char *name, enum texels kind)
{
    struct stock_file file = {NULL, 0, 0};
    uint8_t *texels = texels_make(kind, IMAGE_SIDE);
    const struct stock_image image = {.pixels = STOCK_RGBX, .width = IMAGE_SIDE, .height = IMAGE_SIDE, .bytes = texels};
    char *uri = NULL;
    if (texels && stock_png_write(&image, &file)) uri = base64_of("data:image/png;base64,", file.bytes, file.size);
    if (uri)
        fprintf(out,
                "{\"name\":\"%s\",\"specular\":[0.2,0.2,0.2],\"baseColorFactor\":[1,1,1,1],"
                "\"baseColorTexture\":{\"uri\":\"%s\"}}",
                name, uri);
    free(texels);
    free(file.bytes);
    free(uri);
    return uri;
}

static bool print_materials(FILE *out)
{
    fputs("\"materials\":[", out);
    if (!print_material(out, "squares", TEXELS_SQUARES)) return false;
    fputs(",", out);
    if (!print_material(out, "stripes", TEXELS_STRIPES)) return false;
    fputs(",", out);
    if (!print_material(out, "clouds", TEXELS_CLOUDS)) return false;
    fputs("]", out);
    return true;
}

static void print_meshes(FILE *out)
{
    static void (*const make[])(struct solid * solid) = {make_ground, make_ball, make_box, make_cylinder};
    static struct solid solid;
    fputs(",\"meshes\":[", out);
    for (size_t i = 0; i < sizeof make / sizeof *make; i++) {
        make[i](&solid);
        if (i > 0) fputs(",", out);
        print_solid(out, &solid);
    }
    fputs("]", out);
}

/* Rows of objects that stand on the ground, each turned around y. */
static void print_nodes(FILE *out)
{
    static const char *const names[] = {"ball", "box", "cylinder"};
    struct random random = random_seeded(SEED);
    fputs(",\"nodes\":[{\"mesh\":\"ground\"}", out);
    for (int i = 0; i < SIMULATOR_OBJECTS; i++) {
        const double size = random_range(&random, 0.35, 0.6), half_turn = random_range(&random, 0, PI);
        const double x = 1.6 * (i % COLUMNS - 0.5 * (COLUMNS - 1)) + random_range(&random, -0.2, 0.2);
        const double z = 2.2 * (i / COLUMNS - 1.5) + random_range(&random, -0.4, 0.4);
        fprintf(out,
                ",{\"mesh\":\"%s\",\"translation\":[%.4g,%.4g,%.4g],\"rotation\":[0,%.4g,0,%.4g],"
                "\"scale\":[%.4g,%.4g,%.4g]}",
                names[i % 3], x, size, z, sin(half_turn), cos(half_turn), size, size, size);
    }
    fputs("]", out);
}

struct document simulator_scene_make(void)
{
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fprintf(out, "{\"window\":{\"width\":%d,\"height\":%d},\"shading\":\"phong\",\"background\":\"#000000\",",
            SIMULATOR_WINDOW, SIMULATOR_WINDOW);
    fputs("\"view\":{\"eye\":[5,6,8],\"target\":[0,0.3,0],\"perspective\":{\"yfovDegrees\":50},\"znear\":0.1,"
          "\"zfar\":50},\"lights\":[{\"type\":\"directional\",\"direction\":[-2,-4,-1],\"intensity\":0.6},"
          "{\"type\":\"directional\",\"direction\":[3,-2,-2],\"intensity\":0.3}],"
          "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\"},{\"channel\":\"instanceId\"}],",
          out);
    bool ok = print_materials(out);
    print_meshes(out);
    print_nodes(out);
    fputs("}", out);
    ok = fclose(out) == 0 && ok;
    if (ok) return document;
    free(document.bytes);
    return (struct document){NULL, 0};
}
