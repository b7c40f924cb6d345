/* Which addresses are one client, and which are of a private network. */
#include <string.h>

#include "http/clients.h"
#include "support/tests.h"

static struct client *join(struct clients *clients, const char *text)
{
    struct ip ip;
    assert_true(ip_parse(&ip, text, strlen(text)));
    return clients_join(clients, &ip);
}

static bool are_one(const char *a, const char *b)
{
    struct clients clients = {0};
    struct client *first = join(&clients, a), *second = join(&clients, b);
    const bool one = first == second;
    assert_int_equal(first->connections, one ? 2 : 1);
    clients_leave(&clients, first);
    clients_leave(&clients, second);
    for (size_t i = 0; i < CLIENT_BUCKETS; i++)
        assert_null(clients.buckets[i]);
    return one;
}

TEST(a_network_of_64_bits_is_one_client)
{
    assert_true(are_one("2001:db8:1:2::1", "2001:db8:1:2:ffff:ffff:ffff:ffff"));
    assert_false(are_one("2001:db8:1:2::1", "2001:db8:1:3::1"));
    assert_true(are_one("8.8.8.8", "8.8.8.8"));
    assert_false(are_one("8.8.8.8", "8.8.8.9"));
    assert_true(are_one("8.8.8.8", "::ffff:8.8.8.8"));
    assert_false(are_one("::ffff:8.8.8.8", "::ffff:8.8.8.9"));
    assert_false(are_one("::1", "::2"));
}

TEST(private_networks_and_loopback_are_known)
{
    static const struct {
        const char *address;
        bool is_private, is_loopback;
    } CASES[] = {
        {"127.0.0.1", true, true},        {"127.255.255.255", true, true},   {"::1", true, true},
        {"::ffff:127.0.0.1", true, true}, {"126.255.255.255", false, false}, {"128.0.0.1", false, false},
        {"10.1.2.3", true, false},        {"11.0.0.1", false, false},        {"172.15.255.255", false, false},
        {"172.16.0.1", true, false},      {"172.31.255.255", true, false},   {"172.32.0.1", false, false},
        {"192.168.1.1", true, false},     {"192.169.0.1", false, false},     {"169.254.1.1", true, false},
        {"fc00::1", true, false},         {"fdff::1", true, false},          {"fe00::1", false, false},
        {"fe80::1", true, false},         {"febf::1", true, false},          {"fec0::1", false, false},
        {"2001:db8::1", false, false},    {"::ffff:10.0.0.1", true, false},  {"::2", false, false},
    };
    struct clients clients = {0};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct client *client = join(&clients, CASES[i].address);
        if (client->is_private != CASES[i].is_private || client->is_loopback != CASES[i].is_loopback)
            fail_msg("%s", CASES[i].address);
        clients_leave(&clients, client);
    }
}

RUN_TESTS(NULL, NULL)
