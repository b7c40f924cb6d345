#include "scene/parts/animation.h"

#include <math.h>

#include "scene/parts/slerp.h"
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

/* Interpolates `size` numbers. NULL keys: the node's own. */
static void values_at(const double *keys, int size, const struct place *place, bool is_exact, double *own)
{
    double from[4], to[4];
    for (int k = 0; k < size && keys; k++) {
        const double *at = keys + (size_t)size * place->key + k, *next = place->share > 0.0 ? at + size : at;
        from[k] = is_exact ? *at : zr_rounded(*at);
        to[k] = is_exact ? *next : zr_rounded(*next);
        own[k] = place->share > 0.0 ? (1.0 - place->share) * from[k] + place->share * to[k] : from[k];
    }
    if (size == 4 && keys && place->share > 0.0) zr_slerp_exact(from, to, place->share, own);
    for (int k = 0; k < size && !is_exact; k++)
        own[k] = zr_rounded(own[k]);
}

static struct zr_matrix keyed(const struct zr_track *track, double seconds, const struct zr_node_pose *own)
{
    const struct place place = find_place(track, seconds);
    struct zr_node_pose pose = *own;
    values_at(track->translations, 3, &place, own->is_exact, pose.translation);
    values_at(track->rotations, 4, &place, own->is_exact, pose.rotation);
    values_at(track->scales, 3, &place, own->is_exact, pose.scale);
    struct zr_matrix matrix = zr_matrix_of_pose(pose.translation, pose.rotation, pose.scale);
    for (int i = 0; i < 16 && !own->is_exact; i++)
        matrix.m[i] = zr_rounded(matrix.m[i]);
    return matrix;
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

struct zr_matrix zr_track_matrix(const struct zr_track *track, const struct zr_moment *moment,
                                 const struct zr_node_pose *own, const struct zr_matrix *local)
{
    const struct zr_matrix matrix = track->key_count > 0 ? keyed(track, moment->seconds, own) : *local;
    const double degrees = track->degrees * moment->share;
    if (degrees == 0.0) return matrix;
    const struct zr_matrix turn = turn_of(track->axis, degrees);
    return zr_matrix_mul(&matrix, &turn);
}
