#include "shade/visible_points.h"

#include <string.h>

#include "base/matrix.h"
#include "geometry/geometry.h"
#include "scene/channels.h"
#include "shade/depths.h"
#include "shade/nocs.h"

/* Values that all samples of a primitive share. */
struct shown {
    uint32_t owner; /* 0: none */
    struct zr_eye_depth depth;
    const struct zr_source_instance *instance;
    const zr_vec4 *corners[3];         /* as given; NULL: a line, or not needed */
    struct zr_eye_depth there;         /* depth of the whole triangle in the target of the flow */
    struct zr_eye_plane parts[2], one; /* shares of corners 1 and 2, and 1, all times one common factor; 0 for lines */
    double w[3];                       /* eye-space w of the corners */
};

/* Primitives recur in the next row, so the last ones are cached. */
enum { REMEMBERED = 64 };

struct points {
    const struct zr_geometry *geometry;
    const struct zr_eye_depths *kernel;
    const struct zr_frame *frame;
    const struct zr_draw *draw; /* draw of the last primitive */
    enum zr_space space;
    bool wants_shares;
    zr_vec4 eye; /* zr_camera_eye */
    struct zr_matrix projection, to_world;
    const struct zr_source_instance *last; /* instance of to_object */
    struct zr_matrix to_object;
    bool is_invertible;
    struct points *target; /* of the channel flow; NULL: not wanted */
    struct shown shown[REMEMBERED];
};

/* ---- primitives ---- */

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Makes a plane as value_planes in eye_depth_kernel.c does. p0: value at corner 0; p1, p2: differences at the
 * others. */
static struct zr_eye_plane value_plane(double (*c)[3], double p0, double p1, double p2, double width, double height)
{
    double normal[3], u[3], a[3];
    cross(c[1], c[2], normal);
    for (int k = 0; k < 3; k++)
        u[k] = p2 * c[1][k] - p1 * c[2][k];
    cross(c[0], u, a);
    const double x = (a[0] + p0 * normal[0]) * height, y = (a[1] + p0 * normal[1]) * width;
    const double one = (a[2] + p0 * normal[2]) * (width * height);
    return (struct zr_eye_plane){(one + x * (1.0 - width)) + y * (1.0 - height), 2.0 * x, 2.0 * y};
}

static double source_value(const struct zr_source_instance *instance, const zr_vec4 *p, int row)
{
    const double(*m)[ZR_SOURCE_ROWS] = instance->columns;
    return (((double)p->x * m[0][row] + (double)p->y * m[1][row]) + (double)p->z * m[2][row]) +
           (double)p->w * m[3][row];
}

static void find_planes(const struct points *points, const struct zr_source *source, struct shown *shown)
{
    static const int rows[3] = {ZR_SOURCE_X, ZR_SOURCE_Y, ZR_SOURCE_W};
    const double width = (double)points->frame->width, height = (double)points->frame->height;
    double c[3][3]; /* corner 0, and the vectors from it to the others */
    for (int i = 0; i < 3; i++) {
        zr_vec4 p = *source->corners[i];
        if (i > 0) {
            const zr_vec4 *o = source->corners[0];
            p = (zr_vec4){p.x - o->x, p.y - o->y, p.z - o->z, p.w - o->w};
        }
        for (int r = 0; r < 3; r++)
            c[i][r] = source_value(source->instance, &p, rows[r]);
        shown->w[i] = source_value(source->instance, source->corners[i], ZR_SOURCE_EYE_W);
    }
    shown->one = value_plane(c, 1.0, 0.0, 0.0, width, height);
    shown->parts[0] = value_plane(c, 0.0, 1.0, 0.0, width, height);
    shown->parts[1] = value_plane(c, 0.0, 0.0, 1.0, width, height);
}

