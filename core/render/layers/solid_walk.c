#include "render/layers/solid_walk.h"

#include <string.h>

#include "render/layers/solid_boxes.h"
#include "scene/csg.h"
#include "shade/eye/eye_depth.h"

/* Window depths that differ by more are in order. Corners lie on a grid of 1/256 pixel, which moves the plane of a
 * triangle by its slope over half a step. */
#define ORDERED_APART (1.0f / 1024.0f)

/* Faces recur from sample to sample, so the last ones are kept. */
enum {
    REMEMBERED = 256,
    REMEMBERED_FRAGMENTS = 32,
    REMEMBERED_VALUES = 64,
    KIND_PARTS = 6,
    FRAGMENTS_PER_CANCEL_CHECK = 1 << 12
};

struct face {
    uint32_t owner; /* 0: none */
    uint8_t part;   /* of zr_csg */
    int8_t turn;    /* of the part's winding number, from the eye on */
    bool has_depth;
    struct zr_eye_depth depth;
};

/* A fragment in the order of the walk. */
struct step {
    double depth; /* along the view axis, if it was needed */
    uint64_t key;
};

/* The last list walked. A list of the same faces in the same order, all of them apart, has the same visible one. */
struct last {
    uint32_t count; /* 0: none */
    uint32_t seen;  /* number of the visible fragment; `count`: none */
    uint32_t owners[REMEMBERED_FRAGMENTS];
};

/* How the value of the tree follows from some of the parts, if the ray is in no other. */
enum kind {
    NONE, /* it is false: nothing of them is visible */
    ANY,  /* it is true in each of them: the nearest face is visible, as the z-buffer finds it */
    MIXED
};

struct zr_solid_walk {
    const struct zr_tile_source *tiles;
    const struct zr_csg *csg;
    const struct zr_eye_depths *kernel;
    const struct zr_cancel *cancel;
    const struct zr_draw *draw; /* of the last face */
    double x, y;                /* of the sample, from the window's lower left */
    struct step *steps;         /* fragments of one place of the list whose order must be found */
    uint32_t room;              /* capacity of steps */
    uint32_t unchecked;         /* fragments since the last look at `cancel` */
    bool is_stopped;            /* cancelled: what is found is undefined */
    int32_t windings[ZR_CSG_PARTS_MAX];
    struct last last;
    uint64_t insides[REMEMBERED_VALUES]; /* values of the tree that were found last; one slot per hash */
    bool values[REMEMBERED_VALUES];
    uint64_t kind_parts[REMEMBERED_VALUES]; /* kinds that were found last, likewise */
    enum kind kinds[REMEMBERED_VALUES];
    struct face faces[REMEMBERED];
};

/* Counts passed fragments. False if the request is cancelled, which is looked at once in a while. */
static bool goes_on(struct zr_solid_walk *walk, uint32_t count)
{
    walk->unchecked += count;
    if (walk->unchecked < FRAGMENTS_PER_CANCEL_CHECK) return !walk->is_stopped;
    walk->unchecked = 0;
    walk->is_stopped = walk->is_stopped || zr_is_cancelled(walk->cancel);
    return !walk->is_stopped;
}

/* ---- faces ---- */

static struct face *face_of(struct zr_solid_walk *walk, uint64_t key)
{
    const uint32_t owner = zr_fragment_owner(key);
    struct face *face = &walk->faces[owner % REMEMBERED];
    if (face->owner == owner) return face;
    const struct zr_geometry *geometry = walk->tiles->geometry;
    walk->draw = zr_draw_next(geometry, walk->draw, owner - 1);
    const uint32_t number = zr_draw_face(walk->draw, owner - 1 - walk->draw->first);
    face->owner = owner;
    face->part = (uint8_t)(zr_csg_part_of(walk->csg, walk->draw->instance, walk->draw->mesh, number) - 1);
    face->turn = zr_triangle_of(geometry, walk->draw, owner - 1).back ? -1 : 1;
    face->has_depth = false;
    return face;
}

static void make_depth(struct zr_solid_walk *walk, struct face *face)
{
    const struct zr_geometry *geometry = walk->tiles->geometry;
    const struct zr_draw *draw = zr_draw_of(geometry, face->owner - 1);
    const struct zr_triangle triangle = zr_triangle_of(geometry, draw, face->owner - 1);
    const struct zr_source source = zr_source_of(geometry, draw, triangle.v);
    const zr_vec4 *corners[1 + ZR_EYE_ROOM][3];
    struct zr_eye_depth out[1 + ZR_EYE_ROOM];
    memcpy(corners[0], source.corners, sizeof corners[0]);
    const bool is_behind =
        walk->kernel->make(source.instance, corners, 1, geometry->window.width, geometry->window.height, out) > 0;
    face->depth = out[0];
    if (is_behind && source.is_cut) zr_eye_depth_take_piece(geometry, &triangle, &face->depth);
    face->has_depth = true;
}

