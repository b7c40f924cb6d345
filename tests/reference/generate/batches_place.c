/* Corners in clip space, in double. */
#include "reference/generate/batches.h"

static void apply_in_double(const zr_mat4 *m, double v[4])
{
    double out[4];
    for (int row = 0; row < 4; row++)
        out[row] = (double)m->m[row] * v[0] +
                   ((double)m->m[4 + row] * v[1] + ((double)m->m[8 + row] * v[2] + (double)m->m[12 + row] * v[3]));
    for (int row = 0; row < 4; row++)
        v[row] = out[row];
}

void batches_transform(const struct zr_camera *camera, const zr_mat4 *object_to_world, zr_vec4 position, double clip[4])
{
    clip[0] = (double)position.x;
    clip[1] = (double)position.y;
    clip[2] = (double)position.z;
    clip[3] = (double)position.w;
    apply_in_double(object_to_world, clip);
    apply_in_double(&camera->world_to_eye, clip);
    apply_in_double(&camera->projection, clip);
}