/* Makes the depth of a whole triangle. True if a corner is not in front of the eye. */
static bool make_depth(const struct points *points, const struct zr_source_instance *instance,
                       const zr_vec4 *const given[3], struct zr_eye_depth *depth)
{
    const zr_vec4 *corners[1 + ZR_EYE_ROOM][3];
    struct zr_eye_depth out[1 + ZR_EYE_ROOM];
    memcpy(corners[0], given, sizeof corners[0]);
    const bool is_behind =
        points->kernel->make(instance, corners, 1, points->frame->width, points->frame->height, out) > 0;
    *depth = out[0];
    return is_behind;
}

static struct zr_eye_depth depth_of(const struct points *points, const struct zr_triangle *triangle,
                                    const struct zr_source *source)
{
    struct zr_eye_depth depth;
    if (make_depth(points, source->instance, source->corners, &depth) && source->is_cut)
        zr_eye_depth_take_piece(points->geometry, triangle, &depth);
    return depth;
}

/* Returns the instance in the target of the flow. */
static const struct zr_source_instance *moved_instance(const struct points *points, const struct shown *shown)
{
    return &points->target->geometry->instances[shown->instance - points->geometry->instances];
}

static struct shown shown_make(struct points *points, uint32_t owner)
{
    const struct zr_geometry *geometry = points->geometry;
    points->draw = zr_draw_next(geometry, points->draw, owner - 1);
    const struct zr_triangle triangle = zr_triangle_of(geometry, points->draw, owner - 1);
    struct shown shown = {.owner = owner, .instance = &geometry->instances[points->draw->instance]};
    if (triangle.line) {
        shown.depth = zr_eye_depth_of_line(geometry, points->draw, owner - 1);
        return shown;
    }
    const struct zr_source source = zr_source_of(geometry, points->draw, triangle.v);
    shown.depth = depth_of(points, &triangle, &source);
    if (!points->wants_shares) return shown;
    struct zr_source given = source;
    const bool is_turned = ZR_MUTANT(shares_of_turned_corners, triangle.turned, false);
    if (is_turned && !source.is_cut) { /* undo rule 6's swap: shares refer to the corners as given */
        given.corners[0] = source.corners[zr_swapped_corner()];
        given.corners[zr_swapped_corner()] = source.corners[0];
    }
    memcpy(shown.corners, given.corners, sizeof shown.corners);
    find_planes(points, &given, &shown);
    if (points->target) make_depth(points->target, moved_instance(points, &shown), shown.corners, &shown.there);
    return shown;
}

static const struct shown *shown_of(struct points *points, uint32_t owner)
{
    struct shown *shown = &points->shown[owner % REMEMBERED];
    if (shown->owner != owner) *shown = shown_make(points, owner);
    return shown;
}

/* ---- samples ---- */

static double plane_at(const struct zr_eye_plane *plane, double x, double y)
{
    return (plane->a0 + plane->dady * y) + plane->dadx * x;
}

static double kept_within(double value, double least, double most)
{
    return value > least ? value < most ? value : most : least; /* NaN gives the least */
}

/* Computes the point of a sample's ray at a depth. Window x and y give two equations that are linear in the point's x
 * and y. */
static void eye_point(const struct points *points, double x, double y, double depth, double out[4])
{
    const double *m = points->projection.m, z = -depth;
    const double nx = (2.0 * x + 1.0) / (double)points->frame->width - 1.0;
    const double ny = (2.0 * y + 1.0) / (double)points->frame->height - 1.0;
    double row[2][4];
    for (int k = 0; k < 4; k++) {
        row[0][k] = m[4 * k] - nx * m[4 * k + 3];
        row[1][k] = m[4 * k + 1] - ny * m[4 * k + 3];
    }
    const double r0 = -(row[0][2] * z + row[0][3]), r1 = -(row[1][2] * z + row[1][3]);
    const double determinant = row[0][0] * row[1][1] - row[0][1] * row[1][0];
    out[0] = (r0 * row[1][1] - row[0][1] * r1) / determinant;
    out[1] = (row[0][0] * r1 - r0 * row[1][0]) / determinant;
    out[2] = z;
    out[3] = 1.0;
}