static double depth_at(struct zr_solid_walk *walk, uint64_t key)
{
    struct face *face = face_of(walk, key);
    if (!face->has_depth) make_depth(walk, face);
    const struct zr_eye_plane *p = &face->depth.depth, *one = &face->depth.one;
    const double depth =
        ((p->a0 + p->dady * walk->y) + p->dadx * walk->x) / ((one->a0 + one->dady * walk->y) + one->dadx * walk->x);
    return depth > face->depth.min ? depth < face->depth.max ? depth : face->depth.max : face->depth.min;
}

/* ---- order ---- */

static bool is_before(const struct step *a, const struct step *b)
{
    return a->depth < b->depth || (a->depth == b->depth && a->key < b->key);
}

static void sift(struct step *steps, uint32_t root, uint32_t count)
{
    const struct step moved = steps[root];
    for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && is_before(&steps[child], &steps[child + 1])) child++;
        if (!is_before(&moved, &steps[child])) break;
        steps[root] = steps[child];
        steps[child] = moved;
    }
}

/* Heap sort: in place, and never quadratic. */
static void sort(struct zr_solid_walk *walk, struct step *steps, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0 && goes_on(walk, 1);)
        sift(steps, i, count);
    for (uint32_t last = count; last-- > 1 && goes_on(walk, 1);) {
        const struct step step = steps[0];
        steps[0] = steps[last];
        steps[last] = step;
        sift(steps, 0, last);
    }
}

/* Returns the end of the fragments from `first` on whose order the z-buffer cannot tell. */
static uint32_t cluster_end(const uint64_t *keys, uint32_t first, uint32_t count)
{
    uint32_t end = first + 1;
    while (end < count && zr_fragment_depth(keys[end]) - zr_fragment_depth(keys[end - 1]) <= ORDERED_APART)
        end++;
    return end;
}

/* Orders the fragments first .. end - 1 along the ray. A fragment without a close neighbour has no depth. */
static void order(struct zr_solid_walk *walk, const uint64_t *keys, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end && goes_on(walk, 1); i++)
        walk->steps[i - first] = (struct step){end > first + 1 ? depth_at(walk, keys[i]) : 0.0, keys[i]};
    if (end > first + 1) sort(walk, walk->steps, end - first);
}

/* ---- the walk ---- */

/* Sets the windings at the eye, and the parts of the faces. Returns the parts that it is inside. If backs are missing, the far plane cuts the part. */
static uint64_t begin(struct zr_solid_walk *walk, const uint64_t *keys, uint32_t count, uint64_t *parts)
{
    uint64_t inside = 0;
    *parts = 0;
    memset(walk->windings, 0, walk->csg->part_count * sizeof *walk->windings);
    for (uint32_t i = 0; i < count && goes_on(walk, 1); i++) {
        const struct face *face = face_of(walk, keys[i]);
        walk->windings[face->part] -= face->turn;
        *parts |= UINT64_C(1) << face->part;
    }
    for (uint32_t i = 0; i < walk->csg->part_count; i++) {
        if (walk->windings[i] < 0) walk->windings[i] = 0;
        if (walk->windings[i] > 0) inside |= UINT64_C(1) << i;
    }
    return inside;
}

static uint32_t slot_of(uint64_t parts)
{
    return (uint32_t)(parts * UINT64_C(0x9E3779B97F4A7C15) >> 58);
}

/* zr_csg_value, found once for each combination of parts. */
static bool value_of(struct zr_solid_walk *walk, uint64_t inside)
{
    const uint32_t slot = slot_of(inside);
    if (walk->insides[slot] != inside) {
        walk->insides[slot] = inside;
        walk->values[slot] = zr_csg_value(walk->csg, inside);
    }
    return walk->values[slot];
}

/* Passes a fragment. Returns the parts that the ray is inside behind it. */
static uint64_t pass(struct zr_solid_walk *walk, uint64_t key, uint64_t inside)
{
    const struct face *face = face_of(walk, key);
    const uint64_t bit = UINT64_C(1) << face->part;
    walk->windings[face->part] += face->turn;
    return walk->windings[face->part] != 0 ? inside | bit : inside & ~bit;
}

