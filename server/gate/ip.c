#include "ip.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <string.h>

enum { MAPPED_BYTES = 12, FOUR_BYTES = 4 };

static const uint8_t MAPPED[MAPPED_BYTES] = {[10] = 0xFF, [11] = 0xFF}; /* ::ffff:0:0/96 */

/* Private networks: the first `bits` of an address. Sources: RFC 1918, 3927, 4193, 4291, 1122. */
static const struct {
    struct ip prefix;
    unsigned bits;
    bool is_loopback;
} PRIVATE[] = {
    {{{[10] = 0xFF, [11] = 0xFF, [12] = 127}}, 96 + 8, true},
    {{{[10] = 0xFF, [11] = 0xFF, [12] = 10}}, 96 + 8, false},
    {{{[10] = 0xFF, [11] = 0xFF, [12] = 172, [13] = 16}}, 96 + 12, false},
    {{{[10] = 0xFF, [11] = 0xFF, [12] = 192, [13] = 168}}, 96 + 16, false},
    {{{[10] = 0xFF, [11] = 0xFF, [12] = 169, [13] = 254}}, 96 + 16, false},
    {{{[15] = 1}}, 128, true},
    {{{[0] = 0xFC}}, 7, false},
    {{{[0] = 0xFE, [1] = 0x80}}, 10, false},
};

enum { PRIVATE_COUNT = sizeof PRIVATE / sizeof PRIVATE[0] };

struct ip ip_of_four(const uint8_t bytes[4])
{
    struct ip ip;
    memcpy(ip.bytes, MAPPED, MAPPED_BYTES);
    memcpy(ip.bytes + MAPPED_BYTES, bytes, FOUR_BYTES);
    return ip;
}

struct ip ip_of_socket(const struct sockaddr *address)
{
    struct ip ip = {{0}};
    if (address->sa_family == AF_INET6)
        memcpy(ip.bytes, &((const struct sockaddr_in6 *)(const void *)address)->sin6_addr, IP_SIZE);
    else if (address->sa_family == AF_INET)
        ip = ip_of_four((const uint8_t *)&((const struct sockaddr_in *)(const void *)address)->sin_addr);
    return ip;
}

bool ip_parse(struct ip *ip, const char *text, size_t length)
{
    char copy[IP_TEXT_SIZE];
    uint8_t four[FOUR_BYTES];
    if (length >= sizeof copy || memchr(text, '\0', length)) return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    if (inet_pton(AF_INET6, copy, ip->bytes) == 1) return true;
    if (inet_pton(AF_INET, copy, four) != 1) return false;
    *ip = ip_of_four(four);
    return true;
}

void ip_print(const struct ip *ip, char text[IP_TEXT_SIZE])
{
    const bool is_four = ip_is_four(ip);
    inet_ntop(is_four ? AF_INET : AF_INET6, ip->bytes + (is_four ? MAPPED_BYTES : 0), text, IP_TEXT_SIZE);
}

bool ip_is_same(const struct ip *a, const struct ip *b)
{
    return memcmp(a->bytes, b->bytes, IP_SIZE) == 0;
}

bool ip_is_four(const struct ip *ip)
{
    return memcmp(ip->bytes, MAPPED, MAPPED_BYTES) == 0;
}

bool ip_begins_with(const struct ip *ip, const struct ip *prefix, unsigned bits)
{
    const unsigned whole = bits / 8, rest = bits % 8;
    if (memcmp(ip->bytes, prefix->bytes, whole) != 0) return false;
    return rest == 0 || (uint8_t)((ip->bytes[whole] ^ prefix->bytes[whole]) >> (8 - rest)) == 0;
}

bool ip_is_loopback(const struct ip *ip)
{
    for (size_t i = 0; i < PRIVATE_COUNT; i++)
        if (PRIVATE[i].is_loopback && ip_begins_with(ip, &PRIVATE[i].prefix, PRIVATE[i].bits)) return true;
    return false;
}

bool ip_is_private(const struct ip *ip)
{
    for (size_t i = 0; i < PRIVATE_COUNT; i++)
        if (ip_begins_with(ip, &PRIVATE[i].prefix, PRIVATE[i].bits)) return true;
    return false;
}