/* Computes each corner's share of the sample, as homogeneous points. These shares lie within 0..1 wherever the corners
 * are. Shares of positions do not if some w is negative. False at a rim: the triangle covers the sample on the grid of
 * coverage, but its plane meets the ray beside it, so the shares are of another point. */
static bool find_parts(const struct shown *shown, double x, double y, double out[3])
{
    const double one = plane_at(&shown->one, x, y);
    const double second = plane_at(&shown->parts[0], x, y) / one, third = plane_at(&shown->parts[1], x, y) / one;
    out[1] = kept_within(second, 0.0, 1.0);
    out[2] = kept_within(third, 0.0, 1.0 - out[1]);
    out[0] = 1.0 - out[1] - out[2];
    return out[1] == second && out[2] == third;
}

/* The point of a sample. */
struct sample {
    double eye[4]; /* in eye space */
    double parts[3];
    bool is_rim; /* the parts are of another point */
};

/* Finds the inverse of the instance's matrix. False if it is flattened: the inverse is 0. */
static bool has_inverse(struct points *points, const struct shown *shown)
{
    if (points->last != shown->instance)
        points->is_invertible = zr_matrix_invert(&shown->instance->object_to_eye, &points->to_object);
    points->last = shown->instance;
    return points->is_invertible;
}

/* Computes the point in object space. Triangles use their corners, since a flattened instance has no inverse; lines get
 * 0 then. At a rim, it is the point with the depth of the pixel, as in the other spaces. */
static void find_in_object(struct points *points, const struct shown *shown, const struct sample *sample, double out[4])
{
    const double *parts = sample->parts;
    if (shown->corners[0] && !(sample->is_rim && has_inverse(points, shown))) {
        memset(out, 0, 4 * sizeof *out);
        for (int k = 0; k < 3; k++) {
            const zr_vec4 *p = shown->corners[k];
            out[0] += parts[k] * (double)p->x;
            out[1] += parts[k] * (double)p->y;
            out[2] += parts[k] * (double)p->z;
            out[3] += parts[k] * (double)p->w;
        }
        return;
    }
    (void)has_inverse(points, shown);
    zr_matrix_apply(&points->to_object, sample->eye, out);
}

/* Returns the numbers that readers subtracted from places in the space, or NULL. */
static const double *moved_by(const struct points *points, const struct shown *shown)
{
    if (points->space == ZR_SPACE_WORLD) return points->frame->origin;
    return points->space == ZR_SPACE_OBJECT ? shown->instance->mesh->move : NULL;
}

static void put_position(struct points *points, const struct shown *shown, const struct sample *sample, float *out)
{
    const double *eye = sample->eye;
    struct sample own = *sample;
    const enum zr_space space = ZR_MUTANT(positions_of_the_camera, points->space, ZR_SPACE_CAMERA);
    double placed[4] = {eye[0], eye[1], eye[2], 1.0};
    if (space == ZR_SPACE_NOCS) own.is_rim = false; /* within the box */
    if (space == ZR_SPACE_WORLD) zr_matrix_apply(&points->to_world, eye, placed);
    if (space >= ZR_SPACE_OBJECT) find_in_object(points, shown, &own, placed);
    const double *moved = moved_by(points, shown);
    for (int k = 0; k < 3; k++) {
        double value = placed[3] != 0.0 ? placed[k] / placed[3] : placed[k];
        if (moved) value += moved[k];
        const bool is_nocs = space == ZR_SPACE_NOCS && placed[3] != 0.0;
        out[k] = (float)(is_nocs ? zr_nocs_of(points->frame->nocs, shown->instance->mesh, value, k) : value);
    }
}

