/* cost.c - the core: how much work a scene is, counted before any of it is done: as many passes as it takes
 * (cost_pass.h), and light (cost_picture.h).
 */
#include "zraster.h"

#include <math.h>

#include "cost_pass.h"
#include "cost_picture.h"
#include "effects/shadow_maps.h"
#include "scene/resolved_view.h"
#include "shade/lights/shadow_map.h"
#include "shade/texture_maps.h"

static const double POINT_T = 0.4;          /* placed without a face, in triangles */
static const double CREASE_T = 4.0;         /* normals averaged at a triangle's corners */
static const double SMALL_PNG_TIMES = 30.0; /* a pixel that is compressed well, of those compressed fast */

static double pixels_of(const struct zr_view *view)
{
    return (double)view->width * (double)view->height;
}

static void count_outputs(const struct zr_scene *scene, struct zr_cost *cost)
{
    const struct zr_view *view = &scene->views[0];
    double pixels = pixels_of(view);
    double png = scene->compress == ZR_COMPRESS_SMALL ? SMALL_PNG_TIMES : 1.0;
    for (uint32_t i = 0; i < view->output_count; i++) {
        enum zr_encoding encoding = view->outputs[i].encoding;
        const double words = (double)zr_channel_rows[view->outputs[i].channel].words;
        cost->pixels += pixels * fmax(words, 1.0);
        if (encoding == ZR_ENCODING_PNG || encoding == ZR_ENCODING_PNG16) cost->png_pixels += pixels * png;
    }
}

/* What is done at each pixel that is seen, in fragments: about what an AVX-512 machine takes; others take no less. */
static const double LIGHT_F = 0.6, PLACED_F = 0.5, POINT_F = 4.0;
static const double NEAREST_F = 5.0, LINEAR_F = 8.0, LEVELS_F = 27.0; /* a texture, by how it is filtered */
static const double TEXEL_F = 21.0, LIT_TEXEL_F = 80.0;               /* of a level that is made; in linear light */

static double work_of_channels(const struct zr_view *view)
{
    double work = 0.0;
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if ((zr_channel_rows[c].of_points || c == ZR_CHANNEL_NORMALS) && zr_view_wants(view, (enum zr_channel)c))
            work += POINT_F;
    return work;
}

/* How often all faces are drawn as layers, in sides. Both sides are for thickness; for one pixel, some algorithms draw
 * one tile. */
static double sides_of_layers(const struct zr_view *view)
{
    return (zr_view_wants(view, ZR_CHANNEL_LAYERS) ? 1.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_THICKNESS) ? 2.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) ? 1.0 : 0.0);
}

/* The base colour's texture; 0: there is none. */
static double work_of_texture(const struct zr_scene *scene, const struct zr_material *material)
{
    const uint32_t number = material->textures[ZR_TEXTURE_BASE_COLOR];
    if (number == 0) return 0.0;
    const struct zr_texture *texture = &scene->textures[number - 1];
    if (zr_filter_has_levels(texture->minify)) return LEVELS_F;
    return zr_filter_is_linear(texture->minify) || zr_filter_is_linear(texture->magnify) ? LINEAR_F : NEAREST_F;
}

/* By the textbook. */
static double work_of_colors(const struct zr_scene *scene)
{
    double work = 0.0, textured = 0.0;
    bool phong = false;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        phong |= zr_shading_has_specular(scene->materials[i].shading);
        textured = fmax(textured, work_of_texture(scene, &scene->materials[i]));
    }
    if (scene->picture.is_linear || !zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR)) return 0.0;
    if (scene->fog.is_on) work += 1.0;
    work += textured;
    if (phong) work += 1.0 + LIGHT_F * (double)scene->light_count;
    for (uint32_t i = 0; phong && i < scene->light_count; i++)
        if (zr_light_has_place(&scene->lights[i])) work += PLACED_F;
    return work;
}

/* Before any pass. */
struct work {
    double triangles, placing; /* what faces are cut into, and points without faces, too */
    struct zr_cost_sampling sampling;
};

static struct work work_of(const struct zr_scene *scene, uint32_t corners_max)
{
    uint64_t things = 0, corners = 0;
    double points = 0.0;
    struct work work = {.triangles = 0.0};
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        things += zr_mesh_ids(mesh);
        corners += zr_mesh_corners(mesh);
        points += (double)mesh->position_count;
        work.triangles += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
    }
    work.placing = work.triangles + POINT_T * fmax(points - 3.0 * work.triangles, 0.0);
    const uint64_t samples = corners > corners_max ? (uint64_t)corners_max * things / corners : things;
    work.sampling = (struct zr_cost_sampling){things, samples > 0 || things == 0 ? samples : 1};
    return work;
}

/* `placing`: all points and triangles, by an algorithm that takes no longer than others. */
static void add_pass(struct zr_cost *sum, const struct zr_cost_pass *pass, double placing, double times)
{
    const struct zr_cost *cost = &pass->cost;
    sum->triangles += times * (placing * pass->triangle_times + cost->triangles);
    sum->fragments += times * cost->fragments;
    sum->shape_triangles += times * cost->shape_triangles;
    sum->shape_fragments += times * cost->shape_fragments;
}

