#include "cost.h"

#include <math.h>

#include "base/arena.h"
#include "effects/ground.h"
#include "effects/shadow_maps.h"
#include "geometry/face.h"
#include "raster/tile.h"
#include "render/layers.h"
#include "render/picture.h"
#include "scene/resolved_view.h"
#include "shade/lights/shadow_map.h"
#include "shade/texture_maps.h"
#include "zraster.h"

/* ---- a sample of faces, lines and points ---- */

/* SAMPLES: most faces, lines and points in the sample. SAMPLED_CORNERS: approximate limit of their corners. */
enum { SAMPLES = 1024, SAMPLED_CORNERS = 1 << 16 };

/* Sums over the sample, in pixels of the window. */
struct tally {
    const struct zr_scene *scene;
    double width, height, line_width, side;
    zr_mat4 world_to_clip, object_to_clip;
    bool is_mirrored;
    double faces, fragments, line_fragments, layered;
    double outlines;                          /* edges drawn as lines */
    double shape_corners, shape_samples;      /* faces that are not convex: squared corners; pixels times corners */
    double kept, kept_squares;                /* lower bound of translucent fragments, for memory; sum of squares */
    double lit, lamps, placed_lamps, shadows; /* lit fragments; the others times lights of their material */
    double textures;                          /* fragments times textures */
    double vertex_lamps, vertex_placed_lamps; /* lit vertices and faces, times lights */
    double boxes_width, boxes_height;         /* sums over the boxes of faces, pixels */
};

/* Projection of a face, line or point to the window. */
struct footprint {
    double low[2], high[2];    /* bounding box, pixels */
    double area, net;          /* sums over rings of the absolute and the signed area; counter-clockwise is positive */
    double perimeter;          /* sum over edges of the larger extent in x or y */
    uint32_t in_front, behind; /* corners in front of the eye, and others */
};

/* Projects a corner to `at` and extends the box; at = 0, 0 behind the eye. */
static void include(const struct tally *tally, struct footprint *print, zr_vec4 position, double at[2])
{
    const zr_vec4 clip = zr_mat4_apply(&tally->object_to_clip, position);
    if (!(clip.w > 0.0f)) {
        print->behind++;
        at[0] = at[1] = 0.0;
        return;
    }
    const double w = (double)clip.w;
    at[0] = (0.5 + 0.5 * (double)clip.x / w) * tally->width;
    at[1] = (0.5 + 0.5 * (double)clip.y / w) * tally->height;
    print->in_front++;
    for (int k = 0; k < 2; k++) {
        print->low[k] = fmin(print->low[k], at[k]);
        print->high[k] = fmax(print->high[k], at[k]);
    }
}

static struct footprint footprint_of(const struct tally *tally, const struct zr_mesh *mesh, struct zr_rings rings)
{
    struct footprint print = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t begin = rings.offsets[r], end = rings.offsets[r + 1];
        double doubled = 0.0, before[2], at[2];
        struct footprint last = print;
        include(tally, &last, mesh->positions[mesh->indices[end - 1]], before);
        for (uint32_t i = begin; i < end; i++) {
            include(tally, &print, mesh->positions[mesh->indices[i]], at);
            doubled += before[0] * at[1] - at[0] * before[1];
            print.perimeter += fmax(fabs(at[0] - before[0]), fabs(at[1] - before[1]));
            before[0] = at[0];
            before[1] = at[1];
        }
        print.area += 0.5 * fabs(doubled);
        print.net += 0.5 * doubled;
    }
    return print;
}

/* Returns the share of an extent inside 0..size; extents count as at least one pixel. */
static double share_within(double low, double high, double size)
{
    const double within = fmin(high, size) - fmax(low, 0.0);
    return within < 0.0 ? 0.0 : fmin(fmax(within, 1.0) / fmax(high - low, 1.0), 1.0);
}

/* Estimates the pixels of a face in the window; a face with corners on both sides of the eye counts as the whole
 * window. */
static double pixels_in_window(const struct tally *tally, const struct footprint *print)
{
    const double window = tally->width * tally->height;
    if (print->in_front == 0) return 0.0;
    if (print->behind > 0) return window;
    const double pixels = print->area * share_within(print->low[0], print->high[0], tally->width) *
                          share_within(print->low[1], print->high[1], tally->height);
    return pixels < window ? pixels : window; /* NaN: all of it */
}

