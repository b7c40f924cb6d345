#include "cost.h"

#include <math.h>

#include "base/arena.h"
#include "core.h"
#include "cost_meshes.h"
#include "cost_passes.h"
#include "cost_sample.h"
#include "cost_window.h"
#include "effects/edges.h"
#include "mesh/facts/overlap.h"
#include "output/images/lossy.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"
#include "raster/tile.h"
#include "render/frame_parts.h"
#include "render/layers/layer_surfaces.h"
#include "render/lens.h"
#include "render/picture.h"
#include "scene/camera/resolved_view.h"
#include "scene/output.h"
#include "shade/texture_maps.h"

/* Time per triangle and per fragment, relative to halfspace. */
static const struct {
    double triangle, fragment;
} TIMES[ZR_ALGORITHM_COUNT] = {[ZR_ALGORITHM_HALFSPACE] = {1.0, 1.0},
                               [ZR_ALGORITHM_EDGELIST] = {4.0, 10.0},
                               [ZR_ALGORITHM_TRAPEZOID] = {5.0, 10.0},
                               [ZR_ALGORITHM_SCANLINE] = {6.0, 16.0},
                               [ZR_ALGORITHM_PAINTER] = {12.0, 80.0}};

/* Triangles whose features take as long as those of the smallest part. */
#define FEATURES_OF_PART 100.0

/* Measuring a combined solid, relative to the overlaps of a scene. */
#define INFOS_OF_SOLID 30.0

static void count_geometry(const struct zr_scene *scene, const struct zr_cost_passes *passes, double *counts)
{
    const double times = passes->centres + passes->samples + passes->maps;
    const bool notes_holes = zr_view_notes_holes(&scene->views[0]) && !scene->is_undrawn;
    const bool has_info = zr_view_wants(&scene->views[0], ZR_CHANNEL_INFO) || notes_holes;
    const bool finds_features = scene->has_features || zr_view_picks(&scene->views[0]) || notes_holes;
    const bool finds_boxes = zr_view_space(&scene->views[0], ZR_CHANNEL_POSITION) == ZR_SPACE_NOCS;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        const double triangles = (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
        counts[ZR_COST_INSTANCE] += times;
        counts[ZR_COST_VERTEX] += times * (double)mesh->position_count;
        if (finds_boxes) counts[ZR_COST_VERTEX] += (double)mesh->position_count;
        counts[ZR_COST_TRIANGLE] += times *
                                    (triangles + 2.0 * (double)mesh->line_count + 0.5 * (double)mesh->point_count) *
                                    TIMES[scene->algorithm].triangle;
        const enum zr_shading shading = scene->materials[mesh->material].shading;
        const bool is_smooth = shading == ZR_SHADING_GOURAUD || shading == ZR_SHADING_PHONG;
        if (has_info && triangles >= ZR_OVERLAP_FACES_LEAST) counts[ZR_COST_INFO] = 1.0;
        if (has_info) counts[ZR_COST_FACT] += scene->csg ? 2.0 * triangles : triangles;
        if (has_info && finds_features) counts[ZR_COST_FEATURE] += triangles;
        if (has_info && scene->distance_count > 0) counts[ZR_COST_FACT] += 8.0 * triangles;
        if (zr_view_wants(&scene->views[0], ZR_CHANNEL_WALL)) counts[ZR_COST_FACT] += triangles;
        if (has_info) counts[ZR_COST_PART] += zr_mesh_part_count(mesh);
        if (scene->sections.count > 0) /* the mesh is welded, and each plane lists all corners again */
            counts[ZR_COST_SECTION_CORNER] +=
                (double)mesh->face_offsets[mesh->face_count] * (2.0 + (double)scene->sections.count);
        if (passes->makes_normals || (is_smooth && mesh->normal_count == 0 && !scene->is_undrawn))
            counts[ZR_COST_NORMAL] += triangles;
        counts[ZR_COST_DRAWN_TRIANGLE] += zr_cost_line_times(scene, passes) * triangles;
    }
    counts[ZR_COST_PART] = fmin(counts[ZR_COST_PART], ZR_FRAME_PARTS_MAX);
    if (has_info && scene->csg) counts[ZR_COST_INFO] += INFOS_OF_SOLID;
    if (finds_features) counts[ZR_COST_FEATURE] += FEATURES_OF_PART * counts[ZR_COST_PART];
}

