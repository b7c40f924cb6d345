#include "log_writer.h"

#include <errno.h>
#include <pthread.h>
#include <string.h>
#include <unistd.h>

#include "clock.h"

enum { STOP_MS = 1000 };

/* One per process, like standard error. The bytes from `tail` to `head` are unwritten; both counters only grow. */
static struct {
    pthread_mutex_t lock;
    pthread_cond_t changed, written;
    pthread_t thread;
    bool running, stopping, waiting;
    uint64_t head, tail, lost, lost_ever;
    char bytes[LOG_BUFFER_BYTES];
} writer = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void write_all(const char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t count = write(STDERR_FILENO, bytes, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return; /* the reader is gone */
        bytes += count;
        size -= (size_t)count;
    }
}

static void *write_lines(void *argument)
{
    (void)argument;
    pthread_mutex_lock(&writer.lock);
    while (!writer.stopping || writer.tail < writer.head) {
        if (writer.tail == writer.head) {
            writer.waiting = true;
            pthread_cond_wait(&writer.changed, &writer.lock);
            writer.waiting = false;
            continue;
        }
        const size_t at = (size_t)(writer.tail % LOG_BUFFER_BYTES), to_end = LOG_BUFFER_BYTES - at;
        const size_t size = writer.head - writer.tail < to_end ? (size_t)(writer.head - writer.tail) : to_end;
        pthread_mutex_unlock(&writer.lock);
        write_all(writer.bytes + at, size);
        pthread_mutex_lock(&writer.lock);
        writer.tail += size;
    }
    writer.running = false;
    pthread_cond_signal(&writer.written);
    pthread_mutex_unlock(&writer.lock);
    return NULL;
}

bool log_writer_start(void)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&writer.changed, &attributes);
    pthread_cond_init(&writer.written, &attributes);
    pthread_condattr_destroy(&attributes);
    writer.running = true;
    writer.running = pthread_create(&writer.thread, NULL, write_lines, NULL) == 0;
    return writer.running;
}

void log_writer_stop(void)
{
    pthread_mutex_lock(&writer.lock);
    const bool started = writer.running;
    const struct timespec until = clock_after_ms(STOP_MS);
    int status = 0;
    writer.stopping = true;
    if (started) pthread_cond_signal(&writer.changed);
    while (writer.running && status == 0)
        status = pthread_cond_timedwait(&writer.written, &writer.lock, &until);
    const bool is_stuck = writer.running;
    pthread_mutex_unlock(&writer.lock);
    if (!started) return;
    if (is_stuck) pthread_cancel(writer.thread); /* it waits in write(), without the lock */
    pthread_join(writer.thread, NULL);
    writer.running = false;
}

bool log_writer_put(const char *line, size_t size)
{
    pthread_mutex_lock(&writer.lock);
    const bool at_once = !writer.running, room = LOG_BUFFER_BYTES - (writer.head - writer.tail) >= size;
    if (!at_once && room) {
        const size_t at = (size_t)(writer.head % LOG_BUFFER_BYTES), to_end = LOG_BUFFER_BYTES - at;
        const size_t first = size < to_end ? size : to_end;
        memcpy(writer.bytes + at, line, first);
        memcpy(writer.bytes, line + first, size - first);
        writer.head += size;
        if (writer.waiting) pthread_cond_signal(&writer.changed);
    } else if (!at_once) {
        writer.lost++;
        writer.lost_ever++;
    }
    pthread_mutex_unlock(&writer.lock);
    if (at_once) write_all(line, size);
    return at_once || room;
}

uint64_t log_writer_take_lost(void)
{
    pthread_mutex_lock(&writer.lock);
    const bool is_stuck = LOG_BUFFER_BYTES - (writer.head - writer.tail) < LOG_BUFFER_BYTES / 2;
    const uint64_t lost = is_stuck ? 0 : writer.lost;
    writer.lost -= lost;
    pthread_mutex_unlock(&writer.lock);
    return lost;
}

uint64_t log_writer_lost_ever(void)
{
    pthread_mutex_lock(&writer.lock);
    const uint64_t lost = writer.lost_ever;
    pthread_mutex_unlock(&writer.lock);
    return lost;
}
