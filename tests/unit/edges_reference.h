/* edges_reference.h - tests: pictures of samples, and their edges by a plain search, sample by sample, in double. */
#ifndef ZR_TESTS_EDGES_REFERENCE_H
#define ZR_TESTS_EDGES_REFERENCE_H

#include <math.h>
#include <string.h>

#include "effects/edges.h"
#include "support/random.h"

static struct random dice = {{RANDOM_STATE_1}};

static float between(double low, double high)
{
    return (float)random_range(&dice, low, high);
}

/* ---- pictures: planes, spheres' normals, lines and holes, one over the other ---- */

enum { MOST = 512 }; /* samples a row */

struct sample {
    uint32_t owner;
    zr_vec3 normal, point;
};

struct picture {
    uint32_t width, height, side;
    int columns, rows;
    struct zr_edges edges;
    struct zr_pixel_scale scale;
    struct sample samples[MOST * MOST]; /* [row * MOST + column] */
};

static struct picture picture;

static void begin_picture(uint32_t width, uint32_t height, uint32_t side, bool is_parallel)
{
    picture.width = width, picture.height = height, picture.side = side;
    picture.columns = (int)(width * side), picture.rows = (int)(height * side);
    picture.edges = (struct zr_edges){.is_on = true, .width = 1.5f, .crease_degrees = 30.0f};
    /* 20 pixels a unit; of a perspective, at a depth of 1 */
    picture.scale = (struct zr_pixel_scale){20.0f, {0.0f, 0.0f, is_parallel ? 0.0f : -1.0f}, is_parallel ? 1.0f : 0.0f};
    const struct sample nobody = {0, {0, 0, 0}, {1e18f, 1e18f, 1e18f}};
    for (int i = 0; i < MOST * MOST; i++)
        picture.samples[i] = nobody;
}

static zr_vec3 any_normal(void)
{
    const float x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(0.5, 1.0);
    return zr_vec3_normalize((zr_vec3){x, y, z});
}

/* Where the ray of a sample meets the plane through the middle of its own depth. */
static zr_vec3 point_on(int x, int y, zr_vec3 normal, float depth)
{
    const float step = 1.0f / (20.0f * (float)picture.side);
    const float u = ((float)(x - picture.columns / 2) + 0.5f) * step;
    const float v = ((float)(y - picture.rows / 2) + 0.5f) * step;
    if (picture.scale.offset > 0.0f) return (zr_vec3){u, v, -depth - (normal.x * u + normal.y * v) / normal.z};
    const float t = depth * normal.z / (normal.z - normal.x * u - normal.y * v);
    return (zr_vec3){u * t, v * t, -t};
}

enum kind { PLANE, BALL, LINE, HOLE, KINDS };

struct patch {
    enum kind kind;
    uint32_t owner;
    int left, bottom, right, top;
    zr_vec3 normal;
    float depth;
};

static void draw_sample(const struct patch *patch, int x, int y)
{
    const float u = 1.6f * (float)(x - patch->left) / (float)(patch->right - patch->left) - 0.8f;
    const float v = 1.6f * (float)(y - patch->bottom) / (float)(patch->top - patch->bottom) - 0.8f;
    struct sample *sample = &picture.samples[y * MOST + x];
    *sample = (struct sample){patch->owner, patch->normal, point_on(x, y, patch->normal, patch->depth)};
    if (patch->kind == BALL) sample->normal = zr_vec3_normalize((zr_vec3){u, v, 0.5f});
    if (patch->kind == LINE) sample->normal = (zr_vec3){0, 0, 0};
    if (patch->kind == HOLE) *sample = (struct sample){0, {0, 0, 0}, {1e18f, 1e18f, 1e18f}};
}

static void draw_patch(const struct patch *patch)
{
    for (int y = patch->bottom; y < patch->top && y < picture.rows; y++)
        for (int x = patch->left; x < patch->right && x < picture.columns; x++)
            draw_sample(patch, x, y);
}

static void draw_patches(int count)
{
    for (int i = 0; i < count; i++) {
        struct patch patch = {.kind = (enum kind)random_below(&dice, KINDS), .owner = (uint32_t)i + 1};
        const uint32_t most = random_below(&dice, 3) ? 100 : 5;
        patch.left = (int)random_below(&dice, (uint32_t)picture.columns);
        patch.bottom = (int)random_below(&dice, (uint32_t)picture.rows);
        patch.right = patch.left + 1 + (int)random_below(&dice, most);
        patch.top = patch.bottom + 1 + (int)random_below(&dice, most);
        patch.normal = any_normal();
        patch.depth = between(4.0, 4.5);
        draw_patch(&patch);
    }
}

/* ---- the reference ---- */

enum { SILHOUETTE = 1, CREASE = 2 };

struct vec {
    double x, y, z;
};

static struct vec wide(zr_vec3 v)
{
    return (struct vec){(double)v.x, (double)v.y, (double)v.z};
}

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double sample_width(struct vec point)
{
    const struct vec slope = {(double)picture.scale.slope[0], (double)picture.scale.slope[1],
                              (double)picture.scale.slope[2]};
    const double pixels = (double)picture.scale.scale / (dot(slope, point) + (double)picture.scale.offset);
    return 1.0 / (pixels * picture.side);
}

