#include "geometry/geometry.h"

#include "scene/scene.h"

struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex)
{
    const struct zr_matrix world = zr_matrix_of(object_to_world), view = zr_matrix_of(&camera->world_to_eye);
    const struct zr_matrix projection = zr_matrix_of(&camera->projection);
    const struct zr_matrix eye = zr_matrix_mul(&view, &world), clip = zr_matrix_mul(&projection, &eye);
    struct zr_source_instance out = {
        .first_vertex = first_vertex, .vertex_count = mesh->position_count, .mesh = mesh, .object_to_eye = eye};
    out.to_eye = zr_mat4_mul(&camera->world_to_eye, object_to_world);
    out.to_clip = zr_mat4_mul(&camera->projection, &out.to_eye);
    for (int column = 0; column < 4; column++) {
        out.columns[column][ZR_SOURCE_X] = clip.m[column * 4];
        out.columns[column][ZR_SOURCE_Y] = clip.m[column * 4 + 1];
        out.columns[column][ZR_SOURCE_W] = clip.m[column * 4 + 3];
        out.columns[column][ZR_SOURCE_EYE_DEPTH] = -eye.m[column * 4 + 2];
        out.columns[column][ZR_SOURCE_EYE_W] = eye.m[column * 4 + 3];
    }
    return out;
}

/* Returns the index of the last item whose first word is at most `number`, by binary search; 0 if there is none. Items
 * are `size` bytes apart. */
static size_t last_up_to(const uint32_t *first_words, uint32_t count, size_t size, uint32_t number)
{
    const size_t words = size / sizeof *first_words;
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (first_words[middle * words] <= number)
            low = middle;
        else
            high = middle;
    }
    return low;
}

_Static_assert(offsetof(struct zr_draw, first) == 0 && sizeof(struct zr_draw) % sizeof(uint32_t) == 0,
               "the first word is first");
_Static_assert(offsetof(struct zr_cut, first_vertex) == 0 && sizeof(struct zr_cut) % sizeof(uint32_t) == 0,
               "the first word is first_vertex");

const struct zr_draw *zr_draw_of(const struct zr_geometry *geometry, uint32_t number)
{
    return &geometry->draws[last_up_to(&geometry->draws->first, geometry->draw_count, sizeof *geometry->draws, number)];
}

struct zr_triangle zr_triangle_of(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number)
{
    const uint32_t t = number - draw->first, trait = draw->traits ? draw->traits[t] : 0;
    const struct zr_window_vertex *vertices = geometry->vertices;
    struct zr_triangle out = {.line = zr_draw_is_of_wires(draw), .depth_offset = draw->depth_offset};
    uint32_t *v = out.v;
    if (zr_draw_is_cloud(draw)) return out;
    for (uint32_t k = 0; k < 3; k++)
        v[k] = draw->first_vertex + zr_draw_corner(draw, t, k);
    out.turned = !out.line && zr_window_area(&vertices[v[0]], &vertices[v[1]], &vertices[v[2]]) < 0;
    if (out.turned) {
        const int k = zr_swapped_corner();
        const uint32_t first = v[0];
        v[0] = v[k];
        v[k] = first;
    }
    if (draw->kind == ZR_DRAW_SHAPES) out.shape = 1 + trait / 2;
    out.back = draw->kind == ZR_DRAW_TRIANGLES ? out.turned == draw->mirrored : trait % 2 != 0;
    return out;
}

static struct zr_wire_end end_in_cloud(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number)
{
    const struct zr_source_instance *instance = &geometry->instances[draw->instance];
    const struct zr_viewport viewport = zr_viewport_make(geometry->window.width, geometry->window.height);
    const zr_vec4 p = draw->mesh->positions[zr_cloud_position(draw, number)];
    struct zr_wire_end end;
    zr_viewport_apply(&viewport, zr_mat4_apply(&instance->to_clip, p), &end.vertex);
    end.eye = (struct zr_eye){zr_mat4_row(&instance->to_eye, 2, p), zr_mat4_row(&instance->to_eye, 3, p)};
    return end;
}

void zr_wire_ends(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                  struct zr_wire_end ends[2])
{
    if (zr_draw_is_cloud(draw)) {
        ends[0] = ends[1] = end_in_cloud(geometry, draw, number);
        return;
    }
    for (uint32_t k = 0; k < 2; k++) {
        const uint32_t v = draw->first_vertex + zr_draw_corner(draw, number - draw->first, k);
        ends[k] = (struct zr_wire_end){geometry->vertices[v], geometry->eyes[v]};
    }
}

static const struct zr_cut *cut_of(const struct zr_geometry *geometry, uint32_t vertex)
{
    return &geometry
                ->cuts[last_up_to(&geometry->cuts->first_vertex, geometry->cut_count, sizeof *geometry->cuts, vertex)];
}

struct zr_source zr_source_of(const struct zr_geometry *geometry, const struct zr_draw *draw,
                              const uint32_t vertices[3])
{
    struct zr_source source = {.instance = &geometry->instances[draw->instance]};
    const uint32_t first = draw->first_vertex;
    const uint32_t *cut =
        vertices[0] - first < draw->mesh->position_count ? NULL : cut_of(geometry, vertices[0])->corners;
    source.is_cut = cut != NULL;
    for (int k = 0; k < 3; k++)
        source.corners[k] = &draw->mesh->positions[cut ? cut[k] : vertices[k] - first];
    return source;
}
