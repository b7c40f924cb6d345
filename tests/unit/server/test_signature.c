/* server/gate/signature.c: which addresses are accepted. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gate/signature.h"
#include "support/tests.h"
#include "unit/common/mutate.h"

#define PATH "/v1/renders/4f1d0e1bd4fc80bbbe2b8d22a5d0ab5b5f7b6f2d2d4f7c1e1a7e4f1f9f4f0c55"

enum { NOW = 1800000000, MUTANTS = 1000000, ADDRESS_SIZE = 1024 };

static const uint8_t KEYS[3][20] = {"one key of 20 bytes", "another of 20 bytes", "one that is unknown"};

static struct signature_keys two_keys(void)
{
    struct signature_keys keys = {0};
    for (size_t i = 0; i < 2; i++)
        signature_add_key(&keys, KEYS[i], sizeof KEYS[i]);
    return keys;
}

/* Writes the signature of `signed_bytes` behind `address`. */
static void sign(char *address, size_t key, const char *signed_bytes)
{
    struct hmac_sha256_ctx state;
    uint8_t mac[SIGNATURE_BYTES];
    hmac_sha256_set_key(&state, sizeof KEYS[key], KEYS[key]);
    hmac_sha256_update(&state, strlen(signed_bytes), (const uint8_t *)signed_bytes);
    hmac_sha256_digest(&state, sizeof mac, mac);
    address += strlen(address);
    for (size_t i = 0; i < sizeof mac; i++)
        sprintf(address + 2 * i, "%02x", mac[i]);
}

/* Checks an address, which is split at its first '?', as the daemon does. */
static enum signature_status check(const struct signature_keys *keys, const char *address, int64_t *expires_s)
{
    char copy[ADDRESS_SIZE];
    snprintf(copy, sizeof copy, "%s", address);
    char *query = strchr(copy, '?');
    if (query) *query++ = '\0';
    return signature_check(keys, copy, query, NOW, expires_s);
}

static void signed_address(char address[ADDRESS_SIZE], size_t key, const char *target)
{
    snprintf(address, ADDRESS_SIZE, "%s%csignature=", target, strchr(target, '?') ? '&' : '?');
    sign(address, key, target);
}

static enum signature_status check_signed(size_t key, const char *target)
{
    const struct signature_keys keys = two_keys();
    char address[ADDRESS_SIZE];
    int64_t expires_s;
    signed_address(address, key, target);
    return check(&keys, address, &expires_s);
}

/* RFC 4231, test case 2, whose key has 4 bytes: it is short, and right all the same. */
TEST(signature_is_hmac_sha256)
{
    struct signature_keys keys = {0};
    int64_t expires_s;
    signature_add_key(&keys, (const uint8_t *)"Jefe", 4);
    assert_int_equal(check(&keys,
                           "what do ya want for nothing?signature="
                           "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843",
                           &expires_s),
                     SIGNATURE_WRONG);
    assert_int_equal(check(&keys,
                           "what do ya want for nothing?&signature="
                           "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843",
                           &expires_s),
                     SIGNATURE_GOOD);
}

TEST(every_key_signs_and_no_other)
{
    static const char *const TARGETS[] = {PATH,
                                          PATH "?",
                                          PATH "?look=studio",
                                          PATH "?look=studio&exp=1800000001",
                                          PATH "/small?exp=999999999999",
                                          PATH "?&&a==&b"};
    for (size_t i = 0; i < sizeof TARGETS / sizeof *TARGETS; i++) {
        assert_int_equal(check_signed(0, TARGETS[i]), SIGNATURE_GOOD);
        assert_int_equal(check_signed(1, TARGETS[i]), SIGNATURE_GOOD);
        assert_int_equal(check_signed(2, TARGETS[i]), SIGNATURE_WRONG);
    }
}

TEST(without_keys_nothing_is_accepted)
{
    const struct signature_keys none = {0};
    char address[ADDRESS_SIZE];
    int64_t expires_s;
    signed_address(address, 0, PATH);
    assert_int_equal(check(&none, address, &expires_s), SIGNATURE_WRONG);
}

TEST(exp_is_the_first_second_that_is_too_late)
{
    assert_int_equal(check_signed(0, PATH "?exp=1800000000"), SIGNATURE_EXPIRED);
    assert_int_equal(check_signed(0, PATH "?exp=0"), SIGNATURE_EXPIRED);
    assert_int_equal(check_signed(2, PATH "?exp=0"), SIGNATURE_WRONG);
    const struct signature_keys keys = two_keys();
    char address[ADDRESS_SIZE];
    int64_t expires_s;
    signed_address(address, 0, PATH "?exp=1800000001");
    assert_int_equal(check(&keys, address, &expires_s), SIGNATURE_GOOD);
    assert_int_equal(expires_s, 1800000001);
}

TEST(malformed_addresses_are_refused_with_a_right_signature_too)
{
    static const char *const TARGETS[] = {PATH "?exp=",
                                          PATH "?exp",
                                          PATH "?exp=-1",
                                          PATH "?exp=1800000001.5",
                                          PATH "?exp=1800000001&exp=1800000001",
                                          PATH "?signature=0",
                                          PATH "?signature",
                                          PATH "?exp=1000000000000"};
    for (size_t i = 0; i < sizeof TARGETS / sizeof *TARGETS; i++)
        assert_int_equal(check_signed(0, TARGETS[i]), SIGNATURE_MALFORMED);
    const struct signature_keys keys = two_keys();
    char address[ADDRESS_SIZE];
    int64_t expires_s;
    signed_address(address, 0, PATH "?look=studio");
    strcat(address, "&exp=1800000001");
    assert_int_equal(check(&keys, address, &expires_s), SIGNATURE_MALFORMED);
    assert_int_equal(check(&keys, PATH "?look=studio", &expires_s), SIGNATURE_MISSING);
    assert_int_equal(check(&keys, PATH, &expires_s), SIGNATURE_MISSING);
}

TEST(mutated_addresses_are_not_accepted)
{
    static const char *const TARGETS[] = {PATH "?look=studio&width=320&exp=1800000001", PATH "/small"};
    const struct signature_keys keys = two_keys();
    struct text text = {0};
    for (size_t i = 0; i < MUTANTS; i++) {
        char address[ADDRESS_SIZE];
        int64_t expires_s;
        text.size = 0;
        signed_address(address, i % 2, TARGETS[i / 2 % 2]);
        put(&text, address, strlen(address));
        mutate(&text);
        put(&text, "", 1);
        if (strcmp(text.bytes, address) != 0 && check(&keys, text.bytes, &expires_s) == SIGNATURE_GOOD)
            fail_msg("accepted: %s", text.bytes);
    }
    drop(&text);
}

static void assert_stripped(const char *query, const char *wanted)
{
    char text[ADDRESS_SIZE];
    snprintf(text, sizeof text, "%s", query);
    signature_strip(text);
    assert_string_equal(text, wanted);
}

TEST(signature_and_exp_are_taken_out_and_all_else_stays)
{
    assert_stripped("", "");
    assert_stripped("signature=0", "");
    assert_stripped("exp=1&signature=0", "");
    assert_stripped("a=1&exp=1&b=2&signature=0", "a=1&b=2");
    assert_stripped("exp&signature&a=exp=1&xexp=2&expx=3", "a=exp=1&xexp=2&expx=3");
    assert_stripped("signature=1&signature=2&a", "a");
}

RUN_TESTS(NULL, NULL)
