#include "input/json/npy_read.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

enum { PREFIX = 8, SIDES_MAX = ZR_ARRAY_SIDES_MAX };

static const char MAGIC[] = "\x93NUMPY";

/* The text of the dictionary while it is parsed, and its values. */
struct header {
    const char *at, *end;
    const char *type; /* between its quotes; NULL: not read yet */
    size_t type_size;
    bool has_order, fortran, has_shape;
    size_t sides; /* may exceed SIDES_MAX; `shape` has the first SIDES_MAX */
    uint64_t shape[SIDES_MAX];
};

static void skip_space(struct header *h)
{
    while (h->at < h->end && (*h->at == ' ' || *h->at == '\t' || *h->at == '\n' || *h->at == '\r'))
        h->at++;
}

static bool take(struct header *h, char c)
{
    skip_space(h);
    if (h->at == h->end || *h->at != c) return false;
    h->at++;
    return true;
}

static bool take_word(struct header *h, const char *word)
{
    size_t length = strlen(word);
    skip_space(h);
    if ((size_t)(h->end - h->at) < length || memcmp(h->at, word, length) != 0) return false;
    h->at += length;
    return true;
}

/* Reads a string without escapes, in single or double quotes. */
static bool take_string(struct header *h, const char **text, size_t *size)
{
    skip_space(h);
    if (h->at == h->end || (*h->at != '\'' && *h->at != '"')) return false;
    const char *begin = h->at + 1, *close = memchr(begin, *h->at, (size_t)(h->end - begin));
    if (!close || memchr(begin, '\\', (size_t)(close - begin))) return false;
    *text = begin;
    *size = (size_t)(close - begin);
    h->at = close + 1;
    return true;
}

static bool take_count(struct header *h, uint64_t *out)
{
    skip_space(h);
    const char *begin = h->at;
    for (*out = 0; h->at < h->end && *h->at >= '0' && *h->at <= '9'; h->at++)
        if (__builtin_mul_overflow(*out, 10u, out) || __builtin_add_overflow(*out, (uint64_t)(*h->at - '0'), out))
            return false;
    if (h->at == begin) return false;
    if (h->at < h->end && *h->at == 'L') h->at++; /* suffix of Python 2 */
    return true;
}

/* Reads (), (n,), (n, m), (n, m,) ... */
static bool take_shape(struct header *h)
{
    if (h->has_shape || !take(h, '(')) return false;
    h->has_shape = true;
    while (!take(h, ')')) {
        uint64_t side;
        if (!take_count(h, &side)) return false;
        if (h->sides < SIDES_MAX) h->shape[h->sides] = side;
        h->sides++;
        if (!take(h, ',')) return take(h, ')');
    }
    return true;
}

static bool take_member(struct header *h)
{
    const char *key;
    size_t size;
    if (!take_string(h, &key, &size) || !take(h, ':')) return false;
    if (size == 5 && memcmp(key, "descr", size) == 0) return !h->type && take_string(h, &h->type, &h->type_size);
    if (size == 5 && memcmp(key, "shape", size) == 0) return take_shape(h);
    if (size != 13 || memcmp(key, "fortran_order", size) != 0 || h->has_order) return false;
    h->has_order = true;
    h->fortran = take_word(h, "True");
    return h->fortran || take_word(h, "False");
}

static bool take_dictionary(struct header *h)
{
    if (!take(h, '{')) return false;
    while (!take(h, '}')) {
        if (!take_member(h)) return false;
        if (take(h, ',')) continue;
        if (!take(h, '}')) return false;
        break;
    }
    skip_space(h);
    return h->at == h->end && h->type && h->has_order && h->has_shape;
}

/* Finds the dictionary by its length, which precedes it. */
static bool find_header(const char *bytes, size_t size, struct header *h)
{
    if (size < PREFIX + 2 || memcmp(bytes, MAGIC, sizeof MAGIC - 1) != 0) return false;
    unsigned major = (unsigned char)bytes[6], minor = (unsigned char)bytes[7];
    size_t digits = major == 1 ? 2 : 4, length = 0;
    if (major < 1 || major > 3 || minor != 0 || size < PREFIX + digits) return false;
    for (size_t i = 0; i < digits; i++)
        length |= (size_t)(unsigned char)bytes[PREFIX + i] << 8 * i;
    h->at = bytes + PREFIX + digits;
    if (length > size - PREFIX - digits) return false;
    h->end = h->at + length;
    return true;
}

static bool check_type(const struct header *h, const struct zr_npy_wanted *wanted, bool *swapped,
                       struct zr_reason *reason)
{
    const char *want = wanted->is_float ? "f4" : "u4";
    if (h->type_size == 3 && memcmp(h->type + 1, want, 2) == 0 && (h->type[0] == '<' || h->type[0] == '>')) {
        *swapped = (h->type[0] == '>') != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
        return true;
    }
    zr_reason_give(reason, "the array's type is %s; %s is needed, '<%s' or '>%s'", zr_quote(h->type, h->type_size).text,
                   wanted->is_float ? "float32" : "uint32", want, want);
    return false;
}

