#include "bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/interruption.h"

enum { HUGE_PAGE = 2 << 20, LARGE_FILE = 64 << 20 };

/* Reserves huge pages for a large file: the system clears them faster than small ones. */
static bool reserve_huge(struct bytes *bytes, size_t size)
{
    void *data;
    const size_t room = (size + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    if (posix_memalign(&data, HUGE_PAGE, room) != 0) return false;
    madvise(data, room, MADV_HUGEPAGE);
    *bytes = (struct bytes){.data = data, .room = room};
    return true;
}

/* Makes room for `size` bytes more. */
static bool reserve(struct bytes *bytes, size_t size)
{
    if (size <= bytes->room - bytes->size) return true;
    if (bytes->room == 0 && size > HUGE_PAGE) return reserve_huge(bytes, size);
    const size_t room = bytes->room * 2 > bytes->size + size ? bytes->room * 2 : bytes->size + size;
    char *grown = realloc(bytes->data, room);
    if (!grown) return false;
    bytes->data = grown;
    bytes->room = room;
    return true;
}

bool bytes_add(struct bytes *bytes, const void *data, size_t size)
{
    if (!reserve(bytes, size)) return false;
    if (size > 0) memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
    return true;
}

bool bytes_print(struct bytes *bytes, const char *format, ...)
{
    va_list arguments;
    char *text;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0) return false;
    const bool ok = bytes_add(bytes, text, (size_t)length + 1);
    if (ok) bytes->size--; /* the final zero is not counted */
    free(text);
    return ok;
}

const char *bytes_text(const struct bytes *bytes)
{
    return bytes->data ? bytes->data : "";
}

void bytes_free(struct bytes *bytes)
{
    if (bytes->is_mapped)
        munmap(bytes->data, bytes->room);
    else
        free(bytes->data);
    *bytes = (struct bytes){.data = NULL};
}

static unsigned long long most_bytes = 1ULL << 33;

void bytes_set_most(unsigned long long most)
{
    most_bytes = most;
}

/* Waits until a pipe has bytes or is closed. Returns false once a signal was caught. */
static bool await_bytes(int descriptor)
{
    enum { PATIENCE_MS = 50 };
    struct pollfd one = {.fd = descriptor, .events = POLLIN};
    while (!interrupted())
        if (poll(&one, 1, PATIENCE_MS) > 0) return true;
    errno = EINTR;
    return false;
}

/* Returns true for /dev/null, the empty input of services and scripts. */
static bool is_null(const struct stat *status)
{
    struct stat null;
    return stat("/dev/null", &null) == 0 && null.st_rdev == status->st_rdev;
}

/* Checks that a descriptor has an end. Terminals have one that people give. */
static bool check_kind(int descriptor, const struct stat *status)
{
    if (!S_ISBLK(status->st_mode) && (!S_ISCHR(status->st_mode) || isatty(descriptor) || is_null(status))) return true;
    errno = ENODEV;
    return false;
}

/* Reads to the end. */
static bool read_all(int descriptor, bool is_file, struct bytes *bytes)
{
    enum { STEP = 1 << 24 }; /* bytes between checks for a signal */
    for (;;) {
        if (bytes->size == bytes->room && !reserve(bytes, 65536)) return false;
        if (!(is_file ? !interrupted() : await_bytes(descriptor))) {
            errno = EINTR;
            return false;
        }
        const size_t room = bytes->room - bytes->size;
        const ssize_t some = read(descriptor, bytes->data + bytes->size, room < STEP ? room : STEP);
        if (some < 0 && (errno == EAGAIN || errno == EINTR)) continue;
        if (some <= 0) return some == 0;
        bytes->size += (size_t)some;
        if (bytes->size > most_bytes) {
            errno = EFBIG;
            return false;
        }
    }
}

/* ---- mapped files ---- */

static void say_that_it_shrank(int signal)
{
    static const char text[] = "zraster: a file became shorter while it was read\n";
    (void)signal;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) _exit(1);
    _exit(1);
}

static bool maps_large_files;

void bytes_map_large_files(void)
{
    const struct sigaction action = {.sa_handler = say_that_it_shrank};
    sigaction(SIGBUS, &action, NULL);
    maps_large_files = true;
}

/* Maps a file so large that a copy would cost more than the faults of its pages. A zero follows it, in the rest of its
 * last page. Returns false if it is to be read instead. */
