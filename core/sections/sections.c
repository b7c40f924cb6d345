#include "sections/sections.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/run.h"
#include "mesh/facts/closed_parts.h"
#include "scene/parts/part_list.h"
#include "scene/picture.h"
#include "sections/cap_area.h"
#include "sections/hatch.h"

enum { FACES_PER_CANCEL_CHECK = 1 << 13, POSITIONS_PER_CANCEL_CHECK = 1 << 17 };

struct cutting {
    const struct zr_run *run;
    const struct zr_scene *scene;
    const struct zr_section_planes *planes;
    double diagonal, pitch;
    const uint8_t **closed;      /* per mesh; NULL: not found yet */
    struct zr_part_list names;   /* only if needed */
    const uint64_t *first_parts; /* per instance: number of its first part in the list */
    const uint8_t *is_uncut;     /* per part of the list; NULL: all parts are cut */
    struct zr_scene *out;
    struct zr_mesh *meshes; /* those of the scene, then made ones */
    struct zr_instance *instances;
    uint32_t *owners;              /* as in zr_scene; NULL: none */
    const uint32_t **numbers;      /* per instance: zr_sectioned.numbers; NULL: not cut */
    struct zr_material *materials; /* those of the scene, then those of caps */
    struct zr_section_cap *caps;
    uint32_t cap_count, cap_room;
    uint64_t open_count;
    uint64_t first_open; /* in the list of parts */
};

/* ---- names ---- */

static bool make_names(struct cutting *c)
{
    const struct zr_scene *scene = c->scene;
    uint64_t *first = zr_arena_alloc(c->run->arena, scene->instance_count, sizeof *first), part = 0;
    if (!first) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        first[i] = part;
        part += zr_mesh_part_count(&scene->meshes[scene->instances[i].mesh]);
    }
    c->first_parts = first;
    return true;
}

static enum zr_status find_uncut(struct cutting *c, struct zr_error *error)
{
    const struct zr_sections *sections = &c->scene->sections;
    if (sections->uncut_count == 0) return ZR_OK;
    c->names = zr_part_list_make(c->run->arena, c->scene, UINT32_MAX / 4);
    uint8_t *is_uncut = zr_arena_zero(c->run->arena, c->names.count, sizeof *is_uncut);
    if (!zr_arena_ok(c->run->arena)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < sections->uncut_count; i++) {
        uint32_t part = 0;
        if (zr_is_cancelled(c->run->cancel)) return ZR_CANCELLED;
        while (part < c->names.count && strcmp(c->names.at[part].name, sections->uncut[i]) != 0)
            part++;
        if (part == c->names.count) {
            char pointer[ZR_POINTER_SIZE];
            snprintf(pointer, sizeof pointer, "/sections/uncut/%" PRIu32, i);
            return zr_error_add(error, ZR_BAD_SCENE, pointer,
                                "the scene has no part \"%.100s\"; the first is \"%.100s\"", sections->uncut[i],
                                c->names.count > 0 ? c->names.at[0].name : "");
        }
        is_uncut[part] = 1;
    }
    c->is_uncut = is_uncut;
    return ZR_OK;
}

/* ---- planes ---- */

/* Brings the planes into object space; distances stay in world units. */
static struct zr_section_cut cut_of(const struct cutting *c, const zr_mat4 *m)
{
    struct zr_section_cut cut = {.plane_count = c->planes->count, .is_corner = c->scene->sections.is_corner};
    for (uint32_t k = 0; k < cut.plane_count; k++) {
        const struct zr_section_plane *from = &c->planes->at[k];
        double row[4];
        for (int column = 0; column < 4; column++)
            row[column] =
                ((from->normal[0] * (double)m->m[4 * column] + from->normal[1] * (double)m->m[4 * column + 1]) +
                 from->normal[2] * (double)m->m[4 * column + 2]) +
                from->offset * (double)m->m[4 * column + 3];
        cut.planes[k] = (struct zr_slice_plane){{row[0], row[1], row[2]}, row[3], ZR_SLICE_ON * c->diagonal};
    }
    return cut;
}

