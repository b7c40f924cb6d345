#include "geometry/record.h"

#include <string.h>

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

static void swap(uint32_t values[3])
{
    const int k = zr_swapped_corner();
    const uint32_t first = values[0];
    values[0] = values[k];
    values[k] = first;
}

static struct zr_record written_of(const struct zr_geometry *geometry, uint32_t number)
{
    const struct zr_triangle *written = &geometry->triangles[number];
    struct zr_record record = {.triangle = *written,
                               .colors = written->back ? geometry->back_colors : geometry->front_colors,
                               .normals = geometry->normals};
    if (!geometry->surfaces) return record;
    memcpy(record.n, geometry->surfaces[number].n, sizeof record.n);
    record.material = geometry->surfaces[number].material;
    return record;
}

struct zr_record zr_record_of(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number)
{
    uint32_t t = number - batch->first;
    if (batch->written) return written_of(geometry, batch->first_record + t);
    struct zr_record record = {.triangle = {.face = zr_face_id(geometry, batch, number)},
                               .normals = batch->normals,
                               .material = batch->material};
    uint32_t *v = record.triangle.v, *c = record.triangle.c;
    for (int k = 0; k < 3; k++) {
        v[k] = batch->first_vertex + batch->corners[3 * (size_t)t + (size_t)k];
        c[k] = zr_batch_color(batch, t, k);
        if (batch->normals) record.n[k] = zr_batch_value(batch, batch->normals_rate, t, k);
    }
    const struct zr_window_vertex *vertices = geometry->vertices;
    bool counter_clockwise = zr_window_area(&vertices[v[0]], &vertices[v[1]], &vertices[v[2]]) < 0;
    if (counter_clockwise) {
        swap(v);
        swap(c);
        swap(record.n);
    }
    record.triangle.turned = counter_clockwise;
    record.triangle.back = counter_clockwise == batch->mirrored;
    record.colors = record.triangle.back ? batch->back : batch->front;
    return record;
}
