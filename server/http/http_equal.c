#include "http_equal.h"

#include <string.h>

/* Bytes of bodies that a request is compared with, within a millisecond. */
enum { COMPARED_BYTES = 4 << 20 };

static bool is_same_text(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

/* Compares all but the bytes of the body. The key of an address has the parameters of its preset, which may change
 * meanwhile. Headers of the answer tell whether a token opened the request, and when a signed address ends. */
static bool is_alike(const struct request *a, const struct request *b)
{
    return a->body_size == b->body_size && a->route == b->route && a->gzip == b->gzip &&
           a->is_private == b->is_private && a->expires_s == b->expires_s && a->has_answer == b->has_answer &&
           memcmp(&a->answer_key, &b->answer_key, sizeof a->answer_key) == 0 && is_same_text(a->method, b->method) &&
           is_same_text(a->path, b->path) && is_same_text(a->query, b->query) &&
           is_same_text(a->content_type, b->content_type);
}

static bool is_cancelled(const struct exchange *exchange)
{
    return atomic_load(&exchange->cancel.raised);
}

static void add(struct exchange **list, struct exchange *exchange)
{
    exchange->next_equal = *list;
    *list = exchange;
}

bool http_equal_follow(struct exchange *exchange)
{
    const struct request *request = &exchange->request;
    size_t left = COMPARED_BYTES;
    if (!request->is_shareable) return false;
    for (struct exchange *leader = exchange->http->leaders; leader; leader = leader->next_equal) {
        if (!is_alike(request, &leader->request) || is_cancelled(leader) || request->body_size > left) continue;
        left -= request->body_size;
        if (memcmp(request->body, leader->request.body, request->body_size) != 0) continue;
        exchange->leader = leader;
        add(&leader->followers, exchange);
        return true;
    }
    return false;
}

void http_equal_lead(struct exchange *exchange)
{
    if (exchange->request.is_shareable) add(&exchange->http->leaders, exchange);
}

void http_equal_leave(struct exchange *exchange)
{
    struct exchange **link = exchange->leader ? &exchange->leader->followers : &exchange->http->leaders;
    while (*link && *link != exchange)
        link = &(*link)->next_equal;
    if (*link) *link = exchange->next_equal;
    exchange->leader = NULL;
}

struct exchange *http_equal_take_follower(struct exchange *leader)
{
    struct exchange *follower = leader->followers;
    if (follower) http_equal_leave(follower);
    return follower;
}