/* Estimates the length of a face's edges in the window, pixels. */
static double length_in_window(const struct tally *tally, const struct footprint *print)
{
    if (print->in_front == 0) return 0.0;
    if (print->behind > 0) return tally->width + tally->height;
    const double share = fmin(share_within(print->low[0], print->high[0], tally->width),
                              share_within(print->low[1], print->high[1], tally->height));
    const double most = (tally->width + tally->height) * (print->in_front);
    return print->perimeter * share < most ? print->perimeter * share : most;
}

static void add_layers(struct tally *tally, const struct zr_material *material, double pixels, double kept)
{
    if (!zr_material_is_layered(material)) return;
    tally->layered += pixels;
    if (material->alpha_mode == ZR_ALPHA_MASK || zr_material_has_textures(material)) return;
    tally->kept += kept;
    tally->kept_squares += kept * kept;
}

/* Cost of a light per pixel without linear light, relative to linear light. */
static const double TEXTBOOK_LAMP_TIMES = 0.2;

/* Counts the lights of a material; `placed`: point and spot lights, `shadows`: lights with shadow maps. */
static void count_lamps(const struct zr_scene *scene, const struct zr_material *material, double *all, double *placed,
                        double *shadows)
{
    const bool is_pbr = material->shading == ZR_SHADING_PBR;
    *all = *placed = *shadows = 0.0;
    if (material->shading == ZR_SHADING_UNLIT || material->shading == ZR_SHADING_NORMALS) return;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        if (light->lit == (is_pbr ? ZR_LIT_CLASSIC : ZR_LIT_PBR)) continue;
        *all += 1.0;
        *placed += zr_light_has_place(light);
        *shadows += zr_light_casts_shadows(light);
    }
}

static void add_light(struct tally *tally, const struct zr_material *material, double pixels, double vertices)
{
    const double lit = tally->scene->picture.is_linear ? pixels : TEXTBOOK_LAMP_TIMES * pixels;
    double all, placed, shadows;
    count_lamps(tally->scene, material, &all, &placed, &shadows);
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        tally->textures += material->textures[slot] ? pixels : 0.0;
    if (tally->scene->picture.is_linear || material->shading == ZR_SHADING_PHONG) {
        tally->lit += material->shading == ZR_SHADING_UNLIT ? 0.0 : pixels;
        tally->lamps += lit * all;
        tally->placed_lamps += lit * placed;
        tally->shadows += pixels * shadows;
    } else if (material->shading == ZR_SHADING_FLAT || material->shading == ZR_SHADING_GOURAUD) {
        tally->vertex_lamps += vertices * all;
        tally->vertex_placed_lamps += vertices * placed;
    }
}

static void add_face(struct tally *tally, const struct zr_mesh *mesh, uint32_t face)
{
    const struct zr_material *material = zr_material_of_face(tally->scene, mesh, face);
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const struct footprint print = footprint_of(tally, mesh, rings);
    const double corners = (double)(rings.offsets[rings.count] - rings.offsets[0]);
    const double shared = (double)mesh->position_count / (double)mesh->face_offsets[mesh->face_count];
    if (material->outline != ZR_OUTLINE_NONE) {
        tally->line_fragments += tally->line_width * length_in_window(tally, &print);
        tally->outlines += corners;
    }
    if (material->unfilled) return;
    const bool shape = zr_face_is_shape(mesh, face);
    const bool is_back = print.behind == 0 && (tally->is_mirrored ? print.net > 0.0 : print.net < 0.0);
    const double pixels = is_back && !material->double_sided ? 0.0 : pixels_in_window(tally, &print);
    const double vertices = material->shading == ZR_SHADING_FLAT ? 1.0 : corners * fmin(shared, 1.0);
    add_light(tally, material, pixels, vertices);
    if (shape) {
        tally->shape_corners += corners * corners;
        tally->shape_samples += pixels * corners;
    }
    if (pixels <= 0.0) return;
    const bool is_whole = print.behind == 0 && print.low[0] >= 0.0 && print.low[1] >= 0.0 &&
                          print.high[0] <= tally->width && print.high[1] <= tally->height && corners == 3.0;
    add_layers(tally, material, pixels, is_whole ? fmax(pixels - 0.5 * print.perimeter, 0.0) : 0.0);
    tally->faces += 1.0;
    tally->fragments += pixels;
    tally->boxes_width += fmin(print.high[0] - print.low[0], tally->width);
    tally->boxes_height += fmin(print.high[1] - print.low[1], tally->height);
}

