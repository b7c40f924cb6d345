#include "cost_picture.h"

#include <math.h>

#include "base/arena.h"
#include "effects/ground.h"
#include "effects/shadow_maps.h"
#include "raster/tile.h"
#include "render/layers.h"
#include "render/picture.h"
#include "shade/lights/shadow_map.h"
#include "shade/texture_maps.h"

/* ---- passes ---- */

static bool wants_channels(const struct zr_view *view)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel != ZR_CHANNEL_COLOR) return true;
    return false;
}

static uint32_t sun_count(const struct zr_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->light_count; i++)
        count += zr_light_casts_shadows(&scene->lights[i]) && scene->lights[i].type == ZR_LIGHT_DIRECTIONAL;
    return count;
}

/* Those that see something. */
static uint32_t spot_count(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    uint32_t count = 0;
    struct zr_camera camera;
    for (uint32_t i = 0; i < scene->light_count; i++)
        count += zr_light_casts_shadows(&scene->lights[i]) && scene->lights[i].type == ZR_LIGHT_SPOT &&
                 zr_light_camera(scene, &scene->lights[i], &resolved->camera, &resolved->bounds, &camera);
    return count;
}

struct zr_cost_passes zr_cost_passes_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    const struct zr_picture *picture = &scene->picture;
    const struct zr_view *view = &scene->views[0];
    struct zr_cost_passes passes = {.centres = 1, .side = 1};
    if (!zr_view_wants(view, ZR_CHANNEL_COLOR) || !zr_picture_has_own_passes(picture)) return passes;
    passes.samples = 1;
    passes.side = picture->side;
    passes.centres = wants_channels(view);
    if (!picture->is_linear) return passes;
    const bool has_maps = zr_diagonal_of(&resolved->bounds) > 0.0f;
    const uint32_t spots = has_maps ? spot_count(scene, resolved) : 0;
    const uint32_t shadows = spots + (has_maps ? sun_count(scene) : 0);
    const uint32_t ground = has_maps && picture->has_ground;
    passes.centres += picture->occlusion.is_on;
    passes.maps = shadows + ground;
    passes.lamp_maps = shadows;
    passes.spot_maps = spots;
    passes.map_texels = (double)shadows * ((double)ZR_SHADOW_SIDE * ZR_SHADOW_SIDE) +
                        (double)ground * ((double)ZR_GROUND_SIDE * ZR_GROUND_SIDE);
    passes.makes_normals = true;
    return passes;
}

/* ---- light ---- */

/* Of a sample or a pixel, in those samples of unlit surfaces that take as long: about 6 ns on an AVX-512 machine. */
static const double BYTES_SAMPLE = 0.25; /* averaged; seen or not */
static const double PIXEL = 1.0;         /* finished, and what is kept of it until then; seen or not */
static const double ENVIRONMENT = 1.2;   /* a sample that it lights */
static const double PBR_LAMP = 0.25;
static const double PHONG_LAMP = 0.4;
static const double OTHER_LAMP = 0.08; /* of flat surfaces, and hemispheres */
static const double PLACE = 0.45;      /* of a lamp that has one: the way there, and what arrives */
static const double SHADOW = 5.0;      /* of one lamp: the texels around a place */
static const double TEXTURE = 6.0;     /* of one */
static const double OCCLUSION_PIXEL = 24.0;
static const double OCCLUSION_SAMPLE = 0.2;
static const double EDGE_SAMPLE = 0.6;
static const double EDGE_WORD = 0.2; /* of 64 samples, widened by one */
static const double MAP_TEXEL = 0.5;
enum { LANES_MOST = 16, WORD = 64 };

/* All lamps that light surfaces of the shading, on one sample. */
static double cost_of_lamps(const struct zr_scene *scene, enum zr_shading shading)
{
    const bool is_pbr = zr_shading_is_in(shading, zr_shadings_lit(ZR_SHADED_PHYSICALLY));
    double sum = 0.0;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        const bool around = light->type == ZR_LIGHT_HEMISPHERE;
        if (light->lit == (is_pbr ? ZR_LIT_CLASSIC : ZR_LIT_PBR)) continue;
        const double direct = is_pbr ? PBR_LAMP : zr_shading_has_specular(shading) ? PHONG_LAMP : OTHER_LAMP;
        sum += around ? OTHER_LAMP : direct;
        if (zr_light_has_place(light)) sum += PLACE;
        if (zr_light_casts_shadows(light)) sum += SHADOW;
    }
    return sum;
}

static double cost_of_shading(const struct zr_scene *scene, enum zr_shading shading)
{
    if (zr_shading_is_in(shading, zr_shadings_lit(ZR_SHADED_BY_LAMPS))) return cost_of_lamps(scene, shading);
    if (zr_shading_is_in(shading, zr_shadings_lit(ZR_SHADED_PHYSICALLY)))
        return ENVIRONMENT + cost_of_lamps(scene, shading);
    return 0.0;
}

/* The dearest of all materials. Samples are lit many at once, and anew for each material among them, of which there
 * are many only where faces are small. */