/* Cost per pixel of a computed data channel, relative to POSITION. */
static const double CHANNEL_TIMES[ZR_CHANNEL_COUNT] = {
    [ZR_CHANNEL_DISTANCE] = 1.0, [ZR_CHANNEL_POSITION] = 1.0,     [ZR_CHANNEL_TEXCOORD] = 1.0,
    [ZR_CHANNEL_NORMALS] = 0.4,  [ZR_CHANNEL_BARYCENTRICS] = 4.0, [ZR_CHANNEL_FLOW] = 4.0,
    [ZR_CHANNEL_LAYERS] = 1.3,   [ZR_CHANNEL_THICKNESS] = 1.7};

/* Kinds of cost per pixel of files, beside that of their words. */
enum { ZR_COST_NONE = ZR_COST_KINDS };
#define ROW(ID, word, ending, spelling, type, noun, properties, side_max, COST, text) ZR_COST_##COST,
static const int FILE_COSTS[ZR_ENCODING_COUNT] = {ZR_ENCODING_ROWS(ROW)};
#undef ROW

/* Trying qualities for a number of bytes makes up to ZR_LOSSY_TRIES files. */
static void count_file(const struct zr_scene *scene, const struct zr_output *output, double pixels, double *counts)
{
    const bool is_small = scene->compress == ZR_COMPRESS_SMALL,
               is_tried = output->max_bytes > 0 && zr_encoding_has(output->encoding, ZR_ENCODING_HAS_QUALITY);
    const int kind = FILE_COSTS[output->encoding];
    if (kind == ZR_COST_NONE) return;
    if (output->is_lossless) /* effort 6 takes about 2.5 times as long as effort 1 */
        counts[ZR_COST_LOSSLESS_WEBP_PIXEL] += pixels * (is_small ? 2.5 : 1.0);
    else
        counts[kind == ZR_COST_PNG_PIXEL && is_small ? ZR_COST_SMALL_PNG_PIXEL : kind] +=
            pixels * (is_tried ? (double)ZR_LOSSY_TRIES : 1.0);
}

/* Channels are computed for all `drawn` pixels. With a lens, they are more than those of the view. */
static void count_outputs(const struct zr_scene *scene, double drawn, double *counts)
{
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height;
    for (uint32_t i = 0; !scene->is_undrawn && i < view->output_count; i++) {
        if (view->outputs[i].encoding == ZR_ENCODING_SVG) continue;
        counts[ZR_COST_OUTPUT_WORD] += pixels * fmax((double)zr_channel_rows[view->outputs[i].channel].words, 1.0);
        counts[ZR_COST_CHANNEL_PIXEL] += drawn * CHANNEL_TIMES[view->outputs[i].channel];
        count_file(scene, &view->outputs[i], pixels, counts);
    }
}

/* Returns how often all faces are drawn for channels of layers; thickness draws both sides. */
static double layer_walks(const struct zr_view *view)
{
    return (zr_view_wants(view, ZR_CHANNEL_LAYERS) ? 1.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_THICKNESS) ? 2.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) ? 1.0 : 0.0) + (zr_view_picks(view) ? 1.0 : 0.0) +
           (zr_view_has_masks(view) ? 1.0 : 0.0);
}

/* Faces above one another in a pixel of the window. */
static double depth_of(const struct zr_cost_sample *sample)
{
    return sample->scale * sample->fragments / (sample->width * sample->height);
}

/* A wall is searched for in a tree of all triangles, from each covered pixel. Half of the faces look away. Where many lie
 * above one another, more of the tree is visited. */