static int unsure; /* comparisons that floats may decide otherwise */

static bool is_less(double a, double b)
{
    unsure += fabs(a - b) < 4e-6;
    return a < b;
}

static int reference_pair(const struct sample *a, const struct sample *b)
{
    if (!a->owner || !b->owner) return a->owner || b->owner ? SILHOUETTE : 0;
    const struct vec n1 = wide(a->normal), n2 = wide(b->normal), p1 = wide(a->point), p2 = wide(b->point);
    if (dot(n1, n1) < 0.5 || dot(n2, n2) < 0.5) return 0;
    const struct vec way = {p2.x - p1.x, p2.y - p1.y, p2.z - p1.z};
    const double distance = fmin(fabs(dot(way, n1)), fabs(dot(way, n2)));
    const double cosine = cos((double)picture.edges.crease_degrees * 3.14159265358979323846 / 180.0);
    if (is_less(1.5 * fmax(sample_width(p1), sample_width(p2)), distance)) return SILHOUETTE;
    return is_less(dot(n1, n2), cosine) ? CREASE : 0;
}

static unsigned char found[MOST * MOST];

static void reference_marks(void)
{
    memset(found, 0, sizeof found);
    unsure = 0;
    for (int y = 0; y < picture.rows; y++)
        for (int x = 0; x < picture.columns; x++)
            for (int up = 0; up < 2; up++) {
                if (up ? y + 1 == picture.rows : x + 1 == picture.columns) continue;
                const int i = y * MOST + x, j = up ? i + MOST : i + 1;
                const int marks = reference_pair(&picture.samples[i], &picture.samples[j]);
                found[i] |= (unsigned char)marks;
                found[j] |= (unsigned char)marks;
            }
}

static bool has_crease(int px, int py)
{
    const int side = (int)picture.side;
    for (int y = py * side; y < (py + 1) * side; y++)
        for (int x = px * side; x < (px + 1) * side; x++)
            if (found[y * MOST + x] & CREASE) return true;
    return false;
}

static void drop_creases(int px, int py)
{
    const int side = (int)picture.side;
    for (int y = py * side; y < (py + 1) * side; y++)
        for (int x = px * side; x < (px + 1) * side; x++)
            found[y * MOST + x] &= SILHOUETTE;
}

/* Pixels with creases are visited breadth first, then dropped where their box is small. */
static void reference_speck(int first, unsigned char *visited)
{
    static int members[MOST * MOST];
    int count = 1, left = first % MOST, right = left, bottom = first / MOST, top = bottom;
    members[0] = first;
    visited[first] = 1;
    for (int k = 0; k < count; k++) {
        const int x = members[k] % MOST, y = members[k] / MOST;
        left = x < left ? x : left, right = x > right ? x : right;
        bottom = y < bottom ? y : bottom, top = y > top ? y : top;
        for (int j = y - 1; j <= y + 1; j++)
            for (int i = x - 1; i <= x + 1; i++) {
                if (i < 0 || j < 0 || i >= (int)picture.width || j >= (int)picture.height) continue;
                if (visited[j * MOST + i] || !has_crease(i, j)) continue;
                visited[j * MOST + i] = 1;
                members[count++] = j * MOST + i;
            }
    }
    if (right - left < 12 && top - bottom < 12)
        for (int k = 0; k < count; k++)
            drop_creases(members[k] % MOST, members[k] / MOST);
}

static void reference_specks(void)
{
    static unsigned char visited[MOST * MOST];
    memset(visited, 0, sizeof visited);
    for (int y = 0; y < (int)picture.height; y++)
        for (int x = 0; x < (int)picture.width; x++)
            if (!visited[y * MOST + x] && has_crease(x, y)) reference_speck(y * MOST + x, visited);
}

static unsigned char covered[MOST * MOST];

static void reference_disc(int x, int y, unsigned char marks)
{
    const double wanted = 0.5 * (double)picture.edges.width * picture.side - 0.5, radius = wanted > 0.0 ? wanted : 0.0;
    const int reach = (int)radius + 1;
    for (int j = y - reach; j <= y + reach; j++)
        for (int i = x - reach; i <= x + reach; i++)
            if (i >= 0 && j >= 0 && i < picture.columns && j < picture.rows &&
                (double)((i - x) * (i - x) + (j - y) * (j - y)) <= radius * radius)
                covered[j * MOST + i] |= marks;
}

static double reference_opacity(uint32_t px, uint32_t py)
{
    const uint32_t side = picture.side;
    double sum = 0.0;
    for (uint32_t y = py * side; y < (py + 1) * side; y++)
        for (uint32_t x = px * side; x < (px + 1) * side; x++)
            sum += covered[y * MOST + x] & SILHOUETTE ? 1.0 : covered[y * MOST + x] & CREASE ? 0.85 : 0.0;
    return sum / (side * side);
}

/* False where it is not certain what floats must find. */
static bool reference_picture(void)
{
    reference_marks();
    if (unsure) return false;
    reference_specks();
    memset(covered, 0, sizeof covered);
    for (int y = 0; y < picture.rows; y++)
        for (int x = 0; x < picture.columns; x++)
            if (found[y * MOST + x]) reference_disc(x, y, found[y * MOST + x]);
    return true;
}

#endif