/* Returns the earliest face in a group that belongs to one of the parts. */
static uint64_t first_of(struct zr_solid_walk *walk, const struct step *steps, uint32_t count, uint64_t parts)
{
    uint64_t first = 0;
    for (uint32_t i = 0; i < count; i++)
        if (parts >> face_of(walk, steps[i].key)->part & 1 &&
            (first == 0 || zr_fragment_owner(steps[i].key) < zr_fragment_owner(first)))
            first = steps[i].key;
    return first;
}

/* Returns the end of the steps from `first` on that lie at one place. */
static uint32_t group_end(const struct zr_solid_walk *walk, uint32_t first, uint32_t count)
{
    uint32_t end = first + 1;
    while (end < count && walk->steps[end].depth - walk->steps[first].depth <= walk->csg->tolerance)
        end++;
    return end;
}

/* Passes the ordered fragments. Returns the key of the one where the value of the tree is no longer `value`, or 0. */
static uint64_t pass_steps(struct zr_solid_walk *walk, uint32_t count, bool value, uint64_t *inside)
{
    for (uint32_t first = 0, end; first < count && goes_on(walk, 1); first = end) {
        uint64_t behind = *inside;
        end = group_end(walk, first, count);
        for (uint32_t i = first; i < end; i++)
            behind = pass(walk, walk->steps[i].key, behind);
        if (behind != *inside && value_of(walk, behind) != value)
            return first_of(walk, walk->steps + first, end - first, behind ^ *inside);
        *inside = behind;
    }
    return 0;
}

/* Returns the kind of up to KIND_PARTS parts; that of more is mixed. */
static enum kind find_kind(const struct zr_csg *csg, uint64_t parts)
{
    uint64_t each[KIND_PARTS], positive = 0;
    uint32_t count = 0;
    for (; parts != 0; parts &= parts - 1) {
        if (count == KIND_PARTS) return MIXED;
        each[count] = parts & (~parts + 1);
        if (zr_csg_value(csg, each[count])) positive |= each[count];
        count++;
    }
    for (uint32_t some = 0; some < 1u << count; some++) {
        uint64_t inside = 0;
        for (uint32_t i = 0; i < count; i++)
            if (some >> i & 1) inside |= each[i];
        if (zr_csg_value(csg, inside) != ((inside & positive) != 0)) return MIXED;
    }
    for (uint32_t i = 0; i < count; i++)
        if (positive != 0 && !(positive & each[i])) return MIXED;
    return positive != 0 ? ANY : NONE;
}

static enum kind kind_of(struct zr_solid_walk *walk, uint64_t parts)
{
    const uint32_t slot = slot_of(parts);
    if (walk->kind_parts[slot] != parts) {
        walk->kind_parts[slot] = parts;
        walk->kinds[slot] = find_kind(walk->csg, parts);
    }
    return walk->kinds[slot];
}

/* Returns the key of the visible fragment of a list, or 0. */
static uint64_t find_visible(struct zr_solid_walk *walk, const uint64_t *keys, uint32_t count)
{
    uint64_t parts, inside = begin(walk, keys, count, &parts), seen = 0;
    const enum kind kind = kind_of(walk, parts);
    if (kind != MIXED) return kind == ANY ? keys[0] : 0;
    const bool value = value_of(walk, inside);
    for (uint32_t first = 0, end; first < count && seen == 0 && !walk->is_stopped; first = end) {
        end = cluster_end(keys, first, count);
        order(walk, keys, first, end);
        seen = pass_steps(walk, end - first, value, &inside);
    }
    return seen;
}

/* True if all fragments are so far apart that the z-buffer tells their order. */
static bool are_apart(const uint64_t *keys, uint32_t count)
{
    bool are = true;
    for (uint32_t i = 1; i < count; i++)
        are &= zr_fragment_depth(keys[i]) - zr_fragment_depth(keys[i - 1]) > ORDERED_APART;
    return are;
}

static bool has_owners_of(const struct last *last, const uint64_t *keys)
{
    uint32_t other = 0;
    for (uint32_t i = 0; i < last->count; i++)
        other |= zr_fragment_owner(keys[i]) ^ last->owners[i];
    return other == 0;
}

/* Keeps the owners of a list and its visible fragment, for the next sample. */
static void keep(struct last *last, const uint64_t *keys, uint32_t count, uint64_t seen)
{
    last->count = last->seen = count;
    for (uint32_t i = 0; i < count; i++) {
        last->owners[i] = zr_fragment_owner(keys[i]);
        if (keys[i] == seen) last->seen = i;
    }
}