static double wall_pixels(const struct zr_cost_sample *sample)
{
    const double faces = sample->faces * sample->scale, covered = 0.5 * sample->scale * sample->fragments;
    return fmin(covered, sample->width * sample->height) * pow(fmax(faces / 1000.0, 1.0), 0.3) *
           (1.0 + fmin(depth_of(sample), 240.0) / 16.0);
}

/* Layers are sorted in each pixel. */
static double sorted_layers(const struct zr_cost_sample *sample)
{
    return sample->scale * sample->fragments * fmin(fmax(depth_of(sample) / 12.0, 1.0), 8.0);
}

static double square(double value)
{
    return value * value;
}

/* Returns the number of pairs of faces whose boxes meet. The sample has a face. */
static double meeting_pairs(const struct zr_cost_sample *sample)
{
    const double faces = sample->faces * sample->scale,
                 meets_x = fmin(2.0 * sample->boxes_width / sample->faces / sample->width, 1.0),
                 meets_y = fmin(2.0 * sample->boxes_height / sample->faces / sample->height, 1.0);
    return 0.5 * faces * faces * meets_x * meets_y;
}

/* Returns the number of pairs of faces that cut one another. */
static double crossing_pairs(const struct zr_cost_sample *sample)
{
    return 0.5 * sample->crossing * square(sample->faces * sample->scale);
}

/* Counts the pixels that the painter compares: those of faces that meet, and those of the pieces of faces that it cuts,
 * each with the faces near it. It ends at ZR_PAINTER_WORK_MAX. */
static void count_painter(const struct zr_cost_sample *sample, double drawn, double *counts)
{
    if (sample->faces <= 0.0) return;
    const double pixels = sample->fragments / sample->faces, faces = sample->faces * sample->scale;
    const double cuts = crossing_pairs(sample) * faces * sqrt(pixels) * (1.0 + 0.1 * sample->crossing * faces);
    counts[ZR_COST_COMPARISON] = meeting_pairs(sample) * (1.0 + 0.25 * pixels) * drawn;
    counts[ZR_COST_CUT_PIXEL] = fmin(cuts, (double)ZR_PAINTER_WORK_MAX) * drawn;
}

/* Beyond its bounds, a trace ends. Algorithms without a z-buffer do not list the depths of pixels. */
static double traced_pixels(const struct zr_cost_sample *sample)
{
    const enum zr_algorithm algorithm = sample->scene->algorithm;
    const bool has_depths = algorithm != ZR_ALGORITHM_SCANLINE && algorithm != ZR_ALGORITHM_PAINTER;
    const double most = (double)ZR_TRACE_PRIMITIVES_MAX * sample->width * sample->height;
    return (has_depths ? 1.0 : 0.2) * fmin(sample->scale * (sample->fragments + sample->line_fragments), most);
}

/* Most pixels times corners that a trace visits before it is beyond its bounds. */
#define TRACED_SHAPES_MAX 1e8

/* Returns the corners of all faces and lines. */
static double count_corners(const struct zr_scene *scene)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        sum += (double)mesh->face_offsets[mesh->face_count] + 2.0 * (double)mesh->line_count;
    }
    return sum;
}

/* Edges cross half of the rows of their face. Scanline lists the faces between each two edges of a row, and visits
 * their corners twice as often. The painter compares each two faces, again after each cut. */
static void count_trace(const struct zr_cost_sample *sample, double *counts)
{
    const enum zr_algorithm algorithm = sample->scene->algorithm;
    const double faces = sample->faces * sample->scale, window = sample->width * sample->height;
    const double shapes = sample->scale * sample->shape_samples;
    counts[ZR_COST_TRACED_PIXEL] = traced_pixels(sample);
    counts[ZR_COST_TRACED_SHAPE] = fmin(algorithm == ZR_ALGORITHM_SCANLINE ? 2.0 * shapes : shapes, TRACED_SHAPES_MAX);
    if (faces <= 0.0) return;
    const double rows = 0.5 * sample->boxes_height / sample->faces, pixels = sample->fragments / sample->faces;
    double edges = count_corners(sample->scene) * rows;
    if (algorithm == ZR_ALGORITHM_SCANLINE) edges += 2.0 * fmin(edges, window) * faces * pixels / window;
    counts[ZR_COST_TRACED_EDGE] = fmin(edges, ZR_TRACE_VALUES_MAX / 4);
    if (algorithm == ZR_ALGORITHM_PAINTER)
        counts[ZR_COST_TRACED_COMPARISON] =
            pixels * fmin(meeting_pairs(sample) * fmax(faces / 6.0, 1.0), ZR_TRACE_STEPS_MAX);
}