static void add_line(struct tally *tally, const struct zr_mesh *mesh, const uint32_t ends[2])
{
    const uint32_t offsets[2] = {0, 2};
    struct zr_mesh line = *mesh;
    line.indices = ends;
    struct footprint print = footprint_of(tally, &line, (struct zr_rings){1, offsets});
    print.perimeter *= 0.5; /* footprint_of adds the line twice, as a closed ring */
    const double pixels = tally->line_width * length_in_window(tally, &print);
    tally->line_fragments += pixels;
    add_layers(tally, &tally->scene->materials[mesh->material], pixels, 0.0);
}

/* Cost of a translucent pixel of a point, relative to a pixel of a face. */
static const double POINT_LAYER_TIMES = 3.0;

/* Counts the part of the point's square inside the window. */
static void add_point(struct tally *tally, const struct zr_mesh *mesh, uint32_t position)
{
    struct footprint print = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    const double size = fmax((double)mesh->point_size, 1.0);
    double at[2];
    include(tally, &print, mesh->positions[position], at);
    if (print.in_front == 0) return;
    const double across = fmin(at[0] + 0.5 * size, tally->width) - fmax(at[0] - 0.5 * size, 0.0);
    const double up = fmin(at[1] + 0.5 * size, tally->height) - fmax(at[1] - 0.5 * size, 0.0);
    const double pixels = fmax(across, 0.0) * fmax(up, 0.0);
    tally->line_fragments += pixels;
    add_layers(tally, &tally->scene->materials[mesh->material], POINT_LAYER_TIMES * pixels, 0.0);
}

static void add_primitive(struct tally *tally, const struct zr_mesh *mesh, uint32_t number)
{
    if (number < mesh->face_count)
        add_face(tally, mesh, number);
    else if (number - mesh->face_count < mesh->line_count)
        add_line(tally, mesh, mesh->lines + 2 * (size_t)(number - mesh->face_count));
    else
        add_point(tally, mesh, mesh->points[number - mesh->face_count - mesh->line_count]);
}

/* Returns the n-th pseudo-random number, the same on every machine (Steele's splitmix64). */
static uint64_t scatter(uint64_t n)
{
    n = (n + 1) * 0x9e3779b97f4a7c15u;
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
    return n ^ (n >> 31);
}

/* Adds one primitive from each of `samples` equal ranges, at a pseudo-random place, so that regular patterns in the
 * scene do not bias the sample. */
static void walk(struct tally *tally, uint64_t primitives, uint64_t samples)
{
    const struct zr_mesh *mesh = NULL;
    uint64_t first = 0, end = 0; /* range of `mesh` in the numbers of primitives over all instances */
    uint32_t next_instance = 0;
    for (uint64_t k = 0; k < samples; k++) {
        const uint64_t begin = k * primitives / samples, size = (k + 1) * primitives / samples - begin;
        const uint64_t primitive = begin + scatter(k) % size;
        const struct zr_instance *instance = NULL;
        while (primitive >= end) {
            instance = &tally->scene->instances[next_instance++];
            mesh = &tally->scene->meshes[instance->mesh];
            first = end;
            end += zr_mesh_ids(mesh);
        }
        if (instance) {
            tally->object_to_clip = zr_mat4_mul(&tally->world_to_clip, &instance->object_to_world);
            tally->is_mirrored = zr_mat4_is_mirror(&instance->object_to_world);
        }
        add_primitive(tally, mesh, (uint32_t)(primitive - first));
    }
}

/* ---- passes ---- */

