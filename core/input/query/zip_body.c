#include "input/query/zip_body.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "input/formats/formats.h"
#include "input/formats/input.h"
#include "input/formats/sniff.h"
#include "input/text/names.h"
#include "input/text/text.h"
#include "render_request.h"

/* UPS_MAX: maximum number of ".." in a relative name. Members further away are found only by their full path. */
enum { NAMED_MAX = 8, UPS_MAX = 16 };

struct archive {
    struct zr_zip zip;
    const struct zr_zip_member *model;
    enum zr_format format; /* format of the model */
};

/* ---- names ---- */

static const char *find_last(const char *text, size_t length, char c)
{
    const char *at = text + length;
    while (at > text)
        if (*--at == c) return at;
    return NULL;
}

/* Returns the last part of a member's path; *length: its length. */
static const char *last_part(const struct zr_zip_member *member, size_t *length)
{
    const char *slash = find_last(member->name, member->name_length, '/');
    const char *part = slash ? slash + 1 : member->name;
    *length = (size_t)(member->name + member->name_length - part);
    return part;
}

/* True if the last part of the path ends with a dot and one of the words, which are separated by blanks. */
static bool has_ending(const struct zr_zip_member *member, const char *words)
{
    size_t length;
    const char *part = last_part(member, &length), *dot = find_last(part, length, '.');
    const size_t ending = dot ? (size_t)(part + length - dot - 1) : 0;
    for (const char *at = words; ending > 0 && *at; at += strspn(at, " ")) {
        const size_t here = strcspn(at, " ");
        if (here == ending && strncasecmp(at, dot + 1, ending) == 0) return true;
        at += here;
    }
    return false;
}

static enum zr_format format_of(const struct zr_zip_member *member)
{
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        if (i != ZR_FORMAT_ZIP && has_ending(member, zr_format_rows[i].suffix)) return (enum zr_format)i;
    return ZR_FORMAT_UNKNOWN;
}

/* True for members of hidden folders, such as those that macOS adds. */
static bool is_hidden(const struct zr_zip_member *member)
{
    static const char mac[] = "__MACOSX/";
    const char *const end = member->name + member->name_length;
    if (member->name_length >= sizeof mac - 1 && memcmp(member->name, mac, sizeof mac - 1) == 0) return true;
    for (const char *at = member->name; at < end; at++) {
        if (*at == '.' && at + 1 < end && at[1] != '/') return true;
        at = memchr(at, '/', (size_t)(end - at));
        if (!at) return false;
    }
    return false;
}

/* ---- the model ---- */

static bool is_model(const struct zr_zip_member *member)
{
    return !is_hidden(member) && format_of(member) != ZR_FORMAT_UNKNOWN;
}

/* Lists the models, for a message. */
static struct zr_names_text list_models(const struct zr_zip *zip)
{
    struct zr_names_text names = {""};
    size_t count = 0;
    for (size_t i = 0; i < zip->count; i++) {
        if (!is_model(&zip->members[i]) || ++count > NAMED_MAX) continue;
        zr_names_text_add(&names, zr_quote(zip->members[i].name, zip->members[i].name_length).text);
    }
    char more[32];
    snprintf(more, sizeof more, "%zu more", count - NAMED_MAX);
    if (count > NAMED_MAX) zr_names_text_add(&names, more);
    return names;
}

static enum zr_status refuse_models(const struct zr_zip *zip, size_t count, struct zr_error *error)
{
    if (count > 0)
        return zr_error_add(error, ZR_BAD_SCENE, NULL,
                            "the ZIP archive has %zu models; choose one by the parameter member: %s", count,
                            list_models(zip).text);
    struct zr_names_text endings = {""};
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        if (i != ZR_FORMAT_ZIP) zr_names_text_add(&endings, zr_format_rows[i].suffix);
    return zr_error_add(error, ZR_BAD_SCENE, NULL, "the ZIP archive has no model: no member ends with one of %s",
                        endings.text);
}

/* The members that a name matches: the member with this path, else all whose last part is the name, else all whose last
 * part is the name without regard to case. */