/* Counts pairs of triangles that share a cell, and pairs that cut one another, which share most of their cells. A long
 * triangle lies in many cells. A narrow one has a longer box than others of its area, and neighbours in each cell. */
static void count_line_pairs(const struct zr_cost_sample *sample, double times, double *counts)
{
    const double faces = sample->faces * sample->scale, window = sample->width * sample->height;
    const double per_cell = ZR_COST_CELL_PIXELS / zr_cost_fine_pixels(sample->width, sample->height);
    const double cells = fmin(0.5 * sample->scale * sample->fragments, window) / per_cell + 1.0;
    const double pixels = sample->fragments / fmax(sample->faces, 1.0);
    const double spread = (sample->boxes_width + sample->boxes_height) / fmax(sample->faces, 1.0) / sqrt(per_cell);
    const double of_face = fmin(1.0 + pixels / per_cell + spread, cells);
    const double narrow = fmax(spread - 4.0 * sqrt(pixels / per_cell), 0.0);
    counts[ZR_COST_DRAWN_PAIR] = times * square(faces * of_face) / cells;
    counts[ZR_COST_DRAWN_NARROW] = times * faces * narrow;
    counts[ZR_COST_DRAWN_CROSSING] = times * crossing_pairs(sample) * square(1.0 + sqrt(pixels / per_cell));
}

/* Lit surfaces of a covered pixel, on average. */
static const double SURFACES_A_PIXEL = 2.0;

/* Cost of a sample of a blended surface that is lit once in a pixel, relative to a layer's. Small faces have a surface
 * in each pixel where a sample is theirs: more surfaces than pixels. */
static const double LAYER_SURFACE_TIMES = 0.25;

static double surfaces_a_pixel(const struct zr_cost_sample *sample)
{
    const double pixels = sample->layered / fmax(sample->faces, 1.0);
    if (pixels <= 0.0) return 1.0;
    return fmin(ZR_SURFACES_SIDE * ZR_SURFACES_SIDE * pixels, pixels + 1.6 * sqrt(pixels) + 1.0) / pixels;
}

