#include "clients.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

enum { NETWORK_BYTES = 8 };

/* Addresses are no secrets, and a long bucket costs little beside a connection. */
static struct client **bucket_of(struct clients *clients, const struct ip *key)
{
    uint32_t hash = ZR_HASH_BEGIN;
    for (int i = 0; i < IP_SIZE; i++)
        hash = zr_hash_byte(hash, key->bytes[i]);
    return &clients->buckets[hash % CLIENT_BUCKETS];
}

struct client *clients_join(struct clients *clients, const struct ip *address)
{
    struct ip key = *address;
    const bool is_loopback = ip_is_loopback(address);
    if (!ip_is_four(address) && !is_loopback) memset(key.bytes + NETWORK_BYTES, 0, IP_SIZE - NETWORK_BYTES);

    struct client **bucket = bucket_of(clients, &key);
    for (struct client *client = *bucket; client; client = client->next)
        if (ip_is_same(&client->key, &key)) {
            client->connections++;
            return client;
        }
    struct client *client = calloc(1, sizeof *client);
    if (!client) return NULL;
    client->key = key;
    client->is_loopback = is_loopback;
    client->is_private = ip_is_private(address);
    client->connections = 1;
    client->next = *bucket;
    *bucket = client;
    return client;
}

void clients_leave(struct clients *clients, struct client *client)
{
    if (--client->connections > 0) return;
    struct client **link = bucket_of(clients, &client->key);
    while (*link != client)
        link = &(*link)->next;
    *link = client->next;
    free(client);
}
