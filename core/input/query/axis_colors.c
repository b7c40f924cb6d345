#include "input/query/axis_colors.h"

#include <float.h>
#include <string.h>

#include "base/cancel.h"
#include "base/vec.h"
#include "input/text/names.h"
#include "scene/camera/mesh_up.h"
#include "scene/colormap.h"

enum { POSITIONS_PER_CANCEL_CHECK = 1 << 14 };

struct coloring {
    struct zr_scene *scene;
    struct zr_arena *arena;
    int axis;
    zr_vec4 along; /* the axis in the world */
    double low, high;
    const struct zr_color_scale *scale;
    struct zr_mesh *meshes; /* those of the scene, then the copies */
    struct zr_instance *instances;
};

/* Returns the axis in the world. A bare mesh was turned, and has the axes of its file. */
static zr_vec4 axis_in_world(const struct zr_scene *scene, int axis)
{
    const int up = scene->file.up ? zr_names_find(&zr_mesh_up_names, scene->file.up) : ZR_MESH_UP_Y;
    const zr_mat4 turn = zr_mesh_up_turn((enum zr_mesh_up)up);
    return zr_mat4_apply(&turn, (zr_vec4){axis == 0, axis == 1, axis == 2, 0});
}

static double part_along(const struct coloring *c, zr_vec4 place)
{
    return (double)(c->along.x * place.x + c->along.y * place.y + c->along.z * place.z);
}

static double coordinate(const struct coloring *c, const struct zr_instance *instance, const zr_vec4 *position)
{
    const zr_vec4 at = zr_mat4_apply(&instance->object_to_world, *position);
    return part_along(c, at) / (at.w != 0.0f ? (double)at.w : 1.0);
}

static bool is_cancelled(const struct coloring *c, uint32_t i)
{
    return i % POSITIONS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(c->arena->cancel);
}

/* Finds the least and the greatest coordinate of all instances. */
static bool find_range(struct coloring *c)
{
    c->low = DBL_MAX;
    c->high = -DBL_MAX;
    for (uint32_t k = 0; k < c->scene->instance_count; k++) {
        const struct zr_instance *instance = &c->scene->instances[k];
        const struct zr_mesh *mesh = &c->scene->meshes[instance->mesh];
        for (uint32_t i = 0; i < mesh->position_count; i++) {
            const double at = coordinate(c, instance, &mesh->positions[i]);
            if (is_cancelled(c, i)) return false;
            c->low = at < c->low ? at : c->low;
            c->high = at > c->high ? at : c->high;
        }
    }
    return true;
}

/* Makes the scale for the colour bar, in the coordinates of the file. */
static bool make_scale(struct coloring *c)
{
    struct zr_color_scale *scale = zr_arena_alloc(c->arena, 1, sizeof *scale);
    const double origin = c->scene->origin ? c->scene->origin[c->axis] : 0.0;
    if (scale)
        *scale =
            (struct zr_color_scale){ZR_COLORMAP_VIRIDIS, (float)(c->low + origin), (float)(c->high + origin), false};
    c->scale = scale;
    return scale;
}

/* Colours a mesh by the coordinates that an instance gives it. */
static bool color_mesh(const struct coloring *c, const struct zr_instance *instance, struct zr_mesh *mesh)
{
    zr_vec4 *colors = zr_arena_alloc(c->arena, mesh->position_count, sizeof *colors);
    for (uint32_t i = 0; colors && i < mesh->position_count; i++) {
        const double at = coordinate(c, instance, &mesh->positions[i]);
        if (is_cancelled(c, i)) return false;
        colors[i] = zr_colormap_color(ZR_COLORMAP_VIRIDIS,
                                      c->low < c->high ? (float)((at - c->low) / (c->high - c->low)) : 0.5f);
    }
    mesh->colors = colors;
    mesh->face_colors = NULL;
    mesh->scale = c->scale;
    return colors;
}

/* True if two instances of one mesh give its positions the same coordinates. */
static bool are_alike(const struct coloring *c, const struct zr_instance *a, const struct zr_instance *b)
{
    for (int k = 0; k < 4; k++) {
        const zr_vec4 unit = {k == 0, k == 1, k == 2, k == 3};
        const zr_vec4 of_a = zr_mat4_apply(&a->object_to_world, unit), of_b = zr_mat4_apply(&b->object_to_world, unit);
        if (part_along(c, of_a) != part_along(c, of_b) || of_a.w != of_b.w) return false;
    }
    return true;
}

static bool color_instances(struct coloring *c)
{
    struct zr_scene *scene = c->scene;
    const uint32_t own = scene->mesh_count;
    uint32_t *first = zr_arena_alloc(c->arena, own, sizeof *first); /* instance of each mesh, from 1; 0: none so far */
    if (!first) return false;
    memset(first, 0, own * sizeof *first);
    for (uint32_t k = 0; k < scene->instance_count; k++) {
        struct zr_instance *instance = &c->instances[k];
        uint32_t *of = &first[instance->mesh];
        struct zr_mesh *mesh = &c->meshes[instance->mesh];
        if (*of && are_alike(c, instance, &scene->instances[*of - 1])) continue;
        if (*of) {
            c->meshes[scene->mesh_count] = *mesh;
            mesh = &c->meshes[scene->mesh_count];
            instance->mesh = scene->mesh_count++;
        } else {
            *of = k + 1;
        }
        if (!color_mesh(c, instance, mesh)) return false;
    }
    return true;
}

/* Leaves white, under the colours of the vertices. */
static void whiten(struct zr_material *material)
{
    material->base_color = (zr_vec4){1, 1, 1, material->base_color.w};
    material->emissive = (zr_vec3){0, 0, 0};
    material->textures[ZR_TEXTURE_BASE_COLOR] = material->textures[ZR_TEXTURE_EMISSIVE] = 0;
    material->uniform_color = false;
}

bool zr_axis_colors_apply(struct zr_scene_builder *builder)
{
    struct zr_scene *scene = builder->scene;
    struct coloring c = {.scene = scene, .arena = builder->arena, .axis = (int)scene->parts.colors - ZR_COLORS_X};
    c.along = axis_in_world(scene, c.axis);
    const size_t meshes = (size_t)scene->mesh_count + scene->instance_count, used = scene->mesh_count;
    if (scene->instance_count == 0) return true; /* zr_scene_validate refuses it */
    if (!find_range(&c) || !make_scale(&c)) return false;
    c.meshes = zr_arena_alloc(c.arena, meshes, sizeof *c.meshes);
    c.instances = zr_arena_copy(c.arena, scene->instances, scene->instance_count * sizeof *c.instances);
    if (!c.meshes || !c.instances) return false;
    memcpy(c.meshes, scene->meshes, used * sizeof *c.meshes);
    if (!color_instances(&c)) return false;
    scene->meshes = c.meshes;
    scene->instances = c.instances;
    for (uint32_t i = 0; i < scene->material_count; i++)
        whiten(&builder->materials[i]);
    return true;
}
