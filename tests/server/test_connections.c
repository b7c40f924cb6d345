/* Connections in numbers, silent ones, readers that do not read, and clients that leave. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "server/support/client.h"
#include "support/sanitized.h"
#include "support/tests.h"

#define HEALTH "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n"
#define POST   "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\n"

enum { READY_MAX = 1024, SILENT = 1100, WAIT_MS = 5000 };

static int raise_file_limit(void **state)
{
    struct rlimit limit;
    (void)state;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return -1;
    limit.rlim_cur = limit.rlim_max < 4096 ? limit.rlim_max : 4096;
    return setrlimit(RLIMIT_NOFILE, &limit);
}

/* libmicrohttpd's own loop waits for ever where exactly 128 connections are ready at once. */
TEST(any_number_of_ready_connections_is_answered)
{
    static const int COUNTS[] = {1, 2, 63, 64, 65, 127, 128, 129, 255, 256, 257, 512, 1000, READY_MAX};
    static int clients[READY_MAX];
    struct daemon server = daemon_start(NULL);
    for (size_t c = 0; c < sizeof COUNTS / sizeof COUNTS[0]; c++) {
        for (int i = 0; i < COUNTS[c]; i++) {
            clients[i] = client_connect(&server);
            assert_true(clients[i] >= 0);
        }
        assert_true(client_write(clients[0], HEALTH, strlen(HEALTH))); /* all before it have been accepted */
        free(client_read(clients[0], "ok\"}", WAIT_MS));
        usleep(20000);
        kill(server.pid, SIGSTOP);
        for (int i = 0; i < COUNTS[c]; i++)
            assert_true(client_write(clients[i], HEALTH, strlen(HEALTH)));
        kill(server.pid, SIGCONT);
        for (int i = 0; i < COUNTS[c]; i++) {
            char *text = client_read(clients[i], "ok\"}", WAIT_MS);
            if (raw_status(text) != 200) fail_msg("%d ready: number %d was not answered", COUNTS[c], i);
            free(text);
            close(clients[i]);
        }
    }
    daemon_stop(&server);
}

/* More than there is room for, and all of them older than the one that asks. */
TEST(silent_connections_make_room)
{
    static int silent[SILENT];
    static const char HALF[] = "GET /healthz HTTP/1.1\r\nHost: a\r\nX-Half";
    for (int half = 0; half < 2; half++) {
        struct daemon server = daemon_start(NULL);
        for (int i = 0; i < SILENT; i++) {
            silent[i] = client_connect(&server);
            assert_true(silent[i] >= 0);
            if (half) client_write(silent[i], HALF, strlen(HALF));
        }
        const double begun = client_seconds();
        for (int i = 0; i < 5; i++)
            assert_int_equal(client_get_status(&server, "/healthz"), 200);
        assert_true(client_seconds() - begun <
                    5.0); /* on a busy machine; without room it takes the header's whole time */
        char *last = client_raw(&server, HEALTH, strlen(HEALTH), 200);
        assert_int_equal(raw_status(last), 200);
        free(last);
        for (int i = 0; i < SILENT; i++)
            close(silent[i]);
        daemon_stop(&server);
    }
}

/* Other clients hold all places: health checks of this machine still get through, and other requests are refused. */
TEST(places_for_loopback_are_kept_free)
{
    enum { BUSY = 8 };
    int clients[BUSY];
    struct daemon server =
        daemon_start(LIST("--max-connections=8", "--queue=16", "--workers=1", ANY_COST, "--render-timeout-ms=120000"));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, 4000);
    for (int i = 0; i < BUSY; i++)
        clients[i] = client_begin_render(&server, scene);
    client_wait_for_metric(&server, "", AT_WORK_OR_WAITING("8"));
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    for (int i = 0; i < BUSY; i++)
        close(clients[i]);
    free(scene);
    daemon_stop(&server);
}

