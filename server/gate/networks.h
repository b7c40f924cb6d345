/* networks.h - lists of addresses and networks, such as those of --trusted-proxies. Pure. */
#ifndef ZRASTERD_NETWORKS_H
#define ZRASTERD_NETWORKS_H

#include "ip.h"

enum { NETWORKS_MAX = 64 };

struct network {
    struct ip prefix;
    unsigned bits; /* of an IPv4 network: 96 more than its own */
};

struct networks {
    bool has_loopback, has_private;
    size_t count;
    struct network items[NETWORKS_MAX];
};

/* Parses a list with spaces or commas between its items: addresses, networks ("10.0.0.0/8", "2001:db8::/32"), and the
 * words "loopback" and "private". False: an item is none of these or all addresses (/0), or there are too many. */
bool networks_parse(struct networks *networks, const char *list);

bool networks_contain(const struct networks *networks, const struct ip *ip);

#endif