/* Number of passes by kind. */
struct passes {
    double centres; /* at pixel centres: for channels and, in linear light, for occlusion */
    double samples; /* at side x side samples per pixel: 0 or 1 */
    double side;
    double maps, map_texels; /* shadow maps, that of the ground included, and their texels */
    uint32_t lamp_maps;      /* shadow maps of lights */
    bool makes_normals;      /* averages normals over faces */
};

static bool wants_channels(const struct zr_view *view)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel != ZR_CHANNEL_COLOR) return true;
    return false;
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

static struct passes passes_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    const struct zr_picture *picture = &scene->picture;
    const struct zr_view *view = &scene->views[0];
    struct passes passes = {.centres = 1.0, .side = 1.0};
    if (!zr_view_wants(view, ZR_CHANNEL_COLOR) || !zr_picture_has_own_passes(picture)) return passes;
    passes.samples = 1.0;
    passes.side = (double)picture->side;
    passes.centres = wants_channels(view);
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

/* ---- memory ---- */

/* Bytes per pixel or sample. EDGE_BYTES: per tile, for its borders. */
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

/* True if opaque surfaces may hide layers; hidden layers take no memory. */
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
    if (kept < ZR_TILE_SIZE || may_hide_layers(scene)) return 0.0;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) return kept * FRAGMENT_BYTES + samples * WORD_BYTES;
    return (double)sizeof(struct zr_layers) + kept / tiles * FRAGMENT_BYTES;
}

/* Bytes of shadow maps: each is held twice, as drawn and with a border, in separate blocks. */
static double bytes_of_lamp_maps(uint32_t maps)
{
    const size_t drawn = ZR_SHADOW_SIDE, bordered = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER;
    return (double)maps * (double)(zr_arena_block_bytes(drawn * drawn * WORD_BYTES) +
                                   zr_arena_block_bytes(bordered * bordered * WORD_BYTES));
}

static double window_bytes(const struct zr_scene *scene, const struct passes *passes, double kept)
{
    const struct zr_picture *picture = &scene->picture;
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height, samples = pixels * passes->side * passes->side;
    double sum = pixels * bytes_of_channels(view) + bytes_of_layers(scene, samples, kept);
    if (zr_view_wants(view, ZR_CHANNEL_COLOR)) sum += zr_texture_maps_measure(scene, picture->is_linear).bytes;
    if (scene->algorithm != ZR_ALGORITHM_HALFSPACE) /* these keep a z-buffer of the whole window */
        sum += SAMPLE_BYTES * (pixels * passes->centres + samples * passes->samples);
    if (passes->samples == 0.0 || !picture->is_linear) return sum;
    sum += pixels * LINEAR_BYTES + bytes_of_lamp_maps(passes->lamp_maps);
    if (picture->occlusion.is_on) sum += pixels * (GBUFFER_BYTES + OCCLUSION_BYTES);
    if (picture->edges.is_on)
        sum += pixels * WORD_BYTES + samples * 2.0 / 8.0 + samples / (ZR_TILE_SIZE * ZR_TILE_SIZE) * EDGE_BYTES;
    return sum;
}

/* ---- counts ---- */

/* Time per triangle and per fragment, relative to halfspace. */
static const struct {
    double triangle, fragment;
} TIMES[ZR_ALGORITHM_COUNT] = {[ZR_ALGORITHM_HALFSPACE] = {1.0, 1.0},
                               [ZR_ALGORITHM_EDGELIST] = {4.0, 10.0},
                               [ZR_ALGORITHM_TRAPEZOID] = {5.0, 10.0},
                               [ZR_ALGORITHM_SCANLINE] = {6.0, 16.0},
                               [ZR_ALGORITHM_PAINTER] = {12.0, 80.0}};

/* Returns a lower bound of the translucent fragments that rendering keeps: the mean of the sample less six standard
 * deviations of that mean, for all primitives. */
static double kept_at_least(const struct tally *tally, double samples, double scale)
{
    if (scale <= 1.0) return tally->kept;
    const double mean = tally->kept / samples, square = tally->kept_squares / samples;
    return fmax(mean - 6.0 * sqrt(fmax(square - mean * mean, 0.0) / samples), 0.0) * samples * scale;
}

