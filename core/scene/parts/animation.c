#include "scene/parts/animation.h"

#include <math.h>

#include "base/matrix.h"
#include "base/slerp.h"
#include "base/trig.h"

/* ---- keys ---- */

/* Place of a moment among keys: `share` of the way from `key` to the next one. */
struct place {
    uint32_t key;
    double share; /* 0: at the key, or beyond the first or last one */
};

static struct place find_place(const struct zr_track *track, double seconds)
{
    uint32_t low = 0, high = track->key_count; /* the last key at or before the moment is in low..high-1 */
    if (seconds <= track->times[0]) return (struct place){0, 0.0};
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (track->times[middle] <= seconds)
            low = middle;
        else
            high = middle;
    }
    if (high == track->key_count || track->has_steps) return (struct place){low, 0.0};
    const double start = track->times[low];
    return (struct place){low, (seconds - start) / (track->times[high] - start)};
}

static zr_vec3 vector_at(const float *keys, const struct place *place, zr_vec3 own)
{
    float v[3];
    if (!keys) return own;
    const float *from = keys + 3 * (size_t)place->key;
    for (int k = 0; k < 3; k++)
        v[k] = place->share > 0.0 ? (float)((1.0 - place->share) * (double)from[k] + place->share * (double)from[3 + k])
                                  : from[k];
    return (zr_vec3){v[0], v[1], v[2]};
}

static zr_vec4 rotation_at(const float *keys, const struct place *place, zr_vec4 own)
{
    float v[4];
    if (!keys) return own;
    const float *from = keys + 4 * (size_t)place->key;
    if (!(place->share > 0.0)) return (zr_vec4){from[0], from[1], from[2], from[3]};
    zr_slerp(from, from + 4, place->share, v);
    return (zr_vec4){v[0], v[1], v[2], v[3]};
}

static zr_mat4 keyed(const struct zr_track *track, double seconds, const struct zr_node_pose *own)
{
    const struct place place = find_place(track, seconds);
    return zr_mat4_of_pose(vector_at(track->translations, &place, own->translation),
                           rotation_at(track->rotations, &place, own->rotation),
                           vector_at(track->scales, &place, own->scale));
}

/* ---- turns ---- */

/* Source: Rodrigues' formula. */
static struct zr_matrix turn_of(zr_vec3 axis, double degrees)
{
    double x = (double)axis.x, y = (double)axis.y, z = (double)axis.z, s, c;
    const double length = sqrt(x * x + y * y + z * z);
    x /= length;
    y /= length;
    z /= length;
    zr_sine_cosine(degrees, &s, &c);
    const double d = 1.0 - c;
    return (struct zr_matrix){{d * x * x + c, d * x * y + s * z, d * x * z - s * y, 0.0, d * x * y - s * z,
                               d * y * y + c, d * y * z + s * x, 0.0, d * x * z + s * y, d * y * z - s * x,
                               d * z * z + c, 0.0, 0.0, 0.0, 0.0, 1.0}};
}

zr_mat4 zr_track_matrix(const struct zr_track *track, const struct zr_moment *moment, const struct zr_node_pose *own,
                        const zr_mat4 *local)
{
    zr_mat4 matrix = track->key_count > 0 ? keyed(track, moment->seconds, own) : *local;
    const double degrees = track->degrees * moment->share;
    if (degrees == 0.0) return matrix;
    const struct zr_matrix before = zr_matrix_of(&matrix), turn = turn_of(track->axis, degrees),
                           product = zr_matrix_mul(&before, &turn);
    for (int i = 0; i < 16; i++)
        matrix.m[i] = (float)product.m[i];
    return matrix;
}