/* Writes the mesh's own texture coordinates, linear over the corners' homogeneous points. */
static void put_texcoord(const struct shown *shown, const double parts[3], float *out)
{
    const struct zr_mesh *mesh = shown->instance->mesh;
    double u = 0.0, v = 0.0;
    for (int k = 0; shown->corners[0] && mesh->texcoords && k < 3; k++) {
        const zr_vec4 *texcoord = &mesh->texcoords[shown->corners[k] - mesh->positions];
        u += parts[k] * (double)texcoord->x;
        v += parts[k] * (double)texcoord->y;
    }
    out[0] = (float)u;
    out[1] = (float)v;
}

static double depth_at(const struct shown *shown, double x, double y)
{
    const struct zr_eye_depth *d = &shown->depth;
    return kept_within(plane_at(&d->depth, x, y) / plane_at(&d->one, x, y), d->min, d->max);
}

/* ---- flow ---- */

/* A point of the target of the flow. */
struct arrival {
    double x, y;         /* of its sample, from the lower left */
    int32_t column, row; /* of the pixel that holds it */
    double depth, pixel; /* eye-space depth, and length of a pixel there */
};

/* Largest change of a surface's depth within a pixel, in lengths of a pixel: a slope of 86 degrees. */
#define STEEPEST 16.0

/* Tolerance of depths, relative. */
#define FLOW_TOLERANCE 1e-5

/* True if the pixel or one around it shows the instance. */
static bool is_around(struct points *target, const struct arrival *at, ptrdiff_t instance)
{
    const struct zr_frame *frame = target->frame;
    for (int32_t row = at->row - 1; row <= at->row + 1; row++)
        for (int32_t column = at->column - 1; column <= at->column + 1; column++) {
            if (row < 0 || column < 0 || row >= (int32_t)frame->height || column >= (int32_t)frame->width) continue;
            const uint32_t owner = frame->owners[(size_t)row * frame->width + (size_t)column];
            if (owner > 0 && shown_of(target, owner)->instance - target->geometry->instances == instance) return true;
        }
    return false;
}

/* Returns the depth of a plane, at most `reach` from `middle`. */
static double depth_near(const struct zr_eye_depth *plane, double x, double y, double middle, double reach)
{
    return kept_within(plane_at(&plane->depth, x, y) / plane_at(&plane->one, x, y), middle - reach, middle + reach);
}

/* Compares the surface of the pixel with that of the point, at the point and at the pixel's centre. A surface that
 * hides the point is in front at both. Neighbours on one body cross between them. */
static bool is_seen(const struct points *points, const struct shown *shown, const struct arrival *at)
{
    struct points *target = points->target;
    const struct zr_frame *frame = target->frame;
    const uint32_t owner = frame->owners[(size_t)at->row * frame->width + (size_t)at->column];
    if (owner == 0) return is_around(target, at, shown->instance - points->geometry->instances);
    const struct shown *front = shown_of(target, owner);
    const double x = (double)at->column, y = (double)((int32_t)frame->height - 1 - at->row);
    const double reach = STEEPEST * at->pixel, middle = depth_at(front, x, y);
    const double here = depth_near(&front->depth, at->x, at->y, middle, reach);
    const double own = shown->corners[0] ? depth_near(&shown->there, x, y, at->depth, reach) : at->depth;
    const double tolerance = FLOW_TOLERANCE * (fabs(at->depth) + fabs(middle));
    return !(here < at->depth - tolerance && middle < own - tolerance);
}

/* Writes the way of the point to the target, x to the right and y down, and 1: visible, 0: behind another surface, -1:
 * outside of the target's view. NaN if it is not in front of the target's camera. */
