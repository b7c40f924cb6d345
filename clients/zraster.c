/* zraster.c - the command-line client: a file in, a picture out.
 *
 * Exit status: 0 the picture is there; 1 the server refused or could not be
 * reached, or a file could not be read or written; 2 the command line is wrong.
 */
#include <curl/curl.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "bytes.h"
#include "report.h"
#include "version.h"

#define DEFAULT_SERVER "http://127.0.0.1:8080"
enum { CONNECT_SECONDS = 10, TOTAL_SECONDS = 300 };

struct options {
    const char *file, *out, *server, *type;
    const char *channel, *encoding, *scale, *preset, *shading, *compress;
    char width[12], height[12];
};

static const char USAGE[] = "usage: zraster render FILE [options]\n"
                            "\n"
                            "Sends a scene (.json) or a mesh (.obj, .stl) to zrasterd and saves what comes back.\n"
                            "FILE may be - for standard input, with --type.\n"
                            "\n"
                            "  -o FILE            where to save; - is standard output\n"
                            "                     (default: FILE's name with the ending of what came back)\n"
                            "  --channel NAME     color, depth, windowDepth, faceId or info\n"
                            "  --encoding NAME    png, npy, png16 or json; each channel has a default\n"
                            "  --scale UNITS      scene units a step of a 16-bit depth picture\n"
                            "  --preset NAME      front, back, left, right, top, bottom or isometric (meshes only)\n"
                            "  --shading NAME     unlit, flat or gouraud (meshes only)\n"
                            "  --size WxH         pixels, such as 800x600 (meshes only)\n"
                            "  --compress HOW     fast (default) or small: PNGs of fewer bytes that take longer\n"
                            "  --type TYPE        json, obj or stl, where the file's ending does not say\n"
                            "  --server URL       default: $ZRASTER_SERVER, else " DEFAULT_SERVER "\n"
                            "  --help, --version\n";

/* ---- command line ---- */

static bool parse_size(const char *text, struct options *options)
{
    unsigned width, height;
    char rest;
    if (sscanf(text, "%7ux%7u%c", &width, &height, &rest) != 2) return false;
    snprintf(options->width, sizeof options->width, "%u", width);
    snprintf(options->height, sizeof options->height, "%u", height);
    return true;
}

static int usage_error(const char *what, const char *which)
{
    fprintf(stderr, "zraster: %s%s%s\nzraster --help shows how it is used.\n", what, *which ? ": " : "", which);
    return 2;
}

/* The place in `options` that a flag with a value sets, or NULL. */
static const char **slot_of(struct options *o, const char *flag)
{
    const struct {
        const char *flag;
        const char **slot;
    } table[] = {{"-o", &o->out},          {"--channel", &o->channel}, {"--encoding", &o->encoding},
                 {"--scale", &o->scale},   {"--preset", &o->preset},   {"--shading", &o->shading},
                 {"--server", &o->server}, {"--type", &o->type},       {"--compress", &o->compress}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strcmp(flag, table[i].flag) == 0) return table[i].slot;
    return NULL;
}

/* 0, or the exit status for a wrong command line. `arguments` begin behind "render". */
static int parse_arguments(int count, char **arguments, struct options *options)
{
    for (int i = 0; i < count; i++) {
        const char *flag = arguments[i], **slot = slot_of(options, flag);
        bool size = strcmp(flag, "--size") == 0;
        if (!slot && !size) {
            if (flag[0] == '-' && flag[1] != '\0') return usage_error("unknown option", flag);
            if (options->file) return usage_error("one file at a time; there is a second one", flag);
            options->file = flag;
            continue;
        }
        if (i + 1 == count) return usage_error("a value is missing behind", flag);
        const char *value = arguments[++i];
        if (slot) *slot = value;
        if (size && !parse_size(value, options))
            return usage_error("--size takes WIDTHxHEIGHT, such as 800x600, not", value);
    }
    return options->file ? 0 : usage_error("which file? usage: zraster render FILE", "");
}

/* NULL where the type is not known. */
static const char *content_type(const struct options *options)
{
    static const char *const types[][2] = {{"json", "application/json"}, {"obj", "model/obj"}, {"stl", "model/stl"}};
    const char *dot = strrchr(options->file, '.');
    const char *type = options->type ? options->type : dot ? dot + 1 : "";
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcasecmp(type, types[i][0]) == 0) return types[i][1];
    return NULL;
}

/* ---- the request ---- */

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

static CURLU *make_url(const struct options *o)
{
    CURLU *url = curl_url();
    bool ok = url && curl_url_set(url, CURLUPART_URL, o->server, CURLU_DEFAULT_SCHEME) == CURLUE_OK &&
              curl_url_set(url, CURLUPART_PATH, "/v1/render", 0) == CURLUE_OK &&
              add_parameter(url, "channel", o->channel) && add_parameter(url, "encoding", o->encoding) &&
              add_parameter(url, "scale", o->scale) && add_parameter(url, "preset", o->preset) &&
              add_parameter(url, "shading", o->shading) && add_parameter(url, "width", o->width) &&
              add_parameter(url, "height", o->height) && add_parameter(url, "compress", o->compress);
    if (ok) return url;
    curl_url_cleanup(url);
    return NULL;
}

