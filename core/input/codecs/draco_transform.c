/* Adds corrections to predicted values of Draco meshes: wrapped around a range, or on the unfolded octahedron. */
#include "input/codecs/draco_mesh.h"

#include <math.h>

bool zr_draco_wrap_read(struct zr_draco_stream *stream, uint32_t width, struct zr_draco_wrap *out)
{
    const int32_t low = (int32_t)zr_draco_u32(stream), high = (int32_t)zr_draco_u32(stream);
    *out = (struct zr_draco_wrap){low, high, width};
    return !stream->is_broken && low <= high && (int64_t)high - low < INT32_MAX;
}

/* ---- the octahedron ---- */

enum { BITS_LEAST = 2, BITS_MOST = 30 };

bool zr_draco_octahedron_set(uint32_t bits, struct zr_draco_octahedron *out)
{
    if (bits < BITS_LEAST || bits > BITS_MOST) return false;
    out->center = (1 << (bits - 1)) - 1;
    return true;
}

bool zr_draco_octahedron_read(struct zr_draco_stream *stream, bool is_canonical, struct zr_draco_octahedron *out)
{
    const uint32_t most = zr_draco_u32(stream);
    uint32_t bits = 0;
    if (is_canonical) zr_draco_u32(stream); /* the center, which follows from `most` */
    *out = (struct zr_draco_octahedron){.is_canonical = is_canonical};
    while (bits < 32 && most >> bits > 0)
        bits++;
    return !stream->is_broken && most % 2 == 1 && zr_draco_octahedron_set(bits, out);
}

/* Sums of numbers that a broken stream may let overflow. */
static int32_t sum(int32_t a, int32_t b)
{
    return (int32_t)((uint32_t)a + (uint32_t)b);
}

static int32_t difference(int32_t a, int32_t b)
{
    return (int32_t)((uint32_t)a - (uint32_t)b);
}

static uint32_t magnitude(int32_t a)
{
    return a < 0 ? 0u - (uint32_t)a : (uint32_t)a;
}

/* Mirrors a point about the edge of the inner square of its quadrant. The origin is the center. */
static void mirror(int32_t center, int32_t p[2])
{
    const bool both_up = p[0] >= 0 && p[1] >= 0, both_down = p[0] <= 0 && p[1] <= 0;
    const int32_t sign_0 = both_up     ? 1
                           : both_down ? -1
                           : p[0] > 0  ? 1
                                       : -1,
                  sign_1 = both_up     ? 1
                           : both_down ? -1
                           : p[1] > 0  ? 1
                                       : -1;
    const uint32_t corner_0 = (uint32_t)(sign_0 * center), corner_1 = (uint32_t)(sign_1 * center);
    const uint32_t a = 2 * (uint32_t)p[0] - corner_0, b = 2 * (uint32_t)p[1] - corner_1;
    const bool is_same = sign_0 == sign_1;
    p[0] = (int32_t)((is_same ? 0u - b : b) + corner_0) / 2;
    p[1] = (int32_t)((is_same ? 0u - a : a) + corner_1) / 2;
}

static int32_t wrap(int32_t center, int32_t value)
{
    if (value > center) return difference(value, 2 * center + 1);
    return value < -center ? sum(value, 2 * center + 1) : value;
}

/* Returns the quarter turns that bring a point to the lower left quadrant. */
static int count_turns(const int32_t p[2])
{
    if (p[0] == 0) return p[1] == 0 ? 0 : p[1] > 0 ? 3 : 1;
    if (p[0] > 0) return p[1] >= 0 ? 2 : 1;
    return p[1] <= 0 ? 0 : 3;
}

static void turn(int turns, int32_t p[2])
{
    const int32_t x = p[0], y = p[1];
    if (turns == 0) return;
    p[0] = turns == 1 ? y : difference(0, turns == 2 ? x : y);
    p[1] = turns == 3 ? x : difference(0, turns == 1 ? x : y);
}

void zr_draco_octahedron_add(const struct zr_draco_octahedron *of, const int32_t predicted[2], int32_t values[2])
{
    const int32_t center = of->center;
    int32_t p[2] = {difference(predicted[0], center), difference(predicted[1], center)};
    const bool is_outside = magnitude(p[0]) + magnitude(p[1]) > (uint32_t)center;
    if (is_outside) mirror(center, p);
    const int turns = of->is_canonical ? count_turns(p) : 0;
    turn(turns, p);
    for (int k = 0; k < 2; k++)
        values[k] = wrap(center, sum(p[k], values[k]));
    turn((4 - turns) % 4, values);
    if (is_outside) mirror(center, values);
    for (int k = 0; k < 2; k++)
        values[k] = sum(values[k], center);
}

/* Replaces a point of the outer edges by the one that stands for the same direction. */
static void make_canonical(int32_t center, int32_t p[2])
{
    const int32_t most = 2 * center, s = p[0], t = p[1];
    if ((s == 0 || s == most) && (t == 0 || t == most))
        p[0] = p[1] = most;
    else if ((s == 0 && t > center) || (s == most && t < center))
        p[1] = most - t;
    else if ((t == most && s < center) || (t == 0 && s > center))
        p[0] = most - s;
}

void zr_draco_octahedron_point(const struct zr_draco_octahedron *of, bool is_flipped, const int32_t direction[3],
                               int32_t out[2])
{
    const int32_t center = of->center, most = 2 * center;
    const int64_t length = (int64_t)magnitude(direction[0]) + magnitude(direction[1]) + magnitude(direction[2]);
    int32_t v[3] = {center, 0, 0};
    if (length > 0) {
        v[0] = (int32_t)(direction[0] * (int64_t)center / length);
        v[1] = (int32_t)(direction[1] * (int64_t)center / length);
        v[2] = center - (int32_t)magnitude(v[0]) - (int32_t)magnitude(v[1]);
        if (direction[2] < 0) v[2] = -v[2];
    }
    for (int k = 0; is_flipped && k < 3; k++)
        v[k] = -v[k];
    if (v[0] >= 0) {
        out[0] = v[1] + center;
        out[1] = v[2] + center;
    } else {
        out[0] = v[1] < 0 ? (int32_t)magnitude(v[2]) : most - (int32_t)magnitude(v[2]);
        out[1] = v[2] < 0 ? (int32_t)magnitude(v[1]) : most - (int32_t)magnitude(v[1]);
    }
    make_canonical(center, out);
}

void zr_draco_octahedron_vector(const struct zr_draco_octahedron *of, const int32_t point[2], float out[3])
{
    const float scale = 2.0f / (float)(2 * of->center);
    float y = (float)point[0] * scale - 1.0f, z = (float)point[1] * scale - 1.0f;
    const float x = 1.0f - fabsf(y) - fabsf(z), over = x < 0.0f ? -x : 0.0f;
    y += y < 0.0f ? over : -over;
    z += z < 0.0f ? over : -over;
    const float square = x * x + y * y + z * z;
    out[0] = out[1] = out[2] = 0.0f;
    if (!((double)square >= 1e-6)) return;
    const float factor = 1.0f / sqrtf(square);
    out[0] = x * factor;
    out[1] = y * factor;
    out[2] = z * factor;
}
