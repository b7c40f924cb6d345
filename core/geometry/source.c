#include "geometry/source.h"

#include "scene/scene.h"

struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex)
{
    const struct zr_matrix world = zr_matrix_of(object_to_world), view = zr_matrix_of(&camera->world_to_eye);
    const struct zr_matrix projection = zr_matrix_of(&camera->projection);
    const struct zr_matrix eye = zr_matrix_mul(&view, &world), clip = zr_matrix_mul(&projection, &eye);
    struct zr_source_instance out = {.first_vertex = first_vertex, .mesh = mesh, .object_to_eye = eye};
    out.to_eye = zr_mat4_mul(&camera->world_to_eye, object_to_world);
    for (int column = 0; column < 4; column++) {
        out.columns[column][ZR_SOURCE_X] = clip.m[column * 4];
        out.columns[column][ZR_SOURCE_Y] = clip.m[column * 4 + 1];
        out.columns[column][ZR_SOURCE_W] = clip.m[column * 4 + 3];
        out.columns[column][ZR_SOURCE_EYE_DEPTH] = -eye.m[column * 4 + 2];
        out.columns[column][ZR_SOURCE_EYE_W] = eye.m[column * 4 + 3];
    }
    return out;
}
