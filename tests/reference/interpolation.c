#include "reference/interpolation.h"

#include "geometry/viewport.h"

static const double unit = 0x1p-24;

/* ---- corners ---- */

/* The one that draws the corner. */
static const struct reference_batch *batch_of(const struct reference_arrays *arrays, uint32_t corner)
{
    uint32_t low = 0, high = arrays->batch_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (arrays->batches[middle].first <= corner)
            low = middle;
        else
            high = middle;
    }
    return &arrays->batches[low];
}

static void raise(double *most, double value)
{
    if (value > *most) *most = value;
}

/* The largest that sums come to on the way through the matrix: it and what it is applied to have lost their signs. */
static void reach_through(const zr_mat4 *m, const double in[4], double out[4])
{
    for (int row = 0; row < 4; row++) {
        out[row] = 0.0;
        for (int k = 0; k < 4; k++)
            out[row] += fabs((double)m->m[4 * k + row]) * in[k];
    }
}

static void reach_corner(struct interpolation *p, const struct reference_batch *batch, zr_vec4 at, zr_vec4 texcoord)
{
    const double object[4] = {fabs((double)at.x), fabs((double)at.y), fabs((double)at.z), fabs((double)at.w)};
    double world[4], eye[4], clip[4];
    reach_through(batch->to_world, object, world);
    reach_through(p->world_to_eye, world, eye);
    reach_through(&p->arrays->projection, eye, clip);
    const double shares[4] = {eye[3], eye[3], eye[3], eye[3]};
    const double place[4] = {fabs((double)texcoord.x), fabs((double)texcoord.y), 0.0, 1.0};
    const double *const ways[INTERPOLATION_OF_COUNT] = {eye, world, object, shares, place}; /* as the enum has them */
    for (int k = 0; k < 3; k++)
        raise(&p->reach, ways[p->of][k]);
    raise(&p->reach_w, ways[p->of][3]);
    raise(&p->reach_clip, fmax(clip[3], fmax(clip[0], clip[1])));
}

static zr_vec4 value_of(const struct interpolation *p, const struct reference_batch *batch, zr_vec4 at,
                        zr_vec4 texcoord, int corner)
{
    const float w = zr_mat4_apply(batch->modelview, at).w;
    switch (p->of) {
    case INTERPOLATION_EYE:
        return zr_mat4_apply(batch->modelview, at);
    case INTERPOLATION_WORLD:
        return zr_mat4_apply(batch->to_world, at);
    case INTERPOLATION_SHARES:
        return (zr_vec4){corner == 0 ? w : 0.0f, corner == 1 ? w : 0.0f, corner == 2 ? w : 0.0f, w};
    case INTERPOLATION_TEXCOORD:
        return (zr_vec4){texcoord.x, texcoord.y, 0.0f, 1.0f};
    default:
        return at;
    }
}

/* ---- pieces ---- */

/* One without an area is left out. */
static void add_piece(struct interpolation *p, const struct zr_window_vertex *const v[3],
                      const zr_vec4 *const values[3])
{
    struct interpolation_piece *piece = &p->pieces[p->count];
    double longest = 0.0;
    piece->most_over_w = 0.0;
    for (int i = 0; i < 3; i++) {
        const double oow = (double)v[i]->oow;
        const float in[4] = {values[i]->x, values[i]->y, values[i]->z, values[i]->w};
        piece->x[i] = (double)v[i]->x;
        piece->y[i] = (double)v[i]->y;
        raise(&piece->most_over_w, fabs(oow));
        for (int k = 0; k < 4; k++)
            piece->over_w[i][k] = (double)in[k] * oow;
    }
    for (int i = 0; i < 3; i++)
        raise(&longest, hypot(piece->x[i] - piece->x[(i + 1) % 3], piece->y[i] - piece->y[(i + 1) % 3]));
    const double *x = piece->x, *y = piece->y;
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    piece->height = longest > 0.0 ? fabs(area) / longest : 0.0;
    p->count += piece->height > 0.0;
}

