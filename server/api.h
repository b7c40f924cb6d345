/* api.h - what the daemon answers to what: method, path, headers and bytes in,
 * status, headers and bytes out. Knows no sockets and no threads.
 *
 *     api_open    headers       -> an answer at once, or API_WORK
 *     api_work    headers, body -> an answer, on a worker: it takes long, or waits for the disk;
 *                                  or, where only small work was asked for, that it is large
 */
#ifndef ZRASTERD_API_H
#define ZRASTERD_API_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "answer.h"
#include "config.h"
#include "foresight.h"
#include "multipart.h"
#include "step_times.h"
#include "store.h"
#include "zraster.h"

enum { API_ID_SIZE = 129 };

/* Shared by all requests; read-only but for the counter and what the store and foresight do inside. */
struct api {
    const struct config *config;
    struct zr_limits limits;
    struct foresight *foresight;
    struct zr_team *team;
    struct store *store; /* NULL: no assets are kept */
    uint64_t id_base;    /* random, so that ids of two daemons differ */
    atomic_uint_fast64_t id_next;
};

/* `store` may be NULL. */
void api_init(struct api *api, const struct config *config, struct zr_team *team, struct foresight *foresight,
              struct store *store);

/* The state of the daemon as a request meets it. */
struct api_load {
    bool draining;
    bool queue_full, large_queue_full; /* that for a body of this size, and that for large ones */
    bool answers_full;                 /* those that wait for their readers */
    unsigned retry_after_s;
};

struct api_request {
    char id[API_ID_SIZE];
    const char *method, *path;
    const char *query;                                           /* behind the '?', NULL where there is none */
    const char *content_type, *content_encoding, *authorization; /* NULL where not sent */
    const char *if_none_match;                                   /* likewise */
    bool gzip;                                                   /* by api_open: the body is compressed */
    char boundary[MULTIPART_BOUNDARY_SIZE];                      /* by api_open: of its parts; "": it has none */
    /* By api_open, in `path`: the name of the asset that this is about; "": a new one; NULL: a render. */
    const char *asset;
    bool small_only;          /* by the caller: what turns out to be large is not begun, or given up */
    bool has_asset;           /* by api_open: If-None-Match says that the client has it */
    struct zr_request render; /* by api_open; then `bytes` and `size` by the caller */
    char *query_values;       /* what `render` points into */
};

void api_request_free(struct api_request *request);

/* Keeps the client's id where it is 1..128 of [A-Za-z0-9._-], else makes one. */
void api_take_id(struct api *api, struct api_request *request, const char *client_id);

/* API_LARGE: small_only was asked for, and is not so; there is no answer yet. */
enum api_next { API_ANSWERED, API_WORK, API_LARGE };

/* A body beyond this is no small request's, whatever is in it. */
enum { API_SMALL_BYTES = 64 << 10 };

enum api_next api_open(const struct api *api, const struct api_load *load, struct api_request *request,
                       struct answer *answer);

/* Works in `arena`; the answer's bytes are a copy of their own. Thread-safe. Where small_only is asked for, `cancel`
 * has a parent that is raised once the request has taken too long for a small one: it is large then. times->queue_ms is
 * given, the others are filled in. API_ANSWERED or API_LARGE. */
enum api_next api_work(const struct api *api, const struct api_request *request, struct zr_arena *arena,
                       const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);

/* 200 with a copy of the bytes: the arena they lie in is needed for the next request. */
void api_answer_copy(struct answer *answer, const char *content_type, const void *bytes, size_t size);

/* The arena has failed: 422 for a request that can never fit, with what it needs; 503 where it is the system that has
 * no memory just now. */
void api_refuse_memory(struct answer *answer, const struct zr_arena *arena);

/* The request was cancelled, since its time was over: 504. */
void api_refuse_late(const struct api *api, struct answer *answer);

/* Answers with 503 and says when to come again. */
void api_refuse_busy(struct answer *answer, unsigned retry_after_s, const char *detail);

/* The headers that every answer has. Call once, last. */
void api_finish(struct answer *answer, const char *request_id);

#endif
