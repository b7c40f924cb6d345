#include "site.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cjson/cJSON.h>
#include <zlib.h>

#include "engine.h"
#include "problem.h"
#include "routes.h"
#include "scene/looks.h"
#include "text.h"

/* ---- files ---- */

/* True if Accept-Encoding names gzip, or anything, with a weight above 0 (RFC 9110, 12.5.3). */
static bool takes_gzip(const char *accepted)
{
    for (const char *p = accepted; p && *p; p += strcspn(p, ","), p += *p == ',') {
        p += strspn(p, " \t");
        const size_t length = strcspn(p, " \t;,");
        if (!(length == 4 && strncasecmp(p, "gzip", 4) == 0) && !(length == 1 && *p == '*')) continue;
        const char *weight = p + length + strspn(p + length, " \t;");
        return strncasecmp(weight, "q=", 2) != 0 || strtod(weight + 2, NULL) > 0;
    }
    return false;
}

/* Returns the file's bytes, decompressed; NULL: out of memory. */
static char *decompress(const struct site_file *file)
{
    char *out = malloc(file->plain_size ? file->plain_size : 1);
    z_stream stream = {.next_in = (z_const Bytef *)(uintptr_t)file->bytes,
                       .avail_in = (uInt)file->size,
                       .next_out = (Bytef *)out,
                       .avail_out = (uInt)file->plain_size};
    enum { GZIP = 16 };
    if (!out || inflateInit2(&stream, MAX_WBITS + GZIP) != Z_OK) {
        free(out);
        return NULL;
    }
    const bool is_whole = inflate(&stream, Z_FINISH) == Z_STREAM_END;
    inflateEnd(&stream);
    if (is_whole) return out;
    free(out);
    return NULL;
}

static void answer_site_file(const struct request *request, const struct site_file *file, struct answer *answer)
{
    const bool is_packed = file->plain_size > 0, unpacks = is_packed && !takes_gzip(request->accept_encoding);
    char tag[64];
    snprintf(tag, sizeof tag, "\"%s%s\"", file->tag, unpacks ? "-plain" : "");
    const bool has_file = text_has_tag(request->if_none_match, tag);
    if (has_file) {
        answer->status = 304;
        answer->size = unpacks ? file->plain_size : file->size;
    } else if (!unpacks) {
        answer_copy(answer, file->type, file->bytes, file->size);
    } else {
        char *bytes = decompress(file);
        if (!bytes) {
            problem_busy(answer, 1, REFUSAL_MEMORY);
            return;
        }
        answer->status = 200;
        answer_body(answer, file->type, bytes, file->plain_size);
    }
    if (is_packed && !unpacks && !has_file) answer_header(answer, "Content-Encoding", "gzip");
    answer_header(answer, "ETag", "%s", tag);
    answer_header(answer, "Cache-Control", "no-cache");
    if (is_packed) answer_vary(answer, "Accept-Encoding");
}

/* Answers 404 and returns true if the page and the manual are off. */
static bool refuse_if_off(const struct service *service, struct answer *answer, const char *what)
{
    if (strcmp(service->config->page, "off") != 0) return false;
    problem_answer(answer, 404, "the %s is off; start zrasterd with --page=on for it", what);
    return true;
}

static void answer_policy(struct answer *answer, const char *policy)
{
    answer_header(answer, "Content-Security-Policy", "%s", policy);
    answer_header(answer, "Cross-Origin-Opener-Policy", "same-origin");
}

bool site_open(const struct service *service, struct request *request, struct answer *answer)
{
    if (refuse_if_off(service, answer, "page")) return false;
    const int kind = engine_is_there(service->engine);
    answer_site_file(request, &site_files[kind], answer);
    answer_policy(answer, site_policies[kind]);
    return false;
}

