/* client.h - requests to a daemon: through libcurl, and as raw bytes. */
#ifndef TEST_CLIENT_H
#define TEST_CLIENT_H

#include <stdbool.h>
#include <stddef.h>

#include "daemon.h"

#define JSON_TYPE "Content-Type: application/json"

/* The smallest good scene. */
#define GOOD_SCENE "{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}"

struct reply {
    long status;   /* 0: no answer */
    char *headers; /* as received, zero-terminated */
    char *body;    /* zero-terminated beyond `size` */
    size_t size;
};

/* A request in one step. `headers` ends with NULL and may be NULL; body NULL: none. */
struct reply client_send(const struct daemon *daemon, const char *method, const char *target,
                         const char *const *headers, const void *body, size_t size);

/* POST /v1/render of a JSON scene. */
struct reply client_render(const struct daemon *daemon, const char *scene);

struct reply client_get(const struct daemon *daemon, const char *target);

/* A POST whose body is sent chunked: `size` times the byte 'x'. */
struct reply client_send_chunked(const struct daemon *daemon, const char *target, size_t size);

/* For a group of tests whose clients run in threads: libcurl starts by itself only where there is one. */
int clients_setup(void **state);
int clients_teardown(void **state);

void reply_free(struct reply *reply);

/* The value of a header, "" where there is none; valid until the next call. */
const char *reply_header(const struct reply *reply, const char *name);

/* Whether two bodies are the same, byte for byte. */
bool reply_is_same(const struct reply *a, const struct reply *b);

/* Status of a request, its reply thrown away. */
long client_get_status(const struct daemon *daemon, const char *target);
long client_render_status(const struct daemon *daemon, const char *scene);

/* ---- raw ---- */

int client_connect(const struct daemon *daemon);

/* Sends all of it; false, and no signal, where the other side takes no more. */
bool client_write(int fd, const char *bytes, size_t size);

/* Sends a render of a JSON scene and does not wait for its answer: the connection. No two of them are equal requests,
 * which share their work. */
int client_begin_render(const struct daemon *daemon, const char *scene);

/* Waits until /metrics has `line`; the running test fails where it has not in some seconds. `before` is sent ahead of
 * the request: "", or a PROXY header. */
void client_wait_for_metric(const struct daemon *daemon, const char *before, const char *line);
#define ONE_AT_WORK               "zraster_workers_busy 1"
#define AT_WORK_OR_WAITING(count) "zraster_http_connections{phase=\"work\"} " count

/* Sends `bytes` and reads until the daemon closes, at most `timeout_ms` of
 * silence. Zero-terminated; free it. */
char *client_raw(const struct daemon *daemon, const char *bytes, size_t size, int timeout_ms);

/* Reads until the other side closes, `until` has come (NULL: never), or `timeout_ms` of silence. */
char *client_read(int fd, const char *until, int timeout_ms);

/* Status of the first answer in what was read, 0 where there is none; and how many answers there are. */
int raw_status(const char *text);
int raw_count(const char *text);

/* Seconds, by a clock that never goes back. */
double client_seconds(void);

/* ---- scenes ---- */

/* For what writes every sample of every polygon, one by one and on one thread, and so stays slow however fast
 * production becomes. */
#define SLOW_ALGORITHM "edgelist"

/* A window `side` pixels wide and high, and `count` polygons that each fill it: with SLOW_SIDE and SLOW_ALGORITHM, a
 * millisecond or more each. Free it. */
enum { SLOW_SIDE = 1024 };
char *scene_slow(const char *algorithm, int side, int count);

#endif