/* If cancelled, returns any of both. */
static bool is_placed(const struct zr_mesh *mesh, const struct zr_cancel *cancel)
{
    for (uint32_t p = 0; p < mesh->position_count; p++) {
        if (p % POSITIONS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return true;
        if (!(mesh->positions[p].w > 0.0f)) return false;
    }
    return true;
}

/* ---- parts ---- */

static enum zr_status find_closed(struct cutting *c, uint32_t mesh)
{
    if (c->closed[mesh]) return ZR_OK;
    const uint32_t parts = zr_mesh_part_count(&c->scene->meshes[mesh]);
    uint8_t *closed = zr_arena_alloc(c->run->arena, parts, sizeof *closed);
    if (!closed) return ZR_NO_MEMORY;
    if (!zr_closed_parts_find(c->run, &c->scene->meshes[mesh], closed, NULL)) return ZR_NO_MEMORY;
    c->closed[mesh] = closed;
    return zr_is_cancelled(c->run->cancel) ? ZR_CANCELLED : ZR_OK;
}

/* Marks the parts that lie on both sides of a plane. */
static uint8_t *find_crossed(struct cutting *c, const struct zr_section_cut *cut, const struct zr_mesh *mesh)
{
    const uint32_t count = zr_mesh_part_count(mesh);
    uint8_t(*sides)[ZR_SECTION_PLANES_MAX] = zr_arena_zero(c->run->arena, count, sizeof *sides);
    uint8_t *crossed = zr_arena_zero(c->run->arena, count, sizeof *crossed);
    if (!sides || !crossed) return NULL;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t part = mesh->face_parts ? mesh->face_parts[face] : 0;
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(c->run->cancel)) return crossed;
        for (uint32_t i = mesh->face_offsets[face]; i < mesh->face_offsets[face + 1] && !crossed[part]; i++)
            for (uint32_t k = 0; k < cut->plane_count; k++) {
                sides[part][k] |= zr_slice_distance(&cut->planes[k], mesh->positions[mesh->indices[i]]) > 0.0 ? 1 : 2;
                crossed[part] = crossed[part] || sides[part][k] == 3;
            }
    }
    return crossed;
}

/* Returns how each part of an instance is treated, and counts open ones that a plane crosses. */
static const uint8_t *treat_parts(struct cutting *c, uint32_t instance, const struct zr_section_cut *cut)
{
    const uint32_t number = c->scene->instances[instance].mesh;
    const struct zr_mesh *mesh = &c->scene->meshes[number];
    const uint32_t count = zr_mesh_part_count(mesh);
    const uint8_t *closed = c->closed[number], *crossed = find_crossed(c, cut, mesh);
    uint8_t *parts = zr_arena_alloc(c->run->arena, count, sizeof *parts);
    for (uint32_t part = 0; parts && crossed && part < count; part++) {
        const uint64_t listed = c->first_parts[instance] + part;
        parts[part] = closed[part] ? ZR_SLICE_CLOSED : ZR_SLICE_OPEN;
        if (c->is_uncut && listed < c->names.count && c->is_uncut[listed]) parts[part] = ZR_SLICE_UNCUT;
        if (parts[part] == ZR_SLICE_OPEN && crossed[part] && c->open_count++ == 0) c->first_open = listed;
    }
    return crossed ? parts : NULL;
}

static bool all_are(const uint8_t *parts, uint32_t count, uint8_t treatment)
{
    for (uint32_t i = 0; i < count; i++)
        if (parts[i] != treatment) return false;
    return true;
}

/* ---- caps ---- */

static bool reserve_caps(struct cutting *c, uint32_t more)
{
    if (c->cap_room - c->cap_count >= more) return true;
    const uint64_t wanted = 2 * ((uint64_t)c->cap_count + more),
                   old = c->scene->material_count + (uint64_t)c->cap_count;
    if (wanted > UINT32_MAX / 2) return false;
    void *caps = zr_arena_grow(c->run->arena, c->caps, c->cap_count, wanted, sizeof *c->caps);
    void *materials =
        zr_arena_grow(c->run->arena, c->materials, old, c->scene->material_count + wanted, sizeof *c->materials);
    if (!caps || !materials) return false;
    c->caps = caps;
    c->materials = materials;
    c->cap_room = (uint32_t)wanted;
    return true;
}

/* Copies the material of the part. */
static struct zr_material material_of(const struct cutting *c, const struct zr_mesh *mesh, uint32_t face)
{
    struct zr_material material =
        c->scene->materials[mesh->face_materials ? mesh->face_materials[face] : mesh->material];
    material.double_sided = true;
    material.is_alpha_only = false;
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        material.textures[slot] = 0;
    if (c->scene->sections.has_hatch) material.textures[ZR_TEXTURE_BASE_COLOR] = zr_hatch_texture(c->scene);
    return material;
}

