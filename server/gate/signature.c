#include "signature.h"

#include <string.h>

#include <nettle/memops.h>

enum { EXP_DIGITS_MAX = 12 };

void signature_add_key(struct signature_keys *keys, const uint8_t *bytes, size_t size)
{
    hmac_sha256_set_key(&keys->states[keys->count++], size, bytes);
}

bool signature_same(const uint8_t *a, const uint8_t *b)
{
    return memeql_sec(a, b, SIGNATURE_BYTES);
}

/* ---- parameters of a query ---- */

/* A name or a value of the query, not decoded. */
struct piece {
    const char *at;
    size_t length;
};

/* A parameter and the one after it; next.at NULL: it was the last. */
struct pair {
    struct piece whole, name, value;
    const char *next;
};

static struct pair read_pair(const char *at)
{
    struct pair pair = {.whole = {at, strcspn(at, "&")}, .name = {at, strcspn(at, "=&")}};
    const size_t past = pair.name.length + (at[pair.name.length] == '=');
    pair.value = (struct piece){at + past, pair.whole.length - past};
    pair.next = at[pair.whole.length] == '&' ? at + pair.whole.length + 1 : NULL;
    return pair;
}

static bool is(struct piece piece, const char *text)
{
    return piece.length == strlen(text) && memcmp(piece.at, text, piece.length) == 0;
}

static bool read_mac(struct piece value, uint8_t mac[SIGNATURE_BYTES])
{
    if (value.length != SIGNATURE_DIGITS) return false;
    for (size_t i = 0; i < SIGNATURE_DIGITS; i++) {
        const char c = value.at[i];
        const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
        if (digit < 0) return false;
        mac[i / 2] = (uint8_t)(i % 2 ? mac[i / 2] << 4 | digit : digit);
    }
    return true;
}

static bool read_seconds(struct piece value, int64_t *seconds)
{
    *seconds = 0;
    for (size_t i = 0; i < value.length; i++) {
        if (value.at[i] < '0' || value.at[i] > '9') return false;
        *seconds = *seconds * 10 + (value.at[i] - '0');
        if (i == EXP_DIGITS_MAX) return false;
    }
    return value.length > 0;
}

/* ---- checks ---- */

/* The parameters `signature` and `exp` of an address. */
struct claim {
    const char *signature; /* the parameter's first byte; NULL: there is none */
    uint8_t mac[SIGNATURE_BYTES];
    bool has_exp;
    int64_t exp_s;
};

static enum signature_status read_claim(const char *query, struct claim *claim)
{
    bool is_whole = true;
    *claim = (struct claim){0};
    for (const char *at = query; at;) {
        const struct pair pair = read_pair(at);
        if (is(pair.name, "signature")) {
            is_whole &= !claim->signature && !pair.next && read_mac(pair.value, claim->mac);
            claim->signature = at;
        } else if (is(pair.name, "exp")) {
            is_whole &= !claim->has_exp && read_seconds(pair.value, &claim->exp_s);
            claim->has_exp = true;
        }
        at = pair.next;
    }
    return !claim->signature ? SIGNATURE_MISSING : is_whole ? SIGNATURE_GOOD : SIGNATURE_MALFORMED;
}

static void update(struct hmac_sha256_ctx *state, const char *text, size_t length)
{
    hmac_sha256_update(state, length, (const uint8_t *)text);
}

enum signature_status signature_check(const struct signature_keys *keys, const char *path, const char *query,
                                      int64_t now_s, int64_t *expires_s)
{
    struct claim claim;
    unsigned fitting = 0;
    *expires_s = 0;
    const enum signature_status status = read_claim(query, &claim);
    if (status != SIGNATURE_GOOD) return status;
    const size_t before = (size_t)(claim.signature - query);
    for (size_t i = 0; i < keys->count; i++) {
        struct hmac_sha256_ctx state = keys->states[i];
        uint8_t mac[SIGNATURE_BYTES];
        update(&state, path, strlen(path));
        if (before > 0) {
            update(&state, "?", 1);
            update(&state, query, before - 1); /* without the '&' */
        }
        hmac_sha256_digest(&state, sizeof mac, mac);
        fitting |= signature_same(mac, claim.mac);
    }
    if (!fitting) return SIGNATURE_WRONG;
    if (claim.has_exp && now_s >= claim.exp_s) return SIGNATURE_EXPIRED;
    *expires_s = claim.exp_s;
    return SIGNATURE_GOOD;
}

void signature_strip(char *query)
{
    char *to = query;
    for (const char *at = query; at;) {
        const struct pair pair = read_pair(at);
        if (!is(pair.name, "signature") && !is(pair.name, "exp")) {
            if (to > query) *to++ = '&';
            memmove(to, at, pair.whole.length);
            to += pair.whole.length;
        }
        at = pair.next;
    }
    *to = '\0';
}
