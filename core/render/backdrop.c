#include "render/backdrop.h"

#include <math.h>

#include "scene/camera/camera.h"

/* ---- materials ---- */

/* Returns the root mean square of the lengths of the axes. */
static float scale_of(const zr_mat4 *matrix)
{
    float sum = 0.0f;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            sum += matrix->m[4 * column + row] * matrix->m[4 * column + row];
    return sqrtf(sum / 3.0f);
}

/* Writes the scale of a mesh's material, unless an earlier instance has it. */
static void note_scale(const struct zr_scene *scene, uint32_t material, float scale, float *scales)
{
    if (zr_material_refracts(&scene->materials[material]) && scales[material] == 0.0f) scales[material] = scale;
}

/* Finds how much the first instance with each material is scaled. */
static void find_scales(const struct zr_run *run, const struct zr_scene *scene, float *scales)
{
    for (uint32_t i = 0; i < scene->instance_count && !zr_is_cancelled(run->cancel); i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        const float scale = scale_of(&scene->instances[i].object_to_world);
        if (!mesh->face_materials) note_scale(scene, mesh->material, scale, scales);
        for (uint32_t face = 0; mesh->face_materials && face < mesh->face_count; face++)
            note_scale(scene, mesh->face_materials[face], scale, scales);
    }
}

/* Rays of huge volumes stay finite. */
#define THICKNESS_MAX 1e15f

/* Sets thickness and power; `scales` is overwritten. */
static void set_volumes(const struct zr_scene *scene, float eye_scale, float *scales, float *powers)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const struct zr_finish *finish = &scene->materials[i].finish;
        const float thickness = fminf(finish->thickness * scales[i], THICKNESS_MAX);
        powers[i] = finish->distance > 0.0f ? fminf(thickness / finish->distance, ZR_BACKDROP_POWER_MAX) : 0.0f;
        scales[i] = fminf(thickness * eye_scale, THICKNESS_MAX);
    }
}

/* ---- the window ---- */

static void set_window(const struct zr_frame *frame, struct zr_backdrop *out)
{
    const zr_mat4 *projection = &frame->camera.projection;
    const zr_vec4 eye = zr_camera_eye(&frame->camera);
    const float half[2] = {0.5f * (float)frame->width, 0.5f * (float)frame->height};
    const float start[3] = {eye.x, eye.y, eye.z};
    for (int k = 0; k < 4; k++) {
        const float w = projection->m[4 * k + 3];
        for (int row = 0; row < 2; row++)
            out->to_window[row][k] = half[row] * (projection->m[4 * k + row] + w);
        out->to_window[2][k] = w;
    }
    for (int row = 0; eye.w != 0.0f && row < 3; row++)
        for (int k = 0; k < 3; k++)
            out->to_window[row][3] += out->to_window[row][k] * start[k];
}

static void set_levels(uint32_t width, uint32_t height, struct zr_backdrop *out)
{
    const uint32_t smaller = width < height ? width : height;
    int32_t count = 0, first = 0;
    out->roughest = 0.0f;
    for (uint32_t side = smaller; side > 1; side /= 2)
        out->roughest += 1.0f;
    for (;; count++) {
        out->first[count] = first;
        out->width[count] = (int32_t)width;
        out->height[count] = (int32_t)height;
        if ((width == 1 && height == 1) || count + 1 == ZR_BACKDROP_LEVELS) break;
        first += (int32_t)(width * height);
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    out->level_count = count + 1;
}

enum zr_status zr_backdrop_open(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                                struct zr_backdrop *out)
{
    float *scales = zr_arena_zero(run->arena, scene->material_count, sizeof *scales);
    float *powers = zr_arena_alloc(run->arena, scene->material_count, sizeof *powers);
    if (!scales || !powers) return ZR_NO_MEMORY;
    *out = (struct zr_backdrop){.thickness = scales, .power = powers};
    find_scales(run, scene, scales);
    set_volumes(scene, zr_eye_scale_of(&frame->camera), scales, powers);
    set_window(frame, out);
    set_levels(frame->width, frame->height, out);
    return ZR_OK;
}

/* ---- levels ---- */

enum { TEXELS_AT_ONCE = 64, ROWS_PER_RANGE = 4 };

struct halving {
    const float (*from)[4];
    float (*to)[4];
    int32_t width, height, new_width; /* of `from`; of `to` */
    const struct zr_cancel *cancel;
};

static int32_t within(int32_t at, int32_t count)
{
    return at < 0 ? 0 : at < count ? at : count - 1;
}

/* Adds four texels by the weights 1/8, 3/8, 3/8 and 1/8. */
static void add_four(const float *a, const float *b, const float *c, const float *d, float out[4])
{
    for (int k = 0; k < 4; k++)
        out[k] = 0.125f * ((a[k] + d[k]) + 3.0f * (b[k] + c[k]));
}

/* Makes texels first .. end - 1 of a row: columns of `from` first, in `sums`. */
static void halve_part(const struct halving *h, int32_t row, int32_t first, int32_t end)
{
    float sums[2 * TEXELS_AT_ONCE + 2][4];
    const float(*rows[4])[4];
    for (int k = 0; k < 4; k++)
        rows[k] = h->from + (ptrdiff_t)within(2 * row - 1 + k, h->height) * h->width;
    for (int32_t x = 2 * first - 1; x <= 2 * end; x++) {
        const int32_t at = within(x, h->width);
        add_four(rows[0][at], rows[1][at], rows[2][at], rows[3][at], sums[x - (2 * first - 1)]);
    }
    for (int32_t x = first; x < end; x++) {
        float(*of)[4] = sums + 2 * (x - first);
        add_four(of[0], of[1], of[2], of[3], h->to[(ptrdiff_t)row * h->new_width + x]);
    }
}

static void halve_rows(void *context, size_t begin, size_t end)
{
    const struct halving *h = context;
    for (size_t row = begin; row < end && !zr_is_cancelled(h->cancel); row++)
        for (int32_t first = 0; first < h->new_width; first += TEXELS_AT_ONCE)
            halve_part(h, (int32_t)row, first,
                       h->new_width - first < TEXELS_AT_ONCE ? h->new_width : first + TEXELS_AT_ONCE);
}

enum zr_status zr_backdrop_fill(const struct zr_run *run, const struct zr_post_desc *picture, struct zr_backdrop *out)
{
    const int32_t last = out->level_count - 1;
    const size_t texels = (size_t)out->first[last] + (size_t)out->width[last] * (size_t)out->height[last];
    float(*all)[4] = zr_arena_alloc(run->arena, texels, sizeof *all);
    if (!all) return ZR_NO_MEMORY;
    zr_finish_compose(run->team, picture, run->cancel, all);
    for (int32_t i = 1; i < out->level_count; i++) {
        const struct halving halving = {(const float(*)[4])(all + out->first[i - 1]),
                                        all + out->first[i],
                                        out->width[i - 1],
                                        out->height[i - 1],
                                        out->width[i],
                                        run->cancel};
        zr_team_ranges(run->team, (size_t)out->height[i], ROWS_PER_RANGE, halve_rows, (void *)&halving);
    }
    out->texels = all[0];
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}

double zr_backdrop_bytes(double pixels)
{
    return pixels * 1.25 * 4.0 * sizeof(float); /* of the first two levels */
}