struct matches {
    size_t count;
    const struct zr_zip_member *first[2];
};

static struct matches find_last_parts(const struct zr_zip *zip, const char *name, bool any_case)
{
    struct matches matches = {.count = 0};
    for (size_t i = 0; i < zip->count; i++) {
        size_t length;
        const char *part = last_part(&zip->members[i], &length);
        if (length != strlen(name)) continue;
        if (any_case ? strncasecmp(part, name, length) != 0 : memcmp(part, name, length) != 0) continue;
        if (matches.count < 2) matches.first[matches.count] = &zip->members[i];
        matches.count++;
    }
    return matches;
}

static struct matches find_member(const struct zr_zip *zip, const char *name)
{
    const struct zr_zip_member *of_path = zr_zip_find(zip, name, strlen(name));
    if (of_path) return (struct matches){.count = 1, .first = {of_path}};
    const struct matches matches = find_last_parts(zip, name, false);
    return matches.count > 0 ? matches : find_last_parts(zip, name, true);
}

/* Refuses a name that matches no member, or several members. */
static enum zr_status refuse_member(const struct zr_zip *zip, const char *name, const struct matches *matches,
                                    struct zr_error *error)
{
    const struct zr_quote quote = zr_quote(name, strlen(name));
    const struct zr_names_text models = list_models(zip);
    if (matches->count == 0)
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "parameter member: the ZIP archive has no %s; its models: %s",
                            quote.text, *models.text ? models.text : "none");
    const struct zr_zip_member *a = matches->first[0], *b = matches->first[1];
    return zr_error_add(error, ZR_BAD_REQUEST, NULL,
                        "parameter member: %zu members have the name %s; choose one by its path: %s, %s%s",
                        matches->count, quote.text, zr_quote(a->name, a->name_length).text,
                        zr_quote(b->name, b->name_length).text, matches->count > 2 ? ", ..." : "");
}

/* Counts the models; finds one. */
static size_t count_models(struct archive *archive)
{
    size_t count = 0;
    for (size_t i = 0; i < archive->zip.count; i++) {
        if (!is_model(&archive->zip.members[i])) continue;
        archive->model = &archive->zip.members[i];
        count++;
    }
    return count;
}

/* Counts the models again, without JSON files that are not scenes, such as lists of files. */
static enum zr_status count_scenes(struct archive *archive, struct zr_arena *arena, size_t *count,
                                   struct zr_reason *reason)
{
    *count = 0;
    for (size_t i = 0; i < archive->zip.count; i++) {
        const struct zr_zip_member *member = &archive->zip.members[i];
        const char *bytes;
        if (!is_model(member)) continue;
        if (format_of(member) == ZR_FORMAT_JSON) {
            const enum zr_status status = zr_zip_read(member, arena, &bytes, reason);
            if (status != ZR_OK) return status;
            if (!zr_has_geometry_key(bytes, (size_t)member->size)) continue;
        }
        archive->model = member;
        (*count)++;
    }
    return ZR_OK;
}

static enum zr_status choose(struct archive *archive, struct zr_arena *arena, const char *name,
                             struct zr_reason *reason, struct zr_error *error)
{
    const struct zr_zip *zip = &archive->zip;
    if (zip->count == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "the ZIP archive is empty");
    size_t count = name ? 1 : count_models(archive);
    if (count > 1) {
        const size_t all = count;
        const enum zr_status status = count_scenes(archive, arena, &count, reason);
        if (status != ZR_OK) return status;
        if (count == 0) count = all;
    }
    if (name) {
        const struct matches matches = find_member(zip, name);
        if (matches.count != 1) return refuse_member(zip, name, &matches, error);
        archive->model = matches.first[0];
    } else if (count != 1) {
        return refuse_models(zip, count, error);
    }
    archive->format = format_of(archive->model);
    return ZR_OK;
}

/* ---- assets ---- */

static char *write_path(struct zr_arena *arena, const struct zr_zip_member *member)
{
    char *path = zr_arena_alloc(arena, member->name_length + 1, 1);
    if (!path) return NULL;
    memcpy(path, member->name, member->name_length);
    path[member->name_length] = '\0';
    return path;
}

