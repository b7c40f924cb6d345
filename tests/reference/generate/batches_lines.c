#include "reference/generate/batches_builder.h"

bool batches_append_lines(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end)
{
    const struct zr_mesh *mesh = s->mesh;
    bool owners = b->options.purpose == BATCHES_OWNERS;
    struct reference_batch batch = {.mode = REFERENCE_LINES,
                                    .modelview = s->modelview,
                                    .instance = (uint32_t)(s->instance - b->scene->instances),
                                    .smooth = mesh->colors && !owners,
                                    .first = b->corner_count,
                                    .count = 2 * (end - begin)};
    if (begin == end) return true;
    if (!batches_reserve_corners(b, batch.count)) return false;
    b->out->triangles += end - begin;
    for (uint32_t i = 2 * begin; i < 2 * end; i++) {
        zr_vec4 color = b->scene->materials[mesh->material].base_color;
        if (mesh->colors) color = zr_vec4_mul(color, mesh->colors[mesh->lines[i]]);
        if (owners) color = batches_owner_color(b->owner + mesh->face_count + i / 2);
        batches_append_vertex(b, s, mesh->lines[i], color, (zr_vec3){0, 0, 0});
    }
    return batches_append(b, &batch);
}

bool batches_append_points(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end)
{
    const struct zr_mesh *mesh = s->mesh;
    struct reference_batch batch = {.mode = REFERENCE_POINTS,
                                    .modelview = s->modelview,
                                    .instance = (uint32_t)(s->instance - b->scene->instances),
                                    .point_size = mesh->point_size,
                                    .first = b->corner_count,
                                    .count = end - begin};
    if (begin == end) return true;
    if (!batches_reserve_corners(b, batch.count)) return false;
    b->out->triangles += end - begin;
    for (uint32_t i = begin; i < end; i++) {
        zr_vec4 color = b->scene->materials[mesh->material].base_color;
        if (mesh->colors) color = zr_vec4_mul(color, mesh->colors[zr_mesh_point(mesh, i)]);
        if (b->options.purpose == BATCHES_OWNERS)
            color = batches_owner_color(b->owner + mesh->face_count + mesh->line_count + i);
        batches_append_vertex(b, s, zr_mesh_point(mesh, i), color, (zr_vec3){0, 0, 0});
    }
    return batches_append(b, &batch);
}
