#include "render/layers/layer_surfaces.h"

#include <string.h>

#include "base/mutant.h"
#include "shade/models/xray.h"

enum {
    SIDE = ZR_SURFACES_SIDE,
    SAMPLES = SIDE * SIDE,
    COLUMNS = ZR_SURFACES_COLUMNS,
    PIXELS = ZR_SURFACES_PIXELS,
    ROOM_AT_FIRST = 4096
};

/* ---- the pool ---- */

static struct zr_layer_surfaces *take(struct zr_layers_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    struct zr_layer_surfaces *surfaces = pool->free_surfaces;
    if (surfaces)
        pool->free_surfaces = surfaces->next;
    else
        surfaces = zr_arena_zero(pool->arena, 1, sizeof *surfaces);
    pthread_mutex_unlock(&pool->lock);
    if (surfaces) surfaces->count = 0;
    return surfaces;
}

void zr_layer_surfaces_give(const struct zr_tile_source *tiles, struct zr_layer_surfaces *surfaces)
{
    struct zr_layers_pool *pool = tiles->layers;
    pthread_mutex_lock(&pool->lock);
    surfaces->next = pool->free_surfaces;
    pool->free_surfaces = surfaces;
    pthread_mutex_unlock(&pool->lock);
}

/* ---- masks of primitives ---- */

/* The samples of the primitive that is being drawn. */
struct marking {
    struct zr_fragment_marks marks;
    struct zr_layers_pool *pool;
    struct zr_layer_surfaces *out;
    uint32_t last;  /* primitive */
    bool any_twice; /* primitives may have come twice, or out of order */
    uint64_t rows[ZR_TILE_SIZE];
    _Alignas(64) float depths[ZR_LAYER_FLOATS];
};

/* Ensures room for more surfaces. The array that is given up is no larger than the one that is taken. */
static bool make_room(struct zr_layers_pool *pool, uint32_t more, struct zr_layer_surfaces *s)
{
    uint32_t room = s->room ? s->room : ROOM_AT_FIRST;
    if (s->count + more <= s->room) return true;
    while (s->count + more > room && room <= UINT32_MAX / 4)
        room *= 2;
    if (s->count + more > room) return false;
    pthread_mutex_lock(&pool->lock);
    struct zr_layer_surface *at = zr_arena_alloc(pool->arena, room, sizeof *at);
    uint64_t *order = zr_arena_alloc(pool->arena, room, sizeof *order);
    pthread_mutex_unlock(&pool->lock);
    if (!at || !order) return false;
    if (s->count > 0) memcpy(at, s->at, s->count * sizeof *at);
    s->at = at;
    s->order = order;
    s->spare = NULL;
    s->room = room;
    return true;
}

static uint32_t mask_of(const uint64_t *rows, int column)
{
    uint32_t mask = 0;
    for (int y = 0; y < SIDE; y++)
        mask |= (uint32_t)(rows[y] >> column & 0xF) << (SIDE * y);
    return mask;
}

/* Sets the depths of the samples at a place of the tile. */
static void set_depths(const struct marking *m, size_t place, struct zr_layer_surface *out)
{
    for (size_t y = 0; y < SIDE; y++)
        memcpy(out->depths + y * SIDE, m->depths + place + y * ZR_TILE_STRIDE, SIDE * sizeof *out->depths);
    out->depth = out->near = out->far = out->depths[zr_surface_nearest_of(out->mask)];
    for (uint32_t left = out->mask; left; left &= left - 1) {
        const float depth = out->depths[__builtin_ctz(left)];
        if (depth < out->near) out->near = depth;
        if (depth > out->far) out->far = depth;
    }
}

/* Adds the surfaces of row y of pixels. */
static void put_row(const struct marking *m, int32_t y, uint32_t owner, struct zr_layer_surfaces *out)
{
    const uint64_t *rows = m->rows + y * SIDE;
    uint64_t any = rows[0] | rows[1] | rows[2] | rows[3];
    while (any) {
        const int32_t column = __builtin_ctzll(any) / SIDE * SIDE;
        struct zr_layer_surface *added = &out->at[out->count++];
        added->owner = owner;
        added->pixel = (uint16_t)(y * COLUMNS + column / SIDE);
        added->mask = (uint16_t)mask_of(rows, column);
        set_depths(m, (size_t)(y * SIDE * ZR_TILE_STRIDE + column), added);
        any &= ~(UINT64_C(0xF) << column);
    }
}

