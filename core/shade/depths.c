#include "shade/depths.h"

#include <string.h>

enum {
    BAND_MOST = ZR_EYE_BAND * ZR_TILE_SIZE,
    DEPTHS = 2 * BAND_MOST, /* capacity of the cache */
    KEYS = 1024,
    WAITING = 64 /* triangles made together */
};

struct depths {
    const struct zr_geometry *geometry;
    const struct zr_eye_depths *kernel;
    uint32_t width, height;

    /* The shares, beside the depths; NULL: not wanted. */
    struct zr_eye_shares *shares;
    const struct zr_eye_points *points;
    const struct zr_eye_rays *rays;

    const struct zr_draw *draw; /* draw of the last primitive */

    /* Cached depths, followed by those of the queued triangles, which all belong to one instance. */
    uint32_t count, waiting;
    const struct zr_source_instance *instance;
    uint32_t vertices[WAITING][3];
    const zr_vec4 *corners[WAITING + ZR_EYE_ROOM][3];
    uint32_t owners[KEYS]; /* hash table from owner to number */
    uint16_t numbers[KEYS];
    struct zr_eye_depth depths[DEPTHS];
};

static void forget(struct depths *d)
{
    memset(d->owners, 0, sizeof d->owners);
    d->depths[0] = zr_eye_depth_uncovered();
    if (d->shares) d->shares[0] = zr_eye_shares_none();
    d->count = 1;
}

static void make_shares(struct depths *d, uint32_t count)
{
    if (d->shares) d->points->make(d->instance, d->corners, count, d->rays, d->shares + d->count);
}

static void make_waiting(struct depths *d)
{
    const struct zr_window_vertex *vertices = d->geometry->vertices;
    if (ZR_MUTANT(shares_of_turned_corners, true, false)) make_shares(d, d->waiting);
    for (uint32_t i = 0; i < d->waiting; i++) {
        const uint32_t *v = d->vertices[i];
        const zr_vec4 **corners = d->corners[i], *old = corners[0];
        if (zr_window_area(&vertices[v[0]], &vertices[v[1]], &vertices[v[2]]) >= 0) continue;
        corners[0] = corners[1];
        corners[1] = old;
    }
    if (ZR_MUTANT(shares_of_turned_corners, false, true)) make_shares(d, d->waiting);
    d->kernel->make(d->instance, d->corners, d->waiting, d->width, d->height, d->depths + d->count);
    d->count += d->waiting;
    d->waiting = 0;
}

/* Queues a triangle of an instance and prefetches its vertices (a sixth of a million triangles' time). */
static void add_triangle(struct depths *d, const struct zr_source_instance *instance, const uint32_t vertices[3],
                         const zr_vec4 *const corners[3])
{
    if (d->waiting == WAITING || d->instance != instance) make_waiting(d);
    d->instance = instance;
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(corners[k]);
        __builtin_prefetch(&d->geometry->vertices[vertices[k]]);
        d->vertices[d->waiting][k] = vertices[k];
        d->corners[d->waiting][k] = corners[k];
    }
    d->waiting++;
}

/* Makes the depth of a clipped triangle's piece. The queue is empty. */
static void make_piece(struct depths *d, const struct zr_triangle *piece, const struct zr_source *source)
{
    struct zr_eye_depth *depth = &d->depths[d->count];
    memcpy(d->corners[0], source->corners, sizeof d->corners[0]);
    d->instance = source->instance;
    make_shares(d, 1);
    d->count++;
    if (d->kernel->make(source->instance, d->corners, 1, d->width, d->height, depth) > 0)
        zr_eye_depth_take_piece(d->geometry, piece, depth);
}

/* Queues a triangle with the corners as its mesh gives them: rule 6's swap is undone. */
static void add_as_given(struct depths *d, const struct zr_triangle *triangle, const struct zr_source *source)
{
    const int other = triangle->turned ? zr_swapped_corner() : 0;
    uint32_t vertices[3];
    const zr_vec4 *corners[3];
    memcpy(vertices, triangle->v, sizeof vertices);
    memcpy(corners, source->corners, sizeof corners);
    vertices[0] = triangle->v[other];
    vertices[other] = triangle->v[0];
    corners[0] = source->corners[other];
    corners[other] = source->corners[0];
    add_triangle(d, source->instance, vertices, corners);
}

