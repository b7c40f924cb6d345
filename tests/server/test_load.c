/* More work than there is room for, clients that leave, and the end. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/client.h"
#include "support/sanitized.h"
#include "support/tests.h"

enum {
    CLIENTS_MAX = 32,
    FEW = 20,   /* polygons: some tenths of a second of work */
    MANY = 4000 /* polygons: far beyond every deadline here */
};

/* One POST of `scene` on a thread of its own. */
struct post {
    const struct daemon *daemon;
    const char *scene;
    size_t number;
    pthread_t thread;
    struct reply reply;
    bool has_retry_after;
};

static void *run_post(void *argument)
{
    struct post *post = argument;
    char type[64]; /* equal requests would share their work */
    snprintf(type, sizeof type, JSON_TYPE ";number=%zu", post->number);
    post->reply = client_send(post->daemon, "POST", "/v1/render", LIST(type), post->scene, strlen(post->scene));
    post->has_retry_after = atoi(reply_header(&post->reply, "Retry-After")) >= 1;
    return NULL;
}

static void begin_posts(struct post *posts, size_t count, const struct daemon *daemon, const char *scene)
{
    static size_t number;
    for (size_t i = 0; i < count; i++) {
        posts[i] = (struct post){.daemon = daemon, .scene = scene, .number = number++};
        assert_int_equal(pthread_create(&posts[i].thread, NULL, run_post, &posts[i]), 0);
    }
}

/* Waits for all; how many were answered with `status`. */
static size_t end_posts(struct post *posts, size_t count, long status)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        pthread_join(posts[i].thread, NULL);
        found += posts[i].reply.status == status;
        reply_free(&posts[i].reply);
    }
    return found;
}

/* Polls until `target` answers with `status`; false after some seconds. */
static bool wait_for_status(const struct daemon *daemon, const char *target, long status)
{
    for (int i = 0; i < 1000; i++) {
        if (client_get_status(daemon, target) == status) return true;
        usleep(10000);
    }
    return false;
}

