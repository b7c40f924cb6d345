#include "scene/scene_builder.h"

#include <string.h>

#include "base/hash.h"
#include "base/team.h"
#include "scene/doubled_faces.h"
#include "scene/output.h"
#include "scene/unused_positions.h"

enum { MATERIALS_AT_FIRST = 16, IMAGES_AT_FIRST = 4, RANGE_AT_ONCE = 1 << 14 };

struct zr_scene_builder zr_scene_builder_open(struct zr_arena *arena, struct zr_team *team, struct zr_scene *scene)
{
    return (struct zr_scene_builder){.arena = arena, .team = team, .scene = scene};
}

struct zr_mesh *zr_scene_builder_meshes(struct zr_scene_builder *builder, size_t count)
{
    builder->meshes = zr_arena_zero(builder->arena, count, sizeof *builder->meshes);
    for (size_t i = 0; builder->meshes && i < count; i++)
        builder->meshes[i].name = "";
    builder->scene->meshes = builder->meshes;
    builder->scene->mesh_count = builder->meshes ? (uint32_t)count : 0;
    return builder->meshes;
}

void zr_scene_builder_place(struct zr_scene_builder *builder, const struct zr_instance *instances, size_t count)
{
    builder->scene->instances = instances;
    builder->scene->instance_count = (uint32_t)count;
}

/* ---- materials ---- */

