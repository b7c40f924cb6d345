/* ip.h - IP addresses: of sockets, of texts, and their kinds. Pure. */
#ifndef ZRASTERD_IP_H
#define ZRASTERD_IP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/socket.h>

enum { IP_SIZE = 16, IP_TEXT_SIZE = 46 };

/* IPv4 as ::ffff:a.b.c.d. All zero: none. */
struct ip {
    uint8_t bytes[IP_SIZE];
};

struct ip ip_of_socket(const struct sockaddr *address);
struct ip ip_of_four(const uint8_t bytes[4]);

/* Parses a numeric address: "192.0.2.1" or "2001:db8::1", without port, brackets and zone. */
bool ip_parse(struct ip *ip, const char *text, size_t length);

/* Prints IPv4 in its own form. */
void ip_print(const struct ip *ip, char text[IP_TEXT_SIZE]);

bool ip_is_same(const struct ip *a, const struct ip *b);
bool ip_is_four(const struct ip *ip);

/* Returns true if both addresses have the same first `bits`. */
bool ip_begins_with(const struct ip *ip, const struct ip *prefix, unsigned bits);

bool ip_is_loopback(const struct ip *ip);

/* Returns true for loopback and for networks without routes on the internet. */
bool ip_is_private(const struct ip *ip);

#endif
