#include "client.h"

#include <arpa/inet.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <curl/curl.h>

#include "support/cmocka_all.h"

enum { TIMEOUT_S = 120 };

struct text {
    char *bytes;
    size_t size;
};

static size_t append(char *bytes, size_t size, size_t count, void *context)
{
    struct text *text = context;
    char *grown = realloc(text->bytes, text->size + size * count + 1);
    if (!grown) return 0;
    text->bytes = grown;
    memcpy(grown + text->size, bytes, size * count);
    text->size += size * count;
    grown[text->size] = '\0';
    return size * count;
}

static CURL *open_request(const struct daemon *daemon, const char *target)
{
    char url[40000];
    CURL *curl = curl_easy_init();
    snprintf(url, sizeof url, "http://127.0.0.1:%u%s", daemon->port, target);
    curl_easy_setopt(curl, CURLOPT_URL, url);
    curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl, CURLOPT_TIMEOUT, (long)TIMEOUT_S);
    curl_easy_setopt(curl, CURLOPT_PROXY, "");
    if (daemon->client > 0) {
        char address[32];
        snprintf(address, sizeof address, "host!127.0.0.%u", daemon->client);
        curl_easy_setopt(curl, CURLOPT_INTERFACE, address);
    }
    return curl;
}

static struct reply finish_request(CURL *curl)
{
    struct text headers = {0}, body = {0};
    struct reply reply = {0};
    curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, append);
    curl_easy_setopt(curl, CURLOPT_HEADERDATA, &headers);
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, append);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &body);
    CURLcode code = curl_easy_perform(curl);
    /* A refused upload may break off while curl still sends; the answer counts. */
    if (code == CURLE_OK || code == CURLE_SEND_ERROR || code == CURLE_RECV_ERROR)
        curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &reply.status);
    append("", 1, 0, &headers);
    append("", 1, 0, &body);
    reply.headers = headers.bytes;
    reply.body = body.bytes;
    reply.size = body.size;
    curl_easy_cleanup(curl);
    return reply;
}

struct reply client_send(const struct daemon *daemon, const char *method, const char *target,
                         const char *const *headers, const void *body, size_t size)
{
    CURL *curl = open_request(daemon, target);
    struct curl_slist *list = NULL;
    for (size_t i = 0; headers && headers[i]; i++)
        list = curl_slist_append(list, headers[i]);
    curl_easy_setopt(curl, CURLOPT_CUSTOMREQUEST, method);
    if (strcmp(method, "HEAD") == 0) curl_easy_setopt(curl, CURLOPT_NOBODY, 1L);
    if (body) {
        curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, (curl_off_t)size);
        curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body);
    }
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, list);
    struct reply reply = finish_request(curl);
    curl_slist_free_all(list);
    return reply;
}

struct reply client_render(const struct daemon *daemon, const char *scene)
{
    return client_send(daemon, "POST", "/v1/render", (const char *const[]){JSON_TYPE, NULL}, scene, strlen(scene));
}

struct reply client_get(const struct daemon *daemon, const char *target)
{
    return client_send(daemon, "GET", target, NULL, NULL, 0);
}

static size_t give_bytes(char *buffer, size_t size, size_t count, void *context)
{
    size_t *left = context, given = size * count < *left ? size * count : *left;
    memset(buffer, 'x', given);
    *left -= given;
    return given;
}

struct reply client_send_chunked(const struct daemon *daemon, const char *target, size_t size)
{
    CURL *curl = open_request(daemon, target);
    struct curl_slist *list = curl_slist_append(NULL, JSON_TYPE);
    list = curl_slist_append(list, "Transfer-Encoding: chunked");
    curl_easy_setopt(curl, CURLOPT_POST, 1L);
    curl_easy_setopt(curl, CURLOPT_READFUNCTION, give_bytes);
    curl_easy_setopt(curl, CURLOPT_READDATA, &size);
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, list);
    struct reply reply = finish_request(curl);
    curl_slist_free_all(list);
    return reply;
}

int clients_setup(void **state)
{
    (void)state;
    return curl_global_init(CURL_GLOBAL_ALL) == CURLE_OK ? 0 : -1;
}

int clients_teardown(void **state)
{
    (void)state;
    curl_global_cleanup();
    return 0;
}

void reply_free(struct reply *reply)
{
    free(reply->headers);
    free(reply->body);
    *reply = (struct reply){0};
}

const char *reply_header(const struct reply *reply, const char *name)
{
    static _Thread_local char value[4096];
    size_t length = strlen(name);
    value[0] = '\0';
    for (const char *line = reply->headers; line && *line; line = strchr(line, '\n'), line = line ? line + 1 : NULL)
        if (strncasecmp(line, name, length) == 0 && line[length] == ':') {
            const char *start = line + length + 1 + strspn(line + length + 1, " ");
            snprintf(value, sizeof value, "%.*s", (int)strcspn(start, "\r\n"), start);
        }
    return value;
}

