#include "scene/doubled_faces.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "scene/mesh_label.h"
#include "scene/output.h"
#include "scene/picture.h"

/* Sets of faces around a vertex: those that share its position's number, or those that share its place. */
enum sharing { SHARED_NUMBER, SHARED_PLACE };

/* Returns a number for the vertex of a corner: that of its position, or a hash of its place. */
static inline uint32_t vertex_at(const struct zr_mesh *mesh, uint32_t slot, enum sharing sharing)
{
    const uint32_t position = mesh->indices[slot];
    if (sharing == SHARED_NUMBER) return position;
    const zr_vec4 *p = &mesh->positions[position];
    const float at[4] = {p->x + 0.0f, p->y + 0.0f, p->z + 0.0f, p->w}; /* -0 equals 0 */
    uint32_t words[4], hash = ZR_HASH_BEGIN;
    memcpy(words, at, sizeof words);
    for (int i = 0; i < 4; i++)
        hash = zr_hash_word(hash, words[i]);
    return hash ^ hash >> 15;
}

/* Hashes vertices from `first` on, by steps of `step` modulo `count`. Source: FNV-1a, by words. The final mix keeps
 * sums of unrelated hashes from being 0. */
static uint64_t hash_ring(const struct zr_mesh *mesh, uint32_t begin, uint32_t count, uint32_t first, uint32_t step,
                          enum sharing sharing)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (uint32_t i = 0, k = first; i < count; i++, k = (k + step) % count)
        hash = (hash ^ vertex_at(mesh, begin + k, sharing)) * UINT64_C(1099511628211);
    hash = (hash ^ hash >> 31) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

/* Returns hashes that add up to 0 for a ring and its reverse. The hash starts at the least vertex and runs towards the
 * lesser of its neighbours; its sign is the direction. */
static uint64_t signed_hash(const struct zr_mesh *mesh, uint32_t begin, uint32_t end, enum sharing sharing)
{
    const uint32_t count = end - begin;
    uint32_t least = 0;
    for (uint32_t i = 1; i < count; i++)
        if (vertex_at(mesh, begin + i, sharing) < vertex_at(mesh, begin + least, sharing)) least = i;
    const uint32_t next = vertex_at(mesh, begin + (least + 1) % count, sharing),
                   last = vertex_at(mesh, begin + (least + count - 1) % count, sharing);
    return next < last ? hash_ring(mesh, begin, count, least, 1, sharing)
                       : 0 - hash_ring(mesh, begin, count, least, count - 1, sharing);
}

/* Finds the ring of a slot of `indices`: by a guess, which is right if all rings have the same size, or by bisection.
 */
static uint32_t ring_at(const uint32_t *offsets, uint32_t count, uint32_t slot)
{
    const uint32_t guess = (uint32_t)((uint64_t)slot * count / offsets[count]);
    if (offsets[guess] <= slot && slot < offsets[guess + 1]) return guess;
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        *(offsets[middle] <= slot ? &low : &high) = middle;
    }
    return low;
}

enum { TESTED = 256, SUMS = 4 * TESTED, AT_ONCE = 64 };

/* Sum over the rings at a tested vertex. */
struct sum {
    uint64_t hashes;
    bool has_rings;
};

/* Adds the rings at the tested vertices: those that are multiples of `step`, a power of two. Searches them in blocks
 * that compilers vectorise. If two vertices share a sum, they count as one. */
