#include "networks.h"

#include <string.h>

enum { FOUR_OFFSET = 96, BITS_DIGITS = 3 };

static bool is_word(const char *text, size_t length, const char *word)
{
    return length == strlen(word) && memcmp(text, word, length) == 0;
}

static bool parse_bits(const char *text, size_t length, unsigned most, unsigned *bits)
{
    *bits = 0;
    if (length == 0 || length > BITS_DIGITS) return false;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return false;
        *bits = *bits * 10 + (unsigned)(text[i] - '0');
    }
    return *bits <= most;
}

/* IPv4 in IPv6 form, ::ffff:a.b.c.d/N, has the bits of IPv6. */
static bool parse_network(struct network *network, const char *text, size_t length)
{
    const char *slash = memchr(text, '/', length);
    const size_t address_length = slash ? (size_t)(slash - text) : length;
    const unsigned offset = memchr(text, ':', address_length) ? 0 : FOUR_OFFSET;
    if (!ip_parse(&network->prefix, text, address_length)) return false;
    network->bits = 8 * IP_SIZE - offset;
    if (slash && !parse_bits(slash + 1, length - address_length - 1, network->bits, &network->bits)) return false;
    network->bits += offset;
    const bool is_all_of_four = ip_is_four(&network->prefix) && network->bits <= FOUR_OFFSET;
    return network->bits > 0 && !is_all_of_four;
}

bool networks_parse(struct networks *networks, const char *list)
{
    static const char BETWEEN[] = " ,";
    size_t length;
    *networks = (struct networks){0};
    for (const char *at = list + strspn(list, BETWEEN); *at; at += length, at += strspn(at, BETWEEN)) {
        length = strcspn(at, BETWEEN);
        if (is_word(at, length, "loopback"))
            networks->has_loopback = true;
        else if (is_word(at, length, "private"))
            networks->has_private = true;
        else if (networks->count == NETWORKS_MAX || !parse_network(&networks->items[networks->count++], at, length))
            return false;
    }
    return true;
}

bool networks_contain(const struct networks *networks, const struct ip *ip)
{
    for (size_t i = 0; i < networks->count; i++)
        if (ip_begins_with(ip, &networks->items[i].prefix, networks->items[i].bits)) return true;
    return (networks->has_loopback && ip_is_loopback(ip)) || (networks->has_private && ip_is_private(ip));
}
