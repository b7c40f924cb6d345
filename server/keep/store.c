#include "store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "log/log.h"
#include "store_file.h"
#include "store_index.h"

/* Files count in whole blocks, at least one, as on disks. This bounds the number of files, too. */
enum { BLOCK_BYTES = 4096 };

struct store {
    int directory;
    uint64_t max_bytes;
    pthread_mutex_t lock; /* of all members below; held while names are created and removed, not while bytes move */
    pthread_cond_t room_made;
    struct store_index index;
    uint64_t reserved; /* bytes of files being written */
};

/* ---- lookup ---- */

static uint64_t bytes_on_disk(uint64_t size)
{
    uint64_t blocks = size / BLOCK_BYTES + (size % BLOCK_BYTES != 0);
    return (blocks ? blocks : 1) * BLOCK_BYTES;
}

static struct timespec now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_REALTIME, &time);
    return time;
}

static bool is_later(struct timespec a, struct timespec b)
{
    return a.tv_sec != b.tv_sec ? a.tv_sec > b.tv_sec : a.tv_nsec > b.tv_nsec;
}

/* With the lock held: returns true if `name` is still the file that was opened with `info`. */
static bool is_still_there(const struct store *store, const char *name, const struct stat *info)
{
    struct stat present;
    return fstatat(store->directory, name, &present, AT_SYMLINK_NOFOLLOW) == 0 && present.st_dev == info->st_dev &&
           present.st_ino == info->st_ino;
}

/* Notes the use of an opened file. It may come from another daemon, and be new here. If it has made room since it was
 * opened, it no longer counts. */
static void note_use(struct store *store, const char *name, int fd, const struct stat *info)
{
    struct timespec used = now();
    pthread_mutex_lock(&store->lock);
    struct store_entry *entry = store_index_find(&store->index, name);
    if (entry)
        store_index_touch(&store->index, entry, used);
    else if (is_still_there(store, name, info))
        (void)store_index_add(&store->index, name, bytes_on_disk((uint64_t)info->st_size), used);
    pthread_mutex_unlock(&store->lock);
    (void)futimens(fd, (struct timespec[]){used, used}); /* a failure loses the order at the next start */
}

