/* Reads STL, binary and ASCII. Each triangle has its own three vertices. Normals are ignored, since exporters often
 * write zeros or wrong ones. Source: 3D Systems, StereoLithography Interface Specification, 1989. */
#include "input/input.h"

#include <string.h>

#include "base/team.h"
#include "input/parts.h"
#include "input/stl_text.h"

enum {
    HEADER_BYTES = 80,
    COUNT_END = HEADER_BYTES + 4,
    TRIANGLE_BYTES = 50,     /* normal, three vertices, two bytes of attributes */
    VERTICES_AT = 12,        /* offset in a triangle, behind its normal */
    PART_TRIANGLES = 1 << 13 /* read in a tenth of a millisecond */
};

struct binary {
    const struct zr_limits *limits;
    const char *triangles; /* bytes of the first triangle */
    size_t count;
    zr_vec4 *positions;
};

static uint32_t read_u32(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static float read_f32(const char *at)
{
    uint32_t bits = read_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* ---- binary ---- */

/* Reads triangles begin..end - 1, up to `faults` faults. */
static void read_triangles(const struct binary *binary, size_t begin, size_t end, size_t faults, struct zr_error *error)
{
    const float limit = binary->limits->coordinate_max;
    const char *triangle = binary->triangles + begin * TRIANGLE_BYTES;
    for (size_t i = begin; i < end && error->count < faults; i++, triangle += TRIANGLE_BYTES)
        for (size_t corner = 0; corner < 3; corner++) {
            float v[3];
            bool good = true;
            for (size_t axis = 0; axis < 3; axis++) {
                v[axis] = read_f32(triangle + VERTICES_AT + (corner * 3 + axis) * 4);
                good = v[axis] >= -limit && v[axis] <= limit && good; /* false for a NaN */
            }
            binary->positions[i * 3 + corner] = (zr_vec4){v[0], v[1], v[2], 1};
            if (!good)
                zr_error_add(error, ZR_BAD_SCENE, NULL,
                             "triangle %zu of %zu, vertex %zu: (%.9g, %.9g, %.9g) is beyond the limit of %.9g", i + 1,
                             binary->count, corner + 1, (double)v[0], (double)v[1], (double)v[2], (double)limit);
        }
}

static bool read_part(void *context, size_t part)
{
    const struct binary *binary = context;
    const size_t begin = part * PART_TRIANGLES, left = binary->count - begin;
    struct zr_error error = {.count = 0};
    read_triangles(binary, begin, begin + (left < PART_TRIANGLES ? left : PART_TRIANGLES), 1, &error);
    return error.count == 0;
}

static enum zr_status read_binary(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                                  const struct zr_limits *limits, size_t count, zr_vec4 **positions,
                                  struct zr_error *error)
{
    struct binary binary = {limits, request->bytes + COUNT_END, count,
                            zr_arena_alloc(arena, count * 3, sizeof *binary.positions)};
    if (!binary.positions) return ZR_NO_MEMORY;
    const size_t parts = (count + PART_TRIANGLES - 1) / PART_TRIANGLES;
    const size_t failed = zr_parts_read(team, request->cancel, 0, parts, read_part, &binary);
    if (zr_is_cancelled(request->cancel)) return ZR_CANCELLED;
    if (failed < parts) read_triangles(&binary, failed * PART_TRIANGLES, count, ZR_ERROR_ITEMS, error);
    *positions = binary.positions;
    return error->count > 0 ? error->status : ZR_OK;
}

/* ---- both ---- */

/* Decides by the size: many binary files begin with "solid" too. */
static bool is_binary(const char *bytes, size_t size)
{
    return size >= COUNT_END && COUNT_END + (uint64_t)read_u32(bytes + HEADER_BYTES) * TRIANGLE_BYTES == size;
}

bool zr_looks_so_STL(const char *bytes, size_t size)
{
    return is_binary(bytes, size) || zr_stl_is_text(bytes, size);
}

static enum zr_status read_positions(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                                     const struct zr_limits *limits, zr_vec4 **positions, size_t *triangles,
                                     struct zr_error *error)
{
    const char *bytes = request->bytes;
    const size_t size = request->size;
    uint32_t count = size >= COUNT_END ? read_u32(bytes + HEADER_BYTES) : 0;
    uint64_t wanted = COUNT_END + (uint64_t)count * TRIANGLE_BYTES;
    const bool binary = is_binary(bytes, size);
    if (!binary && zr_stl_is_text(bytes, size))
        return zr_stl_text_read(arena, team, request, limits, positions, triangles, error);
    if (size < COUNT_END)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL,
                            "neither 'solid' nor a binary header: at least %d bytes expected, got %zu", COUNT_END,
                            size);
    if (!binary)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "%llu bytes expected for %u triangles, got %zu",
                            (unsigned long long)wanted, count, size);
    if (count > ZR_STL_TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%u triangles, more than the limit of %d", count,
                            ZR_STL_TRIANGLES_MAX);
    *triangles = count;
    return read_binary(arena, team, request, limits, count, positions, error);
}

enum zr_status zr_read_STL(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    zr_vec4 *positions = NULL;
    size_t triangles = 0;
    const enum zr_status status =
        read_positions(builder->arena, builder->team, request, limits, &positions, &triangles, error);
    if (status != ZR_OK) return status;
    if (triangles == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "no geometry: the STL file has no triangle");
    struct zr_mesh *mesh = zr_scene_builder_meshes(builder, 1);
    if (!mesh) return ZR_NO_MEMORY;
    mesh->position_count = (uint32_t)(3 * triangles);
    mesh->positions = positions;
    mesh->face_count = (uint32_t)triangles;
    return ZR_OK;
}
