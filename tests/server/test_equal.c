/* Equal requests that are under way at once: one is drawn, and its answer is that of all. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/assets.h"
#include "support/tests.h"

enum {
    EQUAL = 16,
    FEW = 20,   /* polygons: some tenths of a second of work */
    MANY = 4000 /* polygons: far beyond every deadline here */
};

#define LET_IN ANY_COST, "--workers=1", "--max-per-private-client=0", "--render-timeout-ms=600000"

static int begin(const struct daemon *daemon, const char *target, const char *headers, const char *body)
{
    char head[512];
    const int fd = client_connect(daemon);
    const int length =
        snprintf(head, sizeof head, "%s HTTP/1.1\r\nHost: a\r\nConnection: close\r\nContent-Length: %zu\r\n%s\r\n",
                 target, strlen(body), headers);
    assert_true(fd >= 0 && client_write(fd, head, (size_t)length) && client_write(fd, body, strlen(body)));
    return fd;
}

static int begin_post(const struct daemon *daemon, const char *scene)
{
    return begin(daemon, "POST /v1/render", JSON_TYPE "\r\n", scene);
}

/* Gives the only worker something else to do, until the connection is closed. */
static int begin_block(const struct daemon *daemon)
{
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    const int fd = client_begin_render(daemon, scene);
    client_wait_for_metric(daemon, "", ONE_AT_WORK);
    free(scene);
    return fd;
}

static void wait_for_work(const struct daemon *daemon, int count)
{
    char line[80];
    snprintf(line, sizeof line, AT_WORK_OR_WAITING("%d"), count);
    client_wait_for_metric(daemon, "", line);
}

/* Reads a whole answer. Free it. */
static char *end(int fd)
{
    char *text = client_read(fd, NULL, 120000);
    close(fd);
    return text;
}

static const char *body_of(const char *answer)
{
    const char *end = strstr(answer, "\r\n\r\n");
    assert_non_null(end);
    return end + 4;
}

static size_t count_of(const char *answer)
{
    const char *length = strstr(answer, "Content-Length: ");
    assert_non_null(length);
    return strtoul(length + 16, NULL, 10);
}

static void assert_same_answer(const char *got, const char *want)
{
    assert_int_equal(raw_status(got), 200);
    assert_int_equal(count_of(got), count_of(want));
    assert_memory_equal(body_of(got), body_of(want), count_of(want));
}

TEST(equal_requests_are_drawn_once)
{
    struct daemon server = daemon_start(LIST(LET_IN));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW), *answers[EQUAL];
    int clients[EQUAL];
    const int block = begin_block(&server);
    for (int i = 0; i < EQUAL; i++)
        clients[i] = begin_post(&server, scene);
    wait_for_work(&server, 1 + EQUAL);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    close(block);
    for (int i = 0; i < EQUAL; i++) {
        answers[i] = end(clients[i]);
        assert_same_answer(answers[i], answers[0]);
        const char *id = strstr(answers[i], "X-Request-Id: ");
        assert_non_null(id);
        for (int k = 0; k < i; k++)
            assert_memory_not_equal(id, strstr(answers[k], "X-Request-Id: "), 40);
    }
    client_wait_for_metric(&server, "", "zraster_shared_answers_total 15");
    client_wait_for_metric(&server, "",
                           "zraster_http_request_step_seconds_count{step=\"render\"} 3"); /* and two others */
    client_wait_for_metric(&server, "",
                           "zraster_http_requests_total{route=\"/v1/render\",method=\"POST\",status=\"200\"} 17");
    for (int i = 0; i < EQUAL; i++)
        free(answers[i]);
    free(scene);
    daemon_stop(&server);
}

/* A scene that is not small, or the express would draw it at once, with an answer of 12.6 MB. Free it. */
static char *scene_of_positions(void)
{
    static const char was[] = "{\"channel\":\"info\"}", now[] = "{\"channel\":\"position\",\"encoding\":\"npy\"}";
    char *slow = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW), *scene, *at = strstr(slow, was);
    assert_non_null(at);
    assert_true(asprintf(&scene, "%.*s%s%s", (int)(at - slow), slow, now, at + strlen(was)) > 0);
    free(slow);
    return scene;
}