/* Forgets an asset whose file is gone, unless it has come back. */
static void forget(struct store *store, const char *name)
{
    struct stat info;
    pthread_mutex_lock(&store->lock);
    struct store_entry *entry = store_index_find(&store->index, name);
    if (entry && fstatat(store->directory, name, &info, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT)
        store_index_remove(&store->index, entry);
    pthread_mutex_unlock(&store->lock);
}

/* Removes the file that was opened with `info`, unless another one has replaced it. */
static void remove_broken(struct store *store, const char *name, const struct stat *info)
{
    struct stat present;
    pthread_mutex_lock(&store->lock);
    bool replaced = fstatat(store->directory, name, &present, AT_SYMLINK_NOFOLLOW) == 0 &&
                    (present.st_dev != info->st_dev || present.st_ino != info->st_ino);
    struct store_entry *entry = replaced ? NULL : store_index_find(&store->index, name);
    if (!replaced) unlinkat(store->directory, name, 0);
    if (entry) store_index_remove(&store->index, entry);
    pthread_mutex_unlock(&store->lock);
    log_event("error", "asset-broken", name);
}

/* Returns -1 with errno on failure; ENOENT if there is no such asset. */
static int open_asset(struct store *store, const char *name, struct stat *info)
{
    int fd = store_file_open(store->directory, name, info);
    if (fd >= 0) return fd;
    if (errno == ELOOP) errno = ENOENT;
    int cause = errno;
    if (cause == ENOENT)
        forget(store, name);
    else
        log_event("error", "asset-unreadable", strerror(cause));
    errno = cause;
    return -1;
}

uint64_t store_bytes(struct store *store)
{
    pthread_mutex_lock(&store->lock);
    const uint64_t bytes = store->index.bytes;
    pthread_mutex_unlock(&store->lock);
    return bytes;
}

enum store_status store_look(struct store *store, const char *name, size_t *size)
{
    struct stat info;
    int fd = open_asset(store, name, &info);
    if (fd < 0) return errno == ENOENT ? STORE_MISSING : STORE_FAILED;
    note_use(store, name, fd, &info);
    close(fd);
    *size = (size_t)info.st_size;
    return STORE_THERE;
}

/* Determines the status after reading a file. `whole`: all of it was read, else see errno. `found`: name of its bytes.
 */
static enum store_status finish_reading(struct store *store, const char *name, int fd, const struct stat *info,
                                        bool whole, const char *found)
{
    const int cause = errno;
    if (!whole && cause == ECANCELED) return STORE_CANCELLED;
    if (!whole && cause != 0) {
        log_event("error", "asset-unreadable", strerror(cause));
        errno = cause;
        return STORE_FAILED;
    }
    if (!whole || strcmp(found, name) != 0) {
        remove_broken(store, name, info);
        return STORE_MISSING;
    }
    note_use(store, name, fd, info);
    return STORE_THERE;
}

enum store_status store_read(struct store *store, const char *name, struct zr_arena *arena, const void **bytes,
                             size_t *size)
{
    struct stat info;
    char found[STORE_NAME_SIZE] = "";
    int fd = open_asset(store, name, &info);
    if (fd < 0) return errno == ENOENT ? STORE_MISSING : STORE_FAILED;
    *size = (size_t)info.st_size;
    void *read = zr_arena_alloc(arena, *size, 1);
    *bytes = read;
    enum store_status status = STORE_NO_MEMORY;
    if (read) {
        const bool whole = store_file_read(fd, read, *size);
        if (whole) store_name(read, *size, found);
        status = finish_reading(store, name, fd, &info, whole, found);
    }
    close(fd);
    return status;
}

enum store_status store_fetch(struct store *store, const char *name, const struct zr_cancel *cancel, int *fd,
                              size_t *size)
{
    struct stat info;
    char found[STORE_NAME_SIZE] = "";
    *fd = open_asset(store, name, &info);
    if (*fd < 0) return errno == ENOENT ? STORE_MISSING : STORE_FAILED;
    *size = (size_t)info.st_size;
    const bool whole = store_name_of_file(*fd, *size, cancel, found) && lseek(*fd, 0, SEEK_SET) == 0;
    const enum store_status status = finish_reading(store, name, *fd, &info, whole, found);
    if (status != STORE_THERE) {
        const int cause = errno;
        close(*fd);
        errno = cause;
    }
    return status;
}

/* ---- room ---- */

/* With the lock held: removes the least recently used file. False with errno on failure. */
static bool evict(struct store *store)
{
    struct stat info;
    struct store_entry *oldest = store_index_oldest(&store->index);
    /* Another daemon may have used it later. */
    if (fstatat(store->directory, oldest->name, &info, AT_SYMLINK_NOFOLLOW) == 0 &&
        is_later(info.st_mtim, oldest->used)) {
        store_index_touch(&store->index, oldest, info.st_mtim);
        return true;
    }
    if (unlinkat(store->directory, oldest->name, 0) != 0 && errno != ENOENT) return false;
    store_index_remove(&store->index, oldest);
    return true;
}

/* Reserves `bytes`, at most the size of the store. Waits for other writers if their files and this one do not fit
 * together. False with errno on failure. */
static bool make_room(struct store *store, uint64_t bytes)
{
    bool made = true;
    pthread_mutex_lock(&store->lock);
    while (store->reserved + bytes > store->max_bytes)
        pthread_cond_wait(&store->room_made, &store->lock);
    while (made && store->index.bytes + store->reserved + bytes > store->max_bytes)
        made = evict(store);
    if (made) store->reserved += bytes;
    pthread_mutex_unlock(&store->lock);
    return made;
}

/* ---- putting ---- */

static enum store_status status_of_errno(void)
{
    switch (errno) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
        return STORE_DISK_FULL;
    case EROFS:
    case EACCES:
    case EPERM:
        return STORE_READ_ONLY;
    default:
        return STORE_FAILED;
    }
}

/* With the lock held: returns true if the asset is known and its file exists. */
static bool is_present(struct store *store, const char *name)
{
    struct stat info;
    struct store_entry *entry = store_index_find(&store->index, name);
    if (!entry) return false;
    if (fstatat(store->directory, name, &info, AT_SYMLINK_NOFOLLOW) == 0) return true;
    store_index_remove(&store->index, entry);
    return false;
}

/* With the lock held: renames the temporary file, or removes it if another writer was faster. */
static enum store_status publish(struct store *store, const char *temporary, const char *name, uint64_t bytes,
                                 struct timespec used)
{
    bool there = is_present(store, name);
    if (!there && renameat(store->directory, temporary, store->directory, name) == 0) {
        (void)store_index_add(&store->index, name, bytes,
                              used); /* out of memory: the file stays unknown, like that of another daemon */
        return STORE_NEW;
    }
    enum store_status status = there ? STORE_THERE : status_of_errno();
    int cause = errno;
    unlinkat(store->directory, temporary, 0);
    errno = cause;
    return status;
}

