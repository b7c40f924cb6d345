/* The stages of a picture, from top to bottom: each STAGE of draw_light is one. */
#include "render/picture.h"

#include "base/run.h"
#include "effects/eye_dome.h"
#include "mesh/crease_normals.h"
#include "mesh/face_normals.h"
#include "mesh/mesh_tables.h"
#include "render/backdrop.h"
#include "render/depth_maps.h"
#include "render/finish.h"
#include "render/mesh_lines.h"
#include "render/stage.h"
#include "render/supersample.h"
#include "scene/looks.h"
#include "scene/scene_edit.h"
#include "shade/lights/lamps.h"
#include "shade/paint.h"

struct drawing {
    const struct zr_run *run;
    const struct zr_scene *scene;
    struct zr_frame *frame;
    const struct zr_crease_normals *const *creases;
};

static enum zr_status status_of(const struct drawing *d)
{
    if (zr_is_cancelled(d->run->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(d->run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Describes a pass with side x side samples per pixel. */
static struct zr_pass_desc pass_at(const struct drawing *d, uint32_t side, bool linear)
{
    return (struct zr_pass_desc){.scene = d->scene,
                                 .camera = &d->frame->camera,
                                 .window = zr_window_of(d->scene, d->frame->width, d->frame->height, side),
                                 .wants = {.colors = !linear, .samples = linear, .crease_normals = d->creases}};
}

/* ---- several samples, as bytes ---- */

static enum zr_status draw_bytes(const struct drawing *d)
{
    const uint32_t side = d->scene->picture->side;
    const struct zr_pass_desc desc = pass_at(d, side, false);
    struct zr_pass pass;
    enum zr_status status = ZR_OK;
    STAGE(zr_pass_make(d->run, &desc, &pass));
    STAGE(zr_supersample_bytes(d->run->team, &pass, side, d->run->cancel, d->frame));
    if (status == ZR_OK) d->frame->counts = zr_pass_counts(&pass);
    return status;
}

/* ---- linear light ---- */

/* Makes crease normals for meshes without normals. */
static enum zr_status make_creases(struct drawing *d)
{
    const struct zr_scene *scene = d->scene;
    const struct zr_crease_normals **creases = zr_arena_zero(d->run->arena, scene->mesh_count, sizeof *creases);
    for (uint32_t i = 0; creases && i < scene->mesh_count; i++) {
        if (!zr_mesh_lacks_normals(&scene->meshes[i]) || scene->meshes[i].face_count == 0) continue;
        creases[i] = zr_mesh_table_creases(scene->tables, scene, i);
        if (creases[i]) continue;
        creases[i] = zr_crease_normals_make(d->run, &scene->meshes[i], scene->picture->crease_degrees);
    }
    d->creases = creases;
    return status_of(d);
}

static float *floats(const struct drawing *d, size_t count)
{
    return zr_arena_alloc(d->run->arena, count, sizeof(float));
}

/* Allocates a G-buffer of points and normals. Both sides are rounded up to whole blocks of tiles. */
static enum zr_status make_gbuffer(const struct drawing *d, struct zr_gbuffer *out)
{
    const size_t stride = ((size_t)d->frame->width + 15) / 16 * 16;
    const size_t count = stride * (((size_t)d->frame->height + 7) / 8 * 8);
    *out = (struct zr_gbuffer){.width = (int32_t)d->frame->width,
                               .height = (int32_t)d->frame->height,
                               .stride = (ptrdiff_t)stride,
                               .owner = zr_arena_alloc(d->run->arena, count, sizeof *out->owner)};
    for (int k = 0; k < 3; k++) {
        out->normal[k] = floats(d, count);
        out->point[k] = floats(d, count);
    }
    return zr_arena_ok(d->run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

struct gbuffer_drawing {
    const struct drawing *of;
    const struct zr_pass *pass;
    const struct zr_gbuffer *out;
};

static void draw_gbuffer_range(void *context, size_t begin, size_t end)
{
    const struct gbuffer_drawing *g = context;
    const struct zr_paint *paint = zr_paint_of(zr_team_isa(g->of->run->team));
    struct zr_tile tile;
    for (size_t number = begin; number < end; number++) {
        if (!zr_tile_find_visible(&g->pass->tiles, (uint32_t)number, g->of->run->cancel, &tile)) return;
        const ptrdiff_t at = tile.y * g->out->stride + tile.x;
        struct zr_gbuffer to = *g->out;
        to.owner += at;
        for (int k = 0; k < 3; k++) {
            to.normal[k] += at;
            to.point[k] += at;
        }
        paint->samples(&g->pass->geometry, &g->pass->attributes, &tile, &to);
    }
}

/* Draws the G-buffer at pixel centres. */
static enum zr_status draw_gbuffer(const struct drawing *d, struct zr_gbuffer *pixels)
{
    struct zr_pass_desc desc = pass_at(d, 1, true);
    struct zr_pass pass;
    desc.untextured = true;
    struct gbuffer_drawing drawing = {d, &pass, pixels};
    enum zr_status status = make_gbuffer(d, pixels);
    if (status != ZR_OK) return status;
    const struct zr_arena_step step = zr_arena_open_step(d->run->arena);
    status = zr_pass_make(d->run, &desc, &pass);
    if (status == ZR_OK)
        zr_team_ranges(d->run->team, zr_tile_count(d->frame->width, d->frame->height), 2, draw_gbuffer_range, &drawing);
    zr_arena_close_step(d->run->arena, &step);
    return status == ZR_OK ? status_of(d) : status;
}

/* Returns D in eye space. */
static float diagonal_in_eye(const struct drawing *d)
{
    return zr_diagonal_of(&d->frame->bounds) * zr_eye_scale_of(&d->frame->camera);
}

static enum zr_status draw_occlusion(const struct drawing *d, struct zr_gbuffer *pixels, struct zr_occlusion_map *map)
{
    const struct zr_occlusion *occlusion = &d->scene->picture->occlusion;
    const struct zr_pixel_scale scale = zr_pixel_scale_of(&d->frame->camera, d->frame->height);
    const float diagonal = diagonal_in_eye(d);
    enum zr_status status = draw_gbuffer(d, pixels);
    if (status != ZR_OK) return status;
    const float *light = zr_occlusion_make(d->run, pixels, occlusion, &scale, diagonal);
    *map = (struct zr_occlusion_map){pixels, light, 1.0f / (ZR_OCCLUSION_PLANE * diagonal)};
    return status_of(d);
}

/* Point clouds have light by distances alone instead of occlusion, which needs normals. */
static enum zr_status draw_points_light(const struct drawing *d, struct zr_gbuffer *pixels, const float **light)
{
    const struct zr_picture *picture = d->scene->picture;
    const struct zr_pixel_scale scale = zr_pixel_scale_of(&d->frame->camera, d->frame->height);
    const enum zr_status status = draw_gbuffer(d, pixels);
    if (status != ZR_OK) return status;
    *light = zr_eye_dome_make(d->run, pixels, &picture->occlusion, &scale);
    return status_of(d);
}

static enum zr_status make_light(const struct drawing *d, struct zr_linear_frame *out)
{
    const size_t stride = ((size_t)d->frame->width + 15) / 16 * 16, count = stride * d->frame->height;
    *out = (struct zr_linear_frame){.width = d->frame->width, .height = d->frame->height, .stride = stride};
    for (int k = 0; k < 3; k++)
        out->color[k] = floats(d, count);
    out->cover = floats(d, count);
    return zr_arena_ok(d->run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Draws all samples. The edge marks point into the pass until they are finished. */
static enum zr_status draw_samples(const struct drawing *d, const struct zr_sample_stages *stages, struct zr_pass *pass)
{
    const uint32_t side = d->scene->picture->side;
    const struct zr_pass_desc desc = pass_at(d, side, true);
    enum zr_status status = ZR_OK;
    STAGE(zr_pass_make(d->run, &desc, pass));
    if (status == ZR_OK && stages->edges &&
        !zr_edges_set_faces(stages->edges, d->run->arena, &pass->geometry, &pass->attributes))
        status = ZR_NO_MEMORY;
    STAGE(zr_supersample_light(d->run, pass, stages, side, d->frame));
    if (status == ZR_OK) d->frame->counts = zr_pass_counts(pass);
    return status;
}

static enum zr_status begin_edges(const struct drawing *d, struct zr_edge_marks **marks)
{
    const struct zr_picture *picture = d->scene->picture;
    const struct zr_pixel_scale scale = zr_pixel_scale_of(&d->frame->camera, d->frame->height);
    *marks =
        zr_edge_marks_make(d->run->arena, d->frame->width, d->frame->height, picture->side, &picture->edges, &scale);
    return status_of(d);
}

static enum zr_status finish(const struct drawing *d, struct zr_post_desc *desc, struct zr_edge_marks *edges)
{
    if (edges) desc->ink = zr_edges_finish(d->run, edges);
    if (status_of(d) != ZR_OK) return status_of(d);
    zr_finish_picture(d->run->team, desc, d->run->cancel);
    return status_of(d);
}

/* Finds the map of the first directional lamp with shadows. */
static struct zr_ground_sun ground_sun_of(const struct drawing *d, const struct zr_shadow_map *shadows)
{
    const zr_vec4 eye = zr_camera_eye(&d->frame->camera);
    struct zr_ground_sun sun = {.map = NULL};
    for (uint32_t i = 0; shadows && i < d->scene->light_count && !sun.map; i++)
        if (d->scene->lights[i].type == ZR_LIGHT_DIRECTIONAL && shadows[i].depths) sun.map = &shadows[i];
    if (eye.w != 0.0f) sun.start = (zr_vec3){eye.x, eye.y, eye.z};
    return sun;
}

/* Draws tiles with glass again, now over the picture of all others. Without an opaque background, glass is drawn
 * once. */
static enum zr_status draw_glass(const struct drawing *d, const struct zr_post_desc *desc,
                                 struct zr_sample_stages *stages, const struct zr_pass *pass,
                                 struct zr_backdrop *backdrop)
{
    enum zr_status status = ZR_OK;
    stages->glass = ZR_GLASS_REPEATED;
    stages->edges = NULL;
    STAGE(zr_backdrop_fill(d->run, desc, backdrop));
    STAGE(zr_supersample_light(d->run, pass, stages, d->scene->picture->side, d->frame));
    return status;
}

/* Draws the picture without lines of the mesh. */
static enum zr_status draw_light(struct drawing *d)
{
    const struct zr_picture *picture = d->scene->picture;
    const struct zr_camera *camera = &d->frame->camera;
    const struct zr_bounds *bounds = &d->frame->bounds;
    const struct zr_shadow_map *shadows = NULL;
    struct zr_linear_frame light;
    struct zr_gbuffer pixels;
    struct zr_pass pass;
    const bool is_cloud = picture->occlusion.is_on && zr_eye_dome_fits(d->scene);
    const bool has_occlusion = picture->occlusion.is_on && !is_cloud;
    const bool refracts = zr_any_refracts(d->scene->materials, d->scene->material_count);
    const float *points_light = NULL;
    struct zr_edge_marks *edges = NULL;
    struct zr_backdrop backdrop;
    struct zr_occlusion_map occlusion;
    struct zr_linear_lighting lighting;
    struct zr_ground ground = {.light = NULL};
    struct zr_sample_stages stages = {.lighting = &lighting,
                                      .occlusion = has_occlusion ? &occlusion : NULL,
                                      .has_xrays = zr_any_is_xray(d->scene->materials, d->scene->material_count) ||
                                                   zr_any_is_glass(d->scene->materials, d->scene->material_count),
                                      .out = &light};
    struct zr_post_desc desc = {.scene = d->scene, .light = &light, .ground = &ground, .out = d->frame->color};
    enum zr_status status = ZR_OK;

    STAGE(make_creases(d));
    if (has_occlusion) STAGE(draw_occlusion(d, &pixels, &occlusion));
    if (is_cloud) STAGE(draw_points_light(d, &pixels, &points_light));
    if (picture->has_ground) STAGE(zr_ground_map_draw(d->run, d->scene, camera, bounds, &ground, &desc.ground_frame));
    STAGE(zr_shadow_maps_draw(d->run, d->scene, camera, bounds, &shadows));
    zr_linear_lighting_make(d->run->arena, d->scene, camera, bounds, shadows, &lighting);
    if (picture->has_ground_sun) desc.sun = ground_sun_of(d, shadows);
    if (!zr_rays_of(camera, d->frame->width, d->frame->height, &desc.rays)) desc.ground = NULL;
    if (refracts) STAGE(zr_backdrop_open(d->run, d->scene, d->frame, &backdrop));
    if (refracts) lighting.backdrop = &backdrop;
    if (refracts && zr_background_is_opaque(d->scene)) stages.glass = ZR_GLASS_LEFT_OUT;
    STAGE(make_light(d, &light));
    const struct zr_surface_rule rule = {zr_pixel_scale_of(camera, d->frame->height)};
    if (picture->side == ZR_SURFACES_SIDE) stages.surfaces = &rule;
    if (picture->edges.is_on && !picture->edges.is_from_mesh) STAGE(begin_edges(d, &edges));
    stages.edges = edges;
    STAGE(draw_samples(d, &stages, &pass));
    if (stages.glass == ZR_GLASS_LEFT_OUT) STAGE(draw_glass(d, &desc, &stages, &pass, &backdrop));
    if (status == ZR_OK && points_light) zr_eye_dome_apply(d->run, &pixels, points_light, light.color, light.stride);
    STAGE(finish(d, &desc, edges));
    return status;
}

/* Lines of the mesh use the memory of the light again. */
static enum zr_status draw_light_and_lines(struct drawing *d)
{
    const struct zr_edges *edges = &d->scene->picture->edges;
    const struct zr_arena_step step = zr_arena_open_step(d->run->arena);
    enum zr_status status = draw_light(d);
    zr_arena_close_step(d->run->arena, &step);
    if (edges->is_on && edges->is_from_mesh) STAGE(zr_mesh_lines_draw(d->run, d->scene, d->frame));
    return status;
}

/* Makes glass blended, and surfaces with the shading xray blended and double-sided. */
static void blend_layers(struct zr_material *material)
{
    if (zr_material_is_glass(material) && material->alpha_mode == ZR_ALPHA_OPAQUE) {
        material->is_solid = true;
        material->base_color.w = 1.0f;
        material->alpha_mode = ZR_ALPHA_BLEND;
    }
    if (!zr_shading_is_layered(material->shading)) return;
    material->double_sided = true;
    material->alpha_mode = ZR_ALPHA_BLEND;
}

bool zr_picture_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_scene *edited,
                      const struct zr_scene **out)
{
    *out = scene;
    if (!zr_any_is_xray(scene->materials, scene->material_count) &&
        !zr_any_is_glass(scene->materials, scene->material_count))
        return true;
    *out = edited;
    return zr_scene_edit_materials(arena, scene, blend_layers, edited);
}

enum zr_status zr_picture_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    struct drawing drawing = {run, scene, frame, NULL};
    struct zr_scene with_layers;
    if (!zr_picture_scene(run->arena, scene, &with_layers, &drawing.scene)) return ZR_NO_MEMORY;
    return scene->picture->is_linear ? draw_light_and_lines(&drawing) : draw_bytes(&drawing);
}
