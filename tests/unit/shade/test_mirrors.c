/* Mirrors: balls of smooth metal show the edges of the lights sharply, and blurred ones by roughness. */
#include "scene/scene.h"
#include "support/isas.h"
#include "unit/common/lit_samples.h"

enum { DIAMETER = 300 };

static struct lit_samples samples;
static struct zr_material metal;

/* Steepest edge of a row, and how wide it is: the difference within 8 pixels, by that of neighbours. */
struct edge {
    double step, width;
};

/* The row of the ball's pixels at height y, from -1 to 1. */
static size_t make_row(double y)
{
    size_t count = 0;
    samples_clear(&samples);
    for (int i = 0; i < DIAMETER; i++) {
        const double x = (i + 0.5) * 2 / DIAMETER - 1, square = 1 - x * x - y * y;
        if (square < 0.1) continue; /* reflections are narrow at the rim */
        const zr_vec3 normal = {(float)x, (float)y, (float)sqrt(square)};
        samples_set(&samples, count++, 0, (zr_vec3){1, 1, 1}, normal, normal);
    }
    return count;
}

static struct edge edge_of(size_t count)
{
    const float *light = samples.out[1];
    struct edge edge = {0, 0};
    for (size_t i = 8; i + 9 < count; i++) {
        const double step = fabs((double)(light[i + 1] - light[i]));
        double low = 1, high = 0;
        if (step <= edge.step) continue;
        for (size_t k = i - 8; k < i + 9; k++) {
            low = fmin(low, (double)light[k]);
            high = fmax(high, (double)light[k]);
        }
        edge = (struct edge){step, (high - low) / step};
    }
    return edge;
}

/* Returns the mean width of the steepest edges of rows through the lights. */
static double mean_width(enum zr_isa isa, enum zr_environment_name name, float roughness)
{
    struct zr_linear_lighting lighting = no_light(&metal);
    double sum = 0;
    int count = 0;
    metal = (struct zr_material){.shading = ZR_SHADING_PBR, ZR_MATERIAL_PLASTIC, .metallic = 1, .roughness = roughness};
    lighting.is_parallel = true;
    lighting.to_eye = (zr_vec3){0, 0, 1};
    lighting.has_environment = zr_environment_make(name, &lighting.environment);
    lighting.environment_intensity = 0.1f;
    for (double y = 0.2; y < 0.6; y += 0.02) {
        const size_t pixels = make_row(y);
        samples_light(&samples, isa, &lighting);
        const struct edge edge = edge_of(pixels);
        if (edge.step < 0.01) continue;
        sum += edge.width;
        count++;
    }
    assert_true(count > 10);
    return sum / count;
}

TEST_EACH_ISA(edges_are_two_pixels_wide)
{
    static const enum zr_environment_name names[] = {ZR_ENVIRONMENT_STUDIO, ZR_ENVIRONMENT_METAL};
    const enum zr_isa isa = isa_under_test(state);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const double smooth = mean_width(isa, names[i], 0), rough = mean_width(isa, names[i], 0.25f);
        print_message("%zu: %.2f, %.2f\n", i, smooth, rough);
        assert_true(smooth <= 2.0);
        assert_true(rough > 2.0 * smooth);
    }
}

/* ---- light from all around ---- */

static double step_of(double x, double w)
{
    return 0.5 + 0.5 * x / sqrt(x * x + w * w);
}

static double dot_of(const double a[3], zr_vec3 b)
{
    return a[0] * (double)b.x + a[1] * (double)b.y + a[2] * (double)b.z;
}

/* Green light of an environment from a direction, by the formulas of environment.h. */
static double radiance(const struct zr_environment_light *e, const double d[3])
{
    const double up = step_of(d[1], (double)e->half_width);
    double sum = (double)e->ground.y + ((double)e->sky.y - (double)e->ground.y) * up;
    for (uint32_t i = 0; i < e->box_count; i++) {
        const struct zr_environment_box *b = &e->boxes[i];
        const double u = dot_of(d, b->across), v = dot_of(d, b->along), a = (double)b->a, h = (double)b->h,
                     w = (double)b->w0;
        sum += (double)b->color.y * (step_of(u + a, w) - step_of(u - a, w)) * (step_of(v + h, w) - step_of(v - h, w)) *
               step_of(dot_of(d, b->middle), w);
    }
    for (uint32_t i = 0; i < e->lobe_count; i++) {
        const double w = (double)e->lobes[i].w0, s = 1 + 2 * (1 - dot_of(d, e->lobes[i].middle)) / (w * w);
        sum += (double)e->lobes[i].color.y / (s * s);
    }
    return sum;
}

static double harmonics_at(const struct zr_environment_light *e, const double n[3])
{
    const double f[ZR_HARMONICS] = {
        1, n[0], n[1], n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0], 3 * n[2] * n[2] - 1, n[0] * n[0] - n[1] * n[1]};
    double sum = 0;
    for (int i = 0; i < ZR_HARMONICS; i++)
        sum += f[i] * (double)e->harmonics[i].y;
    return sum;
}

/* Direction i of a spiral of `count` over the sphere. */
static void spiral(int i, int count, double out[3])
{
    const double z = 1 - (2 * i + 1.0) / count, angle = i * 2.399963229728653, r = sqrt(1 - z * z);
    out[0] = r * cos(angle), out[1] = z, out[2] = r * sin(angle);
}

/* E is the mean of L, weighted by the cosine; its polynomial is as close as one of order 2 can be. */
TEST(harmonics_are_those_of_the_lights)
{
    enum { DIRECTIONS = 20000, NORMALS = 100 };
    static double lights[DIRECTIONS], directions[DIRECTIONS][3];
    static const enum zr_environment_name names[] = {ZR_ENVIRONMENT_STUDIO, ZR_ENVIRONMENT_METAL,
                                                     ZR_ENVIRONMENT_OUTDOOR};
    for (size_t name = 0; name < sizeof names / sizeof *names; name++) {
        struct zr_environment_light e;
        double squares = 0;
        assert_true(zr_environment_make(names[name], &e));
        for (int i = 0; i < DIRECTIONS; i++) {
            spiral(i, DIRECTIONS, directions[i]);
            lights[i] = radiance(&e, directions[i]);
        }
        for (int k = 0; k < NORMALS; k++) {
            double n[3], sum = 0;
            spiral(k, NORMALS, n);
            for (int i = 0; i < DIRECTIONS; i++) {
                const double *d = directions[i], cosine = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
                sum += lights[i] * fmax(cosine, 0) * 4 / DIRECTIONS;
            }
            squares += (sum - harmonics_at(&e, n)) * (sum - harmonics_at(&e, n)) / NORMALS;
        }
        print_message("%zu: %.4f\n", name, sqrt(squares));
        assert_true(sqrt(squares) < 0.025);
    }
}

RUN_TESTS(NULL, NULL)
