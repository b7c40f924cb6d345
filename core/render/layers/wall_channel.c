#include "render/layers/wall_channel.h"

#include <math.h>

#include "base/cancel.h"
#include "base/matrix.h"
#include "base/team.h"
#include "measure/surface_ray.h"
#include "scene/camera/rays.h"

enum { PIXELS_PER_CANCEL_CHECK = 64 };

/* Shares of the diagonal: a visible point lies on a triangle that is as near, and faces nearer than that are the one
 * that the ray begins at. */
static const double near_share = 1e-4, least_share = 1e-7;

struct drawing {
    const struct zr_run *run;
    const struct zr_surface_tree *tree;
    const struct zr_frame *frame;
    float *out;
    struct zr_rays rays;
    struct zr_matrix to_world;
};

static double at_window(float start, float by_x, float by_y, double x, double y)
{
    return ((double)start + x * (double)by_x) + y * (double)by_y;
}

/* Returns the point of a ray at a depth along the view axis, relative to the solid's middle. */
static struct zr_world_place point_of(const struct drawing *d, double x, double y, double depth)
{
    const struct zr_rays *r = &d->rays;
    const double origin[3] = {at_window(r->origin.x, r->origin_x.x, r->origin_y.x, x, y),
                              at_window(r->origin.y, r->origin_x.y, r->origin_y.y, x, y),
                              at_window(r->origin.z, r->origin_x.z, r->origin_y.z, x, y)};
    const double way[3] = {at_window(r->direction.x, r->direction_x.x, r->direction_y.x, x, y),
                           at_window(r->direction.y, r->direction_x.y, r->direction_y.y, x, y),
                           at_window(r->direction.z, r->direction_x.z, r->direction_y.z, x, y)};
    const double t = (-depth - origin[2]) / way[2];
    const double in_eye[4] = {origin[0] + way[0] * t, origin[1] + way[1] * t, -depth, 1.0};
    double at[4];
    zr_matrix_apply(&d->to_world, in_eye, at);
    const struct zr_world_place place = {at[0] / at[3], at[1] / at[3], at[2] / at[3]};
    return zr_world_place_minus(place, d->tree->solid->middle);
}

static float wall_at(const struct drawing *d, struct zr_world_place at, struct zr_surface_hit *hit, uint64_t *steps)
{
    const struct zr_solid *solid = d->tree->solid;
    const double near = near_share * solid->diagonal;
    zr_surface_tree_nearest(d->tree, at, -1.0, hit, steps);
    if (!(hit->square <= near * near)) return 0.0f;
    const struct zr_world_place n = zr_surface_normal(solid, hit->triangle), inwards = {-n.x, -n.y, -n.z};
    if (n.x == 0.0 && n.y == 0.0 && n.z == 0.0) return 0.0f;
    return (float)zr_surface_ray_exit(d->tree, solid->parts[hit->triangle], hit->at, inwards,
                                      least_share * solid->diagonal, steps);
}

static void draw_rows(void *context, size_t begin, size_t end)
{
    const struct drawing *d = context;
    const struct zr_frame *frame = d->frame;
    const uint64_t most = (uint64_t)ZR_WALL_STEPS_OF_PIXEL * frame->width;
    for (size_t y = begin; y < end; y++) {
        float *out = d->out + y * frame->width;
        const float *depth = frame->depth + y * frame->width;
        struct zr_surface_hit hit = {.triangle = 0};
        uint64_t steps = 0;
        for (uint32_t x = 0; x < frame->width; x++) {
            if (x % PIXELS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(d->run->cancel)) return;
            out[x] = 0.0f;
            if (!(depth[x] < INFINITY) || steps > most) continue;
            const double row = (double)(frame->height - 1 - y) + 0.5;
            out[x] = wall_at(d, point_of(d, (double)x + 0.5, row, (double)depth[x]), &hit, &steps);
        }
    }
}

enum zr_status zr_wall_channel_draw(const struct zr_run *run, const struct zr_scene *scene,
                                    const struct zr_frame *frame, float *out)
{
    const struct zr_matrix to_eye = zr_matrix_of(&frame->camera.world_to_eye);
    struct drawing d = {.run = run, .frame = frame, .out = out};
    struct zr_scene in_world = *scene; /* whose places are not those of the file */
    struct zr_solid solid;
    struct zr_surface_tree tree;
    in_world.file.up = NULL;
    in_world.origin = NULL;
    enum zr_status status = zr_solid_make(run, &in_world, NULL, &solid);
    if (status == ZR_OK) status = zr_surface_tree_make(run, &solid, &tree);
    if (status != ZR_OK) return status;
    d.tree = &tree;
    const bool is_drawn = solid.count > 0 && solid.diagonal > 0.0 && zr_matrix_invert(&to_eye, &d.to_world) &&
                          zr_rays_of(&frame->camera, frame->width, frame->height, &d.rays);
    if (!is_drawn) {
        const size_t bytes = (size_t)frame->width * frame->height * sizeof(float);
        return zr_arena_clear(run->arena, out, bytes) ? ZR_OK : ZR_CANCELLED;
    }
    zr_team_ranges(run->team, frame->height, 4, draw_rows, &d);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