/* Gives each cap of the sectioned mesh its material, and the coordinates of its hatch. */
static bool dress_caps(struct cutting *c, uint32_t instance, struct zr_sectioned *made)
{
    struct zr_mesh *mesh = &made->mesh;
    const uint32_t caps = mesh->cap_count, first = mesh->face_count - caps;
    uint32_t *materials = zr_arena_alloc(c->run->arena, mesh->face_count, sizeof *materials);
    zr_vec4 *texcoords = NULL;
    if (c->scene->sections.has_hatch && caps > 0) {
        texcoords = zr_arena_zero(c->run->arena, mesh->position_count, sizeof *texcoords);
        if (!texcoords) return false;
        if (mesh->texcoords) memcpy(texcoords, mesh->texcoords, mesh->position_count * sizeof *texcoords);
    }
    if (!materials || !reserve_caps(c, caps)) return false;
    for (uint32_t face = 0; face < first; face++)
        materials[face] = mesh->face_materials ? mesh->face_materials[face] : mesh->material;
    for (uint32_t i = 0; i < caps; i++) {
        const struct zr_slice_cap *cap = &made->caps[made->cap_numbers[i]];
        const uint64_t part = c->first_parts[instance] + cap->part;
        const zr_mat4 *matrix = &c->scene->instances[instance].object_to_world;
        c->materials[c->scene->material_count + c->cap_count] = material_of(c, mesh, first + i);
        materials[first + i] = c->scene->material_count + c->cap_count;
        struct zr_section_cap *drawn = &c->caps[c->cap_count++];
        *drawn = (struct zr_section_cap){instance, cap->part, cap->plane, 0.0};
        if (!zr_cap_area_find(c->run, mesh, i, matrix, &drawn->area)) return false;
        if (texcoords)
            zr_hatch_put(mesh, first + i, matrix, &c->planes->at[cap->plane], c->scene->picture->z_is_up, part,
                         c->pitch, texcoords);
    }
    mesh->face_materials = materials;
    if (texcoords) mesh->texcoords = texcoords;
    return true;
}

/* ---- instances ---- */

static const uint32_t no_offsets[1] = {0};

static void empty(struct zr_mesh *mesh)
{
    *mesh = (struct zr_mesh){
        .name = mesh->name, .face_offsets = no_offsets, .material = mesh->material, .scale = mesh->scale};
}

/* Adds a mesh for an instance. */
static struct zr_mesh *add_mesh(struct cutting *c, uint32_t instance)
{
    const uint32_t number = c->out->mesh_count++, whole = c->scene->instances[instance].mesh;
    c->meshes[number] = c->scene->meshes[whole];
    if (c->owners) c->owners[number] = c->owners[whole];
    c->instances[instance].mesh = number;
    return &c->meshes[number];
}

static enum zr_status cut_instance(struct cutting *c, uint32_t instance, struct zr_error *error)
{
    const struct zr_instance *from = &c->scene->instances[instance];
    const struct zr_mesh *mesh = &c->scene->meshes[from->mesh];
    const struct zr_section_cut cut = cut_of(c, &from->object_to_world);
    const enum zr_section_side side = zr_section_side_of(&cut, mesh, c->run->cancel);
    struct zr_sectioned made;
    if (zr_is_cancelled(c->run->cancel)) return ZR_CANCELLED;
    if (side == ZR_SECTION_WHOLE) return ZR_OK;
    if (!is_placed(mesh, c->run->cancel))
        return zr_error_add(error, ZR_BAD_SCENE, "/sections",
                            "a plane meets the mesh \"%.100s\", which has positions with w <= 0: these cannot be cut",
                            mesh->name);
    enum zr_status status = find_closed(c, from->mesh);
    if (status != ZR_OK) return status;
    const uint8_t *parts = treat_parts(c, instance, &cut);
    if (!parts) return ZR_NO_MEMORY;
    if (all_are(parts, zr_mesh_part_count(mesh), ZR_SLICE_UNCUT)) return ZR_OK;
    struct zr_mesh *out = add_mesh(c, instance);
    if (side == ZR_SECTION_GONE && !c->is_uncut) {
        empty(out);
        c->numbers[instance] = no_offsets;
        return ZR_OK;
    }
    status = zr_sectioned_make(c->run, mesh, parts, &cut, &made);
    if (status != ZR_OK) return status;
    if (!dress_caps(c, instance, &made)) return zr_is_cancelled(c->run->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    *out = made.mesh;
    c->numbers[instance] = made.numbers;
    return ZR_OK;
}

/* ---- ids ---- */

static bool make_ids(struct cutting *c, struct zr_sections_cut *out)
{
    const struct zr_scene *scene = c->scene;
    uint64_t count = 0, whole = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        count += zr_mesh_ids(&c->meshes[c->instances[i].mesh]);
        whole += zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
    }
    uint32_t *ids = zr_arena_alloc(c->run->arena, count, sizeof *ids), id = 0, first = 0, cap = (uint32_t)whole;
    if (!ids || count + whole > UINT32_MAX / 2) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &c->meshes[c->instances[i].mesh];
        const uint32_t old = (uint32_t)zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
        const uint32_t own = (uint32_t)zr_mesh_ids(mesh);
        if (zr_is_cancelled(c->run->cancel)) return true;
        for (uint32_t k = 0; k < own; k++) {
            if (k % POSITIONS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(c->run->cancel)) return true;
            const uint32_t number = c->numbers[i] ? c->numbers[i][k] : k;
            ids[id++] = number < old ? first + number : cap++;
        }
        first += old;
    }
    out->ids = ids;
    out->id_count = id;
    out->first_cap_id = (uint32_t)whole;
    return true;
}