static void count_geometry(const struct zr_scene *scene, const struct passes *passes, double *counts)
{
    const double times = passes->centres + passes->samples + passes->maps;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        const double triangles = (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
        counts[ZR_COST_INSTANCE] += times;
        counts[ZR_COST_VERTEX] += times * (double)mesh->position_count;
        counts[ZR_COST_TRIANGLE] += times * (triangles + 2.0 * ((double)mesh->line_count + (double)mesh->point_count)) *
                                    TIMES[scene->algorithm].triangle;
        const enum zr_shading shading = scene->materials[mesh->material].shading;
        const bool is_smooth = shading == ZR_SHADING_GOURAUD || shading == ZR_SHADING_PHONG;
        if (passes->makes_normals || (is_smooth && mesh->normal_count == 0)) counts[ZR_COST_NORMAL] += triangles;
    }
}

/* Cost per pixel of a computed data channel, relative to POSITION. */
static const double CHANNEL_TIMES[ZR_CHANNEL_COUNT] = {[ZR_CHANNEL_DISTANCE] = 1.0,
                                                       [ZR_CHANNEL_POSITION] = 1.0,
                                                       [ZR_CHANNEL_TEXCOORD] = 1.0,
                                                       [ZR_CHANNEL_NORMALS] = 0.4,
                                                       [ZR_CHANNEL_BARYCENTRICS] = 4.0};

static void count_outputs(const struct zr_scene *scene, double *counts)
{
    const struct zr_view *view = &scene->views[0];
    const double pixels = (double)view->width * (double)view->height;
    for (uint32_t i = 0; i < view->output_count; i++) {
        const enum zr_encoding encoding = view->outputs[i].encoding;
        counts[ZR_COST_OUTPUT_WORD] += pixels * fmax((double)zr_channel_rows[view->outputs[i].channel].words, 1.0);
        counts[ZR_COST_CHANNEL_PIXEL] += pixels * CHANNEL_TIMES[view->outputs[i].channel];
        if (encoding != ZR_ENCODING_PNG && encoding != ZR_ENCODING_PNG16) continue;
        counts[scene->compress == ZR_COMPRESS_SMALL ? ZR_COST_SMALL_PNG_PIXEL : ZR_COST_PNG_PIXEL] += pixels;
    }
}

/* Returns how often all faces are drawn for channels of layers; thickness draws both sides. */
static double layer_walks(const struct zr_view *view)
{
    return (zr_view_wants(view, ZR_CHANNEL_LAYERS) ? 1.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_THICKNESS) ? 2.0 : 0.0) +
           (zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) ? 1.0 : 0.0);
}

