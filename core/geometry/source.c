#include "geometry/source.h"

struct matrix {
    double m[16]; /* column-major */
};

static struct matrix widened(const zr_mat4 *matrix)
{
    struct matrix out;
    for (int i = 0; i < 16; i++)
        out.m[i] = (double)matrix->m[i];
    return out;
}

static struct matrix product(const struct matrix *a, const struct matrix *b)
{
    struct matrix out;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            const double *c = &b->m[column * 4];
            out.m[column * 4 + row] =
                ((a->m[row] * c[0] + a->m[4 + row] * c[1]) + a->m[8 + row] * c[2]) + a->m[12 + row] * c[3];
        }
    return out;
}

struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex)
{
    struct matrix world = widened(object_to_world), view = widened(&camera->world_to_eye);
    struct matrix projection = widened(&camera->projection);
    struct matrix eye = product(&view, &world), clip = product(&projection, &eye);
    struct zr_source_instance out = {.first_vertex = first_vertex, .mesh = mesh};
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
static const struct zr_source_instance *instance_of(const struct zr_sources *sources, uint32_t vertex)
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
    struct zr_source source = {.instance = instance_of(sources, vertices[0])};
    const struct zr_mesh *mesh = source.instance->mesh;
    uint32_t first = source.instance->first_vertex;
    const uint32_t *cut = vertices[0] - first < mesh->position_count ? NULL : cut_of(sources, vertices[0])->corners;
    source.is_cut = cut != NULL;
    for (int k = 0; k < 3; k++)
        source.corners[k] = &mesh->positions[cut ? cut[k] : vertices[k] - first];
    return source;
}
