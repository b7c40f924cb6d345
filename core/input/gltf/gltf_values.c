/* Converts elements of accessors of glTF to floats and indices. Source: glTF 2.0, sections 3.6.2 and 3.11. */
#include "input/gltf/gltf_file.h"

#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "base/inlined.h"

/* Elements between checks for cancellation: about 20 microseconds. */
enum { AT_ONCE = 4096, WIDTH_MAX = 16 };

/* ---- numbers ---- */

static uint16_t read_u16(const unsigned char *at)
{
    return (uint16_t)(at[0] | at[1] << 8);
}

static uint32_t read_u32(const unsigned char *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static float read_f32(const unsigned char *at)
{
    const uint32_t bits = read_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The two lowest signed integers both stand for -1. */
static float at_least_minus_one(float value)
{
    return value < -1.0f ? -1.0f : value;
}

ZR_INLINED float read_number(const unsigned char *at, uint32_t type, bool is_normalized)
{
    switch (type) {
    case ZR_GLTF_INT8: {
        const float value = (float)(int8_t)at[0];
        return is_normalized ? at_least_minus_one(value / 127.0f) : value;
    }
    case ZR_GLTF_UINT8:
        return is_normalized ? (float)at[0] / 255.0f : (float)at[0];
    case ZR_GLTF_INT16: {
        const float value = (float)(int16_t)read_u16(at);
        return is_normalized ? at_least_minus_one(value / 32767.0f) : value;
    }
    case ZR_GLTF_UINT16:
        return is_normalized ? (float)read_u16(at) / 65535.0f : (float)read_u16(at);
    case ZR_GLTF_UINT32:
        return is_normalized ? (float)((double)read_u32(at) / 4294967295.0) : (float)read_u32(at);
    default:
        return read_f32(at);
    }
}

static uint32_t read_index(const unsigned char *at, uint32_t type)
{
    return type == ZR_GLTF_UINT8 ? at[0] : type == ZR_GLTF_UINT16 ? read_u16(at) : read_u32(at);
}

/* ---- floats ---- */

/* Elements of one type. */
struct elements {
    const unsigned char *at;
    size_t stride;
    uint32_t type, width;
    bool is_normalized;
};

/* Reads `count` elements. It is inlined per type and width, so that frequent ones become short loops. */
ZR_INLINED void read_elements(struct elements of, uint32_t count, float *out, size_t step)
{
    const size_t size = zr_gltf_type_bytes(of.type);
    for (uint32_t i = 0; i < count; i++, of.at += of.stride, out += step)
        for (uint32_t k = 0; k < of.width; k++)
            out[k] = read_number(of.at + k * size, of.type, of.is_normalized);
}

static void read_run(const struct zr_gltf_values *values, const unsigned char *at, uint32_t count, float *out,
                     size_t step)
{
    const uint32_t type = values->accessor->type;
    if (type == ZR_GLTF_FLOAT32 && values->width == 3)
        read_elements((struct elements){at, values->stride, ZR_GLTF_FLOAT32, 3, false}, count, out, step);
    else if (type == ZR_GLTF_FLOAT32 && values->width == 2)
        read_elements((struct elements){at, values->stride, ZR_GLTF_FLOAT32, 2, false}, count, out, step);
    else
        read_elements((struct elements){at, values->stride, type, values->width, values->is_normalized}, count, out,
                      step);
}

static void put_zeros(uint32_t width, uint32_t count, float *out, size_t step)
{
    for (uint32_t i = 0; i < count; i++, out += step)
        for (uint32_t k = 0; k < width; k++)
            out[k] = 0.0f;
}

/* Returns the first element with a number beyond the limit or not finite, else `count`. */
static uint32_t find_bad(const float *at, size_t step, uint32_t width, uint32_t count, float limit)
{
    for (uint32_t i = 0; i < count; i++, at += step) {
        bool good = true;
        for (uint32_t k = 0; k < width; k++)
            good = at[k] >= -limit && at[k] <= limit && good; /* false for a NaN */
        if (!good) return i;
    }
    return count;
}

static const struct zr_json_path *path_of(const struct zr_gltf_values *values, struct zr_json_path room[2])
{
    room[0] = *ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_ACCESSORS));
    room[1] = *ZR_JSON_ITEM(&room[0], values->number);
    return &room[1];
}