static enum store_status write_reserved(struct store *store, const char *name, const void *bytes, size_t size,
                                        uint64_t reserved)
{
    char temporary[STORE_TEMPORARY_SIZE];
    struct timespec used = now();
    int fd;
    bool written = store_file_write(store->directory, bytes, size, used, temporary, &fd);
    enum store_status status = written ? STORE_NEW : status_of_errno();
    int cause = errno;
    pthread_mutex_lock(&store->lock);
    if (written) {
        status = publish(store, temporary, name, reserved, used);
        cause = errno;
    }
    store->reserved -= reserved;
    pthread_cond_broadcast(&store->room_made);
    pthread_mutex_unlock(&store->lock);
    if (written) close(fd);
    /* A name lost in a crash can be sent again, so a failure is no error. */
    if (status == STORE_NEW) (void)fsync(store->directory);
    errno = cause;
    return status;
}

/* Returns true if the asset exists. Removes a broken file. */
static bool is_kept(struct store *store, const char *name)
{
    size_t size;
    int fd;
    if (store_fetch(store, name, NULL, &fd, &size) != STORE_THERE) return false;
    close(fd);
    return true;
}

enum store_status store_put(struct store *store, const char *name, const void *bytes, size_t size)
{
    uint64_t reserved = bytes_on_disk(size);
    if (reserved > store->max_bytes) return STORE_TOO_LARGE;
    if (is_kept(store, name)) return STORE_THERE;
    if (!make_room(store, reserved)) return status_of_errno();
    return write_reserved(store, name, bytes, size, reserved);
}

/* ---- the beginning and the end ---- */

struct found {
    char name[STORE_NAME_SIZE];
    uint64_t bytes;
    struct timespec used;
};

static int compare_use(const void *a, const void *b)
{
    struct timespec first = ((const struct found *)a)->used, second = ((const struct found *)b)->used;
    return is_later(first, second) - is_later(second, first);
}

/* Lists the *count assets of the directory and removes temporary files. NULL with errno on failure. Free the result. */
static struct found *find_assets(struct store *store, DIR *listing, size_t *count)
{
    size_t room = 64;
    struct found *found = malloc(room * sizeof *found);
    struct stat info;
    for (struct dirent *file; found && (file = readdir(listing));) {
        if (store_file_is_temporary(file->d_name)) store_file_sweep(store->directory, file->d_name);
        if (!store_is_name(file->d_name) || fstatat(store->directory, file->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(info.st_mode))
            continue;
        if (*count == room) {
            struct found *grown = reallocarray(found, room *= 2, sizeof *found);
            if (!grown) free(found);
            found = grown;
        }
        if (!found) break;
        struct found *one = &found[(*count)++];
        *one = (struct found){.bytes = bytes_on_disk((uint64_t)info.st_size), .used = info.st_mtim};
        memcpy(one->name, file->d_name, STORE_NAME_SIZE);
    }
    return found;
}

static bool fill_index(struct store *store)
{
    int fd = openat(store->directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *listing = fd < 0 ? NULL : fdopendir(fd);
    if (!listing) {
        if (fd >= 0) close(fd);
        return false;
    }
    size_t count = 0;
    struct found *found = find_assets(store, listing, &count);
    closedir(listing);
    if (!found) return false;
    qsort(found, count, sizeof *found, compare_use);
    bool added = true;
    for (size_t i = 0; added && i < count; i++)
        added = store_index_add(&store->index, found[i].name, found[i].bytes, found[i].used);
    free(found);
    return added;
}

struct store *store_open(const char *directory, uint64_t max_bytes, char *message, size_t message_size)
{
    struct store *store = calloc(1, sizeof *store);
    if (!store) {
        snprintf(message, message_size, "out of memory");
        return NULL;
    }
    store->max_bytes = max_bytes;
    store_index_init(&store->index);
    pthread_mutex_init(&store->lock, NULL);
    pthread_cond_init(&store->room_made, NULL);
    store->directory = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (store->directory < 0 || !fill_index(store)) {
        snprintf(message, message_size, "--assets-dir: cannot use '%.200s': %s", directory, strerror(errno));
        store_close(store);
        return NULL;
    }
    if (faccessat(store->directory, ".", W_OK, AT_EACCESS) != 0) log_event("warn", "assets-read-only", strerror(errno));
    while (store->index.bytes > max_bytes && evict(store))
        continue;
    return store;
}

void store_close(struct store *store)
{
    if (!store) return;
    store_index_free(&store->index);
    if (store->directory >= 0) close(store->directory);
    pthread_cond_destroy(&store->room_made);
    pthread_mutex_destroy(&store->lock);
    free(store);
}
