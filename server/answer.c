#include "answer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "problem.h"

void answer_header(struct answer *answer, const char *name, const char *format, ...)
{
    if (answer->header_count == ANSWER_HEADERS_MAX) return;
    char *value = NULL;
    va_list arguments;
    va_start(arguments, format);
    int length = vasprintf(&value, format, arguments);
    va_end(arguments);
    if (length < 0) return;
    answer->headers[answer->header_count++] = (struct answer_header){name, value};
}

void answer_body(struct answer *answer, const char *content_type, char *bytes, size_t size)
{
    free(answer->bytes);
    answer->bytes = bytes;
    answer->size = size;
    answer_header(answer, "Content-Type", "%s", content_type);
}

void answer_send(const struct answer *answer, int socket_fd)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out) return;
    fprintf(out, "HTTP/1.1 %d %s\r\nConnection: close\r\nContent-Length: %zu\r\n", answer->status,
            problem_title(answer->status), answer->size);
    for (size_t i = 0; i < answer->header_count; i++)
        fprintf(out, "%s: %s\r\n", answer->headers[i].name, answer->headers[i].value);
    fputs("\r\n", out);
    if (answer->size > 0) fwrite(answer->bytes, 1, answer->size, out);
    if (fclose(out) == 0) (void)!send(socket_fd, text, length, MSG_NOSIGNAL | MSG_DONTWAIT);
    free(text);
}

void answer_free(struct answer *answer)
{
    free(answer->bytes);
    for (size_t i = 0; i < answer->header_count; i++)
        free(answer->headers[i].value);
    *answer = (struct answer){0};
}