static bool check_shape(const struct header *h, uint32_t width, uint32_t height, struct zr_reason *reason)
{
    if (h->sides == 2 && h->shape[0] == height && h->shape[1] == width && !h->fortran) return true;
    if (h->sides != 2)
        zr_reason_give(reason, "the array has %zu dimensions; the window's height and width are needed", h->sides);
    else if (h->fortran)
        zr_reason_give(reason, "the array is in Fortran order; numpy.ascontiguousarray makes it rows");
    else
        zr_reason_give(reason, "the shape is (%" PRIu64 ", %" PRIu64 "), not the window's (%" PRIu32 ", %" PRIu32 ")",
                       h->shape[0], h->shape[1], height, width);
    return false;
}

static void copy_values(uint32_t *out, const char *bytes, size_t count, bool swapped)
{
    memcpy(out, bytes, count * sizeof *out);
    for (size_t i = 0; swapped && i < count; i++)
        out[i] = __builtin_bswap32(out[i]);
}

enum zr_status zr_npy_read(struct zr_arena *arena, const struct zr_parsed_bytes *file,
                           const struct zr_npy_wanted *wanted, void **values, struct zr_reason *reason)
{
    const uint32_t width = wanted->width, height = wanted->height;
    struct header h = {.at = NULL};
    bool swapped = false;
    if (!find_header(file->bytes, file->size, &h) || !take_dictionary(&h)) {
        zr_reason_give(reason, "not an NPY file (numpy.save) of version 1.0, 2.0 or 3.0");
        return ZR_BAD_SCENE;
    }
    if (!check_type(&h, wanted, &swapped, reason) || !check_shape(&h, width, height, reason)) return ZR_BAD_SCENE;
    size_t count = (size_t)width * height, held = file->size - (size_t)(h.end - (const char *)file->bytes);
    if (held / 4 != count || held % 4 != 0) {
        zr_reason_give(reason, "%zu bytes of numbers; %zu are needed", held, count * 4);
        return ZR_BAD_SCENE;
    }
    *values = zr_arena_alloc(arena, count, 4);
    if (!*values) return ZR_NO_MEMORY;
    copy_values(*values, h.end, count, swapped);
    return ZR_OK;
}

/* ---- any array ---- */

static bool find_type(const struct header *h, enum zr_number_type *out, struct zr_reason *reason)
{
    const bool is_known = h->type_size == 3;
    for (int type = ZR_F4; is_known && type < ZR_NUMBER_TYPES; type++) {
        if (memcmp(h->type + 1, zr_number_name((enum zr_number_type)type), 2) != 0) continue;
        *out = (enum zr_number_type)type;
        if (h->type[0] == '<' || (type == ZR_U1 && h->type[0] == '|')) return true;
        if (h->type[0] != '>') break;
        zr_reason_give(reason, "the array's type is %s, big endian; astype('<%s') makes it little endian",
                       zr_quote(h->type, h->type_size).text, zr_number_name(*out));
        return false;
    }
    zr_reason_give(reason, "the array's type is %s; f4, f8, u1, i4, u4, i8 and u8 are read",
                   zr_quote(h->type, h->type_size).text);
    return false;
}

bool zr_npy_open(const void *bytes, size_t size, struct zr_array *out, struct zr_reason *reason)
{
    struct header h = {.at = NULL};
    size_t needed;
    if (!find_header(bytes, size, &h) || !take_dictionary(&h)) {
        zr_reason_give(reason, "not an NPY file (numpy.save) of version 1.0, 2.0 or 3.0");
        return false;
    }
    *out = (struct zr_array){.data = h.end, .ndim = h.sides};
    if (!find_type(&h, &out->type, reason)) return false;
    if (h.fortran) {
        zr_reason_give(reason, "the array is in Fortran order; numpy.ascontiguousarray makes it rows");
        return false;
    }
    if (h.sides < 1 || h.sides > SIDES_MAX) {
        zr_reason_give(reason, "the array has %zu dimensions; 1 to %d are read", h.sides, (int)SIDES_MAX);
        return false;
    }
    bool fits = true;
    for (size_t i = 0; i < h.sides; i++) {
        out->shape[i] = (size_t)h.shape[i];
        fits &= out->shape[i] == h.shape[i];
    }
    const size_t held = size - (size_t)(h.end - (const char *)bytes);
    if (!fits || !zr_array_bytes(out, &needed)) {
        zr_reason_give(reason, "the array's shape is too large");
        return false;
    }
    if (held != needed) zr_reason_give(reason, "%zu bytes of numbers; %zu are needed", held, needed);
    return held == needed;
}
