#include "shade/paint.h"

#include "raster/bins.h"
#include "raster/triangle_simd.h"

/* Runs up to this length are painted side by side. */
enum { SHORT_RUN = 8 };

/* Runs of one colour, waiting until there are as many as lanes. */
struct flat_queue {
    uint32_t count;
    const zr_vec4 *colors[ZR_LANES];
    uint32_t *pixels[ZR_LANES];
    uint32_t lengths[ZR_LANES];
};

struct smooth_queue {
    uint32_t count;
    float x[ZR_LANES], y[ZR_LANES]; /* of first pixels */
    uint32_t lengths[ZR_LANES];
    uint32_t *pixels[ZR_LANES];
    const struct zr_window_vertex *vertices[3][ZR_LANES];
    const zr_vec4 *colors[3][ZR_LANES];
};

/* ---- bytes ---- */

static inline zr_vi color_bytes(zr_vf value)
{
    value = zr_vf_min(zr_vf_max(value, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    return zr_vi_round(value * zr_vf_set(255.0f));
}

/* As zr_color_pack, opaque. */
static inline zr_vi pack(zr_vf red, zr_vf green, zr_vf blue)
{
    const zr_vi r = color_bytes(red), g = color_bytes(green), b = color_bytes(blue);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return r | g << 8 | b << 16 | zr_vi_set(-0x1000000);
#else
    return r << 24 | g << 16 | b << 8 | zr_vi_set(255);
#endif
}

/* ---- one colour ---- */

static inline void fill_run(uint32_t *pixels, uint32_t count, zr_vi colors)
{
    for (; count > ZR_LANES; count -= ZR_LANES, pixels += ZR_LANES)
        zr_vi_store(pixels, colors);
    zr_vi_store_first(pixels, colors, count);
}

static void paint_flat(struct flat_queue *q)
{
    uint32_t packed[ZR_LANES];
    zr_vf red, green, blue, alpha;
    for (uint32_t i = q->count; i < ZR_LANES; i++)
        q->colors[i] = q->colors[0];
#define COLOR(i) (&q->colors[i]->x)
    ZR_LOAD4(red, green, blue, alpha, COLOR);
    (void)alpha;
    zr_vi_store(packed, pack(red, green, blue));
    for (uint32_t i = 0; i < q->count; i++)
        fill_run(q->pixels[i], q->lengths[i], zr_vi_set((int32_t)packed[i]));
    q->count = 0;
}

/* ---- colours that vary ---- */

struct planes {
    struct zr_plane_v oow, red, green, blue;
};

struct color_v {
    zr_vf red, green, blue;
};

static inline zr_vi paint_at(const struct planes *p, zr_vf x, zr_vf y)
{
    const zr_vf reciprocal = zr_vf_set(1.0f) / zr_plane_at_v(&p->oow, x, y);
    return pack(zr_plane_at_v(&p->red, x, y) * reciprocal, zr_plane_at_v(&p->green, x, y) * reciprocal,
                zr_plane_at_v(&p->blue, x, y) * reciprocal);
}

/* Rule 6: the corners 0 and 1 are to change places. Large triangles are measured one by one, in 64 bits. */
static inline zr_vm turned_around(const struct smooth_queue *q, const struct zr_corner_v v[3])
{
    struct zr_grid_v g[3];
    for (int k = 0; k < 3; k++)
        g[k] = zr_grid_of(v[k].x, v[k].y);
    const zr_vi area = zr_area_v(g), span = zr_vi_set(ZR_BIN_SMALL_SPAN);
    const zr_vm wide = zr_vm_or(zr_vi_lt(span, zr_span_v(g[0].x, g[1].x, g[2].x)),
                                zr_vi_lt(span, zr_span_v(g[0].y, g[1].y, g[2].y)));
    uint32_t turned = zr_vm_bits(zr_vi_lt(area, zr_vi_set(0)));
    for (uint32_t bits = zr_vm_bits(wide); bits; bits &= bits - 1) {
        int i = zr_lowest_bit(bits);
        turned &= ~(1u << i);
        turned |= (uint32_t)(zr_window_area(q->vertices[0][i], q->vertices[1][i], q->vertices[2][i]) < 0) << i;
    }
    return zr_vm_of(turned);
}

static inline struct planes planes_make(const struct smooth_queue *q)
{
    struct zr_corner_v v[3];
    struct color_v c[3];
    zr_vf alpha;
#define VERTEX_0(i) (&q->vertices[0][i]->x)
#define VERTEX_1(i) (&q->vertices[1][i]->x)
#define VERTEX_2(i) (&q->vertices[2][i]->x)
#define COLOR_0(i) (&q->colors[0][i]->x)
#define COLOR_1(i) (&q->colors[1][i]->x)
#define COLOR_2(i) (&q->colors[2][i]->x)
    ZR_LOAD4(v[0].x, v[0].y, v[0].z, v[0].oow, VERTEX_0);
    ZR_LOAD4(v[1].x, v[1].y, v[1].z, v[1].oow, VERTEX_1);
    ZR_LOAD4(v[2].x, v[2].y, v[2].z, v[2].oow, VERTEX_2);
    ZR_LOAD4(c[0].red, c[0].green, c[0].blue, alpha, COLOR_0);
    ZR_LOAD4(c[1].red, c[1].green, c[1].blue, alpha, COLOR_1);
    ZR_LOAD4(c[2].red, c[2].green, c[2].blue, alpha, COLOR_2);
    (void)alpha;
    for (int k = 0; k < 3; k++) {
        c[k].red = c[k].red * v[k].oow;
        c[k].green = c[k].green * v[k].oow;
        c[k].blue = c[k].blue * v[k].oow;
    }
    const zr_vm turned = turned_around(q, v);
    zr_swap_vf(turned, &v[0].x, &v[1].x);
    zr_swap_vf(turned, &v[0].y, &v[1].y);
    zr_swap_vf(turned, &v[0].oow, &v[1].oow);
    zr_swap_vf(turned, &c[0].red, &c[1].red);
    zr_swap_vf(turned, &c[0].green, &c[1].green);
    zr_swap_vf(turned, &c[0].blue, &c[1].blue);
    const struct zr_basis_v basis = zr_basis_make_v(v);
    return (struct planes){zr_plane_make_v(&basis, v[0].oow, v[1].oow, v[2].oow),
                           zr_plane_make_v(&basis, c[0].red, c[1].red, c[2].red),
                           zr_plane_make_v(&basis, c[0].green, c[1].green, c[2].green),
                           zr_plane_make_v(&basis, c[0].blue, c[1].blue, c[2].blue)};
}

static inline void store_plane(float out[3][ZR_LANES], const struct zr_plane_v *plane)
{
    zr_vf_store(out[0], plane->a0);
    zr_vf_store(out[1], plane->dadx);
    zr_vf_store(out[2], plane->dady);
}

static inline struct zr_plane_v spread_plane(float in[3][ZR_LANES], uint32_t i)
{
    return (struct zr_plane_v){zr_vf_set(in[0][i]), zr_vf_set(in[1][i]), zr_vf_set(in[2][i])};
}

static inline void paint_long(const struct planes *p, float first_x, float first_y, uint32_t *pixels, uint32_t count)
{
    const zr_vf y = zr_vf_set(first_y);
    zr_vf x = zr_vf_set(first_x) + zr_vf_ramp();
    for (; count > ZR_LANES; count -= ZR_LANES, pixels += ZR_LANES, x = x + zr_vf_set((float)ZR_LANES))
        zr_vi_store(pixels, paint_at(p, x, y));
    zr_vi_store_first(pixels, paint_at(p, x, y), count);
}

/* The first n of four, n at most 4. */
static inline void store_four(uint32_t *out, const uint32_t *four, uint32_t n)
{
    for (uint32_t i = 0; i < n; i += ZR_LANES)
        zr_vi_store_first(out + i, zr_vi_load(four + i), n - i < ZR_LANES ? n - i : ZR_LANES);
}

/* Pixels `begin` .. begin + 3 of each run that is short and has them, at once: four vectors of all runs' pixels are
 * turned into four pixels of each run, which are stored without asking how many they are. */
static inline void paint_four(const struct planes *p, const struct smooth_queue *q, zr_vf x, zr_vf y, uint32_t begin)
{
    uint32_t fours[4 * ZR_LANES + ZR_LANES]; /* the last load looks behind the end */
    zr_vi colors[4];
    x = x + zr_vf_set((float)begin);
    for (int k = 0; k < 4; k++, x = x + zr_vf_set(1.0f))
        colors[k] = paint_at(p, x, y);
    zr_vi_store4(fours, colors[0], colors[1], colors[2], colors[3]);
    for (uint32_t i = 0; i < q->count; i++) {
        const uint32_t length = q->lengths[i];
        uint32_t left = length > begin && length <= SHORT_RUN ? length - begin : 0;
        store_four(q->pixels[i] + begin, fours + 4 * (size_t)i, left < 4 ? left : 4);
    }
}

static void paint_smooth(struct smooth_queue *q)
{
    uint32_t longest = 0, longer = 0;
    for (uint32_t i = 0; i < q->count; i++) {
        const uint32_t count = q->lengths[i], in_short = count <= SHORT_RUN ? count : 0;
        longer += in_short == 0;
        longest = in_short > longest ? in_short : longest;
    }
    for (uint32_t i = q->count; i < ZR_LANES; i++) {
        for (int k = 0; k < 3; k++) {
            q->vertices[k][i] = q->vertices[k][0];
            q->colors[k][i] = q->colors[k][0];
        }
    }
    const struct planes planes = planes_make(q);
    for (uint32_t begin = 0; begin < longest; begin += 4)
        paint_four(&planes, q, zr_vf_load(q->x), zr_vf_load(q->y), begin);
    float kept[4][3][ZR_LANES];
    if (longer > 0) {
        store_plane(kept[0], &planes.oow);
        store_plane(kept[1], &planes.red);
        store_plane(kept[2], &planes.green);
        store_plane(kept[3], &planes.blue);
    }
    for (uint32_t i = 0; i < q->count && longer > 0; i++) {
        if (q->lengths[i] <= SHORT_RUN) continue;
        const struct planes own = {spread_plane(kept[0], i), spread_plane(kept[1], i), spread_plane(kept[2], i),
                                   spread_plane(kept[3], i)};
        paint_long(&own, q->x[i], q->y[i], q->pixels[i], q->lengths[i]);
    }
    q->count = 0;
}

/* ---- runs into queues ---- */

struct painter {
    const struct zr_geometry *geometry;
    const struct zr_batch *batch; /* of the last record */
    struct flat_queue flat;
    struct smooth_queue smooth;
};

/* What is added is never gathered in a struct first: it would be stored in parts and loaded whole, which waits (a
 * fifth of the bunny's time, Gouraud). */
static inline void add_flat(struct painter *p, uint32_t *pixels, uint32_t length, const zr_vec4 *color)
{
    struct flat_queue *q = &p->flat;
    q->colors[q->count] = color;
    q->pixels[q->count] = pixels;
    q->lengths[q->count++] = length;
    if (q->count == ZR_LANES) paint_flat(q);
}

static inline void add_smooth(struct painter *p, int32_t x, int32_t y, uint32_t *pixels, uint32_t length,
                              const struct zr_window_vertex *vertices, const uint32_t v[3], const zr_vec4 *colors,
                              const uint32_t c[3])
{
    struct smooth_queue *q = &p->smooth;
    for (int k = 0; k < 3; k++) {
        q->vertices[k][q->count] = &vertices[v[k]];
        q->colors[k][q->count] = &colors[c[k]];
    }
    q->x[q->count] = (float)x;
    q->y[q->count] = (float)y;
    q->pixels[q->count] = pixels;
    q->lengths[q->count++] = length;
    if (q->count == ZR_LANES) paint_smooth(q);
}

/* A record that is written out. */
static void add_record(struct painter *p, int32_t x, int32_t y, uint32_t *pixels, uint32_t length,
                       const struct zr_triangle *t, const zr_vec4 *colors)
{
    if (t->c[0] == t->c[1] && t->c[1] == t->c[2])
        add_flat(p, pixels, length, &colors[t->c[0]]);
    else if (t->line)
        zr_paint_line(p->geometry, t, x, y, pixels, length);
    else
        add_smooth(p, x, y, pixels, length, p->geometry->vertices, t->v, colors, t->c);
}

/* So many pixels from x, y of the window on. */
static inline void add_run(struct painter *p, uint32_t number, int32_t x, int32_t y, uint32_t *pixels, uint32_t length)
{
    if (!zr_batch_holds(p->batch, number)) p->batch = zr_batch_of(p->geometry, number);
    const struct zr_batch *batch = p->batch;
    uint32_t t = number - batch->first;
    if (batch->written) {
        const struct zr_triangle *record = &p->geometry->triangles[batch->first_record + t];
        add_record(p, x, y, pixels, length, record,
                   record->back ? p->geometry->back_colors : p->geometry->front_colors);
    } else if (batch->front != batch->back) { /* its side must be known to know its colours */
        const struct zr_record record = zr_record_of(p->geometry, batch, number);
        add_record(p, x, y, pixels, length, &record.triangle, record.colors);
    } else if (batch->colors == ZR_BATCH_PER_VERTEX) {
        const uint32_t *corners = batch->corners + 3 * (size_t)t;
        add_smooth(p, x, y, pixels, length, p->geometry->vertices + batch->first_vertex, corners, batch->front, corners);
    } else if (batch->colors == ZR_BATCH_PER_CORNER) {
        const uint32_t slots[3] = {zr_batch_color(batch, t, 0), zr_batch_color(batch, t, 1),
                                   zr_batch_color(batch, t, 2)};
        add_smooth(p, x, y, pixels, length, p->geometry->vertices + batch->first_vertex,
                   batch->corners + 3 * (size_t)t, batch->front, slots);
    } else {
        add_flat(p, pixels, length, &batch->front[zr_batch_color(batch, t, 0)]);
    }
}

/* ---- rows ---- */

/* A row has room behind its end, so that the last vector may look one owner farther. */
static inline uint64_t find_ends(const uint32_t *owners, int32_t width)
{
    uint64_t out = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vm same = zr_vi_eq(zr_vi_load(owners + x), zr_vi_load(owners + x + 1));
        out |= (uint64_t)(zr_vm_bits(same) ^ ZR_ALL_BITS) << x;
    }
    const uint64_t last = UINT64_C(1) << (width - 1);
    return (out & (last - 1)) | last;
}

static uint64_t ends(const uint32_t *owners, int32_t width)
{
    return find_ends(owners, width);
}

static uint32_t paint_tile(const struct zr_geometry *geometry, const struct zr_tile *tile, uint32_t nothing,
                           uint32_t *pixels, ptrdiff_t stride)
{
    struct painter painter;
    painter.geometry = geometry;
    painter.batch = &geometry->batches[0];
    painter.flat.count = painter.smooth.count = 0;
    const zr_vi nothings = zr_vi_set((int32_t)nothing);
    uint32_t covered = 0;
    for (int32_t y = 0; y < tile->height; y++, pixels += stride) {
        const uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        int32_t begin = 0, end;
        for (uint64_t bits = find_ends(owners, tile->width); bits; bits &= bits - 1, begin = end) {
            end = __builtin_ctzll(bits) + 1;
            if (owners[begin] == 0) {
                fill_run(pixels + begin, (uint32_t)(end - begin), nothings);
                continue;
            }
            covered += (uint32_t)(end - begin);
            add_run(&painter, owners[begin] - 1, tile->x + begin, tile->y + y, pixels + begin, (uint32_t)(end - begin));
        }
    }
    if (painter.flat.count > 0) paint_flat(&painter.flat);
    if (painter.smooth.count > 0) paint_smooth(&painter.smooth);
    return covered;
}

/* ---- arrays ---- */

static void fill(void *out, ptrdiff_t stride, int32_t width, int32_t rows, uint32_t value)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    for (int32_t row = 0; row < rows; row++)
        fill_run((uint32_t *)out + row * stride, (uint32_t)width, values);
}

static void copy(void *out, ptrdiff_t stride, int32_t width, int32_t rows, const void *in)
{
    for (int32_t row = 0; row < rows; row++) {
        const uint32_t *from = (const uint32_t *)in + row * ZR_TILE_STRIDE;
        uint32_t *to = (uint32_t *)out + row * stride;
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_store(to + x, zr_vi_load(from + x));
        zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {paint_tile, ends, fill, copy};
