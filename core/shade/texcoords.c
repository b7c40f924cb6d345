#include "shade/texcoords.h"

#include <math.h>

/* Floats resolve texels of the largest image up to NEAR. Products of transforms stay finite up to MOST. */
#define NEAR_MAX 1e4
#define MOST     1e12

static bool is_near(const zr_vec4 *v)
{
    return (double)fabsf(v->x) <= NEAR_MAX && (double)fabsf(v->y) <= NEAR_MAX && (double)fabsf(v->z) <= NEAR_MAX &&
           (double)fabsf(v->w) <= NEAR_MAX;
}

bool zr_texcoords_are_far(const struct zr_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->position_count; i++)
        if (!is_near(&mesh->texcoords[i])) return true;
    return false;
}

/* True if whole repeats of coordinate `axis` are whole repeats in the image, too. */
static bool keeps_repeats(const struct zr_texture *texture, int axis)
{
    const float u = texture->rows[0][axis], v = texture->rows[1][axis];
    return u == floorf(u) && v == floorf(v) && (u == 0.0f || texture->wrap_s != ZR_WRAP_CLAMP) &&
           (v == 0.0f || texture->wrap_t != ZR_WRAP_CLAMP);
}

unsigned zr_texcoords_repeat(const struct zr_scene *scene, const struct zr_material *material)
{
    unsigned repeat = 15;
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++) {
        if (material->textures[slot] == 0) continue;
        const struct zr_texture *texture = &scene->textures[material->textures[slot] - 1];
        for (int axis = 0; axis < 2; axis++)
            if (!keeps_repeats(texture, axis)) repeat &= ~(1u << (2 * texture->texcoord + (uint32_t)axis));
    }
    return repeat;
}

/* ---- far coordinates ---- */

/* Coordinate k of a vertex. */
static double coordinate(const zr_vec4 *given, const struct zr_texture *texture, int k)
{
    const float *v = &given->x;
    if (!texture) return (double)v[k];
    const float *uv = v + 2 * texture->texcoord, *row = texture->rows[k];
    return (double)row[0] * (double)uv[0] + (double)row[1] * (double)uv[1] + (double)row[2];
}

/* Returns the middle of coordinate k as a number of repeats: an even one, which mirrored images need. */
static double middle_of(const struct zr_mesh *mesh, const struct zr_texture *texture, int k)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const double at = coordinate(&mesh->texcoords[i], texture, k);
        low = at < low ? at : low;
        high = at > high ? at : high;
    }
    return 2.0 * floor((low + high) / 4.0);
}

static void put_far(const struct zr_mesh *mesh, const struct zr_texture *texture, int k, bool repeats, zr_vec4 *out)
{
    const double whole = repeats ? middle_of(mesh, texture, k) : 0.0;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const double at = coordinate(&mesh->texcoords[i], texture, k) - whole;
        (&out[i].x)[k] = (float)(at < -MOST ? -MOST : at > MOST ? MOST : at);
    }
}

/* ---- all ---- */

void zr_texcoords_put(const struct zr_mesh *mesh, const struct zr_texture *texture, unsigned repeat, zr_vec4 *out)
{
    bool near = true;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const zr_vec4 given = mesh->texcoords[i];
        float in_image[2];
        out[i] = given;
        if (texture) {
            zr_texture_transform(texture, texture->texcoord == 0 ? given.x : given.z,
                                 texture->texcoord == 0 ? given.y : given.w, in_image);
            out[i] = (zr_vec4){in_image[0], in_image[1], 0.0f, 0.0f};
        }
        near = near && is_near(&out[i]);
    }
    if (near) return;
    if (texture) repeat = (texture->wrap_s != ZR_WRAP_CLAMP ? 1u : 0u) | (texture->wrap_t != ZR_WRAP_CLAMP ? 2u : 0u);
    for (int k = 0; k < (texture ? 2 : 4); k++)
        put_far(mesh, texture, k, repeat >> k & 1u, out);
}