bool reply_is_same(const struct reply *a, const struct reply *b)
{
    return a->size == b->size && memcmp(a->body, b->body, a->size) == 0;
}

long client_get_status(const struct daemon *daemon, const char *target)
{
    struct reply reply = client_get(daemon, target);
    long status = reply.status;
    reply_free(&reply);
    return status;
}

long client_render_status(const struct daemon *daemon, const char *scene)
{
    struct reply reply = client_render(daemon, scene);
    long status = reply.status;
    reply_free(&reply);
    return status;
}

int client_connect(const struct daemon *daemon)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)daemon->port)};
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    struct sockaddr_in own = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(0x7F000000 | (daemon->client % 256))};
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (daemon->client > 0 && bind(fd, (struct sockaddr *)&own, sizeof own) != 0) perror("bind");
    if (connect(fd, (struct sockaddr *)&address, sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

char *client_read(int fd, const char *until, int timeout_ms)
{
    struct text text = {0};
    char buffer[65536];
    struct pollfd polled = {.fd = fd, .events = POLLIN};
    append("", 1, 0, &text);
    while (!(until && strstr(text.bytes, until)) && poll(&polled, 1, timeout_ms) > 0) {
        ssize_t count = recv(fd, buffer, sizeof buffer, 0);
        if (count <= 0) break;
        append(buffer, 1, (size_t)count, &text);
    }
    return text.bytes;
}

bool client_write(int fd, const char *bytes, size_t size)
{
    for (size_t sent = 0; sent < size;) {
        ssize_t count = send(fd, bytes + sent, size - sent, MSG_NOSIGNAL);
        if (count <= 0) return false;
        sent += (size_t)count;
    }
    return true;
}

int client_begin_render(const struct daemon *daemon, const char *scene)
{
    static unsigned number;
    char head[256];
    int fd = client_connect(daemon);
    assert_true(fd >= 0);
    int length =
        snprintf(head, sizeof head,
                 "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE ";number=%u\r\nContent-Length: %zu\r\n\r\n",
                 number++, strlen(scene));
    assert_true(client_write(fd, head, (size_t)length));
    assert_true(client_write(fd, scene, strlen(scene)));
    return fd;
}

char *client_raw(const struct daemon *daemon, const char *bytes, size_t size, int timeout_ms)
{
    int fd = client_connect(daemon);
    assert_true(fd >= 0);
    client_write(fd, bytes, size); /* it may answer before it has read all, and close */
    char *text = client_read(fd, NULL, timeout_ms);
    close(fd);
    return text;
}

void client_wait_for_metric(const struct daemon *daemon, const char *before, const char *line)
{
    char request[256], whole[256];
    const double begun = client_seconds();
    const int size =
        snprintf(request, sizeof request, "%sGET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", before);
    snprintf(whole, sizeof whole, "\n%s\n", line);
    for (bool found = false; !found; usleep(5000)) {
        char *text = client_raw(daemon, request, (size_t)size, 5000);
        found = strstr(text, whole);
        free(text);
        if (!found && client_seconds() - begun > 10) fail_msg("no metric is '%s'", line);
    }
}

int raw_status(const char *text)
{
    int status = 0;
    return sscanf(text, "HTTP/1.1 %d", &status) == 1 ? status : 0;
}

int raw_count(const char *text)
{
    int count = 0;
    for (const char *p = text; (p = strstr(p, "HTTP/1.1 ")); p++)
        count++;
    return count;
}

char *scene_slow(const char *algorithm, int side, int count)
{
    static const char HEAD[] =
        "{\"algorithm\":\"%s\",\"window\":{\"width\":%d,\"height\":%d},\"shading\":\"unlit\",\"view\":{\"preset\":"
        "\"front\"},\"outputs\":[{\"channel\":\"info\"}],\"polygons\":[";
    enum { POLYGON_SIZE = 160 };
    char *scene = malloc(sizeof HEAD + strlen(algorithm) + 2 * 11 + (size_t)count * POLYGON_SIZE + 3);
    assert_non_null(scene);
    size_t used = (size_t)sprintf(scene, HEAD, algorithm, side, side);
    /* Later ones are nearer, so each covers the one before. */
    for (int i = 0; i < count; i++)
        used += (size_t)sprintf(scene + used, "%s{\"vertices\":[[-1,-1,%d],[1,-1,%d],[1,1,%d],[-1,1,%d]]}",
                                i ? "," : "", i, i, i, i);
    sprintf(scene + used, "]}");
    return scene;
}

double client_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
