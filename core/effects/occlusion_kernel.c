#include "effects/occlusion.h"
#include "effects/pixel_scale_simd.h"
#include "shade/lights/tone_simd.h"

/* ---- from pixel centres to samples ---- */

/* Returns the lanes whose point is covered. Uncovered pixels store ZR_FAR_POINT, which the plane of a point seen
 * edge-on may pass at a small distance. */
static inline zr_vm zr_is_near_v(zr_vm where, zr_vf point_x)
{
    return zr_vf_lt_where(where, point_x, zr_vf_set(0.5f * ZR_FAR_POINT));
}

/* Two neighbouring pixel rows, and the weight of each. At the window's border both are the same. */
struct zr_pixel_row {
    ptrdiff_t start[2]; /* offsets of the rows in the G-buffer */
    float share[2];
};

/* The same of rows or columns, per lane. */
struct beside {
    zr_vi at[2];
    zr_vf share[2];
};

struct zr_pixel_column {
    int32_t base; /* first column of vectors that contain all columns */
    struct beside beside;
};

/* Returns n such that sample v, at `side` samples per pixel, lies between the centres of pixels n and n + 1; may be -1.
 * Centres are at integers here: the sample is at (v + 1/2) / side - 1/2. */
static inline int32_t zr_pixel_before(int32_t v, int32_t side)
{
    return (2 * v + 1 + side) / (2 * side) - 1;
}

static inline struct zr_pixel_row zr_pixel_row_at(const struct zr_gbuffer *pixels, int32_t sample_y, int32_t side)
{
    const int32_t before = zr_pixel_before(sample_y, side), top = pixels->height - 1;
    const float share = (((float)sample_y + 0.5f) / (float)side - 0.5f) - (float)before;
    const int32_t low = before < 0 ? 0 : before, high = before < top ? before + 1 : top;
    return (struct zr_pixel_row){{low * pixels->stride, high * pixels->stride}, {1.0f - share, share}};
}

/* Finds the pixels of `count` between which coordinates lie, in samples. */
static inline struct beside beside_of(zr_vf sample, uint32_t side, int32_t count)
{
    const zr_vf x = (sample + zr_vf_set(0.5f)) / zr_vf_set((float)side) - zr_vf_set(0.5f);
    const zr_vi near = zr_vi_round(x), zero = zr_vi_set(0), last = zr_vi_set(count - 1);
    const zr_vi before = zr_vi_select(zr_vf_lt(x, zr_vf_of(near)), near - zr_vi_set(1), near);
    const zr_vf share = x - zr_vf_of(before);
    return (struct beside){
        {zr_vi_min(zr_vi_max(before, zero), last), zr_vi_min(zr_vi_max(before + zr_vi_set(1), zero), last)},
        {zr_vf_set(1.0f) - share, share}};
}

/* For ZR_LANES neighbouring samples, at least two per pixel. With 4 lanes or more, one vector contains all pixels
 * between them, and lanes are picked from it, which takes a third of the time of gathering. */
static inline struct zr_pixel_column zr_pixel_column_at(const struct zr_gbuffer *pixels, int32_t sample_x, int32_t side)
{
    const int32_t first = zr_pixel_before(sample_x, side), most = (int32_t)pixels->stride - ZR_LANES;
    const zr_vf x = zr_vf_of(zr_vi_set(sample_x) + zr_vi_ramp());
    return (struct zr_pixel_column){first < 0      ? 0
                                    : first < most ? first
                                                   : most,
                                    beside_of(x, (uint32_t)side, pixels->width)};
}

static inline zr_vf zr_pixel_pick(const float *row, int32_t base, zr_vi at)
{
    if (ZR_LANES == 1) return zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, row, at));
    return zr_vf_pick(zr_vf_load(row + base), at - zr_vi_set(base));
}

/* Weighted sums over the pixels around samples, whose planes are `normal` through `point`. */
struct between {
    struct zr_vec3_v point, normal;
    zr_vf sum, weights;
};

static inline struct between between_of(struct zr_vec3_v point, struct zr_vec3_v normal)
{
    return (struct between){point, normal, zr_vf_set(0.0f), zr_vf_set(0.0f)};
}

