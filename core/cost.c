/* cost.c - the core: how much work a scene is, counted before any of it is done.
 *
 * Space:  triangles are placed, clipped and measured in the window just as for drawing;
 *         of a large scene a sample will do, one polygon out of each stretch of them, at a
 *         place that no regular pattern in the scene can keep to. The same scene gives
 *         the same cost.
 */
#include "zraster.h"

#include "cost_pairs.h"

#include "geometry/clip.h"
#include "geometry/face.h"
#include "geometry/viewport.h"
#include "raster/tile.h"
#include "scene/camera.h"
#include "scene/resolved_view.h"
#include "scene/scene.h"
#include "shade/colors.h"

/* What other work takes, in triangles (T) and fragments (F): to a factor of two or three, for what is predicted is
 * to keep out what takes a hundred times too long. */
static const double POINT_T = 0.4;             /* placed without a face */
static const double LINE_T = 1.5;              /* beside its pixels, and again in each tile */
static const double LINE_PIXEL_F = 10.0;       /* one column or row */
static const double CUT_T = 1.0 / 80.0;        /* triangulation: a corner times a corner */
static const double SMALL_PNG_TIMES = 30.0;    /* a pixel that is compressed well, of those compressed fast */
static const double SHAPE_PIXEL_F = 10.0;      /* decided by the odd-even rule */
static const double SHAPE_OVERLAP_F = 0.2;     /* a sample looked up in one of a shape's triangles */
static const double SHAPE_VISIT_T = 1.0 / 8.0; /* an edge or a triangle of a shape, met by a tile */
static const double LARGE_VISIT_T = 1.0 / 8.0; /* a large triangle, met by a tile */
enum { TILES_OF_SMALL = 4 };
static const double STAND_IN_MAX = 16.0; /* times the area of three of a face's corners */

/* How many times longer the other algorithms take: for a triangle, and for a fragment. */
static const struct {
    double triangle, fragment;
} TIMES[ZR_ALGORITHM_COUNT] = {[ZR_ALGORITHM_HALFSPACE] = {1.0, 1.0},
                               [ZR_ALGORITHM_EDGELIST] = {2.0, 10.0},
                               [ZR_ALGORITHM_TRAPEZOID] = {3.0, 10.0},
                               [ZR_ALGORITHM_SCANLINE] = {3.0, 16.0},
                               [ZR_ALGORITHM_PAINTER] = {5.0, 80.0}};

/* The painter looks at every two that meet, and compares them pixel by pixel where they overlap. Of two that run
 * through one another it cuts one, whose parts run through others: so this is taken for each row of such a pair, as
 * often as a triangle is crossed. Those that only overlap wait for one another, in chains that are walked anew for each
 * that comes round and is cut, row by row. Fitted to scenes in windows of 128 and 512 pixels: 60 to 400 triangles
 * of five sizes anywhere, and through one point; 60 to 1000 needles; 30 to 120 layers; 1000 and 3000 parallels and a
 * weave of them; three meshes. Measured anew with these figures, the 46 that take a millisecond or more took 0.13
 * to 2.9 times what is predicted where nothing was learned, two of three 0.5 to 1.3 times; weaves least. What is rare
 * in a scene of thousands is seen by no sample: 200 large triangles among 20000 small ones took 18 times longer. */
static const double MEETING_F = 30.0, COMPARED_F = 2.0, CROSSED_ROW_F = 450.0, CHAINED_ROW_F = 2.0;

/* What the triangles of one face cover, and the box around them. */
struct measure {
    const struct zr_viewport *viewport;
    double area; /* pixels, those covered twice counted twice */
    double net;  /* less those of triangles that face away */
    double min_x, min_y, max_x, max_y;
    bool is_seen;
    struct zr_cost_triangle first; /* that is seen */
};

static void include(struct measure *measure, const struct zr_window_vertex *v)
{
    measure->min_x = fmin(measure->min_x, (double)v->x);
    measure->min_y = fmin(measure->min_y, (double)v->y);
    measure->max_x = fmax(measure->max_x, (double)v->x);
    measure->max_y = fmax(measure->max_y, (double)v->y);
}

