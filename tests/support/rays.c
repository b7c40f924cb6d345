#include "support/rays.h"

#include <stdlib.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void make_unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

/* ---- shapes ---- */

void rays_add_triangle(struct rays_scene *scene, const double a[3], const double b[3], const double c[3])
{
    if (scene->triangle_count == RAYS_TRIANGLES_MAX) abort();
    struct rays_triangle *out = &scene->triangles[scene->triangle_count++];
    for (int k = 0; k < 3; k++) {
        out->corner[k] = a[k];
        out->sides[0][k] = b[k] - a[k];
        out->sides[1][k] = c[k] - a[k];
    }
}

void rays_add_quad(struct rays_scene *scene, const double corner[3], const double u[3], const double v[3])
{
    double at[3][3];
    for (int k = 0; k < 3; k++) {
        at[0][k] = corner[k] + u[k];
        at[1][k] = corner[k] + u[k] + v[k];
        at[2][k] = corner[k] + v[k];
    }
    rays_add_triangle(scene, corner, at[0], at[1]);
    rays_add_triangle(scene, corner, at[1], at[2]);
}

void rays_add_box(struct rays_scene *scene, const double low[3], const double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double u[3] = {0}, v[3] = {0}, other[3] = {low[0], low[1], low[2]};
        u[i] = high[i] - low[i];
        v[j] = high[j] - low[j];
        other[axis] = high[axis];
        rays_add_quad(scene, low, u, v);
        rays_add_quad(scene, other, u, v);
    }
}

void rays_add_sphere(struct rays_scene *scene, const double middle[3], double radius)
{
    if (scene->sphere_count == RAYS_SPHERES_MAX) abort();
    struct rays_sphere *out = &scene->spheres[scene->sphere_count++];
    memcpy(out->middle, middle, sizeof out->middle);
    out->radius = radius;
}

/* Tests the ball around the corner that contains the triangle. */
static bool may_come_near(const struct rays_triangle *t, const double point[3], double distance)
{
    const double v[3] = {point[0] - t->corner[0], point[1] - t->corner[1], point[2] - t->corner[2]};
    const double sides[2] = {sqrt(dot(t->sides[0], t->sides[0])), sqrt(dot(t->sides[1], t->sides[1]))};
    double normal[3];
    cross(t->sides[0], t->sides[1], normal);
    return sqrt(dot(v, v)) <= distance + fmax(sides[0], sides[1]) &&
           fabs(dot(v, normal)) <= distance * sqrt(dot(normal, normal));
}

void rays_pick(const struct rays_scene *scene, const double point[3], double distance, struct rays_scene *out)
{
    out->triangle_count = out->sphere_count = 0;
    for (int i = 0; i < scene->triangle_count; i++)
        if (may_come_near(&scene->triangles[i], point, distance))
            out->triangles[out->triangle_count++] = scene->triangles[i];
    for (int i = 0; i < scene->sphere_count; i++)
        out->spheres[out->sphere_count++] = scene->spheres[i];
}

/* ---- rays ---- */

/* Moller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. */
static double meet_triangle(const struct rays_triangle *t, const struct ray *ray)
{
    const double v[3] = {ray->from[0] - t->corner[0], ray->from[1] - t->corner[1], ray->from[2] - t->corner[2]};
    double p[3], q[3];
    cross(ray->along, t->sides[1], p);
    const double determinant = dot(t->sides[0], p);
    if (determinant == 0.0) return HUGE_VAL;
    const double a = dot(v, p) / determinant;
    if (a < 0.0 || a > 1.0) return HUGE_VAL;
    cross(v, t->sides[0], q);
    const double b = dot(ray->along, q) / determinant, distance = dot(t->sides[1], q) / determinant;
    return b < 0.0 || a + b > 1.0 || distance < ray->nearest || distance > ray->farthest ? HUGE_VAL : distance;
}

static double meet_sphere(const struct rays_sphere *s, const struct ray *ray)
{
    const double v[3] = {ray->from[0] - s->middle[0], ray->from[1] - s->middle[1], ray->from[2] - s->middle[2]};
    const double b = dot(v, ray->along), square = b * b - dot(v, v) + s->radius * s->radius;
    if (square < 0.0) return HUGE_VAL;
    for (int sign = -1; sign <= 1; sign += 2) {
        const double distance = -b + sign * sqrt(square);
        if (distance >= ray->nearest && distance <= ray->farthest) return distance;
    }
    return HUGE_VAL;
}

double rays_first(const struct rays_scene *scene, const struct ray *ray, double normal[3])
{
    double first = HUGE_VAL;
    for (int i = 0; i < scene->triangle_count; i++) {
        const double distance = meet_triangle(&scene->triangles[i], ray);
        if (distance >= first) continue;
        first = distance;
        cross(scene->triangles[i].sides[0], scene->triangles[i].sides[1], normal);
    }
    for (int i = 0; i < scene->sphere_count; i++) {
        const double distance = meet_sphere(&scene->spheres[i], ray);
        if (distance >= first) continue;
        first = distance;
        for (int k = 0; k < 3; k++)
            normal[k] = ray->from[k] + first * ray->along[k] - scene->spheres[i].middle[k];
    }
    if (first == HUGE_VAL) return first;
    make_unit(normal);
    for (int k = 0, behind = dot(normal, ray->along) > 0.0; behind && k < 3; k++)
        normal[k] = -normal[k];
    return first;
}

bool rays_hit(const struct rays_scene *scene, const struct ray *ray)
{
    for (int i = 0; i < scene->triangle_count; i++)
        if (meet_triangle(&scene->triangles[i], ray) < HUGE_VAL) return true;
    for (int i = 0; i < scene->sphere_count; i++)
        if (meet_sphere(&scene->spheres[i], ray) < HUGE_VAL) return true;
    return false;
}

double rays_open(const struct rays_scene *scene, const double point[3], const double normal[3], double radius, int side)
{
    const double helper[3] = {fabs(normal[0]) < 0.9, fabs(normal[0]) >= 0.9, 0}, pi = acos(-1.0);
    static struct rays_scene near;
    double across[3], up[3];
    int open = 0;
    cross(helper, normal, across);
    make_unit(across);
    cross(normal, across, up);
    rays_pick(scene, point, radius, &near);
    for (int i = 0; i < side * side; i++) {
        const double square = (i / side + 0.5) / side, angle = 2.0 * pi * (i % side + 0.5 * (i / side % 2)) / side;
        const double a = sqrt(square) * cos(angle), b = sqrt(square) * sin(angle), c = sqrt(1.0 - square);
        struct ray ray = {.nearest = 1e-6 * radius, .farthest = radius};
        for (int k = 0; k < 3; k++) {
            ray.from[k] = point[k] + 1e-6 * radius * normal[k];
            ray.along[k] = across[k] * a + up[k] * b + normal[k] * c;
        }
        open += !rays_hit(&near, &ray);
    }
    return (double)open / (side * side);
}