/* Adds a pixel: its point, its occlusion and its bilinear weight. Weights are (bilinear + 0.001) / (0.0001 +
 * distance^2), where distance is that of the pixel's point from the sample's plane, times map->plane_scale. */
static inline void add_pixel(const struct zr_occlusion_map *map, zr_vm where, struct zr_vec3_v there,
                             const zr_vf values[2], struct between *b)
{
    const zr_vf zero = zr_vf_set(0.0f), light = values[0], bilinear = values[1];
    const zr_vf away = zr_dot_v(zr_minus_v(there, b->point), b->normal) * zr_vf_set(map->plane_scale);
    const zr_vf weight = (bilinear + zr_vf_set(0.001f)) / (zr_vf_set(0.0001f) + away * away);
    const zr_vm counts = zr_is_near_v(where, there.x);
    b->sum = b->sum + zr_vf_select(counts, weight * light, zero);
    b->weights = b->weights + zr_vf_select(counts, weight, zero);
}

/* Returns the mean; 1 if the weights sum up to 0. */
static inline zr_vf between_end(const struct between *b)
{
    return zr_vf_select(zr_vf_lt(zr_vf_set(1e-12f), b->weights), b->sum / b->weights, zr_vf_set(1.0f));
}

/* Returns the interpolated occlusion. */
static inline zr_vf zr_occlusion_between_v(const struct zr_occlusion_map *map, const struct zr_pixel_row *row,
                                           const struct zr_pixel_column *column, struct zr_vec3_v point,
                                           struct zr_vec3_v normal)
{
    struct between between = between_of(point, normal);
    for (int i = 0; i < 4; i++) {
        const ptrdiff_t start = row->start[i >> 1];
        const zr_vi at = column->beside.at[i & 1];
        const struct zr_vec3_v there = {zr_pixel_pick(map->pixels->point[0] + start, column->base, at),
                                        zr_pixel_pick(map->pixels->point[1] + start, column->base, at),
                                        zr_pixel_pick(map->pixels->point[2] + start, column->base, at)};
        const zr_vf values[2] = {zr_pixel_pick(map->light + start, column->base, at),
                                 column->beside.share[i & 1] * zr_vf_set(row->share[i >> 1])};
        add_pixel(map, ZR_ALL_LANES, there, values, &between);
    }
    return between_end(&between);
}

static inline struct zr_vec3_v load3(float *const planes[3], ptrdiff_t at)
{
    return (struct zr_vec3_v){zr_vf_load(planes[0] + at), zr_vf_load(planes[1] + at), zr_vf_load(planes[2] + at)};
}

static inline struct zr_vec3_v gather3(float *const planes[3], zr_vm where, zr_vi at)
{
    return (struct zr_vec3_v){zr_vf_bits(zr_vi_gather(where, planes[0], at)),
                              zr_vf_bits(zr_vi_gather(where, planes[1], at)),
                              zr_vf_bits(zr_vi_gather(where, planes[2], at))};
}

/* Returns the covered ones of ZR_LANES pixels from column x on; `at` is the index of the first. */
static inline zr_vm covered_at(const struct zr_gbuffer *pixels, int32_t x, ptrdiff_t at)
{
    const zr_vm uncovered = zr_vi_eq(zr_vi_load(pixels->owner + at), zr_vi_set(0));
    return zr_vm_andnot(zr_vm_first((uint32_t)(pixels->width - x)), uncovered);
}

/* ---- raw occlusion of pixels ---- */

/* ZR_LANES pixels. Columns and rows are biased by INT32_MIN, so that one comparison tests both ends of the range. */
struct centers {
    struct zr_vec3_v point, normal;
    zr_vm covered;
    zr_vi at, x, y;
    zr_vf length[ZR_OCCLUSION_STEPS]; /* of steps, in pixels */
};

/* Longer steps leave every window. */
#define LONGEST 65536.0f

/* Sets the lengths of steps; at least 1, 2, 3 and 4 pixels, so a radius below 4 pixels counts as 4. */
static inline void set_lengths(const struct zr_occlusion_work *work, int32_t x, int32_t y, struct centers *c)
{
    const zr_vf w = zr_pixel_scale_w_v(&work->scale, c->point);
    const zr_vf pixels = zr_vf_set(work->radius * work->scale.scale) / w;
    const zr_vf radius = zr_vf_min(pixels, zr_vf_set(LONGEST));
    for (int j = 0; j < ZR_OCCLUSION_STEPS; j++) {
        const zr_vf length = radius * zr_vf_load(&work->step[y & 3][j][x & 15]);
        c->length[j] = zr_vf_max(length, zr_vf_set(1.0f + (float)j));
    }
}