bool engine_open(const struct service *service, struct request *request, struct answer *answer)
{
    const char *name = request->path + sizeof ENGINE_PATH - 1;
    const struct site_file *file = engine_find(service->engine, name);
    if (refuse_if_off(service, answer, "page")) return false;
    if (file) {
        answer_site_file(request, file, answer);
        /* A Worker has the policy of its script: it imports the others, and compiles the module. */
        answer_policy(answer, "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; "
                              "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    } else if (engine_is_there(service->engine)) {
        problem_answer(answer, 404, "the page has no file '%.100s'", name);
    } else {
        problem_answer(answer, 404,
                       "the page does not draw by itself; start zrasterd with --engine-dir=DIRECTORY for that");
    }
    return false;
}

bool manual_open(const struct service *service, struct request *request, struct answer *answer)
{
    const size_t length = strlen(request->path);
    if (refuse_if_off(service, answer, "manual")) return false;
    if (length < sizeof MANUAL_PATH - 1) { /* relative, so that it also holds behind a proxy that adds a path */
        answer->status = 308;
        answer_header(answer, "Location", "%s", &MANUAL_PATH[1]);
        return false;
    }
    const char *name = request->path + sizeof MANUAL_PATH - 1;
    for (const struct site_file *file = manual_files; file < manual_files + manual_file_count; file++)
        if (strcmp(file->name, name) == 0) {
            answer_site_file(request, file, answer);
            answer_policy(answer, "default-src 'none'; style-src 'self'; img-src 'self' data:; base-uri 'none'; "
                                  "form-action 'none'; frame-ancestors 'none'");
            return false;
        }
    problem_answer(answer, 404, "the manual has no page '%.100s'; " MANUAL_PATH " lists them", name);
    return false;
}

/* ---- lists ---- */

/* Answers a list as JSON and frees it. */
static void answer_list(struct answer *answer, cJSON *root, bool is_whole)
{
    char *text = is_whole ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    answer->status = 200;
    answer->is_broken |= !text;
    if (text) answer_body(answer, "application/json", text, strlen(text));
}

static cJSON *add_item(cJSON *list)
{
    cJSON *item = cJSON_CreateObject();
    if (cJSON_AddItemToArray(list, item)) return item;
    cJSON_Delete(item);
    return NULL;
}

static void list_examples(struct answer *answer)
{
    cJSON *root = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(root, "examples");
    bool is_whole = list;
    for (const struct site_file *file = site_files; file < site_files + site_file_count && is_whole; file++) {
        if (!file->files) continue;
        cJSON *item = add_item(list), *files = cJSON_Parse(file->files);
        is_whole = cJSON_AddStringToObject(item, "name", file->name) &&
                   cJSON_AddStringToObject(item, "title", file->title) && files &&
                   cJSON_AddItemToObject(item, "files", files);
        if (!is_whole) cJSON_Delete(files);
    }
    answer_list(answer, root, is_whole);
}

bool examples_open(const struct service *service, struct request *request, struct answer *answer)
{
    (void)service;
    if (strcmp(request->path, "/v1/examples") == 0) {
        list_examples(answer);
        return false;
    }
    const char *name = request->path + sizeof EXAMPLES_PATH - 1;
    for (const struct site_file *file = site_files; file < site_files + site_file_count; file++)
        if (*file->name && strcmp(file->name, name) == 0) {
            answer_site_file(request, file, answer);
            return false;
        }
    problem_answer(answer, 404, "there is no example '%.100s'; /v1/examples lists them", name);
    return false;
}

static bool add_look(cJSON *list, int first)
{
    const struct zr_look *look = &zr_looks[first];
    cJSON *item = add_item(list), *versions = NULL;
    bool is_whole = cJSON_AddStringToObject(item, "name", look->name) &&
                    cJSON_AddStringToObject(item, "text", look->text) &&
                    (versions = cJSON_AddArrayToObject(item, "versions"));
    for (int i = first; is_whole && i < zr_look_count && strcmp(zr_looks[i].name, look->name) == 0; i++) {
        cJSON *version = cJSON_CreateNumber(zr_looks[i].version);
        is_whole = cJSON_AddItemToArray(versions, version);
        if (!is_whole) cJSON_Delete(version);
    }
    return is_whole;
}

bool looks_open(const struct service *service, struct request *request, struct answer *answer)
{
    (void)service;
    (void)request;
    cJSON *root = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(root, "looks");
    bool is_whole = list;
    for (int i = 0; i < zr_look_count && is_whole; i++)
        if (i == 0 || strcmp(zr_looks[i - 1].name, zr_looks[i].name) != 0) is_whole = add_look(list, i);
    answer_list(answer, root, is_whole);
    return false;
}
