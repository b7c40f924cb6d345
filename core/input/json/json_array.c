#include "input/json/json_array.h"

#include <stdio.h>
#include <string.h>

#include "input/formats/quick.h"
#include "input/json/json_bytes.h"
#include "input/json/npy_read.h"
#include "input/text/color_text.h"
#include "input/text/parts.h"
#include "input/text/recenter.h"

/* PART_NUMBERS: numbers between two checks for cancellation, whole rows of three, some 20 us of work. TEAM_NUMBERS:
 * smaller arrays are read by one thread. ROWS_MAX: kernels gather rows by 32-bit offsets. */
enum { PART_NUMBERS = 3 << 13, TEAM_NUMBERS = 1 << 16, ROWS_MAX = (1 << 29) - 1 };

/* ---- finding an array ---- */

/* Formats a shape as numpy does: (5,), (5, 2). */
static void write_shape(const struct zr_array *numbers, char text[96])
{
    size_t used = 0;
    for (size_t i = 0; i < numbers->ndim; i++)
        used += (size_t)snprintf(text + used, 96 - used, "%s%zu", i > 0 ? ", " : "(", numbers->shape[i]);
    snprintf(text + used, 96 - used, numbers->ndim == 1 ? ",)" : ")");
}

static bool refuse_shape(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_array *array)
{
    const struct zr_array_wanted *wanted = array->wanted;
    char shape[96], needed[64];
    write_shape(&array->numbers, shape);
    if (wanted->most == 1)
        snprintf(needed, sizeof needed, "(n,) is");
    else if (wanted->rows > 0)
        snprintf(needed, sizeof needed, "(%zu, %zu) is", wanted->rows, wanted->most);
    else if (wanted->least == wanted->most)
        snprintf(needed, sizeof needed, "(n, %zu) is", wanted->least);
    else if (wanted->most == wanted->least + 1)
        snprintf(needed, sizeof needed, "(n, %zu) or (n, %zu) is", wanted->least, wanted->most);
    else
        snprintf(needed, sizeof needed, "(n, m) with m from %zu to %zu is", wanted->least, wanted->most);
    return zr_json_fault(json, path, "the array's shape is %s; %s needed", shape, needed);
}

/* Finds rows and columns. Checks them and the type. */
static bool check_form(struct zr_json *json, const struct zr_json_path *path, struct zr_json_array *array)
{
    const struct zr_array_wanted *wanted = array->wanted;
    const struct zr_array *numbers = &array->numbers;
    if (wanted->of && numbers->type <= ZR_F8)
        return zr_json_fault(json, path, "the array's type is %s; indices need u1, i4, u4, i8 or u8",
                             zr_number_name(numbers->type));
    array->rows = numbers->shape[0];
    array->columns = numbers->ndim > 1 ? numbers->shape[1] : 1;
    if (numbers->ndim > 2 || (numbers->ndim == 1 && wanted->most > 1) || array->columns < wanted->least ||
        array->columns > wanted->most || (wanted->rows > 0 && array->rows != wanted->rows))
        return refuse_shape(json, path, array);
    if (array->rows > ROWS_MAX || array->rows * array->columns > UINT32_MAX)
        return zr_json_fault(json, path, "%zu rows of %zu numbers are too many", array->rows, array->columns);
    return true;
}

bool zr_json_has_time(struct zr_json *json, size_t bytes)
{
    struct zr_parsed_assets *assets = json->assets;
    assets->array_bytes += bytes;
    if (!assets->quick || assets->array_bytes <= assets->quick->array_bytes_max) return true;
    zr_quick_exceed(assets->quick, json->error);
    return false;
}

bool zr_json_array_open(struct zr_json *json, const struct zr_json_path *path, const struct zr_array_wanted *wanted,
                        struct zr_json_array *array)
{
    struct zr_asset asset;
    struct zr_reason reason;
    size_t bytes;
    if (json->is_ahead) zr_json_give_up(json); /* only the caller's thread reads assets and notes their use */
    if (json->is_ahead) return false;
    if (!json->assets) return zr_json_expect(json, path, "a list");
    if (!zr_parsed_read_asset(json, path, &asset)) return false;
    if (asset.array.type == ZR_BYTES && !zr_npy_open(asset.bytes, asset.size, &asset.array, &reason))
        return zr_json_fault(json, path, "%s", reason.text);
    *array = (struct zr_json_array){.wanted = wanted, .numbers = asset.array, .is_lent = asset.is_lent};
    return check_form(json, path, array) && zr_array_bytes(&array->numbers, &bytes) && zr_json_has_time(json, bytes);
}