/* Adds a primitive that may be a line or a clipped piece. */
static void add_any(struct depths *d, uint32_t number)
{
    const struct zr_triangle triangle = zr_triangle_of(d->geometry, d->draw, number);
    if (triangle.line) {
        make_waiting(d);
        if (d->shares) d->shares[d->count] = zr_eye_shares_none();
        d->depths[d->count++] = zr_eye_depth_of_line(d->geometry, d->draw, number);
        return;
    }
    const struct zr_source source = zr_source_of(d->geometry, d->draw, triangle.v);
    if (source.is_cut) {
        make_waiting(d);
        make_piece(d, &triangle, &source);
    } else {
        add_as_given(d, &triangle, &source);
    }
}

static void add(struct depths *d, uint32_t number)
{
    const struct zr_draw *draw = d->draw = zr_draw_next(d->geometry, d->draw, number);
    if (draw->counted || zr_draw_is_cloud(draw)) {
        add_any(d, number);
        return;
    }
    const uint32_t *v = draw->corners + 3 * (size_t)(number - draw->first), first = draw->first_vertex;
    const uint32_t vertices[3] = {first + v[0], first + v[1], first + v[2]};
    const zr_vec4 *positions = draw->mesh->positions;
    const zr_vec4 *const corners[3] = {positions + v[0], positions + v[1], positions + v[2]};
    add_triangle(d, &d->geometry->instances[draw->instance], vertices, corners);
}

static int32_t number_of(struct depths *d, uint32_t owner)
{
    const uint32_t key = owner % KEYS;
    if (d->owners[key] != owner) {
        add(d, owner - 1);
        d->owners[key] = owner;
        d->numbers[key] = (uint16_t)(d->count + d->waiting - 1);
    }
    return d->numbers[key];
}

static void find_runs(struct depths *d, const uint32_t *owners, uint64_t ends, struct zr_eye_runs *out)
{
    int32_t *number = out->numbers;
    out->ends = ends;
    for (; ends; ends &= ends - 1) {
        const uint32_t owner = owners[__builtin_ctzll(ends)];
        *number++ = owner > 0 ? number_of(d, owner) : 0;
    }
}

static void start(struct depths *d)
{
    d->draw = &d->geometry->draws[0];
    d->instance = NULL;
    d->waiting = 0;
    forget(d);
}

/* Finds the runs of the band of rows from y on, and makes what they need. Returns the number of rows. */
static int32_t find_band(struct depths *d, uint64_t (*ends)(const uint32_t *owners, int32_t width),
                         const struct zr_tile *tile, int32_t y, struct zr_eye_runs runs[ZR_EYE_BAND])
{
    const int32_t rows = tile->height - y < ZR_EYE_BAND ? tile->height - y : ZR_EYE_BAND;
    if (d->count + BAND_MOST > DEPTHS) forget(d);
    for (int32_t row = 0; row < rows; row++) {
        const uint32_t *owners = &tile->owner[(y + row) * ZR_TILE_STRIDE];
        find_runs(d, owners, ends(owners, tile->width), &runs[row]);
    }
    make_waiting(d);
    return rows;
}

float zr_depths_tile(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                     uint64_t (*ends)(const uint32_t *owners, int32_t width), uint32_t width, uint32_t height,
                     struct zr_tile *tile)
{
    struct depths d;
    float deepest = 0.0f;
    d.geometry = geometry;
    d.kernel = kernel;
    d.width = width;
    d.height = height;
    d.shares = NULL;
    start(&d);
    for (int32_t y = 0; y < tile->height; y += ZR_EYE_BAND) {
        struct zr_eye_runs runs[ZR_EYE_BAND];
        const int32_t rows = find_band(&d, ends, tile, y, runs);
        const float deep = kernel->fill(d.depths, runs, rows, tile->x, tile->y + y, &tile->depth[y * ZR_TILE_STRIDE]);
        deepest = deep > deepest ? deep : deepest;
    }
    return deepest;
}

void zr_depths_fill_points(const struct zr_depths_of *of, const struct zr_eye_rays *rays, const struct zr_tile *tile,
                           const struct zr_eye_targets *to)
{
    struct depths d;
    struct zr_eye_shares shares[DEPTHS];
    d.geometry = of->geometry;
    d.kernel = of->kernel;
    d.width = (uint32_t)rays->width;
    d.height = (uint32_t)rays->height;
    d.shares = to->barycentrics ? shares : NULL;
    d.points = of->points;
    d.rays = rays;
    start(&d);
    for (int32_t y = 0; y < tile->height; y += ZR_EYE_BAND) {
        struct zr_eye_runs runs[ZR_EYE_BAND];
        const int32_t rows = find_band(&d, of->ends, tile, y, runs);
        const struct zr_eye_band band = {d.depths, d.shares, runs, tile->x, tile->y + y, tile->width, rows};
        of->points->fill(rays, &band, to, y);
    }
}