/* Adds the visible part of a triangle. */
static void add_triangle(struct measure *measure, const zr_vec4 corners[3])
{
    struct zr_clipped clipped;
    unsigned o[3] = {zr_clip_outcode(corners[0]), zr_clip_outcode(corners[1]), zr_clip_outcode(corners[2])};
    if (o[0] & o[1] & o[2]) return;
    int count = zr_clip_triangle(corners, o[0] | o[1] | o[2], NULL, &clipped);
    struct zr_window_vertex first = {0}, previous = {0}, current;
    double doubled = 0.0;
    for (int i = 0; i < count; i++) {
        if (!zr_viewport_apply(measure->viewport, clipped.vertices[i].position, &current)) return;
        include(measure, &current);
        if (!measure->is_seen && i < 3) measure->first.corners[i] = current;
        if (i == 0) first = current;
        if (i >= 2)
            doubled += (double)(previous.x - first.x) * (double)(current.y - first.y) -
                       (double)(current.x - first.x) * (double)(previous.y - first.y);
        previous = current;
    }
    measure->is_seen |= count >= 3;
    measure->area += fabs(doubled * 0.5);
    measure->net += doubled * 0.5;
}

/* How the faces of one instance get to the window. */
struct placed {
    zr_mat4 object_to_clip;
    bool mirrored; /* a face that shows its front goes clockwise */
};

static zr_vec4 corner_of(const struct zr_mesh *mesh, const struct placed *placed, uint32_t position)
{
    return zr_mat4_apply(&placed->object_to_clip, mesh->positions[position]);
}

static void measure_fans(struct measure *measure, const struct zr_mesh *mesh, struct zr_rings rings,
                         const struct placed *placed)
{
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *indices = mesh->indices + rings.offsets[r];
        zr_vec4 corners[3] = {corner_of(mesh, placed, indices[0]), corner_of(mesh, placed, indices[1])};
        for (uint32_t i = 2; i < rings.offsets[r + 1] - rings.offsets[r]; i++) {
            corners[2] = corner_of(mesh, placed, indices[i]);
            add_triangle(measure, corners);
            corners[1] = corners[2];
        }
    }
}

/* What a walk over faces and lines adds up. */
struct tally {
    struct zr_cost cost;
    double seen;                   /* faces */
    struct zr_cost_triangle *kept; /* of some of these, for the painter; or NULL: of none */
    size_t kept_count;
};

/* Tiles that a box of pixels touches. */
static double tiles_of(double width, double height)
{
    return (width / ZR_TILE_SIZE + 1.0) * (height / ZR_TILE_SIZE + 1.0);
}

static void add_line(struct zr_cost *cost, const struct zr_viewport *viewport, const zr_vec4 ends[2])
{
    const unsigned codes[2] = {zr_clip_outcode(ends[0]), zr_clip_outcode(ends[1])};
    struct zr_clipped clipped;
    struct zr_window_vertex a, b;
    cost->triangles += LINE_T;
    if (codes[0] & codes[1] || !zr_clip_line(ends, codes, &clipped)) return;
    if (!zr_viewport_apply(viewport, clipped.vertices[0].position, &a) ||
        !zr_viewport_apply(viewport, clipped.vertices[1].position, &b))
        return;
    double length = fmax(fabs((double)a.x - (double)b.x), fabs((double)a.y - (double)b.y));
    cost->fragments += LINE_PIXEL_F * length;
    cost->triangles += LINE_T * length / ZR_TILE_SIZE;
}

static void add_outline(struct zr_cost *cost, const struct zr_mesh *mesh, struct zr_rings rings,
                        const struct placed *placed, const struct zr_viewport *viewport)
{
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *indices = mesh->indices + rings.offsets[r];
        uint32_t count = rings.offsets[r + 1] - rings.offsets[r];
        zr_vec4 ends[2] = {corner_of(mesh, placed, indices[count - 1])};
        for (uint32_t i = 0; i < count; i++) {
            ends[1] = corner_of(mesh, placed, indices[i]);
            add_line(cost, viewport, ends);
            ends[0] = ends[1];
        }
    }
}

/* The fans of concave rings cover more than the face, but no more than their box. */
static void add_filled(struct zr_cost *cost, const struct zr_scene *scene, const struct measure *measure, bool shape,
                       double corners)
{
    double width = measure->max_x - measure->min_x, height = measure->max_y - measure->min_y;
    double pixels = fmin(measure->area, width * height), tiles = tiles_of(width, height);
    if (shape) {
        cost->shape_fragments += SHAPE_PIXEL_F * pixels + SHAPE_OVERLAP_F * measure->area;
        cost->shape_triangles += SHAPE_VISIT_T * tiles * corners;
        return;
    }
    cost->fragments += pixels;
    if (tiles > TILES_OF_SMALL)
        cost->triangles +=
            LARGE_VISIT_T * (corners - 2.0) * tiles_of((double)scene->views[0].width, (double)scene->views[0].height);
}

/* Scattered numbers, the same on every machine (Steele's splitmix64). */
static uint64_t scatter(uint64_t n)
{
    n = (n + 1) * 0x9e3779b97f4a7c15u;
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
    return n ^ (n >> 31);
}