static void count_fragments(const struct zr_cost_sample *sample, const struct zr_cost_passes *passes, double *counts)
{
    const struct zr_scene *scene = sample->scene;
    const struct zr_picture *picture = scene->picture;
    const double pixels = sample->width * sample->height, samples = pixels * passes->side * passes->side;
    const double scale = sample->scale, drawn = passes->centres + passes->samples * passes->side * passes->side;
    const double times = drawn * scale * TIMES[scene->algorithm].fragment;
    const double depth = scale * sample->layered / pixels, repeats = zr_cost_refracts(scene) ? 2.0 : 1.0;
    counts[ZR_COST_TRIANGLE] += 2.0 * (passes->centres + passes->samples) * scale * sample->outlines;
    counts[ZR_COST_RUN] =
        scale * sample->runs * (passes->centres + passes->maps + passes->samples * (1.0 + 0.5 * passes->side));
    counts[ZR_COST_FRAGMENT] = times * sample->fragments;
    counts[ZR_COST_LINE_FRAGMENT] = times * sample->line_fragments;
    counts[ZR_COST_SHAPE_CORNER] = (passes->centres + passes->samples + passes->maps) * scale * sample->shape_corners;
    counts[ZR_COST_SHAPE_SAMPLE] = drawn * scale * sample->shape_samples;
    /* Each tile looks at all edges of a cap. For lines of the mesh, the cap is triangulated. */
    const double caps = scale * sample->cap_corners;
    counts[ZR_COST_CAP_TILE] = caps * fmax(drawn * pixels / (ZR_TILE_SIZE * ZR_TILE_SIZE), 1.0);
    if (passes->samples > 0.0 && picture->is_linear && zr_cost_draws_lines(picture))
        counts[ZR_COST_SHAPE_CORNER] += 0.25 * caps * caps / fmax((double)scene->instance_count, 1.0);
    const double layer_times = zr_cost_lights_surfaces(scene) ? LAYER_SURFACE_TIMES * surfaces_a_pixel(sample) : 1.0;
    counts[ZR_COST_LAYER] = layer_times * repeats * drawn * scale * sample->layered * fmax(log2(depth) / 10.0, 1.0);
    if (scene->csg) counts[ZR_COST_SOLID_SAMPLE] = (times + passes->map_texels * scale / pixels) * sample->fragments;
    counts[ZR_COST_CHANNEL_LAYER] = layer_walks(&scene->views[0]) * sorted_layers(sample);
    if (zr_view_wants(&scene->views[0], ZR_CHANNEL_WALL)) counts[ZR_COST_WALL_PIXEL] = wall_pixels(sample);
    if (zr_view_wants(&scene->views[0], ZR_CHANNEL_TRACE)) count_trace(sample, counts);
    counts[ZR_COST_MAP_TEXEL] = passes->map_texels;
    counts[ZR_COST_MAP_FRAGMENT] = passes->map_texels * scale * sample->fragments / pixels;
    if (scene->algorithm == ZR_ALGORITHM_PAINTER) count_painter(sample, drawn, counts);
    counts[ZR_COST_DRAWN_PIXEL] = zr_cost_line_times(scene, passes) *
                                  zr_cost_fine_pixels(sample->width, sample->height) * scale * sample->fragments;
    count_line_pairs(sample, zr_cost_line_times(scene, passes), counts);
    if (!zr_view_has_pixels(&scene->views[0], ZR_CHANNEL_COLOR)) return;
    /* Shading runs once per covered sample or surface of a pixel, and once per translucent fragment. If
     * glass zr_cost_refracts, layers are drawn again, with the samples behind them. */
    const double side_squared = passes->samples > 0.0 ? passes->side * passes->side : 1.0;
    const double lit_a_pixel = zr_cost_lights_surfaces(scene) ? SURFACES_A_PIXEL : side_squared;
    const double shaded = fmin(scale * sample->fragments, pixels) + (2.0 * repeats - 1.0) * scale * sample->layered;
    const double share = sample->fragments > 0.0 ? lit_a_pixel * shaded / sample->fragments : 0.0;
    counts[ZR_COST_LIT_SAMPLE] = share * sample->lit;
    counts[ZR_COST_LAMP_SAMPLE] = share * sample->lamps;
    counts[ZR_COST_PLACED_LAMP_SAMPLE] = share * sample->placed_lamps;
    counts[ZR_COST_TEXTURE_SAMPLE] = share * sample->textures;
    counts[ZR_COST_VERTEX_LAMP] = scale * sample->vertex_lamps;
    counts[ZR_COST_VERTEX_PLACED_LAMP] = scale * sample->vertex_placed_lamps;
    counts[picture->is_linear ? ZR_COST_LINEAR_LEVEL_TEXEL : ZR_COST_LEVEL_TEXEL] =
        zr_texture_maps_measure(scene, picture->is_linear).texels;
    if (passes->samples == 0.0) return;
    counts[ZR_COST_WINDOW_SAMPLE] = samples;
    if (!picture->is_linear) return;
    counts[ZR_COST_LINEAR_PIXEL] = pixels;
    const bool has_ground_sun = picture->has_ground && picture->has_ground_sun && passes->lamp_maps > 0;
    counts[ZR_COST_SHADOW_SAMPLE] = share * sample->shadows + (has_ground_sun ? pixels : 0.0);
    if (picture->occlusion.is_on) counts[ZR_COST_OCCLUSION_PIXEL] = fmin(scale * sample->fragments, pixels);
    if (picture->edges.is_on && !picture->edges.is_from_mesh) {
        counts[ZR_COST_EDGE_SAMPLE] = samples;
        const struct zr_view *view = &scene->views[0];
        const double width = (double)zr_edges_width_in(&picture->edges, view->width, view->height);
        counts[ZR_COST_EDGE_WIDTH_SAMPLE] = samples * 0.5 * width * passes->side;
    }
}