static bool refuse(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t element, const float *at)
{
    const double limit = values->limit;
    struct zr_json_path room[2];
    for (uint32_t k = 0; k < values->width; k++)
        if (!((double)at[k] >= -limit && (double)at[k] <= limit))
            return zr_json_fault(&file->json, path_of(values, room),
                                 "element %u of %u has %.9g; magnitudes up to %.9g are allowed", element, values->count,
                                 (double)at[k], limit);
    return false;
}

/* Sets an element to 0, or makes it a hole, if it has a number that is not finite. */
static bool mend(struct zr_gltf *file, const struct zr_gltf_values *values, float *at)
{
    struct zr_json_path room[2];
    bool is_finite = true;
    for (uint32_t k = 0; k < values->width; k++)
        is_finite = is_finite && isfinite(at[k]);
    if (is_finite || !(values->mends || values->holes)) return false;
    zr_gltf_note(values->holes ? &file->holes : &file->not_finite, path_of(values, room));
    put_zeros(values->width, 1, at, values->width);
    if (values->holes) at[0] = NAN;
    return true;
}

/* Checks `count` elements, the first of which has the number `first`. */
static bool check_run(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t first, uint32_t count,
                      float *out, size_t step)
{
    for (uint32_t i = 0; i < count; i++) {
        i += find_bad(out + i * step, step, values->width, count - i, (float)values->limit);
        if (i < count && !mend(file, values, out + i * step)) return refuse(file, values, first + i, out + i * step);
    }
    return true;
}

/* Reports a sparse index that is too large, or not above the index before it. */
static bool refuse_sparse(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t k, uint32_t index)
{
    struct zr_json_path room[2];
    return zr_json_fault(&file->json, ZR_JSON_KEY(path_of(values, room), "sparse"),
                         "index %u is %u, of %u elements; indices must rise", k, index, values->count);
}

/* Puts the sparse elements of the range. */
static bool put_sparse(struct zr_gltf *file, const struct zr_gltf_values *values, const struct zr_gltf_range *range,
                       float *out, size_t step)
{
    const struct zr_gltf_accessor *accessor = values->accessor;
    const struct zr_gltf_sparse *sparse = &accessor->sparse;
    const size_t size = values->width * zr_gltf_type_bytes(accessor->type);
    for (uint32_t k = 0, before = 0; k < sparse->count; k++) {
        const size_t index_size = zr_gltf_type_bytes(sparse->indices_type);
        const uint32_t index = read_index(values->sparse_indices + k * index_size, sparse->indices_type);
        if (index >= values->count || (k > 0 && index <= before)) return refuse_sparse(file, values, k, index);
        before = index;
        const struct elements of = {values->sparse_values + k * size, size, accessor->type, values->width,
                                    values->is_normalized};
        if (index >= range->first && index - range->first < range->count)
            read_elements(of, 1, out + (index - range->first) * step, step);
        if (k % AT_ONCE == AT_ONCE - 1 && zr_is_cancelled(file->json.cancel)) return false;
    }
    return true;
}

