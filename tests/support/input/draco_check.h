/* draco_check.h - tests: the streams of draco_streams.h as bytes, and the digest of a decoded mesh. */
#ifndef ZR_TESTS_DRACO_CHECK_H
#define ZR_TESTS_DRACO_CHECK_H

#include <stdio.h>
#include <string.h>

#include "input/codecs/draco.h"
#include "input/text/base64.h"
#include "support/input/draco_streams.h"

enum { DRACO_STREAMS = sizeof draco_streams / sizeof *draco_streams, DRACO_BYTES_MOST = 4096 };

/* Decodes the text of a stream. Returns the number of bytes. */
static inline size_t draco_stream_bytes(size_t number, unsigned char out[DRACO_BYTES_MOST])
{
    const char *text = draco_streams[number].base64;
    size_t used = 0;
    return zr_base64_room(strlen(text)) <= DRACO_BYTES_MOST && zr_base64_decode(text, strlen(text), out, &used) ? used
                                                                                                                : 0;
}

/* Writes a glTF file with the faces and the positions of a stream. more: keys of the root, with a comma before them. */
static inline size_t draco_stream_file(size_t number, const char *more, char out[2 * DRACO_BYTES_MOST])
{
    const char *text = draco_streams[number].base64, *padding = strchr(text, '=');
    const size_t bytes = strlen(text) / 4 * 3 - (padding ? strlen(padding) : 0);
    const int length = snprintf(
        out, 2 * DRACO_BYTES_MOST,
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"buffers\":[{"
        "\"byteLength\":%zu,\"uri\":\"data:;base64,%s\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"},{\"componentType\":5123,\"count\":"
        "%u,\"type\":\"SCALAR\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,"
        "\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{\"POSITION\":0}}}}]}],"
        "\"nodes\":[{\"mesh\":0}]%s}",
        bytes, text, bytes, draco_streams[number].points, 3 * draco_streams[number].faces, more);
    return length > 0 && length < 2 * DRACO_BYTES_MOST ? (size_t)length : 0;
}

static inline uint64_t draco_digest_add(uint64_t sum, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001B3);
    return sum;
}

/* As draco_streams.mjs computes it, on a little-endian machine. */
static inline uint64_t draco_digest(const struct zr_draco_mesh *mesh)
{
    const uint32_t counts[2] = {mesh->point_count, mesh->face_count};
    uint64_t sum = draco_digest_add(UINT64_C(0xCBF29CE484222325), counts, sizeof counts);
    sum = draco_digest_add(sum, mesh->corners, mesh->face_count * 3 * sizeof *mesh->corners);
    for (uint32_t i = 0; i < mesh->attribute_count; i++) {
        const struct zr_draco_attribute *of = &mesh->attributes[i];
        const uint32_t head[3] = {of->id, (uint32_t)of->type, of->width};
        sum = draco_digest_add(sum, head, sizeof head);
        sum = draco_digest_add(sum, of->values, mesh->point_count * of->width * zr_draco_type_bytes(of->type));
    }
    return sum;
}

#endif