static double cost_of_a_sample(const struct zr_scene *scene, double samples_a_face)
{
    double most = 0.0, textures_most = 0.0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        double textures = 0.0;
        for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
            textures += scene->materials[i].textures[slot] > 0;
        textures_most = fmax(textures_most, TEXTURE * textures);
    }
    for (int shading = 0; shading < ZR_SHADING_COUNT; shading++)
        for (uint32_t i = 0; i < scene->material_count; i++)
            if ((int)scene->materials[i].shading == shading) {
                most = fmax(most, cost_of_shading(scene, (enum zr_shading)shading));
                break;
            }
    most += textures_most;
    const double faces_at_once = fmin((double)LANES_MOST / fmax(samples_a_face, 1.0), LANES_MOST);
    return 1.0 + most * fmax(fmin(faces_at_once, (double)scene->material_count), 1.0);
}

static double cost_of_edges(const struct zr_scene *scene, double window_samples)
{
    const struct zr_edges *edges = &scene->picture.edges;
    const double radius = 0.5 * (double)edges->width * (double)scene->picture.side;
    return edges->is_on ? window_samples * (EDGE_SAMPLE + EDGE_WORD * radius / WORD) : 0.0;
}

double zr_cost_of_light(const struct zr_scene *scene, const struct zr_cost_passes *passes,
                        const struct zr_cost_covered *covered)
{
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height;
    const double window_samples = pixels * (double)passes->side * (double)passes->side;
    if (passes->samples == 0) return 0.0;
    if (!scene->picture.is_linear) return BYTES_SAMPLE * window_samples;
    double sum = PIXEL * pixels + MAP_TEXEL * passes->map_texels + cost_of_edges(scene, window_samples);
    sum += (covered->samples + covered->layered) * cost_of_a_sample(scene, covered->samples_a_face);
    if (scene->picture.occlusion.is_on) sum += covered->centres * OCCLUSION_PIXEL + covered->samples * OCCLUSION_SAMPLE;
    return sum;
}

/* ---- memory ---- */

/* Bytes of a pixel or a sample. EDGE_BYTES: of a tile, whose sides are kept. */
enum {
    WORD_BYTES = 4,
    SAMPLE_BYTES = 8,
    GBUFFER_BYTES = 28,
    OCCLUSION_BYTES = 4,
    LINEAR_BYTES = 16,
    FRAGMENT_BYTES = 8,
    EDGE_BYTES = 7196
};

static double bytes_of_channels(const struct zr_view *view)
{
    double words = 0.0;
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (zr_view_needs(view, (enum zr_channel)c)) words += (double)zr_channel_rows[c].words;
    return WORD_BYTES * words;
}

static double bytes_of_edges(double pixels, double samples)
{
    return pixels * WORD_BYTES + samples * 2.0 / 8.0 + samples / (ZR_TILE_SIZE * ZR_TILE_SIZE) * EDGE_BYTES;
}

/* What is opaque hides layers, nobody knows how many: those are not kept. */
static bool may_hide_layers(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (!zr_material_is_layered(&scene->materials[i])) return true;
    return false;
}

/* Fragments of a tile at once, of as many as tiles have on the average; of the other algorithms, those of the window.
 */
static double bytes_of_layers(const struct zr_scene *scene, double samples, double layered)
{
    const double tiles = fmax(samples / (ZR_TILE_SIZE * ZR_TILE_SIZE), 1.0);
    if (layered < ZR_TILE_SIZE) return 0.0; /* so little may cover the centre of no pixel */
    if (may_hide_layers(scene)) layered = 0.0;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) return layered * FRAGMENT_BYTES + samples * WORD_BYTES;
    return (double)sizeof(struct zr_layers) + layered / tiles * FRAGMENT_BYTES;
}

/* Each as it is drawn and with a border, which are blocks of their own. */
double zr_cost_lamp_map_bytes(const struct zr_cost_passes *passes)
{
    const size_t drawn = ZR_SHADOW_SIDE, bordered = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER;
    const bool are_made = passes->samples > 0 && passes->lamp_maps > 0;
    const size_t bytes =
        zr_arena_block_bytes(drawn * drawn * WORD_BYTES) + zr_arena_block_bytes(bordered * bordered * WORD_BYTES);
    return are_made ? (double)bytes * (double)passes->lamp_maps : 0.0;
}

double zr_cost_window_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes,
                            const struct zr_cost_covered *covered)
{
    const struct zr_picture *picture = &scene->picture;
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height;
    const double samples = pixels * (double)passes->side * (double)passes->side;
    double sum = pixels * bytes_of_channels(view);
    if (zr_view_wants(view, ZR_CHANNEL_COLOR)) sum += zr_texture_maps_measure(scene, picture->is_linear).bytes;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) /* each of them has the whole window at once */
        sum += SAMPLE_BYTES * (pixels * (double)passes->centres + samples * (double)passes->samples);
    sum += bytes_of_layers(scene, samples, covered->layered);
    if (passes->samples == 0 || !picture->is_linear) return sum;
    sum += pixels * LINEAR_BYTES + zr_cost_lamp_map_bytes(passes);
    if (picture->occlusion.is_on) sum += pixels * (GBUFFER_BYTES + OCCLUSION_BYTES);
    if (picture->edges.is_on) sum += bytes_of_edges(pixels, samples);
    return sum;
}