static inline struct zr_vec3_v load_points(const zr_vec4 *points, zr_vi numbers)
{
    struct zr_vec3_v v;
    zr_vf w;
    uint32_t each[ZR_LANES];
    zr_vi_store(each, numbers);
#define POINT(i) (&points[each[i]].x)
    ZR_LOAD4(v.x, v.y, v.z, w, POINT);
#undef POINT
    (void)w;
    return v;
}

/* Occlusion by the points of one direction: shares of the light from this direction, weighted by its cosine. */
struct along {
    zr_vf near, all;     /* largest share: of points up to two radii away, of all of them */
    zr_vf behind;        /* largest share of the opposite direction, by surfaces that lean over the pixel's point */
    zr_vf highest, foot; /* height of the highest point over the plane; squared distance of the last one along it */
    zr_vm is_broken;     /* a later point is lower than half of the highest one */
};

/* Adds the point at [at] as the top of a column on the plane, lengths in radii. A column hides sin^2 of its elevation,
 * and no more than lies within the radius. In a hole, it begins halfway from the last point. `outward`: along the
 * plane; a surface beyond the normal hides all of this direction, and cos^2 of the other one. */
static inline void add_column(const struct zr_occlusion_work *work, const struct centers *c, zr_vm inside, zr_vi at,
                              struct zr_vec3_v outward, struct along *along)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), half = zr_vf_set(0.5f);
    const struct zr_vec3_v there = load_points(work->points, at), v = zr_minus_v(there, c->point);
    const zr_vm counts = zr_vf_lt_where(inside, there.x, zr_vf_set(0.5f * ZR_FAR_POINT * work->over_radius));
    const zr_vf square = zr_dot_v(v, v), height = zr_dot_v(v, c->normal), square_height = height * height;
    const zr_vf foot = square - square_height, sine = square_height / square;
    const zr_vm hides = zr_vf_lt_where(counts, zero, height);
    /* Not those of its own plane, which a wide view may show on the other side. */
    const zr_vm leans = zr_vf_lt_where(zr_vf_lt_where(hides, zr_vf_set(1e-4f), sine), zr_dot_v(v, outward), zero);
    const zr_vf share = zr_vf_max(zr_vf_min(sine, one - foot), zero);
    const zr_vf in_a_hole = zr_vf_min(sine, one - half * (foot + along->foot));
    const zr_vf nearness = zr_clamp01_v((zr_vf_set(4.0f) - square) * zr_vf_set(1.0f / 3.0f));
    const zr_vf over = zr_clamp01_v(zr_vf_set(2.0f) - zr_vf_set(2.0f) * square);
    const zr_vf near = zr_vf_select(leans, over, share * nearness);
    along->near = zr_vf_max(along->near, zr_vf_select(hides, near, zero));
    along->all = zr_vf_max(along->all, zr_vf_select(hides, in_a_hole, zero));
    along->behind = zr_vf_max(along->behind, zr_vf_select(leans, over * (one - sine), zero));
    const zr_vm is_lower = zr_vf_lt_where(counts, height, half * along->highest);
    along->is_broken = zr_vm_or(along->is_broken, zr_vf_lt_where(is_lower, zero, along->highest));
    along->highest = zr_vf_max(along->highest, zr_vf_select(counts, height, zero));
    along->foot = zr_vf_select(counts, foot, along->foot);
}

/* Beyond a rod or a plate in the air, points are low again, and light passes below it. */
static inline zr_vf all_of(const struct along *along)
{
    return zr_vf_select(along->is_broken, zr_vf_set(0.0f), along->all);
}

/* Sums over the axes: hidden light times the weight of the axis, and weights. */
struct hidden {
    zr_vf sum, weights;
};

/* Adds an axis of the picture, whose two directions are weighted by the angle that they stand for on the plane. Points
 * farther away than the radius count if there are any on both sides, as in a hole. */
