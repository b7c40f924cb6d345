#include "shade/resolve.h"

#include <string.h>

#include "raster/line.h"
#include "shade/eye_depth.h"

/* Pixels of one row that belong to one record. */
struct run {
    int32_t x, y, count; /* window space, y up */
    uint32_t owner;
};

/* A record's planes, kept while its runs are resolved. */
struct surface {
    uint32_t owner; /* 0: none yet */
    bool flat;
    uint32_t flat_color;
    struct zr_plane oow, red, green, blue; /* colours times 1/w */
    struct zr_eye_depth eye_depth;
};

/* Small records come back in every row of a tile: this many are remembered. */
enum { SURFACES = 256 };

/* Adding and taking away 1.5 * 2^23 rounds to an integer, ties to even: the float
 * has no bits left for a fraction. Compiles to vector code, as rintf does not everywhere. */
static inline float round_small(float v)
{
    return (v + 12582912.0f) - 12582912.0f;
}

static inline uint32_t color_byte(float value)
{
    value = value > 0.0f ? value : 0.0f;
    value = value < 1.0f ? value : 1.0f;
    return (uint32_t)(int32_t)round_small(value * 255.0f);
}

uint32_t zr_color_byte(float value)
{
    return color_byte(value);
}

/* As four bytes in memory: red, green, blue, alpha. */
static inline uint32_t pack(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return red | green << 8 | blue << 16 | alpha << 24;
#else
    return red << 24 | green << 16 | blue << 8 | alpha;
#endif
}

/* What the planes of a record have in common: of a triangle's or of a line's. */
struct basis {
    bool is_line;
    struct zr_plane_basis triangle;
    struct zr_line_basis line;
};

static struct basis basis_make(const struct zr_triangle *t, const struct zr_window_vertex *const v[3])
{
    struct basis basis = {.is_line = t->line};
    if (t->line)
        basis.line = zr_line_basis_make(v[0], v[1]);
    else
        basis.triangle = zr_plane_basis_make(v[0], v[1], v[2]);
    return basis;
}

static struct zr_plane plane_make(const struct basis *basis, float p0, float p1, float p2)
{
    return basis->is_line ? zr_line_plane_make(&basis->line, p0, p1) : zr_plane_make(&basis->triangle, p0, p1, p2);
}

static void make_color(const struct zr_geometry *geometry, const struct zr_triangle *t, struct surface *surface)
{
    const zr_vec4 *colors = t->back ? geometry->back_colors : geometry->front_colors;
    zr_vec4 c0 = colors[t->c[0]], c1 = colors[t->c[1]], c2 = colors[t->c[2]];
    surface->flat = t->c[0] == t->c[1] && t->c[1] == t->c[2];
    if (surface->flat) {
        surface->flat_color = pack(color_byte(c0.x), color_byte(c0.y), color_byte(c0.z), 255);
        return;
    }
    const struct zr_window_vertex *const v[3] = {&geometry->vertices[t->v[0]], &geometry->vertices[t->v[1]],
                                                 &geometry->vertices[t->v[2]]};
    const float oow[3] = {v[0]->oow, v[1]->oow, v[2]->oow};
    const struct basis basis = basis_make(t, v);
    surface->oow = plane_make(&basis, oow[0], oow[1], oow[2]);
    surface->red = plane_make(&basis, c0.x * oow[0], c1.x * oow[1], c2.x * oow[2]);
    surface->green = plane_make(&basis, c0.y * oow[0], c1.y * oow[1], c2.y * oow[2]);
    surface->blue = plane_make(&basis, c0.z * oow[0], c1.z * oow[1], c2.z * oow[2]);
}

/* Only what the frame's channels ask for: small records are set up as often as drawn. */
static void make_surface(const struct zr_geometry *geometry, const struct zr_frame *frame, uint32_t owner,
                         struct surface *surface)
{
    const struct zr_triangle *t = &geometry->triangles[owner - 1];
    surface->owner = owner;
    if (frame->color) make_color(geometry, t, surface);
    if (frame->depth) zr_eye_depth_make(geometry, t, frame->width, frame->height, &surface->eye_depth);
}

