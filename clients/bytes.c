#include "bytes.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool bytes_add(struct bytes *bytes, const void *data, size_t size)
{
    if (size > bytes->room - bytes->size) {
        size_t room = bytes->room * 2 > bytes->size + size ? bytes->room * 2 : bytes->size + size + 65536;
        char *grown = realloc(bytes->data, room);
        if (!grown) return false;
        bytes->data = grown;
        bytes->room = room;
    }
    memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
    return true;
}

void bytes_free(struct bytes *bytes)
{
    free(bytes->data);
    *bytes = (struct bytes){NULL, 0, 0};
}

bool bytes_read(struct bytes *bytes, const char *path)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    if (!file) return false;
    char chunk[65536];
    bool ok = true;
    for (size_t got; ok && (got = fread(chunk, 1, sizeof chunk, file)) > 0;)
        ok = bytes_add(bytes, chunk, got);
    int why = errno;
    ok = ok && !ferror(file);
    if (file != stdin) fclose(file);
    errno = why;
    return ok;
}

bool bytes_same_file(const char *a, const char *b)
{
    struct stat s, t;
    const bool there = strcmp(a, "-") == 0 ? fstat(STDIN_FILENO, &s) == 0 : stat(a, &s) == 0;
    return there && stat(b, &t) == 0 && S_ISREG(s.st_mode) && s.st_dev == t.st_dev && s.st_ino == t.st_ino;
}

/* Devices, pipes and dangling links are written in place; a rename would replace them by a file. */
static bool is_special(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0) return !S_ISREG(status.st_mode);
    return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

static bool write_whole(const struct bytes *bytes, FILE *file)
{
    bool ok = fwrite(bytes->data ? bytes->data : "", 1, bytes->size, file) == bytes->size;
    return fflush(file) == 0 && ok;
}

/* Returns the rights of an existing file, else those that fopen gives a new one. */
static mode_t mode_for(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0) return status.st_mode & 0777;
    mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

static bool write_and_rename(const struct bytes *bytes, int descriptor, const char *beside, const char *path)
{
    fchmod(descriptor, mode_for(path));
    FILE *file = fdopen(descriptor, "wb");
    if (!file) {
        close(descriptor);
        return false;
    }
    bool ok = write_whole(bytes, file);
    return fclose(file) == 0 && ok && rename(beside, path) == 0;
}

static bool write_beside(const struct bytes *bytes, const char *path)
{
    size_t size = strlen(path) + sizeof ".XXXXXX";
    char *beside = malloc(size);
    if (!beside) return false;
    snprintf(beside, size, "%s.XXXXXX", path);
    int descriptor = mkstemp(beside);
    bool ok = descriptor >= 0 && write_and_rename(bytes, descriptor, beside, path);
    int why = errno;
    if (descriptor >= 0 && !ok) unlink(beside);
    errno = why;
    free(beside);
    return ok;
}

bool bytes_write(const struct bytes *bytes, const char *path)
{
    if (strcmp(path, "-") == 0) return write_whole(bytes, stdout);
    if (!is_special(path)) {
        char *target = realpath(path, NULL); /* of a link: a rename would replace the link itself */
        bool written = write_beside(bytes, target ? target : path);
        free(target);
        return written;
    }
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    bool ok = write_whole(bytes, file);
    return fclose(file) == 0 && ok;
}