/* ---- reading numbers ---- */

/* Read numbers of a type T, compared as type R. Load by memcpy, since NPY data may have any alignment. False if one is
 * out of range. */
#define FLOATS(name, T, R, VALUE)                                                                                      \
    static bool floats_of_##name(const char *from, size_t count, const struct zr_array_wanted *wanted, float *to)      \
    {                                                                                                                  \
        const R low = (R)wanted->low, high = (R)wanted->high;                                                          \
        const int holes = wanted->has_holes;                                                                           \
        int wrong = 0;                                                                                                 \
        for (size_t i = 0; i < count; i++) {                                                                           \
            T number;                                                                                                  \
            memcpy(&number, from + i * sizeof number, sizeof number);                                                  \
            const R value = VALUE;                                                                                     \
            wrong |= !((value >= low) & (value <= high)) & !(holes & (value != value));                                \
            to[i] = (float)value;                                                                                      \
        }                                                                                                              \
        return !wrong;                                                                                                 \
    }
FLOATS(f4, float, float, number)
FLOATS(f8, double, double, number)
FLOATS(u1, uint8_t, double, number)
FLOATS(i4, int32_t, double, number)
FLOATS(u4, uint32_t, double, number)
FLOATS(i8, int64_t, double, (double)number)
FLOATS(u8, uint64_t, double, (double)number)
FLOATS(color, uint8_t, float, zr_color_channel(number))
#undef FLOATS

typedef bool read_floats_fn(const char *from, size_t count, const struct zr_array_wanted *wanted, float *to);
static read_floats_fn *const float_readers[ZR_NUMBER_TYPES] = {NULL,         floats_of_f4, floats_of_f8, floats_of_u1,
                                                               floats_of_i4, floats_of_u4, floats_of_i8, floats_of_u8};

/* Read integers; those beyond 32 bits are cut. False if one is. */
#define INDICES(name, T)                                                                                               \
    static bool indices_of_##name(const char *from, size_t count, uint32_t *to)                                        \
    {                                                                                                                  \
        int wrong = 0;                                                                                                 \
        for (size_t i = 0; i < count; i++) {                                                                           \
            T number;                                                                                                  \
            memcpy(&number, from + i * sizeof number, sizeof number);                                                  \
            const uint64_t wide = (uint64_t)number;                                                                    \
            wrong |= wide > UINT32_MAX;                                                                                \
            to[i] = (uint32_t)number;                                                                                  \
        }                                                                                                              \
        return !wrong;                                                                                                 \
    }
INDICES(u1, uint8_t)
INDICES(i4, int32_t)
INDICES(u4, uint32_t)
INDICES(i8, int64_t)
INDICES(u8, uint64_t)
#undef INDICES

typedef bool read_indices_fn(const char *from, size_t count, uint32_t *to);
static read_indices_fn *const index_readers[ZR_NUMBER_TYPES] = {
    NULL, NULL, NULL, indices_of_u1, indices_of_i4, indices_of_u4, indices_of_i8, indices_of_u8};

/* Returns a number as the same list in JSON gives it. */
static double number_at(const struct zr_json_array *array, size_t i)
{
    const char *at = (const char *)array->numbers.data + i * zr_number_bytes(array->numbers.type);
    union {
        float f4;
        double f8;
        uint8_t u1;
        int32_t i4;
        uint32_t u4;
        int64_t i8;
        uint64_t u8;
    } v;
    memcpy(&v, at, zr_number_bytes(array->numbers.type));
    switch (array->numbers.type) {
    case ZR_F4:
        return (double)v.f4;
    case ZR_F8:
        return v.f8;
    case ZR_U1:
        return array->wanted->is_color ? (double)zr_color_channel(v.u1) : (double)v.u1;
    case ZR_I4:
        return (double)v.i4;
    case ZR_U4:
        return (double)v.u4;
    case ZR_I8:
        return (double)v.i8;
    default:
        return (double)v.u8;
    }
}

