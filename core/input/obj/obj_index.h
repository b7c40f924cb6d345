/* obj_index.h - input: indices of Wavefront OBJ. */
#ifndef ZR_OBJ_INDEX_H
#define ZR_OBJ_INDEX_H

#include <stdint.h>

#include "input/obj/obj_text.h"
#include "input/text/number.h"

/* Reads an integer with an optional sign; saturates far above any count. */
ZR_INLINED const char *zr_obj_read_integer(const char *at, const char *end, int64_t *value)
{
    bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) at++;
    const uint64_t word = zr_eight_bytes(at, end);
    const unsigned count = zr_count_digits(word);
    if (count == 0) return NULL;
    int64_t magnitude = zr_digits_value(word, count);
    at += count;
    for (; count == 8 && at < end && (unsigned char)(*at - '0') < 10; at++)
        if (magnitude < INT64_C(1) << 40) magnitude = magnitude * 10 + (*at - '0');
    *value = negative ? -magnitude : magnitude;
    return at;
}

/* Converts an index from 1, or a negative one relative to the last element so far, to an index from 0. False if there
 * is no such element. */
ZR_INLINED bool zr_obj_resolve_index(int64_t index, size_t so_far, size_t total, uint32_t *out)
{
    const int64_t resolved = index > 0 ? index - 1 : (int64_t)so_far + index;
    *out = (uint32_t)resolved;
    return index != 0 && resolved >= 0 && resolved < (int64_t)total;
}

/* The indices of a corner. */
struct zr_obj_corner {
    int64_t position, texcoord, normal;
    bool has_texcoord, has_normal;
    bool has_gap; /* a slash without an index, other than in v//vn */
};

/* Reads v, v/vt, v//vn or v/vt/vn, also if an index after a slash is missing. False for any other word. Sets texcoord
 * only if `is_textured`, a constant: without it the compiler omits the digits. */
ZR_INLINED bool zr_obj_read_indices(struct zr_obj_statement *statement, bool is_textured, struct zr_obj_corner *corner)
{
    int64_t unused;
    const char *end = statement->end, *at = zr_obj_read_integer(statement->at, end, &corner->position), *behind;
    corner->has_texcoord = corner->has_normal = corner->has_gap = false;
    if (at && at < end && *at == '/') {
        corner->has_texcoord =
            (behind = zr_obj_read_integer(++at, end, is_textured ? &corner->texcoord : &unused)) != NULL;
        if (corner->has_texcoord) at = behind;
        if (at < end && *at == '/') {
            corner->has_normal = (behind = zr_obj_read_integer(++at, end, &corner->normal)) != NULL;
            corner->has_gap = !corner->has_normal;
            if (corner->has_normal) at = behind;
        } else {
            corner->has_gap = !corner->has_texcoord;
        }
    }
    if (!at || !zr_obj_ends_word(statement, at)) return false;
    statement->at = at;
    return true;
}

#endif
