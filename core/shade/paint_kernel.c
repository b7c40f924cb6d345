#include "shade/paint.h"

#include "raster/bins.h"
#include "raster/triangle_simd.h"

/* Runs up to this length are painted side by side. */
enum { SHORT_RUN = 8 };

/* So many runs are found at a time, then their corners and colours, then they are painted: by then, what was asked for
 * has come from memory (a third of the time of a mesh whose triangles are as small as pixels). */
enum { RUNS = 128, QUEUE = RUNS + ZR_LANES };

struct run_list {
    uint32_t count;
    uint32_t numbers[RUNS]; /* of records */
    uint16_t at[RUNS];      /* first pixel, in the tile's arrays */
    uint16_t lengths[RUNS];
};

/* Runs of one colour. */
struct flat_queue {
    uint32_t count;
    const zr_vec4 *colors[QUEUE];
    uint16_t at[QUEUE], lengths[QUEUE];
};

struct smooth_queue {
    uint32_t count;
    uint16_t at[QUEUE], lengths[QUEUE];
    const struct zr_window_vertex *vertices[3][QUEUE];
    const zr_vec4 *colors[3][QUEUE];
};

struct painter {
    const struct zr_geometry *geometry;
    const struct zr_tile *tile;
    uint32_t *colors;             /* of the tile */
    const struct zr_batch *batch; /* of the last record */
    struct run_list runs;
    struct flat_queue flat;
    struct smooth_queue smooth;
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

/* Runs `first` .. first + count - 1 of the queue; a group of lanes at most. */
static void paint_flat(const struct flat_queue *q, uint32_t first, uint32_t count, uint32_t *out)
{
    const uint32_t last = first + count - 1;
    uint32_t packed[ZR_LANES];
    zr_vf red, green, blue, alpha;
#define COLOR(i) (&q->colors[first + (i) < last ? first + (i) : last]->x)
    ZR_LOAD4(red, green, blue, alpha, COLOR);
    (void)alpha;
    zr_vi_store(packed, pack(red, green, blue));
    for (uint32_t i = 0; i < count; i++)
        fill_run(out + q->at[first + i], q->lengths[first + i], zr_vi_set((int32_t)packed[i]));
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
static inline zr_vm turned_around(const struct smooth_queue *q, const uint32_t lanes[ZR_LANES],
                                  const struct zr_corner_v v[3])
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
        turned |= (uint32_t)(zr_window_area(q->vertices[0][lanes[i]], q->vertices[1][lanes[i]], q->vertices[2][lanes[i]]) < 0) << i;
    }
    return zr_vm_of(turned);
}

static inline struct planes planes_make(const struct smooth_queue *q, const uint32_t lanes[ZR_LANES])
{
    struct zr_corner_v v[3];
    struct color_v c[3];
    zr_vf alpha;
#define VERTEX_0(i) (&q->vertices[0][lanes[i]]->x)
#define VERTEX_1(i) (&q->vertices[1][lanes[i]]->x)
#define VERTEX_2(i) (&q->vertices[2][lanes[i]]->x)
#define COLOR_0(i) (&q->colors[0][lanes[i]]->x)
#define COLOR_1(i) (&q->colors[1][lanes[i]]->x)
#define COLOR_2(i) (&q->colors[2][lanes[i]]->x)
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
    const zr_vm turned = turned_around(q, lanes, v);
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

/* Runs of one group of lanes; `short_lengths` are 0 for those that are not short. */
struct group {
    uint32_t count;
    uint32_t short_lengths[ZR_LANES];
    float x[ZR_LANES], y[ZR_LANES]; /* of first pixels, in the window */
    uint32_t *out[ZR_LANES];
};

/* Pixels `begin` .. begin + 3 of each run that is short and has them, at once: four vectors of all runs' pixels are
 * turned into four pixels of each run, which are stored without asking how many they are. */
static inline void paint_four(const struct planes *p, const struct group *g, uint32_t begin)
{
    uint32_t fours[4 * ZR_LANES + ZR_LANES]; /* the last load looks behind the end */
    zr_vi colors[4];
    zr_vf x = zr_vf_load(g->x) + zr_vf_set((float)begin);
    const zr_vf y = zr_vf_load(g->y);
    for (int k = 0; k < 4; k++, x = x + zr_vf_set(1.0f))
        colors[k] = paint_at(p, x, y);
    zr_vi_store4(fours, colors[0], colors[1], colors[2], colors[3]);
    for (uint32_t i = 0; i < g->count; i++) {
        const uint32_t left = g->short_lengths[i] > begin ? g->short_lengths[i] - begin : 0;
        store_four(g->out[i] + begin, fours + 4 * (size_t)i, left < 4 ? left : 4);
    }
}

static inline uint32_t group_make(const struct painter *p, uint32_t first, uint32_t count, struct group *g)
{
    const struct smooth_queue *q = &p->smooth;
    uint32_t longest = 0;
    g->count = count;
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        const uint32_t k = first + (i < count ? i : 0), length = q->lengths[k];
        g->short_lengths[i] = length <= SHORT_RUN ? length : 0;
        longest = g->short_lengths[i] > longest ? g->short_lengths[i] : longest;
        g->x[i] = (float)(p->tile->x + q->at[k] % ZR_TILE_STRIDE);
        g->y[i] = (float)(p->tile->y + q->at[k] / ZR_TILE_STRIDE);
        g->out[i] = p->colors + q->at[k];
    }
    return longest;
}

