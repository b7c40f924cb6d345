#include "model.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "faults.h"
#include "tree.h"

enum { LOOK_BYTES = 256 << 10 }; /* decoded within 1 ms */

/* ---- bytes ---- */

/* Values of the characters of base64, in both alphabets; -1: it is none. */
struct digits {
    signed char of[256];
};

static struct digits make_digits(void)
{
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    struct digits digits;
    memset(digits.of, -1, sizeof digits.of);
    for (int i = 0; i < 64; i++)
        digits.of[(unsigned char)alphabet[i]] = (signed char)i;
    digits.of['-'] = 62;
    digits.of['_'] = 63;
    return digits;
}

/* Decodes whole groups of four, up to another character. Returns how many were read. */
static size_t decode_groups(const struct digits *digits, const char *text, size_t size, unsigned char **end)
{
    const unsigned char *at = (const unsigned char *)text;
    unsigned char *out = *end;
    size_t read = 0;
    for (; size - read >= 4; read += 4) {
        const int a = digits->of[at[read]], b = digits->of[at[read + 1]], c = digits->of[at[read + 2]],
                  d = digits->of[at[read + 3]];
        if ((a | b | c | d) < 0) break;
        *out++ = (unsigned char)(a << 2 | b >> 4);
        *out++ = (unsigned char)(b << 4 | c >> 2);
        *out++ = (unsigned char)(c << 6 | d);
    }
    *end = out;
    return read;
}

/* Passes "data:...;base64,", which some callers put before the bytes. */
static const char *pass_scheme(struct mcp_span text)
{
    const size_t size = (size_t)(text.end - text.at);
    const char *comma =
        size > 5 && memcmp(text.at, "data:", 5) == 0 ? memchr(text.at, ',', size < 200 ? size : 200) : NULL;
    return comma ? comma + 1 : text.at;
}

/* Passes line ends, written as escapes, and a slash with a backslash. */
static const char *pass_escapes(const char *at, const char *end)
{
    while (end - at >= 2 && *at == '\\' && (at[1] == 'n' || at[1] == 'r'))
        at += 2;
    return end - at >= 2 && *at == '\\' && at[1] == '/' ? at + 1 : at;
}

static bool decode(const struct mcp_host *host, struct mcp_span text, struct mcp_model *model,
                   struct mcp_faults *faults)
{
    const char *const begin = pass_scheme(text), *end = text.end;
    const struct digits digits = make_digits();
    unsigned char *out = host->allocate(host->context, (size_t)(end - begin) / 4 * 3 + 4);
    uint32_t bits = 0;
    unsigned count = 0;
    if (!out) return false;
    model->bytes = out;
    while (end > begin && (end[-1] == '=' || (end[-1] == 'n' && end - begin > 1 && end[-2] == '\\')))
        end -= end[-1] == '=' ? 1 : 2;
    for (const char *at = begin; (at = pass_escapes(at, end)) < end;) {
        const size_t left = (size_t)(end - at);
        if (mcp_host_is_cancelled(host)) return false;
        if (count == 0) at += decode_groups(&digits, at, left < LOOK_BYTES ? left : LOOK_BYTES, &out);
        for (int i = 0; i < 4 && (at = pass_escapes(at, end)) < end; i++, at++) {
            const int digit = digits.of[(unsigned char)*at];
            if (digit < 0)
                return mcp_fault(faults, "/model/base64", "character %zu is no base64", (size_t)(at - text.at) + 1);
            bits = bits << 6 | (uint32_t)digit;
            if (++count < 4) continue;
            *out++ = (unsigned char)(bits >> 16);
            *out++ = (unsigned char)(bits >> 8);
            *out++ = (unsigned char)bits;
            count = 0;
        }
    }
    if (count == 1) return mcp_fault(faults, "/model/base64", "the last characters are missing");
    if (count > 1) *out++ = (unsigned char)(bits >> (count == 2 ? 4 : 10));
    if (count == 3) *out++ = (unsigned char)(bits >> 2);
    model->size = (size_t)(out - (const unsigned char *)model->bytes);
    return true;
}

static bool unescape(const struct mcp_host *host, struct mcp_span text, struct mcp_model *model)
{
    const struct zr_json_text escaped = {text.at, text.end, true};
    char *out = host->allocate(host->context, (size_t)(text.end - text.at) + 1);
    if (!out) return false;
    model->bytes = out;
    model->size = zr_json_text_resolve(&escaped, out);
    return true;
}

/* ---- the argument ---- */

