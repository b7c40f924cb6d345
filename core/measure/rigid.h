/* rigid.h - measure: rigid motions in double precision, and the moments from which they are guessed. */
#ifndef ZR_RIGID_H
#define ZR_RIGID_H

#include "mesh/world_place.h"

/* A place p moves to turn p + shift. */
struct zr_rigid {
    double turn[3][3]; /* rows; a rotation, or a reflection, perhaps scaled */
    double shift[3];
};

/* Centre and second moments around it, divided by the weight. */
struct zr_moments {
    struct zr_world_place center;
    double second[3][3];
};

struct zr_cancel;
struct zr_solid;

/* Returns the moments of the volume of a closed solid, else of the surface. If cancelled, returns any early. */
struct zr_moments zr_moments_of(const struct zr_solid *solid, const struct zr_cancel *cancel);

/* Finds the eigenvalues of a symmetric matrix, ascending, and unit eigenvectors, the columns of a rotation. By
 * rotations of Jacobi. */
void zr_eigen_find(const double matrix[3][3], double values[3], double vectors[3][3]);

struct zr_world_place zr_rigid_apply(const struct zr_rigid *motion, struct zr_world_place p);

/* Returns the motion that does `first`, then `then`. */
struct zr_rigid zr_rigid_after(const struct zr_rigid *first, const struct zr_rigid *then);

/* Returns the motion that turns around `center` by a rotation near the vector `turn`, its tangent form, and shifts. */
struct zr_rigid zr_rigid_of_step(struct zr_world_place center, const double turn[3], const double shift[3]);

/* Returns the scaling around `center`. */
struct zr_rigid zr_rigid_scaling(struct zr_world_place center, double scale);

/* Returns the factor by which lengths change: exactly 1 if it is 1 to 1e-12. */
double zr_rigid_scale(const struct zr_rigid *motion);

static inline struct zr_rigid zr_rigid_none(void)
{
    return (struct zr_rigid){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
}

#endif
