/* draco_transform.h - input: how corrections are added to predicted values of Draco meshes; private to the decoder. */
#ifndef ZR_DRACO_TRANSFORM_H
#define ZR_DRACO_TRANSFORM_H

#include "input/codecs/draco_mesh.h"

/* Values within low .. high: a sum beyond them wraps around. */
struct zr_draco_wrap {
    int32_t low, high;
    uint32_t width;
};
bool zr_draco_wrap_read(struct zr_draco_stream *stream, uint32_t width, struct zr_draco_wrap *out);

/* Adds the predicted values to the corrections, in place. */
static inline void zr_draco_wrap_add(const struct zr_draco_wrap *of, const int32_t *predicted, int32_t *values)
{
    const uint32_t span = (uint32_t)of->high - (uint32_t)of->low + 1;
    for (uint32_t k = 0; k < of->width; k++) {
        const int32_t p = predicted[k] > of->high ? of->high : predicted[k] < of->low ? of->low : predicted[k];
        const uint32_t sum = (uint32_t)p + (uint32_t)values[k];
        values[k] = (int32_t)((int32_t)sum > of->high ? sum - span : (int32_t)sum < of->low ? sum + span : sum);
    }
}

/* Unit vectors on an octahedron that is unfolded to the square 0 .. 2 * center (Cigolle and others, A survey of
 * efficient representations for independent unit vectors, 2014). */
struct zr_draco_octahedron {
    int32_t center;
    bool is_canonical; /* corrections are turned to one quadrant */
};

/* Sets the square of `bits` bits. False if there is none. */
bool zr_draco_octahedron_set(uint32_t bits, struct zr_draco_octahedron *out);

bool zr_draco_octahedron_read(struct zr_draco_stream *stream, bool is_canonical, struct zr_draco_octahedron *out);

/* Adds a predicted point of the square to a correction, in place. */
void zr_draco_octahedron_add(const struct zr_draco_octahedron *of, const int32_t predicted[2], int32_t values[2]);

/* Finds the point of the square for a direction, or for the opposite one. Magnitudes are at most 2^29. */
void zr_draco_octahedron_point(const struct zr_draco_octahedron *of, bool is_flipped, const int32_t direction[3],
                               int32_t out[2]);

/* Finds the unit vector of a point of the square, in float32 as the reference decoder does. */
void zr_draco_octahedron_vector(const struct zr_draco_octahedron *of, const int32_t point[2], float out[3]);

/* Positions as integers: value i of an order is at integers[3 * of_value[i]]. */
struct zr_draco_positions {
    const int32_t *integers;
    const uint32_t *of_value;
};

/* draco_texcoords.c, draco_normal.c: read what the prediction needs, and add predictions from positions to corrections,
 * in place. */
bool zr_draco_predict_texcoords(struct zr_draco *draco, struct zr_draco_values *of,
                                const struct zr_draco_positions *positions);
bool zr_draco_predict_normals(struct zr_draco *draco, struct zr_draco_values *of, bool is_canonical,
                              const struct zr_draco_positions *positions);

#endif