static void count_fragments(const struct tally *tally, const struct passes *passes, double scale, double *counts)
{
    const struct zr_scene *scene = tally->scene;
    const struct zr_picture *picture = &scene->picture;
    const double pixels = tally->width * tally->height, samples = pixels * passes->side * passes->side;
    const double drawn = passes->centres + passes->samples * passes->side * passes->side;
    const double times = drawn * scale * TIMES[scene->algorithm].fragment;
    const double depth = scale * tally->layered / pixels;
    counts[ZR_COST_TRIANGLE] += 2.0 * (passes->centres + passes->samples) * scale * tally->outlines;
    counts[ZR_COST_FRAGMENT] = times * tally->fragments;
    counts[ZR_COST_LINE_FRAGMENT] = times * tally->line_fragments;
    counts[ZR_COST_SHAPE_CORNER] = (passes->centres + passes->samples + passes->maps) * scale * tally->shape_corners;
    counts[ZR_COST_SHAPE_SAMPLE] = drawn * scale * tally->shape_samples;
    counts[ZR_COST_LAYER] = drawn * scale * tally->layered * fmax(log2(depth) / 10.0, 1.0);
    counts[ZR_COST_CHANNEL_LAYER] = layer_walks(&scene->views[0]) * scale * tally->fragments;
    counts[ZR_COST_MAP_TEXEL] = passes->map_texels;
    counts[ZR_COST_MAP_FRAGMENT] = passes->map_texels * scale * tally->fragments / pixels;
    if (scene->algorithm == ZR_ALGORITHM_PAINTER && tally->faces > 0.0) {
        const double faces = tally->faces * scale,
                     meets_x = fmin(2.0 * tally->boxes_width / tally->faces / tally->width, 1.0),
                     meets_y = fmin(2.0 * tally->boxes_height / tally->faces / tally->height, 1.0);
        counts[ZR_COST_COMPARISON] =
            0.5 * faces * faces * meets_x * meets_y * (1.0 + 0.25 * tally->fragments / tally->faces) * drawn;
    }
    if (!zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR)) return;
    /* Shading runs once per covered sample, and once per translucent fragment. */
    const double side_squared = passes->samples > 0.0 ? passes->side * passes->side : 1.0;
    const double shaded = fmin(scale * tally->fragments, pixels) + scale * tally->layered;
    const double share = tally->fragments > 0.0 ? side_squared * shaded / tally->fragments : 0.0;
    counts[ZR_COST_LIT_SAMPLE] = share * tally->lit;
    counts[ZR_COST_LAMP_SAMPLE] = share * tally->lamps;
    counts[ZR_COST_PLACED_LAMP_SAMPLE] = share * tally->placed_lamps;
    counts[ZR_COST_TEXTURE_SAMPLE] = share * tally->textures;
    counts[ZR_COST_VERTEX_LAMP] = scale * tally->vertex_lamps;
    counts[ZR_COST_VERTEX_PLACED_LAMP] = scale * tally->vertex_placed_lamps;
    counts[picture->is_linear ? ZR_COST_LINEAR_LEVEL_TEXEL : ZR_COST_LEVEL_TEXEL] =
        zr_texture_maps_measure(scene, picture->is_linear).texels;
    if (passes->samples == 0.0) return;
    counts[ZR_COST_WINDOW_SAMPLE] = samples;
    if (!picture->is_linear) return;
    counts[ZR_COST_LINEAR_PIXEL] = pixels;
    counts[ZR_COST_SHADOW_SAMPLE] = share * tally->shadows;
    if (picture->occlusion.is_on) counts[ZR_COST_OCCLUSION_PIXEL] = fmin(scale * tally->fragments, pixels);
    if (picture->edges.is_on) {
        counts[ZR_COST_EDGE_SAMPLE] = samples;
        counts[ZR_COST_EDGE_WIDTH_SAMPLE] = samples * 0.5 * (double)picture->edges.width * passes->side;
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

struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved)
{
    const struct zr_view *view = &scene->views[0];
    const struct passes passes = passes_of(scene, resolved);
    struct tally tally = {.scene = scene,
                          .width = (double)view->width,
                          .height = (double)view->height,
                          .line_width = fmax((double)scene->picture.line_width, 1.0),
                          .world_to_clip = zr_mat4_mul(&resolved->camera.projection, &resolved->camera.world_to_eye)};
    struct zr_cost cost = {.counts = {[ZR_COST_REQUEST] = 1.0}, .lamp_maps = passes.lamp_maps};
    uint64_t primitives = 0, corners = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        primitives += zr_mesh_ids(&scene->meshes[scene->instances[i].mesh]);
        corners += zr_mesh_corners(&scene->meshes[scene->instances[i].mesh]);
    }
    const double per_primitive = (double)corners / fmax((double)primitives, 1.0);
    const double most = fmin(fmax(SAMPLED_CORNERS / fmax(per_primitive, 1.0), 1.0), SAMPLES);
    const uint64_t samples = primitives < (uint64_t)most ? primitives : (uint64_t)most;
    const double scale = samples > 0 ? (double)primitives / (double)samples : 0.0;
    walk(&tally, primitives, samples);
    count_geometry(scene, &passes, cost.counts);
    count_outputs(scene, cost.counts);
    count_fragments(&tally, &passes, scale, cost.counts);
    for (int kind = 0; kind < ZR_COST_KINDS; kind++)
        cost.ms += 1e-6 * cost.counts[kind] * ROWS[kind].ns;
    cost.lamp_map_bytes = bytes_of_lamp_maps(passes.lamp_maps);
    cost.window_bytes = window_bytes(scene, &passes,
                                     kept_at_least(&tally, (double)samples, scale) *
                                         (passes.samples > 0.0 ? passes.side * passes.side : 1.0));
    return cost;
}