static void resolve_color(const struct surface *surface, const struct run *run, uint32_t *out)
{
    if (surface->flat) {
        for (int32_t i = 0; i < run->count; i++)
            out[i] = surface->flat_color;
        return;
    }
    const struct zr_plane w = surface->oow, r = surface->red, g = surface->green, b = surface->blue;
    const float y = (float)run->y;
    for (int32_t i = 0; i < run->count; i++) {
        float x = (float)(run->x + i);
        float reciprocal = 1.0f / zr_plane_at(&w, x, y);
        uint32_t red = color_byte(zr_plane_at(&r, x, y) * reciprocal);
        uint32_t green = color_byte(zr_plane_at(&g, x, y) * reciprocal);
        uint32_t blue = color_byte(zr_plane_at(&b, x, y) * reciprocal);
        out[i] = pack(red, green, blue, 255);
    }
}

static void resolve_depth(const struct surface *surface, const struct run *run, float *out)
{
    const struct zr_eye_depth depth = surface->eye_depth;
    for (int32_t i = 0; i < run->count; i++)
        out[i] = zr_eye_depth_at(&depth, run->x + i, run->y);
}

/* The base as it is; its depth in the tile is for the depth test only. */
static void resolve_base(const struct zr_frame *frame, const struct zr_base *base, size_t pixel, int32_t count)
{
    size_t bytes = (size_t)count * 4;
    if (frame->color && base->color) memcpy(frame->color + 4 * pixel, base->color + 4 * pixel, bytes);
    if (frame->depth && base->depth) memcpy(frame->depth + pixel, base->depth + pixel, bytes);
    if (frame->face_id && base->face_id) memcpy(frame->face_id + pixel, base->face_id + pixel, bytes);
    if (frame->window_depth && base->window_depth)
        memcpy(frame->window_depth + pixel, base->window_depth + pixel, bytes);
}

static void resolve_nothing(const struct zr_frame *frame, uint32_t background, size_t pixel, int32_t count)
{
    uint32_t *color = (uint32_t *)(void *)frame->color;
    for (int32_t i = 0; color && i < count; i++)
        color[pixel + (size_t)i] = background;
    for (int32_t i = 0; frame->depth && i < count; i++)
        frame->depth[pixel + (size_t)i] = INFINITY;
    if (frame->face_id) memset(frame->face_id + pixel, 0, (size_t)count * sizeof *frame->face_id);
    if (frame->base) resolve_base(frame, frame->base, pixel, count);
}

static void resolve_run(const struct zr_geometry *geometry, const struct surface *surface, const struct run *run,
                        const struct zr_frame *frame, size_t pixel)
{
    if (frame->color) resolve_color(surface, run, (uint32_t *)(void *)frame->color + pixel);
    if (frame->depth) resolve_depth(surface, run, frame->depth + pixel);
    if (!frame->face_id) return;
    uint32_t face = geometry->triangles[run->owner - 1].face + (frame->base ? frame->base->first_face_id - 1 : 0);
    for (int32_t i = 0; i < run->count; i++)
        frame->face_id[pixel + (size_t)i] = face;
}

uint32_t zr_resolve_tile(const struct zr_geometry *geometry, zr_vec4 background, const struct zr_tile *tile,
                         const struct zr_frame *frame)
{
    struct surface surfaces[SURFACES];
    for (int i = 0; i < SURFACES; i++)
        surfaces[i].owner = 0;
    uint32_t nothing =
        pack(color_byte(background.x), color_byte(background.y), color_byte(background.z), color_byte(background.w));
    uint32_t covered = 0;
    for (int32_t row = 0; row < tile->height; row++) {
        const uint32_t *owners = &tile->owner[row * ZR_TILE_SIZE];
        struct run run = {.y = tile->y + row};
        /* Window space has y up, pictures have row 0 on top. */
        size_t line = (size_t)(frame->height - 1 - (uint32_t)run.y) * frame->width + (size_t)tile->x;
        if (frame->window_depth)
            memcpy(frame->window_depth + line, &tile->depth[row * ZR_TILE_SIZE], (size_t)tile->width * sizeof(float));
        for (int32_t begin = 0, end; begin < tile->width; begin = end) {
            run.owner = owners[begin];
            for (end = begin + 1; end < tile->width && owners[end] == run.owner;)
                end++;
            run.x = tile->x + begin;
            run.count = end - begin;
            if (run.owner == 0) {
                resolve_nothing(frame, nothing, line + (size_t)begin, run.count);
                continue;
            }
            struct surface *surface = &surfaces[run.owner % SURFACES];
            if (surface->owner != run.owner) make_surface(geometry, frame, run.owner, surface);
            resolve_run(geometry, surface, &run, frame, line + (size_t)begin);
            covered += (uint32_t)run.count;
        }
    }
    return covered;
}
