#include "mesh/facts/wall_tree.h"

#include "mesh/facts/closed_parts.h"

enum { DIGIT = 10, DIGITS = 1 << DIGIT, ITEMS_PER_CANCEL_CHECK = 1 << 14, NORMAL_BITS = 8 };

/* Arrays that are filled in. */
struct making {
    const struct zr_cancel *cancel;
    uint32_t (*corners)[3];
    float (*normals)[3];
    uint32_t *keys, *spare;
    double min[3], max[3];
};

static bool is_due(const struct making *m, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel);
}

void zr_wall_solid_places(const struct zr_wall_solid *solid, uint32_t triangle, struct zr_world_place out[3])
{
    for (int k = 0; k < 3; k++) {
        zr_world_place_of(solid->object_to_world, solid->mesh->positions[solid->corners[triangle][k]], &out[k]);
        out[k] = zr_world_place_minus(out[k], solid->origin);
    }
}

/* ---- triangles ---- */

static size_t triangles_most(const struct zr_wall_faces *faces)
{
    size_t count = 0;
    for (uint32_t i = faces->begin; i < faces->end; i++) {
        const struct zr_rings rings = zr_mesh_rings(faces->mesh, faces->faces ? faces->faces[i] : i);
        for (uint32_t r = 0; r < rings.count; r++) {
            const uint32_t corners = rings.offsets[r + 1] - rings.offsets[r];
            if (corners > 2) count += corners - 2;
        }
    }
    return count;
}

static size_t leaves_of(size_t triangles)
{
    return (triangles + ZR_WALL_LEAF - 1) / ZR_WALL_LEAF;
}

size_t zr_wall_solid_bytes(const struct zr_wall_faces *faces)
{
    const size_t count = triangles_most(faces), nodes = 2 * leaves_of(count);
    return 2 * nodes * sizeof(struct zr_wall_box) +
           count * (4 * sizeof(uint32_t) + 3 * sizeof(uint32_t) + 3 * sizeof(float));
}

static void add_triangle(struct making *m, struct zr_wall_solid *solid, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t number = solid->count;
    struct zr_world_place p[3];
    const uint32_t corners[3] = {a, b, c};
    memcpy(m->corners[number], corners, sizeof corners);
    zr_wall_solid_places(solid, number, p);
    const struct zr_world_place area =
        zr_world_place_cross(zr_world_place_minus(p[1], p[0]), zr_world_place_minus(p[2], p[0]));
    const double length = sqrt(zr_world_place_dot(area, area));
    for (int i = 0; i < 3; i++) {
        const double at[3] = {p[i].x, p[i].y, p[i].z};
        for (int k = 0; k < 3; k++) {
            m->min[k] = zr_least_of(m->min[k], at[k]);
            m->max[k] = zr_most_of(m->max[k], at[k]);
        }
    }
    if (!(length > 0.0 && length < HUGE_VAL)) return;
    m->normals[number][0] = (float)(area.x / length);
    m->normals[number][1] = (float)(area.y / length);
    m->normals[number][2] = (float)(area.z / length);
    solid->count++;
}

static bool add_faces(struct making *m, const struct zr_wall_faces *faces, struct zr_wall_solid *solid)
{
    const struct zr_mesh *mesh = faces->mesh;
    for (uint32_t i = faces->begin; i < faces->end; i++) {
        const uint32_t face = faces->faces ? faces->faces[i] : i;
        const struct zr_rings rings = zr_mesh_rings(mesh, face);
        if (is_due(m, i)) return false;
        for (uint32_t r = 0; r < rings.count; r++) {
            const uint32_t *at = mesh->indices + rings.offsets[r], count = rings.offsets[r + 1] - rings.offsets[r];
            const bool is_hole = r > 0 && zr_ring_turns_as_first(mesh, &rings, r), turns = is_hole != faces->is_turned;
            for (uint32_t k = 2; k < count; k++)
                add_triangle(m, solid, at[0], at[turns ? k : k - 1], at[turns ? k - 1 : k]);
        }
    }
    return true;
}

/* ---- orders ---- */