/* Runs `first` .. first + count - 1 of the queue; a group of lanes at most. */
static void paint_smooth(const struct painter *p, uint32_t first, uint32_t count)
{
    const struct smooth_queue *q = &p->smooth;
    struct group group;
    uint32_t lanes[ZR_LANES], longer = 0;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        lanes[i] = first + (i < count ? i : 0);
    const struct planes planes = planes_make(q, lanes);
    const uint32_t longest = group_make(p, first, count, &group);
    for (uint32_t begin = 0; begin < longest; begin += 4)
        paint_four(&planes, &group, begin);
    float kept[4][3][ZR_LANES];
    for (uint32_t i = 0; i < count; i++)
        longer += group.short_lengths[i] == 0;
    if (longer == 0) return;
    store_plane(kept[0], &planes.oow);
    store_plane(kept[1], &planes.red);
    store_plane(kept[2], &planes.green);
    store_plane(kept[3], &planes.blue);
    for (uint32_t i = 0; i < count; i++) {
        if (group.short_lengths[i] > 0) continue;
        const struct planes own = {spread_plane(kept[0], i), spread_plane(kept[1], i), spread_plane(kept[2], i),
                                   spread_plane(kept[3], i)};
        paint_long(&own, group.x[i], group.y[i], group.out[i], q->lengths[first + i]);
    }
}

/* ---- runs into queues ---- */

static inline void add_flat(struct painter *p, uint32_t run, const zr_vec4 *color)
{
    struct flat_queue *q = &p->flat;
    __builtin_prefetch(color);
    q->colors[q->count] = color;
    q->at[q->count] = p->runs.at[run];
    q->lengths[q->count++] = p->runs.lengths[run];
}

static inline void add_smooth(struct painter *p, uint32_t run, const struct zr_window_vertex *vertices,
                              const uint32_t v[3], const zr_vec4 *colors, const uint32_t c[3])
{
    struct smooth_queue *q = &p->smooth;
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(&vertices[v[k]]);
        __builtin_prefetch(&colors[c[k]]);
        q->vertices[k][q->count] = &vertices[v[k]];
        q->colors[k][q->count] = &colors[c[k]];
    }
    q->at[q->count] = p->runs.at[run];
    q->lengths[q->count++] = p->runs.lengths[run];
}

/* A record that is written out. */
static void add_record(struct painter *p, uint32_t run, const struct zr_triangle *t, const zr_vec4 *colors)
{
    const int32_t at = p->runs.at[run];
    if (t->c[0] == t->c[1] && t->c[1] == t->c[2])
        add_flat(p, run, &colors[t->c[0]]);
    else if (t->line)
        zr_paint_line(p->geometry, t, p->tile->x + at % ZR_TILE_STRIDE, p->tile->y + at / ZR_TILE_STRIDE,
                      p->colors + at, p->runs.lengths[run]);
    else
        add_smooth(p, run, p->geometry->vertices, t->v, colors, t->c);
}

static inline void add_run(struct painter *p, uint32_t run)
{
    const uint32_t number = p->runs.numbers[run];
    if (!zr_batch_holds(p->batch, number)) p->batch = zr_batch_of(p->geometry, number);
    const struct zr_batch *batch = p->batch;
    const uint32_t t = number - batch->first;
    const uint32_t *corners = batch->corners + 3 * (size_t)t;
    const struct zr_window_vertex *vertices = p->geometry->vertices + batch->first_vertex;
    if (batch->written) {
        const struct zr_triangle *record = &p->geometry->triangles[batch->first_record + t];
        add_record(p, run, record, record->back ? p->geometry->back_colors : p->geometry->front_colors);
    } else if (batch->front != batch->back) { /* its side must be known to know its colours */
        const struct zr_record record = zr_record_of(p->geometry, batch, number);
        add_record(p, run, &record.triangle, record.colors);
    } else if (batch->colors == ZR_BATCH_PER_VERTEX) {
        add_smooth(p, run, vertices, corners, batch->front, corners);
    } else if (batch->colors == ZR_BATCH_PER_CORNER) {
        const uint32_t slots[3] = {zr_batch_color(batch, t, 0), zr_batch_color(batch, t, 1),
                                   zr_batch_color(batch, t, 2)};
        add_smooth(p, run, vertices, corners, batch->front, slots);
    } else {
        add_flat(p, run, &batch->front[zr_batch_color(batch, t, 0)]);
    }
}

