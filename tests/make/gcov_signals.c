/* gcov_signals.c - part of the programs of `make walk` and `make test-map`: SIGUSR1 sets the counts of gcov to 0, SIGUSR2
 * writes them, and so does the end of the processor time that `ulimit -t` grants, which ends the program. */
#include <signal.h>
#include <stddef.h>
#include <unistd.h>

#include <gcov.h>

static void handle(int number)
{
    if (number == SIGXCPU) alarm(10); /* writing never ends if the signal came within malloc */
    (number == SIGUSR1 ? __gcov_reset : __gcov_dump)();
    if (number == SIGXCPU) _exit(1);
}

__attribute__((constructor)) static void catch_signals(void)
{
    const struct sigaction action = {.sa_handler = handle, .sa_flags = SA_RESTART};
    sigaction(SIGUSR1, &action, NULL);
    sigaction(SIGUSR2, &action, NULL);
    sigaction(SIGXCPU, &action, NULL);
}
