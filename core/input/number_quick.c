#include "input/number_quick.h"

#include "input/number_round.h"

enum { DIGITS = 19, WORDS = 3, EXPONENT_DIGITS = 3 };

/* Sets the sign without a branch, which would be mispredicted every other time. */
static bool convert(uint64_t mantissa, int exponent, bool negative, double *value)
{
    double magnitude;
    if (!zr_number_round(mantissa, exponent, &magnitude)) return false;
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    bits |= (uint64_t)negative << 63;
    memcpy(value, &bits, sizeof bits);
    return true;
}

/* Adds an exponent of up to three digits, from behind the 'e'. */
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
    unsigned room = mantissa == 0 ? DIGITS : DIGITS - count;
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
    return convert(mantissa, exponent, negative, value) ? at : NULL;
}
