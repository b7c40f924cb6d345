#include "input/text/number.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- digits in 64 bits ----
 *
 * If doubles hold the digits and the power of ten exactly, one operation on them rounds once.
 * Source: Clinger, "How to read floating point numbers accurately", PLDI 1990.
 *
 * Otherwise one multiplication by a power of five in 128 bits decides how the exact product rounds. It detects the rare
 * cases in which it does not.
 * Source: Lemire, "Number parsing at a gigabyte per second", Software: Practice and Experience 2021, section 5; the
 *         names are the paper's. */
__extension__ typedef unsigned __int128 uint128;

enum { FIRST = -64, LAST = 47, MANTISSA_BITS = 52, BIAS = 1023, EXPONENT_INFINITE = 0x7FF };

/* 5^q for q = FIRST..LAST, scaled to 128 bits: truncated for q >= 0, rounded up for q < 0. Other powers are rare in
 * scenes, and strtod handles them; the full table has 652 lines. */
static const uint64_t powers[LAST - FIRST + 1][2] = {
    {0xa87fea27a539e9a5, 0x3f2398d747b36224}, {0xd29fe4b18e88640e, 0x8eec7f0d19a03aad},
    {0x83a3eeeef9153e89, 0x1953cf68300424ac}, {0xa48ceaaab75a8e2b, 0x5fa8c3423c052dd7},
    {0xcdb02555653131b6, 0x3792f412cb06794d}, {0x808e17555f3ebf11, 0xe2bbd88bbee40bd0},
    {0xa0b19d2ab70e6ed6, 0x5b6aceaeae9d0ec4}, {0xc8de047564d20a8b, 0xf245825a5a445275},
    {0xfb158592be068d2e, 0xeed6e2f0f0d56712}, {0x9ced737bb6c4183d, 0x55464dd69685606b},
    {0xc428d05aa4751e4c, 0xaa97e14c3c26b886}, {0xf53304714d9265df, 0xd53dd99f4b3066a8},
    {0x993fe2c6d07b7fab, 0xe546a8038efe4029}, {0xbf8fdb78849a5f96, 0xde98520472bdd033},
    {0xef73d256a5c0f77c, 0x963e66858f6d4440}, {0x95a8637627989aad, 0xdde7001379a44aa8},
    {0xbb127c53b17ec159, 0x5560c018580d5d52}, {0xe9d71b689dde71af, 0xaab8f01e6e10b4a6},
    {0x9226712162ab070d, 0xcab3961304ca70e8}, {0xb6b00d69bb55c8d1, 0x3d607b97c5fd0d22},
    {0xe45c10c42a2b3b05, 0x8cb89a7db77c506a}, {0x8eb98a7a9a5b04e3, 0x77f3608e92adb242},
    {0xb267ed1940f1c61c, 0x55f038b237591ed3}, {0xdf01e85f912e37a3, 0x6b6c46dec52f6688},
    {0x8b61313bbabce2c6, 0x2323ac4b3b3da015}, {0xae397d8aa96c1b77, 0xabec975e0a0d081a},
    {0xd9c7dced53c72255, 0x96e7bd358c904a21}, {0x881cea14545c7575, 0x7e50d64177da2e54},
    {0xaa242499697392d2, 0xdde50bd1d5d0b9e9}, {0xd4ad2dbfc3d07787, 0x955e4ec64b44e864},
    {0x84ec3c97da624ab4, 0xbd5af13bef0b113e}, {0xa6274bbdd0fadd61, 0xecb1ad8aeacdd58e},
    {0xcfb11ead453994ba, 0x67de18eda5814af2}, {0x81ceb32c4b43fcf4, 0x80eacf948770ced7},
    {0xa2425ff75e14fc31, 0xa1258379a94d028d}, {0xcad2f7f5359a3b3e, 0x096ee45813a04330},
    {0xfd87b5f28300ca0d, 0x8bca9d6e188853fc}, {0x9e74d1b791e07e48, 0x775ea264cf55347e},
    {0xc612062576589dda, 0x95364afe032a819e}, {0xf79687aed3eec551, 0x3a83ddbd83f52205},
    {0x9abe14cd44753b52, 0xc4926a9672793543}, {0xc16d9a0095928a27, 0x75b7053c0f178294},
    {0xf1c90080baf72cb1, 0x5324c68b12dd6339}, {0x971da05074da7bee, 0xd3f6fc16ebca5e04},
    {0xbce5086492111aea, 0x88f4bb1ca6bcf585}, {0xec1e4a7db69561a5, 0x2b31e9e3d06c32e6},
    {0x9392ee8e921d5d07, 0x3aff322e62439fd0}, {0xb877aa3236a4b449, 0x09befeb9fad487c3},
    {0xe69594bec44de15b, 0x4c2ebe687989a9b4}, {0x901d7cf73ab0acd9, 0x0f9d37014bf60a11},
    {0xb424dc35095cd80f, 0x538484c19ef38c95}, {0xe12e13424bb40e13, 0x2865a5f206b06fba},
    {0x8cbccc096f5088cb, 0xf93f87b7442e45d4}, {0xafebff0bcb24aafe, 0xf78f69a51539d749},
    {0xdbe6fecebdedd5be, 0xb573440e5a884d1c}, {0x89705f4136b4a597, 0x31680a88f8953031},
    {0xabcc77118461cefc, 0xfdc20d2b36ba7c3e}, {0xd6bf94d5e57a42bc, 0x3d32907604691b4d},
    {0x8637bd05af6c69b5, 0xa63f9a49c2c1b110}, {0xa7c5ac471b478423, 0x0fcf80dc33721d54},
    {0xd1b71758e219652b, 0xd3c36113404ea4a9}, {0x83126e978d4fdf3b, 0x645a1cac083126ea},
    {0xa3d70a3d70a3d70a, 0x3d70a3d70a3d70a4}, {0xcccccccccccccccc, 0xcccccccccccccccd},
    {0x8000000000000000, 0x0000000000000000}, {0xa000000000000000, 0x0000000000000000},
    {0xc800000000000000, 0x0000000000000000}, {0xfa00000000000000, 0x0000000000000000},
    {0x9c40000000000000, 0x0000000000000000}, {0xc350000000000000, 0x0000000000000000},
    {0xf424000000000000, 0x0000000000000000}, {0x9896800000000000, 0x0000000000000000},
    {0xbebc200000000000, 0x0000000000000000}, {0xee6b280000000000, 0x0000000000000000},
    {0x9502f90000000000, 0x0000000000000000}, {0xba43b74000000000, 0x0000000000000000},
    {0xe8d4a51000000000, 0x0000000000000000}, {0x9184e72a00000000, 0x0000000000000000},
    {0xb5e620f480000000, 0x0000000000000000}, {0xe35fa931a0000000, 0x0000000000000000},
    {0x8e1bc9bf04000000, 0x0000000000000000}, {0xb1a2bc2ec5000000, 0x0000000000000000},
    {0xde0b6b3a76400000, 0x0000000000000000}, {0x8ac7230489e80000, 0x0000000000000000},
    {0xad78ebc5ac620000, 0x0000000000000000}, {0xd8d726b7177a8000, 0x0000000000000000},
    {0x878678326eac9000, 0x0000000000000000}, {0xa968163f0a57b400, 0x0000000000000000},
    {0xd3c21bcecceda100, 0x0000000000000000}, {0x84595161401484a0, 0x0000000000000000},
    {0xa56fa5b99019a5c8, 0x0000000000000000}, {0xcecb8f27f4200f3a, 0x0000000000000000},
    {0x813f3978f8940984, 0x4000000000000000}, {0xa18f07d736b90be5, 0x5000000000000000},
    {0xc9f2c9cd04674ede, 0xa400000000000000}, {0xfc6f7c4045812296, 0x4d00000000000000},
    {0x9dc5ada82b70b59d, 0xf020000000000000}, {0xc5371912364ce305, 0x6c28000000000000},
    {0xf684df56c3e01bc6, 0xc732000000000000}, {0x9a130b963a6c115c, 0x3c7f400000000000},
    {0xc097ce7bc90715b3, 0x4b9f100000000000}, {0xf0bdc21abb48db20, 0x1e86d40000000000},
    {0x96769950b50d88f4, 0x1314448000000000}, {0xbc143fa4e250eb31, 0x17d955a000000000},
    {0xeb194f8e1ae525fd, 0x5dcfab0800000000}, {0x92efd1b8d0cf37be, 0x5aa1cae500000000},
    {0xb7abc627050305ad, 0xf14a3d9e40000000}, {0xe596b7b0c643c719, 0x6d9ccd05d0000000},
    {0x8f7e32ce7bea5c6f, 0xe4820023a2000000}, {0xb35dbf821ae4f38b, 0xdda2802c8a800000},
    {0xe0352f62a19e306e, 0xd50b2037ad200000}, {0x8c213d9da502de45, 0x4526f422cc340000},
};

