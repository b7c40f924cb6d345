#include "geometry/batch.h"

#include "geometry/geometry.h"

const struct zr_batch *zr_batch_of(const struct zr_geometry *geometry, uint32_t number)
{
    uint32_t low = 0, high = geometry->batch_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (geometry->batches[middle].first <= number)
            low = middle;
        else
            high = middle;
    }
    return &geometry->batches[low];
}

uint32_t zr_face_id(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number)
{
    const uint32_t t = number - batch->first;
    return batch->written ? geometry->triangles[batch->first_record + t].face
                          : batch->first_id + zr_batch_face(batch, t);
}

struct zr_record zr_record_of(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number)
{
    uint32_t t = number - batch->first;
    if (batch->written) {
        const struct zr_triangle *written = &geometry->triangles[batch->first_record + t];
        return (struct zr_record){*written, written->back ? geometry->back_colors : geometry->front_colors};
    }
    struct zr_record record;
    record.triangle = (struct zr_triangle){.face = zr_face_id(geometry, batch, number)};
    for (int k = 0; k < 3; k++) {
        record.triangle.v[k] = batch->first_vertex + batch->corners[3 * (size_t)t + (size_t)k];
        record.triangle.c[k] = zr_batch_color(batch, t, k);
    }
    const struct zr_window_vertex *vertices = geometry->vertices;
    uint32_t *v = record.triangle.v, *c = record.triangle.c;
    bool counter_clockwise = zr_window_area(&vertices[v[0]], &vertices[v[1]], &vertices[v[2]]) < 0;
    if (counter_clockwise) {
        const int k = zr_swapped_corner();
        uint32_t v0 = v[0], c0 = c[0];
        v[0] = v[k];
        c[0] = c[k];
        v[k] = v0;
        c[k] = c0;
    }
    record.triangle.turned = counter_clockwise;
    record.triangle.back = counter_clockwise == batch->mirrored;
    record.colors = record.triangle.back ? batch->back : batch->front;
    return record;
}
