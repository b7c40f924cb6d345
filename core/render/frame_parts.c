#include "render/frame_parts.h"

#include "base/cancel.h"
#include "base/run.h"
#include "mesh/features/part_features.h"
#include "sections/sections.h"

/* Owner ids of an instance, and its first part. */
struct owner {
    uint32_t begin, end; /* numbers of faces, lines and points, over all instances in order */
    uint64_t first_part;
};

static struct owner *list_owners(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct owner *owners = zr_arena_alloc(arena, scene->instance_count, sizeof *owners);
    uint64_t part = 0;
    uint32_t id = 0;
    for (uint32_t i = 0; owners && i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        owners[i] = (struct owner){id, id + (uint32_t)zr_mesh_ids(mesh), part};
        id = owners[i].end;
        part += zr_mesh_part_count(mesh);
    }
    return owners;
}

/* Returns the instance of an owner id, or `count` if it has none, such as pixels of a base. */
static uint32_t instance_of(const struct owner *owners, uint32_t count, uint32_t number)
{
    uint32_t low = 0, high = count;
    if (count == 0 || number >= owners[count - 1].end) return count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (owners[middle].begin <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Returns the number of the part that has an element of an instance; UINT64_MAX: none. */
static uint64_t part_of(const struct zr_mesh *mesh, const struct owner *owner, uint32_t number)
{
    const uint32_t face = number - owner->begin;
    if (!mesh->face_parts) return owner->first_part;
    return face < mesh->face_count ? owner->first_part + mesh->face_parts[face] : UINT64_MAX;
}

/* Returns the part of the cap with a face id; UINT64_MAX: it is none. */
static uint64_t part_of_cap(const struct zr_sections_cut *sections, const struct owner *owners, uint32_t number)
{
    if (!sections || number < sections->first_cap_id || number - sections->first_cap_id >= sections->cap_count)
        return UINT64_MAX;
    const struct zr_section_cap *cap = &sections->caps[number - sections->first_cap_id];
    return owners[cap->instance].first_part + cap->part;
}

enum zr_status zr_fragment_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_part_list list =
        frame->parts.list.count > 0 ? frame->parts.list : zr_part_list_make(run->arena, scene, ZR_FRAME_PARTS_MAX);
    const struct owner *owners = list_owners(run->scratch, scene);
    for (uint32_t i = 0; owners && i < frame->fragments.count; i++) {
        struct zr_pixel_fragment *fragment = &frame->fragments.at[i];
        const uint32_t number = fragment->face_id - 1, instance = instance_of(owners, scene->instance_count, number);
        const uint64_t part = instance < scene->instance_count
                                  ? part_of(&scene->meshes[scene->instances[instance].mesh], &owners[instance], number)
                                  : part_of_cap(frame->sections, owners, number);
        fragment->part = part < list.count ? list.at[part].name : NULL;
    }
    return owners && zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Names the part and the feature of a picked surface. */
static void name_picked(const struct zr_scene *scene, const struct zr_frame *frame, const struct owner *owners,
                        struct zr_picked *picked)
{
    const struct zr_frame_parts *parts = &frame->parts;
    const uint32_t number = picked->face_id - 1, instance = instance_of(owners, scene->instance_count, number);
    const bool is_face = instance < scene->instance_count;
    const uint64_t part = is_face
                              ? part_of(&scene->meshes[scene->instances[instance].mesh], &owners[instance], number)
                              : part_of_cap(frame->sections, owners, number);
    picked->is_cap = !is_face && part != UINT64_MAX;
    picked->part = part < parts->list.count ? (uint32_t)part : UINT32_MAX;
    if (picked->part == UINT32_MAX || picked->is_cap || !parts->features) return;
    picked->feature = zr_feature_find_at(&parts->features[picked->part], picked->point, picked->normal);
    picked->has_feature = picked->feature.kind != ZR_FEATURE_NONE;
}

enum zr_status zr_pick_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct owner *owners = list_owners(run->scratch, scene);
    for (uint32_t i = 0; owners && i < frame->picks.count; i++) {
        struct zr_pick *pick = &frame->picks.at[i];
        if (pick->is_hit) name_picked(scene, frame, owners, &pick->at);
        for (uint32_t k = 0; k < pick->behind_count; k++)
            name_picked(scene, frame, owners, &pick->behind[k]);
    }
    return owners ? ZR_OK : ZR_NO_MEMORY;
}

/* Returns false if cancelled. */
static bool count_pixels(const struct zr_scene *scene, const struct zr_frame *frame, const struct owner *owners,
                         const struct zr_cancel *cancel, uint64_t *pixels)
{
    const uint32_t first = frame->base ? frame->base->first_face_id : 1, count = scene->instance_count;
    const uint32_t *id = frame->face_id;
    uint32_t instance = 0;
    for (uint32_t y = 0; y < frame->height; y++) {
        if (zr_is_cancelled(cancel)) return false;
        for (uint32_t x = 0; x < frame->width; x++, id++) {
            const uint32_t number = *id - first; /* the base's smaller ids wrap to large numbers */
            if (*id == 0) continue;
            if (instance == count || number < owners[instance].begin || number >= owners[instance].end)
                instance = instance_of(owners, count, number);
            const struct zr_mesh *mesh = instance < count ? &scene->meshes[scene->instances[instance].mesh] : NULL;
            const uint64_t part =
                mesh ? part_of(mesh, &owners[instance], number) : part_of_cap(frame->sections, owners, number);
            if (part < frame->parts.list.count) pixels[part]++;
        }
    }
    return true;
}

static void sum_caps(const struct zr_sections_cut *sections, const struct owner *owners, uint32_t count, double *areas)
{
    for (uint32_t i = 0; i < sections->cap_count; i++) {
        const uint64_t part = owners[sections->caps[i].instance].first_part + sections->caps[i].part;
        if (part < count) areas[part] += sections->caps[i].area;
    }
}

/* Lists the parts, with room for their facts. Returns NULL without memory. */
static struct zr_part_facts *list_parts(struct zr_arena *arena, const struct zr_scene *scene,
                                        struct zr_known_parts *out)
{
    *out = (struct zr_known_parts){.list = zr_part_list_make(arena, scene, ZR_FRAME_PARTS_MAX)};
    struct zr_part_facts *facts = zr_arena_alloc(arena, out->list.count, sizeof *facts);
    out->facts = facts;
    return zr_arena_ok(arena) ? facts : NULL;
}

/* Finds the features of the parts if the scene asks for them. */
static enum zr_status find_features(const struct zr_run *run, const struct zr_scene *scene,
                                    struct zr_known_parts *parts)
{
    const struct zr_view *view = &scene->views[0];
    if (!scene->has_features && view->picks.count == 0 && !zr_annotate_needs_features(&view->annotate))
        return ZR_OK;
    struct zr_part_features *features = zr_arena_alloc(run->arena, parts->list.count, sizeof *features);
    parts->features = features;
    return features ? zr_part_features_find(run, scene, &parts->list, parts->facts, features) : ZR_NO_MEMORY;
}

enum zr_status zr_known_parts_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_known_parts *out)
{
    struct zr_part_facts *facts = list_parts(run->arena, scene, out);
    if (!facts) return ZR_NO_MEMORY;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    const enum zr_status status = zr_part_facts_find(&inner, scene, &out->list, facts);
    zr_arena_close_scratch(&scratch, run->arena);
    return status == ZR_OK ? find_features(run, scene, out) : status;
}