bool zr_gltf_read_floats(struct zr_gltf *file, const struct zr_gltf_values *values, const struct zr_gltf_range *range,
                         float *out, size_t step)
{
    const uint32_t first = range->first, count = range->count;
    for (uint32_t at = 0; at < count; at += AT_ONCE) {
        const uint32_t run = count - at < AT_ONCE ? count - at : AT_ONCE;
        if (zr_is_cancelled(file->json.cancel)) return false;
        if (values->bytes)
            read_run(values, values->bytes + (size_t)(first + at) * values->stride, run, out + at * step, step);
        else
            put_zeros(values->width, run, out + at * step, step);
    }
    if (values->sparse_indices && !put_sparse(file, values, range, out, step)) return false;
    for (uint32_t at = 0; at < count; at += AT_ONCE) {
        const uint32_t run = count - at < AT_ONCE ? count - at : AT_ONCE;
        if (!check_run(file, values, first + at, run, out + at * step, step)) return false;
        if (zr_is_cancelled(file->json.cancel)) return false;
    }
    return true;
}

/* ---- indices ---- */

static bool put_sparse_indices(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t *out)
{
    const struct zr_gltf_accessor *accessor = values->accessor;
    const struct zr_gltf_sparse *sparse = &accessor->sparse;
    const size_t size = zr_gltf_type_bytes(accessor->type), index_size = zr_gltf_type_bytes(sparse->indices_type);
    for (uint32_t k = 0, before = 0; k < sparse->count; k++) {
        const uint32_t index = read_index(values->sparse_indices + k * index_size, sparse->indices_type);
        if (index >= values->count || (k > 0 && index <= before)) return refuse_sparse(file, values, k, index);
        before = index;
        out[index] = read_index(values->sparse_values + k * size, accessor->type);
    }
    return true;
}

static void copy_indices(const struct zr_gltf_values *values, uint32_t first, uint32_t count, uint32_t *out)
{
    const unsigned char *at = values->bytes + (size_t)first * values->stride;
    const uint32_t type = values->accessor->type;
    if (type == ZR_GLTF_UINT8)
        for (uint32_t i = 0; i < count; i++)
            out[i] = at[i * values->stride];
    else if (type == ZR_GLTF_UINT16)
        for (uint32_t i = 0; i < count; i++)
            out[i] = read_u16(at + i * values->stride);
    else
        for (uint32_t i = 0; i < count; i++)
            out[i] = read_u32(at + i * values->stride);
}

/* Returns the largest index of a type, which OpenGL and others take as the restart of a strip. */
static uint32_t most_of(uint32_t type)
{
    return type == ZR_GLTF_UINT8 ? UINT8_MAX : type == ZR_GLTF_UINT16 ? UINT16_MAX : UINT32_MAX;
}

bool zr_gltf_read_indices(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t end, uint32_t *out,
                          struct zr_gltf_range *range)
{
    const uint32_t type = values->accessor->type;
    struct zr_json_path room[2];
    uint32_t low = UINT32_MAX, high = 0;
    if (values->width != 1 || (type != ZR_GLTF_UINT8 && type != ZR_GLTF_UINT16 && type != ZR_GLTF_UINT32))
        return zr_json_fault(&file->json, path_of(values, room),
                             "indices are SCALAR with the componentType 5121, 5123 or 5125");
    for (uint32_t at = 0; at < values->count; at += AT_ONCE) {
        const uint32_t run = values->count - at < AT_ONCE ? values->count - at : AT_ONCE;
        if (zr_is_cancelled(file->json.cancel)) return false;
        if (values->bytes)
            copy_indices(values, at, run, out + at);
        else
            memset(out + at, 0, run * sizeof *out);
    }
    if (values->sparse_indices && !put_sparse_indices(file, values, out)) return false;
    for (uint32_t i = 0; i < values->count; i++) {
        low = out[i] < low ? out[i] : low;
        high = out[i] > high ? out[i] : high;
    }
    *range = values->count == 0 ? (struct zr_gltf_range){0, 0} : (struct zr_gltf_range){low, high - low + 1};
    if (high < end || values->count == 0) return true;
    uint32_t bad = 0;
    while (out[bad] < end)
        bad++;
    return zr_json_fault(&file->json, path_of(values, room), "index %u is %u, of %u vertices%s", bad, out[bad], end,
                         out[bad] == most_of(type) ? "; glTF has no primitive restart" : "");
}
