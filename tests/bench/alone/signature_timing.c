/* signature_timing - bench: whether the time of a check tells how much of a signature is right. Prints, for signatures
 * with 0 to 64 right digits at the front, the median time of a check, and Welch's t of its times beside those without a
 * right digit; beyond 4.5 or so, the times differ (Reparaz, Balasch & Verbauwhede, "Dude, is my code constant time?").
 * A comparison that stops at the first wrong digit stands beside it, to show what the measurement finds.
 * The last row is a signature that is accepted, as its sender learns from the answer. `make signature-timing` runs it.
 *
 *     build/tests/bench/alone/signature_timing [SAMPLES]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gate/signature.h"
#include "support/random.h"

#define PATH  "/v1/renders/4f1d0e1bd4fc80bbbe2b8d22a5d0ab5b5f7b6f2d2d4f7c1e1a7e4f1f9f4f0c55"
#define QUERY "look=studio&width=320"

enum { CLASSES = 8, DEFAULT_SAMPLES = 2000000, CALLS = 64 };
static const int RIGHT_DIGITS[CLASSES] = {0, 1, 2, 8, 16, 32, 63, 64};

/* Both take the query of a class, and the digits of the right signature. */
typedef bool check_fn(const struct signature_keys *keys, const char *query, const char *right);

static bool check(const struct signature_keys *keys, const char *query, const char *right)
{
    int64_t expires_s;
    (void)right;
    return signature_check(keys, PATH, query, 0, &expires_s) == SIGNATURE_GOOD;
}

static bool compare_early(const struct signature_keys *keys, const char *query, const char *right)
{
    const char *given = query + sizeof QUERY - 1 + sizeof "&signature=" - 1;
    (void)keys;
    for (volatile int i = 0; i < SIGNATURE_DIGITS; i++)
        if (given[i] != right[i]) return false;
    return true;
}

/* Times of a class, in ns a call. */
struct times {
    double *ns;
    size_t count;
};

static double now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Mean and variance of the lower nine tenths: what interrupts it says nothing. `times` is sorted. */
static void moments(const struct times *times, double *mean, double *variance, double *count)
{
    const size_t used = times->count * 9 / 10;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < used; i++)
        sum += times->ns[i];
    *mean = sum / (double)used;
    for (size_t i = 0; i < used; i++)
        squares += (times->ns[i] - *mean) * (times->ns[i] - *mean);
    *variance = squares / (double)(used - 1);
    *count = (double)used;
}

static double welch_t(const struct times *a, const struct times *b)
{
    double mean_a, variance_a, count_a, mean_b, variance_b, count_b;
    moments(a, &mean_a, &variance_a, &count_a);
    moments(b, &mean_b, &variance_b, &count_b);
    return (mean_a - mean_b) / sqrt(variance_a / count_a + variance_b / count_b);
}

/* Measures in an order that is random, so that the machine's pace does not follow the classes. Returns whether the
 * checks were right. */
static bool measure(check_fn *call, const struct signature_keys *keys, char queries[CLASSES][256], const char *right,
                    size_t samples, struct times times[CLASSES])
{
    struct random numbers = random_seeded(1);
    bool is_right = true;
    char query[256]; /* one place for all classes */
    for (size_t i = 0; i < samples / CALLS; i++) {
        const size_t class = random_next(&numbers) % CLASSES;
        memcpy(query, queries[class], sizeof query);
        const double began = now_ns();
        for (int k = 0; k < CALLS; k++)
            is_right &= call(keys, query, right) == (RIGHT_DIGITS[class] == SIGNATURE_DIGITS);
        times[class].ns[times[class].count++] = (now_ns() - began) / CALLS;
    }
    for (size_t i = 0; i < CLASSES; i++)
        qsort(times[i].ns, times[i].count, sizeof(double), compare);
    return is_right;
}

/* Another digit of the same kind: reading a letter and reading a number may differ, which the sender knows. */
static char other_digit(char digit)
{
    return digit == '9' ? '0' : digit == 'f' ? 'a' : (char)(digit + 1);
}

int main(int argc, char **argv)
{
    const size_t samples = argc > 1 ? strtoull(argv[1], NULL, 10) : DEFAULT_SAMPLES;
    const uint8_t key[32] = "a key of 32 bytes for this bench";
    static const struct {
        const char *name;
        check_fn *call;
    } KINDS[] = {{"signature_check", check}, {"a comparison that stops early", compare_early}};
    struct signature_keys keys = {0};
    struct hmac_sha256_ctx state;
    uint8_t mac[SIGNATURE_BYTES];
    char right[SIGNATURE_DIGITS + 1], queries[CLASSES][256];
    signature_add_key(&keys, key, sizeof key);
    state = keys.states[0];
    hmac_sha256_update(&state, sizeof PATH "?" QUERY - 1, (const uint8_t *)PATH "?" QUERY);
    hmac_sha256_digest(&state, sizeof mac, mac);
    for (size_t i = 0; i < sizeof mac; i++)
        snprintf(right + 2 * i, 3, "%02x", mac[i]);
    for (size_t i = 0; i < CLASSES; i++) {
        char digits[SIGNATURE_DIGITS + 1];
        memcpy(digits, right, sizeof digits);
        for (int k = RIGHT_DIGITS[i]; k < SIGNATURE_DIGITS; k++)
            digits[k] = other_digit(right[k]);
        snprintf(queries[i], sizeof queries[i], QUERY "&signature=%s", digits);
    }
    for (size_t kind = 0; kind < sizeof KINDS / sizeof *KINDS; kind++) {
        struct times times[CLASSES] = {0};
        for (size_t i = 0; i < CLASSES; i++)
            if (!(times[i].ns = malloc(samples / CALLS * sizeof(double)))) return EXIT_FAILURE;
        if (!measure(KINDS[kind].call, &keys, queries, right, samples, times)) return EXIT_FAILURE;
        printf("%s: right digits, median ns, t beside 0 right digits\n", KINDS[kind].name);
        for (size_t i = 0; i < CLASSES; i++)
            printf("%4d %10.1f %8.1f\n", RIGHT_DIGITS[i], times[i].ns[times[i].count / 2],
                   welch_t(&times[i], &times[0]));
        for (size_t i = 0; i < CLASSES; i++)
            free(times[i].ns);
    }
    return EXIT_SUCCESS;
}
