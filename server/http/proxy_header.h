/* proxy_header.h - the PROXY header, by which a load balancer gives the address of its client: versions 1 and 2.
 *
 *     proxy_header_take(&header, bytes, count)     for the first bytes of a connection, in pieces of any size
 *
 * Pure: no sockets. Source of the rules: haproxy.org, proxy-protocol.txt.
 */
#ifndef ZRASTERD_PROXY_HEADER_H
#define ZRASTERD_PROXY_HEADER_H

#include "gate/ip.h"

/* Longest headers, in bytes. Version 2: 16, the addresses, and values (TLV), which are skipped. */
enum { PROXY_HEADER_V1_MAX = 107, PROXY_HEADER_V2_MAX = 4096 };

/* Starts as {0}. */
struct proxy_header {
    uint8_t bytes[PROXY_HEADER_V1_MAX]; /* the first `taken` ones */
    uint32_t taken, size;               /* size: of a header of version 2, once it is known */
    bool is_whole;
    bool has_source; /* false: the load balancer speaks for itself, or does not know its client */
    struct ip source;
    const char *wrong; /* the fault, or NULL */
};

/* Takes bytes up to the end of the header or to a fault, and returns their number. */
size_t proxy_header_take(struct proxy_header *header, const char *bytes, size_t size);

/* Returns true if bytes begin as a PROXY header does. */
bool proxy_header_begins(const char *bytes, size_t size);

#endif