static bool is_same_color(zr_vec3 a, zr_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_same_finish(const struct zr_finish *a, const struct zr_finish *b)
{
    float left[ZR_FINISH_FLOATS], right[ZR_FINISH_FLOATS];
    memcpy(left, a, sizeof left);
    memcpy(right, b, sizeof right);
    for (int i = 0; i < ZR_FINISH_FLOATS; i++)
        if (left[i] != right[i]) return false;
    return true;
}

static bool is_same(const struct zr_material *a, const struct zr_material *b)
{
    return a->shading == b->shading && a->double_sided == b->double_sided && a->unfilled == b->unfilled &&
           a->is_hidden == b->is_hidden && a->is_operand == b->is_operand && a->uniform_color == b->uniform_color &&
           a->outline == b->outline && a->shininess == b->shininess && a->metallic == b->metallic &&
           a->roughness == b->roughness && zr_vec4_equal(a->base_color, b->base_color) &&
           zr_vec4_equal(a->outline_color, b->outline_color) && is_same_color(a->specular, b->specular) &&
           is_same_color(a->reflectance, b->reflectance) && a->grazing == b->grazing &&
           is_same_color(a->emissive, b->emissive) && is_same_color(a->cool, b->cool) &&
           a->alpha_mode == b->alpha_mode && a->alpha_cutoff == b->alpha_cutoff && a->normal_scale == b->normal_scale &&
           a->coat_normal_scale == b->coat_normal_scale && a->occlusion_strength == b->occlusion_strength &&
           is_same_finish(&a->finish, &b->finish) && memcmp(a->textures, b->textures, sizeof a->textures) == 0;
}

static uint32_t hash_floats(uint32_t value, const float *numbers, size_t count)
{
    uint32_t word;
    for (size_t i = 0; i < count; i++) {
        const float number = numbers[i] + 0.0f; /* -0 equals 0 */
        memcpy(&word, &number, sizeof word);
        value = zr_hash_word(value, word);
    }
    return value;
}

/* Returns equal values for equal materials. */
static uint32_t hash(const struct zr_material *m)
{
    float finish[ZR_FINISH_FLOATS];
    memcpy(finish, &m->finish, sizeof finish);
    const float numbers[] = {
        m->base_color.x,    m->base_color.y,    m->base_color.z,  m->base_color.w,    m->shininess,
        m->specular.x,      m->specular.y,      m->specular.z,    m->outline_color.x, m->outline_color.y,
        m->outline_color.z, m->outline_color.w, m->metallic,      m->roughness,       m->emissive.x,
        m->emissive.y,      m->emissive.z,      m->cool.x,        m->cool.y,          m->cool.z,
        m->alpha_cutoff,    m->reflectance.x,   m->reflectance.y, m->reflectance.z,   m->grazing};
    uint32_t value = hash_floats(ZR_HASH_BEGIN, numbers, sizeof numbers / sizeof *numbers);
    value = hash_floats(value, finish, ZR_FINISH_FLOATS);
    uint32_t word = (uint32_t)m->is_operand << 18 | (uint32_t)m->alpha_mode << 16 | (uint32_t)m->shading << 8 |
                    (uint32_t)m->outline << 4 | (uint32_t)m->is_hidden << 3 | (uint32_t)m->double_sided << 2 |
                    (uint32_t)m->unfilled << 1 | (uint32_t)m->uniform_color;
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        word = word * 31u + m->textures[slot];
    return zr_hash_word(value, word);
}

/* Finds the slot of an equal material, or the empty slot for a new one. */
static uint32_t *find_slot(const struct zr_scene_builder *builder, const struct zr_material *material)
{
    const size_t mask = 2 * builder->material_room - 1;
    size_t slot = (hash(material) ^ hash(material) >> 15) & mask;
    while (builder->slots[slot] != UINT32_MAX && !is_same(&builder->materials[builder->slots[slot]], material))
        slot = (slot + 1) & mask;
    return &builder->slots[slot];
}

static bool grow_materials(struct zr_scene_builder *builder)
{
    const size_t count = builder->scene->material_count;
    const size_t room = builder->material_room ? 2 * builder->material_room : MATERIALS_AT_FIRST;
    struct zr_material *more = zr_arena_grow(builder->arena, builder->materials, count, room, sizeof *more);
    uint32_t *slots = zr_arena_alloc(builder->arena, 2 * room, sizeof *slots);
    if (!more || !slots) return false;
    memset(slots, 0xFF, 2 * room * sizeof *slots);
    builder->materials = more;
    builder->slots = slots;
    builder->material_room = room;
    for (uint32_t i = 0; i < count; i++)
        *find_slot(builder, &more[i]) = i;
    return true;
}

uint32_t zr_scene_builder_material(struct zr_scene_builder *builder, const struct zr_material *material)
{
    uint32_t *count = &builder->scene->material_count;
    if (*count == builder->material_room && !grow_materials(builder)) return 0;
    uint32_t *slot = find_slot(builder, material);
    if (*slot == UINT32_MAX) {
        builder->materials[*count] = *material;
        *slot = (*count)++;
    }
    return *slot;
}

/* ---- images ---- */

uint32_t zr_scene_builder_image(struct zr_scene_builder *builder, const struct zr_image *image)
{
    struct zr_scene *scene = builder->scene;
    if (scene->image_count == builder->image_room) {
        const size_t room = builder->image_room ? 2 * builder->image_room : IMAGES_AT_FIRST;
        struct zr_image *more = zr_arena_grow(builder->arena, builder->images, scene->image_count, room, sizeof *more);
        if (!more) return 0;
        builder->images = more;
        builder->image_room = room;
    }
    builder->images[scene->image_count] = *image;
    scene->images = builder->images;
    return scene->image_count++;
}

/* ---- textures ---- */

static bool is_same_texture(const struct zr_texture *a, const struct zr_texture *b)
{
    return a->image == b->image && a->texcoord == b->texcoord && a->wrap_s == b->wrap_s && a->wrap_t == b->wrap_t &&
           a->magnify == b->magnify && a->minify == b->minify && a->is_color == b->is_color &&
           memcmp(a->rows, b->rows, sizeof a->rows) == 0;
}

uint32_t zr_scene_builder_texture(struct zr_scene_builder *builder, const struct zr_texture *texture)
{
    struct zr_scene *scene = builder->scene;
    for (uint32_t i = scene->texture_count; i-- > 0;)
        if (is_same_texture(&builder->textures[i], texture)) return i;
    if (scene->texture_count == builder->texture_room) {
        const size_t room = builder->texture_room ? 2 * builder->texture_room : IMAGES_AT_FIRST;
        struct zr_texture *more =
            zr_arena_grow(builder->arena, builder->textures, scene->texture_count, room, sizeof *more);
        if (!more) return 0;
        builder->textures = more;
        builder->texture_room = room;
    }
    builder->textures[scene->texture_count] = *texture;
    scene->textures = builder->textures;
    return scene->texture_count++;
}

void zr_scene_builder_note_normals(struct zr_scene_builder *builder, uint32_t mesh, const zr_vec3 *normals,
                                   size_t count)
{
    struct zr_read_counts *counts = &builder->scene->counts;
    counts->normals += count;
    for (size_t i = 0; i < count; i++)
        if (zr_normal_is_zero(normals[i]) && counts->zero_normals++ == 0) counts->zero_normals_mesh = mesh;
}

/* ---- missing arrays ---- */

struct counting {
    uint32_t *numbers, step;
};

static void count_range(void *context, size_t begin, size_t end)
{
    const struct counting *counting = context;
    for (size_t i = begin; i < end; i++)
        counting->numbers[i] = (uint32_t)i * counting->step;
}

/* Allocates the numbers 0, step, 2 step, ... */
static const uint32_t *count_up(struct zr_scene_builder *builder, size_t count, uint32_t step)
{
    struct counting counting = {zr_arena_alloc(builder->arena, count, sizeof(uint32_t)), step};
    if (counting.numbers) zr_team_ranges(builder->team, count, RANGE_AT_ONCE, count_range, &counting);
    return counting.numbers;
}

void zr_scene_builder_complete(struct zr_scene_builder *builder)
{
    for (uint32_t i = 0; i < builder->scene->mesh_count && zr_arena_ok(builder->arena); i++) {
        struct zr_mesh *mesh = &builder->meshes[i];
        if (mesh->is_complete) continue;
        mesh->is_complete = true;
        if (!mesh->face_offsets) mesh->face_offsets = count_up(builder, (size_t)mesh->face_count + 1, 3);
        const bool is_soup = !mesh->indices && mesh->face_count > 0;
        if (mesh->face_offsets && !mesh->indices)
            mesh->indices = count_up(builder, mesh->face_offsets[mesh->face_count], 1);
        if (!is_soup && mesh->indices && mesh->face_offsets)
            zr_unused_positions_move(builder->arena, builder->team, mesh, (zr_vec4 *)mesh->positions);
    }
}

void zr_scene_builder_close(struct zr_scene_builder *builder)
{
    struct zr_scene *scene = builder->scene;
    zr_scene_builder_complete(builder);
    scene->materials = builder->materials;
    if (zr_arena_ok(builder->arena)) zr_doubled_faces_warn(builder->arena, scene, &builder->warnings);
    if (zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR))
        zr_warning_list_append(builder->arena, &builder->warnings, &builder->color_warnings);
    scene->warnings = builder->warnings.texts;
    scene->warning_count = (uint32_t)builder->warnings.count;
}