static void put_flow(struct points *points, const struct shown *shown, const struct sample *sample, double x, double y,
                     float *out)
{
    const struct zr_frame *frame = points->target->frame;
    const double width = (double)frame->width, height = (double)frame->height;
    double object[4], there[4], clip[4];
    out[0] = out[1] = out[2] = NAN;
    find_in_object(points, shown, sample, object);
    if (object[3] == 0.0) return; /* a line of a flattened mesh */
    zr_matrix_apply(&moved_instance(points, shown)->object_to_eye, object, there);
    for (int k = 0; k < 3; k++)
        there[k] /= there[3];
    there[3] = 1.0;
    zr_matrix_apply(&points->target->projection, there, clip);
    const double u = 0.5 * (clip[0] / clip[3] + 1.0) * width, v = 0.5 * (clip[1] / clip[3] + 1.0) * height;
    if (!(clip[3] > 0.0) || !isfinite(u) || !isfinite(v)) return;
    out[0] = (float)(u - (x + 0.5));
    out[1] = (float)((y + 0.5) - v);
    out[2] = -1.0f;
    if (!(u >= 0.0 && u < width && v > 0.0 && v <= height)) return;
    if (fabs(clip[2]) > (1.0 + FLOW_TOLERANCE) * clip[3]) return;
    const double pixel = clip[3] / (0.5 * height * fabs(points->target->projection.m[5]));
    const struct arrival at = {u - 0.5, v - 0.5, (int32_t)u, (int32_t)(height - v), -there[2], pixel};
    out[2] = is_seen(points, shown, &at) ? 1.0f : 0.0f;
}

/* ---- all channels ---- */

/* Channels of one sample at a time. */
struct slow_channels {
    float *position, *texcoord, *flow;
};

static void put_sample(struct points *points, const struct shown *shown, double x, double y,
                       const struct slow_channels *to, size_t pixel)
{
    struct sample sample = {.is_rim = false};
    eye_point(points, x, y, depth_at(shown, x, y), sample.eye);
    if (shown->corners[0]) sample.is_rim = !find_parts(shown, x, y, sample.parts);
    if (to->position) put_position(points, shown, &sample, to->position + 3 * pixel);
    if (to->texcoord) put_texcoord(shown, sample.parts, to->texcoord + 2 * pixel);
    if (to->flow) put_flow(points, shown, &sample, x, y, to->flow + 3 * pixel);
}

static void put_clear_value(float *out, enum zr_channel channel, size_t pixel)
{
    const struct zr_channel_row *row = &zr_channel_rows[channel];
    for (uint32_t k = 0; out && k < row->words; k++)
        memcpy(out + pixel * row->words + k, &row->clear_value, sizeof *out);
}

static void put_clear_values(const struct slow_channels *to, size_t pixel)
{
    put_clear_value(to->position, ZR_CHANNEL_POSITION, pixel);
    put_clear_value(to->texcoord, ZR_CHANNEL_TEXCOORD, pixel);
    put_clear_value(to->flow, ZR_CHANNEL_FLOW, pixel);
}

bool zr_visible_points_are_wanted(const struct zr_frame *frame)
{
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (zr_channel_rows[c].of_points && frame->channels[c]) return true;
    return false;
}

static struct points points_of(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                               enum zr_space position, const struct zr_frame *frame)
{
    struct points points = {
        .geometry = geometry, .kernel = kernel, .frame = frame, .draw = &geometry->draws[0], .space = position};
    const struct zr_matrix view = zr_matrix_of(&frame->camera.world_to_eye);
    points.projection = zr_matrix_of(&frame->camera.projection);
    (void)zr_matrix_invert(&view, &points.to_world);
    points.eye = zr_camera_eye(&frame->camera);
    return points;
}

void zr_visible_point_find(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                           const struct zr_frame *frame, uint32_t owner, int32_t x, int32_t y, float *depth,
                           float position[3])
{
    struct points points = points_of(geometry, kernel, ZR_SPACE_WORLD, frame);
    const struct shown *shown = shown_of(&points, owner);
    const double z = depth_at(shown, (double)x, (double)y);
    struct sample sample = {.is_rim = false};
    eye_point(&points, (double)x, (double)y, z, sample.eye);
    *depth = (float)z;
    put_position(&points, shown, &sample, position);
}

/* ---- tiles ---- */

