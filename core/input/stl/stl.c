/* Reads STL, binary and ASCII. Each facet has its own vertices, unless the builder shares places. Normals are ignored,
 * since exporters often write zeros or wrong ones. Source: 3D Systems, StereoLithography Interface Specification,
 * 1989. */
#include "input/formats/input.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/team.h"
#include "input/stl/stl_file.h"
#include "input/stl/stl_weld.h"
#include "input/text/parts.h"
#include "input/text/recenter.h"
#include "input/text/text.h"
#include "render_request.h"

enum {
    HEADER_BYTES = 80,
    COUNT_END = HEADER_BYTES + 4,
    TRIANGLE_BYTES = ZR_STL_TRIANGLE_BYTES,
    VERTICES_AT = ZR_STL_VERTICES_AT,
    ATTRIBUTES_AT = 48,       /* after its vertices */
    PART_TRIANGLES = 1 << 13, /* read in a tenth of a millisecond */
    SHARED_LEAST = 1 << 12,   /* triangles of a file whose equal vertices are stored once */
    CORNERS_PER_CANCEL_CHECK = 1 << 16
};

struct binary {
    const struct zr_limits *limits;
    const char *triangles;  /* bytes of the first triangle */
    size_t count, vertices; /* triangles; positions */
    zr_vec4 *positions;
    uint32_t *hashes;                        /* of the vertices, instead of positions; or NULL */
    atomic_uint any, all, unmarked, colored; /* as in zr_stl_attributes, over all triangles */
    struct zr_stl_colors colors;
    zr_vec4 *face_colors;
    atomic_bool is_far;    /* a coordinate is beyond the limit */
    atomic_bool has_holes; /* the x of a first vertex is NaN: the triangle is not finite */
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

static uint16_t read_u16(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint16_t)(b[0] | b[1] << 8);
}

/* ---- binary ---- */

static uint16_t attribute_of(const struct binary *binary, size_t triangle)
{
    return read_u16(binary->triangles + triangle * TRIANGLE_BYTES + ATTRIBUTES_AT);
}

/* True if no number of the vertices is infinite or a NaN: sums of these are NaN if each is taken times 0. */
static bool is_finite(const char *triangle)
{
    float sum = 0.0f;
    for (size_t k = 0; k < 9; k++)
        sum += 0.0f * read_f32(triangle + VERTICES_AT + 4 * k);
    return sum == 0.0f;
}

static void put_corner(const struct binary *binary, size_t corner, const float v[3])
{
    uint32_t words[3];
    memcpy(words, v, sizeof words);
    if (binary->hashes)
        binary->hashes[corner] = zr_stl_hash(words);
    else
        binary->positions[corner] = (zr_vec4){v[0], v[1], v[2], 1};
}

/* Reads triangles begin..end - 1, up to `faults` faults. Returns the bits that any attribute has. */
static unsigned read_triangles(struct binary *binary, size_t begin, size_t end, size_t faults, struct zr_error *error)
{
    unsigned any = 0;
    const float near = binary->limits->coordinate_max, limit = (float)zr_recenter_limit(binary->limits);
    const char *triangle = binary->triangles + begin * TRIANGLE_BYTES;
    for (size_t i = begin; i < end && error->count < faults; i++, triangle += TRIANGLE_BYTES) {
        any |= read_u16(triangle + ATTRIBUTES_AT);
        if (!is_finite(triangle)) {
            if (!binary->hashes) binary->positions[i * 3] = (zr_vec4){NAN, 0, 0, 1};
            atomic_store_explicit(&binary->has_holes, true, memory_order_relaxed);
            continue;
        }
        for (size_t corner = 0; corner < 3; corner++) {
            float v[3];
            bool good = true, is_far = false;
            for (size_t axis = 0; axis < 3; axis++) {
                v[axis] = read_f32(triangle + VERTICES_AT + (corner * 3 + axis) * 4);
                good = v[axis] >= -limit && v[axis] <= limit && good; /* false for a NaN */
                is_far = v[axis] < -near || v[axis] > near || is_far;
            }
            if (is_far) atomic_store_explicit(&binary->is_far, true, memory_order_relaxed);
            put_corner(binary, i * 3 + corner, v);
            if (!good)
                zr_error_add(error, ZR_BAD_SCENE, NULL,
                             "triangle %zu of %zu, vertex %zu: (%.9g, %.9g, %.9g) is beyond the limit of %.9g", i + 1,
                             binary->count, corner + 1, (double)v[0], (double)v[1], (double)v[2], (double)limit);
        }
    }
    return any;
}

