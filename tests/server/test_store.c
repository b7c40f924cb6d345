/* The directory of assets: what it holds, what becomes of it, and who works in it. */
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "server/support/assets.h"
#include "support/tests.h"

/* Many at once, and none refused for it. */
#define CROWD "--max-per-client=0", "--queue=64", "--workers=8"

static bool has_file(const struct folder *folder, const char *name)
{
    struct stat info;
    return lstat(folder_file(folder, name).path, &info) == 0;
}

/* One block on disk, its own for each number. */
static struct asset_name post_number(const struct daemon *daemon, int number, long status)
{
    char text[32];
    int length = snprintf(text, sizeof text, "asset %d", number);
    return asset_post(daemon, text, (size_t)length, status);
}

static void assert_is_number(const struct daemon *daemon, const char *name, int number)
{
    char text[32];
    int length = snprintf(text, sizeof text, "asset %d", number);
    struct reply reply = asset_get(daemon, name);
    assert_int_equal(reply.status, 200);
    assert_int_equal(reply.size, length);
    assert_string_equal(reply.body, text);
    reply_free(&reply);
}

/* ---- room ---- */

TEST(least_recently_used_makes_room)
{
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, LIST("--assets-max-bytes=12288"));
    struct asset_name names[6];
    for (int i = 0; i < 3; i++)
        names[i] = post_number(&server, i, 201);
    assert_is_number(&server, names[0].text, 0); /* each way to use one counts */
    post_number(&server, 1, 200);
    names[3] = post_number(&server, 3, 201);
    assert_int_equal(asset_status(&server, names[2].text), 404);
    assert_false(has_file(&folder, names[2].text));
    names[4] = post_number(&server, 4, 201);
    assert_int_equal(asset_status(&server, names[0].text), 404);
    assert_is_number(&server, names[1].text, 1);
    assert_is_number(&server, names[3].text, 3);
    assert_is_number(&server, names[4].text, 4);
    char large[8193] = "";
    asset_post(&server, large, 8193, 201); /* three blocks */
    assert_int_equal(folder_count(&folder), 1);
    daemon_stop(&server);
    folder_remove(&folder);
}

TEST(assets_and_their_order_outlive_a_restart)
{
    struct folder folder = folder_make();
    struct asset_name names[4];
    struct daemon server = assets_start(&folder, LIST("--assets-max-bytes=12288"));
    for (int i = 0; i < 3; i++)
        names[i] = post_number(&server, i, 201);
    assert_is_number(&server, names[0].text, 0);
    daemon_stop(&server);
    server = assets_start(&folder, LIST("--assets-max-bytes=12288"));
    names[3] = post_number(&server, 3, 201);
    assert_int_equal(asset_status(&server, names[1].text), 404);
    assert_is_number(&server, names[2].text, 2);
    assert_is_number(&server, names[0].text, 0);
    assert_is_number(&server, names[3].text, 3);
    daemon_stop(&server);
    server = assets_start(&folder, LIST("--assets-max-bytes=8192")); /* less than there is */
    assert_int_equal(folder_count(&folder), 2);
    assert_int_equal(asset_status(&server, names[2].text), 404);
    assert_is_number(&server, names[0].text, 0);
    daemon_stop(&server);
    folder_remove(&folder);
}

/* ---- what else may lie there ---- */

TEST(only_temporary_files_that_nobody_works_on_are_removed)
{
    struct folder folder = folder_make();
    const char *const foreign[] = {"README", ".zraster-upload-0123456789abcde", ".zraster-upload-0123456789abcdefg",
                                   ".zraster-upload-0123456789abcdeX", "upload-0123456789abcdef"};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        struct folder file = folder_file(&folder, foreign[i]);
        folder_write(&file, "x", 1);
    }
    struct folder left = folder_file(&folder, ".zraster-upload-0123456789abcdef");
    struct folder held = folder_file(&folder, ".zraster-upload-fedcba9876543210");
    folder_write(&left, "half", 4);
    folder_write(&held, "half", 4);
    int fd = open(held.path, O_RDONLY);
    assert_int_equal(flock(fd, LOCK_EX), 0);
    struct daemon server = assets_start(&folder, NULL);
    assert_false(has_file(&folder, strrchr(left.path, '/') + 1));
    assert_int_equal(folder_count(&folder), 6);
    daemon_stop(&server);
    close(fd);
    server = assets_start(&folder, NULL);
    assert_false(has_file(&folder, strrchr(held.path, '/') + 1));
    assert_int_equal(folder_count(&folder), 5);
    daemon_stop(&server);
    folder_remove(&folder);
}