/* Returns the path of a member as seen from the model's folder. */
static const char *relative(struct zr_arena *arena, const struct zr_zip_member *model, const char *path)
{
    size_t common = 0, ups = 0;
    const char *slash = find_last(model->name, model->name_length, '/');
    const size_t folder = slash ? (size_t)(slash - model->name) + 1 : 0;
    for (size_t i = 0; i < folder && path[i] == model->name[i]; i++)
        if (path[i] == '/') common = i + 1;
    for (size_t i = common; i < folder; i++)
        ups += model->name[i] == '/';
    if (ups == 0 || ups > UPS_MAX) return ups == 0 ? path + common : path;
    char *name = zr_arena_alloc(arena, 3 * ups + strlen(path + common) + 1, 1), *end = name;
    if (!name) return NULL;
    for (size_t i = 0; i < ups; i++)
        end = mempcpy(end, "../", 3);
    strcpy(end, path + common);
    return name;
}

static bool add_asset(struct zr_arena *arena, const struct archive *archive, const struct zr_zip_member *member,
                      struct zr_packed *packed, struct zr_asset *asset)
{
    const char *path = write_path(arena, member), *name = path ? relative(arena, archive->model, path) : NULL;
    *packed = (struct zr_packed){.member = member, .path = path};
    *asset = (struct zr_asset){.name = name, .size = (size_t)member->size, .packed = packed};
    packed->asset = (struct zr_asset){.name = name, .size = (size_t)member->size};
    return name != NULL;
}

/* Adds the members to the assets of the request. */
static bool add_assets(struct zr_arena *arena, const struct archive *archive, struct zr_request *request)
{
    enum { CHECKED_AT_ONCE = 1 << 10 };
    size_t count = request->asset_count;
    struct zr_packed *packed = zr_arena_alloc(arena, archive->zip.count, sizeof *packed);
    struct zr_asset *assets = zr_arena_alloc(arena, count + archive->zip.count, sizeof *assets);
    if (!packed || !assets) return false;
    if (count > 0) memcpy(assets, request->assets, count * sizeof *assets);
    for (size_t i = 0; i < archive->zip.count; i++) {
        const struct zr_zip_member *member = &archive->zip.members[i];
        if (i % CHECKED_AT_ONCE == 0 && zr_is_cancelled(arena->cancel)) return false;
        if (member == archive->model || is_hidden(member)) continue;
        if (!add_asset(arena, archive, member, packed++, &assets[count++])) return false;
    }
    request->assets = assets;
    request->asset_count = count;
    return true;
}

/* ---- interface ---- */

static enum zr_status refuse_reading(enum zr_status status, const char *reason, struct zr_error *error)
{
    return zr_error_add(error, status, NULL, "%s ZIP archive: %s", status == ZR_BAD_SYNTAX ? "a broken" : "a", reason);
}

static enum zr_status open_archive(struct zr_arena *arena, struct zr_request *request, const struct zr_limits *limits,
                                   const char **model, struct zr_error *error)
{
    struct archive archive = {.model = NULL};
    struct zr_reason reason = {""};
    const char *bytes;
    enum zr_status status = zr_zip_open(arena, request->bytes, request->size, &archive.zip, &reason);
    if (status == ZR_OK) {
        *archive.zip.unpacked = (struct zr_unpacked){.quick = request->quick, .bytes_max = limits->unpacked_bytes_max};
        status = choose(&archive, arena, request->member, &reason, error);
        if (status != ZR_OK && error->count > 0) return status;
        if (status == ZR_OK) status = zr_zip_read(archive.model, arena, &bytes, &reason);
    }
    if (status != ZR_OK) return *reason.text ? refuse_reading(status, reason.text, error) : status;
    *model = write_path(arena, archive.model);
    if (!*model || !add_assets(arena, &archive, request))
        return zr_is_cancelled(arena->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    request->format = archive.format;
    request->bytes = bytes;
    request->size = (size_t)archive.model->size;
    request->member = NULL;
    if (request->size == 0) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "in %s: the member is empty", *model);
    if (request->format == ZR_FORMAT_UNKNOWN) request->format = zr_format_of_bytes(bytes, request->size);
    if (request->format == ZR_FORMAT_UNKNOWN)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "in %s: the member has none of the formats that are read",
                            *model);
    return ZR_OK;
}

