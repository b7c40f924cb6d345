/* random.h - support: reproducible random numbers for tests.
 *
 * The same seed gives the same numbers on every machine, without libm. Not for secrets.
 * Source: Blackman & Vigna, "Scrambled linear pseudorandom number generators"
 * (xoshiro256**), seeded by Steele's splitmix64 as its authors advise.
 */
#ifndef ZR_TEST_RANDOM_H
#define ZR_TEST_RANDOM_H

#include <stdint.h>

struct random {
    uint64_t s[4];
};

static inline uint64_t random_split(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline struct random random_seeded(uint64_t seed)
{
    struct random r;
    for (int i = 0; i < 4; i++)
        r.s[i] = random_split(&seed);
    return r;
}

/* random_seeded(1) for a static variable: {{RANDOM_STATE_1}}. */
#define RANDOM_STATE_1 0x910a2dec89025cc1u, 0xbeeb8da1658eec67u, 0xf893a2eefb32555eu, 0x71c18690ee42c90bu

static inline uint64_t random_rotate(uint64_t x, int k)
{
    return (x << k) | (x >> (64 - k));
}

static inline uint64_t random_next(struct random *r)
{
    uint64_t *s = r->s, result = random_rotate(s[1] * 5, 7) * 9, t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = random_rotate(s[3], 45);
    return result;
}

/* 0 .. n - 1, for n >= 1; its bias of n / 2^32 does not matter to a test. */
static inline uint32_t random_below(struct random *r, uint32_t n)
{
    return (uint32_t)(((random_next(r) >> 32) * n) >> 32);
}

/* low <= result < high, in steps of 2^-53 of the range. */
static inline double random_range(struct random *r, double low, double high)
{
    return low + (high - low) * ((double)(random_next(r) >> 11) * 0x1p-53);
}

#endif
