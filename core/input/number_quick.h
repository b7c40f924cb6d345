/* number_quick.h - input: the numbers that scenes are full of, eight digits at a time.
 *
 * Why:    a large scene is a million short decimals, and reading them is what reading it
 *         costs. A digit at a time takes 20 ns for a short one and 35 for 17 digits; these, 11 and 20, and inlined 9,
 *         because they have no branch that depends on how many digits there are.
 * Source: Lemire, "Quickly parsing eight digits", 2018; Clinger, "How to read floating point
 *         numbers accurately", PLDI 1990, for why one division of exact operands is correctly rounded.
 */
#ifndef ZR_NUMBER_QUICK_H
#define ZR_NUMBER_QUICK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/inlined.h"
#include "input/number.h"

/* Eight bytes of text, the first one lowest; zeros behind `end`, which is never read. */
static inline uint64_t zr_eight_bytes(const char *at, const char *end)
{
    uint64_t word = 0;
    if (end - at >= 8) {
        memcpy(&word, at, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
        word = __builtin_bswap64(word);
#endif
        return word;
    }
    for (int i = 0; at + i < end; i++)
        word |= (uint64_t)(unsigned char)at[i] << (8 * i);
    return word;
}

/* How many of the eight are digits, counted up to the first that is none. Carries between bytes
 * only go upwards, from a byte that is no digit itself. */
static inline unsigned zr_count_digits(uint64_t word)
{
    const uint64_t ones = UINT64_C(0x0101010101010101);
    uint64_t digits = word ^ (ones * '0');
    uint64_t others = ((digits + ones * (0x7F - 9)) | digits) & (ones * 0x80);
    return others ? (unsigned)__builtin_ctzll(others) / 8 : 8;
}

/* The value of the first `count` of eight bytes, 1 to 8, all digits. */
static inline uint32_t zr_digits_value(uint64_t word, unsigned count)
{
    word = (word ^ UINT64_C(0x3030303030303030)) << (8 * (8 - count)); /* zeros before the first digit */
    word = (word * (1 + (10 << 8))) >> 8;                              /* pairs of digits */
    word = ((word & UINT64_C(0x00FF00FF00FF00FF)) * (1 + (100 << 16))) >> 16;
    return (uint32_t)(((word & UINT64_C(0x0000FFFF0000FFFF)) * (1 + (UINT64_C(10000) << 32))) >> 32);
}

/* The byte behind the first `count` of eight, below 8. */
static inline char zr_byte_behind(uint64_t word, unsigned count)
{
    return (char)(word >> (8 * count));
}

static inline uint32_t zr_quick_scale(unsigned digits)
{
    static const uint32_t scales[9] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
    return scales[digits];
}

/* A number of JSON with at most 7 digits before the point and 23 behind it, few enough in all to fit 64 bits, and 3 of
 * an exponent. Returns where it ends, or NULL where there is anything else at `at`: number.h knows what. */
const char *zr_number_quick(const char *at, const char *end, double *value);

#ifdef __SSE2__
#include <emmintrin.h>

enum { ZR_QUICKER_BYTES = 32 };

/* Which of the next 32 bytes are no digits; the first byte is bit 0. */
static inline uint32_t zr_mark_others(const char *at)
{
    const __m128i nine = _mm_set1_epi8(9), zero = _mm_set1_epi8('0');
    __m128i low = _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)at), zero);
    __m128i high = _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)(at + 16)), zero);
    uint32_t first = (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(low, nine), nine));
    uint32_t second = (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(high, nine), nine));
    return ~(first | second << 16);
}

/* The same inlined for [-] digits . digits of at most 16 characters, where ZR_QUICKER_BYTES may be read. What comes
 * behind is the caller's to judge: only ',' or ']' is known to end the number. Where the next number begins depends on
 * this one through one load, not three in a row, and all digits are gathered in a word: 11 ns a number become 9. */