/* ---- parts ---- */

struct reading {
    const struct zr_json_array *array;
    size_t count; /* numbers */
    bool is_widened;
    void *to; /* NULL: floats are only checked */
};

static const char *place_of(const struct reading *r, size_t number)
{
    return (const char *)r->array->numbers.data + number * zr_number_bytes(r->array->numbers.type);
}

/* Reads a few floats at a time. Appends 1 to rows of three. */
static bool read_in_blocks(const struct reading *r, read_floats_fn *read, size_t first, size_t end)
{
    float block[3 * 256];
    bool good = true;
    for (size_t at = first; at < end; at += sizeof block / sizeof *block) {
        const size_t left = end - at, count = left < sizeof block / sizeof *block ? left : sizeof block / sizeof *block;
        good &= read(place_of(r, at), count, r->array->wanted, block);
        zr_vec4 *rows = r->to ? (zr_vec4 *)r->to + at / 3 : NULL;
        for (size_t i = 0; rows && i < count / 3; i++)
            rows[i] = (zr_vec4){block[3 * i], block[3 * i + 1], block[3 * i + 2], 1.0f};
    }
    return good;
}

static bool read_floats(const struct reading *r, size_t first, size_t end)
{
    const bool is_color = r->array->wanted->is_color && r->array->numbers.type == ZR_U1;
    read_floats_fn *read = is_color ? floats_of_color : float_readers[r->array->numbers.type];
    if (r->is_widened || !r->to) return read_in_blocks(r, read, first, end);
    return read(place_of(r, first), end - first, r->array->wanted, (float *)r->to + first);
}

/* Without unsigned comparisons, which SSE2 lacks: the top bit of an index or of its distance to the last is set. */
static bool are_below(const uint32_t *indices, size_t count, uint32_t limit)
{
    uint32_t most = 0, tops = 0;
    if (limit == 0) return count == 0;
    if (limit <= (uint32_t)INT32_MAX + 1) {
        for (size_t i = 0; i < count; i++)
            tops |= indices[i] | (limit - 1 - indices[i]);
        return !(tops >> 31);
    }
    for (size_t i = 0; i < count; i++)
        most = indices[i] > most ? indices[i] : most;
    return most < limit;
}

/* Copies indices, then checks the copies, which no caller changes. */
static bool read_indices(const struct reading *r, size_t first, size_t end)
{
    uint32_t *to = (uint32_t *)r->to + first;
    const bool is_there = r->to == r->array->numbers.data;
    return (is_there || index_readers[r->array->numbers.type](place_of(r, first), end - first, to)) &&
           are_below(to, end - first, r->array->wanted->end);
}

static bool read_part(void *context, size_t part)
{
    const struct reading *r = context;
    const size_t first = part * PART_NUMBERS, left = r->count - first;
    const size_t end = first + (left < PART_NUMBERS ? left : PART_NUMBERS);
    return r->array->wanted->of ? read_indices(r, first, end) : read_floats(r, first, end);
}

/* Reports the numbers that are wrong, from number `first` on. */
static void report(struct zr_json *json, const struct zr_json_path *path, const struct reading *r, size_t first)
{
    const struct zr_array_wanted *wanted = r->array->wanted;
    const size_t faults = json->error->count;
    for (size_t i = first; i < r->count; i++) {
        const struct zr_json_path *row = ZR_JSON_ITEM(path, i / r->array->columns);
        const struct zr_json_path *at = wanted->most == 1 ? row : ZR_JSON_ITEM(row, i % r->array->columns);
        const double value = number_at(r->array, i);
        if (i % PART_NUMBERS == 0) zr_json_look(json);
        if (zr_json_stops(json)) return;
        if (wanted->of)
            zr_json_check_index(json, at, value, wanted->end, wanted->of);
        else if (!(wanted->has_holes && value != value))
            zr_json_check_range(json, at, wanted->low, wanted->high, value);
    }
    if (!zr_json_failed_since(json, faults)) zr_json_fault(json, path, "the array changed while it was read");
}