/* Of a map, which is about a diagonal of the bounds wide. That may be infinite, where a corner has next to no w, and
 * shares of such a map would be no numbers. */
static double square_of_map(const struct zr_bounds *bounds)
{
    static const double largest = 1e60;
    const double diagonal = (double)zr_diagonal_of(bounds);
    return fmin(diagonal * diagonal, largest);
}

/* Drawn in the maps of spots, in which a face may cover much more than in one along a direction. Of many spots some are
 * looked at. Maps have both sides of all faces; so that closed bodies cover twice what is measured. */
static double fragments_of_spots(const struct zr_scene *scene, const struct zr_resolved_view *resolved, uint32_t spots,
                                 const struct zr_cancel *cancel, struct zr_cost_sampling sampling)
{
    enum { MEASURED_MOST = 4, SIDES = 2 };
    const struct zr_cost_target map = {ZR_SHADOW_SIDE, ZR_SHADOW_SIDE, 1.0, 0.0};
    const uint32_t stride = (spots + MEASURED_MOST - 1) / MEASURED_MOST;
    double sum = 0.0, measured = 0.0;
    uint32_t number = 0;
    for (uint32_t i = 0; spots > 0 && i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        struct zr_camera camera;
        if (light->type != ZR_LIGHT_SPOT || !zr_light_casts_shadows(light)) continue;
        if (!zr_light_camera(scene, light, &resolved->camera, &resolved->bounds, &camera)) continue;
        if (number++ % stride != 0) continue;
        measured += 1.0;
        const struct zr_cost_pass pass = zr_cost_pass_measure(scene, &camera, map, 0.0, cancel, sampling);
        sum += pass.covered + ZR_COST_LAYER_F * pass.masked;
    }
    return measured > 0.0 ? SIDES * sum * (double)spots / measured : 0.0;
}

/* What the two sizes of window come to. */
static struct zr_cost_covered covered_by(const struct zr_view *view, uint32_t side, const struct zr_cost_pass *centres,
                                         const struct zr_cost_pass *samples)
{
    const double pixels = pixels_of(view);
    return (struct zr_cost_covered){.centres = fmin(centres->covered, pixels),
                                    .samples = fmin(samples->covered, pixels * (double)side * (double)side),
                                    .samples_a_face = samples->covered / fmax(samples->faces, 1.0),
                                    .layered = samples->layered};
}

struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                             uint32_t corners_max, const struct zr_cancel *cancel)
{
    const struct zr_view *view = &scene->views[0];
    const struct zr_cost_passes passes = zr_cost_passes_of(scene, resolved);
    const double line_width = (double)scene->picture.line_width;
    const struct zr_cost_target window = {view->width, view->height, fmax(line_width, 1.0), 1.0},
                                larger = {view->width * passes.side, view->height * passes.side,
                                          fmax(line_width * (double)passes.side, 1.0), (double)passes.side};
    const struct work work = work_of(scene, corners_max);
    struct zr_cost cost = {.algorithm = (int)scene->algorithm};
    count_outputs(scene, &cost);
    /* In a map no face can cover more than it would if it faced the lamp, nor more than all of it. */
    const double of_map = passes.maps > 0 ? square_of_map(&resolved->bounds) : 0.0;
    const struct zr_cost_pass centres =
        zr_cost_pass_measure(scene, &resolved->camera, window, of_map, cancel, work.sampling);
    struct zr_cost_pass samples = centres;
    if (passes.side > 1) samples = zr_cost_pass_measure(scene, &resolved->camera, larger, 0.0, cancel, work.sampling);
    add_pass(&cost, &centres, work.placing, (double)passes.centres);
    add_pass(&cost, &samples, work.placing, (double)passes.samples);
    cost.triangles += (double)passes.maps * work.placing + (passes.makes_normals ? CREASE_T * work.triangles : 0.0);
    const struct zr_cost_covered covered = covered_by(view, passes.side, &centres, &samples);
    const double spot_texels = (double)passes.spot_maps * ((double)ZR_SHADOW_SIDE * ZR_SHADOW_SIDE);
    cost.fragments += fragments_of_spots(scene, resolved, passes.spot_maps, cancel, work.sampling);
    cost.fragments += (of_map > 0.0 ? (passes.map_texels - spot_texels) * centres.surface / of_map : 0.0) +
                      covered.centres * work_of_channels(view) + covered.samples * work_of_colors(scene);
    if (zr_view_wants(view, ZR_CHANNEL_COLOR))
        cost.fragments += (scene->picture.is_linear ? LIT_TEXEL_F : TEXEL_F) *
                          zr_texture_maps_measure(scene, scene->picture.is_linear).texels;
    cost.triangles += ZR_COST_LAYER_T * work.triangles * sides_of_layers(view);
    cost.fragments += ZR_COST_LAYER_F * centres.covered * sides_of_layers(view);
    cost.samples = zr_cost_of_light(scene, &passes, &covered);
    cost.lamp_maps = passes.lamp_maps;
    cost.lamp_map_bytes = zr_cost_lamp_map_bytes(&passes);
    cost.window_bytes = zr_cost_window_bytes(scene, &passes, &covered);
    return cost;
}
