#include "post.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "curl_rows.h"
#include "interruption.h"
#include "report.h"

enum { CONNECT_SECONDS = 10, TOTAL_SECONDS = 300, HEADER_SIZE = TOKEN_SIZE + 64 };

#define PATH "/v1/render"

static struct curl_functions curl;

int post_open(void)
{
    static const char *const names[] = {"libcurl-gnutls.so.4", "libcurl.so.4"};
    void *library = NULL;
    for (size_t i = 0; !library && i < sizeof names / sizeof *names; i++)
        library = dlopen(names[i], RTLD_NOW);
    bool ok = library != NULL;
#define CURL_LOAD(name)                                                                                                \
    if (ok) ok = (*(void **)(void *)&curl.name = dlsym(library, "curl_" #name)) != NULL;
    CURL_ROWS(CURL_LOAD)
#undef CURL_LOAD
    if (ok && curl.global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK) return 0;
    fputs("zraster: --server needs libcurl; as root: apt-get install libcurl3-gnutls; or leave out --server to render "
          "here\n",
          stderr);
    return STATUS_FAILED;
}

void post_close(void)
{
    if (curl.global_cleanup) curl.global_cleanup();
}

/* ---- address ---- */

/* Sets the address of the request. HOST:PORT means http. PATH is appended to the server's own path, if any. */
static bool set_address(CURLU *url, const char *server, const char *query)
{
    char *whole = NULL, *path = NULL, *longer = NULL;
    if (asprintf(&whole, "%s%s", strstr(server, "://") ? "" : "http://", server) < 0) return false;
    bool ok = curl.url_set(url, CURLUPART_URL, whole, 0) == CURLUE_OK &&
              curl.url_set(url, CURLUPART_QUERY, *query ? query : NULL, 0) == CURLUE_OK &&
              curl.url_set(url, CURLUPART_FRAGMENT, NULL, 0) == CURLUE_OK &&
              curl.url_get(url, CURLUPART_PATH, &path, 0) == CURLUE_OK;
    for (size_t end = ok ? strlen(path) : 0; end > 0 && path[end - 1] == '/'; end--)
        path[end - 1] = '\0';
    ok = ok && asprintf(&longer, "%s" PATH, path) >= 0 && curl.url_set(url, CURLUPART_PATH, longer, 0) == CURLUE_OK;
    if (path) curl.free(path);
    free(longer);
    free(whole);
    return ok;
}

/* ---- answer ---- */

static size_t receive(char *data, size_t size, size_t count, void *body)
{
    return bytes_add(body, data, size * count) ? size * count : 0;
}

/* Returns the value of a header line, or NULL for another header. *length: without the line's end. */
static const char *value_of(const char *line, size_t size, const char *name, int *length)
{
    const size_t begin = strlen(name);
    if (size <= begin || strncasecmp(line, name, begin) != 0) return NULL;
    size_t first = begin, end = size;
    while (first < end && line[first] == ' ')
        first++;
    while (end > first && (line[end - 1] == '\r' || line[end - 1] == '\n'))
        end--;
    *length = (int)(end - first);
    return line + first;
}

static size_t receive_header(char *line, size_t size, size_t count, void *context)
{
    struct answer *answer = context;
    int length;
    const char *value = value_of(line, size * count, "zraster-warnings:", &length);
    if (value) bytes_print(&answer->warnings, "%.*s\n", length, value);
    value = value_of(line, size * count, "zraster-look:", &length);
    if (value) snprintf(answer->look, sizeof answer->look, "%.*s", length, value);
    return size * count;
}

/* Returns true to stop a transfer. */
static int stops(void *context, curl_off_t a, curl_off_t b, curl_off_t c, curl_off_t d)
{
    (void)context, (void)a, (void)b, (void)c, (void)d;
    return interrupted();
}

static void take_reply(CURL *handle, const struct token *token, struct answer *answer)
{
    const char *type = NULL;
    curl_off_t seconds = 0;
    long status = 0;
    curl.easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
    curl.easy_getinfo(handle, CURLINFO_CONTENT_TYPE, &type);
    curl.easy_getinfo(handle, CURLINFO_RETRY_AFTER, &seconds);
    snprintf(answer->type, sizeof answer->type, "%.*s", (int)strcspn(type ? type : "", "; "), type ? type : "");
    answer->file = (struct zraster_bytes){bytes_text(&answer->received), answer->received.size, answer->type};
    if (status == 200) return;
    report_problem(&answer->faults, status, &answer->received);
    if (status == 401 && *token->text)
        bytes_print(&answer->faults, "\nThe server rejected the token of %s.", token->from);
    else if (status == 401)
        bytes_print(&answer->faults, "\n--token-file FILE, or the variable ZRASTER_TOKEN, gives the token.");
    if (seconds > 0) bytes_print(&answer->faults, "\nTry again in %ld s.", (long)seconds);
    answer_refuse(answer);
}

/* ---- request ---- */

static struct curl_slist *make_headers(const char *content_type, const struct token *token)
{
    char type[HEADER_SIZE], authorization[HEADER_SIZE];
    snprintf(type, sizeof type, "Content-Type: %s", content_type);
    snprintf(authorization, sizeof authorization, "Authorization: Bearer %s", token->text);
    struct curl_slist *headers = curl.slist_append(NULL, type);
    if (!headers || !*token->text) return headers;
    struct curl_slist *both = curl.slist_append(headers, authorization);
    if (!both) curl.slist_free_all(headers);
    return both;
}

static curl_mimepart *add_part(curl_mime *form, const char *name, const char *type, const struct bytes *bytes)
{
    curl_mimepart *part = curl.mime_addpart(form);
    const bool ok = part && curl.mime_name(part, name) == CURLE_OK &&
                    curl.mime_data(part, bytes_text(bytes), bytes->size) == CURLE_OK &&
                    curl.mime_type(part, type) == CURLE_OK;
    return ok ? part : NULL;
}

/* Asks for no warning if the scene does not use the part. */
static bool make_optional(curl_mimepart *part)
{
    struct curl_slist *headers = curl.slist_append(NULL, "Zraster-Use: optional");
    if (!headers) return false;
    return curl.mime_headers(part, headers, 1) == CURLE_OK;
}

/* Makes a form of the scene and its parts. */
static curl_mime *make_form(CURL *handle, const struct input *input)
{
    curl_mime *form = curl.mime_init(handle);
    bool ok = form && add_part(form, "scene", input->type, &input->body);
    for (size_t i = 0; ok && i < input->part_count; i++) {
        const struct input_part *given = &input->parts[i];
        curl_mimepart *part = add_part(form, given->name, "application/octet-stream", &given->bytes);
        ok = part && (!given->is_neighbour || make_optional(part));
    }
    if (!ok && form) curl.mime_free(form);
    return ok ? form : NULL;
}

static void set_options(CURL *handle, CURLU *url, char *why, struct answer *answer)
{
    curl.easy_setopt(handle, CURLOPT_CURLU, url);
    curl.easy_setopt(handle, CURLOPT_WRITEFUNCTION, receive);
    curl.easy_setopt(handle, CURLOPT_WRITEDATA, &answer->received);
    curl.easy_setopt(handle, CURLOPT_HEADERFUNCTION, receive_header);
    curl.easy_setopt(handle, CURLOPT_HEADERDATA, answer);
    curl.easy_setopt(handle, CURLOPT_CONNECTTIMEOUT, (long)CONNECT_SECONDS);
    curl.easy_setopt(handle, CURLOPT_TIMEOUT, (long)TOTAL_SECONDS);
    curl.easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
    curl.easy_setopt(handle, CURLOPT_NOPROGRESS, 0L);
    curl.easy_setopt(handle, CURLOPT_XFERINFOFUNCTION, stops);
    curl.easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
    curl.easy_setopt(handle, CURLOPT_USERAGENT, "zraster");
    curl.easy_setopt(handle, CURLOPT_ERRORBUFFER, why);
}

static CURLcode send_to(CURLU *url, CURL *handle, const struct token *token, const struct input *input, char *why,
                        struct answer *answer)
{
    curl_mime *form = input->part_count ? make_form(handle, input) : NULL;
    struct curl_slist *headers = make_headers(form ? "multipart/form-data" : input->type, token);
    CURLcode code = CURLE_OUT_OF_MEMORY;
    set_options(handle, url, why, answer);
    if (form)
        curl.easy_setopt(handle, CURLOPT_MIMEPOST, form);
    else {
        curl.easy_setopt(handle, CURLOPT_POSTFIELDS, bytes_text(&input->body));
        curl.easy_setopt(handle, CURLOPT_POSTFIELDSIZE_LARGE, (curl_off_t)input->body.size);
    }
    curl.easy_setopt(handle, CURLOPT_HTTPHEADER, headers);
    if (headers && (form || input->part_count == 0)) code = curl.easy_perform(handle);
    if (code == CURLE_OK) take_reply(handle, token, answer);
    curl.slist_free_all(headers);
    if (form) curl.mime_free(form);
    return code;
}

static void explain(const char *server, CURLcode code, const char *why, struct bytes *faults)
{
    const char *at = strrchr(server, '@'); /* text before it may be a password */
    const char *shown = at ? at + 1 : server;
    if (code == CURLE_COULDNT_CONNECT || code == CURLE_COULDNT_RESOLVE_HOST)
        bytes_print(faults, "nothing answers at %s: start zrasterd there, or leave out --server to render here", shown);
    else
        bytes_print(faults, "%s: %s", shown, *why ? why : curl.easy_strerror(code));
}

void post(const char *server, const struct token *token, const struct input *input, const char *query,
          struct answer *answer)
{
    char why[CURL_ERROR_SIZE] = "";
    CURLU *url = curl.url();
    CURL *handle = curl.easy_init();
    CURLcode code = CURLE_FAILED_INIT;
    if (url && !set_address(url, server, query))
        snprintf(why, sizeof why, "not an address; give HOST:PORT or http://HOST:PORT");
    else if (url && handle)
        code = send_to(url, handle, token, input, why, answer);
    if (code != CURLE_OK) {
        answer->status = interrupted() ? STATUS_INTERRUPTED : STATUS_FAILED;
        explain(server, code, why, &answer->faults);
    }
    curl.easy_cleanup(handle);
    curl.url_cleanup(url);
}
