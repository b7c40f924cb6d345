#include "clients.h"

#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

enum { NETWORK_BYTES = 8, MAPPED_BYTES = 12 };

static const uint8_t MAPPED[MAPPED_BYTES] = {[10] = 0xFF, [11] = 0xFF}; /* ::ffff:0:0/96 */

/* Private networks: the first `bits` of an address; IPv4 as ::ffff:a.b.c.d. Sources: RFC 1918, 3927, 4193, 4291, 1122.
 */
static const struct {
    uint8_t bytes[CLIENT_KEY_SIZE];
    unsigned bits;
    bool is_loopback;
} PRIVATE[] = {
    {{[10] = 0xFF, [11] = 0xFF, [12] = 127}, 96 + 8, true},
    {{[10] = 0xFF, [11] = 0xFF, [12] = 10}, 96 + 8, false},
    {{[10] = 0xFF, [11] = 0xFF, [12] = 172, [13] = 16}, 96 + 12, false},
    {{[10] = 0xFF, [11] = 0xFF, [12] = 192, [13] = 168}, 96 + 16, false},
    {{[10] = 0xFF, [11] = 0xFF, [12] = 169, [13] = 254}, 96 + 16, false},
    {{[15] = 1}, 128, true},
    {{[0] = 0xFC}, 7, false},
    {{[0] = 0xFE, [1] = 0x80}, 10, false},
};

static bool begins_with(const uint8_t *address, const uint8_t *prefix, unsigned bits)
{
    const unsigned whole = bits / 8, rest = bits % 8;
    if (memcmp(address, prefix, whole) != 0) return false;
    return rest == 0 || (uint8_t)((address[whole] ^ prefix[whole]) >> (8 - rest)) == 0;
}

static void write_address(uint8_t out[CLIENT_KEY_SIZE], const struct sockaddr *address)
{
    memset(out, 0, CLIENT_KEY_SIZE);
    if (address->sa_family == AF_INET6) {
        memcpy(out, &((const struct sockaddr_in6 *)(const void *)address)->sin6_addr, CLIENT_KEY_SIZE);
    } else if (address->sa_family == AF_INET) {
        memcpy(out, MAPPED, MAPPED_BYTES);
        memcpy(out + MAPPED_BYTES, &((const struct sockaddr_in *)(const void *)address)->sin_addr, 4);
    }
}

/* Addresses are no secrets, and a long bucket costs little beside a connection. */
static struct client **bucket_of(struct clients *clients, const uint8_t key[CLIENT_KEY_SIZE])
{
    uint32_t hash = ZR_HASH_BEGIN;
    for (int i = 0; i < CLIENT_KEY_SIZE; i++)
        hash = zr_hash_byte(hash, key[i]);
    return &clients->buckets[hash % CLIENT_BUCKETS];
}

struct client *clients_join(struct clients *clients, const struct sockaddr *address)
{
    struct client made = {.connections = 1};
    write_address(made.key, address);
    for (size_t i = 0; i < sizeof PRIVATE / sizeof PRIVATE[0]; i++)
        if (begins_with(made.key, PRIVATE[i].bytes, PRIVATE[i].bits)) {
            made.is_private = true;
            made.is_loopback = PRIVATE[i].is_loopback;
        }
    if (memcmp(made.key, MAPPED, MAPPED_BYTES) != 0 && !made.is_loopback)
        memset(made.key + NETWORK_BYTES, 0, CLIENT_KEY_SIZE - NETWORK_BYTES);

    struct client **bucket = bucket_of(clients, made.key);
    for (struct client *client = *bucket; client; client = client->next)
        if (memcmp(client->key, made.key, CLIENT_KEY_SIZE) == 0) {
            client->connections++;
            return client;
        }
    struct client *client = malloc(sizeof *client);
    if (!client) return NULL;
    *client = made;
    client->next = *bucket;
    *bucket = client;
    return client;
}

void clients_leave(struct clients *clients, struct client *client)
{
    if (--client->connections > 0) return;
    struct client **link = bucket_of(clients, client->key);
    while (*link != client)
        link = &(*link)->next;
    *link = client->next;
    free(client);
}
