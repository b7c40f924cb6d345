#include "interruption.h"

#include <signal.h>

static zraster_cancel *running;
static volatile sig_atomic_t caught;

static void interrupt(int signal)
{
    (void)signal;
    caught = 1;
    zraster_cancel_raise(running);
}

void interruption_catch(void)
{
    struct sigaction action = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void interruption_raises(zraster_cancel *cancel)
{
    running = cancel;
}

bool interrupted(void)
{
    return caught;
}
