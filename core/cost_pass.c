#include "cost_pass.h"

#include "cost_pairs.h"
#include "geometry/clip.h"
#include "geometry/face.h"
#include "geometry/viewport.h"
#include "raster/bins.h"
#include "raster/tile.h"

/* What other work takes, in triangles (T) and fragments (F): to a factor of two or three, for what is predicted is
 * to keep out what takes a hundred times too long. */
static const double LINE_T = 1.5;              /* beside its pixels, and again in each tile */
static const double LINE_PIXEL_F = 10.0;       /* one column or row */
static const double WIDE_PIXEL_F = 2.0;        /* each pixel more of it, where lines are wide */
static const double SQUARE_T = 2.0;            /* a point, beside its pixels, and again in each tile */
static const double SQUARE_PIXEL_F = 2.0;      /* of the window */
static const double CUT_T = 1.0 / 80.0;        /* triangulation: a corner times a corner */
static const double SHAPE_PIXEL_F = 10.0;      /* decided by the odd-even rule */
static const double SHAPE_OVERLAP_F = 0.2;     /* a sample looked up in one of a shape's triangles */
static const double SHAPE_VISIT_T = 1.0 / 8.0; /* an edge or a triangle of a shape, met by a tile */
static const double WIDE_VISIT_T = 1.0 / 8.0;  /* a triangle of some tiles, in one of them */
static const double LARGE_TRY_T = 1.0 / 16.0;  /* one of more tiles, in each of the window: is it there? */
enum { TILES_OF_SMALL = 4, TILES_OF_LISTED = ZR_BIN_TILES };
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
    zr_mat4 object_to_clip, object_to_world;
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

/* What a walk over faces, lines and points adds up. */
struct tally {
    struct zr_cost_target target;
    struct zr_viewport viewport;
    double surface_most; /* of a face; 0: surfaces are not wanted */
    struct zr_cost cost;
    double covered;                /* pixels of all faces, lines and points */
    double surface;                /* of all faces, in the world, scene units squared */
    double layered, masked;        /* of these, pixels of what is see-through, and what has a mask */
    double layered_triangles;      /* triangles of what is see-through */
    double faces;                  /* whose pixels count */
    double seen;                   /* those of them that `kept` has been offered */
    struct zr_cost_triangle *kept; /* of some of these, for the painter; or NULL: of none */
    size_t kept_count;
};

/* Tiles that a box of pixels touches. */
static double tiles_of(double width, double height)
{
    return (width / ZR_TILE_SIZE + 1.0) * (height / ZR_TILE_SIZE + 1.0);
}

static void add_layers(struct tally *tally, const struct zr_material *material, double pixels, double triangles)
{
    if (!zr_material_is_layered(material)) return;
    if (material->alpha_mode == ZR_ALPHA_MASK) tally->masked += pixels;
    tally->layered += pixels;
    tally->layered_triangles += triangles;
}

/* Of a line's width, what is in the window: of a line at its border, half. */
static double width_in_window(const struct tally *tally, const struct zr_window_vertex *a,
                              const struct zr_window_vertex *b)
{
    const bool goes_across = fabs((double)a->x - (double)b->x) >= fabs((double)a->y - (double)b->y);
    const double room = (double)(goes_across ? tally->target.height : tally->target.width);
    return fmin(fmax(0.5 * tally->target.line_width, 1.0), room);
}

static void add_line(struct tally *tally, const struct zr_material *material, const zr_vec4 ends[2])
{
    const unsigned codes[2] = {zr_clip_outcode(ends[0]), zr_clip_outcode(ends[1])};
    const double width = tally->target.line_width;
    struct zr_cost *cost = &tally->cost;
    struct zr_clipped clipped;
    struct zr_window_vertex a, b;
    cost->triangles += LINE_T;
    if (codes[0] & codes[1] || !zr_clip_line(ends, codes, &clipped)) return;
    if (!zr_viewport_apply(&tally->viewport, clipped.vertices[0].position, &a) ||
        !zr_viewport_apply(&tally->viewport, clipped.vertices[1].position, &b))
        return;
    double length = fmax(fabs((double)a.x - (double)b.x), fabs((double)a.y - (double)b.y));
    cost->fragments += length * (LINE_PIXEL_F + WIDE_PIXEL_F * (width - 1.0));
    cost->triangles += LINE_T * length / ZR_TILE_SIZE * (1.0 + width / ZR_TILE_SIZE);
    tally->covered += length * width;
    add_layers(tally, material, length * width_in_window(tally, &a, &b), 1.0);
}

