#include "render/layer_surfaces.h"

#include <string.h>

#include "base/mutant.h"
#include "shade/models/xray.h"

enum { SIDE = ZR_SURFACES_SIDE, COLUMNS = ZR_SURFACES_COLUMNS, PIXELS = ZR_SURFACES_PIXELS, ROOM_AT_FIRST = 4096 };

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
};

/* Ensures room for the surfaces of one more primitive. What is given up is no larger than what is taken. */
static bool make_room(struct zr_layers_pool *pool, struct zr_layer_surfaces *s)
{
    if (s->count + PIXELS <= s->room) return true;
    if (s->room > UINT32_MAX / 4) return false;
    const uint32_t room = s->room ? 2 * s->room : ROOM_AT_FIRST;
    pthread_mutex_lock(&pool->lock);
    struct zr_layer_surface *at = zr_arena_alloc(pool->arena, room, sizeof *at);
    uint64_t *order = zr_arena_alloc(pool->arena, room, sizeof *order);
    pthread_mutex_unlock(&pool->lock);
    if (!at || !order) return false;
    if (s->count > 0) memcpy(at, s->at, s->count * sizeof *at);
    s->at = at;
    s->order = order;
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

/* Adds the surfaces of a row of pixels. */
static void put_row(const uint64_t *rows, int32_t y, uint32_t owner, struct zr_layer_surfaces *out)
{
    uint64_t any = rows[0] | rows[1] | rows[2] | rows[3];
    while (any) {
        const int column = __builtin_ctzll(any) / SIDE * SIDE;
        out->at[out->count++] = (struct zr_layer_surface){
            .owner = owner, .pixel = (uint16_t)(y * COLUMNS + column / SIDE), .mask = (uint16_t)mask_of(rows, column)};
        any &= ~(UINT64_C(0xF) << column);
    }
}

/* Ends the primitive of the marks and begins another one. Without memory, its surfaces are left out. */
static void turn(struct zr_fragment_marks *marks, uint32_t owner)
{
    struct marking *m = (struct marking *)marks; /* its first member */
    if (marks->begin > 0 && make_room(m->pool, m->out))
        for (int32_t y = 0; y < COLUMNS; y++)
            put_row(m->rows + y * SIDE, y, marks->begin, m->out);
    memset(m->rows, 0, sizeof m->rows);
    m->any_twice |= owner > 0 && owner <= m->last;
    m->last = owner;
    marks->begin = owner;
    marks->end = owner + 1;
}

/* Joins the surfaces of a primitive in a pixel, and puts all in the order of primitives: some algorithms draw all of them
 * row by row. */
static void join_parts(struct zr_layer_surfaces *s)
{
    uint64_t *keys = s->order;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->count; i++)
        keys[i] = (uint64_t)s->at[i].owner << 32 | (uint32_t)s->at[i].pixel << 16 | s->at[i].mask;
    zr_fragment_keys_sort(keys, s->count);
    for (uint32_t i = 0; i < s->count; i++)
        if (count > 0 && keys[i] >> 16 == keys[i - 1] >> 16)
            s->at[count - 1].mask |= (uint16_t)keys[i];
        else
            s->at[count++] = (struct zr_layer_surface){
                .owner = (uint32_t)(keys[i] >> 32), .pixel = (uint16_t)(keys[i] >> 16), .mask = (uint16_t)keys[i]};
    s->count = count;
}

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
    const bool is_complete = zr_layers_put_blended(tiles, number, cancel, tile, &fragments);
    turn(&marking.marks, 0);
    if (marking.any_twice) join_parts(surfaces);
    if (surfaces->count > 0)
        *out = surfaces;
    else
        zr_layer_surfaces_give(tiles, surfaces);
    return is_complete && zr_arena_ok(pool->arena);
}

/* ---- light ---- */

static void keep_light(const struct zr_surfaces *list, struct zr_layer_surface *at)
{
    const float *depths = list->floats[8]; /* eye space: z */
    for (uint32_t i = 0; i < list->list.count; i++) {
        at[i].depth = depths[i];
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

enum { SAMPLES = SIDE * SIDE, STEEP_LISTED = ZR_SAMPLES_LISTED / SAMPLES };

/* Lists each sample of a surface. */
static void list_samples(const struct zr_tile *tile, const struct zr_layer_surface *s, struct zr_sample_list *list)
{
    for (uint32_t left = s->mask; left; left &= left - 1) {
        const uint32_t sample = (uint32_t)__builtin_ctz(left), i = list->count++;
        list->x[i] = (float)(tile->x + s->pixel % COLUMNS * SIDE + (int32_t)sample % SIDE);
        list->y[i] = (float)(tile->y + s->pixel / COLUMNS * SIDE + (int32_t)sample / SIDE);
        list->owner[i] = s->owner;
    }
}

/* Gives the listed surfaces the means of the opacities at their samples. */
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
        const int samples = __builtin_popcount(listed[i]->mask);
        float sum = 0.0f;
        for (int k = 0; k < samples; k++)
            sum += *opacity++;
        listed[i]->color[3] = sum / (float)samples;
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
            list_samples(tile, &surfaces->at[i], &list->list);
        }
        if (count < STEEP_LISTED && (count == 0 || i + 1 < surfaces->count)) continue;
        put_means(light, list, room, listed, count);
        list->list.count = count = 0;
    }
}

/* ---- order ---- */

/* Returns bits in the order of the distances, of which the upper half is the float. */
static uint64_t key_of(float depth, uint32_t number)
{
    const float distance = ZR_MUTANT(layers_front_first, -depth, depth);
    uint32_t bits;
    memcpy(&bits, &distance, sizeof bits);
    bits ^= bits >> 31 ? UINT32_MAX : UINT32_C(1) << 31;
    return (uint64_t)bits << 32 | number;
}

/* Sorts the surfaces by pixels, and those of each pixel by distance. */
static void put_in_order(struct zr_layer_surfaces *s, const struct zr_cancel *cancel)
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
        s->order[next[s->at[i].pixel]++] = key_of(s->at[i].depth, i);
    for (uint32_t pixel = 0; pixel < PIXELS && !zr_is_cancelled(cancel); pixel++)
        zr_fragment_keys_sort(s->order + s->first[pixel], s->first[pixel + 1] - s->first[pixel]);
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
    put_in_order(surfaces, cancel);
}
