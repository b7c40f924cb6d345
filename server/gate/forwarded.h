/* forwarded.h - the client's address in X-Forwarded-For or Forwarded (RFC 7239). Pure.
 *
 * Each proxy appends the address that it received from. So the list is read from its end, as far as trusted proxies
 * wrote it. Entries of the client itself stand before that and are not read.
 */
#ifndef ZRASTERD_FORWARDED_H
#define ZRASTERD_FORWARDED_H

#include "networks.h"

/* The header that trusted proxies write. */
enum forwarded_form { FORWARDED_NONE, FORWARDED_FOR, FORWARDED_STANDARD };

/* Parses "none", "x-forwarded-for" or "forwarded". */
bool forwarded_form_parse(enum forwarded_form *form, const char *word);

/* Returns the name of the header in lower case; FORWARDED_NONE: NULL. */
const char *forwarded_header(enum forwarded_form form);

/* Returns the last address of the list that is no trusted proxy's; if all are, the first. Where an item has no address
 * ("unknown", "_hidden", anything malformed), that is the address behind it; behind the last one is `peer`, the address
 * that the daemon received from. `list`: the values of all such headers, joined by commas in their order. */
struct ip forwarded_client(enum forwarded_form form, const struct networks *trusted, const struct ip *peer,
                           const char *list);

#endif
