/* Lists of networks, and the client's address in the headers of proxies. */
#include <stdio.h>
#include <string.h>

#include "gate/forwarded.h"
#include "support/tests.h"

static bool contains(const char *list, const char *address)
{
    struct networks networks;
    struct ip ip;
    if (!networks_parse(&networks, list)) fail_msg("%s", list);
    if (!ip_parse(&ip, address, strlen(address))) fail_msg("%s", address);
    return networks_contain(&networks, &ip);
}

TEST(networks_contain_their_addresses)
{
    static const struct {
        const char *list, *address;
        bool is_in;
    } CASES[] = {
        {"", "10.0.0.1", false},
        {"10.0.0.1", "10.0.0.1", true},
        {"10.0.0.1", "10.0.0.2", false},
        {"10.0.0.1", "::ffff:10.0.0.1", true},
        {"10.0.0.0/8, 192.0.2.128/25", "10.255.0.9", true},
        {"10.0.0.0/8, 192.0.2.128/25", "192.0.2.200", true},
        {"10.0.0.0/8,192.0.2.128/25", "192.0.2.127", false},
        {"0.0.0.0/1", "8.8.8.8", true},
        {"0.0.0.0/1", "2001:db8::1", false},
        {"::/1", "2001:db8::1", true},
        {"2001:db8::/33", "2001:db8:7fff::1", true},
        {"2001:db8::/33", "2001:db8:8000::1", false},
        {"::ffff:10.0.0.0/104", "10.1.2.3", true},
        {"loopback", "127.0.0.9", true},
        {"loopback", "::1", true},
        {"loopback", "10.0.0.1", false},
        {"private", "10.0.0.1", true},
        {"private", "fd00::1", true},
        {"private", "127.0.0.1", true},
        {"private", "11.0.0.1", false},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        if (contains(CASES[i].list, CASES[i].address) != CASES[i].is_in)
            fail_msg("%s in %s", CASES[i].address, CASES[i].list);
}

TEST(other_lists_are_refused)
{
    static const char *const LISTS[] = {"10.0.0",
                                        "10.0.0.0/33",
                                        "10.0.0.0/",
                                        "10.0.0.0/-1",
                                        "10.0.0.0/8x",
                                        "10.0.0.0/0008",
                                        "example.org",
                                        "[::1]",
                                        "::1/129",
                                        "fe80::1%eth0",
                                        "10.0.0.1:80",
                                        "Loopback",
                                        "/8",
                                        "10.0.0.1;",
                                        "010.0.0.1",
                                        "1.2.3.4.5",
                                        "0x7f000001",
                                        "2130706433",
                                        "0.0.0.0/0",
                                        "::/0",
                                        "10.0.0.1 0.0.0.0/0",
                                        "::ffff:0.0.0.0/96"};
    struct networks networks;
    char many[NETWORKS_MAX * 9 + 16] = "";
    for (size_t i = 0; i < sizeof LISTS / sizeof LISTS[0]; i++)
        if (networks_parse(&networks, LISTS[i])) fail_msg("%s", LISTS[i]);
    for (int i = 0; i < NETWORKS_MAX; i++)
        strcat(many, "10.0.0.1 ");
    assert_true(networks_parse(&networks, many));
    assert_false(networks_parse(&networks, strcat(many, "10.0.0.1")));
}

static void assert_client(enum forwarded_form form, const char *list, const char *wanted)
{
    struct networks trusted;
    struct ip peer;
    char found[IP_TEXT_SIZE];
    assert_true(networks_parse(&trusted, "10.0.0.0/8 fd00::/8"));
    assert_true(ip_parse(&peer, "10.0.0.1", strlen("10.0.0.1")));
    const struct ip client = forwarded_client(form, &trusted, &peer, list);
    ip_print(&client, found);
    if (strcmp(found, wanted) != 0) fail_msg("%s: %s instead of %s", list, found, wanted);
}

TEST(x_forwarded_for_names_the_last_address_that_is_no_proxy)
{
    static const struct {
        const char *list, *client;
    } CASES[] = {
        {"", "10.0.0.1"},
        {"8.8.8.8", "8.8.8.8"},
        {"1.1.1.1, 8.8.8.8", "8.8.8.8"},
        {"1.1.1.1, 8.8.8.8, 10.0.0.2", "8.8.8.8"},
        {"10.0.0.9,10.0.0.2", "10.0.0.9"},
        {"1.1.1.1, garbage, 10.0.0.2", "10.0.0.2"},
        {"1.1.1.1, garbage", "10.0.0.1"},
        {"garbage, 8.8.8.8", "8.8.8.8"},
        {",,8.8.8.8 ,\t, ", "8.8.8.8"},
        {"8.8.8.8:1234", "8.8.8.8"},
        {"8.8.8.8:", "10.0.0.1"},
        {"8.8.8.8:123456", "10.0.0.1"},
        {"2001:db8::1", "2001:db8::1"},
        {"[2001:db8::1]", "2001:db8::1"},
        {"[2001:db8::1]:443", "2001:db8::1"},
        {"[2001:db8::1]443", "10.0.0.1"},
        {"[8.8.8.8]", "10.0.0.1"},
        {"[2001:db8::1", "10.0.0.1"},
        {"2001:db8::1, fd00::2", "2001:db8::1"},
        {"unknown", "10.0.0.1"},
        {"\"8.8.8.8\"", "10.0.0.1"},
        {"\", 8.8.8.8", "8.8.8.8"},
        {"::ffff:8.8.8.8", "8.8.8.8"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        assert_client(FORWARDED_FOR, CASES[i].list, CASES[i].client);
}

TEST(forwarded_names_it_as_rfc_7239_has_it)
{
    static const struct {
        const char *list, *client;
    } CASES[] = {
        {"for=8.8.8.8", "8.8.8.8"},
        {"For=8.8.8.8;proto=http;by=203.0.113.43", "8.8.8.8"},
        {"proto=http ; for=8.8.8.8", "8.8.8.8"},
        {"for=1.1.1.1, for=8.8.8.8;by=\"a,b;c\", for=10.0.0.2", "8.8.8.8"},
        {"for=\"[2001:db8:cafe::17]:4711\"", "2001:db8:cafe::17"},
        {"for=\"8.8.8.8:_gazonk\"", "10.0.0.1"},
        {"for=\"8.8.8.8:80\"", "8.8.8.8"},
        {"for=\"8.8\\.8.8\"", "8.8.8.8"},
        {"for=_hidden", "10.0.0.1"},
        {"for=unknown", "10.0.0.1"},
        {"for=1.1.1.1, for=_hidden, for=10.0.0.2", "10.0.0.2"},
        {"8.8.8.8", "10.0.0.1"},
        {"proto=http", "10.0.0.1"},
        {"for=8.8.8.8;for=9.9.9.9", "10.0.0.1"},
        {"for =8.8.8.8", "10.0.0.1"},
        {"for=", "10.0.0.1"},
        {"for=\"", "10.0.0.1"},
        {"for=\"\\\"", "10.0.0.1"},
        /* Quotes that a client opens do not hide the item that its proxy appends. */
        {"for=\", for=8.8.8.8", "8.8.8.8"},
        {"for=\"1.1.1.1, for=8.8.8.8;by=\"[fd00::2]\"", "8.8.8.8"},
        {"for=\"\\, for=8.8.8.8", "8.8.8.8"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        assert_client(FORWARDED_STANDARD, CASES[i].list, CASES[i].client);
}

/* A chain of proxies appends to any list of a client, and the client cannot choose its address. */
TEST(no_list_of_a_client_hides_its_address)
{
    static const char BYTES[] = "\",;=[]:. \\\t0123456789forunknown_ab";
    char list[128];
    unsigned seed = 1;
    for (int round = 0; round < 200000; round++) {
        size_t used = 0, length = (seed = seed * 1103515245 + 12345) >> 16 & 31;
        for (; used < length; used++)
            list[used] = BYTES[((seed = seed * 1103515245 + 12345) >> 16) % (sizeof BYTES - 1)];
        snprintf(list + used, sizeof list - used, ", %s8.8.8.8, %s10.0.0.2", round % 2 ? "for=" : "",
                 round % 2 ? "for=" : "");
        assert_client(round % 2 ? FORWARDED_STANDARD : FORWARDED_FOR, list, "8.8.8.8");
    }
}

RUN_TESTS(NULL, NULL)