void interpolation_enter(struct interpolation *p, uint32_t first)
{
    if (p->known && p->first == first) return;
    const struct reference_batch *batch = batch_of(p->arrays, first);
    const zr_mat4 to_clip = zr_mat4_mul(&p->arrays->projection, batch->modelview);
    const struct zr_viewport viewport = zr_viewport_make(p->width, p->height);
    struct zr_clipped clipped;
    struct zr_window_vertex v[ZR_CLIP_MAX];
    zr_vec4 corners[3], values[ZR_CLIP_VALUES];
    unsigned any = 0;
    p->first = first;
    p->known = true;
    p->count = 0;
    p->reach = p->reach_w = p->reach_clip = 0.0;
    for (int k = 0; k < 3; k++) {
        const zr_vec4 at = p->arrays->positions[first + (uint32_t)k];
        const zr_vec4 texcoord = p->arrays->texcoords[first + (uint32_t)k];
        reach_corner(p, batch, at, texcoord);
        values[k] = value_of(p, batch, at, texcoord, k);
        corners[k] = zr_mat4_apply(&to_clip, at);
        any |= zr_clip_outcode(corners[k]);
    }
    const int count = zr_clip_triangle(corners, any, NULL, &clipped);
    zr_clip_replay(clipped.made, clipped.made_count, clipped.corners, values);
    for (int i = 0; i < count; i++)
        (void)zr_viewport_apply(&viewport, clipped.vertices[i].position, &v[i]);
    for (int i = 2; i < count; i++)
        add_piece(p, (const struct zr_window_vertex *[3]){&v[i - 1], &v[i], &v[0]},
                  (const zr_vec4 *[3]){&values[clipped.vertices[i - 1].id], &values[clipped.vertices[i].id],
                                       &values[clipped.vertices[0].id]});
}

/* ---- pixels ---- */

/* Shares of the corners of a piece in a place of the window; returns the smallest. */
static double shares_at(const struct interpolation_piece *piece, double x, double y, double shares[3])
{
    const double x1 = piece->x[1] - piece->x[0], y1 = piece->y[1] - piece->y[0];
    const double x2 = piece->x[2] - piece->x[0], y2 = piece->y[2] - piece->y[0];
    const double area = x1 * y2 - x2 * y1, px = x - piece->x[0], py = y - piece->y[0];
    shares[1] = (px * y2 - x2 * py) / area;
    shares[2] = (x1 * py - px * y1) / area;
    shares[0] = 1.0 - shares[1] - shares[2];
    return fmin(shares[0], fmin(shares[1], shares[2]));
}

static double span_of(const struct interpolation_piece *piece, int k)
{
    const double a = piece->over_w[0][k], b = piece->over_w[1][k], c = piece->over_w[2][k];
    return fmax(a, fmax(b, c)) - fmin(a, fmin(b, c));
}

double interpolation_loss(const struct interpolation *p, uint32_t x, uint32_t y, double magnitude)
{
    const struct interpolation_piece *nearest = NULL;
    double shares[3] = {0, 0, 0}, least = -HUGE_VAL, outside = 0.0, w = 0.0;
    for (int i = 0; i < p->count; i++) {
        double of_piece[3];
        const double smallest = shares_at(&p->pieces[i], x + 0.5, y + 0.5, of_piece);
        if (!(smallest > least)) continue;
        least = smallest;
        nearest = &p->pieces[i];
        memcpy(shares, of_piece, sizeof shares);
    }
    if (!nearest) return 0.0;
    for (int i = 0; i < 3; i++) {
        outside += shares[i] < 0.0 ? -shares[i] : 0.0;
        w += shares[i] * nearest->over_w[i][3];
    }
    const double pixels = unit * (double)(p->width > p->height ? p->width : p->height);
    const double moved = pixels * (1.0 + p->reach_clip * nearest->most_over_w) / nearest->height + outside;
    double span = 0.0;
    for (int k = 0; k < 3; k++)
        raise(&span, span_of(nearest, k));
    const double of_value = unit * p->reach * nearest->most_over_w + span * moved;
    const double of_w = unit * p->reach_w * nearest->most_over_w + span_of(nearest, 3) * moved;
    return (of_value + magnitude * of_w) / fabs(w);
}
