#include "cost/cost_passes.h"

#include "effects/ground.h"
#include "effects/shadow_maps.h"
#include "lines/window_view.h"
#include "render/backdrop.h"
#include "render/layers/layer_surfaces.h"
#include "render/picture.h"
#include "scene/output.h"
#include "scene/picture.h"

static bool wants_channels(const struct zr_view *view)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel != ZR_CHANNEL_COLOR) return true;
    return zr_view_annotates(view);
}

static uint32_t count_lamp_maps(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    uint32_t count = 0;
    struct zr_camera camera;
    for (uint32_t i = 0; i < scene->light_count; i++)
        count += zr_light_casts_shadows(&scene->lights[i]) &&
                 (scene->lights[i].type == ZR_LIGHT_DIRECTIONAL ||
                  zr_light_camera(scene, &scene->lights[i], &resolved->camera, &resolved->bounds, &camera));
    return count;
}

double zr_cost_channel_words(const struct zr_view *view)
{
    double words = 0.0;
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (zr_view_needs(view, (enum zr_channel)c)) words += (double)zr_channel_rows[c].words;
    return words;
}

struct zr_cost_passes zr_cost_passes_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    const struct zr_picture *picture = scene->picture;
    const struct zr_view *view = &scene->views[0];
    /* Passes of the masks, of the target of a flow, and of a trace. */
    const double more = (double)zr_view_has_masks(view) + (double)zr_view_wants(view, ZR_CHANNEL_FLOW) +
                        (double)zr_view_wants(view, ZR_CHANNEL_TRACE);
    struct zr_cost_passes passes = {.centres = scene->is_undrawn ? 0.0 : 1.0 + more,
                                    .side = 1.0,
                                    .has_colors = zr_view_has_pixels(view, ZR_CHANNEL_COLOR),
                                    .has_masks = zr_view_has_masks(view),
                                    .has_flow = zr_view_wants(view, ZR_CHANNEL_FLOW),
                                    .has_walls = zr_view_wants(view, ZR_CHANNEL_WALL),
                                    .has_info = zr_view_wants(view, ZR_CHANNEL_INFO),
                                    .channel_words = zr_cost_channel_words(view)};
    if (!passes.has_colors || !zr_picture_has_own_passes(picture)) return passes;
    passes.samples = 1.0;
    passes.side = (double)picture->side;
    passes.centres = wants_channels(view) + more;
    if (!picture->is_linear) return passes;
    const bool has_maps = zr_diagonal_of(&resolved->bounds) > 0.0f;
    const double ground = has_maps && picture->has_ground;
    passes.centres += picture->occlusion.is_on;
    passes.lamp_maps = has_maps ? count_lamp_maps(scene, resolved) : 0;
    passes.maps = (double)passes.lamp_maps + ground;
    passes.map_texels = (double)passes.lamp_maps * ((double)ZR_SHADOW_SIDE * ZR_SHADOW_SIDE) +
                        ground * ((double)ZR_GROUND_SIDE * ZR_GROUND_SIDE);
    passes.makes_normals = true;
    return passes;
}

bool zr_cost_lights_surfaces(const struct zr_scene *scene)
{
    return scene->picture && scene->picture->is_linear && scene->picture->side == ZR_SURFACES_SIDE &&
           scene->texture_count == 0;
}

bool zr_cost_draws_lines(const struct zr_picture *picture)
{
    return picture->edges.is_on && picture->edges.is_from_mesh;
}

double zr_cost_fine_pixels(double width, double height)
{
    return (double)ZR_FINE_DIAGONAL * ZR_FINE_DIAGONAL / (width * width + height * height);
}

double zr_cost_line_times(const struct zr_scene *scene, const struct zr_cost_passes *passes)
{
    const bool in_picture = passes->samples > 0.0 && scene->picture->is_linear;
    if (scene->is_undrawn || !zr_cost_draws_lines(scene->picture)) return 0.0;
    return (in_picture ? 1.0 : 0.0) + (zr_view_encodes(&scene->views[0], ZR_ENCODING_SVG) ? 1.0 : 0.0);
}

bool zr_cost_refracts(const struct zr_scene *scene)
{
    return scene->picture->is_linear && zr_background_is_opaque(scene) &&
           zr_any_refracts(scene->materials, scene->material_count);
}