/* ---- warnings ---- */

enum { WARNING_SIZE = 240 };

static const char *make_warning(struct cutting *c)
{
    if (c->open_count == 0) return NULL;
    char *text = zr_arena_alloc(c->run->arena, WARNING_SIZE, 1);
    if (c->names.count == 0) c->names = zr_part_list_make(c->run->arena, c->scene, UINT32_MAX / 4);
    if (!text || c->first_open >= c->names.count) return NULL;
    if (c->open_count == 1)
        snprintf(text, WARNING_SIZE, "the part %.100s is cut, but has no cap, since it is not closed",
                 c->names.at[c->first_open].name);
    else
        snprintf(text, WARNING_SIZE,
                 "%" PRIu64 " parts are cut, but have no caps, since they are not closed, the first: %.100s",
                 c->open_count, c->names.at[c->first_open].name);
    return text;
}

/* ---- the scene ---- */

static bool make_rooms(struct cutting *c)
{
    const struct zr_scene *scene = c->scene;
    const size_t meshes = (size_t)scene->mesh_count + scene->instance_count;
    c->owners = scene->mesh_owners ? zr_arena_alloc(c->run->arena, meshes, sizeof *c->owners) : NULL;
    c->out = zr_arena_alloc(c->run->arena, 1, sizeof *c->out);
    c->meshes = zr_arena_alloc(c->run->arena, meshes, sizeof *c->meshes);
    c->instances = zr_arena_copy(c->run->arena, scene->instances, scene->instance_count * sizeof *c->instances);
    c->materials = zr_arena_copy(c->run->arena, scene->materials, scene->material_count * sizeof *c->materials);
    c->numbers = zr_arena_zero(c->run->arena, scene->instance_count, sizeof *c->numbers);
    c->closed = zr_arena_zero(c->run->arena, scene->mesh_count, sizeof *c->closed);
    if (!zr_arena_ok(c->run->arena) || !make_names(c)) return false;
    memcpy(c->meshes, scene->meshes, scene->mesh_count * sizeof *c->meshes);
    *c->out = *scene;
    if (!c->owners) return true;
    memcpy(c->owners, scene->mesh_owners, scene->mesh_count * sizeof *c->owners);
    c->out->mesh_owners = c->owners;
    return true;
}

static enum zr_status cut_scene(struct cutting *c, struct zr_error *error)
{
    if (!make_rooms(c)) return ZR_NO_MEMORY;
    enum zr_status status = find_uncut(c, error);
    for (uint32_t i = 0; i < c->scene->instance_count && status == ZR_OK; i++)
        status = cut_instance(c, i, error);
    c->out->meshes = c->meshes;
    c->out->instances = c->instances;
    c->out->materials = c->materials;
    c->out->material_count += c->cap_count;
    if (status == ZR_OK && c->scene->sections.has_hatch && !zr_hatch_add(c->run->arena, c->out)) status = ZR_NO_MEMORY;
    return status;
}

enum zr_status zr_sections_make(const struct zr_run *run, const struct zr_scene *scene,
                                const struct zr_section_planes *planes, double diagonal, double pitch,
                                const struct zr_sections_cut **out)
{
    struct cutting c = {.run = run, .scene = scene, .planes = planes, .diagonal = diagonal, .pitch = pitch};
    struct zr_sections_cut *made = zr_arena_zero(run->arena, 1, sizeof *made);
    if (!made) return ZR_NO_MEMORY;
    const enum zr_status status = cut_scene(&c, run->error);
    if (status != ZR_OK) return status;
    if (!make_ids(&c, made)) return ZR_NO_MEMORY;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    made->scene = c.out;
    made->cap_count = c.cap_count;
    made->caps = c.caps;
    made->warning = make_warning(&c);
    *out = made;
    if (scene->is_strict && made->warning)
        return zr_error_add(run->error, ZR_BAD_SCENE, "/sections", "%s", made->warning);
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