/* Where its corners stand is asked for. */
static inline void expect_run(struct painter *p, uint32_t number)
{
    if (!zr_batch_holds(p->batch, number)) p->batch = zr_batch_of(p->geometry, number);
    const struct zr_batch *batch = p->batch;
    const size_t t = number - batch->first;
    if (batch->written)
        __builtin_prefetch(&p->geometry->triangles[batch->first_record + t]);
    else
        __builtin_prefetch(batch->corners + 3 * t);
}

/* Paints what the queues hold, in full groups of lanes; the rest waits for more, unless this is the end. */
static void paint_queues(struct painter *p, bool end)
{
    struct flat_queue *flat = &p->flat;
    struct smooth_queue *smooth = &p->smooth;
    uint32_t done = 0;
    for (uint32_t left = flat->count; left >= ZR_LANES || (end && left > 0); left = flat->count - done) {
        const uint32_t some = left < ZR_LANES ? left : ZR_LANES;
        paint_flat(flat, done, some, p->colors);
        done += some;
    }
    for (uint32_t i = 0; done > 0 && done + i < flat->count; i++) {
        flat->colors[i] = flat->colors[done + i];
        flat->at[i] = flat->at[done + i];
        flat->lengths[i] = flat->lengths[done + i];
    }
    flat->count -= done;
    done = 0;
    for (uint32_t left = smooth->count; left >= ZR_LANES || (end && left > 0); left = smooth->count - done) {
        const uint32_t some = left < ZR_LANES ? left : ZR_LANES;
        paint_smooth(p, done, some);
        done += some;
    }
    for (uint32_t i = 0; done > 0 && done + i < smooth->count; i++) {
        for (int k = 0; k < 3; k++) {
            smooth->vertices[k][i] = smooth->vertices[k][done + i];
            smooth->colors[k][i] = smooth->colors[k][done + i];
        }
        smooth->at[i] = smooth->at[done + i];
        smooth->lengths[i] = smooth->lengths[done + i];
    }
    smooth->count -= done;
}

static void paint_runs(struct painter *p, bool end)
{
    for (uint32_t i = 0; i < p->runs.count; i++)
        add_run(p, i);
    p->runs.count = 0;
    paint_queues(p, end);
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

static uint32_t paint_tile(const struct zr_geometry *geometry, struct zr_tile *tile, uint32_t nothing,
                           const void *behind, ptrdiff_t stride)
{
    struct painter painter;
    painter.geometry = geometry;
    painter.tile = tile;
    painter.colors = tile->owner; /* rows are looked through before they are painted */
    painter.batch = &geometry->batches[0];
    painter.runs.count = painter.flat.count = painter.smooth.count = 0;
    const zr_vi nothings = zr_vi_set((int32_t)nothing);
    uint32_t covered = 0;
    for (int32_t y = 0; y < tile->height; y++) {
        uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        int32_t begin = 0, end;
        if (painter.runs.count > RUNS - ZR_TILE_SIZE) paint_runs(&painter, false);
        for (uint64_t bits = find_ends(owners, tile->width); bits; bits &= bits - 1, begin = end) {
            end = __builtin_ctzll(bits) + 1;
            if (owners[begin] == 0) {
                if (behind)
                    memcpy(owners + begin, (const uint32_t *)behind + y * stride + begin, 4 * (size_t)(end - begin));
                else
                    fill_run(owners + begin, (uint32_t)(end - begin), nothings);
                continue;
            }
            struct run_list *runs = &painter.runs;
            runs->numbers[runs->count] = owners[begin] - 1;
            runs->at[runs->count] = (uint16_t)(y * ZR_TILE_STRIDE + begin);
            runs->lengths[runs->count++] = (uint16_t)(end - begin);
            expect_run(&painter, owners[begin] - 1);
            covered += (uint32_t)(end - begin);
        }
    }
    paint_runs(&painter, true);
    return covered;
}

/* ---- arrays ---- */

static void fill(void *out, ptrdiff_t stride, int32_t width, int32_t rows, uint32_t value, bool streamed)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    for (int32_t row = 0; row < rows; row++) {
        uint32_t *to = (uint32_t *)out + row * stride;
        if (streamed)
            for (int32_t x = 0; x < width; x += ZR_LANES)
                zr_vi_stream(to + x, values);
        else
            fill_run(to, (uint32_t)width, values);
    }
}

static void copy(void *out, ptrdiff_t stride, int32_t width, int32_t rows, const void *in, bool streamed)
{
    for (int32_t row = 0; row < rows; row++) {
        const uint32_t *from = (const uint32_t *)in + row * ZR_TILE_STRIDE;
        uint32_t *to = (uint32_t *)out + row * stride;
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            if (streamed)
                zr_vi_stream(to + x, zr_vi_load(from + x));
            else
                zr_vi_store(to + x, zr_vi_load(from + x));
        if (x < width) zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {paint_tile, ends, fill, copy, zr_stream_end};
