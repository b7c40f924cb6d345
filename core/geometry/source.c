#include "geometry/source.h"

struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex)
{
    const struct zr_matrix world = zr_matrix_of(object_to_world), view = zr_matrix_of(&camera->world_to_eye);
    const struct zr_matrix projection = zr_matrix_of(&camera->projection);
    const struct zr_matrix eye = zr_matrix_mul(&view, &world), clip = zr_matrix_mul(&projection, &eye);
    struct zr_source_instance out = {.first_vertex = first_vertex, .mesh = mesh, .object_to_eye = eye};
    for (int column = 0; column < 4; column++) {
        out.columns[column][ZR_SOURCE_X] = clip.m[column * 4];
        out.columns[column][ZR_SOURCE_Y] = clip.m[column * 4 + 1];
        out.columns[column][ZR_SOURCE_W] = clip.m[column * 4 + 3];
        out.columns[column][ZR_SOURCE_EYE_DEPTH] = -eye.m[column * 4 + 2];
        out.columns[column][ZR_SOURCE_EYE_W] = eye.m[column * 4 + 3];
    }
    return out;
}

/* The last instance that begins at the vertex or before it: those without vertices begin where the next one does. */
const struct zr_source_instance *zr_source_instance_of(const struct zr_sources *sources, uint32_t vertex)
{
    uint32_t low = 0, high = sources->instance_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (sources->instances[middle].first_vertex <= vertex)
            low = middle;
        else
            high = middle;
    }
    return &sources->instances[low];
}

static const struct zr_source_cut *cut_of(const struct zr_sources *sources, uint32_t vertex)
{
    uint32_t low = 0, high = sources->cut_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (sources->cuts[middle].first_vertex <= vertex)
            low = middle;
        else
            high = middle;
    }
    return &sources->cuts[low];
}

struct zr_source zr_source_of(const struct zr_sources *sources, const uint32_t vertices[3])
{
    struct zr_source source = {.instance = zr_source_instance_of(sources, vertices[0])};
    const struct zr_mesh *mesh = source.instance->mesh;
    uint32_t first = source.instance->first_vertex;
    const uint32_t *cut = vertices[0] - first < mesh->position_count ? NULL : cut_of(sources, vertices[0])->corners;
    source.is_cut = cut != NULL;
    for (int k = 0; k < 3; k++)
        source.corners[k] = &mesh->positions[cut ? cut[k] : vertices[k] - first];
    return source;
}