TEST(files_that_are_none_of_ours_do_no_harm)
{
    char link[ASSET_NAME_SIZE], pipe[ASSET_NAME_SIZE], directory[ASSET_NAME_SIZE];
    struct folder folder = folder_make(), outside = folder_make();
    struct folder secret = folder_file(&outside, "secret");
    folder_write(&secret, "abc", 3);
    memset(pipe, '1', 64), memset(link, '2', 64), memset(directory, '3', 64);
    pipe[64] = link[64] = directory[64] = '\0';
    assert_int_equal(symlink(secret.path, folder_file(&folder, ABC_NAME).path), 0);
    assert_int_equal(symlink("/dev/zero", folder_file(&folder, link).path), 0);
    assert_int_equal(mkfifo(folder_file(&folder, pipe).path, 0600), 0);
    assert_int_equal(mkdir(folder_file(&folder, EMPTY_NAME).path, 0700), 0);
    assert_int_equal(mkdir(folder_file(&folder, directory).path, 0700), 0);
    struct daemon server = assets_start(&folder, NULL);
    const char *const names[] = {ABC_NAME, link, pipe, EMPTY_NAME, directory};
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(asset_status(&server, names[i]), 404);
    assert_problem(asset_put(&server, EMPTY_NAME, "", 0), 500, "Is a directory");
    assert_int_equal(folder_count(&folder), 5); /* and nothing is left of the attempt */
    asset_post(&server, "abc", 3, 201);         /* in the link's place, not through it */
    assert_int_equal(asset_status(&server, ABC_NAME), 200);
    assert_true(has_file(&outside, "secret"));
    daemon_stop(&server);
    folder_remove(&folder);
    folder_remove(&outside);
}

/* ---- files that change ---- */

TEST(broken_file_is_found_removed_and_healed)
{
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, NULL);
    struct folder file = folder_file(&folder, ABC_NAME);
    const char *const broken[] = {"abd", "ab", "abcd", ""};
    asset_post(&server, "abc", 3, 201);
    for (size_t i = 0; i < 4; i++) {
        folder_write(&file, broken[i], strlen(broken[i]));
        assert_int_equal(asset_status(&server, ABC_NAME), 404);
        assert_false(has_file(&folder, ABC_NAME));
        asset_post(&server, "abc", 3, 201);
        assert_int_equal(asset_status(&server, ABC_NAME), 200);
    }
    free(daemon_wait_for_log(&server, "asset-broken"));
    assert_int_equal(truncate(file.path, 2), 0); /* sent again before anybody asked for it */
    asset_post(&server, "abc", 3, 201);
    assert_int_equal(asset_status(&server, ABC_NAME), 200);
    folder_write(&file, "abd", 3); /* likewise, of the same size */
    asset_post(&server, "abc", 3, 201);
    assert_int_equal(asset_status(&server, ABC_NAME), 200);
    assert_int_equal(unlink(file.path), 0);
    assert_int_equal(asset_status(&server, ABC_NAME), 404);
    asset_post(&server, "abc", 3, 201);
    assert_int_equal(unlink(file.path), 0);
    asset_post(&server, "abc", 3, 201);
    daemon_stop(&server);
    folder_remove(&folder);
}

struct spoiler {
    struct folder file;
    atomic_bool stop;
};

static void *cut_again_and_again(void *argument)
{
    struct spoiler *spoiler = argument;
    while (!atomic_load(&spoiler->stop)) {
        (void)!truncate(spoiler->file.path, 100);
        usleep(1000);
    }
    return NULL;
}

