#include "watchdog.h"

#include <linux/tcp.h>
#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "clock.h"

enum {
    TICK_WORK_MS = 20, /* a client that left is noticed within 50 ms */
    TICK_MS = 50,
    RATE_GRACE_MS = 5000, /* before the average speed of a body says anything */
    LINGER_MS = 2000,     /* a refused client may go on sending: closing at once would reset what it should read */
    RELEASES_MAX = 64     /* a tick */
};

struct watchdog {
    const struct config *config;
    struct watchdog_calls calls;
    void *context;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    pthread_t thread;
    bool stopping;
    struct watch *first;
    size_t poll_capacity;
    struct pollfd *polled;
    struct watch **polled_watches;
};

static uint64_t bytes_received(const struct watch *watch)
{
    struct tcp_info info = {0};
    socklen_t size = sizeof info;
    if (getsockopt(watch->socket_fd, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
    return info.tcpi_bytes_received;
}

bool watchdog_has_unknown_bytes(const struct watch *watch)
{
    /* The kernel counts the client's FIN as a byte. */
    return bytes_received(watch) > watch->received_before + 1;
}

/* ---- with the lock held ---- */

static void refuse(struct watch *watch, const struct answer *answer)
{
    answer_send(answer, watch->socket_fd);
    shutdown(watch->socket_fd, SHUT_WR);
    watch->phase = WATCH_REFUSED;
    watch->in_flight = false;
    watch->deadline_ms = clock_ms() + LINGER_MS;
}

static void expire(struct watchdog *watchdog, struct watch *watch, int64_t now)
{
    bool kept = watch->phase == WATCH_HEADER && watch->idle_deadline_ms > 0;
    if (kept && bytes_received(watch) == watch->received_before && now < watch->idle_deadline_ms) {
        watch->deadline_ms = now + (int64_t)watchdog->config->header_timeout_ms;
        if (watch->deadline_ms > watch->idle_deadline_ms) watch->deadline_ms = watch->idle_deadline_ms;
    } else if (watch->phase == WATCH_WORK) {
        atomic_store(&watch->cancel->raised, true);
        watch->deadline_ms = INT64_MAX;
    } else if (watch->phase == WATCH_BODY ||
               (watch->phase == WATCH_HEADER && !(kept && bytes_received(watch) == watch->received_before))) {
        struct answer answer = {0};
        watchdog->calls.expired(watchdog->context, watch, &answer);
        refuse(watch, &answer);
        answer_free(&answer);
    } else {
        shutdown(watch->socket_fd, SHUT_RDWR);
        watch->deadline_ms = INT64_MAX;
    }
}

static bool too_slow(const struct watchdog *watchdog, const struct watch *watch, int64_t now)
{
    int64_t elapsed = now - watch->began_ms;
    return watch->phase == WATCH_BODY && elapsed > RATE_GRACE_MS &&
           (double)watch->body_bytes * 1000.0 < (double)watchdog->config->body_min_bytes_per_second * (double)elapsed;
}

/* Fills `released` with the owners whose clients left before any work was done. */
static size_t look_for_lost_clients(struct watchdog *watchdog, size_t polled, void *released[RELEASES_MAX])
{
    size_t count = 0;
    if (polled == 0 || poll(watchdog->polled, (nfds_t)polled, 0) <= 0) return 0;
    for (size_t i = 0; i < polled && count < RELEASES_MAX; i++) {
        struct watch *watch = watchdog->polled_watches[i];
        if (!watchdog->polled[i].revents) continue;
        watch->client_left = true;
        atomic_store(&watch->cancel->raised, true);
        if (watchdog->calls.withdraw(watchdog->context, watch->owner)) released[count++] = watch->owner;
    }
    return count;
}

static size_t look(struct watchdog *watchdog, void *released[RELEASES_MAX])
{
    int64_t now = clock_ms();
    size_t polled = 0;
    for (struct watch *watch = watchdog->first; watch; watch = watch->next) {
        if (now >= watch->deadline_ms || too_slow(watchdog, watch, now)) expire(watchdog, watch, now);
        if (watch->phase == WATCH_WORK && !watch->client_left && polled < watchdog->poll_capacity) {
            watchdog->polled[polled] = (struct pollfd){.fd = watch->socket_fd, .events = POLLRDHUP};
            watchdog->polled_watches[polled++] = watch;
        }
    }
    return look_for_lost_clients(watchdog, polled, released);
}

static void wait_for_tick(struct watchdog *watchdog)
{
    if (!watchdog->first) {
        pthread_cond_wait(&watchdog->changed, &watchdog->lock);
        return;
    }
    uint64_t tick = TICK_MS;
    for (struct watch *watch = watchdog->first; watch; watch = watch->next)
        if (watch->phase == WATCH_WORK) tick = TICK_WORK_MS;
    const struct timespec until = clock_after_ms(tick);
    pthread_cond_timedwait(&watchdog->changed, &watchdog->lock, &until);
}

static void *watch_all(void *argument)
{
    struct watchdog *watchdog = argument;
    void *released[RELEASES_MAX];
    pthread_mutex_lock(&watchdog->lock);
    while (!watchdog->stopping) {
        size_t count = look(watchdog, released);
        if (count > 0) {
            /* Not under our lock: resuming a connection takes libmicrohttpd's. */
            pthread_mutex_unlock(&watchdog->lock);
            for (size_t i = 0; i < count; i++)
                watchdog->calls.release(watchdog->context, released[i]);
            pthread_mutex_lock(&watchdog->lock);
        }
        if (!watchdog->stopping) wait_for_tick(watchdog);
    }
    pthread_mutex_unlock(&watchdog->lock);
    return NULL;
}

/* ---- life ---- */

struct watchdog *watchdog_create(const struct config *config, const struct watchdog_calls *calls, void *context)
{
    struct watchdog *watchdog = calloc(1, sizeof *watchdog);
    if (!watchdog) return NULL;
    watchdog->config = config;
    watchdog->calls = *calls;
    watchdog->context = context;
    watchdog->poll_capacity = config->max_connections;
    watchdog->polled = calloc(watchdog->poll_capacity, sizeof *watchdog->polled);
    watchdog->polled_watches = calloc(watchdog->poll_capacity, sizeof *watchdog->polled_watches);
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&watchdog->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    pthread_mutex_init(&watchdog->lock, NULL);
    if (!watchdog->polled || !watchdog->polled_watches ||
        pthread_create(&watchdog->thread, NULL, watch_all, watchdog) != 0) {
        free(watchdog->polled);
        free(watchdog->polled_watches);
        free(watchdog);
        return NULL;
    }
    return watchdog;
}

void watchdog_destroy(struct watchdog *watchdog)
{
    if (!watchdog) return;
    pthread_mutex_lock(&watchdog->lock);
    watchdog->stopping = true;
    pthread_cond_signal(&watchdog->changed);
    pthread_mutex_unlock(&watchdog->lock);
    pthread_join(watchdog->thread, NULL);
    pthread_cond_destroy(&watchdog->changed);
    pthread_mutex_destroy(&watchdog->lock);
    free(watchdog->polled);
    free(watchdog->polled_watches);
    free(watchdog);
}

void watchdog_add(struct watchdog *watchdog, struct watch *watch)
{
    pthread_mutex_lock(&watchdog->lock);
    watch->phase = WATCH_HEADER;
    watch->began_ms = clock_ms();
    watch->deadline_ms = watch->began_ms + (int64_t)watchdog->config->header_timeout_ms;
    watch->next = watchdog->first;
    if (watch->next)
        watch->next->previous = watch;
    else
        pthread_cond_signal(&watchdog->changed);
    watchdog->first = watch;
    pthread_mutex_unlock(&watchdog->lock);
}

void watchdog_remove(struct watchdog *watchdog, struct watch *watch)
{
    pthread_mutex_lock(&watchdog->lock);
    if (watch->previous)
        watch->previous->next = watch->next;
    else
        watchdog->first = watch->next;
    if (watch->next) watch->next->previous = watch->previous;
    pthread_mutex_unlock(&watchdog->lock);
}

/* ---- phases ---- */

bool watchdog_enter(struct watchdog *watchdog, struct watch *watch, enum watch_phase phase, void *owner)
{
    const struct config *config = watchdog->config;
    pthread_mutex_lock(&watchdog->lock);
    bool alive = watch->phase != WATCH_REFUSED;
    watch->owner = owner;
    if (alive) {
        uint64_t timeout = phase == WATCH_BODY    ? config->body_timeout_ms
                           : phase == WATCH_WRITE ? config->write_timeout_ms
                                                  : config->header_timeout_ms;
        watch->phase = phase;
        watch->began_ms = clock_ms();
        watch->deadline_ms = watch->began_ms + (int64_t)timeout;
        watch->body_bytes = 0;
        /* The request has been read: what comes from now on belongs to the next. */
        if (phase == WATCH_WRITE) watch->received_before = bytes_received(watch);
        if (phase == WATCH_HEADER) {
            watch->in_flight = false;
            watch->idle_deadline_ms = watch->began_ms + (int64_t)config->idle_timeout_ms;
            if (watch->deadline_ms > watch->idle_deadline_ms) watch->deadline_ms = watch->idle_deadline_ms;
        }
    }
    pthread_mutex_unlock(&watchdog->lock);
    return alive;
}

bool watchdog_enter_work(struct watchdog *watchdog, struct watch *watch, struct zr_cancel *cancel)
{
    pthread_mutex_lock(&watchdog->lock);
    bool alive = watch->phase != WATCH_REFUSED;
    if (alive) {
        watch->phase = WATCH_WORK;
        watch->deadline_ms = INT64_MAX;
        watch->cancel = cancel;
        watch->client_left = false;
        pthread_cond_signal(&watchdog->changed);
    }
    pthread_mutex_unlock(&watchdog->lock);
    return alive;
}

void watchdog_work_begins(struct watchdog *watchdog, struct watch *watch)
{
    pthread_mutex_lock(&watchdog->lock);
    watch->deadline_ms = clock_ms() + (int64_t)watchdog->config->render_timeout_ms;
    pthread_mutex_unlock(&watchdog->lock);
}

void watchdog_work_waits(struct watchdog *watchdog, struct watch *watch)
{
    pthread_mutex_lock(&watchdog->lock);
    watch->deadline_ms = INT64_MAX;
    pthread_mutex_unlock(&watchdog->lock);
}

bool watchdog_leave_work(struct watchdog *watchdog, struct watch *watch)
{
    pthread_mutex_lock(&watchdog->lock);
    bool left = watch->client_left;
    watch->phase = WATCH_WRITE;
    watch->deadline_ms = clock_ms() + (int64_t)watchdog->config->write_timeout_ms;
    watch->cancel = NULL;
    pthread_mutex_unlock(&watchdog->lock);
    return left;
}

void watchdog_count_body(struct watchdog *watchdog, struct watch *watch, size_t bytes)
{
    pthread_mutex_lock(&watchdog->lock);
    watch->body_bytes += bytes;
    pthread_mutex_unlock(&watchdog->lock);
}

bool watchdog_refuse(struct watchdog *watchdog, struct watch *watch, const struct answer *answer)
{
    pthread_mutex_lock(&watchdog->lock);
    bool alive = watch->phase != WATCH_REFUSED;
    if (alive) refuse(watch, answer);
    pthread_mutex_unlock(&watchdog->lock);
    return alive;
}

bool watchdog_admit(struct watchdog *watchdog, struct watch *watch, size_t max)
{
    size_t count = 0;
    pthread_mutex_lock(&watchdog->lock);
    for (struct watch *other = watchdog->first; other; other = other->next)
        if (other->in_flight && strcmp(other->address, watch->address) == 0) count++;
    watch->in_flight = max == 0 || count < max;
    bool admitted = watch->in_flight;
    pthread_mutex_unlock(&watchdog->lock);
    return admitted;
}

void watchdog_cut_short(struct watchdog *watchdog, bool sockets_too)
{
    pthread_mutex_lock(&watchdog->lock);
    for (struct watch *watch = watchdog->first; watch; watch = watch->next) {
        if (watch->phase == WATCH_WORK) atomic_store(&watch->cancel->raised, true);
        if (sockets_too) shutdown(watch->socket_fd, SHUT_RDWR);
    }
    pthread_mutex_unlock(&watchdog->lock);
}