enum zr_status zr_frame_features_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_known_parts *known = scene->known_parts;
    struct zr_known_parts *own = zr_arena_alloc(run->arena, 1, sizeof *own);
    if (!own) return ZR_NO_MEMORY;
    const enum zr_status status = known && known->features ? ZR_OK : zr_known_parts_make(run, scene, own);
    if (status != ZR_OK) return status;
    if (!known || !known->features) known = own;
    frame->known_parts = known;
    frame->parts.list = known->list;
    frame->parts.facts = known->facts;
    frame->parts.features = known->features;
    return ZR_OK;
}

enum zr_status zr_frame_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct zr_frame_parts *parts = &frame->parts;
    struct zr_known_parts own;
    const struct zr_known_parts *known = frame->known_parts ? frame->known_parts : scene->known_parts;
    enum zr_status status = ZR_OK;
    if (!known) {
        struct zr_part_facts *facts = list_parts(run->arena, scene, &own);
        status = facts ? zr_part_facts_find(&inner, scene, &own.list, facts) : ZR_NO_MEMORY;
        if (status == ZR_OK) status = find_features(run, scene, &own);
        known = &own;
    }
    if (status != ZR_OK) return status;
    parts->list = known->list;
    parts->facts = known->facts;
    parts->features = known->features;
    uint64_t *pixels = zr_arena_zero(run->arena, parts->list.count, sizeof *pixels);
    double *areas = zr_arena_zero(run->arena, frame->sections ? parts->list.count : 0, sizeof *areas);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    if (!frame->face_id && !frame->sections) return ZR_OK;
    const struct owner *owners = list_owners(run->scratch, scene);
    if (!owners) return ZR_NO_MEMORY;
    if (frame->sections) sum_caps(frame->sections, owners, parts->list.count, areas);
    if (frame->sections) parts->cap_areas = areas;
    if (!frame->face_id) return ZR_OK;
    parts->pixels = pixels;
    return count_pixels(scene, frame, owners, run->cancel, pixels) ? ZR_OK : ZR_CANCELLED;
}