/* They come and go while nobody looks: first there is no place, and then no connection that anybody would look at. */
TEST(a_crowd_that_has_gone_leaves_the_daemon_listening)
{
    enum { CROWD = 30 };
    int clients[CROWD];
    struct daemon server = daemon_start(LIST("--max-connections=8"));
    kill(server.pid, SIGSTOP);
    for (int i = 0; i < CROWD; i++)
        clients[i] = client_connect(&server);
    for (int i = 0; i < CROWD; i++)
        close(clients[i]);
    kill(server.pid, SIGCONT);
    usleep(200000);
    const int fd = client_connect(&server);
    assert_true(client_write(fd, HEALTH, strlen(HEALTH)));
    char *text = client_read(fd, "ok\"}", 1000);
    assert_int_equal(raw_status(text), 200);
    free(text);
    close(fd);
    daemon_stop(&server);
}

/* The first bytes of the next request come with the last ones of the request before. */
TEST(requests_that_overlap_count_once_for_their_client)
{
    static const char FIRST[] = POST "Content-Length: 53\r\n\r\n" GOOD_SCENE "PO",
                      NEXT[] = "ST /v1/render HTTP/1.1\r\n"
                               "Host: a\r\n" JSON_TYPE "\r\n"
                               "Content-Length: 53\r\n\r\n" GOOD_SCENE "PO";
    assert_int_equal(strlen(GOOD_SCENE), 53);
    struct daemon server = daemon_start(LIST("--max-per-private-client=2"));
    const int client = client_connect(&server);
    for (int i = 0; i < 4; i++) {
        assert_true(i == 0 ? client_write(client, FIRST, strlen(FIRST)) : client_write(client, NEXT, strlen(NEXT)));
        char *text = client_read(client, NULL, 500);
        assert_int_equal(raw_status(text), 200);
        free(text);
    }
    close(client);
    daemon_stop(&server);
}

/* ---- clients that leave ---- */

static int count_in_log(const struct daemon *daemon, const char *text)
{
    char *log = daemon_log(daemon);
    int count = 0;
    for (const char *at = log; (at = strstr(at, text)); at++)
        count++;
    free(log);
    return count;
}

/* By the end of its sending half, by closing, or by a reset; while the daemon waits for more, or with the last bytes.
 */
TEST(an_upload_that_its_client_ends_frees_its_place_at_once)
{
    enum { UPLOADS = 40 };
    static const char HEAD[] = POST "Content-Length: 1000\r\nExpect: 100-continue\r\n\r\n";
    struct daemon server = daemon_start(LIST("--max-per-private-client=1"));
    for (int i = 0; i < UPLOADS; i++) {
        const bool is_reset = i % 4 == 0, is_half = i % 4 == 1, is_sudden = i % 4 == 2;
        int fd = client_connect(&server);
        assert_true(client_write(fd, HEAD, strlen(HEAD)));
        if (!is_sudden) free(client_read(fd, "100 Continue\r\n\r\n", WAIT_MS)); /* it has been read */
        assert_true(client_write(fd, "{", 1));
        if (is_reset) setsockopt(fd, SOL_SOCKET, SO_LINGER, &(struct linger){1, 0}, sizeof(struct linger));
        if (is_half)
            shutdown(fd, SHUT_WR);
        else
            close(fd);
        long status = 429;
        for (int tries = 0; tries < 200 && (status = client_render_status(&server, GOOD_SCENE)) == 429; tries++)
            usleep(10000);
        assert_int_equal(status, 200);
        if (is_half) close(fd);
    }
    for (int tries = 0; tries < 500 && count_in_log(&server, "the client left") < UPLOADS; tries++)
        usleep(10000);
    assert_int_equal(count_in_log(&server, "the client left"), UPLOADS);
    daemon_stop(&server);
}

/* ---- readers that do not read ---- */

/* 16 MB, that nobody reads. */
/* buffer: the client's, or 0: as large as its system makes it. */
static int begin_large_answer(const struct daemon *server, int buffer)
{
    static const char REQUEST[] = "POST /v1/render?channel=depth&encoding=npy&width=2048&height=2048 HTTP/1.1\r\n"
                                  "Host: a\r\nContent-Type: model/obj\r\nContent-Length: 33\r\n\r\n"
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\n";
    int fd = client_connect(server);
    if (buffer > 0) assert_int_equal(setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer), 0);
    assert_true(client_write(fd, REQUEST, sizeof REQUEST - 1));
    return fd;
}

