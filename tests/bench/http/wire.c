#include "bench/http/wire.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

enum { ROOM = 1 << 20 };

bool wire_open(struct wire *wire, unsigned port)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    int on = 1;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    *wire = (struct wire){.fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), .bytes = malloc(ROOM), .room = ROOM};
    setsockopt(wire->fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return wire->bytes && connect(wire->fd, (struct sockaddr *)&address, sizeof address) == 0;
}

void wire_close(struct wire *wire)
{
    if (wire->fd >= 0) close(wire->fd);
    free(wire->bytes);
}

static bool send_all(int fd, struct iovec *parts, int count)
{
    struct msghdr message = {.msg_iov = parts, .msg_iovlen = (size_t)count};
    while (message.msg_iovlen > 0) {
        ssize_t sent = sendmsg(fd, &message, MSG_NOSIGNAL);
        if (sent < 0) return false;
        while (message.msg_iovlen > 0 && (size_t)sent >= message.msg_iov->iov_len) {
            sent -= (ssize_t)message.msg_iov->iov_len;
            message.msg_iov++;
            message.msg_iovlen--;
        }
        if (message.msg_iovlen == 0) break;
        message.msg_iov->iov_base = (char *)message.msg_iov->iov_base + sent;
        message.msg_iov->iov_len -= (size_t)sent;
    }
    return true;
}

/* More bytes behind the first *size; a zero behind them. */
static bool receive(struct wire *wire, size_t *size)
{
    if (wire->room - *size < ROOM / 2) {
        char *wider = realloc(wire->bytes, wire->room * 2);
        if (!wider) return false;
        wire->bytes = wider;
        wire->room *= 2;
    }
    ssize_t count = recv(wire->fd, wire->bytes + *size, wire->room - *size - 1, 0);
    if (count <= 0) return false;
    *size += (size_t)count;
    wire->bytes[*size] = '\0';
    return true;
}

static bool read_answer(struct wire *wire, struct wire_answer *answer)
{
    size_t size = 0, length = 0, head;
    char *end = NULL;
    wire->bytes[0] = '\0';
    while (!end) {
        if (!receive(wire, &size)) return false;
        end = strstr(wire->bytes, "\r\n\r\n");
    }
    *end = '\0';
    head = (size_t)(end - wire->bytes) + 4;
    const char *told = strcasestr(wire->bytes, "\r\nContent-Length:");
    if (!told || sscanf(told + 17, "%zu", &length) != 1) return false;
    while (size < head + length)
        if (!receive(wire, &size)) return false;
    *answer = (struct wire_answer){.headers = wire->bytes, .body = wire->bytes + head, .size = length};
    return sscanf(wire->bytes, "HTTP/1.1 %d", &answer->status) == 1;
}

bool wire_ask(struct wire *wire, const char *method, const char *target, const void *body, size_t size,
              struct wire_answer *answer)
{
    char head[300];
    int length = snprintf(head, sizeof head, "%s %s HTTP/1.1\r\nHost: 127.0.0.1\r\n", method, target);
    if (body)
        length += snprintf(head + length, sizeof head - (size_t)length,
                           "Content-Type: application/json\r\nContent-Length: %zu\r\n", size);
    length += snprintf(head + length, sizeof head - (size_t)length, "\r\n");
    struct iovec parts[] = {{head, (size_t)length}, {(void *)(uintptr_t)body, size}};
    return send_all(wire->fd, parts, body ? 2 : 1) && read_answer(wire, answer);
}

double wire_step_ms(const struct wire_answer *answer, const char *step)
{
    char key[32];
    const int length = snprintf(key, sizeof key, "%s;dur=", step);
    const char *at = strstr(answer->headers, key);
    return at ? strtod(at + length, NULL) : 0.0;
}