/* A part of those that are seen, each as likely as any other (Vitter's algorithm R). */
static void keep(struct tally *tally, const struct zr_cost_triangle *triangle)
{
    const uint64_t number = (uint64_t)tally->seen;
    tally->seen += 1.0;
    const uint64_t place = number < ZR_COST_PAIRS_SAMPLE ? number : scatter(number) % (number + 1);
    if (place >= ZR_COST_PAIRS_SAMPLE) return;
    tally->kept[place] = *triangle;
    if (tally->kept_count <= place) tally->kept_count = place + 1;
}

/* A triangle that stands for the whole face where pairs are counted: three corners far apart, in their plane as large
 * as the face; of a face that is clipped the first triangle seen. */
static struct zr_cost_triangle stand_in(const struct measure *measure, const struct zr_mesh *mesh,
                                        struct zr_rings rings, const struct placed *placed)
{
    struct zr_cost_triangle whole;
    struct zr_window_vertex *c = whole.corners;
    const uint32_t begin = rings.offsets[0], count = rings.offsets[1] - begin;
    if (count == 3) return measure->first;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t index = mesh->indices[begin + k * count / 3];
        const zr_vec4 position = corner_of(mesh, placed, index);
        if (zr_clip_outcode(position) != 0 || !zr_viewport_apply(measure->viewport, position, &c[k]))
            return measure->first;
    }
    const double area = 0.5 * fabs((double)(c[1].x - c[0].x) * (double)(c[2].y - c[0].y) -
                                   (double)(c[2].x - c[0].x) * (double)(c[1].y - c[0].y));
    const double box = (measure->max_x - measure->min_x) * (measure->max_y - measure->min_y);
    if (area < 1.0) return measure->first;
    const float times = (float)sqrt(fmin(fmin(measure->area, box) / area, STAND_IN_MAX));
    const struct zr_window_vertex middle = {.x = (c[0].x + c[1].x + c[2].x) / 3.0f,
                                            .y = (c[0].y + c[1].y + c[2].y) / 3.0f,
                                            .z = (c[0].z + c[1].z + c[2].z) / 3.0f};
    for (int k = 0; k < 3; k++) {
        c[k].x = middle.x + times * (c[k].x - middle.x);
        c[k].y = middle.y + times * (c[k].y - middle.y);
        c[k].z = middle.z + times * (c[k].z - middle.z);
    }
    return whole;
}

static void add_face(struct tally *tally, const struct zr_scene *scene, const struct zr_mesh *mesh, uint32_t face,
                     const struct placed *placed, const struct zr_viewport *viewport)
{
    struct zr_cost *cost = &tally->cost;
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    const struct zr_material *material = zr_material_of_face(scene, mesh, face);
    struct measure measure = {
        .viewport = viewport, .min_x = HUGE_VAL, .min_y = HUGE_VAL, .max_x = -HUGE_VAL, .max_y = -HUGE_VAL};
    uint32_t corners = rings.offsets[rings.count] - rings.offsets[0];
    if (material->outline != ZR_OUTLINE_NONE) add_outline(cost, mesh, rings, placed, viewport);
    if (material->unfilled) return;
    measure_fans(&measure, mesh, rings, placed);
    bool shape = zr_face_is_shape(mesh, face);
    if (shape) cost->shape_triangles += CUT_T * (double)corners * (double)corners;
    bool turned_away = (placed->mirrored ? measure.net > 0.0 : measure.net < 0.0) && !material->double_sided;
    if (measure.area <= 0.0 || turned_away) return;
    add_filled(cost, scene, &measure, shape, (double)corners);
    if (!tally->kept) return;
    const struct zr_cost_triangle whole = stand_in(&measure, mesh, rings, placed);
    keep(tally, &whole);
}

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

/* What the painter takes, in fragments, beside painting. */
static double comparisons(const struct tally *tally, double faces)
{
    const struct zr_cost_pairs pairs = zr_cost_pairs_measure(tally->kept, tally->kept_count);
    const double all = 0.5 * faces * faces, others = 0.5 * faces;
    return all * (MEETING_F * pairs.meeting + COMPARED_F * pairs.area +
                  CROSSED_ROW_F * pairs.rows * (others * pairs.crossing) +
                  CHAINED_ROW_F * pairs.heights * (others * pairs.overlapping));
}

