#include "http_room.h"

/* Parts of the whole. */
enum { SMALL_PART = 8, CLIENT_PART = 2 };

bool http_room_is_full(struct http *http)
{
    return atomic_load(&http->answer_bytes) >= http->config->answer_memory_bytes;
}

bool http_room_is_small(struct http *http, size_t more)
{
    const uint64_t most = http->config->answer_memory_bytes;
    return atomic_load(&http->answer_bytes) + more >= most - most / SMALL_PART;
}

bool http_room_is_taken_by(const struct http *http, struct client *client)
{
    return client && atomic_load(&client->answer_bytes) > http->config->answer_memory_bytes / CLIENT_PART;
}

bool http_room_is_short(struct http *http)
{
    const struct config *config = http->config;
    return 4 * atomic_load(&http->streams) >= 3 * config->max_streams ||
           atomic_load(&http->answer_bytes) / 3 >= config->answer_memory_bytes / 4;
}

void http_room_take(struct exchange *exchange, size_t bytes)
{
    atomic_fetch_add(&exchange->http->answer_bytes, bytes);
    if (exchange->holder) atomic_fetch_add(&exchange->holder->answer_bytes, bytes);
}

void http_room_return(struct exchange *exchange, size_t bytes)
{
    atomic_fetch_sub(&exchange->http->answer_bytes, bytes);
    if (exchange->holder) atomic_fetch_sub(&exchange->holder->answer_bytes, bytes);
}

/* Adds to a sum that stays below `end`. */
static bool add_below(atomic_size_t *sum, size_t bytes, uint64_t end)
{
    size_t before = atomic_load(sum);
    do
        if (before + bytes >= end) return false;
    while (!atomic_compare_exchange_weak(sum, &before, before + bytes));
    return true;
}

/* The first answer of a client that waits may take more than its share: the others are less than half of that. */
enum refusal http_room_take_stream(struct exchange *exchange, size_t bytes)
{
    struct http *http = exchange->http;
    struct client *client = exchange->holder;
    const uint64_t most = http->config->answer_memory_bytes, share = most / CLIENT_PART;
    const size_t others = client ? atomic_load(&client->answer_bytes) - exchange->answer_bytes : 0;
    if (others + bytes > share && others > share / 2) return REFUSAL_SHARE;
    if (!add_below(&http->answer_bytes, bytes, most - most / SMALL_PART)) return REFUSAL_ANSWERS;
    if (client) atomic_fetch_add(&client->answer_bytes, bytes);
    return REFUSAL_NONE;
}

static void count_stream(struct exchange *exchange, size_t by)
{
    atomic_fetch_add(&exchange->http->streams, by);
    if (exchange->holder) atomic_fetch_add(&exchange->holder->streams, by);
}

static enum refusal find_place(struct exchange *exchange)
{
    struct http *http = exchange->http;
    const size_t most = (size_t)http->config->max_streams, part = most / CLIENT_PART, share = part ? part : 1;
    if (atomic_load(&http->streams) > most) return REFUSAL_STREAMS;
    return exchange->holder && atomic_load(&exchange->holder->streams) > share ? REFUSAL_STREAM_SHARE : REFUSAL_NONE;
}

enum refusal http_room_open_stream(struct exchange *exchange)
{
    if (http_room_is_small(exchange->http, 0)) return REFUSAL_ANSWERS;
    count_stream(exchange, 1);
    const enum refusal refusal = find_place(exchange);
    exchange->has_stream = !refusal;
    if (refusal) count_stream(exchange, SIZE_MAX);
    return refusal;
}

void http_room_close_stream(struct exchange *exchange)
{
    if (exchange->has_stream) count_stream(exchange, SIZE_MAX);
}

void http_room_leave(struct exchange *exchange)
{
    http_room_return(exchange, exchange->answer_bytes);
    if (exchange->holder) clients_leave(&exchange->http->connections.clients, exchange->holder);
}