static inline void add_axis(const struct zr_occlusion_work *work, const struct centers *c, zr_vf cosine, zr_vf sine,
                            struct hidden *hidden)
{
    const struct zr_gbuffer *pixels = work->pixels;
    const zr_vi width = zr_vi_set(INT32_MIN + pixels->width), height = zr_vi_set(INT32_MIN + pixels->height);
    const zr_vi stride = zr_vi_set((int32_t)pixels->stride), none = zr_vi_set(0);
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), half = zr_vf_set(0.5f), twice = zr_vf_set(2.0f);
    const zr_vf tilt = cosine * c->normal.x + sine * c->normal.y;
    const struct zr_vec3_v outward = {cosine - c->normal.x * tilt, sine - c->normal.y * tilt,
                                      zero - c->normal.z * tilt};
    const struct zr_vec3_v inward = {zero - outward.x, zero - outward.y, zero - outward.z};
    struct along there = {zero, zero, zero, zero, zero, zr_vm_of(0)}, back = there;
    for (int j = 0; j < ZR_OCCLUSION_STEPS; j++) {
        const zr_vi x = zr_vi_round(c->length[j] * cosine), y = zr_vi_round(c->length[j] * sine);
        const zr_vi step = y * stride + x;
        const zr_vm is_there = zr_vi_lt_where(zr_vi_lt_where(c->covered, c->x + x, width), c->y + y, height);
        const zr_vm is_back = zr_vi_lt_where(zr_vi_lt_where(c->covered, c->x - x, width), c->y - y, height);
        add_column(work, c, is_there, zr_vi_select(is_there, c->at + step, none), outward, &there);
        add_column(work, c, is_back, zr_vi_select(is_back, c->at - step, none), inward, &back);
    }
    const zr_vf a = all_of(&there), b = all_of(&back);
    const zr_vf both = zr_vf_min(twice * zr_vf_min(a, b), half * (a + b));
    const zr_vf weight = one / zr_vf_max(one - tilt * tilt, zr_vf_set(0.01f));
    hidden->sum = hidden->sum + weight * (zr_vf_max(zr_vf_max(there.near, back.behind), both) +
                                          zr_vf_max(zr_vf_max(back.near, there.behind), both));
    hidden->weights = hidden->weights + weight;
}

static inline zr_vf find(const struct zr_occlusion_work *work, int32_t x, int32_t y, zr_vm covered)
{
    const ptrdiff_t at = y * work->pixels->stride + x;
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    struct centers c = {.point = load3(work->pixels->point, at), .normal = load3(work->pixels->normal, at)};
    c.covered = covered;
    c.at = zr_vi_set((int32_t)at) + zr_vi_ramp();
    c.x = zr_vi_set(INT32_MIN + x) + zr_vi_ramp();
    c.y = zr_vi_set(INT32_MIN + y);
    set_lengths(work, x, y, &c);
    c.point = zr_scale_v(c.point, zr_vf_set(work->over_radius));
    struct hidden hidden = {zero, zero};
    for (int k = 0; k < ZR_OCCLUSION_AXES; k++)
        add_axis(work, &c, zr_vf_load(&work->cosine[y & 3][k][x & 15]), zr_vf_load(&work->sine[y & 3][k][x & 15]),
                 &hidden);
    const zr_vf mean = zr_vf_set(0.5f) * hidden.sum / hidden.weights, strong = zr_vf_set(work->strength) * mean;
    return one - strong / zr_vf_max(one - mean + strong, zr_vf_set(1e-30f));
}

/* ---- blur ---- */

enum { BLUR_RADIUS = 2 };
/* Any 4 consecutive pixels of the pattern get equal weight. */
static const float blur_weights[2 * BLUR_RADIUS + 1] = {1, 2, 2, 2, 1};

struct blur {
    struct zr_vec3_v point, normal;
    zr_vf limit, sum, weights;
};

static inline struct blur blur_begin(const struct zr_occlusion_work *work, ptrdiff_t at)
{
    return (struct blur){load3(work->pixels->point, at), load3(work->pixels->normal, at), zr_vf_set(work->plane_limit),
                         zr_vf_set(0.0f), zr_vf_set(0.0f)};
}