/* With the second answer, the client has more than half of the room. */
TEST(shared_answers_of_a_client_leave_room_to_others)
{
    enum { COUNT = 5 };
    struct daemon server =
        daemon_start(LIST(ANY_COST, "--workers=1", "--render-timeout-ms=600000", "--answer-memory-bytes=42000000"));
    char *scene = scene_of_positions();
    int clients[COUNT], pictures = 0;
    const int block = begin_block(&server);
    for (int i = 0; i < COUNT; i++)
        clients[i] = begin_post(&server, scene);
    wait_for_work(&server, 1 + COUNT);
    close(block);
    for (int i = 0; i < COUNT; i++) { /* the others are drawn, or refused while the answers before them are read */
        char *answer = end(clients[i]);
        const int status = raw_status(answer);
        free(answer);
        assert_true(status == 200 || status == 503);
        pictures += status == 200;
    }
    free(scene);
    assert_true(pictures >= 2);
    client_wait_for_metric(&server, "", "zraster_shared_answers_total 1");
    daemon_stop(&server);
}

TEST(followers_are_answered_if_their_leader_leaves)
{
    struct daemon server = daemon_start(LIST(LET_IN));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, FEW), *answers[4];
    for (int is_at_work = 0; is_at_work < 2; is_at_work++) {
        const int block = is_at_work ? -1 : begin_block(&server);
        const int leader = begin_post(&server, scene);
        if (is_at_work) client_wait_for_metric(&server, "", ONE_AT_WORK);
        const int first = begin_post(&server, scene), second = begin_post(&server, scene);
        wait_for_work(&server, is_at_work ? 3 : 4);
        close(leader);
        usleep(20000);
        if (!is_at_work) close(block);
        answers[2 * is_at_work] = end(first);
        answers[2 * is_at_work + 1] = end(second);
    }
    for (int i = 0; i < 4; i++)
        assert_same_answer(answers[i], answers[0]);
    client_wait_for_metric(&server, "", "zraster_shared_answers_total 4");
    for (int i = 0; i < 4; i++)
        free(answers[i]);
    free(scene);
    daemon_stop(&server);
}

TEST(work_ends_once_all_have_left)
{
    struct daemon server = daemon_start(LIST(LET_IN));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    for (int order = 0; order < 2; order++) {
        int clients[3];
        for (int i = 0; i < 3; i++) {
            clients[i] = begin_post(&server, scene);
            client_wait_for_metric(&server, "", ONE_AT_WORK);
        }
        wait_for_work(&server, 3);
        for (int i = 0; i < 3; i++)
            close(clients[order ? 2 - i : i]);
        client_wait_for_metric(&server, "", "zraster_workers_busy 0");
        wait_for_work(&server, 0);
    }
    client_wait_for_metric(&server, "", "zraster_shared_answers_total 0");
    free(scene);
    daemon_stop(&server);
}

/* The deadline of a leader is not that of its followers, which are worked on then. */
TEST(deadlines_are_not_shared)
{
    struct daemon server =
        daemon_start(LIST(ANY_COST, "--workers=1", "--max-per-private-client=0", "--render-timeout-ms=400"));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    const double begun = client_seconds();
    const int leader = begin_post(&server, scene), follower = begin_post(&server, scene);
    char *first = end(leader), *second = end(follower);
    assert_int_equal(raw_status(first), 504);
    assert_int_equal(raw_status(second), 504);
    assert_true(client_seconds() - begun > 0.8);
    free(first);
    free(second);
    free(scene);
    daemon_stop(&server);
}

TEST(a_leader_and_its_followers_are_refused_when_the_daemon_ends)
{
    struct daemon server = daemon_start(LIST(LET_IN, "--drain-timeout-ms=100"));
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, MANY);
    int clients[3];
    for (int i = 0; i < 3; i++)
        clients[i] = begin_post(&server, scene);
    wait_for_work(&server, 3);
    daemon_stop(&server);
    for (int i = 0; i < 3; i++) {
        char *text = end(clients[i]);
        assert_int_equal(raw_status(text), 503);
        free(text);
    }
    free(scene);
}

/* ---- what is not equal ---- */

#define SCENE(colour)                                                                                                  \
    "{\"window\":{\"width\":1500,\"height\":1500},\"samples\":16,\"background\":[" colour                              \
    ",0,0],\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}"

