/* clients.h - counts connections and requests per client address.
 *
 * An IPv6 network of 64 bits is one client, since its owner has 2^64 addresses (RFC 4291, 2.5.4). IPv4 addresses in
 * IPv6 form count as IPv4. Not thread-safe.
 */
#ifndef ZRASTERD_CLIENTS_H
#define ZRASTERD_CLIENTS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "gate/ip.h"

enum { CLIENT_BUCKETS = 1024 };

struct client {
    struct client *next; /* in its bucket */
    struct ip key;
    bool is_loopback, is_private; /* as ip.h has them */
    size_t connections;           /* and requests whose exchange has not ended */
    size_t in_flight;             /* requests */
    atomic_size_t answer_bytes;   /* share of http->answer_bytes (http_state.h); workers change it, too */
    atomic_size_t streams;        /* share of http->streams */
};

struct clients {
    struct client *buckets[CLIENT_BUCKETS];
};

/* Adds a connection, or a request that came over that of a proxy, to the client with this address and returns the
 * client; NULL: out of memory. Undo it by clients_leave. */
struct client *clients_join(struct clients *clients, const struct ip *address);
void clients_leave(struct clients *clients, struct client *client);

#endif