static bool map(int descriptor, size_t size, struct bytes *bytes)
{
    const long page = sysconf(_SC_PAGESIZE);
    if (!maps_large_files || size < LARGE_FILE || page <= 0 || size % (size_t)page == 0) return false;
    void *data = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, descriptor, 0);
    if (data == MAP_FAILED) return false;
    *bytes = (struct bytes){.data = data, .size = size, .room = size, .is_mapped = true};
    return true;
}

bool bytes_read(struct bytes *bytes, const char *path)
{
    struct stat status;
    const bool is_pipe = strcmp(path, "-") == 0;
    const int descriptor = is_pipe ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return false;
    bool ok = fstat(descriptor, &status) == 0 && check_kind(descriptor, &status);
    const bool is_file = ok && S_ISREG(status.st_mode);
    if (ok && is_file && (unsigned long long)status.st_size > most_bytes) {
        errno = EFBIG;
        ok = false;
    }
    const bool is_mapped =
        ok && is_file && !is_pipe && bytes->size == 0 && map(descriptor, (size_t)status.st_size, bytes);
    ok = is_mapped || (ok && reserve(bytes, is_file ? (size_t)status.st_size + 1 : 1) &&
                       read_all(descriptor, is_file, bytes) && reserve(bytes, 1));
    if (ok && !is_mapped) bytes->data[bytes->size] = '\0'; /* ends the text */
    const int why = errno;
    if (!is_pipe) close(descriptor);
    errno = why;
    return ok;
}

void bytes_explain(struct bytes *faults)
{
    if (errno == EFBIG)
        bytes_print(faults, "it has more than %llu bytes; --max-file-bytes allows more", most_bytes);
    else if (errno == ENODEV)
        bytes_print(faults, "it is a device, which has no end");
    else
        bytes_print(faults, "%s", strerror(errno));
}

bool bytes_same_file(const char *a, const char *b)
{
    struct stat s, t;
    const bool there = strcmp(a, "-") == 0 ? fstat(STDIN_FILENO, &s) == 0 : stat(a, &s) == 0;
    return there && stat(b, &t) == 0 && S_ISREG(s.st_mode) && s.st_dev == t.st_dev && s.st_ino == t.st_ino;
}

/* Returns true for devices, pipes and dangling links. A rename would replace them by a file. */
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

/* Returns the permissions of an existing file, else those that fopen gives a new one. */
static mode_t mode_for(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0) return status.st_mode & 0777;
    mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

/* ---- files that are complete or absent ---- */

/* Opens a file without a name in the folder of `path`: a killed process leaves no file. -1: the file system or the
 * sandbox does not support it. */
static int open_nameless(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const bool can_name = access("/proc/self/fd", X_OK) == 0;
    const int descriptor = folder && can_name ? open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600) : -1;
    free(folder);
    return descriptor;
}

/* Gives a nameless file the name `path`, by way of `beside` if `path` exists. */
static bool give_name(int descriptor, const char *beside, const char *path)
{
    char nameless[40];
    snprintf(nameless, sizeof nameless, "/proc/self/fd/%d", descriptor);
    if (linkat(AT_FDCWD, nameless, AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0) return true;
    if (errno != EEXIST) return false;
    return linkat(AT_FDCWD, nameless, AT_FDCWD, beside, AT_SYMLINK_FOLLOW) == 0 && rename(beside, path) == 0;
}

static bool write_all(const struct bytes *bytes, int descriptor)
{
    for (size_t done = 0; done < bytes->size;) {
        const ssize_t some = write(descriptor, bytes->data + done, bytes->size - done);
        if (some < 0 && errno != EINTR) return false;
        if (some > 0) done += (size_t)some;
    }
    return true;
}

static bool write_beside(const struct bytes *bytes, const char *path)
{
    char *beside = NULL;
    int descriptor = open_nameless(path);
    const bool is_nameless = descriptor >= 0;
    if (is_nameless ? asprintf(&beside, "%s.%ld", path, (long)getpid()) < 0 : asprintf(&beside, "%s.XXXXXX", path) < 0)
        beside = NULL;
    if (beside && !is_nameless) descriptor = mkstemp(beside);
    bool ok = beside && descriptor >= 0 && fchmod(descriptor, mode_for(path)) == 0 && write_all(bytes, descriptor);
    if (ok && is_nameless) ok = give_name(descriptor, beside, path);
    int why = errno;
    const bool is_closed = descriptor < 0 || close(descriptor) == 0;
    if (ok && !is_nameless) { /* a network file system has the bytes only now */
        ok = is_closed && rename(beside, path) == 0;
        why = errno;
    }
    if (!ok && beside && descriptor >= 0) unlink(beside);
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