/* Ends the primitive of the marks and begins another one. Without memory, its surfaces are left out. */
static void turn(struct zr_fragment_marks *marks, uint32_t owner)
{
    struct marking *m = (struct marking *)marks; /* its first member */
    if (marks->begin > 0 && make_room(m->pool, PIXELS, m->out))
        for (int32_t y = 0; y < COLUMNS; y++)
            put_row(m, y, marks->begin, m->out);
    memset(m->rows, 0, sizeof m->rows);
    m->any_twice |= owner > 0 && owner <= m->last;
    m->last = owner;
    marks->begin = owner;
    marks->end = owner + 1;
}

/* ---- order ---- */

typedef uint64_t key_fn(const struct zr_layer_surface *surface);

/* Depths are not negative: their bits have their order. */
static uint64_t by_depth(const struct zr_layer_surface *surface)
{
    uint32_t bits;
    memcpy(&bits, &surface->depth, sizeof bits);
    return ZR_MUTANT(layers_front_first, bits, UINT32_MAX - bits);
}

static uint64_t by_owner(const struct zr_layer_surface *surface)
{
    return surface->owner;
}

/* Sorts the surfaces by pixels, and those of each pixel by a key of 32 bits. */
static void put_in_order(struct zr_layer_surfaces *s, key_fn *key, const struct zr_cancel *cancel)
{
    uint32_t next[PIXELS] = {0}, begin = 0;
    for (uint32_t i = 0; i < s->count; i++)
        next[s->at[i].pixel]++;
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        s->first[pixel] = begin;
        begin += next[pixel];
        next[pixel] = s->first[pixel];
    }
    s->first[PIXELS] = begin;
    for (uint32_t i = 0; i < s->count; i++)
        s->order[next[s->at[i].pixel]++] = key(&s->at[i]) << 32 | i;
    for (uint32_t pixel = 0; pixel < PIXELS && !zr_is_cancelled(cancel); pixel++)
        zr_fragment_keys_sort(s->order + s->first[pixel], s->first[pixel + 1] - s->first[pixel]);
}

/* ---- surfaces that cross ---- */

/* Depths of surfaces in one place differ by rounding, and then no sample tells more than another. */
#define COINCIDENT 1e-6f

enum { CROSSING_MOST = 64 /* surfaces of a pixel that are compared with one another */ };

/* True if surface j is in front of i at a sample of both. `i` is in front in the order of the pixel. */
static bool do_cross(const struct zr_layer_surfaces *s, uint32_t i, uint32_t j)
{
    const struct zr_layer_surface *a = &s->at[i], *b = &s->at[j];
    if (a->far < b->near) return false;
    for (uint32_t left = a->mask & b->mask; left; left &= left - 1) {
        const float near = a->depths[__builtin_ctz(left)], far = b->depths[__builtin_ctz(left)];
        if (near > far + COINCIDENT) return true;
    }
    return false;
}

static bool any_cross(const struct zr_layer_surfaces *s, uint32_t pixel)
{
    const uint32_t begin = s->first[pixel], end = s->first[pixel + 1];
    for (uint32_t i = begin; i < end && end - begin <= CROSSING_MOST; i++)
        for (uint32_t j = i + 1; j < end; j++)
            if (do_cross(s, (uint32_t)s->order[i], (uint32_t)s->order[j])) return true;
    return false;
}

/* Makes each sample of a surface a surface behind the others, and leaves none of its own. */
static void split(struct zr_layer_surfaces *s, uint32_t i)
{
    for (uint32_t left = s->at[i].mask; left; left &= left - 1) {
        struct zr_layer_surface *sample = &s->at[s->count++];
        *sample = s->at[i];
        sample->mask = (uint16_t)(left & -left);
        sample->depth = sample->depths[__builtin_ctz(left)];
    }
    s->at[i].mask = 0;
}

/* Splits the surfaces of pixels in which some cross. Returns false if there are none, or no memory. */
static bool split_crossing(struct zr_layers_pool *pool, const struct zr_cancel *cancel, struct zr_layer_surfaces *s)
{
    bool crosses[PIXELS];
    uint32_t more = 0;
    for (uint32_t pixel = 0; pixel < PIXELS && !zr_is_cancelled(cancel); pixel++) {
        crosses[pixel] = any_cross(s, pixel);
        if (crosses[pixel]) more += SAMPLES * (s->first[pixel + 1] - s->first[pixel]);
    }
    if (more == 0 || zr_is_cancelled(cancel) || !make_room(pool, more, s)) return false;
    for (uint32_t i = 0, all = s->count; i < all; i++)
        if (crosses[s->at[i].pixel]) split(s, i);
    return true;
}

/* ---- primitives that come more than once ---- */

