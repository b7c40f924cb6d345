#include "reference/gl/look_texture.h"

#include <math.h>

typedef double vec3[3];

static double determinant(const vec3 a, const vec3 b, const vec3 c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* x, y and w, x and y being pixels times w. */
static void to_window(const struct zr_scene *scene, const struct reference_arrays *arrays,
                      const struct reference_batch *batch, zr_vec4 position, vec3 out)
{
    const float *p[] = {arrays->projection.m, batch->modelview->m};
    const double in[4] = {(double)position.x, (double)position.y, (double)position.z, (double)position.w};
    double eye[4] = {0}, clip[4] = {0};
    for (int row = 0; row < 4; row++)
        for (int k = 0; k < 4; k++)
            eye[row] += (double)p[1][4 * k + row] * in[k];
    for (int row = 0; row < 4; row++)
        for (int k = 0; k < 4; k++)
            clip[row] += (double)p[0][4 * k + row] * eye[k];
    out[0] = 0.5 * (clip[0] + clip[3]) * (double)scene->views[0].width;
    out[1] = 0.5 * (clip[1] + clip[3]) * (double)scene->views[0].height;
    out[2] = clip[3];
}

/* Cramer's rule: the x and y of the plane that has the values. */
static void solve(vec3 corners[3], const double values[3], float *x, float *y)
{
    const double all = determinant(corners[0], corners[1], corners[2]);
    vec3 c[3];
    for (int axis = 0; axis < 2; axis++) {
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                c[i][k] = k == axis ? values[i] : corners[i][k];
        *(axis == 0 ? x : y) = all != 0.0 ? (float)(determinant(c[0], c[1], c[2]) / all) : 0.0f;
    }
}

static void put_steps(const struct zr_scene *scene, const struct reference_arrays *arrays,
                      const struct reference_batch *batch, uint32_t first, struct look_corners *out)
{
    static const double ones[3] = {1, 1, 1};
    vec3 corners[3];
    double values[4][3];
    zr_vec4 x, y, w = {0, 0, 0, 0};
    for (uint32_t i = 0; i < 3; i++) {
        const zr_vec4 t = arrays->texcoords[first + i];
        to_window(scene, arrays, batch, arrays->positions[first + i], corners[i]);
        values[0][i] = (double)t.x;
        values[1][i] = (double)t.y;
        values[2][i] = (double)t.z;
        values[3][i] = (double)t.w;
    }
    solve(corners, values[0], &x.x, &y.x);
    solve(corners, values[1], &x.y, &y.y);
    solve(corners, values[2], &x.z, &y.z);
    solve(corners, values[3], &x.w, &y.w);
    solve(corners, ones, &w.x, &w.y);
    for (uint32_t i = 0; i < 3; i++) {
        out->along_x[first + i] = x;
        out->along_y[first + i] = y;
        out->w_along[first + i] = w;
    }
}

/* Where a texture of normals is looked at. */
static void place_of(const struct zr_texture *texture, zr_vec4 texcoord, double out[2])
{
    const double u = (double)(texture->texcoord == 0 ? texcoord.x : texcoord.z),
                 v = (double)(texture->texcoord == 0 ? texcoord.y : texcoord.w);
    for (int k = 0; k < 2; k++)
        out[k] = (double)texture->rows[k][0] * u + (double)texture->rows[k][1] * v + (double)texture->rows[k][2];
}

static void put_tangents(const struct zr_scene *scene, const struct reference_arrays *arrays,
                         const struct reference_batch *batch, uint32_t first, struct look_corners *out)
{
    const struct zr_material *material = batch->textured;
    const uint32_t coat = material->textures[ZR_TEXTURE_COAT_NORMAL],
                   own = material->textures[ZR_TEXTURE_NORMAL] ? material->textures[ZR_TEXTURE_NORMAL] : coat,
                   number = own ? own : material->textures[ZR_TEXTURE_ANISOTROPY];
    const double turn = zr_mat4_is_mirror(batch->modelview) ? -1.0 : 1.0;
    static const struct zr_texture plain = {.rows = {{1, 0, 0}, {0, 1, 0}}};
    if (number == 0 && material->finish.anisotropy == 0.0f) return;
    if (arrays->tangents[first].w != 0.0f) {
        for (uint32_t i = first; i < first + 3; i++) {
            out->tangents[i] = arrays->tangents[i];
            out->tangents[i].w = (float)(turn * (arrays->tangents[i].w < 0.0f ? -1.0 : 1.0));
        }
        return;
    }
    const zr_vec4 *p = &arrays->positions[first];
    double at[3][2];
    for (uint32_t i = 0; i < 3; i++)
        place_of(number ? &scene->textures[number - 1] : &plain, arrays->texcoords[first + i], at[i]);
    const vec3 e1 = {(double)p[1].x - (double)p[0].x, (double)p[1].y - (double)p[0].y, (double)p[1].z - (double)p[0].z},
               e2 = {(double)p[2].x - (double)p[0].x, (double)p[2].y - (double)p[0].y, (double)p[2].z - (double)p[0].z};
    const double u1 = at[1][0] - at[0][0], v1 = at[1][1] - at[0][1], u2 = at[2][0] - at[0][0], v2 = at[2][1] - at[0][1];
    const double area = u1 * v2 - u2 * v1;
    zr_vec4 tangent = {0, 0, 0, (float)(area > 0.0 ? -turn : turn)};
    if (area != 0.0) {
        tangent.x = (float)((e1[0] * v2 - e2[0] * v1) / area);
        tangent.y = (float)((e1[1] * v2 - e2[1] * v1) / area);
        tangent.z = (float)((e1[2] * v2 - e2[2] * v1) / area);
    }
    for (uint32_t i = first; i < first + 3; i++)
        out->tangents[i] = tangent;
}

bool look_corners_make(struct zr_arena *arena, const struct zr_scene *scene, const struct reference_arrays *arrays,
                       struct look_corners *out)
{
    uint32_t corners = 0;
    for (uint32_t i = 0; i < arrays->batch_count; i++)
        corners = arrays->batches[i].first + arrays->batches[i].count;
    zr_vec4 **const lists[] = {&out->tangents, &out->along_x, &out->along_y, &out->w_along};
    for (int k = 0; k < 4; k++)
        if (!(*lists[k] = zr_arena_zero(arena, (size_t)corners + 1, sizeof(zr_vec4)))) return false;
    for (uint32_t i = 0; i < arrays->batch_count; i++) {
        const struct reference_batch *batch = &arrays->batches[i];
        for (uint32_t k = 0; batch->textured && k + 2 < batch->count; k += 3) {
            put_steps(scene, arrays, batch, batch->first + k, out);
            put_tangents(scene, arrays, batch, batch->first + k, out);
        }
    }
    return true;
}
