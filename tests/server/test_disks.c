/* Directories of assets that do not take what they are given: full ones, read-only ones, and what is none. */
#include <errno.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "server/support/assets.h"
#include "support/tests.h"

static void assert_full_and_well(struct daemon *server, const struct folder *folder)
{
    enum { SIZE = 200000 };
    char *bytes = calloc(1, SIZE);
    for (int i = 0; i < 3; i++) {
        assert_problem(client_send(server, "POST", "/v1/assets", NULL, bytes, SIZE), 507, "no room");
        assert_int_equal(folder_count(folder), 1); /* nothing is left of it */
    }
    assert_int_equal(asset_status(server, ABC_NAME), 200);
    asset_post(server, "abc", 3, 200);
    free(bytes);
}

TEST(file_beyond_the_system_limit_gives_507)
{
    struct folder folder = folder_make();
    struct rlimit before, low;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    low = (struct rlimit){100000, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &low), 0);
    struct daemon server = assets_start(&folder, NULL);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    asset_post(&server, "abc", 3, 201);
    assert_full_and_well(&server, &folder);
    daemon_stop(&server);
    folder_remove(&folder);
}

/* A small file system that nobody else sees. False: not allowed. */
static bool mount_small(const struct folder *folder)
{
    return unshare(CLONE_NEWNS) == 0 && mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) == 0 &&
           mount("none", folder->path, "tmpfs", 0, "size=64k") == 0;
}

TEST(full_disk_gives_507)
{
    struct folder folder = folder_make();
    if (!mount_small(&folder)) {
        fprintf(stderr, "LEFT OUT: a full disk: mounting a small one needs root (%s)\n", strerror(errno));
        folder_remove(&folder);
        skip();
    }
    struct daemon server = assets_start(&folder, NULL);
    asset_post(&server, "abc", 3, 201);
    assert_full_and_well(&server, &folder);
    daemon_stop(&server);
    assert_int_equal(umount(folder.path), 0);
    folder_remove(&folder);
}

/* Root may write everywhere but on a disk that is mounted so. */
static bool make_read_only(const struct folder *folder, bool on)
{
    if (geteuid() != 0) return chmod(folder->path, on ? 0500 : 0700) == 0;
    if (!on) return umount(folder->path) == 0;
    return mount("none", folder->path, "tmpfs", MS_REMOUNT | MS_RDONLY, "size=64k") == 0;
}

TEST(read_only_directory_serves_what_it_has)
{
    struct folder folder = folder_make();
    if (geteuid() == 0 && !mount_small(&folder)) {
        fprintf(stderr, "LEFT OUT: a read-only directory: root cannot mount one here (%s)\n", strerror(errno));
        folder_remove(&folder);
        skip();
    }
    struct folder file = folder_file(&folder, ABC_NAME);
    folder_write(&file, "abc", 3);
    assert_true(make_read_only(&folder, true));
    struct daemon server = assets_start(&folder, LIST("--assets-max-bytes=4096"));
    free(daemon_wait_for_log(&server, "assets-read-only"));
    assert_int_equal(asset_status(&server, ABC_NAME), 200);
    asset_post(&server, "abc", 3, 200);
    assert_problem(client_send(&server, "POST", "/v1/assets", NULL, "other", 5), 403, "cannot be written");
    assert_int_equal(asset_status(&server, ABC_NAME), 200);
    daemon_stop(&server);
    assert_true(make_read_only(&folder, false));
    folder_remove(&folder);
}

TEST(directory_that_cannot_be_used_stops_the_start)
{
    struct folder folder = folder_make();
    struct folder file = folder_file(&folder, "file");
    folder_write(&file, "", 0);
    const struct {
        const char *path, *text;
    } cases[] = {{"/does/not/exist", "No such file or directory"}, {file.path, "Not a directory"}};
    for (size_t i = 0; i < 2; i++) {
        char *output = NULL;
        assert_int_equal(daemon_run(LIST("--port=0", "--assets-dir", cases[i].path), &output), 1);
        if (!strstr(output, "--assets-dir") || !strstr(output, cases[i].text)) fail_msg("%s", output);
        free(output);
    }
    folder_remove(&folder);
}

RUN_TESTS(NULL, NULL)