static size_t receive(char *data, size_t size, size_t count, void *answer)
{
    return bytes_add(answer, data, size * count) ? size * count : 0;
}

/* Shows the server's warnings as they arrive. */
static size_t receive_header(char *line, size_t size, size_t count, void *unused)
{
    static const char name[] = "zraster-warnings:";
    (void)unused;
    if (size * count > sizeof name && strncasecmp(line, name, sizeof name - 1) == 0)
        fprintf(stderr, "warning:%.*s", (int)(size * count - (sizeof name - 1)), line + sizeof name - 1);
    return size * count;
}

/* True where an answer came, of whatever status. */
static bool post(const struct options *options, const char *type, const struct bytes *body, struct bytes *answer,
                 long *status, char answer_type[64])
{
    char header[64], why[CURL_ERROR_SIZE] = "";
    snprintf(header, sizeof header, "Content-Type: %s", type);
    struct curl_slist *headers = curl_slist_append(NULL, header);
    CURLU *url = make_url(options);
    CURL *curl = curl_easy_init();
    CURLcode code = CURLE_FAILED_INIT;
    if (!url) fprintf(stderr, "zraster: not a URL: %s\n", options->server);
    if (url && curl && headers) {
        curl_easy_setopt(curl, CURLOPT_CURLU, url);
        curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers);
        curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body->data ? body->data : "");
        curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, (curl_off_t)body->size);
        curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, receive);
        curl_easy_setopt(curl, CURLOPT_WRITEDATA, answer);
        curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, receive_header);
        curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, (long)CONNECT_SECONDS);
        curl_easy_setopt(curl, CURLOPT_TIMEOUT, (long)TOTAL_SECONDS);
        curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
        curl_easy_setopt(curl, CURLOPT_USERAGENT, "zraster");
        curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, why);
        code = curl_easy_perform(curl);
        curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, status);
        const char *got = NULL;
        curl_easy_getinfo(curl, CURLINFO_CONTENT_TYPE, &got);
        snprintf(answer_type, 64, "%s", got ? got : "");
    }
    if (url && code != CURLE_OK)
        fprintf(stderr, "zraster: %s: %s\n", options->server, *why ? why : curl_easy_strerror(code));
    curl_easy_cleanup(curl);
    curl_url_cleanup(url);
    curl_slist_free_all(headers);
    return code == CURLE_OK;
}

/* ---- the answer ---- */

/* FILE's name without folder and ending, and the ending of what came back. */
static void default_name(const char *file, const char *type, char *out, size_t size)
{
    static const char *const endings[][2] = {
        {"image/png", "png"}, {"application/x-npy", "npy"}, {"application/json", "json"}, {"application/zip", "zip"}};
    const char *slash = strrchr(file, '/'), *base = slash ? slash + 1 : file, *dot = strrchr(base, '.');
    const char *ending = "bin";
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (strcmp(type, endings[i][0]) == 0) ending = endings[i][1];
    if (strcmp(file, "-") == 0) base = "out", dot = NULL;
    int length = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    snprintf(out, size, "%.*s.%s", length, base, ending);
    if (strcmp(out, file) == 0) snprintf(out, size, "%.*s.out.%s", length, base, ending); /* never over the input */
}

static int render(const struct options *options)
{
    const char *type = content_type(options);
    if (!type) return usage_error("json, obj or stl? --type says it where the file's ending does not", options->file);
    struct bytes body = {NULL, 0, 0}, answer = {NULL, 0, 0};
    long status = 0;
    char answer_type[64] = "", name[4096];
    int result = 1;
    if (!bytes_read(&body, options->file)) {
        fprintf(stderr, "zraster: cannot read %s: %s\n", options->file, strerror(errno));
    } else if (post(options, type, &body, &answer, &status, answer_type)) {
        default_name(options->file, answer_type, name, sizeof name);
        if (options->out) snprintf(name, sizeof name, "%s", options->out);
        if (status == 200 && strcmp(name, "-") != 0 && bytes_same_file(options->file, name))
            fprintf(stderr, "zraster: %s would overwrite its own input; -o names another file\n", name);
        else if (status != 200)
            report_problem(stderr, options->file, status, &answer);
        else if (!bytes_write(&answer, name))
            fprintf(stderr, "zraster: cannot write %s: %s\n", name, strerror(errno));
        else
            result = 0;
        if (result == 0 && strcmp(name, "-") != 0) printf("%s\n", name);
    }
    bytes_free(&body);
    bytes_free(&answer);
    return result;
}

int main(int count, char **arguments)
{
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) {
            fputs(USAGE, stdout);
            return 0;
        }
        if (strcmp(arguments[i], "--version") == 0) {
            puts("zraster " ZR_VERSION);
            return 0;
        }
    }
    if (count < 2 || strcmp(arguments[1], "render") != 0)
        return usage_error(count < 2 ? "what shall it do? usage: zraster render FILE" : "unknown command",
                           count < 2 ? "" : arguments[1]);
    const char *server = getenv("ZRASTER_SERVER");
    struct options options = {.server = server && *server ? server : DEFAULT_SERVER};
    int wrong = parse_arguments(count - 2, arguments + 2, &options);
    if (wrong) return wrong;
    curl_global_init(CURL_GLOBAL_DEFAULT);
    int result = render(&options);
    curl_global_cleanup();
    return result;
}