TEST(full_queue_refuses_and_serves_the_others)
{
    struct daemon server = daemon_start((const char *const[]){
        ANY_COST, "--workers=1", "--queue=2", "--max-per-client=0", "--render-timeout-ms=120000", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW);
    struct post posts[CLIENTS_MAX];
    begin_posts(posts, CLIENTS_MAX, &server, scene);
    size_t served = 0, refused = 0;
    for (size_t i = 0; i < CLIENTS_MAX; i++) {
        pthread_join(posts[i].thread, NULL);
        served += posts[i].reply.status == 200;
        refused += posts[i].reply.status == 503 && posts[i].has_retry_after;
        reply_free(&posts[i].reply);
    }
    assert_int_equal(served + refused, CLIENTS_MAX);
    assert_true(served >= 2 && refused >= 1); /* two have room, even before the worker takes the first of them */
    free(scene);
    daemon_stop(&server);
}

TEST(full_queue_answers_health_and_not_ready)
{
    struct daemon server = daemon_start((const char *const[]){
        ANY_COST, "--workers=1", "--queue=1", "--max-per-client=0", "--render-timeout-ms=120000", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    int clients[3]; /* one is worked on, one waits; the last is there in case the first was still waiting */
    for (int i = 0; i < 3; i++, usleep(100000))
        clients[i] = client_begin_render(&server, scene);
    assert_true(wait_for_status(&server, "/readyz", 503));
    double begun = client_seconds();
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    assert_true(client_seconds() - begun < 1.0);
    for (int i = 0; i < 3; i++)
        close(clients[i]);
    assert_true(wait_for_status(&server, "/readyz", 200));
    free(scene);
    daemon_stop(&server);
}

TEST(client_with_too_many_requests_gets_429)
{
    struct daemon server = daemon_start((const char *const[]){
        ANY_COST, "--workers=1", "--queue=8", "--max-per-private-client=2", "--render-timeout-ms=120000", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW);
    struct post posts[8];
    size_t served = 0, refused = 0;
    begin_posts(posts, 8, &server, scene);
    for (size_t i = 0; i < 8; i++) {
        pthread_join(posts[i].thread, NULL);
        served += posts[i].reply.status == 200;
        refused += posts[i].reply.status == 429 && posts[i].has_retry_after;
        reply_free(&posts[i].reply);
    }
    assert_int_equal(served + refused, 8);
    assert_true(served >= 2 && refused >= 1);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200); /* all are over: the count is back */
    free(scene);
    daemon_stop(&server);
}

TEST(client_that_leaves_frees_the_worker)
{
    struct daemon server = daemon_start((const char *const[]){
        ANY_COST, "--workers=1", "--queue=4", "--max-per-client=0", "--render-timeout-ms=120000", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    int rendering = client_begin_render(&server, scene), waiting = client_begin_render(&server, scene);
    client_wait_for_metric(&server, "", AT_WORK_OR_WAITING("2"));
    close(rendering);
    close(waiting);
    double begun = client_seconds();
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    assert_true(client_seconds() - begun <
                5.0); /* under sanitizers; a worker that was not told is busy for far longer */
    char *line = daemon_wait_for_log(&server, "the client left");
    assert_non_null(strstr(line, "\"status\":0,\"aborted\":true"));
    free(line);
    free(scene);
    daemon_stop(&server);
}

TEST(render_past_its_deadline_gives_504)
{
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--render-timeout-ms=150", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    struct reply reply = client_render(&server, scene);
    assert_int_equal(reply.status, 504);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/problem+json");
    reply_free(&reply);
    free(scene);
    daemon_stop(&server);
}

/* Work that is in the lights, not in the pixels, ends at the deadline too. */
TEST(lighting_past_its_deadline_gives_504)
{
    enum { LIGHTS = 1000, FACES = 200000 };
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--render-timeout-ms=150", NULL});
    char *scene = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&scene, &size);
    fputs("{\"lights\":[", out);
    for (int i = 0; i < LIGHTS; i++)
        fprintf(out, "%s{\"type\":\"directional\",\"direction\":[0,0,-1]}", i ? "," : "");
    fputs("],\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[", out);
    for (int i = 0; i < FACES; i++)
        fputs(i ? ",[0,1,2]" : "[0,1,2]", out);
    fputs("]}]}", out);
    assert_int_equal(fclose(out), 0);
    double begun = client_seconds();
    assert_int_equal(client_render_status(&server, scene), 504);
    assert_true(client_seconds() - begun < 10.0); /* under sanitizers; it would take far longer */
    free(scene);
    daemon_stop(&server);
}

/* The independent algorithms take no help and no short cuts: so they have to look at the clock. */
TEST(every_algorithm_past_its_deadline_gives_504)
{
    /* Scan lines draw MANY within the deadline. The painter's work grows by the square: under sanitizers, the daemon
     * would predict more than ANY_COST for MANY. */
    static const struct {
        const char *word;
        int count;
    } algorithms[] = {{"edgelist", MANY}, {"trapezoid", MANY}, {"scanline", 4 * MANY}, {"painter", MANY / 4}};
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--render-timeout-ms=150", NULL});
    for (size_t i = 0; i < sizeof algorithms / sizeof algorithms[0]; i++) {
        char *scene = scene_slow(algorithms[i].word, SLOW_SIDE, algorithms[i].count);
        double begun = client_seconds();
        assert_int_equal(client_render_status(&server, scene), 504);
        assert_true(client_seconds() - begun < 10.0); /* under sanitizers; all of it would take far longer */
        free(scene);
    }
    daemon_stop(&server);
}

TEST(request_that_never_fits_its_memory_gives_422)
{
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--request-memory-bytes=1048576", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, 1);
    struct reply reply = client_render(&server, scene);
    assert_int_equal(reply.status, 422);
    assert_string_equal(reply_header(&reply, "Retry-After"), "");
    const char *needs = strstr(reply.body, "at least ");
    assert_true(needs && strtoul(needs + strlen("at least "), NULL, 10) > 1048576);
    assert_true(strstr(reply.body, "requestMemoryBytes") && strstr(reply.body, "1048576 bytes"));
    reply_free(&reply);
    free(scene);
    daemon_stop(&server);
}

/* More than two a worker, and with the queue that is there unless another is asked for. */
TEST(crowd_of_small_requests_waits_and_is_served)
{
    enum { CROWD = IS_SANITIZED ? CLIENTS_MAX / 4 : CLIENTS_MAX }; /* a request that would wait for a second gets 503 */
    struct daemon server = daemon_start((const char *const[]){"--workers=1", "--max-per-client=0", NULL});
    for (int round = 0; round < 3; round++) {
        struct post posts[CROWD];
        begin_posts(posts, CROWD, &server, GOOD_SCENE);
        assert_int_equal(end_posts(posts, CROWD, 200), CROWD);
    }
    daemon_stop(&server);
}

TEST(upload_memory_used_up_gives_503)
{
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--upload-memory-bytes=100000", NULL});
    struct reply reply = client_send_chunked(&server, "/v1/render", 200000);
    assert_int_equal(reply.status, 503);
    reply_free(&reply);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    daemon_stop(&server);
}

TEST(reader_that_stops_is_cut_off)
{
    static const char REQUEST[] = "POST /v1/render?channel=depth&encoding=npy&width=4096&height=4096 HTTP/1.1\r\n"
                                  "Host: a\r\nContent-Type: model/obj\r\nContent-Length: 33\r\n\r\n"
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\n";
    struct daemon server =
        daemon_start((const char *const[]){ANY_COST, "--write-timeout-ms=300", "--render-timeout-ms=120000", NULL});
    int fd = client_connect(&server);
    assert_true(client_write(fd, REQUEST, sizeof REQUEST - 1));
    char *line = daemon_wait_for_log(&server, "\"aborted\":true");
    assert_non_null(strstr(line, "\"status\":200"));
    free(line);
    close(fd);
    daemon_stop(&server);
}

TEST(sigterm_lets_renders_in_flight_end)
{
    enum { IN_FLIGHT = 6 };
    struct daemon server =
        daemon_start((const char *const[]){ANY_COST, "--workers=2", "--queue=8", "--max-per-client=0",
                                           "--render-timeout-ms=120000", "--drain-timeout-ms=120000", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW * (IS_SANITIZED ? 4 : 16)); /* all come before one ends */
    struct post posts[IN_FLIGHT];
    int kept = client_connect(&server);
    static const char EARLY[] = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    assert_true(client_write(kept, EARLY, sizeof EARLY - 1));
    free(client_read(kept, "ok\"}", 5000));
    begin_posts(posts, IN_FLIGHT, &server, scene);
    client_wait_for_metric(&server, "", AT_WORK_OR_WAITING("6"));
    daemon_signal(&server);
    usleep(50000);

    int fresh = client_connect(&server);
    assert_int_equal(fresh, -1);
    static const char LATE[] = "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nContent-Length: 2\r\n\r\n{}";
    assert_true(client_write(kept, LATE, sizeof LATE - 1));
    char *text = client_read(kept, NULL, 20000);
    assert_int_equal(raw_status(text), 503);
    assert_non_null(strstr(text, "Retry-After: "));
    assert_non_null(strstr(text, "Connection: close"));
    free(text);
    close(kept);

    assert_int_equal(end_posts(posts, IN_FLIGHT, 200), IN_FLIGHT);
    daemon_stop(&server);
    free(scene);
}

/* Until the delay has passed, load balancers may still send requests: over connections that are open, and over new
 * ones. */
TEST(sigterm_with_a_delay_serves_until_it_has_passed)
{
    enum { DELAY_MS = 1000 };
    static const char READY[] = "GET /readyz HTTP/1.1\r\nHost: a\r\n\r\n";
    static const char RENDER[] = "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nContent-Length: 57\r\n\r\n"
                                 "{\"polygons\": [{\"vertices\": [[0,0,0], [1,0,0], [0,1,0]]}]}";
    struct daemon server = daemon_start(LIST(ANY_COST, "--drain-delay-ms=1000"));
    int kept = client_connect(&server);
    assert_true(client_write(kept, READY, sizeof READY - 1));
    free(client_read(kept, "ready\"}", 5000));
    const double began = client_seconds();
    daemon_signal(&server);
    assert_true(wait_for_status(&server, "/readyz", 503));
    for (int is_fresh = 0; is_fresh < 2; is_fresh++) {
        int fd = is_fresh ? client_connect(&server) : kept;
        assert_true(fd >= 0 && client_write(fd, RENDER, sizeof RENDER - 1));
        char *text = client_read(fd, NULL, 5000);
        assert_int_equal(raw_status(text), 200);
        assert_non_null(strstr(text, "Connection: close"));
        free(text);
        close(fd);
    }
    daemon_stop(&server);
    assert_true((client_seconds() - began) * 1000 >= DELAY_MS);
}

TEST(drain_that_takes_too_long_is_cut_short)
{
    struct daemon server =
        daemon_start((const char *const[]){ANY_COST, "--workers=1", "--queue=1", "--max-per-client=0",
                                           "--render-timeout-ms=120000", "--drain-timeout-ms=200", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    struct post posts[2]; /* one is worked on, one waits: both at once would find no room but for one */
    begin_posts(&posts[0], 1, &server, scene);
    client_wait_for_metric(&server, "", ONE_AT_WORK);
    begin_posts(&posts[1], 1, &server, scene);
    assert_true(wait_for_status(&server, "/readyz", 503));
    usleep(300000); /* not ready before the last of them has come */
    daemon_stop(&server);
    assert_int_equal(end_posts(posts, 2, 503), 2);
    free(scene);
}

/* Requests that come on kept connections while the daemon is on its way out: it must end
 * well, whatever they meet. */
TEST(sigterm_amid_requests_on_kept_connections_ends_well)
{
    enum { KEPT = 48, ROUNDS = 8 };
    static const char HEALTH[] = "GET /readyz HTTP/1.1\r\nHost: a\r\n\r\n";
    struct daemon servers[ROUNDS];
    int kept[ROUNDS][KEPT];
    for (int round = 0; round < ROUNDS; round++) {
        servers[round] = daemon_start(NULL);
        for (int i = 0; i < KEPT; i++) {
            kept[round][i] = client_connect(&servers[round]);
            assert_true(client_write(kept[round][i], HEALTH, sizeof HEALTH - 1));
            free(client_read(kept[round][i], "}", 5000));
        }
        for (int i = 0; i < KEPT; i++) {
            if (i == KEPT / 2) daemon_signal(&servers[round]);
            client_write(kept[round][i], HEALTH, sizeof HEALTH - 1);
        }
    }
    for (int round = 0; round < ROUNDS; round++) { /* all wait for their clients at once */
        daemon_stop(&servers[round]);              /* asserts exit status 0 */
        for (int i = 0; i < KEPT; i++)
            close(kept[round][i]);
    }
}

/* Connections made before the signal get an answer, also those that nobody had accepted. */
TEST(sigterm_answers_those_who_wait_to_be_accepted)
{
    enum { CLIENTS = 60, ROUNDS = 5 };
    static const char HEALTH[] = "GET /readyz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    for (int round = 0; round < ROUNDS; round++) {
        /* Every other time more of them than may be connected at once. */
        struct daemon server = daemon_start((const char *const[]){
            "--max-per-client=0", round % 2 ? "--max-connections=8" : "--max-connections=100", NULL});
        int waiting[CLIENTS];
        for (int i = 0; i < CLIENTS; i++) {
            waiting[i] = client_connect(&server);
            assert_true(client_write(waiting[i], HEALTH, sizeof HEALTH - 1));
        }
        daemon_signal(&server);
        for (int i = 0; i < CLIENTS; i++) {
            char *text = client_read(waiting[i], NULL, 5000);
            int status = raw_status(text);
            assert_true(status == 200 || status == 503);
            free(text);
            close(waiting[i]);
        }
        daemon_stop(&server);
    }
}

/* 4 million values make a tree of hundreds of megabytes, outside of every arena. */
TEST(memory_of_a_large_body_is_given_back)
{
    enum { VALUES = 2000000 };
    struct daemon server = daemon_start((const char *const[]){"--workers=1", NULL});
    char *body = malloc(2 * VALUES + 64), *end = body + sprintf(body, "{\"polygons\":[0");
    for (int i = 0; i < VALUES; i++) {
        *end++ = ',';
        *end++ = '0';
    }
    strcpy(end, "]}");
    assert_int_equal(client_render_status(&server, body), 422);
    free(body);
    long resident = 0;
    for (int tries = 0; tries < 50; tries++) {
        char path[64];
        snprintf(path, sizeof path, "/proc/%d/statm", (int)server.pid);
        FILE *file = fopen(path, "r");
        assert_non_null(file);
        assert_int_equal(fscanf(file, "%*d %ld", &resident), 1);
        fclose(file);
        resident *= sysconf(_SC_PAGESIZE) >> 10;
        if (resident < 120 * 1024) break;
        usleep(100000);
    }
#if !IS_SANITIZED /* whose allocators keep what is freed */
    assert_true(resident < 120 * 1024);
#endif
    daemon_stop(&server);
}

TEST(sigterm_with_uploads_and_idle_connections_ends)
{
    static const char HALF[] = "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nContent-Length: 99\r\n\r\n{";
    struct daemon server = daemon_start((const char *const[]){ANY_COST, "--drain-timeout-ms=200", NULL});
    int half = client_connect(&server), silent = client_connect(&server);
    assert_true(client_write(half, HALF, sizeof HALF - 1));
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    daemon_stop(&server);
    close(half);
    close(silent);
}

RUN_TESTS(clients_setup, clients_teardown)