static bool join(const struct zr_layer_surface *part, struct zr_layer_surface *whole)
{
    if (part->pixel != whole->pixel || part->owner != whole->owner) return false;
    for (uint32_t left = part->mask; left; left &= left - 1)
        whole->depths[__builtin_ctz(left)] = part->depths[__builtin_ctz(left)];
    if (part->near < whole->near) whole->near = part->near;
    if (part->far > whole->far) whole->far = part->far;
    whole->mask |= part->mask;
    whole->depth = whole->depths[zr_surface_nearest_of(whole->mask)];
    return true;
}

/* Joins the surfaces of a primitive in a pixel: some algorithms draw all primitives row by row. Puts those of a pixel
 * in the order of primitives. Returns false if out of memory. */
static bool join_parts(struct zr_layers_pool *pool, const struct zr_cancel *cancel, struct zr_layer_surfaces *s)
{
    const uint32_t all = s->count;
    if (!s->spare) {
        pthread_mutex_lock(&pool->lock);
        s->spare = zr_arena_alloc(pool->arena, s->room, sizeof *s->spare);
        pthread_mutex_unlock(&pool->lock);
    }
    if (!s->spare) return false;
    put_in_order(s, by_owner, cancel);
    s->count = 0;
    for (uint32_t i = 0; i < all; i++) {
        const struct zr_layer_surface *part = &s->at[(uint32_t)s->order[i]];
        if (s->count == 0 || !join(part, &s->spare[s->count - 1])) s->spare[s->count++] = *part;
    }
    struct zr_layer_surface *at = s->at;
    s->at = s->spare;
    s->spare = at;
    return true;
}

/* ---- surfaces of a tile ---- */

bool zr_layer_surfaces_find(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                            struct zr_tile *tile, struct zr_layer_surfaces **out)
{
    struct zr_layers_pool *pool = tiles->layers;
    *out = NULL;
    if (!zr_layers_has_blended(tiles, number)) return true;
    struct zr_layer_surfaces *surfaces = take(pool);
    if (!surfaces) return false;
    struct marking marking = {.marks = {.turn = turn, .stride = ZR_TILE_STRIDE}, .pool = pool, .out = surfaces};
    struct zr_fragments fragments = {.marks = &marking.marks};
    marking.marks.rows = marking.rows;
    marking.marks.depths = marking.depths;
    const bool is_complete = zr_layers_put_blended(tiles, number, cancel, tile, &fragments);
    turn(&marking.marks, 0);
    const bool are_joined = !marking.any_twice || join_parts(pool, cancel, surfaces);
    if (surfaces->count > 0)
        *out = surfaces;
    else
        zr_layer_surfaces_give(tiles, surfaces);
    return is_complete && are_joined && zr_arena_ok(pool->arena);
}

/* ---- light ---- */

static void keep_light(const struct zr_surfaces *list, struct zr_layer_surface *at)
{
    for (uint32_t i = 0; i < list->list.count; i++) {
        for (int k = 0; k < 3; k++)
            at[i].color[k] = list->color[k][i];
        at[i].color[3] = list->occlusion[i];
    }
}

/* Lights `count` surfaces of any pixels. */
static void light_listed(const struct zr_layer_light *light, const struct zr_tile *tile, struct zr_surfaces *list,
                         struct zr_sample_room *room, struct zr_layer_surface *at, uint32_t count)
{
    const struct zr_tile_source *tiles = light->tiles;
    float *const color[3] = {list->color[0], list->color[1], list->color[2]}, *opacity = list->occlusion;
    zr_layer_surfaces_list_of(tiles->isa)(at, count, tile, &list->list);
    struct zr_gbuffer values = zr_surfaces_gbuffer(list);
    values.opacity = opacity; /* they have no occlusion */
    zr_samples_at_of(tiles->isa)(tiles->geometry, tiles->attributes, &list->list, room, &values);
    zr_linear_light_of(tiles->isa)(light->lighting, &values, NULL, color);
    if (light->has_xrays) zr_xray_of(tiles->isa)(light->lighting, &values, opacity);
    keep_light(list, at);
}

/* ---- surfaces that turn away within a pixel ---- */

/* Surfaces that are as opaque as this are nearly edge-on, where opacity can change much within a pixel. */
#define STEEP 0.35f

enum { QUARTERS = 4, STEEP_LISTED = ZR_SAMPLES_LISTED / QUARTERS };

/* Samples of each quarter of a pixel. The first of all four lie in different rows and columns. */
static const uint8_t quarters[QUARTERS][SAMPLES / QUARTERS] = {
    {1, 5, 4, 0}, {7, 6, 2, 3}, {8, 9, 13, 12}, {14, 10, 11, 15}};

