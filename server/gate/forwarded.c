#include "forwarded.h"

#include <string.h>
#include <strings.h>

enum { NODE_SIZE = 64, PORT_DIGITS = 5 };

struct text {
    const char *at;
    size_t length;
};

bool forwarded_form_parse(enum forwarded_form *form, const char *word)
{
    static const char *const WORDS[] = {
        [FORWARDED_NONE] = "none", [FORWARDED_FOR] = "x-forwarded-for", [FORWARDED_STANDARD] = "forwarded"};
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++)
        if (strcmp(word, WORDS[i]) == 0) {
            *form = (enum forwarded_form)i;
            return true;
        }
    return false;
}

const char *forwarded_header(enum forwarded_form form)
{
    return form == FORWARDED_FOR ? "x-forwarded-for" : form == FORWARDED_STANDARD ? "forwarded" : NULL;
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t';
}

static struct text trim(const char *from, const char *to)
{
    while (from < to && is_space(*from))
        from++;
    while (from < to && is_space(to[-1]))
        to--;
    return (struct text){from, (size_t)(to - from)};
}

static bool is_port(const char *from, const char *to)
{
    if (from == to || to - from > PORT_DIGITS) return false;
    for (; from < to; from++)
        if (*from < '0' || *from > '9') return false;
    return true;
}

/* Parses an address with or without a port: "192.0.2.1:80", "[2001:db8::1]:80". Some proxies write IPv6 without
 * brackets. */
static bool parse_node(struct ip *ip, struct text node)
{
    const char *const end = node.at + node.length;
    if (node.length > 0 && *node.at == '[') {
        const char *close = memchr(node.at, ']', node.length);
        if (!close || (close + 1 < end && (close[1] != ':' || !is_port(close + 2, end)))) return false;
        const size_t length = (size_t)(close - node.at - 1);
        return memchr(node.at + 1, ':', length) && ip_parse(ip, node.at + 1, length);
    }
    const char *colon = memchr(node.at, ':', node.length);
    const bool has_port = colon && !memchr(colon + 1, ':', (size_t)(end - colon - 1));
    if (has_port && !is_port(colon + 1, end)) return false;
    return ip_parse(ip, node.at, has_port ? (size_t)(colon - node.at) : node.length);
}

/* Removes quotes and backslashes (RFC 9110, 5.6.4). */
static bool parse_value(struct ip *ip, struct text value)
{
    char node[NODE_SIZE];
    size_t used = 0;
    if (value.length < 2 || *value.at != '"' || value.at[value.length - 1] != '"')
        return !memchr(value.at, '"', value.length) && parse_node(ip, value);
    for (size_t i = 1; i < value.length - 1; i++) {
        if (value.at[i] == '\\' && ++i == value.length - 1) return false;
        if (used == sizeof node) return false;
        node[used++] = value.at[i];
    }
    return parse_node(ip, (struct text){node, used});
}

/* Returns the end of a parameter: the next semicolon outside of quotes, or `end`. */
static const char *parameter_end(const char *at, const char *end)
{
    bool is_quoted = false;
    for (; at < end && (is_quoted || *at != ';'); at++)
        if (*at == '"')
            is_quoted = !is_quoted;
        else if (is_quoted && *at == '\\' && at + 1 < end)
            at++;
    return at;
}

/* Parses for=... of an item such as 'proto=http;for="[2001:db8::1]:80"'. False: it has none, or two. */
static bool parse_standard(struct ip *ip, struct text item)
{
    const char *const end = item.at + item.length;
    size_t found = 0;
    for (const char *at = item.at; at < end;) {
        const char *stop = parameter_end(at, end);
        const struct text parameter = trim(at, stop);
        at = stop < end ? stop + 1 : end;
        if (parameter.length < 4 || strncasecmp(parameter.at, "for=", 4) != 0) continue;
        if (!parse_value(ip, (struct text){parameter.at + 4, parameter.length - 4})) return false;
        found++;
    }
    return found == 1;
}

/* Returns the last item of the text from `list` to `*end`, and moves *end to the comma before it, or to NULL. A comma
 * is outside of quotes if the quotes behind it are in pairs: quotes that a client opened before it do not count. */
static struct text last_item(const char *list, const char **end, bool has_quotes)
{
    const char *const stop = *end;
    size_t quotes = 0;
    for (const char *at = stop; at > list; at--) {
        quotes += has_quotes && at[-1] == '"';
        if (at[-1] == ',' && quotes % 2 == 0) {
            *end = at - 1;
            return trim(at, stop);
        }
    }
    *end = NULL;
    return trim(list, stop);
}

struct ip forwarded_client(enum forwarded_form form, const struct networks *trusted, const struct ip *peer,
                           const char *list)
{
    struct ip client = *peer, next = *peer;
    for (const char *end = list + strlen(list); end && networks_contain(trusted, &client);) {
        const struct text item = last_item(list, &end, form == FORWARDED_STANDARD);
        if (item.length == 0) continue; /* RFC 9110, 5.6.1: empty items count for nothing */
        if (!(form == FORWARDED_STANDARD ? parse_standard(&next, item) : parse_node(&next, item))) break;
        client = next;
    }
    return client;
}