/* Spreads the lowest 10 bits to every third bit. */
static uint32_t spread_to_thirds(uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

static uint32_t spread_to_halves(uint32_t x)
{
    x = (x | x << 4) & 0x0f0fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
}

/* Cells of space along a curve in the order of Morton. */
static uint32_t key_of_place(const struct making *m, const struct zr_wall_solid *solid, uint32_t triangle)
{
    struct zr_world_place p[3];
    uint32_t key = 0;
    zr_wall_solid_places(solid, triangle, p);
    const double middle[3] = {(p[0].x + p[1].x + p[2].x) / 3.0, (p[0].y + p[1].y + p[2].y) / 3.0,
                              (p[0].z + p[1].z + p[2].z) / 3.0};
    for (int k = 0; k < 3; k++) {
        const double side = m->max[k] - m->min[k];
        const double cell = side > 0.0 ? (middle[k] - m->min[k]) / side * 1023.0 : 0.0;
        key |= spread_to_thirds((uint32_t)zr_most_of(0.0, zr_least_of(cell, 1023.0))) << k;
    }
    return key;
}

/* Cells of an octahedron, whose middles have the directions of the axes. */
static uint32_t key_of_normal(const float n[3])
{
    const float sum = fabsf(n[0]) + fabsf(n[1]) + fabsf(n[2]), half = (float)((1 << (NORMAL_BITS - 1)) - 1);
    float u = n[0] / sum, v = n[1] / sum;
    if (n[2] < 0.0f) {
        const float folded = (1.0f - fabsf(v)) * (u < 0.0f ? -1.0f : 1.0f);
        v = (1.0f - fabsf(u)) * (v < 0.0f ? -1.0f : 1.0f);
        u = folded;
    }
    const uint32_t x = (uint32_t)((u + 1.0f) * half + 0.5f), y = (uint32_t)((v + 1.0f) * half + 0.5f);
    return spread_to_halves(x & 255u) | spread_to_halves(y & 255u) << 1;
}

/* Sorts `order` by the lowest bits of the keys of its triangles; equal ones keep their order. */
static bool sort_by_keys(const struct making *m, uint32_t *order, uint32_t count, int bits)
{
    for (int shift = 0; shift < bits; shift += DIGIT) {
        uint32_t begins[DIGITS + 1] = {0};
        for (uint32_t i = 0; i < count && !is_due(m, i); i++)
            begins[(m->keys[i] >> shift) % DIGITS + 1]++;
        for (int d = 0; d < DIGITS; d++)
            begins[d + 1] += begins[d];
        for (uint32_t i = 0; i < count; i++) {
            if (is_due(m, i)) return false;
            m->spare[begins[(m->keys[order[i]] >> shift) % DIGITS]++] = order[i];
        }
        memcpy(order, m->spare, count * sizeof *order);
    }
    return true;
}

static void make_orders(struct making *m, const struct zr_wall_solid *solid, uint32_t *around, uint32_t *along)
{
    for (uint32_t i = 0; i < solid->count && !is_due(m, i); i++) {
        around[i] = i;
        m->keys[i] = key_of_place(m, solid, i);
    }
    if (!sort_by_keys(m, around, solid->count, 30)) return;
    memcpy(along, around, solid->count * sizeof *along);
    for (uint32_t i = 0; i < solid->count && !is_due(m, i); i++)
        m->keys[i] = key_of_normal(m->normals[i]);
    sort_by_keys(m, along, solid->count, 2 * NORMAL_BITS);
}

/* ---- boxes ---- */

static void clear(struct zr_wall_box *box)
{
    for (int k = 0; k < 3; k++) {
        box->min[k] = HUGE_VAL;
        box->max[k] = -HUGE_VAL;
        box->low[k] = 2.0f;
        box->high[k] = -2.0f;
    }
}

static void join(struct zr_wall_box *box, const struct zr_wall_box *more)
{
    for (int k = 0; k < 3; k++) {
        box->min[k] = zr_least_of(box->min[k], more->min[k]);
        box->max[k] = zr_most_of(box->max[k], more->max[k]);
        if (more->low[k] < box->low[k]) box->low[k] = more->low[k];
        if (more->high[k] > box->high[k]) box->high[k] = more->high[k];
    }
}

static struct zr_wall_box box_of(const struct zr_wall_solid *solid, uint32_t triangle)
{
    struct zr_wall_box box;
    struct zr_world_place p[3];
    zr_wall_solid_places(solid, triangle, p);
    for (int k = 0; k < 3; k++) {
        const double a = k == 0   ? p[0].x
                         : k == 1 ? p[0].y
                                  : p[0].z,
                     b = k == 0   ? p[1].x
                         : k == 1 ? p[1].y
                                  : p[1].z,
                     c = k == 0   ? p[2].x
                         : k == 1 ? p[2].y
                                  : p[2].z;
        box.min[k] = zr_least_of(a, zr_least_of(b, c));
        box.max[k] = zr_most_of(a, zr_most_of(b, c));
        box.low[k] = box.high[k] = solid->normals[triangle][k];
    }
    return box;
}

static void fill_tree(const struct making *m, const struct zr_wall_solid *solid, const uint32_t *order,
                      struct zr_wall_box *boxes)
{
    for (uint32_t leaf = 0; leaf < solid->leaf_count && !is_due(m, leaf); leaf++) {
        struct zr_wall_box *box = &boxes[solid->leaf_count + leaf];
        clear(box);
        for (uint32_t i = ZR_WALL_LEAF * leaf; i < solid->count && i < ZR_WALL_LEAF * (leaf + 1); i++) {
            const struct zr_wall_box own = box_of(solid, order[i]);
            join(box, &own);
        }
    }
    for (uint32_t node = solid->leaf_count; node-- > 1;) {
        boxes[node] = boxes[2 * node];
        join(&boxes[node], &boxes[2 * node + 1]);
    }
}

/* ---- all steps ---- */

bool zr_wall_solid_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_wall_faces *faces,
                        struct zr_wall_solid *out)
{
    const size_t triangles = triangles_most(faces), nodes = 2 * leaves_of(triangles);
    void *room = zr_arena_alloc(arena, zr_wall_solid_bytes(faces), 1); /* one block, whose size is known before */
    if (!room) return false;
    struct zr_wall_box *around_boxes = room, *along_boxes = around_boxes + nodes;
    struct making m = {.cancel = cancel,
                       .corners = (uint32_t(*)[3])(void *)(along_boxes + nodes),
                       .min = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                       .max = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    m.normals = (float(*)[3])(void *)(m.corners + triangles);
    m.keys = (uint32_t *)(void *)(m.normals + triangles);
    m.spare = m.keys + triangles;
    uint32_t *around = m.spare + triangles, *along = around + triangles;
    *out = (struct zr_wall_solid){.mesh = faces->mesh,
                                  .object_to_world = faces->object_to_world,
                                  .corners = (const uint32_t(*)[3])m.corners,
                                  .normals = (const float(*)[3])m.normals,
                                  .along = {along, along_boxes},
                                  .around = {around, around_boxes}};
    const uint32_t first = faces->faces ? faces->faces[faces->begin] : faces->begin;
    zr_world_place_of(faces->object_to_world,
                      faces->mesh->positions[faces->mesh->indices[faces->mesh->face_offsets[first]]], &out->origin);
    if (!add_faces(&m, faces, out)) return false;
    out->leaf_count = (uint32_t)leaves_of(out->count);
    if (out->count == 0) return true;
    const double origin[3] = {out->origin.x, out->origin.y, out->origin.z};
    double squares = 0.0, far = 0.0;
    for (int k = 0; k < 3; k++) {
        squares += (m.max[k] - m.min[k]) * (m.max[k] - m.min[k]);
        far = zr_most_of(far, zr_most_of(fabs(m.min[k] + origin[k]), fabs(m.max[k] + origin[k])));
    }
    out->size = sqrt(squares);
    out->step = zr_most_of(1e-6 * out->size, (double)FLT_EPSILON * far);
    make_orders(&m, out, around, along);
    if (zr_is_cancelled(cancel)) return false;
    fill_tree(&m, out, around, around_boxes);
    fill_tree(&m, out, along, along_boxes);
    return !zr_is_cancelled(cancel);
}
