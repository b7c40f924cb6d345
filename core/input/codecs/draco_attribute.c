/* Attributes of Draco meshes: their descriptions, their integers, and the numbers that these stand for. */
#include "input/codecs/draco_mesh.h"

#include <string.h>

/* Attributes that share an order of values. */
struct group {
    uint32_t first, count;
    struct zr_draco_order order;
};

/* ---- descriptions ---- */

size_t zr_draco_type_bytes(int type)
{
    static const size_t bytes[] = {
        [ZR_DRACO_INT8] = 1,  [ZR_DRACO_UINT8] = 1,  [ZR_DRACO_INT16] = 2,  [ZR_DRACO_UINT16] = 2,
        [ZR_DRACO_INT32] = 4, [ZR_DRACO_UINT32] = 4, [ZR_DRACO_FLOAT32] = 4};
    return type >= 0 && (size_t)type < sizeof bytes / sizeof *bytes ? bytes[type] : 0;
}

static bool read_description(struct zr_draco *draco, struct zr_draco_attribute *made, struct zr_draco_values *of)
{
    struct zr_draco_stream *stream = &draco->stream;
    of->made = made;
    of->kind = zr_draco_u8(stream);
    made->type = (int)zr_draco_u8(stream);
    made->width = zr_draco_u8(stream);
    made->is_normalized = zr_draco_u8(stream) > 0;
    made->id = zr_draco_count(stream);
    if (stream->is_broken) return false;
    if (zr_draco_type_bytes(made->type) == 0)
        return zr_draco_refuse(draco, "attribute %u has numbers of the type %d, which is not read", made->id,
                               made->type);
    return (made->width > 0 && made->width <= ZR_DRACO_WIDTH) ||
           zr_draco_refuse(draco, "attribute %u has %u numbers per point; 1 to %d are read", made->id, made->width,
                           ZR_DRACO_WIDTH);
}

static bool read_coder(struct zr_draco *draco, struct zr_draco_values *of)
{
    const struct zr_draco_attribute *made = of->made;
    of->coder = zr_draco_u8(&draco->stream);
    of->width = of->coder == ZR_DRACO_NORMAL ? 2 : made->width;
    if (draco->stream.is_broken) return false;
    if (of->coder > ZR_DRACO_NORMAL)
        return zr_draco_refuse(draco, "attribute %u has the unknown coder %u", made->id, of->coder);
    if (of->coder == ZR_DRACO_NORMAL && made->width != 3) return false;
    return (of->coder < ZR_DRACO_QUANTIZED || made->type == ZR_DRACO_FLOAT32) &&
           (of->coder != ZR_DRACO_INTEGER || made->type != ZR_DRACO_FLOAT32);
}

static bool read_descriptions(struct zr_draco *draco, struct group *group)
{
    struct zr_draco_mesh *mesh = draco->mesh;
    const uint32_t count = zr_draco_count(&draco->stream);
    if (count == 0) return false;
    if (count > ZR_DRACO_ATTRIBUTES - mesh->attribute_count)
        return zr_draco_refuse(draco, "%u attributes; %d are read", mesh->attribute_count + count, ZR_DRACO_ATTRIBUTES);
    group->first = mesh->attribute_count;
    group->count = count;
    mesh->attribute_count += count;
    for (uint32_t i = group->first; i < group->first + count; i++)
        if (!read_description(draco, &mesh->attributes[i], &draco->values[i])) return false;
    for (uint32_t i = group->first; i < group->first + count; i++)
        if (!read_coder(draco, &draco->values[i])) return false;
    return true;
}

/* ---- orders ---- */

/* The table and the walk of a group. */
struct place {
    const struct zr_draco_corners *of; /* NULL: sequential */
    bool by_degree;
};

/* Reads the table and the walk of a group. used: tables that other groups have; bit i: seams[i], the last one: base. */
static bool read_place(struct zr_draco *draco, uint64_t *used, struct place *out)
{
    enum { VERTICES, CORNERS, DEPTH_FIRST = 0, BY_DEGREE };
    *out = (struct place){NULL, false};
    if (!draco->has_table) return true;
    const uint32_t number = zr_draco_u8(&draco->stream), kind = zr_draco_u8(&draco->stream),
                   walk = zr_draco_u8(&draco->stream);
    const bool is_base = number >= 128; /* a negative number */
    const uint64_t bit = UINT64_C(1) << (is_base ? ZR_DRACO_ATTRIBUTES : number % ZR_DRACO_ATTRIBUTES);
    if (draco->stream.is_broken || (!is_base && number >= draco->seam_count) || *used & bit || walk > BY_DEGREE ||
        (kind != VERTICES && (is_base || walk != DEPTH_FIRST)))
        return false;
    *used |= bit;
    *out = (struct place){kind == VERTICES ? &draco->base : &draco->seams[number], walk == BY_DEGREE};
    return true;
}

/* ---- values ---- */

