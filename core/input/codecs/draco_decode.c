/* Decodes Draco meshes: the header, the metadata, the connectivity, the attributes. */
#include "input/codecs/draco_mesh.h"

#include <string.h>

/* ---- metadata ---- */

/* Skips a name and its length. */
static void skip_name(struct zr_draco_stream *stream)
{
    zr_draco_take(stream, zr_draco_u8(stream));
}

/* Skips an object and all objects in it, which follow it. */
static bool skip_object(struct zr_draco *draco)
{
    struct zr_draco_stream *stream = &draco->stream;
    for (uint64_t left = 1, first = 1; left > 0 && !stream->is_broken; left--, first = 0) {
        if (!first) skip_name(stream);
        for (uint32_t entries = zr_draco_count(stream); entries > 0 && !stream->is_broken; entries--) {
            skip_name(stream);
            zr_draco_take(stream, zr_draco_count(stream));
            if (zr_draco_stops(draco)) return false;
        }
        left += zr_draco_count(stream);
        if (zr_draco_stops(draco)) return false;
    }
    return !stream->is_broken;
}

static bool skip_metadata(struct zr_draco *draco)
{
    for (uint32_t left = zr_draco_count(&draco->stream); left > 0; left--) {
        zr_draco_count(&draco->stream); /* the attribute's id */
        if (!skip_object(draco)) return false;
    }
    return skip_object(draco);
}

/* ---- the mesh ---- */

/* Reads the header and the metadata. Sets *method to that of the connectivity. */
static bool read_header(struct zr_draco *draco, uint32_t *method)
{
    enum { POINTS, MESH, HAS_METADATA = 0x8000 };
    struct zr_draco_stream *stream = &draco->stream;
    const unsigned char *name = zr_draco_take(stream, 5);
    if (!name || memcmp(name, "DRACO", 5) != 0)
        return zr_draco_refuse(draco, "the compressed data are not of Draco: they do not begin with DRACO");
    const uint32_t major = zr_draco_u8(stream), minor = zr_draco_u8(stream), kind = zr_draco_u8(stream);
    *method = zr_draco_u8(stream);
    const uint32_t flags = zr_draco_u16(stream);
    if (stream->is_broken) return false;
    if (kind == POINTS) return zr_draco_refuse(draco, "a point cloud of Draco; meshes are read");
    if (kind != MESH) return zr_draco_refuse(draco, "contents of Draco of the unknown kind %u; meshes are read", kind);
    if (*method > 1) return zr_draco_refuse(draco, "a mesh of the unknown method %u", *method);
    if (major != 2 || minor != 2)
        return zr_draco_refuse(draco, "Draco's bitstream %u.%u; version 2.2 is read", major, minor);
    return !(flags & HAS_METADATA) || skip_metadata(draco);
}

bool zr_draco_decode(struct zr_arena *arena, const struct zr_cancel *cancel, const void *bytes, size_t size,
                     struct zr_draco_mesh *out, struct zr_reason *reason)
{
    enum { SEQUENTIAL, EDGEBREAKER };
    struct zr_draco draco = {.arena = arena,
                             .scratch = zr_arena_open_scratch(arena),
                             .cancel = cancel,
                             .reason = reason,
                             .size = size,
                             .stream = {bytes, (const unsigned char *)bytes + size, false},
                             .mesh = out};
    uint32_t method = SEQUENTIAL;
    *out = (struct zr_draco_mesh){.point_count = 0};
    reason->text[0] = '\0';
    const bool good = read_header(&draco, &method) &&
                      (method == EDGEBREAKER ? zr_draco_read_edgebreaker(&draco) : zr_draco_read_sequential(&draco)) &&
                      zr_draco_read_attributes(&draco);
    const bool is_told = good || reason->text[0] || !zr_arena_ok(&draco.scratch) || zr_is_cancelled(cancel);
    if (!is_told)
        zr_reason_give(reason, "the compressed data are broken, at about byte %zu of %zu",
                       (size_t)(draco.stream.at - (const unsigned char *)bytes), size);
    zr_arena_close_scratch(&draco.scratch, arena);
    return good;
}