/* Of all faces and lines, from `samples` of them. */
static struct zr_cost measure_sample(const struct zr_scene *scene, const struct zr_camera *camera,
                                     const struct zr_cancel *cancel, uint64_t things, uint64_t samples)
{
    struct zr_cost_triangle kept[ZR_COST_PAIRS_SAMPLE];
    const double triangle_times = TIMES[scene->algorithm].triangle, fragment_times = TIMES[scene->algorithm].fragment;
    struct zr_viewport viewport = zr_viewport_make(scene->views[0].width, scene->views[0].height);
    zr_mat4 world_to_clip = zr_mat4_mul(&camera->projection, &camera->world_to_eye);
    struct placed placed = {.mirrored = false};
    const struct zr_mesh *mesh = NULL;
    uint64_t first = 0, end = 0; /* the faces and lines of `mesh`, counted over all instances */
    uint32_t next_instance = 0;
    struct tally sum = {.kept = scene->algorithm == ZR_ALGORITHM_PAINTER ? kept : NULL};
    for (uint64_t k = 0; k < samples && !zr_is_cancelled(cancel); k++) {
        uint64_t begin = k * things / samples, size = (k + 1) * things / samples - begin;
        uint64_t thing = begin + scatter(k) % size;
        while (thing >= end) {
            const struct zr_instance *instance = &scene->instances[next_instance++];
            mesh = &scene->meshes[instance->mesh];
            placed.object_to_clip = zr_mat4_mul(&world_to_clip, &instance->object_to_world);
            placed.mirrored = zr_mat4_is_mirror(&instance->object_to_world);
            first = end;
            end += zr_mesh_ids(mesh);
        }
        uint32_t number = (uint32_t)(thing - first);
        if (number < mesh->face_count) {
            add_face(&sum, scene, mesh, number, &placed, &viewport);
            continue;
        }
        const uint32_t *line = mesh->lines + 2 * (size_t)(number - mesh->face_count);
        const zr_vec4 ends[2] = {corner_of(mesh, &placed, line[0]), corner_of(mesh, &placed, line[1])};
        add_line(&sum.cost, &viewport, ends);
    }
    double scale = samples > 0 ? (double)things / (double)samples : 0.0;
    const double more = sum.kept ? comparisons(&sum, sum.seen * scale) : 0.0;
    return (struct zr_cost){.triangles = sum.cost.triangles * scale * triangle_times,
                            .fragments = sum.cost.fragments * scale * fragment_times + more,
                            .shape_triangles = sum.cost.shape_triangles * scale * triangle_times,
                            .shape_fragments = sum.cost.shape_fragments * scale * fragment_times};
}

/* What is done at each pixel that is seen, in fragments: about what an AVX-512 machine takes; others take no less. */
static const double LIGHT_F = 0.6, POINT_F = 4.0;

static double pixel_work(const struct zr_scene *scene)
{
    static const enum zr_channel slow[] = {ZR_CHANNEL_DISTANCE, ZR_CHANNEL_POSITION, ZR_CHANNEL_BARYCENTRICS,
                                           ZR_CHANNEL_NORMALS};
    double work = 0.0;
    bool phong = false;
    for (uint32_t i = 0; i < scene->material_count; i++)
        phong |= scene->materials[i].shading == ZR_SHADING_PHONG;
    const struct zr_view *view = &scene->views[0];
    const bool colors = zr_view_wants(view, ZR_CHANNEL_COLOR);
    if (scene->fog.is_on && colors) work += 1.0;
    if (phong && colors) work += 1.0 + LIGHT_F * (double)scene->light_count;
    for (size_t i = 0; i < sizeof slow / sizeof slow[0]; i++)
        if (zr_view_wants(view, slow[i])) work += POINT_F;
    return work;
}

struct zr_cost zr_scene_cost(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                             uint32_t corners_max, const struct zr_cancel *cancel)
{
    struct zr_cost cost = {0};
    uint64_t things = 0, corners = 0;
    double points = 0.0;
    count_outputs(scene, &cost);
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        things += zr_mesh_ids(mesh);
        corners += mesh->face_offsets[mesh->face_count] + 2 * (uint64_t)mesh->line_count;
        points += (double)mesh->position_count;
        cost.triangles += (double)mesh->face_offsets[mesh->face_count] - 2.0 * (double)mesh->face_count;
    }
    cost.triangles += POINT_T * fmax(points - 3.0 * cost.triangles, 0.0);
    uint64_t samples = corners > corners_max ? (uint64_t)corners_max * things / corners : things;
    struct zr_cost measured =
        measure_sample(scene, &resolved->camera, cancel, things, samples > 0 || things == 0 ? samples : 1);
    cost.triangles = cost.triangles * TIMES[scene->algorithm].triangle + measured.triangles;
    cost.fragments = measured.fragments + fmin(measured.fragments, pixels_of(&scene->views[0])) * pixel_work(scene);
    cost.shape_triangles = measured.shape_triangles;
    cost.shape_fragments = measured.shape_fragments;
    cost.algorithm = (int)scene->algorithm;
    return cost;
}