TEST(file_that_shrinks_while_it_is_read_never_harms)
{
    enum { SIZE = 1 << 22, ROUNDS = 12 };
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, NULL);
    char *bytes = malloc(SIZE);
    memset(bytes, 'z', SIZE);
    struct asset_name name = asset_post(&server, bytes, SIZE, 201);
    struct spoiler spoiler = {.file = folder_file(&folder, name.text)};
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, cut_again_and_again, &spoiler), 0);
    for (int i = 0; i < ROUNDS; i++) {
        struct reply put = asset_put(&server, name.text, bytes, SIZE);
        assert_in_range(put.status, 200, 201);
        reply_free(&put);
        const time_t begun = time(NULL);
        struct reply got = asset_get(&server, name.text);
        if (got.status == 200)
            assert_memory_equal(got.body, bytes, SIZE);
        else if (got.status == 0) /* cut while it was sent: the connection ends, and soon */
            assert_true(time(NULL) - begun < 10);
        else
            assert_int_equal(got.status, 404);
        reply_free(&got);
    }
    atomic_store(&spoiler.stop, true);
    pthread_join(thread, NULL);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    daemon_stop(&server);
    folder_remove(&folder);
    free(bytes);
}

TEST(file_that_is_cut_while_it_is_read_is_missing)
{
    const off_t size = 128 << 20;
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, NULL);
    struct folder file = folder_file(&folder, ABC_NAME);
    for (int ms = 1; ms <= 64; ms *= 4) {
        folder_write(&file, "", 0);
        assert_int_equal(truncate(file.path, size), 0);
        int fd = client_connect(&server);
        static const char request[] = "GET /v1/assets/" ABC_NAME " HTTP/1.1\r\nHost: a\r\n\r\n";
        assert_true(client_write(fd, request, sizeof request - 1));
        usleep((useconds_t)ms * 1000);
        (void)!truncate(file.path, 1000);
        char *answer = client_read(fd, "kept under this name", 30000);
        assert_int_equal(raw_status(answer), 404);
        assert_false(has_file(&folder, ABC_NAME));
        free(answer);
        close(fd);
    }
    daemon_stop(&server);
    folder_remove(&folder);
}

/* Its end will never come, and nobody else's limits are waited for. */
TEST(file_that_is_cut_while_it_is_sent_ends_its_connection)
{
    enum { SIZE = 32 << 20 }; /* more than systems hold on the way */
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, NULL);
    char *bytes = calloc(1, SIZE), text[256];
    assert_non_null(bytes);
    struct asset_name name = asset_post(&server, bytes, SIZE, 201);
    struct folder file = folder_file(&folder, name.text);
    int fd = client_connect(&server);
    snprintf(text, sizeof text, "GET /v1/assets/%s HTTP/1.1\r\nHost: a\r\n\r\n", name.text);
    assert_true(client_write(fd, text, strlen(text)));
    assert_int_equal(recv(fd, text, 64, MSG_WAITALL), 64);
    assert_int_equal(truncate(file.path, 1000), 0);
    const time_t begun = time(NULL);
    free(client_read(fd, NULL, 15000));
    assert_true(time(NULL) - begun < 4); /* a reader has 5 s at least */
    close(fd);
    daemon_stop(&server);
    folder_remove(&folder);
    free(bytes);
}

/* ---- many at once ---- */

enum { CLIENTS = 12, EACH = 15 };

struct client {
    const struct daemon *daemon;
    pthread_t thread;
    int first; /* its numbers, from here on */
    int created, kept, lost;
    struct asset_name names[EACH];
};

static void *put_and_get(void *argument)
{
    struct client *client = argument;
    for (int i = 0; i < EACH; i++) {
        char text[32];
        int length = snprintf(text, sizeof text, "asset %d", client->first + i);
        struct reply reply = client_send(client->daemon, "POST", "/v1/assets", NULL, text, (size_t)length);
        client->created += reply.status == 201;
        client->kept += reply.status == 200;
        (void)!sscanf(reply.body, "{\"sha256\":\"%64[0-9a-f]\"", client->names[i].text);
        reply_free(&reply);
        reply = asset_get(client->daemon, client->names[i].text);
        client->lost += reply.status == 404;
        if (reply.status == 200 && strcmp(reply.body, text) != 0) client->created = -1000;
        reply_free(&reply);
    }
    return NULL;
}