/* Returns floor(log2(10^q)) + 63. */
static int power(int q)
{
    return ((152170 + 65536) * q >> 16) + 63;
}

/* Limits of Clinger's method: 10^22 is the largest power of ten that a double holds exactly. */
enum { EXACT_POWER = 22 };
#define EXACT_MANTISSA (UINT64_C(1) << 53)

static double round_once(uint64_t mantissa, int exponent)
{
    static const double tens[EXACT_POWER + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const double digits = (double)(int64_t)mantissa;
    return exponent < 0 ? digits / tens[-exponent] : digits * tens[exponent];
}

bool zr_number_round(uint64_t w, int q, double *value)
{
    if (w <= EXACT_MANTISSA && q >= -EXACT_POWER && q <= EXACT_POWER) {
        *value = round_once(w, q);
        return true;
    }
    if (w == 0 || q < FIRST || q > LAST) return false;
    int l = __builtin_clzll(w);
    const uint64_t *t = powers[q - FIRST];
    uint128 product = (uint128)(w << l) * t[0];
    uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
    /* The lower half of the power matters only if all bits after the kept ones are 1: then it can carry into them. */
    if ((high & 0x1FF) == 0x1FF) {
        uint64_t more = (uint64_t)((uint128)(w << l) * t[1] >> 64);
        low += more;
        if (low < more) high++;
        if (low == UINT64_MAX && (q < -27 || q > 55)) return false; /* beyond -27..55, 5^q is not exact in 128 bits */
    }
    int upper = (int)(high >> 63);
    uint64_t m = high >> (upper + 64 - MANTISSA_BITS - 3);
    int p = power(q) + upper - l + BIAS;
    if (p <= 0) return false; /* a denormal has fewer bits */
    /* Midway between two doubles: rounds to even. */
    if (low <= 1 && q >= -4 && q <= 23 && (m & 3) == 1 && m << (upper + 64 - MANTISSA_BITS - 3) == high)
        m &= ~UINT64_C(1);
    m = (m + (m & 1)) >> 1;
    if (m >> (MANTISSA_BITS + 1)) {
        m >>= 1;
        p++;
    }
    if (p >= EXPONENT_INFINITE) return false;
    uint64_t bits = (m & ~(UINT64_C(1) << MANTISSA_BITS)) | (uint64_t)p << MANTISSA_BITS;
    memcpy(value, &bits, sizeof bits);
    return true;
}

/* ---- short numbers ---- */

enum { FAST_DIGITS = 19 }; /* as many as fit 64 bits */
enum { WORDS = 3, EXPONENT_DIGITS = 3 };

/* Sets the sign without a branch, which would be mispredicted every other time. */
static bool convert_signed(uint64_t mantissa, int exponent, bool negative, double *value)
{
    double magnitude;
    if (!zr_number_round(mantissa, exponent, &magnitude)) return false;
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    bits |= (uint64_t)negative << 63;
    memcpy(value, &bits, sizeof bits);
    return true;
}

/* Adds an exponent of up to three digits, from after the 'e'. */
static const char *add_exponent(const char *at, const char *end, int *exponent)
{
    uint64_t word = zr_eight_bytes(at, end);
    const bool negative = (char)word == '-', is_signed = negative || (char)word == '+';
    word >>= 8 * is_signed;
    const unsigned count = zr_count_digits(word);
    if (count - 1 >= EXPONENT_DIGITS) return NULL;
    const int written = (int)zr_digits_value(word, count);
    *exponent += negative ? -written : written;
    return at + is_signed + count;
}

const char *zr_number_quick(const char *at, const char *end, double *value)
{
    if (at == end) return NULL;
    bool negative = *at == '-';
    at += negative;
    uint64_t word = zr_eight_bytes(at, end);
    unsigned count = zr_count_digits(word), decimals = 0;
    if (count - 1 > 6 || (count > 1 && (char)word == '0')) return NULL;
    uint64_t mantissa = zr_digits_value(word, count);
    unsigned room = mantissa == 0 ? FAST_DIGITS : FAST_DIGITS - count;
    char behind = zr_byte_behind(word, count);
    at += count;
    if (behind == '.') {
        unsigned more = 8;
        at++;
        for (int i = 0; i < WORDS && more == 8; i++) {
            word = zr_eight_bytes(at + decimals, end);
            more = zr_count_digits(word);
            if (more > 0) mantissa = mantissa * zr_quick_scale(more) + zr_digits_value(word, more);
            decimals += more;
        }
        if (decimals == 0 || more == 8 || decimals > room) return NULL;
        behind = zr_byte_behind(word, more);
        at += decimals;
    }
    int exponent = -(int)decimals;
    if (behind == 'e' || behind == 'E') {
        at = add_exponent(at + 1, end, &exponent);
        if (!at) return NULL;
    }
    return convert_signed(mantissa, exponent, negative, value) ? at : NULL;
}

/* ---- any number ---- */

enum {
    EXPONENT_MAX = 1000000, /* clamps exponents: far beyond any double, far within an int */
    /* The midpoint of two doubles has at most 767 significant digits. Later digits affect the rounding only by whether
     * all of them are zero. */
    DIGITS_KEPT = 770
};

struct decimal {
    bool negative;
    const char *first, *last; /* significant digits, possibly with a point among them; last is one past */
    int digits;               /* their count, at most EXPONENT_MAX */
    uint64_t mantissa;        /* valid while digits <= FAST_DIGITS */
    int64_t exponent;         /* of the last digit */
};

static bool is_digit(const char *at, const char *end)
{
    return at < end && (unsigned char)(*at - '0') < 10;
}

/* Accumulates digits into the mantissa while they fit, and counts all of them. */
static const char *read_digits(const char *at, const char *end, struct decimal *decimal)
{
    uint64_t mantissa = decimal->mantissa;
    int digits = decimal->digits;
    for (; is_digit(at, end); at++) {
        if (digits == 0) {
            if (*at == '0') continue;
            decimal->first = at;
        }
        if (digits < FAST_DIGITS) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
        if (digits < EXPONENT_MAX) digits++;
    }
    decimal->mantissa = mantissa;
    decimal->digits = digits;
    return at;
}

static const char *read_exponent(const char *at, const char *end, int64_t *exponent)
{
    const char *digit = at + 1;
    bool negative = digit < end && *digit == '-';
    if (digit < end && (*digit == '-' || *digit == '+')) digit++;
    if (!is_digit(digit, end)) return NULL;
    int64_t value = 0;
    for (; is_digit(digit, end); digit++)
        if (value < EXPONENT_MAX) value = value * 10 + (*digit - '0');
    *exponent += negative ? -value : value;
    return digit;
}

/* Converts by strtod, on a copy without a point, so that the locale does not matter. */
static double convert_exactly(const struct decimal *decimal)
{
    char text[DIGITS_KEPT + 32];
    size_t used = 0;
    int64_t exponent = decimal->exponent;
    bool rest = false;
    for (const char *at = decimal->first; at < decimal->last; at++) {
        if (*at == '.') continue;
        if (used < DIGITS_KEPT) {
            text[used++] = *at;
        } else {
            rest = rest || *at != '0';
            exponent++;
        }
    }
    if (rest) {
        text[used++] = '1';
        exponent--;
    }
    if (exponent > EXPONENT_MAX) exponent = EXPONENT_MAX;
    if (exponent < -EXPONENT_MAX) exponent = -EXPONENT_MAX;
    snprintf(text + used, sizeof text - used, "e%d", (int)exponent);
    return strtod(text, NULL);
}

static double convert(const struct decimal *decimal)
{
    if (decimal->digits == 0) return 0.0;
    double value;
    if (decimal->digits <= FAST_DIGITS && decimal->exponent >= -EXPONENT_MAX && decimal->exponent <= EXPONENT_MAX &&
        zr_number_round(decimal->mantissa, (int)decimal->exponent, &value))
        return value;
    return convert_exactly(decimal);
}

const char *zr_number_read(const char *at, const char *end, double *value)
{
    struct decimal decimal = {.negative = at < end && *at == '-'};
    if (at < end && (*at == '-' || *at == '+')) at++;
    const char *whole = at;
    at = read_digits(at, end, &decimal);
    size_t written = (size_t)(at - whole);
    decimal.last = at;
    if (at < end && *at == '.') {
        const char *fraction = at + 1;
        at = read_digits(fraction, end, &decimal);
        written += (size_t)(at - fraction);
        decimal.exponent = -(int64_t)(at - fraction);
        decimal.last = at;
    }
    if (written == 0) return NULL;
    if (at < end && (*at == 'e' || *at == 'E')) {
        at = read_exponent(at, end, &decimal.exponent);
        if (!at) return NULL;
    }
    double magnitude = convert(&decimal);
    *value = decimal.negative ? -magnitude : magnitude;
    return at;
}

const char *zr_number_read_json(const char *at, const char *end, double *value)
{
    const char *behind = zr_number_read(at, end, value), *digit = at;
    if (!behind) return NULL;
    if (*digit == '-') digit++;
    if (!is_digit(digit, behind) || (*digit == '0' && is_digit(digit + 1, behind))) return NULL;
    const char *point = memchr(digit, '.', (size_t)(behind - digit));
    return point && !is_digit(point + 1, behind) ? NULL : behind;
}
