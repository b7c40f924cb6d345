/* Sequential connectivity of Draco meshes: the points of all corners, as numbers or as coded differences. */
#include "input/codecs/draco_mesh.h"

enum { COMPRESSED, RAW };

/* Differences to the corner before; the lowest bit is the sign. */
static bool read_differences(struct zr_draco *draco, uint32_t corners)
{
    uint32_t last = 0, *points = draco->points;
    if (!zr_draco_read_symbols(&draco->stream, &draco->scratch, draco->cancel, corners, 1, points)) return false;
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t difference = points[i] >> 1;
        last += points[i] & 1 ? 0 - difference : difference;
        points[i] = last;
        if (last >= draco->mesh->point_count) return false;
        if (zr_draco_stops(draco)) return false;
    }
    return true;
}

/* The width of a number depends on the number of points. */
static bool read_numbers(struct zr_draco *draco, uint32_t corners)
{
    const uint32_t count = draco->mesh->point_count;
    struct zr_draco_stream *stream = &draco->stream;
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t point = count < 1u << 8    ? zr_draco_u8(stream)
                               : count < 1u << 16 ? zr_draco_u16(stream)
                               : count < 1u << 21 ? zr_draco_count(stream)
                                                  : zr_draco_u32(stream);
        draco->points[i] = point;
        if (stream->is_broken || point >= count) return false;
        if (zr_draco_stops(draco)) return false;
    }
    return true;
}

bool zr_draco_read_sequential(struct zr_draco *draco)
{
    const uint64_t faces = zr_draco_varint(&draco->stream), points = zr_draco_varint(&draco->stream);
    const uint32_t method = zr_draco_u8(&draco->stream);
    if (draco->stream.is_broken || !zr_draco_set_faces(draco, faces) || !zr_draco_set_points(draco, points))
        return false;
    const uint32_t corners = 3 * draco->mesh->face_count;
    return method == COMPRESSED ? read_differences(draco, corners) : read_numbers(draco, corners);
}
