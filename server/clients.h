/* clients.h - who is connected: connections and requests, counted for each address.
 *
 * An IPv6 network of 64 bits counts as one client: who has one has 2^64 addresses in it (RFC 4291, 2.5.4).
 * IPv4 addresses written as IPv6 count as IPv4. Not thread-safe.
 */
#ifndef ZRASTERD_CLIENTS_H
#define ZRASTERD_CLIENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/socket.h>

enum { CLIENT_BUCKETS = 1024, CLIENT_KEY_SIZE = 16 };

struct client {
    struct client *next; /* of its bucket */
    uint8_t key[CLIENT_KEY_SIZE];
    bool is_loopback, is_private; /* private: loopback too, and networks that are not routed on the internet */
    size_t connections;
    size_t in_flight; /* requests */
};

struct clients {
    struct client *buckets[CLIENT_BUCKETS];
};

/* The client that has this address, with one connection more; NULL without memory. clients_leave gives it back. */
struct client *clients_join(struct clients *clients, const struct sockaddr *address);
void clients_leave(struct clients *clients, struct client *client);

#endif