static inline void blur_add(struct blur *blur, float weight, zr_vm there, struct zr_vec3_v point, zr_vf light)
{
    const zr_vf away = zr_vf_abs(zr_dot_v(zr_minus_v(point, blur->point), blur->normal)), zero = zr_vf_set(0.0f);
    const zr_vm counts = zr_vm_and(zr_is_near_v(there, point.x), zr_vf_le(away, blur->limit));
    blur->sum = blur->sum + zr_vf_select(counts, zr_vf_set(weight) * light, zero);
    blur->weights = blur->weights + zr_vf_select(counts, zr_vf_set(weight), zero);
}

/* Returns the blurred value; 1 for uncovered lanes, and for those without a plane. */
static inline zr_vf blur_end(const struct blur *blur, zr_vm covered)
{
    const zr_vm has_plane = zr_vf_lt_where(covered, zr_vf_set(0.0f), zr_dot_v(blur->normal, blur->normal));
    return zr_vf_select(has_plane, blur->sum / blur->weights, zr_vf_set(1.0f));
}

static inline zr_vf blur_along(const struct zr_occlusion_work *work, int32_t x, int32_t y, zr_vm covered)
{
    const struct zr_gbuffer *pixels = work->pixels;
    const ptrdiff_t start = y * pixels->stride;
    const bool is_inside = x >= BLUR_RADIUS && x + ZR_LANES + BLUR_RADIUS <= pixels->width;
    struct blur blur = blur_begin(work, start + x);
    for (int i = -BLUR_RADIUS; i <= BLUR_RADIUS; i++) {
        const ptrdiff_t at = start + x + i;
        if (is_inside) {
            blur_add(&blur, blur_weights[i + BLUR_RADIUS], ZR_ALL_LANES, load3(pixels->point, at),
                     zr_vf_load(work->light + at));
            continue;
        }
        const zr_vi column = zr_vi_set(x + i) + zr_vi_ramp(), zero = zr_vi_set(0);
        const zr_vm there = zr_vm_andnot(zr_vi_lt(column, zr_vi_set(pixels->width)), zr_vi_lt(column, zero));
        const zr_vi each = zr_vi_select(there, zr_vi_set((int32_t)start) + column, zero);
        blur_add(&blur, blur_weights[i + BLUR_RADIUS], there, gather3(pixels->point, there, each),
                 zr_vf_bits(zr_vi_gather(there, work->light, each)));
    }
    return blur_end(&blur, covered);
}

static inline zr_vf blur_across(const struct zr_occlusion_work *work, int32_t x, int32_t y, zr_vm covered)
{
    const struct zr_gbuffer *pixels = work->pixels;
    struct blur blur = blur_begin(work, y * pixels->stride + x);
    for (int i = -BLUR_RADIUS; i <= BLUR_RADIUS; i++) {
        const ptrdiff_t at = (y + i) * pixels->stride + x;
        if (y + i < 0 || y + i >= pixels->height) continue;
        blur_add(&blur, blur_weights[i + BLUR_RADIUS], ZR_ALL_LANES, load3(pixels->point, at),
                 zr_vf_load(work->rows + at));
    }
    return blur_end(&blur, covered);
}

/* ---- rows ---- */

typedef zr_vf row_step(const struct zr_occlusion_work *work, int32_t x, int32_t y, zr_vm covered);

static inline __attribute__((always_inline)) void do_row(const struct zr_occlusion_work *work, int32_t y,
                                                         row_step *step, float *out)
{
    const ptrdiff_t start = y * work->pixels->stride;
    for (int32_t x = 0; x < work->pixels->width; x += ZR_LANES) {
        const zr_vm covered = covered_at(work->pixels, x, start + x);
        zr_vf_store(out + start + x, zr_vm_any(covered) ? step(work, x, y, covered) : zr_vf_set(1.0f));
    }
}

void ZR_KERNEL(zr_occlusion_points)(const struct zr_occlusion_work *work, int32_t y)
{
    const ptrdiff_t start = y * work->pixels->stride;
    for (ptrdiff_t at = start; at < start + work->pixels->width; at += ZR_LANES) {
        const struct zr_vec3_v point = load3(work->pixels->point, at);
        const zr_vf k = zr_vf_set(work->over_radius);
        zr_vf_store4(&work->points[at].x, point.x * k, point.y * k, point.z * k, zr_vf_set(0.0f));
    }
}