ZR_INLINED const char *zr_number_quicker(const char *at, double *value)
{
    static const double powers[2][16] = {
        {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15},
        {-1e0, -1e1, -1e2, -1e3, -1e4, -1e5, -1e6, -1e7, -1e8, -1e9, -1e10, -1e11, -1e12, -1e13, -1e14, -1e15}};
    const __m128i nine = _mm_set1_epi8(9);
    __m128i text = _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)at), _mm_set1_epi8('0'));
    __m128i digits = _mm_cmpeq_epi8(_mm_max_epu8(text, nine), nine);
    size_t negative = *at == '-', others = ((size_t)(unsigned)_mm_movemask_epi8(digits) | negative) ^ 0x1FFFF;
    size_t point = (size_t)__builtin_ctz((unsigned)others), whole = point - negative;
    size_t behind = (size_t)__builtin_ctz((unsigned)(others & (others - 1)) | 0x10000), decimals = behind - point - 1;
    const char *first = at + negative;
    size_t zero = *first == '0';
    if (at[point] != '.' || whole - 1 > 6 - 6 * zero || decimals - 1 > 14) return NULL;
    /* The digits without the point, and without a zero in front of it. */
    whole -= zero;
    uint64_t before, after, kept = (UINT64_C(1) << (8 * whole)) - 1;
    memcpy(&before, first + zero, sizeof before);
    memcpy(&after, first + zero + 1, sizeof after);
    uint64_t word = (before & kept) | (after & ~kept), mantissa;
    size_t count = whole + decimals;
    if (count <= 8) {
        mantissa = zr_digits_value(word, (unsigned)count);
    } else {
        memcpy(&after, first + zero + 9, sizeof after);
        mantissa = (uint64_t)zr_digits_value(word, 8) * zr_quick_scale((unsigned)count - 8) +
                   zr_digits_value(after, (unsigned)count - 8);
    }
    *value = (double)(int64_t)mantissa / powers[negative][decimals];
    return at + behind;
}

enum { ZR_QUICK_ROW_BYTES = 32 + 8 };

/* Whole numbers of up to 7 digits without leading zeros, the first one behind `at`, one `separator` and perhaps a blank
 * between two, `most` of them at most, which end within 32 bytes, where ZR_QUICK_ROW_BYTES may be read: each is from +
 * what becomes out[i], which is less than `count`. Returns where the last one ends, *used of them; NULL where there is
 * anything else. All ends are found at once, so that no number waits for the one before. */
ZR_INLINED const char *zr_number_quick_row(const char *at, char separator, uint32_t from, uint32_t count, size_t most,
                                           uint32_t *out, size_t *used)
{
    uint32_t others = zr_mark_others(at) & ~UINT32_C(1);
    size_t start = 1;
    for (size_t i = 0; others && i < most; i++) {
        const size_t behind = (size_t)__builtin_ctz(others), digits = behind - start;
        uint64_t word;
        memcpy(&word, at + start, sizeof word);
        if (digits - 1 > 6 || (digits > 1 && (char)word == '0')) return NULL;
        const uint32_t index = zr_digits_value(word, (unsigned)digits) - from;
        if (index >= count) return NULL;
        out[i] = index;
        if (at[behind] != separator) {
            *used = i + 1;
            return at + behind;
        }
        const uint32_t blank = at[behind + 1] == ' ';
        others &= others - 1;
        others &= others - blank;
        start = behind + 1 + blank;
    }
    return NULL;
}
#endif

/* zr_number_read (number.h), with the same value and end always; inlined for numbers in their usual form that a blank
 * or a line's end is behind. */
static inline const char *zr_number_next(const char *at, const char *end, double *value)
{
    const char *behind;
#ifdef __SSE2__
    if (end - at >= ZR_QUICKER_BYTES && (behind = zr_number_quicker(at, value)) && (unsigned char)*behind <= ' ')
        return behind;
#endif
    behind = zr_number_quick(at, end, value);
    return behind ? behind : zr_number_read(at, end, value);
}

#endif