static bool take_path(const struct mcp_host *host, const char *path, struct mcp_model *model, struct mcp_faults *faults)
{
    const char *end = path + strlen(path), *name;
    if (!host->reads_files)
        return mcp_fault(faults, "/model/path", "this server reads no files: give base64, text or an uploaded asset");
    while (end > path && end[-1] == '/')
        end--;
    for (name = end; name > path && name[-1] != '/';)
        name--;
    if (name == end || (size_t)(end - name) >= sizeof model->name)
        return mcp_fault(faults, "/model/path", "'%.100s' names no file", path);
    snprintf(model->name, sizeof model->name, "%.*s", (int)(end - name), name);
    model->path = path;
    return true;
}

static bool take_asset(const struct mcp_host *host, const char *asset, struct mcp_model *model,
                       struct mcp_faults *faults)
{
    if (host->reads_files)
        return mcp_fault(faults, "/model/asset", "this server has no uploaded assets: give a path, base64 or text");
    if (strlen(asset) >= sizeof model->name || strncmp(asset, "sha256:", 7) != 0)
        return mcp_fault(faults, "/model/asset", "an asset is \"sha256:\" and 64 digits, as POST /v1/assets answers");
    snprintf(model->name, sizeof model->name, "%s", asset);
    return true;
}

static const cJSON *find_source(const cJSON *given, struct mcp_faults *faults)
{
    const struct mcp_words known = mcp_words_of_keys(mcp_model_sources, ~0u);
    const cJSON *found = NULL, *item;
    const size_t before = faults->count;
    cJSON_ArrayForEach(item, given)
    {
        char pointer[MCP_POINTER_SIZE];
        snprintf(pointer, sizeof pointer, "/model/%.100s", item->string);
        if (!mcp_words_find(&known, item->string))
            mcp_fault_unknown(faults, pointer, "the key", item->string, &known);
        else if (!cJSON_IsString(item))
            mcp_fault(faults, pointer, "a string is expected");
        else if (found)
            mcp_fault(faults, pointer, "%s is given, too: give one of base64, text, path and asset", found->string);
        else
            found = item;
    }
    if (!found && faults->count == before)
        mcp_fault(faults, "/model", "give one of base64, text, path (zraster mcp) and asset (the daemon)");
    return faults->count > before ? NULL : found;
}

/* Reads an object that is given. Faults have pointers into /model. */
static bool read(const struct mcp_host *host, const cJSON *given, struct mcp_span base64, struct mcp_span text,
                 struct mcp_model *model, struct mcp_faults *faults)
{
    if (!cJSON_IsObject(given))
        return mcp_fault(faults, "/model", "an object is expected, such as {\"%s\": ...}",
                         host->reads_files ? "path" : "base64");
    const cJSON *source = find_source(given, faults);
    if (!source) return false;
    model->is_given = true;
    bool is_read;
    if (strcmp(source->string, "path") == 0)
        is_read = take_path(host, source->valuestring, model, faults);
    else if (strcmp(source->string, "asset") == 0)
        is_read = take_asset(host, source->valuestring, model, faults);
    else if (strcmp(source->string, "base64") == 0)
        is_read = decode(host, base64, model, faults);
    else
        is_read = unescape(host, text, model);
    model->z_is_up = mcp_model_is_z_up(model->path, model->bytes, model->size);
    return is_read;
}

bool mcp_model_read(const struct mcp_host *host, const struct mcp_message *message, struct mcp_model *model,
                    struct mcp_faults *faults)
{
    const cJSON *given = mcp_get(message->arguments, "model");
    *model = (struct mcp_model){.name = "model"};
    return !given || read(host, given, message->base64, message->text, model, faults);
}

bool mcp_side_read(const struct mcp_host *host, const struct mcp_message *message, int side, struct mcp_model *model,
                   struct mcp_faults *faults)
{
    const cJSON *given = mcp_get(message->arguments, side == 0 ? "a" : "b");
    const size_t before = faults->count;
    *model = (struct mcp_model){.name = "model"};
    if (!given) return mcp_fault(faults, side == 0 ? "/a" : "/b", "the model is missing");
    const bool is_read = read(host, given, message->sides[side].base64, message->sides[side].text, model, faults);
    for (size_t i = before; i < faults->count; i++)
        mcp_side_point(faults->at[i].pointer, side);
    return is_read;
}

void mcp_side_point(char pointer[MCP_POINTER_SIZE], int side)
{
    static const char model[] = "/model";
    const bool is_source = strncmp(pointer, model, sizeof model - 1) == 0;
    char rest[MCP_POINTER_SIZE];
    snprintf(rest, sizeof rest, "%s", is_source ? pointer + sizeof model - 1 : "");
    snprintf(pointer, MCP_POINTER_SIZE, "/%c%.180s", side == 0 ? 'a' : 'b', rest);
}