/* Returns the key of the visible fragment of a list, or 0. */
static uint64_t seen_of(struct zr_solid_walk *walk, const uint64_t *keys, uint32_t count)
{
    struct last *last = &walk->last;
    const bool is_plain = count <= REMEMBERED_FRAGMENTS && are_apart(keys, count);
    if (is_plain && count == last->count && has_owners_of(last, keys)) return last->seen < count ? keys[last->seen] : 0;
    const uint64_t seen = find_visible(walk, keys, count);
    if (is_plain) keep(last, keys, count, seen);
    return seen;
}

static bool put_samples(struct zr_solid_walk *walk, const struct zr_layers *layers, struct zr_tile *tile)
{
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const uint32_t place = (uint32_t)(y * ZR_TILE_STRIDE + x);
            uint32_t count;
            const uint64_t *keys = zr_fragments_of(&layers->fragments, place, &count);
            if (count == 0) continue;
            if (!goes_on(walk, count)) return false;
            walk->x = (double)(tile->x + x);
            walk->y = (double)(tile->y + y);
            const uint64_t key = seen_of(walk, keys, count);
            if (key == 0) continue;
            if (zr_tile_put_at(tile, place, zr_fragment_depth(key), zr_fragment_owner(key)) && tile->has_early_color)
                tile->early_color[place] = 0;
        }
    return true;
}

/* Makes the walk of a thread, which keeps it for its later tiles. */
static struct zr_solid_walk *walk_make(const struct zr_tile_source *tiles, const struct zr_cancel *cancel)
{
    struct zr_solid_walk *walk = zr_arena_alloc(tiles->layers->arena, 1, sizeof *walk);
    if (!walk) return NULL;
    walk->tiles = tiles;
    walk->csg = tiles->scene->csg;
    walk->kernel = zr_eye_depths_of(tiles->isa);
    walk->cancel = cancel;
    walk->draw = &tiles->geometry->draws[0];
    walk->room = walk->unchecked = walk->last.count = 0;
    walk->is_stopped = false;
    for (int i = 0; i < REMEMBERED; i++)
        walk->faces[i].owner = 0;
    for (int i = 0; i < REMEMBERED_VALUES; i++) {
        walk->insides[i] = walk->kind_parts[i] = 0;
        walk->kinds[i] = NONE;
        walk->values[i] = zr_csg_value(walk->csg, 0);
    }
    return walk;
}

/* Returns the thread's walk with room for the longest list. NULL without memory. */
static struct zr_solid_walk *walk_of(const struct zr_tile_source *tiles, const struct zr_cancel *cancel,
                                     struct zr_layers *layers)
{
    struct zr_layers_pool *pool = tiles->layers;
    pthread_mutex_lock(&pool->lock);
    if (!layers->walk) layers->walk = walk_make(tiles, cancel);
    struct zr_solid_walk *walk = layers->walk;
    if (walk && walk->room < layers->most) {
        walk->room = layers->most + layers->most / 2;
        walk->steps = zr_arena_alloc(pool->arena, walk->room, sizeof *walk->steps);
        if (!walk->steps) walk = NULL;
    }
    pthread_mutex_unlock(&pool->lock);
    return walk;
}

bool zr_solids_put(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                   struct zr_tile *tile)
{
    const struct zr_window *window = &tiles->geometry->window;
    struct zr_tile all;
    if (!tiles->solids || !zr_visibility_has_any(tiles->visibility, number, ZR_ALPHA_OPERAND)) return true;
    const enum kind kind = find_kind(tiles->scene->csg, zr_solid_boxes_at(tiles->solids, tile));
    if (kind == NONE) return true;
    zr_layers_write_all(tiles, tile);
    if (kind == ANY) return zr_visibility_draw(tiles->visibility, number, ZR_ALPHA_OPERAND, cancel, tile);
    struct zr_layers *layers = zr_layers_take(tiles->layers);
    if (!layers) return false;
    zr_tile_place(&all, number, window->width, window->height);
    zr_tile_begin(&all, NULL, window->width, window->height);
    all.has_early_color = false;
    bool is_done = zr_layers_find(tiles, number, ZR_ALPHA_OPERAND, cancel, &all, layers);
    if (is_done && layers->most > 0) {
        struct zr_solid_walk *walk = walk_of(tiles, cancel, layers);
        is_done = walk && put_samples(walk, layers, tile);
    }
    zr_layers_give(tiles->layers, layers);
    return is_done;
}