static inline void add_rings(const struct zr_mesh *mesh, uint32_t step, enum sharing sharing, struct sum sums[SUMS])
{
    const uint32_t *offsets = mesh->face_rings ? mesh->ring_offsets : mesh->face_offsets;
    const uint32_t count = mesh->face_rings ? mesh->face_rings[mesh->face_count] : mesh->face_count;
    const uint32_t end = offsets[count], mask = step - 1;
    for (uint32_t slot = 0; slot < end; slot += AT_ONCE) {
        const uint32_t behind = end - slot < AT_ONCE ? end : slot + AT_ONCE;
        uint32_t found = 0;
        for (uint32_t i = slot; i < behind; i++)
            found |= (vertex_at(mesh, i, sharing) & mask) == 0;
        for (uint32_t i = slot; found && i < behind; i++) {
            const uint32_t vertex = vertex_at(mesh, i, sharing);
            if (vertex & mask) continue;
            const uint32_t ring = ring_at(offsets, count, i);
            struct sum *sum = &sums[vertex / step % SUMS];
            sum->hashes += signed_hash(mesh, offsets[ring], offsets[ring + 1], sharing);
            sum->has_rings = true;
        }
    }
}

/* True if all faces at some tested vertex are doubled. */
static bool has_doubled_faces(const struct zr_mesh *mesh, enum sharing sharing)
{
    struct sum sums[SUMS] = {{0, false}};
    uint32_t step = 1;
    while (mesh->position_count / step > TESTED)
        step *= 2;
    if (sharing == SHARED_NUMBER)
        add_rings(mesh, step, SHARED_NUMBER, sums);
    else
        add_rings(mesh, step, SHARED_PLACE, sums);
    for (uint32_t i = 0; i < SUMS; i++)
        if (sums[i].has_rings && sums[i].hashes == 0) return true;
    return false;
}

/* From about this crease angle on, opposite faces are averaged (mesh/crease_normals.h). */
#define ALL_AROUND_DEGREES 179.9f

/* Sets of shadings for which the outputs average the normals of faces. */
struct averaging {
    unsigned by_number, by_place;
};

static struct averaging averaging_of(const struct zr_scene *scene)
{
    const struct zr_view *view = &scene->views[0];
    const bool has_color = zr_view_wants(view, ZR_CHANNEL_COLOR), is_linear = scene->picture->is_linear;
    struct averaging out = {0, 0};
    if ((has_color && !is_linear) || zr_view_wants(view, ZR_CHANNEL_NORMALS)) out.by_number = ZR_SHADINGS_SMOOTH;
    if (has_color && is_linear && scene->picture->crease_degrees > ALL_AROUND_DEGREES)
        out.by_place = ZR_SHADING_ALL & ~(zr_shadings_at(ZR_SHADED_NEVER) | zr_shadings_at(ZR_SHADED_PER_FACE));
    return out;
}

/* True if a filled face of the mesh has one of the shadings. */
static bool has_shading(const struct zr_scene *scene, const struct zr_mesh *mesh, unsigned shadings)
{
    const uint32_t count = mesh->face_materials ? mesh->face_count : mesh->face_count > 0;
    for (uint32_t face = 0; shadings && face < count; face++) {
        const struct zr_material *material = zr_material_of_face(scene, mesh, face);
        if (!material->unfilled && zr_shading_is_in(material->shading, shadings)) return true;
    }
    return false;
}

static bool lacks_normals(const struct zr_scene *scene, const struct zr_mesh *mesh, const struct averaging *averaging)
{
    if (mesh->normal_count > 0) return false;
    return (has_shading(scene, mesh, averaging->by_number) && has_doubled_faces(mesh, SHARED_NUMBER)) ||
           (has_shading(scene, mesh, averaging->by_place) && has_doubled_faces(mesh, SHARED_PLACE));
}

void zr_doubled_faces_warn(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *warnings)
{
    const struct averaging averaging = averaging_of(scene);
    uint32_t count = 0, first = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (lacks_normals(scene, &scene->meshes[i], &averaging) && count++ == 0) first = i;
    if (count == 0) return;
    char more[32] = "";
    if (count > 1) snprintf(more, sizeof more, " and %" PRIu32 " more", count - 1);
    zr_warning_list_add(arena, warnings,
                        "%s%s: at some vertices each face appears twice, once with each winding, so their "
                        "normals add up to 0; use \"shading\": \"flat\", or give each face once with \"doubleSided\"",
                        zr_mesh_label_of(first, scene->meshes[first].name).text, more);
}