static size_t parts_of(const struct binary *binary)
{
    return (binary->count + PART_TRIANGLES - 1) / PART_TRIANGLES;
}

static size_t end_of_part(const struct binary *binary, size_t part)
{
    const size_t end = (part + 1) * PART_TRIANGLES;
    return end < binary->count ? end : binary->count;
}

/* Reads attributes one by one only if any is not zero. */
static bool read_part(void *context, size_t part)
{
    struct binary *binary = context;
    const size_t begin = part * PART_TRIANGLES, end = end_of_part(binary, part);
    struct zr_error error = {.count = 0};
    struct zr_stl_attributes bits = {.all = 0};
    if (read_triangles(binary, begin, end, 1, &error)) {
        bits.all = UINT16_MAX;
        for (size_t i = begin; i < end; i++)
            zr_stl_attributes_add(&bits, attribute_of(binary, i));
    }
    atomic_fetch_or_explicit(&binary->any, bits.any, memory_order_relaxed);
    atomic_fetch_and_explicit(&binary->all, bits.all, memory_order_relaxed);
    atomic_fetch_or_explicit(&binary->unmarked, bits.unmarked, memory_order_relaxed);
    atomic_fetch_or_explicit(&binary->colored, bits.colored, memory_order_relaxed);
    return error.count == 0;
}

static bool color_part(void *context, size_t part)
{
    const struct binary *binary = context;
    for (size_t i = part * PART_TRIANGLES; i < end_of_part(binary, part); i++)
        binary->face_colors[i] = zr_stl_facet_color(&binary->colors, attribute_of(binary, i));
    return true;
}

static enum zr_status read_colors(const struct zr_run *run, struct binary *binary)
{
    const size_t parts = parts_of(binary);
    const struct zr_stl_attributes bits = {.any = (uint16_t)binary->any,
                                           .all = (uint16_t)binary->all,
                                           .unmarked = (uint16_t)binary->unmarked,
                                           .colored = (uint16_t)binary->colored};
    binary->colors = zr_stl_colors_of(binary->triangles - COUNT_END, &bits);
    if (binary->colors.dialect == ZR_STL_PLAIN) return ZR_OK;
    binary->face_colors = zr_arena_alloc(run->arena, binary->count, sizeof *binary->face_colors);
    if (!binary->face_colors) return ZR_NO_MEMORY;
    return zr_parts_read(run->team, run->cancel, 0, parts, color_part, binary) < parts ? ZR_CANCELLED : ZR_OK;
}

/* Leaves out the triangles that are not finite, with a warning. */
static void drop_holes(struct binary *binary, struct zr_scene_builder *builder)
{
    size_t kept = 0;
    for (size_t i = 0; i < binary->count && !(i % PART_TRIANGLES == 0 && zr_is_cancelled(builder->arena->cancel));
         i++) {
        if (isnan(binary->positions[i * 3].x)) continue;
        memmove(binary->positions + 3 * kept, binary->positions + 3 * i, 3 * sizeof *binary->positions);
        if (binary->face_colors) binary->face_colors[kept] = binary->face_colors[i];
        kept++;
    }
    const size_t holes = binary->count - kept;
    zr_warning_list_add(builder->arena, &builder->warnings, "STL: %zu %s left out", holes,
                        holes == 1 ? "triangle is not finite and is" : "triangles are not finite and are");
    binary->count = kept;
    binary->vertices = 3 * kept;
}

/* Reads all triangles. Returns the number of the first part with a fault, or of all. */
static size_t read_parts(const struct zr_run *run, struct binary *binary)
{
    binary->all = UINT16_MAX;
    return zr_parts_read(run->team, run->cancel, 0, parts_of(binary), read_part, binary);
}

/* Reads colours, and moves far positions. */
static enum zr_status finish(const struct zr_run *run, struct binary *binary, struct zr_scene_builder *builder,
                             struct zr_stl *out)
{
    enum zr_status status = read_colors(run, binary);
    if (binary->has_holes) drop_holes(binary, builder);
    if (status == ZR_OK && (binary->is_far || zr_recenter_is_remote(binary->positions, binary->vertices)))
        status = zr_recenter_shift(run, binary->limits, binary->positions, binary->vertices, &builder->scene->origin);
    *out = (struct zr_stl){.vertices = binary->vertices,
                           .facets = binary->count,
                           .positions = binary->positions,
                           .face_colors = binary->face_colors};
    return status;
}

