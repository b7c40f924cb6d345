/* rays.h - support: rays against triangles and spheres, in doubles: a judge of light and shadow. */
#ifndef ZR_TESTS_RAYS_H
#define ZR_TESTS_RAYS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

enum { RAYS_TRIANGLES_MAX = 4096, RAYS_SPHERES_MAX = 16 };

struct ray {
    double from[3], along[3]; /* along: a unit vector */
    double nearest, farthest; /* hits at other distances do not count */
};

struct rays_triangle {
    double corner[3], sides[2][3]; /* from the corner to the two others */
};

struct rays_sphere {
    double middle[3], radius;
};

struct rays_scene {
    struct rays_triangle triangles[RAYS_TRIANGLES_MAX];
    struct rays_sphere spheres[RAYS_SPHERES_MAX];
    int triangle_count, sphere_count;
};

void rays_add_triangle(struct rays_scene *scene, const double a[3], const double b[3], const double c[3]);

/* Adds two triangles: from `corner` along both sides. */
void rays_add_quad(struct rays_scene *scene, const double corner[3], const double u[3], const double v[3]);

void rays_add_box(struct rays_scene *scene, const double low[3], const double high[3]);

void rays_add_sphere(struct rays_scene *scene, const double middle[3], double radius);

/* Copies what comes within `distance` of a point. */
void rays_pick(const struct rays_scene *scene, const double point[3], double distance, struct rays_scene *out);

/* Returns the distance of the first hit, or HUGE_VAL, and sets its unit normal, which faces the ray. */
double rays_first(const struct rays_scene *scene, const struct ray *ray, double normal[3]);

bool rays_hit(const struct rays_scene *scene, const struct ray *ray);

/* Returns the share of light, weighted by its cosine, that reaches a point past everything within `radius`. side x side
 * rays of equal weight, each in the middle of its cell. */
double rays_open(const struct rays_scene *scene, const double point[3], const double normal[3], double radius,
                 int side);

#endif
