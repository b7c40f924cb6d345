/* patch.h - mesh: facets on one cylinder, and what a facet covers of it. */
#ifndef ZR_PATCH_H
#define ZR_PATCH_H

#include "mesh/features/cylinder_fit.h"
#include "mesh/features/facets.h"

#define ZR_PATCH_SOFT        0.469 /* cosine of 62 degrees: between neighbours on a cylinder */
#define ZR_PATCH_RADIUS_MOST 10.0  /* of the size: beyond, a patch is flat */

struct zr_patch {
    struct zr_cylinder_frame frame;
    bool is_concave;
    uint32_t begin, end; /* of its facets */
    double low, high;    /* along the axis, from the frame's centre */
};

/* The part of a cylinder that a facet covers, in the frame of the cylinder. Its outermost corners across the axis are `first` and `last`,
 * counterclockwise seen along the facet's own normal. */
struct zr_facet_span {
    double first[2], last[2]; /* across the axis, from the centre */
    double first_radius, last_radius;
    double width;       /* across the axis */
    double least, most; /* distances of corners from the axis */
    double low, high;   /* along the axis, from the centre */
    double outwards;    /* cosine of the angle between its normal and the way from the centre to its middle */
};

/* Returns true if the facet faces away from the axis, or towards it. */
static inline bool zr_facet_span_faces(const struct zr_facet_span *span, bool is_concave)
{
    return (is_concave ? 0.0 - span->outwards : span->outwards) > 0.9;
}

/* Measures a facet. False if its normal is along the axis, a corner is farther from the axis than `radius_most`, or no
 * steps are left. */
bool zr_facet_span_of(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t facet,
                      const struct zr_cylinder_frame *frame, double radius_most, struct zr_facet_span *out);

/* Returns true if a distance from the axis is the radius. */
static inline bool zr_radius_fits(double distance, const struct zr_cylinder_frame *frame, double tolerance)
{
    return fabs(distance - frame->radius) <= tolerance;
}

/* Returns true if a facet lies on the cylinder of a patch. */
bool zr_patch_fits(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                   uint32_t facet);

/* Fits a frame to facets: its axis, centre and radius. `frame` is a first guess. False if there is no such cylinder. */
bool zr_patch_fit(struct zr_feature_work *work, const struct zr_facets *facets, const uint32_t *list, uint32_t count,
                  struct zr_cylinder_frame *frame);

#endif