static const struct {
    double ns;
    const char *words;
} ROWS[ZR_COST_KINDS] = {
#define COST_ROW(ID, ns, words) {ns, words},
    ZR_COST_ROWS(COST_ROW)
#undef COST_ROW
};

struct zr_cost_most zr_cost_most(const struct zr_cost *cost)
{
    int most = 0;
    for (int kind = 1; kind < ZR_COST_KINDS; kind++)
        if (cost->counts[kind] * ROWS[kind].ns > cost->counts[most] * ROWS[most].ns) most = kind;
    return (struct zr_cost_most){1e-6 * cost->counts[most] * ROWS[most].ns, cost->counts[most], ROWS[most].words};
}

void zr_cost_add(struct zr_cost *cost, enum zr_cost_kind kind, double count)
{
    cost->ms += 1e-6 * count * ROWS[kind].ns;
    cost->counts[kind] += count;
}

void zr_cost_remove(struct zr_cost *cost, enum zr_cost_kind kind)
{
    cost->ms -= 1e-6 * cost->counts[kind] * ROWS[kind].ns;
    cost->counts[kind] = 0.0;
}

/* Adds the pixels that a lens looks up, and the channels of the view. */
static void add_lens(const struct zr_view *view, struct zr_cost *cost)
{
    const double pixels = (double)view->width * (double)view->height;
    cost->counts[ZR_COST_LENS_PIXEL] += pixels;
    cost->window_bytes +=
        pixels * (sizeof(uint32_t) * zr_cost_channel_words(view) + (double)sizeof(struct zr_remap_place));
}

/* Geometry and fragments are those of `drawn`, with the view `resolved`; outputs are those of `scene`. With a lens,
 * `drawn` is the pinhole picture, else `scene`. */
static struct zr_cost cost_of(const struct zr_scene *scene, const struct zr_scene *drawn,
                              const struct zr_resolved_view *resolved)
{
    const struct zr_cost_passes passes = zr_cost_passes_of(drawn, resolved);
    const struct zr_view *view = &drawn->views[0];
    struct zr_cost cost = {.counts = {[ZR_COST_REQUEST] = 1.0}, .lamp_maps = passes.lamp_maps};
    const struct zr_cost_sample sample = zr_cost_sample_of(drawn, resolved);
    cost.window_bytes =
        zr_cost_window_bytes(drawn, &passes, sample.kept * (passes.samples > 0.0 ? passes.side * passes.side : 1.0),
                             sample.scale * sample.fragments);
    count_geometry(drawn, &passes, cost.counts);
    count_outputs(scene, (double)view->width * (double)view->height, cost.counts);
    count_fragments(&sample, &passes, cost.counts);
    if (drawn != scene && !scene->is_undrawn) add_lens(&scene->views[0], &cost);
    for (int kind = 0; kind < ZR_COST_KINDS; kind++)
        cost.ms += 1e-6 * cost.counts[kind] * ROWS[kind].ns;
    cost.mesh_bytes = zr_cost_mesh_bytes(drawn, &passes);
    cost.lamp_map_bytes = zr_cost_lamp_map_bytes(passes.lamp_maps);
    return cost;
}

struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    struct zr_lens_drawing drawing;
    if (!resolved->lens) return cost_of(scene, scene, resolved);
    zr_lens_drawing_open(scene, resolved, &drawing);
    return cost_of(scene, &drawing.scene, &drawing.resolved);
}