static enum zr_status read_binary(struct zr_scene_builder *builder, const struct zr_request *request,
                                  const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error)
{
    const struct zr_run run = {builder->arena, builder->arena, builder->team, request->cancel, error};
    const size_t count = read_u32(request->bytes + HEADER_BYTES);
    struct binary binary = {.limits = limits,
                            .triangles = request->bytes + COUNT_END,
                            .count = count,
                            .vertices = 3 * count,
                            .positions = zr_arena_alloc(run.arena, count * 3, sizeof *binary.positions)};
    if (!binary.positions) return ZR_NO_MEMORY;
    const size_t failed = read_parts(&run, &binary);
    if (zr_is_cancelled(run.cancel)) return ZR_CANCELLED;
    if (failed < parts_of(&binary)) {
        read_triangles(&binary, failed * PART_TRIANGLES, count, ZR_ERROR_ITEMS, error);
        return error->status;
    }
    return finish(&run, &binary, builder, out);
}

/* ---- binary, with equal vertices stored once ---- */

/* Finds the first of equal vertices. Returns the number of different ones; 0: they cannot be shared. */
static size_t weld(const struct zr_run *run, struct binary *binary, uint32_t *firsts)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    size_t vertices = 0;
    binary->hashes = zr_arena_alloc(&scratch, binary->count * 3, sizeof *binary->hashes);
    if (binary->hashes && read_parts(run, binary) == parts_of(binary) && !binary->has_holes)
        vertices = zr_stl_weld(&inner, binary->triangles, binary->count * 3, binary->hashes, firsts);
    zr_arena_close_scratch(&scratch, run->arena);
    binary->hashes = NULL;
    return vertices;
}

/* Replaces first corners by numbers of positions, and writes these. A first corner has its number already. */
static bool place(const struct zr_run *run, const struct binary *binary, uint32_t *indices)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3 * binary->count; i++) {
        if (i % CORNERS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) return false;
        const uint32_t first = indices[i];
        indices[i] = first < i ? indices[first] : count;
        if (first < i) continue;
        const char *at = zr_stl_corner(binary->triangles, i);
        binary->positions[count++] = (zr_vec4){read_f32(at), read_f32(at + 4), read_f32(at + 8), 1};
    }
    return true;
}

/* Reads a file without faults whose triangles have vertices in common. Others leave *out without facets. */
static enum zr_status read_shared(struct zr_scene_builder *builder, const struct zr_request *request,
                                  const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error)
{
    const struct zr_run run = {builder->arena, builder->arena, builder->team, request->cancel, error};
    const size_t count = read_u32(request->bytes + HEADER_BYTES);
    struct binary binary = {.limits = limits, .triangles = request->bytes + COUNT_END, .count = count};
    uint32_t *indices = zr_arena_alloc(run.arena, count * 3, sizeof *indices);
    binary.vertices = indices ? weld(&run, &binary, indices) : 0;
    if (zr_is_cancelled(run.cancel)) return ZR_CANCELLED;
    if (binary.vertices == 0) zr_arena_trim(run.arena, indices, count * 3, 0, sizeof *indices);
    if (binary.vertices > 0) binary.positions = zr_arena_alloc(run.arena, binary.vertices, sizeof *binary.positions);
    if (!zr_arena_ok(run.arena)) return ZR_NO_MEMORY;
    if (binary.vertices == 0) return ZR_OK;
    if (!place(&run, &binary, indices)) return ZR_CANCELLED;
    const enum zr_status status = finish(&run, &binary, builder, out);
    out->indices = indices;
    return status;
}

static enum zr_status read_binary_file(struct zr_scene_builder *builder, const struct zr_request *request,
                                       const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error)
{
    if (builder->shares_places && read_u32(request->bytes + HEADER_BYTES) >= SHARED_LEAST) {
        const enum zr_status status = read_shared(builder, request, limits, out, error);
        if (status != ZR_OK || out->facets > 0) return status;
    }
    return read_binary(builder, request, limits, out, error);
}

/* ---- both ---- */

/* Returns the size of a binary file by its header. */
static uint64_t size_wanted(const char *bytes)
{
    return COUNT_END + (uint64_t)read_u32(bytes + HEADER_BYTES) * TRIANGLE_BYTES;
}

