/* number.h - input: reads decimal numbers of any length as the nearest double.
 *
 * Why:  strtod needs a terminating zero, depends on the locale, and accepts "inf", "nan" and hexadecimal. All formats
 *       share one definition: the value is the nearest double, and a float is that double converted.
 */
#ifndef ZR_NUMBER_H
#define ZR_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/inlined.h"

/* Reads [+-] digits [. digits] [e [+-] digits] at the start of at..end, with at least one digit before or after the
 * point. Returns the byte after it, which the caller checks; NULL if there is no number. Overflow gives an
 * infinity. */
const char *zr_number_read(const char *at, const char *end, double *value);

/* The same for a number of JSON (RFC 8259, section 6): no plus sign, no leading zeros, digits on both sides of a
 * point. */
const char *zr_number_read_json(const char *at, const char *end, double *value);

/* Sets *value to the double nearest to mantissa * 10^exponent, ties to even. False, with *value unchanged, for
 * exponents outside of -64..47, mantissa 0 with an exponent outside of -22..22, denormal results, and rare hard cases.
 * Takes 4 ns; strtod takes 90. */
bool zr_number_round(uint64_t mantissa, int exponent, double *value);

/* ---- short numbers, eight digits at a time ----
 *
 * Why:    a large scene is a million short decimals, and reading them dominates its time. Digit by digit a number takes
 *         20 ns, or 35 with 17 digits; here 11 and 20, and 9 inlined: no branch depends on the number of digits.
 * Source: Lemire, "Quickly parsing eight digits", 2018; Clinger, "How to read floating point numbers accurately", PLDI
 *         1990, for the proof that one division of exact operands is correctly rounded.
 */

/* Returns eight bytes of text, the first in the lowest bits; zeros from `end` on, where nothing is read. */
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

/* Counts the digits before the first other byte, 0..8. Carries between bytes only start at a byte that is no digit, and
 * only go upwards. */
static inline unsigned zr_count_digits(uint64_t word)
{
    const uint64_t ones = UINT64_C(0x0101010101010101);
    uint64_t digits = word ^ (ones * '0');
    uint64_t others = ((digits + ones * (0x7F - 9)) | digits) & (ones * 0x80);
    return others ? (unsigned)__builtin_ctzll(others) / 8 : 8;
}

/* Returns the value of the first `count` of eight bytes, 1..8, all digits. */
static inline uint32_t zr_digits_value(uint64_t word, unsigned count)
{
    word = (word ^ UINT64_C(0x3030303030303030)) << (8 * (8 - count)); /* shifts in zeros before the first digit */
    word = (word * (1 + (10 << 8))) >> 8; /* sums digits to pairs, then to fours, then to eights */
    word = ((word & UINT64_C(0x00FF00FF00FF00FF)) * (1 + (100 << 16))) >> 16;
    return (uint32_t)(((word & UINT64_C(0x0000FFFF0000FFFF)) * (1 + (UINT64_C(10000) << 32))) >> 32);
}

/* Returns the byte after the first `count` of eight, count < 8. */
static inline char zr_byte_behind(uint64_t word, unsigned count)
{
    return (char)(word >> (8 * count));
}

static inline uint32_t zr_quick_scale(unsigned digits)
{
    static const uint32_t scales[9] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
    return scales[digits];
}

/* Reads a JSON number with at most 7 digits before the point, 23 after it, and 3 of an exponent; all digits must fit
 * 64 bits. Returns the byte after it, or NULL for any other text, which zr_number_read reads. */
const char *zr_number_quick(const char *at, const char *end, double *value);

#ifdef __SSE2__
#include <emmintrin.h>

enum { ZR_QUICKER_BYTES = 32 };

/* Marks the bytes among the next 32 that are no digits; bit 0 is the first byte. */
static inline uint32_t zr_mark_others(const char *at)
{
    const __m128i nine = _mm_set1_epi8(9), zero = _mm_set1_epi8('0');
    __m128i low = _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)at), zero);
    __m128i high = _mm_sub_epi8(_mm_loadu_si128((const __m128i *)(const void *)(at + 16)), zero);
    uint32_t first = (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(low, nine), nine));
    uint32_t second = (uint32_t)_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(high, nine), nine));
    return ~(first | second << 16);
}

/* zr_number_quick, inlined, for [-] digits . digits of at most 16 characters; ZR_QUICKER_BYTES must be readable. The
 * caller checks the next byte: only ',' or ']' surely ends the number. Finding the end takes one load instead of three
 * dependent ones, and all digits are gathered in one word: 9 ns instead of 11. */
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
    /* Removes the point, and a zero before it. */
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

/* Reads integers of at most 7 digits without leading zeros, from the byte after `at` on. They are separated by
 * one `separator` and perhaps a blank. Reads at most `most`, within 32 bytes; ZR_QUICK_ROW_BYTES must be readable.
 * out[i] is the i-th minus `from`, and less than `count`. Returns the byte after the last, and their number in *used;
 * NULL for any other text. All ends are found at once, so that no number waits for the one before. */
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

/* Equal to zr_number_read, inlined for the usual form with a blank or a line end after it. */
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
