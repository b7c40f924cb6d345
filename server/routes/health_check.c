#include "health_check.h"

#include <netdb.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "gate/networks.h"

enum { TIMEOUT_S = 3 };

/* Returns true if the daemon waits for a PROXY header from the address of the socket. */
static bool is_proxy_asked_for(const struct config *config, int fd)
{
    struct sockaddr_storage own;
    socklen_t size = sizeof own;
    struct networks trusted;
    if (strcmp(config->proxy_protocol, "on") != 0 || !networks_parse(&trusted, config->trusted_proxies) ||
        getsockname(fd, (struct sockaddr *)&own, &size) != 0)
        return false;
    const struct ip ip = ip_of_socket((const struct sockaddr *)&own);
    return networks_contain(&trusted, &ip);
}

static bool say(int fd, const char *text)
{
    return send(fd, text, strlen(text), MSG_NOSIGNAL) == (ssize_t)strlen(text);
}

static bool ask(const struct config *config, int fd)
{
    static const char REQUEST[] = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    static const char GOOD[] = "HTTP/1.1 200 ";
    char answer[sizeof GOOD] = "";
    size_t got = 0;
    if (is_proxy_asked_for(config, fd) && !say(fd, "PROXY UNKNOWN\r\n")) return false;
    if (!say(fd, REQUEST)) return false;
    while (got < sizeof GOOD - 1) {
        ssize_t count = recv(fd, answer + got, sizeof GOOD - 1 - got, 0);
        if (count <= 0) return false;
        got += (size_t)count;
    }
    return strcmp(answer, GOOD) == 0;
}

bool health_check(const struct config *config)
{
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM, .ai_flags = AI_NUMERICHOST | AI_NUMERICSERV};
    struct addrinfo *address = NULL;
    char port[16];
    snprintf(port, sizeof port, "%u", (unsigned)config->port);
    if (getaddrinfo(config->address, port, &hints, &address) != 0) return false;
    struct timeval timeout = {.tv_sec = TIMEOUT_S};
    /* As destinations, 0.0.0.0 and :: are this machine. */
    int fd = socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    bool well = fd >= 0 && setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout) == 0 &&
                setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout) == 0 &&
                connect(fd, address->ai_addr, address->ai_addrlen) == 0 && ask(config, fd);
    if (fd >= 0) close(fd);
    freeaddrinfo(address);
    return well;
}