/* Decides by the size and the count: many binary files begin with "solid" too. The last byte of the count is 0 in files
 * of up to 16 million triangles, and in no text. */
static bool is_binary(const char *bytes, size_t size)
{
    if (size < COUNT_END) return false;
    return size_wanted(bytes) == size || bytes[COUNT_END - 1] == 0 || !zr_stl_is_text(bytes, size);
}

/* True if the magnitudes of the first `count` triangles are those of a model. Data of other formats fail, since half of
 * all floats are smaller or larger. */
static bool has_model_triangles(const char *bytes, size_t count)
{
    enum { TRIANGLES = 8 };
    const float smallest = 1e-20f, largest = 1e12f;
    bool any = false;
    for (size_t i = 0; i < (count < TRIANGLES ? count : TRIANGLES); i++)
        for (size_t k = 0; k < 9; k++) {
            const float v = fabsf(read_f32(bytes + COUNT_END + i * TRIANGLE_BYTES + VERTICES_AT + 4 * k));
            if (v != 0.0f && !(v > smallest && v < largest)) return false;
            any |= v != 0.0f;
        }
    return any;
}

bool zr_looks_so_STL(const char *bytes, size_t size)
{
    if (!is_binary(bytes, size)) return zr_stl_is_text(bytes, size);
    const uint64_t wanted = size_wanted(bytes);
    return wanted == size || zr_stl_is_text(bytes, size) ||
           (wanted < size && has_model_triangles(bytes, read_u32(bytes + HEADER_BYTES)));
}

bool zr_stl_is_cut(const char *bytes, size_t size)
{
    return size >= COUNT_END + TRIANGLE_BYTES && is_binary(bytes, size) && !zr_stl_is_text(bytes, size) &&
           size_wanted(bytes) > size && has_model_triangles(bytes, (size - COUNT_END) / TRIANGLE_BYTES);
}

/* Returns the length of the first line within the header if header and count are printable, as in a text; else 0. */
static size_t text_header_line(const char *bytes)
{
    size_t line = COUNT_END;
    for (size_t i = COUNT_END; i-- > 0;) {
        if (bytes[i] == '\n' || bytes[i] == '\r')
            line = i;
        else if (bytes[i] != '\t' && ((unsigned char)bytes[i] < ' ' || bytes[i] == 0x7F))
            return 0;
    }
    return line;
}

static enum zr_status read_any(struct zr_scene_builder *builder, const struct zr_request *request,
                               const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error)
{
    const char *bytes = request->bytes;
    const size_t size = request->size;
    if (!is_binary(bytes, size) && zr_stl_is_text(bytes, size))
        return zr_stl_text_read(builder, request, limits, out, error);
    if (size < COUNT_END)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL,
                            "neither 'solid' nor a binary header: at least %d bytes expected, got %zu", COUNT_END,
                            size);
    const uint32_t count = read_u32(bytes + HEADER_BYTES);
    const uint64_t wanted = size_wanted(bytes);
    const size_t line = text_header_line(bytes);
    if (wanted > size && line > 0)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "neither 'solid' nor a binary header: the text begins with %s",
                            zr_quote(bytes, line).text);
    if (wanted > size || (count == 0 && wanted < size))
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "%llu bytes expected for %u triangles, got %zu; they hold %zu",
                            (unsigned long long)wanted, count, size, (size - COUNT_END) / TRIANGLE_BYTES);
    if (count > ZR_STL_TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%u triangles, more than the limit of %d", count,
                            ZR_STL_TRIANGLES_MAX);
    if (wanted < size)
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "STL: %llu byte%s behind the last of %u triangles ignored",
                            (unsigned long long)(size - wanted), size - wanted == 1 ? "" : "s", count);
    return read_binary_file(builder, request, limits, out, error);
}

enum zr_status zr_read_STL(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_stl stl = {0};
    const enum zr_status status = read_any(builder, request, limits, &stl, error);
    if (status != ZR_OK) return status;
    if (stl.facets == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "no geometry: the STL file has no triangle");
    struct zr_mesh *mesh = zr_scene_builder_meshes(builder, 1);
    if (!mesh) return ZR_NO_MEMORY;
    mesh->position_count = (uint32_t)stl.vertices;
    mesh->positions = stl.positions;
    mesh->face_count = (uint32_t)stl.facets;
    mesh->indices = stl.indices;
    mesh->face_offsets = stl.offsets;
    mesh->face_colors = stl.face_colors;
    return ZR_OK;
}