/* All clients at once; what they count, added up. */
static struct client run_clients(struct client *clients, const struct daemon *a, const struct daemon *b, bool same)
{
    struct client sum = {.created = 0};
    for (int i = 0; i < CLIENTS; i++) {
        clients[i] = (struct client){.daemon = i % 2 ? a : b, .first = same ? 0 : i * EACH};
        assert_int_equal(pthread_create(&clients[i].thread, NULL, put_and_get, &clients[i]), 0);
    }
    for (int i = 0; i < CLIENTS; i++) {
        pthread_join(clients[i].thread, NULL);
        sum.created += clients[i].created;
        sum.kept += clients[i].kept;
        sum.lost += clients[i].lost;
    }
    return sum;
}

TEST(same_assets_put_at_once_are_new_once)
{
    static struct client clients[CLIENTS];
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, LIST(CROWD));
    struct client sum = run_clients(clients, &server, &server, true);
    assert_int_equal(sum.created, EACH);
    assert_int_equal(sum.kept, (CLIENTS - 1) * EACH);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(folder_count(&folder), EACH);
    daemon_stop(&server);
    folder_remove(&folder);
}

TEST(different_assets_put_at_once_are_all_kept)
{
    static struct client clients[CLIENTS];
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, LIST(CROWD));
    struct client sum = run_clients(clients, &server, &server, false);
    assert_int_equal(sum.created, CLIENTS * EACH);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(folder_count(&folder), CLIENTS * EACH);
    for (int i = 0; i < CLIENTS; i++)
        for (int k = 0; k < EACH; k++)
            assert_is_number(&server, clients[i].names[k].text, i * EACH + k);
    daemon_stop(&server);
    folder_remove(&folder);
}

TEST(bound_holds_while_many_put_at_once)
{
    static struct client clients[CLIENTS];
    struct folder folder = folder_make();
    struct daemon server = assets_start(&folder, LIST(CROWD, "--assets-max-bytes=12288"));
    struct client sum = run_clients(clients, &server, &server, false);
    assert_int_equal(sum.created, CLIENTS * EACH);
    assert_int_equal(folder_count(&folder), 3);
    daemon_stop(&server);
    folder_remove(&folder);
}

/* ---- two daemons ---- */

TEST(two_daemons_share_a_directory)
{
    static struct client clients[CLIENTS];
    struct folder folder = folder_make();
    struct daemon a = assets_start(&folder, LIST(CROWD)), b = assets_start(&folder, LIST(CROWD));
    struct asset_name name = asset_post(&a, "abc", 3, 201);
    assert_int_equal(asset_status(&b, name.text), 200);
    asset_post(&b, "abc", 3, 200);
    struct client sum = run_clients(clients, &a, &b, true);
    assert_int_equal(sum.created + sum.kept, CLIENTS * EACH);
    assert_int_equal(sum.lost, 0);
    sum = run_clients(clients, &a, &b, false);
    assert_int_equal(sum.created + sum.kept, CLIENTS * EACH);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(folder_count(&folder), CLIENTS * EACH + 1);
    daemon_stop(&a);
    daemon_stop(&b);
    folder_remove(&folder);
}

TEST(daemon_spares_what_another_has_used)
{
    struct folder folder = folder_make();
    struct daemon a = assets_start(&folder, LIST("--assets-max-bytes=8192"));
    struct asset_name first = post_number(&a, 1, 201), second = post_number(&a, 2, 201);
    struct daemon b = assets_start(&folder, LIST("--assets-max-bytes=8192"));
    assert_is_number(&b, first.text, 1);
    post_number(&a, 3, 201);
    assert_int_equal(asset_status(&b, second.text), 404);
    assert_is_number(&a, first.text, 1);
    post_number(&b, 4, 201); /* b had both of the first two in mind: one is gone, and it notices */
    assert_int_equal(client_get_status(&b, "/healthz"), 200);
    daemon_stop(&a);
    daemon_stop(&b);
    folder_remove(&folder);
}

RUN_TESTS(clients_setup, clients_teardown)