TEST(answers_that_wait_for_readers_have_a_ceiling)
{
    enum { READERS = 40 };
    int readers[READERS];
    struct daemon server = daemon_start(LIST("--answer-memory-bytes=64000000", "--workers=2", "--queue=64"));
    for (int i = 0; i < READERS; i++)
        readers[i] = begin_large_answer(&server, 4096);
    long status = 0;
    for (int tries = 0; tries < 500 && (status = client_render_status(&server, GOOD_SCENE)) != 503; tries++)
        usleep(10000);
    assert_int_equal(status, 503);
    struct reply reply = client_render(&server, GOOD_SCENE);
    assert_non_null(strstr(reply.body, "answerMemoryBytes"));
    assert_string_not_equal(reply_header(&reply, "Retry-After"), "");
    reply_free(&reply);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
#if !IS_SANITIZED /* whose allocators keep what is freed */
    /* Those up to the ceiling, one more of each thread that renders, and a frame of each. */
    assert_true(daemon_memory_kib(&server, "VmRSS:") < 400 * 1024);
#endif
    for (int i = 0; i < READERS; i++)
        close(readers[i]);
    for (int tries = 0; tries < 500 && (status = client_render_status(&server, GOOD_SCENE)) == 503; tries++)
        usleep(10000);
    assert_int_equal(status, 200);
    daemon_stop(&server);
}

/* A system takes as much as its buffers hold at once, and then nothing for long: here for more than half of the 20 s
 * that it may, while the other reader is cut off. */
TEST(a_reader_below_the_least_speed_is_cut_off)
{
    struct daemon patient = daemon_start(NULL);
    int paused = begin_large_answer(&patient, 0);
    struct daemon server = daemon_start(LIST("--answer-min-bytes-per-second=100000"));
    const double begun = client_seconds();
    int fd = begin_large_answer(&server, 4096);
    char byte;
    while (client_seconds() - begun < 20.0 && recv(fd, &byte, 1, 0) == 1) {
        char *log = daemon_log(&server);
        const bool is_cut = strstr(log, "\"aborted\":true");
        free(log);
        if (is_cut) break;
        usleep(100000);
    }
    char *line = daemon_wait_for_log(&server, "\"aborted\":true");
    assert_non_null(strstr(line, "\"status\":200"));
    assert_non_null(strstr(line, "read too slowly"));
    free(line);
    assert_true(client_seconds() - begun < 15.0); /* 5 s, on a busy machine; write-timeout-ms is 60 s */
    close(fd);
    daemon_stop(&server);
    while (client_seconds() - begun < 12.0)
        usleep(100000);
    size_t size = 0;
    char bytes[4096];
    for (ssize_t count = 1; count > 0 && size < (size_t)2048 * 2048 * 4; size += (size_t)(count > 0 ? count : 0))
        count = recv(paused, bytes, sizeof bytes, 0);
    assert_true(size >= (size_t)2048 * 2048 * 4); /* all of it */
    close(paused);
    daemon_stop(&patient);
}

/* ---- the log ---- */

/* A daemon whose standard error is a pipe that nobody reads. Closes `closed` of its standard files. */
static struct daemon start_with_pipe(int log[2])
{
    int out[2];
    char line[256] = "";
    struct daemon server = {.log_fd = -1};
    assert_int_equal(pipe(log), 0);
    assert_int_equal(pipe(out), 0);
    server.pid = fork();
    if (server.pid == 0) {
        dup2(out[1], STDOUT_FILENO);
        dup2(log[1], STDERR_FILENO);
        close(log[0]);
        close(out[0]);
        execl(daemon_binary(), daemon_binary(), "--port=0", (char *)NULL);
        _exit(127);
    }
    close(out[1]);
    close(log[1]);
    for (size_t used = 0; used + 1 < sizeof line && !strchr(line, '\n') && read(out[0], line + used, 1) == 1; used++)
        continue;
    close(out[0]);
    assert_int_equal(sscanf(line, "listening on http://127.0.0.1:%u", &server.port), 1);
    return server;
}