/* Reads what the integers stand for. */
static bool read_scale(struct zr_draco *draco, struct zr_draco_values *of)
{
    enum { BITS_MOST = 30 };
    struct zr_draco_stream *stream = &draco->stream;
    struct zr_draco_octahedron octahedron;
    if (of->coder == ZR_DRACO_QUANTIZED) {
        of->bytes = zr_draco_take(stream, 4 * of->width);
        const uint32_t range = zr_draco_u32(stream);
        memcpy(&of->range, &range, sizeof range);
        of->bits = zr_draco_u8(stream);
        return !stream->is_broken && of->bits >= 1 && of->bits <= BITS_MOST;
    }
    if (of->coder != ZR_DRACO_NORMAL) return true;
    of->bits = zr_draco_u8(stream);
    return !stream->is_broken && zr_draco_octahedron_set(of->bits, &octahedron);
}

static bool read_values(struct zr_draco *draco, struct zr_draco_values *of)
{
    if (of->coder != ZR_DRACO_GENERIC) return zr_draco_read_integers(draco, of);
    const size_t size = of->made->width * zr_draco_type_bytes(of->made->type);
    of->bytes = zr_draco_take(&draco->stream, (uint64_t)size * of->order->count);
    return of->bytes;
}

static void put(unsigned char *out, size_t bytes, uint32_t number)
{
    for (size_t k = 0; k < bytes; k++)
        out[k] = (unsigned char)(number >> 8 * k & 0xFF);
}

static void put_float(unsigned char *out, float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put(out, sizeof bits, bits);
}

/* Writes the numbers of one value. */
static void put_value(const struct zr_draco_values *of, const float *lows, uint32_t value, unsigned char *out)
{
    const struct zr_draco_attribute *made = of->made;
    const size_t bytes = zr_draco_type_bytes(made->type);
    if (of->coder == ZR_DRACO_GENERIC) {
        memcpy(out, of->bytes + (size_t)value * made->width * bytes, made->width * bytes);
        return;
    }
    const int32_t *integers = of->integers + (size_t)value * of->width;
    if (of->coder == ZR_DRACO_INTEGER) {
        for (uint32_t k = 0; k < made->width; k++)
            put(out + k * bytes, bytes, (uint32_t)integers[k]);
    } else if (of->coder == ZR_DRACO_QUANTIZED) {
        const float step = of->range / (float)((1 << of->bits) - 1);
        for (uint32_t k = 0; k < made->width; k++)
            put_float(out + k * bytes, (float)integers[k] * step + lows[k]);
    } else {
        const struct zr_draco_octahedron octahedron = {.center = (1 << (of->bits - 1)) - 1};
        float vector[3];
        zr_draco_octahedron_vector(&octahedron, integers, vector);
        for (uint32_t k = 0; k < 3; k++)
            put_float(out + k * bytes, vector[k]);
    }
}

/* Writes the numbers of all points. */
static bool put_values(struct zr_draco *draco, struct zr_draco_values *of)
{
    struct zr_draco_attribute *made = of->made;
    const size_t size = made->width * zr_draco_type_bytes(made->type), count = draco->mesh->point_count;
    unsigned char *out = zr_arena_alloc_beside(draco->arena, &draco->scratch, count, size);
    float lows[ZR_DRACO_WIDTH] = {0};
    if (!out) return false;
    for (uint32_t k = 0; of->coder == ZR_DRACO_QUANTIZED && k < of->width; k++) {
        struct zr_draco_stream low = {of->bytes + 4 * k, of->bytes + 4 * k + 4, false};
        const uint32_t bits = zr_draco_u32(&low);
        memcpy(&lows[k], &bits, sizeof bits);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (zr_draco_stops(draco)) return false;
        put_value(of, lows, of->order->of ? of->order->of_point[i] : i, out + i * size);
    }
    made->values = out;
    return true;
}

static bool read_group(struct zr_draco *draco, const struct place *place, struct group *group)
{
    const uint32_t end = group->first + group->count;
    if (place->of && !zr_draco_make_order(draco, place->of, place->by_degree, &group->order)) return false;
    if (!place->of) group->order = (struct zr_draco_order){.count = draco->mesh->point_count};
    for (uint32_t i = group->first; i < end; i++) {
        draco->values[i].order = &group->order;
        if (!read_values(draco, &draco->values[i])) return false;
    }
    for (uint32_t i = group->first; i < end; i++)
        if (!read_scale(draco, &draco->values[i])) return false;
    for (uint32_t i = group->first; i < end; i++)
        if (!put_values(draco, &draco->values[i])) return false;
    return true;
}

bool zr_draco_read_attributes(struct zr_draco *draco)
{
    const uint32_t count = zr_draco_u8(&draco->stream);
    struct place places[ZR_DRACO_ATTRIBUTES];
    uint64_t used = 0;
    if (count > ZR_DRACO_ATTRIBUTES)
        return zr_draco_refuse(draco, "%u groups of attributes; %d are read", count, ZR_DRACO_ATTRIBUTES);
    struct group *groups = zr_arena_zero(&draco->scratch, count, sizeof *groups);
    if (!groups) return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_place(draco, &used, &places[i])) return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_descriptions(draco, &groups[i])) return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_group(draco, &places[i], &groups[i])) return false;
    return !draco->stream.is_broken;
}
