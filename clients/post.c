#include "post.h"

#include <curl/curl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { CONNECT_SECONDS = 10, TOTAL_SECONDS = 300, HEADER_SIZE = TOKEN_SIZE + 64 };

#define PATH "/v1/render"

static char *joined(const char *a, const char *b)
{
    const size_t size = strlen(a) + strlen(b) + 1;
    char *both = malloc(size);
    if (both) snprintf(both, size, "%s%s", a, b);
    return both;
}

/* ---- address ---- */

static bool add_parameter(CURLU *url, const char *name, const char *value)
{
    if (!value || !*value) return true;
    char *escaped = curl_easy_escape(NULL, value, 0);
    if (!escaped) return false;
    size_t size = strlen(name) + strlen(escaped) + 2;
    char *pair = malloc(size);
    if (pair) snprintf(pair, size, "%s=%s", name, escaped);
    bool ok = pair && curl_url_set(url, CURLUPART_QUERY, pair, CURLU_APPENDQUERY) == CURLUE_OK;
    free(pair);
    curl_free(escaped);
    return ok;
}

/* Sets the server's address; HOST:PORT means http. */
static bool set_server(CURLU *url, const char *server)
{
    char *whole = joined(strstr(server, "://") ? "" : "http://", server);
    bool ok = whole && curl_url_set(url, CURLUPART_URL, whole, 0) == CURLUE_OK;
    free(whole);
    return ok && curl_url_set(url, CURLUPART_QUERY, NULL, 0) == CURLUE_OK &&
           curl_url_set(url, CURLUPART_FRAGMENT, NULL, 0) == CURLUE_OK;
}

/* Appends to the server's own path, such as https://example.org/zraster. */
static bool add_path(CURLU *url)
{
    char *path = NULL;
    if (curl_url_get(url, CURLUPART_PATH, &path, 0) != CURLUE_OK) return false;
    for (size_t end = strlen(path); end > 0 && path[end - 1] == '/'; end--)
        path[end - 1] = '\0';
    char *whole = joined(path, PATH);
    bool ok = whole && curl_url_set(url, CURLUPART_PATH, whole, 0) == CURLUE_OK;
    free(whole);
    curl_free(path);
    return ok;
}

static CURLU *make_url(const struct options *o)
{
    CURLU *url = curl_url();
    bool ok = url && set_server(url, o->server) && add_path(url);
    for (size_t i = 0; i < OPTIONS_PARAMETERS && ok; i++)
        ok = add_parameter(url, options_parameters[i].name, o->parameters[i]);
    if (ok) return url;
    curl_url_cleanup(url);
    return NULL;
}

/* ---- answer ---- */

static size_t receive(char *data, size_t size, size_t count, void *body)
{
    return bytes_add(body, data, size * count) ? size * count : 0;
}

static size_t receive_header(char *line, size_t size, size_t count, void *unused)
{
    static const char name[] = "zraster-warnings:";
    (void)unused;
    if (size * count > sizeof name && strncasecmp(line, name, sizeof name - 1) == 0)
        fprintf(stderr, "warning:%.*s", (int)(size * count - (sizeof name - 1)), line + sizeof name - 1);
    return size * count;
}

static void read_reply(CURL *curl, struct reply *reply)
{
    const char *type = NULL;
    curl_off_t seconds = 0;
    curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &reply->status);
    curl_easy_getinfo(curl, CURLINFO_CONTENT_TYPE, &type);
    curl_easy_getinfo(curl, CURLINFO_RETRY_AFTER, &seconds);
    reply->retry_seconds = (long)seconds;
    snprintf(reply->type, sizeof reply->type, "%s", type ? type : "");
    reply->type[strcspn(reply->type, "; ")] = '\0';
}

static struct curl_slist *make_headers(const struct options *options, const struct token *token)
{
    char type[HEADER_SIZE], authorization[HEADER_SIZE];
    snprintf(type, sizeof type, "Content-Type: %s", options->content_type);
    snprintf(authorization, sizeof authorization, "Authorization: Bearer %s", token->text);
    struct curl_slist *headers = curl_slist_append(NULL, type);
    if (!headers || !*token->text) return headers;
    struct curl_slist *both = curl_slist_append(headers, authorization);
    if (!both) curl_slist_free_all(headers);
    return both;
}

static void explain(const struct options *options, CURLcode code, const char *why)
{
    const char *at = strrchr(options->server, '@'); /* text before it may be a password */
    fprintf(stderr, "zraster: %s: %s\n", at ? at + 1 : options->server, *why ? why : curl_easy_strerror(code));
    if (code == CURLE_COULDNT_CONNECT || code == CURLE_COULDNT_RESOLVE_HOST)
        fprintf(stderr,
                "Does zrasterd run there? --server HOST:PORT, or the variable ZRASTER_SERVER, names another.\n");
}

bool post(const struct options *options, const struct token *token, const struct bytes *body, struct reply *reply)
{
    char why[CURL_ERROR_SIZE] = "";
    struct curl_slist *headers = make_headers(options, token);
    CURLU *url = make_url(options);
    CURL *curl = curl_easy_init();
    CURLcode code = CURLE_FAILED_INIT;
    if (!url) snprintf(why, sizeof why, "not an address; HOST:PORT and http://HOST:PORT are");
    if (url && curl && headers) {
        curl_easy_setopt(curl, CURLOPT_CURLU, url);
        curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers);
        curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body->data ? body->data : "");
        curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, (curl_off_t)body->size);
        curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, receive);
        curl_easy_setopt(curl, CURLOPT_WRITEDATA, &reply->body);
        curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, receive_header);
        curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, (long)CONNECT_SECONDS);
        curl_easy_setopt(curl, CURLOPT_TIMEOUT, (long)TOTAL_SECONDS);
        curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
        curl_easy_setopt(curl, CURLOPT_USERAGENT, "zraster");
        curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, why);
        code = curl_easy_perform(curl);
        if (code == CURLE_OK) read_reply(curl, reply);
    }
    if (code != CURLE_OK) explain(options, code, why);
    curl_easy_cleanup(curl);
    curl_url_cleanup(url);
    curl_slist_free_all(headers);
    return code == CURLE_OK;
}