TEST(a_log_that_nobody_reads_holds_no_answer_up)
{
    enum { REQUESTS = 2000 };
    static char path[1200];
    static char seen[64 << 10];
    int log[2], status = 0;
    memset(path, 'a', sizeof path - 1);
    path[0] = '/';
    struct daemon server = start_with_pipe(log);
    for (int i = 0; i < REQUESTS; i++) /* each gives a line of 700 bytes or more: the pipe has 64 KiB, and we one MiB */
        assert_int_equal(client_get_status(&server, path), 404);
    /* The log is read at last, and reports the lost lines. */
    bool is_told = false;
    for (size_t read_bytes = 0; read_bytes < (size_t)3 << 20 && !is_told;) {
        struct pollfd polled = {.fd = log[0], .events = POLLIN};
        if (poll(&polled, 1, 100) == 0)
            client_get_status(&server, "/healthz");
        else {
            ssize_t count = read(log[0], seen, sizeof seen - 1);
            assert_true(count > 0);
            seen[count] = '\0';
            read_bytes += (size_t)count;
            is_told = strstr(seen, "\"event\":\"log-lost\"");
        }
    }
    assert_true(is_told);
    /* Nor does it hold up the end. */
    for (int i = 0; i < REQUESTS; i++)
        client_get_status(&server, path);
    const double begun = client_seconds();
    daemon_signal(&server);
    assert_int_equal(waitpid(server.pid, &status, 0), server.pid);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_true(client_seconds() - begun < 10.0);
    close(log[0]);
}

/* No socket or asset gets their numbers. */
TEST(closed_standard_files_are_opened_on_nothing)
{
    int out[2], status = 0;
    char line[256] = "";
    unsigned port;
    assert_int_equal(pipe(out), 0);
    pid_t pid = fork();
    if (pid == 0) {
        dup2(out[1], STDOUT_FILENO);
        close(STDIN_FILENO);
        close(STDERR_FILENO);
        execl(daemon_binary(), daemon_binary(), "--port=0", (char *)NULL);
        _exit(127);
    }
    close(out[1]);
    for (size_t used = 0; used + 1 < sizeof line && !strchr(line, '\n') && read(out[0], line + used, 1) == 1; used++)
        continue;
    assert_int_equal(sscanf(line, "listening on http://127.0.0.1:%u", &port), 1);
    for (int fd = 0; fd <= 2; fd += 2) {
        char link[64], target[64] = "";
        snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, fd);
        assert_true(readlink(link, target, sizeof target - 1) > 0);
        assert_string_equal(target, "/dev/null");
    }
    kill(pid, SIGTERM);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    close(out[0]);
}

/* It counts as gone, whether its end comes with its request or later. */
TEST(a_client_that_ends_with_its_request_is_let_go)
{
    enum { TRIES = 20 };
    int fds[TRIES];
    struct daemon server = daemon_start(NULL);
    const double begun = client_seconds();
    for (int i = 0; i < TRIES; i++) {
        fds[i] = client_connect(&server);
        assert_true(client_write(fds[i], HEALTH HEALTH, 2 * strlen(HEALTH)));
        assert_int_equal(shutdown(fds[i], SHUT_WR), 0);
    }
    for (int i = 0; i < TRIES; i++) {
        char *text = client_read(fds[i], NULL, 10000);
        assert_int_equal(raw_count(text), 2);
        free(text);
        assert_true(client_seconds() - begun < 8.0); /* a second, on a busy machine; idle-timeout-ms is 60 s */
        close(fds[i]);
    }
    daemon_stop(&server);
}

TEST(files_are_enough_for_each_connection_to_have_an_asset)
{
    struct rlimit limit, low;
    char path[64], line[256];
    unsigned long most = 0;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &limit), 0);
    low = limit;
    low.rlim_cur = 256;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &low), 0);
    struct daemon server = daemon_start(LIST("--max-connections=500"));
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    snprintf(path, sizeof path, "/proc/%d/limits", (int)server.pid);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        if (sscanf(line, "Max open files %lu", &most) == 1) break;
    fclose(file);
    assert_true(most >= 2 * 500);
    daemon_stop(&server);
}

RUN_TESTS(raise_file_limit, NULL)
