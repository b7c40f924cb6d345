#include "input/query/cloud.h"

#include "input/query/point_spacing.h"
#include "render_request.h"
#include "scene/parsed_picture.h"

struct numbers {
    uint64_t faces, lines, points;
};

static struct numbers count(const struct zr_scene *scene)
{
    struct numbers sum = {0, 0, 0};
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        sum.faces += scene->meshes[i].face_count;
        sum.lines += scene->meshes[i].line_count;
        sum.points += scene->meshes[i].point_count;
    }
    return sum;
}

/* True if the meshes have points, and neither faces nor lines. */
static bool is_cloud(const struct zr_scene *scene)
{
    const struct numbers sum = count(scene);
    return sum.points > 0 && sum.faces == 0 && sum.lines == 0;
}

bool zr_cloud_take_edges(struct zr_parsed_scene *root)
{
    struct zr_edges *edges = &root->picture->merged.edges;
    if (!is_cloud(root->scene) || !edges->is_on || zr_picture_gives(root->picture, ZR_PICTURE_EDGES)) return false;
    edges->is_on = false;
    return true;
}

static void color_meshes(const struct zr_query *query, zr_vec4 color)
{
    const struct zr_scene_builder *builder = query->given.builder;
    for (uint32_t i = 0; i < builder->scene->mesh_count && !query->request->color; i++)
        if (!builder->meshes[i].colors) builder->materials[builder->meshes[i].material].base_color = color;
}

void zr_wire_color(const struct zr_query *query)
{
    const struct zr_scene *scene = query->given.builder->scene;
    const struct numbers sum = count(scene);
    if (scene->look->wire.w > 0.0f && sum.lines > 0 && sum.faces == 0) color_meshes(query, scene->look->wire);
}

void zr_cloud_draw_in_ink(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    const struct zr_look *look = builder->scene->look;
    const zr_vec3 edges = builder->scene->picture->edges.color, own = look->picture->edges.color;
    const bool is_own = edges.x == own.x && edges.y == own.y && edges.z == own.z;
    const zr_vec4 ink = is_own && look->cloud.w > 0.0f ? look->cloud : (zr_vec4){edges.x, edges.y, edges.z, 1};
    if (look->material.shading == ZR_SHADING_PBR) return;
    color_meshes(query, ink);
}

void zr_cloud_size_points(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    const struct zr_scene *scene = builder->scene;
    float size = 0.0f;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        struct zr_mesh *mesh = &builder->meshes[i];
        if (mesh->point_count == 0 || mesh->point_size > 0.0f) continue;
        if (size == 0.0f) size = zr_point_size_for(builder->arena, builder->team, scene, &scene->views[0]);
        mesh->point_size = size;
        mesh->points_are_round = scene->look->picture->side > 1;
    }
}