static bool read_parts(struct zr_json *json, const struct zr_json_path *path, struct reading *r)
{
    const size_t parts = (r->count + PART_NUMBERS - 1) / PART_NUMBERS;
    struct zr_team *team = r->count < TEAM_NUMBERS ? NULL : json->team;
    const size_t read = zr_parts_read(team, json->cancel, 0, parts, read_part, r);
    zr_json_look(json);
    if (read == parts || zr_json_stops(json)) return read == parts;
    report(json, path, r, read * PART_NUMBERS);
    return false;
}

/* Makes room for `items` more, or uses the numbers in place. NULL without memory. */
static void *make_room(struct zr_json *json, const struct zr_json_array *array, bool may_stay, size_t items,
                       struct zr_growing *out)
{
    const bool stays = may_stay && array->is_lent && !array->wanted->is_changed && items > 0 && out->count == 0 &&
                       (uintptr_t)array->numbers.data % sizeof(float) == 0;
    if (stays) {
        out->items = (void *)(uintptr_t)array->numbers.data;
        out->room = items;
    } else if (!zr_growing_reserve(out, json, items > 0 ? items : 1)) {
        return NULL;
    }
    void *to = (char *)out->items + out->count * out->size;
    out->count += items;
    return to;
}

/* Replaces positions by those minus the move of a far scene. */
static bool move_rows(struct zr_json *json, const struct zr_json_array *array, zr_vec4 *to)
{
    for (size_t i = 0; i < array->rows; i++) {
        const size_t at = i * array->columns;
        const double v[3] = {number_at(array, at), number_at(array, at + 1), number_at(array, at + 2)};
        to[i] = zr_far_position(json->move, v, array->columns == 4 ? number_at(array, at + 3) : 1.0);
        if (i % PART_NUMBERS == 0) zr_json_look(json);
        if (zr_json_stops(json)) return false;
    }
    return true;
}

bool zr_json_array_floats(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_array *array,
                          struct zr_growing *out)
{
    struct reading r = {.array = array, .count = array->rows * array->columns};
    r.is_widened = array->columns == 3 && out->size == sizeof(zr_vec4);
    const size_t items = r.is_widened ? array->rows : r.count * sizeof(float) / out->size;
    r.to = make_room(json, array, array->numbers.type == ZR_F4 && !r.is_widened, items, out);
    if (!r.to) return false;
    if (r.to == array->numbers.data) r.to = NULL;
    if (!read_parts(json, path, &r)) return false;
    return !(json->move && array->wanted->is_place) || move_rows(json, array, r.to);
}

bool zr_json_array_indices(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_array *array,
                           struct zr_growing *out)
{
    struct reading r = {.array = array, .count = array->rows * array->columns};
    const bool may_stay =
        array->numbers.type == ZR_U4 || (array->numbers.type == ZR_I4 && array->wanted->end <= (uint32_t)INT32_MAX + 1);
    r.to = make_room(json, array, may_stay, r.count * sizeof(uint32_t) / out->size, out);
    return r.to && read_parts(json, path, &r);
}

bool zr_json_array_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_array_wanted *wanted,
                        struct zr_growing *out)
{
    struct zr_json_array array;
    return zr_json_array_open(json, path, wanted, &array) && zr_json_array_floats(json, path, &array, out);
}

bool zr_json_array_square(struct zr_json *json, const struct zr_json_path *path, size_t side, double limit, double *out)
{
    const struct zr_array_wanted wanted = {.rows = side, .least = side, .most = side};
    struct zr_json_array array;
    bool good = true;
    if (!zr_json_array_open(json, path, &wanted, &array)) return false;
    for (size_t i = 0; i < side * side; i++) {
        out[i] = number_at(&array, i);
        good &= zr_json_check_range(json, ZR_JSON_ITEM(ZR_JSON_ITEM(path, i / side), i % side), -limit, limit, out[i]);
    }
    return good;
}
