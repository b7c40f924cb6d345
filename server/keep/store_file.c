#include "store_file.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include <nettle/base16.h>
#include <nettle/sha2.h>

/* ---- names ---- */

enum { CHUNK_BYTES = 64 << 10 };

bool store_is_name(const char *text)
{
    return strspn(text, "0123456789abcdef") == STORE_NAME_SIZE - 1 && text[STORE_NAME_SIZE - 1] == '\0';
}

static void finish(struct sha256_ctx *context, char name[STORE_NAME_SIZE])
{
    uint8_t digest[SHA256_DIGEST_SIZE];
    sha256_digest(context, sizeof digest, digest);
    base16_encode_update(name, sizeof digest, digest);
    name[STORE_NAME_SIZE - 1] = '\0';
}

void store_name(const void *bytes, size_t size, char name[STORE_NAME_SIZE])
{
    struct sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, size, bytes);
    finish(&context, name);
}

bool store_name_of_file(int fd, size_t size, const struct zr_cancel *cancel, char name[STORE_NAME_SIZE])
{
    struct sha256_ctx context;
    uint8_t chunk[CHUNK_BYTES];
    sha256_init(&context);
    for (size_t done = 0; done < size;) {
        const size_t count = size - done < sizeof chunk ? size - done : sizeof chunk;
        if (zr_is_cancelled(cancel)) {
            errno = ECANCELED;
            return false;
        }
        if (!store_file_read(fd, chunk, count)) return false;
        sha256_update(&context, count, chunk);
        done += count;
    }
    finish(&context, name);
    return true;
}

/* ---- files ---- */

/* PART_MAX: below the most that Linux moves per call. ATTEMPTS: losing the race of create() that often is an error. */
enum { PART_MAX = 1 << 30, ATTEMPTS = 8, DIGITS = 16, MODE = 0600 };

static const char PREFIX[] = ".zraster-upload-";

_Static_assert(sizeof PREFIX + DIGITS == STORE_TEMPORARY_SIZE, "a temporary name fits");

int store_file_open(int directory, const char *name, struct stat *info)
{
    /* O_NONBLOCK: a pipe of that name must not block. */
    int fd = openat(directory, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) return -1;
    if (fstat(fd, info) == 0 && S_ISREG(info->st_mode)) return fd;
    close(fd);
    errno = ENOENT;
    return -1;
}

bool store_file_read(int fd, void *bytes, size_t size)
{
    for (size_t done = 0; done < size;) {
        ssize_t count = read(fd, (char *)bytes + done, size - done < PART_MAX ? size - done : PART_MAX);
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) errno = 0;
        if (count <= 0) return false;
        done += (size_t)count;
    }
    return true;
}

static bool write_all(int fd, const char *bytes, size_t size)
{
    for (size_t done = 0; done < size;) {
        ssize_t count = write(fd, bytes + done, size - done < PART_MAX ? size - done : PART_MAX);
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) done += (size_t)count;
    }
    return true;
}

/* Creates and locks a new file. A process that starts now may remove the file as abandoned before it is locked; then
 * another one is created. */
static int create(int directory, char temporary[STORE_TEMPORARY_SIZE])
{
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        uint64_t number;
        struct stat info;
        if (getrandom(&number, sizeof number, 0) != sizeof number) return -1;
        snprintf(temporary, STORE_TEMPORARY_SIZE, "%s%016" PRIx64, PREFIX, number);
        int fd = openat(directory, temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, MODE);
        if (fd < 0) return -1;
        bool is_ours = flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; /* or the file system has no locks */
        if (is_ours && fstat(fd, &info) == 0 && info.st_nlink > 0) return fd;
        unlinkat(directory, temporary, 0);
        close(fd);
    }
    errno = EAGAIN;
    return -1;
}

bool store_file_write(int directory, const void *bytes, size_t size, struct timespec used,
                      char temporary[STORE_TEMPORARY_SIZE], int *fd)
{
    *fd = create(directory, temporary);
    if (*fd < 0) return false;
    if (write_all(*fd, bytes, size) && futimens(*fd, (struct timespec[]){used, used}) == 0 && fsync(*fd) == 0)
        return true;
    int cause = errno;
    unlinkat(directory, temporary, 0);
    close(*fd);
    errno = cause;
    return false;
}

bool store_file_is_temporary(const char *name)
{
    size_t length = sizeof PREFIX - 1;
    return strncmp(name, PREFIX, length) == 0 && strspn(name + length, "0123456789abcdef") == DIGITS &&
           name[length + DIGITS] == '\0';
}

void store_file_sweep(int directory, const char *temporary)
{
    int fd = openat(directory, temporary, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) return;
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) unlinkat(directory, temporary, 0);
    close(fd);
}
