#include "input/model/parsed_material.h"

#include <math.h>

#include "base/isa.h"
#include "base/srgb.h"
#include "base/team.h"
#include "base/trig.h"

/* ---- textures ---- */

const char *const zr_texture_keys[ZR_TEXTURE_SLOTS] = {"baseColorTexture",
                                                       "metallicRoughnessTexture",
                                                       "normalTexture",
                                                       "occlusionTexture",
                                                       "emissiveTexture",
                                                       "clearcoatTexture",
                                                       "clearcoatRoughnessTexture",
                                                       "clearcoatNormalTexture",
                                                       "sheenColorTexture",
                                                       "iridescenceTexture",
                                                       "iridescenceThicknessTexture",
                                                       "transmissionTexture",
                                                       "thicknessTexture",
                                                       "anisotropyTexture"};

const uint32_t zr_filter_numbers[ZR_FILTER_COUNT] = {9728, 9729, 9984, 9985, 9986, 9987};
const uint32_t zr_wrap_numbers[ZR_WRAP_COUNT] = {10497, 33648, 33071};

static int find_number(const uint32_t *numbers, int count, uint32_t number)
{
    for (int i = 0; i < count; i++)
        if (numbers[i] == number) return i;
    return -1;
}

int zr_filter_of_number(uint32_t number)
{
    return find_number(zr_filter_numbers, ZR_FILTER_COUNT, number);
}

int zr_wrap_of_number(uint32_t number)
{
    return find_number(zr_wrap_numbers, ZR_WRAP_COUNT, number);
}

/* Products of coordinates and transforms stay finite up to this magnitude. Offsets beyond OFFSET_NEAR lose their whole
 * repeats, an even number of them. */
#define NUMBER_MAX  1e12
#define OFFSET_NEAR 1e4

static double offset_of(double offset, enum zr_wrap wrap)
{
    return wrap == ZR_WRAP_CLAMP || fabs(offset) <= OFFSET_NEAR ? offset : fmod(offset, 2.0);
}

static float clamp_number(double v)
{
    return (float)(v < -NUMBER_MAX ? -NUMBER_MAX : v > NUMBER_MAX ? NUMBER_MAX : v);
}

/* Scales, then rotates, then translates the coordinates. Source: KHR_texture_transform. */
void zr_parsed_put_transform(const struct zr_parsed_texture *given, struct zr_texture *texture)
{
    const double to_degrees = 57.295779513082321;
    double sine, cosine;
    zr_sine_cosine(given->rotation * to_degrees, &sine, &cosine);
    const double x = (double)given->scale[0], y = (double)given->scale[1];
    const double rows[2][3] = {{cosine * x, sine * y, offset_of((double)given->offset[0], texture->wrap_s)},
                               {-sine * x, cosine * y, offset_of((double)given->offset[1], texture->wrap_t)}};
    for (int row = 0; row < 2; row++)
        for (int k = 0; k < 3; k++)
            texture->rows[row][k] = clamp_number(rows[row][k]);
}

/* ---- colours of light ---- */

/* Components of a text are bytes. */
enum { LAST = 255, RAMP_ROOM = 16 };

static float linear_part(const float *ramp, float part)
{
    return part < 0.0f ? ramp[lrintf(-part * (float)LAST)] : part;
}

zr_vec3 zr_light_color(zr_vec3 given, bool is_linear)
{
    float ramp[LAST + RAMP_ROOM];
    if (!is_linear || !(given.x < 0.0f || given.y < 0.0f || given.z < 0.0f))
        return (zr_vec3){fabsf(given.x), fabsf(given.y), fabsf(given.z)};
    zr_srgb_ramp_of(zr_team_isa(NULL))(LAST, ramp);
    return (zr_vec3){linear_part(ramp, given.x), linear_part(ramp, given.y), linear_part(ramp, given.z)};
}
