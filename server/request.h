/* request.h - what a request is on its way from the header to its answer, and what all requests share. Knows no sockets
 * and no threads.
 *
 *     router_open    headers       -> an answer at once, or REQUEST_WORK
 *     router_work    headers, body -> an answer, on a worker: it takes long, or waits for the disk;
 *                                     or, where only small work was asked for, that it is large
 */
#ifndef ZRASTERD_REQUEST_H
#define ZRASTERD_REQUEST_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "answer.h"
#include "config.h"
#include "multipart.h"
#include "step_times.h"
#include "store.h"
#include "zraster.h"

enum { REQUEST_ID_SIZE = 129 };

/* Shared by all requests; read-only but for the counter and what the store does inside. */
struct service {
    const struct config *config;
    struct zr_limits limits;
    double slowness; /* slowness.h */
    struct zr_team *team;
    struct store *store; /* NULL: no assets are kept */
    uint64_t id_base;    /* random, so that ids of two daemons differ */
    atomic_uint_fast64_t id_next;
};

/* `store` may be NULL. */
void service_init(struct service *service, const struct config *config, struct zr_team *team, double slowness,
                  struct store *store);

/* The state of the daemon as a request meets it. */
struct load {
    bool draining;
    bool queue_full, large_queue_full; /* that for a body of this size, and that for large ones */
    bool answers_full;                 /* those that wait for their readers */
    unsigned retry_after_s;
};

/* Why no work can be taken on now; NULL: one can. makes_answer: a large one, in memory. */
const char *load_busy_with(const struct load *load, const struct service *service, bool makes_answer);

struct route;

struct request {
    char id[REQUEST_ID_SIZE];
    const char *method, *path;
    const char *query;                                           /* behind the '?', NULL where there is none */
    const char *content_type, *content_encoding, *authorization; /* NULL where not sent */
    const char *if_none_match;                                   /* likewise */
    const struct route *route;                                   /* by router_open */
    bool gzip;                                                   /* by it, too: the body is compressed */
    bool small_only; /* by the caller: what turns out to be large is not begun, or given up */

    /* By rendering_open. */
    char boundary[MULTIPART_BOUNDARY_SIZE]; /* of the body's parts; "": it has none */
    struct zr_request render;               /* `bytes` and `size` by the caller */
    char *query_values;                     /* what `render` points into */

    /* By assets_open. */
    const char *asset; /* in `path`: the name of the asset that this is about; "": a new one; NULL: none */
    bool has_asset;    /* If-None-Match says that the client has it */
};

void request_free(struct request *request);

/* Keeps the client's id where it is 1..128 of [A-Za-z0-9._-], else makes one. */
void request_take_id(struct request *request, struct service *service, const char *client_id);

/* REQUEST_LARGE: small_only was asked for, and is not so; there is no answer yet. */
enum request_next { REQUEST_ANSWERED, REQUEST_WORK, REQUEST_LARGE };

/* A body beyond this is no small request's, whatever is in it. */
enum { REQUEST_SMALL_BYTES = 64 << 10 };

/* What is answered to a path. */
struct route {
    const char *path, *methods; /* a path that ends with a slash: and all below it */
    bool open_to_all;           /* no token is asked for */

    /* All that can be said before the body; false: it is answered. */
    bool (*open)(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);

    /* As router_work. NULL: `open` answers. */
    enum request_next (*work)(const struct service *service, const struct request *request, struct zr_arena *arena,
                              const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);
    bool makes_answer; /* `work` makes a large one, in memory */
};

#endif
