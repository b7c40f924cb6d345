/* Finds the chunks of a binary glTF. Source: glTF 2.0, section 4 "GLB File Format Specification". */
#include "input/gltf/gltf_file.h"

#include <string.h>

#include "input/formats/input.h"

enum { HEADER_BYTES = 12, CHUNK_HEADER_BYTES = 8, VERSION = 2 };
enum { MAGIC = 0x46546C67, JSON_CHUNK = 0x4E4F534A, BINARY_CHUNK = 0x004E4942 };

static uint32_t read_u32(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

bool zr_looks_so_GLB(const char *bytes, size_t size)
{
    return size >= 4 && read_u32(bytes) == MAGIC;
}

static enum zr_status find_chunks(const char *bytes, size_t size, struct zr_parsed_bytes *text,
                                  struct zr_parsed_bytes *chunk, struct zr_error *error)
{
    for (size_t at = HEADER_BYTES; at < size;) {
        if (size - at < CHUNK_HEADER_BYTES)
            return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "byte %zu: %zu bytes are left, too few for a chunk", at,
                                size - at);
        const uint32_t length = read_u32(bytes + at), type = read_u32(bytes + at + 4);
        const size_t first = at + CHUNK_HEADER_BYTES;
        if (length > size - first)
            return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "byte %zu: a chunk of %u bytes, and %zu are left", at,
                                length, size - first);
        if (at == HEADER_BYTES && type != JSON_CHUNK)
            return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "byte %zu: the first chunk is not JSON", at);
        if (type == JSON_CHUNK && !text->bytes) *text = (struct zr_parsed_bytes){bytes + first, length};
        if (type == BINARY_CHUNK && !chunk->bytes) *chunk = (struct zr_parsed_bytes){bytes + first, length};
        at = first + length;
    }
    if (!text->bytes) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "binary glTF without a chunk of JSON");
    return ZR_OK;
}

enum zr_status zr_gltf_unpack(struct zr_scene_builder *builder, const struct zr_parsed_bytes *file,
                              struct zr_parsed_bytes *text, struct zr_parsed_bytes *chunk, struct zr_error *error)
{
    const char *bytes = file->bytes;
    const size_t size = file->size;
    *text = zr_looks_so_GLB(bytes, size) ? (struct zr_parsed_bytes){NULL, 0} : *file;
    *chunk = (struct zr_parsed_bytes){NULL, 0};
    if (text->bytes) return ZR_OK;
    if (size < HEADER_BYTES)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "binary glTF of %zu bytes; its header has %d", size,
                            HEADER_BYTES);
    const uint32_t version = read_u32(bytes + 4), length = read_u32(bytes + 8);
    if (version != VERSION)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "binary glTF of version %u; version 2 is read", version);
    if (length > size)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL,
                            "binary glTF of %u bytes by its header, but there are %zu: was it cut short?", length,
                            size);
    if (length < size)
        zr_warning_list_add(builder->arena, &builder->warnings, "%zu bytes behind the end of binary glTF are not read",
                            size - length);
    return find_chunks(bytes, length, text, chunk, error);
}
