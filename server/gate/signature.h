/* signature.h - signatures of addresses: HMAC-SHA256 (RFC 2104, FIPS 180-4) over the bytes of an address.
 *
 *     /v1/renders/HASH?look=studio&exp=1893456000 & signature=0123...cdef
 *     '------------------ signed ---------------'             64 lower-case hexadecimal digits
 *
 * `signature` is the last parameter, and signs all bytes before its '?' or '&', as they are sent. `exp` is optional:
 * the end of the signature, in seconds since 1970. Pure functions; the time of a check depends on the length of the
 * address and the number of keys, not on how much of a signature is right.
 */
#ifndef ZRASTERD_SIGNATURE_H
#define ZRASTERD_SIGNATURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <nettle/hmac.h>

enum {
    SIGNATURE_BYTES = SHA256_DIGEST_SIZE,
    SIGNATURE_DIGITS = 2 * SIGNATURE_BYTES,
    SIGNATURE_KEYS_MAX = 16,
    SIGNATURE_KEY_MIN = 16, /* bytes */
    SIGNATURE_KEY_MAX = 128
};

struct signature_keys {
    size_t count;
    struct hmac_sha256_ctx states[SIGNATURE_KEYS_MAX]; /* as hmac_sha256_set_key leaves them */
};

enum signature_status {
    SIGNATURE_GOOD,
    SIGNATURE_MISSING,
    SIGNATURE_MALFORMED, /* not last, several, or no 64 digits; `exp` several, or no number */
    SIGNATURE_WRONG,     /* by none of the keys */
    SIGNATURE_EXPIRED    /* right, but its end has passed */
};

/* Adds a key of SIGNATURE_KEY_MIN to SIGNATURE_KEY_MAX bytes. There must be a place for it. */
void signature_add_key(struct signature_keys *keys, const uint8_t *bytes, size_t size);

/* Checks an address. `query` may be NULL. Tries all keys, whichever fits. *expires_s: the value of `exp`, 0 without it,
 * or if the signature is not good. */
enum signature_status signature_check(const struct signature_keys *keys, const char *path, const char *query,
                                      int64_t now_s, int64_t *expires_s);

/* Removes the parameters `signature` and `exp` from a query. */
void signature_strip(char *query);

/* Returns true if two texts of SIGNATURE_BYTES bytes are equal, in a time that does not depend on them. */
bool signature_same(const uint8_t *a, const uint8_t *b);

#endif
