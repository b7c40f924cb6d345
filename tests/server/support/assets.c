#include "assets.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "support/cmocka_all.h"

enum { FLAGS_MAX = 16 };

struct folder folder_make(void)
{
    struct folder folder;
    const char *parent = getenv("TMPDIR");
    snprintf(folder.path, sizeof folder.path, "%.200s/zraster-assets-XXXXXX", parent && *parent ? parent : "/tmp");
    assert_non_null(mkdtemp(folder.path));
    return folder;
}

struct folder folder_file(const struct folder *folder, const char *name)
{
    struct folder file;
    int length = snprintf(file.path, sizeof file.path, "%s/%s", folder->path, name);
    assert_in_range(length, 1, FOLDER_SIZE - 1);
    return file;
}

static bool is_own_link(const char *name)
{
    return strcmp(name, ".") == 0 || strcmp(name, "..") == 0;
}

int folder_count(const struct folder *folder)
{
    int count = 0;
    DIR *listing = opendir(folder->path);
    assert_non_null(listing);
    for (struct dirent *file; (file = readdir(listing));)
        count += !is_own_link(file->d_name);
    closedir(listing);
    return count;
}

void folder_write(const struct folder *file, const void *bytes, size_t size)
{
    int fd = open(file->path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, bytes, size), size);
    close(fd);
}

void folder_remove(const struct folder *folder)
{
    DIR *listing = opendir(folder->path);
    assert_non_null(listing);
    for (struct dirent *file; (file = readdir(listing));)
        if (!is_own_link(file->d_name)) remove(folder_file(folder, file->d_name).path);
    closedir(listing);
    assert_int_equal(rmdir(folder->path), 0);
}

struct daemon assets_start(const struct folder *folder, const char *const *flags)
{
    const char *all[FLAGS_MAX + 1] = {"--assets-dir", folder->path};
    for (size_t i = 0; flags && flags[i]; i++) {
        assert_true(i + 2 < FLAGS_MAX);
        all[i + 2] = flags[i];
    }
    return daemon_start(all);
}

static void make_target(char target[ASSET_TARGET_SIZE], const char *name)
{
    snprintf(target, ASSET_TARGET_SIZE, "/v1/assets/%s", name);
}

struct reply asset_put(const struct daemon *daemon, const char *name, const void *bytes, size_t size)
{
    char target[ASSET_TARGET_SIZE];
    make_target(target, name);
    return client_send(daemon, "PUT", target, NULL, bytes, size);
}

struct reply asset_get(const struct daemon *daemon, const char *name)
{
    char target[ASSET_TARGET_SIZE];
    make_target(target, name);
    return client_get(daemon, target);
}

long asset_status(const struct daemon *daemon, const char *name)
{
    struct reply reply = asset_get(daemon, name);
    long status = reply.status;
    reply_free(&reply);
    return status;
}

struct asset_name asset_post(const struct daemon *daemon, const void *bytes, size_t size, long status)
{
    struct asset_name name;
    struct reply reply = client_send(daemon, "POST", "/v1/assets", NULL, bytes, size);
    if (reply.status != status) fail_msg("wanted %ld, got %ld: %s", status, reply.status, reply.body);
    assert_int_equal(sscanf(reply.body, "{\"sha256\":\"%64[0-9a-f]\"", name.text), 1);
    reply_free(&reply);
    return name;
}