/* Returns the samples of a mask in a quarter of the pixel. */
static uint32_t in_quarter(uint32_t mask, int quarter)
{
    static const uint32_t of[QUARTERS] = {0x0033, 0x00CC, 0x3300, 0xCC00};
    return mask & of[quarter];
}

/* Lists a sample of each quarter that the surface covers: the first of it in the mask. */
static void list_quarters(const struct zr_tile *tile, const struct zr_layer_surface *s, struct zr_sample_list *list)
{
    for (int q = 0; q < QUARTERS; q++) {
        if (in_quarter(s->mask, q) == 0) continue;
        const uint8_t *at = quarters[q];
        while (!(s->mask >> *at & 1u))
            at++;
        const uint32_t i = list->count++;
        list->x[i] = (float)(tile->x + s->pixel % COLUMNS * SIDE + *at % SIDE);
        list->y[i] = (float)(tile->y + s->pixel / COLUMNS * SIDE + *at / SIDE);
        list->owner[i] = s->owner;
    }
}

/* Gives the listed surfaces the means of the opacities of their samples; those of a quarter have one opacity. */
static void put_means(const struct zr_layer_light *light, struct zr_surfaces *list, struct zr_sample_room *room,
                      struct zr_layer_surface *const *listed, uint32_t count)
{
    const struct zr_tile_source *tiles = light->tiles;
    struct zr_gbuffer values = zr_surfaces_gbuffer(list);
    float *opacity = list->occlusion;
    values.opacity = opacity;
    zr_samples_at_of(tiles->isa)(tiles->geometry, tiles->attributes, &list->list, room, &values);
    zr_xray_of(tiles->isa)(light->lighting, &values, opacity);
    for (uint32_t i = 0; i < count; i++) {
        float sum = 0.0f;
        for (int q = 0; q < QUARTERS; q++) {
            const uint32_t samples = in_quarter(listed[i]->mask, q);
            if (samples) sum += (float)__builtin_popcount(samples) * *opacity++;
        }
        listed[i]->color[3] = sum / (float)__builtin_popcount(listed[i]->mask);
    }
}

static void light_steep(const struct zr_layer_light *light, const struct zr_tile *tile, const struct zr_cancel *cancel,
                        struct zr_surfaces *list, struct zr_sample_room *room, struct zr_layer_surfaces *surfaces)
{
    struct zr_layer_surface *listed[STEEP_LISTED];
    uint32_t count = 0;
    list->list.count = 0;
    for (uint32_t i = 0; i < surfaces->count && !zr_is_cancelled(cancel); i++) {
        if (surfaces->at[i].color[3] > ZR_MUTANT(steep_at_middle, STEEP, 2.0f)) {
            listed[count++] = &surfaces->at[i];
            list_quarters(tile, &surfaces->at[i], &list->list);
        }
        if (count < STEEP_LISTED && (count == 0 || i + 1 < surfaces->count)) continue;
        put_means(light, list, room, listed, count);
        list->list.count = count = 0;
    }
}

static void leave_glass(const struct zr_layer_light *light, struct zr_layer_surfaces *surfaces)
{
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        uint32_t hidden = 0;
        for (uint32_t i = surfaces->first[pixel + 1]; i-- > surfaces->first[pixel];) {
            struct zr_layer_surface *s = &surfaces->at[(uint32_t)surfaces->order[i]];
            if (zr_material_refracts(zr_draw_of(light->tiles->geometry, s->owner - 1)->material)) hidden |= s->mask;
            if (s->mask & hidden) s->color[3] = 0.0f;
        }
    }
}

void zr_layer_surfaces_light(const struct zr_layer_light *light, const struct zr_tile *tile,
                             const struct zr_cancel *cancel, struct zr_surfaces *list, struct zr_sample_room *room,
                             struct zr_layer_surfaces *surfaces)
{
    for (uint32_t i = 0; i < surfaces->count && !zr_is_cancelled(cancel); i += ZR_SAMPLES_LISTED) {
        const uint32_t left = surfaces->count - i;
        light_listed(light, tile, list, room, surfaces->at + i, left < ZR_SAMPLES_LISTED ? left : ZR_SAMPLES_LISTED);
    }
    if (light->has_xrays) light_steep(light, tile, cancel, list, room, surfaces);
    put_in_order(surfaces, by_depth, cancel);
    if (split_crossing(light->tiles->layers, cancel, surfaces)) put_in_order(surfaces, by_depth, cancel);
    if (light->leaves_glass && !zr_is_cancelled(cancel)) leave_glass(light, surfaces);
}
