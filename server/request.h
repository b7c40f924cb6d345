/* request.h - a request from its header to its answer, and the data shared by all requests. No sockets, no threads.
 *
 *     router_open    headers       -> an immediate answer, or REQUEST_WORK
 *     route->work    headers, body -> an answer, on a worker, since it takes long or waits for the disk;
 *                                     or, with small_only, REQUEST_LARGE
 */
#ifndef ZRASTERD_REQUEST_H
#define ZRASTERD_REQUEST_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "answer.h"
#include "config.h"
#include "core.h"
#include "http/accept.h"
#include "jobs/slowness.h"
#include "jobs/stream.h"
#include "keep/images.h"
#include "keep/meshes.h"
#include "keep/store.h"
#include "keep/texts.h"
#include "log/log.h"
#include "mcp/handler.h"
#include "routes/multipart.h"

enum { REQUEST_ID_SIZE = 129 };

struct gate; /* gate/gate.h */

struct metrics; /* metrics/metrics.h */

struct engine; /* routes/engine.h */

/* Shared by all requests. Constant, except the gate, the counter and the insides of the store and of the images. */
struct service {
    const struct config *config;
    struct gate *gate; /* who may ask for what; for the thread that serves all connections only */
    struct zr_limits limits;
    struct slowness *slowness;
    struct zr_team *team;
    struct store *store;            /* NULL: no assets are stored */
    struct kept *kept[KEPT_TABLES]; /* NULL: none are kept */
    struct sizes *sizes;            /* of answers of addresses; may be NULL */
    struct metrics *metrics;        /* NULL: nothing is counted */
    const struct engine *engine;    /* files for the page; NULL: none */
    uint64_t id_base;               /* random, so that ids of two daemons differ */
    atomic_uint_fast64_t id_next;
};

/* The caller sets the gate, and those members that may be NULL, before it serves. */
void service_init(struct service *service, const struct config *config, struct zr_team *team,
                  struct slowness *slowness);

/* Returns the limit of the memory of the control group, else the memory of the machine, in bytes. */
double service_memory_limit(const struct service *service);

/* Load of the daemon. */
struct load {
    bool leaving, draining;          /* the daemon is to end; it takes no more work */
    enum refusal queue, large_queue; /* of the queue for a body of this size; of the one for large bodies */
    bool answers_full;               /* unsent answers fill answer_memory_bytes */
    bool client_full;                /* those of the client fill its share */
    bool answers_short;              /* there is room for small answers only; set when work begins */
    unsigned retry_after_s;
};

/* Returns the reason against more work, or REFUSAL_NONE. makes_answer: the work makes a large answer in memory. */
enum refusal load_busy_with(const struct load *load, const struct service *service, bool makes_answer);

struct route;

struct request {
    char id[REQUEST_ID_SIZE];
    struct trace trace;
    struct load load; /* at its beginning */
    const char *method, *path;
    char *query;                                                 /* after the '?', or NULL */
    const char *content_type, *content_encoding, *authorization; /* NULL if not sent */
    const char *if_none_match, *accept_encoding;                 /* NULL if not sent */
    const char *origin, *fetch_site;                             /* of browsers; NULL if not sent */
    const char *asked_method;                                    /* of a preflight; NULL if not sent */
    struct mcp_headers mcp;                                      /* of POST /mcp */
    enum accept_parts parts;                                     /* form of an answer of several files */
    bool takes_open_metrics, takes_tiff;                         /* form of an answer with metrics; with depths */
    struct stream *stream;                                       /* with parts, on a worker; else NULL */
    const struct route *route;                                   /* set by router_open */
    bool gzip;                                                   /* set by router_open: the body is compressed */
    int64_t expires_s; /* set by router_open: end of the address, in seconds since 1970; 0: none */
    bool is_private;   /* set by router_open: a token opened it; shared caches must not keep the answer */
    const char *body;  /* set before the work */
    size_t body_size;
    bool small_only; /* set on the express (queue.h): a request that turns out to be large is given up */

    /* Set by rendering_open and drake_open: */
    char boundary[MULTIPART_BOUNDARY_SIZE]; /* of the body's parts; "": no parts */
    struct zr_request *render; /* malloc'd, without the body; texts of the query follow it; NULL: another route */
    bool is_shareable;         /* an equal request may have the same answer; false: another route, or a stream */

    /* Set by assets_open: */
    const char *asset; /* name of the asset, in `path`; "": a new asset; NULL: another route */
    bool has_asset;    /* If-None-Match: the client has the asset */

    /* Set by renders_open: */
    char scene[STORE_NAME_SIZE];    /* name of the stored scene; "": another route */
    struct zr_file_hash answer_key; /* hash of all that determines the answer */
    bool is_pinned;                 /* the query names its look with the version */
    bool has_preset;                /* SIGHUP may change its parameters */
    bool has_answer;                /* If-None-Match: the client has the answer */
};

/* Sets the id: the client's if it has 1..128 of [A-Za-z0-9._-], else a new one. */
void request_take_id(struct request *request, struct service *service, const char *client_id);

/* Sets the trace from a header (NULL: not sent); a malformed one counts for nothing. */
void request_take_trace(struct request *request, struct service *service, const char *traceparent);

/* REQUEST_LARGE: small_only is set and the request is large; there is no answer yet. */
enum request_next { REQUEST_ANSWERED, REQUEST_WORK, REQUEST_LARGE };

/* Work on a request whose body is here. */
struct work {
    const struct service *service;
    const struct request *request;
    struct zr_arena *arena; /* the answer does not point into it */
    /* `cancel` ends the work, `reading` the reading of the body. With small_only, `cancel` is also raised when the
     * request has run too long for a small one. The body is then still read to its end, which tells whether the request
     * is large. */
    const struct zr_cancel *cancel, *reading;
    struct step_times *times; /* queue_ms is input, the others are output */
    struct answer *answer;
};

/* Larger bodies are never small requests. */
enum { REQUEST_SMALL_BYTES = 64 << 10 };

/* Handler of a path. */
struct route {
    const char *path, *methods; /* a path with a final slash includes all paths below it */
    bool open_to_all;           /* needs no token */

    /* Checks all that is known before the body. False: the answer is ready. */
    bool (*open)(const struct service *service, struct request *request, struct answer *answer);

    /* Returns REQUEST_ANSWERED or REQUEST_LARGE. Thread-safe. NULL: `open` answers. */
    enum request_next (*work)(const struct work *work);
    bool makes_answer;     /* `work` makes a large answer in memory */
    bool has_plain_errors; /* errors are text/plain */
    bool is_signed;        /* needs a signature or a token, if there are keys */
};

#endif