void ZR_KERNEL(zr_occlusion_row)(const struct zr_occlusion_work *work, int32_t y)
{
    do_row(work, y, find, work->light);
    do_row(work, y, blur_along, work->rows);
}

void ZR_KERNEL(zr_occlusion_blur)(const struct zr_occlusion_work *work, int32_t y)
{
    do_row(work, y, blur_across, work->light);
}

/* ---- samples ---- */

static void copy_pixels(const struct zr_occlusion_map *map, const struct zr_gbuffer *samples, int32_t tile_x,
                        int32_t tile_y, float *out)
{
    for (int32_t y = 0; y < samples->height; y++)
        memcpy(out + y * samples->stride, map->light + (tile_y + y) * map->pixels->stride + tile_x,
               (size_t)samples->width * sizeof *out);
}

static inline zr_vf light_samples(const struct zr_occlusion_map *map, const struct zr_gbuffer *samples,
                                  const struct zr_pixel_row *row, const struct zr_pixel_column *column, zr_vm covered,
                                  ptrdiff_t at)
{
    const struct zr_vec3_v point = load3(samples->point, at), normal = load3(samples->normal, at);
    const zr_vm has_plane = zr_vf_lt_where(covered, zr_vf_set(0.0f), zr_dot_v(normal, normal));
    return zr_vf_select(has_plane, zr_occlusion_between_v(map, row, column, point, normal), zr_vf_set(1.0f));
}

void ZR_KERNEL(zr_occlusion_samples)(const struct zr_occlusion_map *map, const struct zr_gbuffer *samples,
                                     uint32_t side, int32_t tile_x, int32_t tile_y, float *out)
{
    if (side == 1) {
        copy_pixels(map, samples, tile_x, tile_y, out);
        return;
    }
    for (int32_t y = 0; y < samples->height; y++) {
        const struct zr_pixel_row row = zr_pixel_row_at(map->pixels, tile_y + y, (int32_t)side);
        for (int32_t x = 0; x < samples->width; x += ZR_LANES) {
            const ptrdiff_t at = y * samples->stride + x;
            const zr_vm covered = covered_at(samples, x, at);
            zr_vf light = zr_vf_set(1.0f);
            if (zr_vm_any(covered)) {
                const struct zr_pixel_column column = zr_pixel_column_at(map->pixels, tile_x + x, (int32_t)side);
                light = light_samples(map, samples, &row, &column, covered, at);
            }
            zr_vf_store(out + at, light);
        }
    }
}

/* ---- from pixel centres to samples in any order ---- */

/* The same for lanes that are no neighbours. */
static inline zr_vf between_any(const struct zr_occlusion_map *map, const struct beside *columns,
                                const struct beside *rows, zr_vm where, struct between between)
{
    for (int i = 0; i < 4; i++) {
        const zr_vi at = rows->at[i >> 1] * zr_vi_set((int32_t)map->pixels->stride) + columns->at[i & 1];
        const zr_vf values[2] = {zr_vf_bits(zr_vi_gather(where, map->light, at)),
                                 columns->share[i & 1] * rows->share[i >> 1]};
        add_pixel(map, where, gather3(map->pixels->point, where, at), values, &between);
    }
    return between_end(&between);
}

void ZR_KERNEL(zr_occlusion_places)(const struct zr_occlusion_map *map, const struct zr_sample_list *list,
                                    const struct zr_gbuffer *values, uint32_t side, float *out)
{
    for (uint32_t i = 0; i < list->count; i += ZR_LANES) {
        const struct beside columns = beside_of(zr_vf_load(list->x + i), side, map->pixels->width),
                            rows = beside_of(zr_vf_load(list->y + i), side, map->pixels->height);
        const struct zr_vec3_v point = load3(values->point, (ptrdiff_t)i), normal = load3(values->normal, (ptrdiff_t)i);
        const zr_vm has_plane = zr_vf_lt_where(zr_vm_first(list->count - i), zr_vf_set(0.0f), zr_dot_v(normal, normal));
        const zr_vf light = between_any(map, &columns, &rows, has_plane, between_of(point, normal));
        zr_vf_store(out + i, zr_vf_select(has_plane, light, zr_vf_set(1.0f)));
    }
}
