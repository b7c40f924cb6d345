#include "admit.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>
#include <time.h>

#include "gate.h"
#include "problem.h"
#include "text.h"

static bool has_token(const struct gate *gate, const char *authorization)
{
    static const char SCHEME[] = "Bearer ";
    if (!gate_asks_for_token(gate) || !authorization || strncasecmp(authorization, SCHEME, sizeof SCHEME - 1) != 0)
        return false;
    const char *given = authorization + sizeof SCHEME - 1;
    given += strspn(given, " ");
    return gate_knows_token(gate, given, text_trimmed_length(given));
}

static bool refuse_without_token(struct answer *answer)
{
    answer_header(answer, "WWW-Authenticate", "Bearer realm=\"zraster\"");
    problem_answer(answer, 401, "the header Authorization: Bearer with a valid token is required");
    return false;
}

/* Details of a 403. They reveal nothing of the keys, but that a signature was right once. */
static const char *refusal(enum signature_status status, size_t key_count)
{
    if (key_count == 0) return "this daemon has no keys for signatures; start zrasterd with --keys-file";
    switch (status) {
    case SIGNATURE_MISSING:
        return "this address needs a signature, or a token";
    case SIGNATURE_MALFORMED:
        return "the last parameter of the address is signature, with 64 lower-case hexadecimal digits; exp, before it, "
               "has seconds since 1970; each stands there once";
    case SIGNATURE_EXPIRED:
        return "the signature of this address has expired";
    default:
        return "the signature does not match this address";
    }
}

/* Admits a request for its token, or refuses it. */
static bool admit_token(const struct gate *gate, struct request *request, struct answer *answer)
{
    request->is_private = has_token(gate, request->authorization);
    return request->is_private || !gate_asks_for_token(gate) || refuse_without_token(answer);
}

bool admit(const struct service *service, struct request *request, struct answer *answer)
{
    const struct gate *gate = service->gate;
    const struct route *route = request->route;
    if (route && route->open_to_all) return true;
    if (!route || !route->is_signed) return admit_token(gate, request, answer);

    const struct signature_keys *keys = gate_keys(gate);
    const enum signature_status status =
        signature_check(keys, request->path, request->query, (int64_t)time(NULL), &request->expires_s);
    if (status == SIGNATURE_MISSING && keys->count == 0) return admit_token(gate, request, answer);
    if (status != SIGNATURE_MISSING)
        signature_strip(request->query);
    else
        request->is_private = has_token(gate, request->authorization);
    if (status == SIGNATURE_GOOD || request->is_private) return true;
    problem_answer(answer, 403, "%s", refusal(status, keys->count));
    return false;
}

void admit_caching(const struct request *request, int64_t seconds, bool is_immutable, struct answer *answer)
{
    /* A second less, since clocks here and caches count whole seconds. */
    const int64_t left = request->expires_s - 1 - (int64_t)time(NULL);
    if (request->expires_s > 0 && left < seconds) seconds = left > 0 ? left : 0;
    answer_header(answer, "Cache-Control", "%s, max-age=%" PRId64 "%s%s", request->is_private ? "private" : "public",
                  seconds, is_immutable ? ", immutable" : "", request->expires_s > 0 ? ", must-revalidate" : "");
}
