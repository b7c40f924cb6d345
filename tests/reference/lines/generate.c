#include <math.h>
#include <stddef.h>

#include "geometry/outline.h"
#include "reference/lines/batch.h"

/* A corner at window position x, y (pixels), depth z in -1..1, with its w. */
static zr_vec4 at(const struct batch *batch, double x, double y, double z, double w)
{
    return (zr_vec4){(float)((x / batch->width * 2.0 - 1.0) * w), (float)((y / batch->height * 2.0 - 1.0) * w),
                     (float)(z * w), (float)w};
}

static double window_x(const struct batch *batch, zr_vec4 p)
{
    return ((double)p.x / (double)p.w + 1.0) * 0.5 * batch->width;
}

static double window_y(const struct batch *batch, zr_vec4 p)
{
    return ((double)p.y / (double)p.w + 1.0) * 0.5 * batch->height;
}

/* Positions in steps of `step` pixels, shifted. */
static zr_vec4 on_grid(struct random *r, const struct batch *batch, double step, double shift_x, double shift_y)
{
    double x = floor(random_range(r, 0, batch->width / step)) * step + shift_x;
    double y = floor(random_range(r, 0, batch->height / step)) * step + shift_y;
    double z = random_range(r, -1, 1);
    return at(batch, x < batch->width ? x : 0, y < batch->height ? y : 0, z, 1);
}

static zr_vec4 anywhere(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    double x = random_range(r, 0, batch->width), y = random_range(r, 0, batch->height), z = random_range(r, -1, 1);
    return at(batch, x, y, z, 1);
}

static zr_vec4 along_axis(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    zr_vec4 p = anywhere(r, batch, NULL);
    switch (first ? random_below(r, 3) : 3) {
    case 0:
        p.x = first->x;
        break;
    case 1:
        p.y = first->y;
        break;
    default:
        break;
    }
    return p;
}

/* The same on a grid, where ends meet the borders and centres of pixels. */
static zr_vec4 along_grid(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    zr_vec4 p = on_grid(r, batch, random_below(r, 2) ? 0.5 : 0.25, 0, 0);
    if (first && random_below(r, 2))
        p.x = first->x;
    else if (first)
        p.y = first->y;
    return p;
}

static zr_vec4 diagonal(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    static const double steps[] = {1, 0.5, 0.25, 1.0 / 256};
    if (!first) return on_grid(r, batch, steps[random_below(r, 4)], 0, 0);
    double x = window_x(batch, *first), y = window_y(batch, *first), step = steps[random_below(r, 4)];
    double d = floor(random_range(r, -60, 60) / step) * step, z = random_range(r, -1, 1);
    double ey = random_below(r, 2) ? d : -d;
    bool inside = x + d >= 0 && x + d <= batch->width && y + ey >= 0 && y + ey <= batch->height;
    return inside ? at(batch, x + d, y + ey, z, 1) : *first;
}

static zr_vec4 centres(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    return on_grid(r, batch, 1, 0.5, 0.5);
}

static zr_vec4 pixel_corners(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    return on_grid(r, batch, 1, 0, 0);
}

static zr_vec4 midpoints(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    uint32_t vertical = random_below(r, 2);
    return on_grid(r, batch, 1, vertical ? 0 : 0.5, vertical ? 0.5 : 0);
}

/* Down to half a subpixel, where snapping has ties. */
static zr_vec4 subpixels(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    static const double steps[] = {1.0 / 512, 1.0 / 256, 0.125, 0.25, 0.5};
    return on_grid(r, batch, steps[random_below(r, 5)], 0, 0);
}

/* A few floats beside a special place. */
static zr_vec4 beside(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    zr_vec4 p = on_grid(r, batch, random_below(r, 2) ? 0.5 : 0.25, 0, 0);
    for (uint32_t k = random_below(r, 3); k > 0; k--)
        p.x = nextafterf(p.x, 0.0f);
    for (uint32_t k = random_below(r, 3); k > 0; k--)
        p.y = nextafterf(p.y, 0.0f);
    return p;
}