static void add_outline(struct tally *tally, const struct zr_material *material, const struct zr_mesh *mesh,
                        struct zr_rings rings, const struct placed *placed)
{
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *indices = mesh->indices + rings.offsets[r];
        uint32_t count = rings.offsets[r + 1] - rings.offsets[r];
        zr_vec4 ends[2] = {corner_of(mesh, placed, indices[count - 1])};
        for (uint32_t i = 0; i < count; i++) {
            ends[1] = corner_of(mesh, placed, indices[i]);
            add_line(tally, material, ends);
            ends[0] = ends[1];
        }
    }
}

/* The fans of concave rings cover more than the face, but no more than their box. */
static void add_filled(struct tally *tally, const struct measure *measure, bool shape, double corners)
{
    struct zr_cost *cost = &tally->cost;
    double width = measure->max_x - measure->min_x, height = measure->max_y - measure->min_y;
    double pixels = fmin(measure->area, width * height), tiles = tiles_of(width, height);
    tally->covered += pixels;
    if (shape) {
        cost->shape_fragments += SHAPE_PIXEL_F * pixels + SHAPE_OVERLAP_F * measure->area;
        cost->shape_triangles += SHAPE_VISIT_T * tiles * corners;
        return;
    }
    cost->fragments += pixels;
    if (tiles > TILES_OF_SMALL && tiles <= TILES_OF_LISTED)
        cost->triangles += WIDE_VISIT_T * (corners - 2.0) * tiles;
    else if (tiles > TILES_OF_LISTED)
        cost->triangles +=
            LARGE_TRY_T * (corners - 2.0) * tiles_of((double)tally->target.width, (double)tally->target.height);
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

/* A square around its middle, as much of it as is in the window. Where pairs are counted half of it stands for it. */
static void add_point(struct tally *tally, const struct zr_material *material, const struct zr_mesh *mesh,
                      zr_vec4 middle)
{
    const double width = fmax((double)mesh->point_size, 1.0) * tally->target.side;
    struct zr_window_vertex at;
    tally->cost.triangles += SQUARE_T;
    if (zr_clip_outcode(middle) != 0 || !zr_viewport_apply(&tally->viewport, middle, &at)) return;
    const double x = (double)at.x - 0.5 * width, y = (double)at.y - 0.5 * width;
    const double across = fmin(x + width, (double)tally->target.width) - fmax(x, 0.0);
    const double up = fmin(y + width, (double)tally->target.height) - fmax(y, 0.0);
    const double pixels = fmax(across, 0.0) * fmax(up, 0.0);
    tally->covered += pixels;
    add_layers(tally, material, pixels, 1.0);
    tally->cost.fragments += SQUARE_PIXEL_F * pixels;
    tally->cost.triangles += SQUARE_T * tiles_of(across, up);
    if (!tally->kept) return;
    struct zr_cost_triangle half = {{at, at, at}};
    half.corners[0].x = half.corners[2].x = (float)x;
    half.corners[0].y = half.corners[1].y = (float)y;
    half.corners[1].x = (float)(x + width);
    half.corners[2].y = (float)(y + width);
    keep(tally, &half);
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

/* Of all rings, holes too, in the world. A corner at infinity makes it so large. */
static double surface_of(const struct zr_mesh *mesh, struct zr_rings rings, const zr_mat4 *object_to_world)
{
    double sum = 0.0;
    for (uint32_t r = 0; r < rings.count; r++) {
        const uint32_t *indices = mesh->indices + rings.offsets[r];
        zr_vec3 corners[3];
        for (uint32_t i = 0; i < rings.offsets[r + 1] - rings.offsets[r]; i++) {
            const zr_vec4 p = zr_mat4_apply(object_to_world, mesh->positions[indices[i]]);
            if (p.w == 0.0f) return HUGE_VAL;
            corners[i < 2 ? i : 2] = zr_vec4_over_w(p);
            if (i < 2) continue;
            const zr_vec3 doubled =
                zr_vec3_cross(zr_vec3_sub(corners[1], corners[0]), zr_vec3_sub(corners[2], corners[0]));
            sum += 0.5 * sqrt((double)zr_vec3_dot(doubled, doubled));
            corners[1] = corners[2];
        }
    }
    return isnan(sum) ? 0.0 : sum;
}

static void add_face(struct tally *tally, const struct zr_scene *scene, const struct zr_mesh *mesh, uint32_t face,
                     const struct placed *placed)
{
    struct zr_cost *cost = &tally->cost;
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    const struct zr_material *material = zr_material_of_face(scene, mesh, face);
    struct measure measure = {
        .viewport = &tally->viewport, .min_x = HUGE_VAL, .min_y = HUGE_VAL, .max_x = -HUGE_VAL, .max_y = -HUGE_VAL};
    uint32_t corners = rings.offsets[rings.count] - rings.offsets[0];
    if (material->outline != ZR_OUTLINE_NONE) add_outline(tally, material, mesh, rings, placed);
    if (material->unfilled) return;
    if (tally->surface_most > 0.0)
        tally->surface += fmin(surface_of(mesh, rings, &placed->object_to_world), tally->surface_most) *
                          (material->alpha_mode == ZR_ALPHA_MASK ? 1.0 + ZR_COST_LAYER_F : 1.0);
    measure_fans(&measure, mesh, rings, placed);
    bool shape = zr_face_is_shape(mesh, face);
    if (shape) cost->shape_triangles += CUT_T * (double)corners * (double)corners;
    bool turned_away = (placed->mirrored ? measure.net > 0.0 : measure.net < 0.0) && !material->double_sided;
    if (measure.area <= 0.0 || turned_away) return;
    add_filled(tally, &measure, shape, (double)corners);
    add_layers(tally, material, measure.area, (double)corners - 2.0);
    if (measure.is_seen) tally->faces += 1.0;
    if (!tally->kept) return;
    const struct zr_cost_triangle whole = stand_in(&measure, mesh, rings, placed);
    keep(tally, &whole);
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

/* Of a walk over `sampling.samples` of them. */
static struct zr_cost_pass pass_of(const struct tally *sum, struct zr_cost_sampling sampling,
                                   enum zr_algorithm algorithm)
{
    const double triangle_times = TIMES[algorithm].triangle, fragment_times = TIMES[algorithm].fragment;
    const double scale = sampling.samples > 0 ? (double)sampling.things / (double)sampling.samples : 0.0;
    const double more = sum->kept ? comparisons(sum, sum->seen * scale) : 0.0;
    return (struct zr_cost_pass){
        .triangle_times = triangle_times,
        .cost = {.triangles = (sum->cost.triangles * triangle_times + sum->layered_triangles * ZR_COST_LAYER_T) * scale,
                 .fragments = (sum->cost.fragments * fragment_times + sum->layered * ZR_COST_LAYER_F) * scale + more,
                 .shape_triangles = sum->cost.shape_triangles * scale * triangle_times,
                 .shape_fragments = sum->cost.shape_fragments * scale * fragment_times},
        .covered = sum->covered * scale,
        .layered = sum->layered * scale,
        .masked = sum->masked * scale,
        .faces = sum->faces * scale,
        .surface = sum->surface * scale};
}

struct zr_cost_pass zr_cost_pass_measure(const struct zr_scene *scene, const struct zr_camera *camera,
                                         struct zr_cost_target target, double surface_most,
                                         const struct zr_cancel *cancel, struct zr_cost_sampling sampling)
{
    struct zr_cost_triangle kept[ZR_COST_PAIRS_SAMPLE];
    const uint64_t things = sampling.things, samples = sampling.samples;
    zr_mat4 world_to_clip = zr_mat4_mul(&camera->projection, &camera->world_to_eye);
    struct placed placed = {.mirrored = false};
    const struct zr_mesh *mesh = NULL;
    uint64_t first = 0, end = 0; /* the faces, lines and points of `mesh`, counted over all instances */
    uint32_t next_instance = 0;
    struct tally sum = {.target = target,
                        .viewport = zr_viewport_make(target.width, target.height),
                        .surface_most = surface_most,
                        .kept = scene->algorithm == ZR_ALGORITHM_PAINTER ? kept : NULL};
    for (uint64_t k = 0; k < samples && !zr_is_cancelled(cancel); k++) {
        uint64_t begin = k * things / samples, size = (k + 1) * things / samples - begin;
        uint64_t thing = begin + scatter(k) % size;
        while (thing >= end) {
            const struct zr_instance *instance = &scene->instances[next_instance++];
            mesh = &scene->meshes[instance->mesh];
            placed.object_to_world = instance->object_to_world;
            placed.object_to_clip = zr_mat4_mul(&world_to_clip, &instance->object_to_world);
            placed.mirrored = zr_mat4_is_mirror(&camera->world_to_eye) != zr_mat4_is_mirror(&instance->object_to_world);
            first = end;
            end += zr_mesh_ids(mesh);
        }
        uint32_t number = (uint32_t)(thing - first);
        if (number < mesh->face_count) {
            add_face(&sum, scene, mesh, number, &placed);
            continue;
        }
        number -= mesh->face_count;
        if (number >= mesh->line_count) {
            add_point(&sum, &scene->materials[mesh->material], mesh,
                      corner_of(mesh, &placed, mesh->points[number - mesh->line_count]));
            continue;
        }
        const uint32_t *line = mesh->lines + 2 * (size_t)number;
        const zr_vec4 ends[2] = {corner_of(mesh, &placed, line[0]), corner_of(mesh, &placed, line[1])};
        add_line(&sum, &scene->materials[mesh->material], ends);
    }
    return pass_of(&sum, sampling, scene->algorithm);
}
