#include "ticker.h"

#include <signal.h>
#include <stdio.h>
#include <time.h>

#include "job.h"

enum { FIRST_MS = 500, PERIOD_MS = 250 };

/* Waits until the ticker ends or the time has passed. The lock is held. */
static void wait_for(struct ticker *ticker, long milliseconds)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += milliseconds * 1000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    if (!ticker->ends) pthread_cond_timedwait(&ticker->change, &ticker->lock, &until);
}

static void *run(void *context)
{
    struct ticker *ticker = context;
    const double began = job_clock();
    pthread_mutex_lock(&ticker->lock);
    wait_for(ticker, FIRST_MS);
    while (!ticker->ends) {
        fprintf(stderr, "\r%.1f s\033[K", (job_clock() - began) / 1e3);
        fflush(stderr);
        ticker->is_printed = true;
        wait_for(ticker, PERIOD_MS);
    }
    pthread_mutex_unlock(&ticker->lock);
    return NULL;
}

/* The thread blocks all signals, so that they reach the one that draws. */
void ticker_start(struct ticker *ticker, bool is_shown)
{
    sigset_t all, before;
    *ticker = (struct ticker){.lock = PTHREAD_MUTEX_INITIALIZER, .change = PTHREAD_COND_INITIALIZER};
    if (!is_shown) return;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    ticker->is_running = pthread_create(&ticker->thread, NULL, run, ticker) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void ticker_end(struct ticker *ticker)
{
    if (!ticker->is_running) return;
    pthread_mutex_lock(&ticker->lock);
    ticker->ends = true;
    pthread_cond_signal(&ticker->change);
    pthread_mutex_unlock(&ticker->lock);
    pthread_join(ticker->thread, NULL);
    ticker->is_running = false;
    if (ticker->is_printed) fputs("\r\033[K", stderr);
}
