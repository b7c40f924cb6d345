#include "daemon.h"

#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/cmocka_all.h"

enum { FLAGS_MAX = 32, START_MS = 20000, STOP_MS = 60000, LOG_WAIT_MS = 10000, TICK_MS = 5, LOG_TAIL = 4000 };

const char *daemon_binary(void)
{
    const char *path = getenv("ZRASTERD");
    return path && *path ? path : "build/zrasterd";
}

static char *read_all(int fd)
{
    struct stat info;
    if (fstat(fd, &info) != 0) return NULL;
    char *text = calloc(1, (size_t)info.st_size + 1);
    if (text && pread(fd, text, (size_t)info.st_size, 0) < 0) text[0] = '\0';
    return text;
}

/* Never returns. The child must not outlive a test that crashes, so it has no
 * terminal or pipe of ours but the two that are given. */
static void become_daemon(const char *const *arguments, int out, int err)
{
    const char *argv[FLAGS_MAX + 2] = {daemon_binary()};
    for (size_t i = 0; arguments && arguments[i] && i < FLAGS_MAX; i++)
        argv[i + 1] = arguments[i];
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execv(argv[0], (char *const *)(uintptr_t)argv);
    fprintf(stderr, "cannot run %s\n", argv[0]);
    _exit(127);
}

static void fail_with_log(const struct daemon *daemon, const char *message)
{
    char *log = daemon_log(daemon);
    size_t length = log ? strlen(log) : 0;
    fprintf(stderr, "%s: %s\n%s\n", daemon_binary(), message,
            log ? log + (length > LOG_TAIL ? length - LOG_TAIL : 0) : "");
    free(log);
    fail();
}

static unsigned read_port(int fd)
{
    char line[256] = "";
    size_t used = 0;
    struct pollfd polled = {.fd = fd, .events = POLLIN};
    while (used + 1 < sizeof line && !strchr(line, '\n') && poll(&polled, 1, START_MS) > 0) {
        ssize_t count = read(fd, line + used, sizeof line - 1 - used);
        if (count <= 0) break;
        used += (size_t)count;
    }
    unsigned port = 0;
    return sscanf(line, "listening on http://127.0.0.1:%u", &port) == 1 ? port : 0;
}

struct daemon daemon_start(const char *const *flags)
{
    const char *arguments[FLAGS_MAX + 1] = {"--port", "0"};
    for (size_t i = 0; flags && flags[i] && i + 2 < FLAGS_MAX; i++)
        arguments[i + 2] = flags[i];
    int out[2];
    struct daemon daemon = {.log_fd = memfd_create("zrasterd-log", MFD_CLOEXEC)};
    assert_true(daemon.log_fd >= 0);
    assert_int_equal(pipe(out), 0);
    daemon.pid = fork();
    if (daemon.pid == 0) become_daemon(arguments, out[1], daemon.log_fd);
    close(out[1]);
    daemon.port = read_port(out[0]);
    close(out[0]);
    if (daemon.port == 0) {
        kill(daemon.pid, SIGKILL);
        waitpid(daemon.pid, NULL, 0);
        fail_with_log(&daemon, "did not say that it listens");
    }
    return daemon;
}

void daemon_signal(const struct daemon *daemon)
{
    kill(daemon->pid, SIGTERM);
}

void daemon_stop(struct daemon *daemon)
{
    int status = 0;
    pid_t ended = 0;
    daemon_signal(daemon);
    for (int waited = 0; waited < STOP_MS && (ended = waitpid(daemon->pid, &status, WNOHANG)) == 0; waited += TICK_MS)
        usleep(TICK_MS * 1000);
    if (ended == 0) {
        kill(daemon->pid, SIGKILL);
        waitpid(daemon->pid, &status, 0);
        fail_with_log(daemon, "did not end after SIGTERM");
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_with_log(daemon, "did not exit with 0");
    close(daemon->log_fd);
}

long daemon_memory_kib(const struct daemon *daemon, const char *key)
{
    char path[64], line[128];
    long kib = -1;
    snprintf(path, sizeof path, "/proc/%d/status", (int)daemon->pid);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (kib < 0 && fgets(line, sizeof line, file))
        if (strncmp(line, key, strlen(key)) == 0) kib = atol(line + strlen(key));
    fclose(file);
    return kib;
}

char *daemon_log(const struct daemon *daemon)
{
    return read_all(daemon->log_fd);
}

char *daemon_wait_for_log(const struct daemon *daemon, const char *text)
{
    for (int waited = 0; waited < LOG_WAIT_MS; waited += TICK_MS) {
        char *log = daemon_log(daemon);
        char *line = NULL, *save = NULL;
        for (char *p = log ? strtok_r(log, "\n", &save) : NULL; p && !line; p = strtok_r(NULL, "\n", &save))
            if (strstr(p, text)) line = strdup(p);
        free(log);
        if (line) return line;
        usleep(TICK_MS * 1000);
    }
    fail_msg("the log has no '%s'", text);
    return NULL;
}

int daemon_run(const char *const *arguments, char **output)
{
    int status = 0, fd = memfd_create("zrasterd-output", MFD_CLOEXEC);
    assert_true(fd >= 0);
    pid_t pid = fork();
    if (pid == 0) become_daemon(arguments, fd, fd);
    waitpid(pid, &status, 0);
    *output = read_all(fd);
    close(fd);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