static zr_vec4 near_first(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    static const double steps[] = {1.0 / 4096, 1.0 / 256, 0.125, 0.5};
    if (!first) return random_below(r, 2) ? anywhere(r, batch, NULL) : on_grid(r, batch, 0.25, 0, 0);
    double step = steps[random_below(r, 4)], reach = random_below(r, 2) ? 1 : 0.25;
    double dx = floor(random_range(r, -reach, reach) / step) * step;
    double dy = floor(random_range(r, -reach, reach) / step) * step, z = random_range(r, -1, 1);
    double x = window_x(batch, *first) + dx, y = window_y(batch, *first) + dy;
    bool inside = x >= 0 && x <= batch->width && y >= 0 && y <= batch->height;
    return inside ? at(batch, x, y, z, 1) : *first;
}

static zr_vec4 same_place(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    if (!first || random_below(r, 4) == 0) return subpixels(r, batch, NULL);
    zr_vec4 p = *first;
    if (random_below(r, 2)) p.z = (float)random_range(r, -1, 1);
    return p;
}

/* From one place in all directions. */
static zr_vec4 star(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    if (!first) return at(batch, floor(batch->width / 2.0) + 0.5, floor(batch->height / 2.0) + 0.5, 0, 1);
    return on_grid(r, batch, 1, 0.5 * random_below(r, 2), 0.5 * random_below(r, 2));
}

static double any_w(struct random *r)
{
    return ldexp(random_range(r, 1, 2), (int)random_below(r, 9) - 4);
}

static zr_vec4 perspective(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    double x = random_range(r, 0, batch->width), y = random_range(r, 0, batch->height);
    double z = random_range(r, -1, 1), w = any_w(r);
    return at(batch, x, y, z, w);
}

static zr_vec4 far_outside(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    double reach = ldexp(1, (int)random_below(r, 6)), w = any_w(r);
    double x = random_range(r, -reach, reach + 1) * batch->width;
    double y = random_range(r, -reach, reach + 1) * batch->height, z = random_range(r, -1, 1);
    return at(batch, x, y, z, w);
}

static zr_vec4 one_plane(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    zr_vec4 p = perspective(r, batch, first);
    if (!first || random_below(r, 2)) return p;
    float side = random_below(r, 2) ? 1.0f : -1.0f, d = (float)random_range(r, 1, 3) * p.w;
    switch (random_below(r, 3)) {
    case 0:
        p.x = side * d;
        break;
    case 1:
        p.y = side * d;
        break;
    default:
        p.z = side * d;
    }
    return p;
}

static zr_vec4 all_planes(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    (void)batch;
    float w = (float)any_w(r), reach = random_below(r, 2) ? 1.3f : 4.0f;
    float x = (float)random_range(r, -1, 1), y = (float)random_range(r, -1, 1), z = (float)random_range(r, -1, 1);
    return (zr_vec4){x * w * reach, y * w * reach, z * w * reach, w};
}

static zr_vec4 behind_eye(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    zr_vec4 p = all_planes(r, batch, first);
    if (random_below(r, 2)) p.w = -p.w;
    return p;
}

/* On the border of the view volume, where cuts are of length 0. */
static zr_vec4 on_planes(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    zr_vec4 p = all_planes(r, batch, first);
    float *c[3] = {&p.x, &p.y, &p.z};
    uint32_t axis = random_below(r, 3);
    *c[axis] = random_below(r, 2) ? p.w : -p.w;
    if (random_below(r, 4) == 0) *c[axis] = nextafterf(*c[axis], random_below(r, 2) ? 1e9f : 0.0f);
    return p;
}

/* Edges that meet the borders of the window in pixel centres and corners. */
static zr_vec4 outside_on_grid(struct random *r, const struct batch *batch, const zr_vec4 *first)
{
    (void)first;
    double step = random_below(r, 2) ? 0.5 : 8;
    double x = floor(random_range(r, -0.5, 1.5) * batch->width / step) * step;
    double y = floor(random_range(r, -0.5, 1.5) * batch->height / step) * step;
    return at(batch, x, y, random_range(r, -1, 1), 1);
}

