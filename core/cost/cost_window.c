#include "cost/cost_window.h"

#include <math.h>

#include "lines/cells.h"
#include "raster/tile.h"
#include "render/backdrop.h"
#include "render/layers/layer_surfaces.h"
#include "render/layers/layers.h"
#include "shade/lights/shadow_map.h"
#include "shade/texture_maps.h"

/* Bytes per pixel or sample. EDGE_BYTES: per tile, for its borders. CELL_BYTES: per cell of lines/cells.h. */
enum {
    WORD_BYTES = 4,
    SAMPLE_BYTES = 8,
    GBUFFER_ARRAYS = 7,
    OCCLUSION_ARRAYS = 1,
    LINEAR_BYTES = 16,
    FRAGMENT_BYTES = 8,
    LAYER_SURFACE_BYTES = sizeof(struct zr_layer_surface) + 8,
    EDGE_BYTES = 7196,
    CELL_BYTES = 8,
    LABEL_BYTES = 15,
    NOTE_BYTES = 9
};

/* True if opaque surfaces may hide layers; hidden layers take no memory, and neither do those that are cut away. */
static bool may_hide_layers(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (!zr_material_is_layered(&scene->materials[i])) return true;
    return scene->base != NULL;
}

/* Bytes of the fragments of an average tile; algorithms other than halfspace keep the fragments of the whole window. */
static double bytes_of_layers(const struct zr_scene *scene, double samples, double kept)
{
    const double tiles = fmax(samples / (ZR_TILE_SIZE * ZR_TILE_SIZE), 1.0);
    if (kept < ZR_TILE_SIZE || may_hide_layers(scene) || scene->sections.count > 0) return 0.0;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) return kept * FRAGMENT_BYTES + samples * WORD_BYTES;
    if (zr_cost_lights_surfaces(scene))
        return kept / (ZR_SURFACES_SIDE * ZR_SURFACES_SIDE) / tiles * LAYER_SURFACE_BYTES;
    return (double)sizeof(struct zr_layers) + kept / tiles * FRAGMENT_BYTES;
}

/* Bytes of shadow maps: each is held twice, as drawn and with a border. */
double zr_cost_lamp_map_bytes(uint32_t maps)
{
    const double drawn = ZR_SHADOW_SIDE, bordered = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER;
    return (double)maps * (drawn * drawn + bordered * bordered) * WORD_BYTES;
}

/* Bytes of the masks of instances: three bits per pixel. Each has at least a tenth of its instance's fragments. */
static double bytes_of_masks(const struct zr_scene *scene, double pixels, double fragments)
{
    return 3.0 / 8.0 * fmin(0.1 * fragments, pixels * (double)scene->instance_count);
}

/* Bytes of the cells in which lines of the mesh are found: at least one face is in a cell that faces cover. Small
 * windows may show a detail of the scene, which has fewer fine pixels. */
static double bytes_of_cells(const struct zr_view *view, double pixels, double fragments)
{
    const double cells =
        fmin(zr_cost_fine_pixels((double)view->width, (double)view->height), 2.0) / ZR_COST_CELL_PIXELS;
    return cells * (pixels * CELL_BYTES + fmin(fragments, pixels) * (double)sizeof(struct zr_cell_entry));
}

/* Bytes of light and effects, while samples are drawn. */
static double bytes_of_light(const struct zr_scene *scene, const struct zr_cost_passes *passes, double pixels,
                             double samples)
{
    const struct zr_picture *picture = scene->picture;
    double sum = pixels * LINEAR_BYTES + zr_cost_lamp_map_bytes(passes->lamp_maps);
    if (zr_cost_refracts(scene)) sum += zr_backdrop_bytes(pixels);
    if (picture->occlusion.is_on) sum += (GBUFFER_ARRAYS + OCCLUSION_ARRAYS) * WORD_BYTES * pixels;
    if (picture->edges.is_on && !picture->edges.is_from_mesh)
        sum += pixels * WORD_BYTES + samples * 2.0 / 8.0 + samples / (ZR_TILE_SIZE * ZR_TILE_SIZE) * EDGE_BYTES;
    return sum;
}

/* The picture, lines of the mesh and channels are drawn one after another, in the same memory. */
double zr_cost_window_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes, double kept,
                            double fragments)
{
    const struct zr_picture *picture = scene->picture;
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height, samples = pixels * passes->side * passes->side;
    const bool is_lit = passes->samples > 0.0 && picture->is_linear;
    if (scene->is_undrawn) return 0.0;
    double sum = bytes_of_layers(scene, samples, kept), lines = 0.0;
    if (passes->has_colors) sum += zr_texture_maps_measure(scene, picture->is_linear).bytes;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) /* these keep a z-buffer of the whole window */
        sum += SAMPLE_BYTES * (passes->samples > 0.0 ? samples : pixels);
    if (is_lit) sum += bytes_of_light(scene, passes, pixels, samples);
    if (is_lit && zr_cost_draws_lines(picture)) lines = pixels * WORD_BYTES + bytes_of_cells(view, pixels, fragments);
    const double flow = passes->has_flow ? pixels * WORD_BYTES : 0.0;
    const double masks = passes->has_masks ? bytes_of_masks(scene, pixels, fragments) : 0.0;
    const bool fits = zr_annotate_fits(&view->annotate, view->width, view->height);
    const double marks =
        (zr_annotate_has(&view->annotate, ZR_ANNOTATE_LABELS) ? LABEL_BYTES : 0) +
        (zr_annotate_has(&view->annotate, ZR_ANNOTATE_HOLES) || view->annotate.dimension_count > 0 ? NOTE_BYTES : 0);
    if (fits) sum = fmax(sum, pixels * marks);
    return pixels * passes->channel_words * WORD_BYTES + masks + fmax(fmax(sum, lines), flow);
}
