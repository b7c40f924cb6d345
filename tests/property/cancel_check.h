/* cancel_check.h - tests: cancels work of this thread after some of its processor time, and checks that it ends soon.
 */
#ifndef ZR_TESTS_CANCEL_CHECK_H
#define ZR_TESTS_CANCEL_CHECK_H

#include <pthread.h>
#include <time.h>

#include "core.h"
#include "support/sanitized.h"
#include "support/tests.h"

/* RAISED_MS: well within the work of each case. LATE_MS: of this thread's processor time, so that other processes do
 * not count. */
#if IS_SANITIZED
enum { LATE_MS = 1000 };
#else
enum { LATE_MS = 50 };
#endif
enum { RAISED_MS = 30 };

/* Raised by a thread of its own once the test's has worked for so long. */
struct later {
    struct zr_cancel cancel;
    atomic_bool given_up; /* the work ended before */
    clockid_t clock;      /* of the test's thread */
    double after_ms, raised_ms;
    pthread_t thread;
};

static inline double now_ms(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static inline void *raise_later(void *argument)
{
    struct later *later = argument;
    const double begin_ms = now_ms(later->clock);
    while (now_ms(later->clock) < begin_ms + later->after_ms && !atomic_load(&later->given_up))
        nanosleep(&(struct timespec){.tv_nsec = 100000}, NULL);
    atomic_store(&later->cancel.raised, true);
    later->raised_ms = now_ms(later->clock);
    return NULL;
}

static inline void begin(struct later *later, double after_ms)
{
    *later = (struct later){.after_ms = after_ms};
    assert_int_equal(pthread_getcpuclockid(pthread_self(), &later->clock), 0);
    assert_int_equal(pthread_create(&later->thread, NULL, raise_later, later), 0);
}

static inline void end(struct later *later)
{
    atomic_store(&later->given_up, true);
    pthread_join(later->thread, NULL);
}

static inline void assert_ended_soon(struct later *later, enum zr_status status)
{
    const double ended_ms = now_ms(later->clock);
    end(later);
    assert_int_equal(status, ZR_CANCELLED);
    if (ended_ms - later->raised_ms > LATE_MS)
        fail_msg("told to stop after %.0f ms, it took %.0f ms more", later->after_ms, ended_ms - later->raised_ms);
}

#endif