const struct placing placings[] = {
    {"anywhere", false, anywhere},
    {"along-axis", false, along_axis},
    {"along-grid", true, along_grid},
    {"diagonal", true, diagonal},
    {"centres", true, centres},
    {"pixel-corners", true, pixel_corners},
    {"midpoints", true, midpoints},
    {"subpixels", true, subpixels},
    {"beside", true, beside},
    {"short", true, near_first},
    {"no-length", true, same_place},
    {"star", true, star},
    {"perspective", false, perspective},
    {"far-outside", false, far_outside},
    {"one-plane", false, one_plane},
    {"all-planes", false, all_planes},
    {"behind-eye", false, behind_eye},
    {"on-planes", false, on_planes},
    {"outside-on-grid", true, outside_on_grid},
};
const uint32_t placing_count = sizeof placings / sizeof *placings;

/* Scattered over 24 bits, so that neighbours differ in all channels; 8 bits a channel hold it exactly. */
zr_vec4 batch_color(uint32_t number)
{
    uint32_t c = (number * 0x9e3779u) & 0xffffffu;
    return (zr_vec4){(float)(c & 255u) / 255.0f, (float)(c >> 8 & 255u) / 255.0f, (float)(c >> 16) / 255.0f, 1.0f};
}

static void choose_window(struct batch *batch, bool binary, struct random *r)
{
    if (binary) {
        batch->width = 32u << random_below(r, 4);
        batch->height = 32u << random_below(r, 4);
    } else {
        batch->width = 40 + random_below(r, BATCH_SIDE - 39);
        batch->height = 40 + random_below(r, BATCH_SIDE - 39);
    }
}

static void choose_state(struct batch *batch, struct random *r)
{
    static const float factors[] = {1, 0, 2.5f, -1, 0.3f}, units[] = {1, 0, 3, -2, 1000};
    batch->smooth = random_below(r, 2);
    batch->chain = random_below(r, 2) ? CHAIN_STRIP : CHAIN_LOOP;
    batch->sided = batch->mode == BATCH_OUTLINES && random_below(r, 6) == 0;
    batch->faces = ZR_SIDE_BOTH;
    if (batch->mode == BATCH_OUTLINES && random_below(r, 3) == 0)
        batch->faces = random_below(r, 2) ? ZR_SIDE_FRONT : ZR_SIDE_BACK;
    batch->factor = factors[random_below(r, 5)];
    batch->units = units[random_below(r, 5)];
}

static uint32_t corners_of(enum batch_mode mode, struct random *r)
{
    if (mode == BATCH_LINES && random_below(r, 8)) return 2;
    if (mode == BATCH_FILLED || random_below(r, 2)) return 3;
    return 3 + random_below(r, BATCH_CORNERS - 2);
}

void batch_generate(struct batch *batch, enum batch_mode mode, const struct placing *placing, struct random *r)
{
    batch->mode = mode;
    choose_window(batch, placing->binary_window, r);
    choose_state(batch, r);
    batch->count = 20 + random_below(r, mode == BATCH_LINES ? BATCH_PRIMITIVES - 19 : 60);
    uint32_t corner = 0;
    for (uint32_t i = 0; i < batch->count; i++) {
        batch->offsets[i] = corner;
        const zr_vec4 *first = NULL;
        for (uint32_t k = corners_of(mode, r); k > 0; k--) {
            batch->positions[corner] = placing->corner(r, batch, first);
            if (!first) first = &batch->positions[corner];
            float red = (float)random_range(r, 0, 1), green = (float)random_range(r, 0, 1);
            float blue = (float)random_range(r, 0, 1);
            uint32_t number = mode == BATCH_LINES ? corner : i;
            batch->colors[corner++] = batch->smooth ? (zr_vec4){red, green, blue, 1.0f} : batch_color(number + 1);
        }
    }
    batch->offsets[batch->count] = corner;
}