enum zr_status zr_zip_body_open(struct zr_arena *arena, struct zr_request *request, const struct zr_limits *limits,
                                const char **model, struct zr_error *error)
{
    *model = NULL;
    if (request->format == ZR_FORMAT_ZIP && zr_looks_so_3MF(request->bytes, request->size))
        request->format = ZR_FORMAT_3MF;
    if (request->format == ZR_FORMAT_ZIP) return open_archive(arena, request, limits, model, error);
    if (!request->member) return ZR_OK;
    return zr_error_add(error, ZR_BAD_REQUEST, NULL, "parameter member belongs to bodies that are a ZIP archive");
}

void zr_zip_body_warn(struct zr_scene_builder *builder, const struct zr_request *request)
{
    size_t count = 0;
    const char *first = NULL;
    for (size_t i = 0; i < request->asset_count; i++) {
        const struct zr_packed *packed = request->assets[i].packed;
        if (!packed || packed->asset.bytes || packed->status != ZR_OK ||
            !has_ending(packed->member, "png jpg jpeg webp mtl bin npy"))
            continue;
        if (count++ == 0) first = packed->path;
    }
    if (count == 0) return;
    const struct zr_quote quote = zr_quote(first, strlen(first));
    if (count == 1)
        zr_warning_list_add(builder->arena, &builder->warnings, "a member of the ZIP archive is not used: %s",
                            quote.text);
    else
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "%zu members of the ZIP archive are not used, the first is %s", count, quote.text);
}

/* Returns the first member that could not be unpacked, or NULL. */
static const struct zr_packed *find_broken(const struct zr_request *request)
{
    for (size_t i = 0; i < request->asset_count; i++)
        if (request->assets[i].packed && request->assets[i].packed->status != ZR_OK) return request->assets[i].packed;
    return NULL;
}

enum zr_status zr_zip_body_check(const struct zr_request *request, const char *model, enum zr_status status,
                                 struct zr_error *error)
{
    const struct zr_packed *broken = model ? find_broken(request) : NULL;
    const struct zr_error all = *error;
    if (broken) {
        *error = (struct zr_error){0};
        return broken->reason ? refuse_reading(broken->status, broken->reason, error) : broken->status;
    }
    if (!model || (status != ZR_BAD_SYNTAX && status != ZR_BAD_SCENE)) return status;
    *error = (struct zr_error){0};
    for (size_t i = 0; i < zr_error_held(&all); i++)
        zr_error_add(error, all.status, all.items[i].pointer, "in %s: %s", zr_quote(model, strlen(model)).text,
                     all.items[i].detail);
    error->count = all.count;
    return status;
}

bool zr_zip_body_keep(struct zr_arena *arena, const struct zr_request *request)
{
    for (size_t i = 0; i < request->asset_count; i++) {
        struct zr_packed *packed = request->assets[i].packed;
        if (!packed) continue;
        packed->is_closed = true;
        if (packed->asset.bytes == packed->member->packed)
            packed->asset.bytes = zr_arena_copy(arena, packed->asset.bytes, packed->asset.size);
    }
    return zr_arena_ok(arena);
}

/* ---- the format: an archive within an archive, since core/request/read.c replaces an archive by its model ---- */

/* An archive begins with a member, or with its end if it is empty. */
bool zr_looks_so_ZIP(const char *bytes, size_t size)
{
    return size >= 4 && (memcmp(bytes, "PK\3\4", 4) == 0 || memcmp(bytes, "PK\5\6", 4) == 0);
}

enum zr_status zr_read_ZIP(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    (void)builder, (void)request, (void)limits;
    return zr_error_add(error, ZR_BAD_SCENE, NULL, "a ZIP archive within a ZIP archive is not read");
}
