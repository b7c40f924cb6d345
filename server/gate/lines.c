#include "lines.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char BLANKS[] = " \t\r";

/* Returns the reason why the file cannot be read, NULL if it can. */
static const char *read_file(struct lines *lines, int fd)
{
    struct stat info;
    if (fd < 0 || fstat(fd, &info) != 0) return strerror(errno);
    if (!S_ISREG(info.st_mode)) return "this is no regular file";
    if (info.st_size > LINES_BYTES_MAX) return "the file has more than 1 MiB";
    lines->is_public = info.st_mode & S_IROTH;
    lines->text = malloc(LINES_BYTES_MAX + 2);
    if (!lines->text) return "out of memory";
    ssize_t count = 1;
    while (count > 0 && lines->size <= LINES_BYTES_MAX) {
        count = read(fd, lines->text + lines->size, LINES_BYTES_MAX + 1 - lines->size);
        if (count < 0) return strerror(errno);
        lines->size += (size_t)count;
    }
    lines->text[lines->size] = '\0';
    if (lines->size > LINES_BYTES_MAX) return "the file has more than 1 MiB";
    return memchr(lines->text, '\0', lines->size) ? "this is no text: it has a zero byte" : NULL;
}

bool lines_open(struct lines *lines, const char *path, char *message, size_t message_size)
{
    *lines = (struct lines){.path = path};
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* no waiting for the other end of a pipe */
    const char *fault = read_file(lines, fd);
    if (fd >= 0) close(fd);
    if (!fault) return true;
    snprintf(message, message_size, "%s: %s", path, fault);
    lines_close(lines);
    return false;
}

char *lines_next(struct lines *lines)
{
    while (lines->at < lines->size) {
        char *line = lines->text + lines->at;
        size_t length = strcspn(line, "\n");
        lines->at += length + 1;
        lines->number++;
        while (length > 0 && strchr(BLANKS, line[length - 1]))
            length--;
        line[length] = '\0';
        line += strspn(line, BLANKS);
        if (*line && *line != '#') return line;
    }
    return NULL;
}

bool lines_fault(const struct lines *lines, char *message, size_t message_size, const char *format, ...)
{
    va_list arguments;
    const int used = snprintf(message, message_size, "%s:%u: ", lines->path, lines->number);
    va_start(arguments, format);
    if (used >= 0 && (size_t)used < message_size)
        vsnprintf(message + used, message_size - (size_t)used, format, arguments);
    va_end(arguments);
    return false;
}

void lines_close(struct lines *lines)
{
    if (lines->text) explicit_bzero(lines->text, lines->size);
    free(lines->text);
    lines->text = NULL;
}
