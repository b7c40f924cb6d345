/* bare_http BODY HEADER...: libmicrohttpd and nothing else, with the same answer to everyone; a HEADER is NAME=VALUE.
 *
 * One thread, epoll. Writes its port, a line, and ends with its standard input.
 */
#include <arpa/inet.h>
#include <microhttpd.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static enum MHD_Result answer(void *context, struct MHD_Connection *connection, const char *target, const char *method,
                              const char *version, const char *body, size_t *size, void **state)
{
    static int seen;
    (void)target, (void)method, (void)version, (void)body, (void)size;
    if (!*state) { /* an answer to headers alone would close the connection */
        *state = &seen;
        return MHD_YES;
    }
    return MHD_queue_response(connection, MHD_HTTP_OK, context);
}

int main(int count, char **arguments)
{
    if (count < 2) return 2;
    struct MHD_Response *response =
        MHD_create_response_from_buffer(strlen(arguments[1]), arguments[1], MHD_RESPMEM_PERSISTENT);
    for (int i = 2; i < count; i++) {
        char *value = strchr(arguments[i], '=');
        if (!value) return 2;
        *value = '\0';
        MHD_add_response_header(response, arguments[i], value + 1);
    }
    struct sockaddr_in address = {.sin_family = AF_INET};
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    struct MHD_Daemon *daemon = MHD_start_daemon(MHD_USE_EPOLL_INTERNAL_THREAD, 0, NULL, NULL, answer, response,
                                                 MHD_OPTION_SOCK_ADDR, &address, MHD_OPTION_END);
    const union MHD_DaemonInfo *info = daemon ? MHD_get_daemon_info(daemon, MHD_DAEMON_INFO_BIND_PORT) : NULL;
    if (!info) return 1;
    printf("%u\n", (unsigned)info->port);
    fflush(stdout);
    char byte;
    while (read(STDIN_FILENO, &byte, 1) > 0) {
    }
    MHD_stop_daemon(daemon);
    MHD_destroy_response(response);
    return 0;
}