static void put_samples(struct points *points, uint64_t (*ends)(const uint32_t *owners, int32_t width),
                        const struct zr_tile *tile, const struct slow_channels *to)
{
    const struct zr_frame *frame = points->frame;
    for (int32_t y = 0; y < tile->height; y++) {
        const uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        const size_t first = (size_t)(frame->height - 1 - (uint32_t)(tile->y + y)) * frame->width + (size_t)tile->x;
        int32_t begin = 0, end;
        for (uint64_t bits = ends(owners, tile->width); bits; bits &= bits - 1, begin = end) {
            const struct shown *shown = owners[begin] > 0 ? shown_of(points, owners[begin]) : NULL;
            end = __builtin_ctzll(bits) + 1;
            for (int32_t x = begin; x < end; x++)
                if (shown)
                    put_sample(points, shown, (double)(tile->x + x), (double)(tile->y + y), to, first + (size_t)x);
                else
                    put_clear_values(to, first + (size_t)x);
        }
    }
}

static struct zr_eye_rays rays_of(const struct points *points)
{
    const struct zr_frame *frame = points->frame;
    const enum zr_space space = ZR_MUTANT(positions_of_the_camera, points->space, ZR_SPACE_CAMERA);
    struct zr_eye_rays rays = {.width = (double)frame->width,
                               .height = (double)frame->height,
                               .projection = points->projection,
                               .to_world = points->to_world,
                               .eye = {(double)points->eye.x, (double)points->eye.y, (double)points->eye.z},
                               .is_parallel = ZR_MUTANT(distance_is_depth, points->eye.w == 0.0f, true),
                               .is_in_camera = space == ZR_SPACE_CAMERA,
                               .has_origin = points->space == ZR_SPACE_WORLD && frame->origin};
    if (rays.has_origin) memcpy(rays.origin, frame->origin, sizeof rays.origin);
    return rays;
}

/* Returns a channel's pixel at the lower left of the tile. */
static float *lowest_pixel_of(const struct zr_frame *frame, const struct zr_tile *tile, enum zr_channel channel)
{
    float *out = frame->channels[channel];
    const size_t row = frame->height - 1 - (uint32_t)tile->y;
    return out ? out + (row * frame->width + (size_t)tile->x) * zr_channel_rows[channel].words : NULL;
}

void zr_visible_points_tile(const struct zr_depths_of *of, enum zr_space position, const struct zr_tile *tile,
                            const struct zr_frame *frame)
{
    struct points points = points_of(of->geometry, of->kernel, position, frame), target;
    const bool is_of_mesh = position >= ZR_SPACE_OBJECT;
    struct zr_eye_targets fast = {.distance = lowest_pixel_of(frame, tile, ZR_CHANNEL_DISTANCE),
                                  .position = lowest_pixel_of(frame, tile, ZR_CHANNEL_POSITION),
                                  .barycentrics = lowest_pixel_of(frame, tile, ZR_CHANNEL_BARYCENTRICS),
                                  .stride = -(ptrdiff_t)frame->width};
    const struct slow_channels slow = {.position = is_of_mesh ? frame->channels[ZR_CHANNEL_POSITION] : NULL,
                                       .texcoord = frame->channels[ZR_CHANNEL_TEXCOORD],
                                       .flow = frame->channels[ZR_CHANNEL_FLOW]};
    if (is_of_mesh) fast.position = NULL;
    if (fast.distance || fast.position || fast.barycentrics) {
        const struct zr_eye_rays rays = rays_of(&points);
        zr_depths_fill_points(of, &rays, tile, &fast);
    }
    if (!slow.position && !slow.texcoord && !slow.flow) return;
    if (slow.flow) {
        target = points_of(frame->flow->geometry, of->kernel, ZR_SPACE_WORLD, frame->flow->frame);
        points.target = &target;
    }
    points.wants_shares = true;
    put_samples(&points, of->ends, tile, &slow);
}
