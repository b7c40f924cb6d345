/* gcov_signals.c - part of the daemon of `make walk`: SIGUSR1 sets the counts of gcov to 0, SIGUSR2 writes them. */
#include <signal.h>
#include <stddef.h>

#include <gcov.h>

static void handle(int number)
{
    (number == SIGUSR1 ? __gcov_reset : __gcov_dump)();
}

__attribute__((constructor)) static void catch_signals(void)
{
    const struct sigaction action = {.sa_handler = handle, .sa_flags = SA_RESTART};
    sigaction(SIGUSR1, &action, NULL);
    sigaction(SIGUSR2, &action, NULL);
}