struct request {
    char target[200];
    const char *headers, *body;
};

/* Sends both twice at once, and then alone: the answers are the same. */
static void assert_not_mixed(const struct daemon *server, const struct request pair[2])
{
    int clients[4];
    char *answers[4];
    const int block = begin_block(server);
    for (int i = 0; i < 4; i++)
        clients[i] = begin(server, pair[i % 2].target, pair[i % 2].headers, pair[i % 2].body);
    wait_for_work(server, 5);
    close(block);
    for (int i = 0; i < 4; i++)
        answers[i] = end(clients[i]);
    for (int i = 0; i < 4; i++) {
        char *alone = end(begin(server, pair[i % 2].target, pair[i % 2].headers, pair[i % 2].body));
        assert_int_equal(raw_status(answers[i]), 200);
        if (strncmp(pair[i % 2].target, "HEAD", 4) == 0)
            assert_string_equal(body_of(answers[i]), "");
        else
            assert_same_answer(answers[i], alone);
        free(alone);
    }
    for (int i = 0; i < 4; i++)
        free(answers[i]);
}

TEST(different_requests_are_not_mixed)
{
    static const char one[] = SCENE("1"), two[] = SCENE("0"), json[] = JSON_TYPE "\r\n";
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, LIST(LET_IN));
    const struct asset_name name = asset_post(&server, one, sizeof one - 1, 201);
    struct request requests[] = {
        {"POST /v1/render", json, one},
        {"POST /v1/render", json, two},
        {"POST /v1/render?width=1400", json, one},
        {"POST /v1/render?width=1300", json, one},
        {"POST /v1/render", "", one},
        {"GET ", "", ""},
        {"GET ", "", ""},
        {"HEAD ", "", ""},
    };
    enum { COUNT = sizeof requests / sizeof *requests, FIRST_ADDRESS = 5 };
    char line[80];
    for (int i = FIRST_ADDRESS; i < COUNT; i++)
        snprintf(requests[i].target + strlen(requests[i].target), 150, "/v1/renders/%s?width=%d", name.text,
                 i == FIRST_ADDRESS ? 1400 : 1300);
    for (int i = 0; i + 1 < COUNT; i++)
        assert_not_mixed(&server, &requests[i]);
    snprintf(line, sizeof line, "zraster_shared_answers_total %d", 2 * (COUNT - 1));
    client_wait_for_metric(&server, "", line);
    daemon_stop(&server);
    folder_remove(&folder);
}

/* A preset that is changed while a picture of it is under way. */
TEST(an_address_whose_preset_has_changed_is_another_one)
{
    static const char scene[] = SCENE("1"), old[] = "small = width=1500\n", new[] = "small = width=1400\n";
    struct folder folder = folder_make(), others = folder_make();
    const struct folder file = folder_file(&others, "presets");
    char flag[FOLDER_SIZE + 16], target[200];
    folder_write(&file, old, sizeof old - 1);
    snprintf(flag, sizeof flag, "--presets=%s", file.path);
    struct daemon server = assets_start(&folder, LIST(LET_IN, flag));
    const struct asset_name name = asset_post(&server, scene, sizeof scene - 1, 201);
    snprintf(target, sizeof target, "GET /v1/renders/%s/small", name.text);
    const int block = begin_block(&server);
    const int before = begin(&server, target, "", "");
    wait_for_work(&server, 2);
    folder_write(&file, new, sizeof new - 1);
    kill(server.pid, SIGHUP);
    free(daemon_wait_for_log(&server, "reload"));
    const int after = begin(&server, target, "", "");
    wait_for_work(&server, 3);
    close(block);
    char *first = end(before), *second = end(after);
    assert_int_equal(raw_status(first), 200);
    assert_int_equal(raw_status(second), 200);
    assert_memory_equal(body_of(first) + 18, "\x05\xdc", 2); /* the width of a PNG */
    assert_memory_equal(body_of(second) + 18, "\x05\x78", 2);
    client_wait_for_metric(&server, "", "zraster_shared_answers_total 0");
    free(first);
    free(second);
    daemon_stop(&server);
    folder_remove(&folder);
    folder_remove(&others);
}

RUN_TESTS(clients_setup, clients_teardown)
