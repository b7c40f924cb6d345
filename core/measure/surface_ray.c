#include "measure/surface_ray.h"

#include <math.h>

enum { DEPTH = 64 };

struct ray {
    struct zr_world_place from, direction;
    double origin[3], along[3];
    double least, nearest; /* distances */
    double pad;            /* more than rounding errors of places */
};

/* Narrows the range of distances to a box. */
static bool meets(const struct ray *ray, const struct zr_surface_box *box)
{
    double low = ray->least, high = ray->nearest;
    for (int k = 0; k < 3; k++) {
        const double min = (double)box->min[k] - ray->pad - ray->origin[k],
                     max = (double)box->max[k] + ray->pad - ray->origin[k];
        if (ray->along[k] == 0.0) {
            if (min > 0.0 || max < 0.0) return false;
            continue;
        }
        const double a = min / ray->along[k], b = max / ray->along[k];
        low = zr_most_of(low, zr_least_of(a, b));
        high = zr_least_of(high, zr_most_of(a, b));
    }
    return low <= high;
}

/* Looks at a triangle whose front the ray leaves through. Borders count, so that no ray slips between neighbours. */
static void look(struct ray *ray, const struct zr_world_place t[3])
{
    const struct zr_world_place n =
        zr_world_place_cross(zr_world_place_minus(t[1], t[0]), zr_world_place_minus(t[2], t[0]));
    const double rate = zr_world_place_dot(n, ray->direction);
    if (!(rate > 0.0)) return;
    const double distance = zr_world_place_dot(n, zr_world_place_minus(t[0], ray->from)) / rate;
    if (!(distance > ray->least && distance < ray->nearest)) return;
    const struct zr_world_place at = {ray->from.x + ray->direction.x * distance,
                                      ray->from.y + ray->direction.y * distance,
                                      ray->from.z + ray->direction.z * distance};
    const double scale = sqrt(zr_world_place_dot(n, n));
    for (int k = 0; k < 3; k++) {
        const struct zr_world_place side = zr_world_place_minus(t[(k + 1) % 3], t[k]);
        const double way = zr_world_place_dot(n, zr_world_place_cross(side, zr_world_place_minus(at, t[k])));
        if (way < -ray->pad * scale * sqrt(zr_world_place_dot(side, side))) return;
    }
    ray->nearest = distance;
}

double zr_surface_ray_exit(const struct zr_surface_tree *tree, uint32_t part, struct zr_world_place from,
                           struct zr_world_place direction, double least, uint64_t *steps)
{
    struct ray ray = {from,  direction, {from.x, from.y, from.z},    {direction.x, direction.y, direction.z},
                      least, HUGE_VAL,  1e-9 * tree->solid->diagonal};
    uint32_t stack[DEPTH] = {1};
    for (int depth = tree->leaf_count > 0 ? 1 : 0; depth > 0; ++*steps) {
        const uint32_t node = stack[--depth];
        if (!meets(&ray, &tree->boxes[node])) continue;
        if (node >= tree->leaf_count) {
            const uint32_t begin = tree->begins[node - tree->leaf_count];
            for (uint32_t i = begin; i < tree->solid->count && i < begin + ZR_SURFACE_LEAF; i++, ++*steps) {
                const struct zr_surface_face *face = &tree->faces[i];
                if (tree->solid->parts[face->triangle] == part) look(&ray, face->at);
            }
            continue;
        }
        /* the nearer child first: that on the side of the ray's start, along its longest axis */
        const int axis = fabs(ray.along[0]) >= fabs(ray.along[1])   ? fabs(ray.along[0]) >= fabs(ray.along[2]) ? 0 : 2
                         : fabs(ray.along[1]) >= fabs(ray.along[2]) ? 1
                                                                    : 2;
        const struct zr_surface_box *a = &tree->boxes[2 * node], *b = &tree->boxes[2 * node + 1];
        const bool is_a_first = ((double)a->min[axis] + (double)a->max[axis] <=
                                 (double)b->min[axis] + (double)b->max[axis]) == (ray.along[axis] > 0.0);
        stack[depth++] = is_a_first ? 2 * node + 1 : 2 * node;
        stack[depth++] = is_a_first ? 2 * node : 2 * node + 1;
    }
    return ray.nearest < HUGE_VAL ? ray.nearest : 0.0;
}
