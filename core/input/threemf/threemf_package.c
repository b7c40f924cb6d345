/* Finds the model part of a 3MF package by its relationships (Open Packaging Conventions), and parts by their paths. */
#include <string.h>
#include <strings.h>

#include "input/formats/input.h"
#include "input/threemf/threemf_file.h"

#define RELATIONSHIPS "_rels/.rels"
#define MODEL_TYPE    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"

/* Memory limit for detection, which reads the directory and the relationships. */
enum { LOOK_BYTES_MAX = 4 << 20 };

/* Decodes percent escapes such as %20. NULL without memory. */
static const char *unescaped(struct zr_arena *arena, const char *text)
{
    const size_t length = strlen(text);
    char *out = zr_arena_alloc(arena, length + 1, 1), *next = out;
    for (size_t i = 0; out && i < length; i++) {
        const bool is_escape =
            text[i] == '%' && i + 2 < length && zr_hex_digit(text[i + 1]) >= 0 && zr_hex_digit(text[i + 2]) >= 0;
        *next++ = is_escape ? (char)(zr_hex_digit(text[i + 1]) * 16 + zr_hex_digit(text[i + 2])) : text[i];
        if (is_escape) i += 2;
    }
    if (out) *next = '\0';
    return out;
}

/* Finds the member at a path from the package's root, as written or with its escapes decoded. */
static const struct zr_zip_member *find_in(const struct zr_zip *zip, struct zr_arena *arena, struct zr_xml_text path)
{
    const char *name = zr_xml_decode(arena, path);
    if (!name) return NULL;
    if (strncmp(name, "./", 2) == 0) name += 2;
    name += strspn(name, "/");
    const struct zr_zip_member *member = zr_zip_find(zip, name, strlen(name));
    if (member || !strchr(name, '%')) return member;
    name = unescaped(arena, name);
    return name ? zr_zip_find(zip, name, strlen(name)) : NULL;
}

const struct zr_zip_member *zr_threemf_find_member(const struct zr_threemf *file, struct zr_xml_text path)
{
    return find_in(&file->zip, file->arena, path);
}

/* Finds the target of the relationship to the 3D model. .at is NULL if there is none. */
static struct zr_xml_text find_target(struct zr_xml *xml, struct zr_xml_tag *tag)
{
    enum zr_xml_event event;
    while ((event = zr_xml_next(xml, tag)) == ZR_XML_BEGIN || event == ZR_XML_END) {
        const struct zr_xml_text type = zr_xml_value(tag, "Type"), target = zr_xml_value(tag, "Target");
        if (event == ZR_XML_BEGIN && zr_xml_text_is(tag->name, "Relationship") && type.at && target.at &&
            zr_xml_text_is(type, MODEL_TYPE))
            return target;
    }
    return (struct zr_xml_text){NULL, 0};
}

/* True for models where packages have them: 3D/NAME.model. */
static bool is_model(const struct zr_zip_member *member)
{
    static const char folder[] = "3D/", end[] = ".model";
    const size_t length = member->name_length, least = strlen(end);
    if (length < least || strncasecmp(member->name + length - least, end, least) != 0) return false;
    size_t name = length;
    while (name > 0 && member->name[name - 1] != '/')
        name--;
    return name >= strlen(folder) && strncasecmp(member->name + name - strlen(folder), folder, strlen(folder)) == 0;
}

/* Finds the model of a package whose relationships do not lead to one. NULL if there is none, or several. */
static const struct zr_zip_member *find_only_model(const struct zr_zip *zip)
{
    const struct zr_zip_member *found = NULL;
    for (size_t i = 0; i < zip->count; i++) {
        if (!is_model(&zip->members[i])) continue;
        if (found) return NULL;
        found = &zip->members[i];
    }
    return found;
}

static bool refuse(struct zr_threemf *file, enum zr_status status, const char *text)
{
    zr_error_add(file->error, status, NULL, "%s", text);
    return false;
}

/* Reads the relationships to find the target. .at is NULL if there is none, or after a fault. */
static struct zr_xml_text read_target(struct zr_threemf *file, const struct zr_zip_member *relationships)
{
    const struct zr_xml_text none = {NULL, 0};
    struct zr_reason reason = {""};
    const char *bytes;
    const enum zr_status status = zr_zip_read(relationships, file->arena, &bytes, &reason);
    if (*reason.text) refuse(file, status, reason.text);
    if (status != ZR_OK) return none;
    zr_xml_open(&file->xml, bytes, (size_t)relationships->size, NULL, 0, file->cancel);
    const struct zr_xml_text target = find_target(&file->xml, &file->tag);
    if (!target.at && *file->xml.reason.text)
        zr_error_add(file->error, ZR_BAD_SYNTAX, NULL, "%s, line %zu: %s", RELATIONSHIPS,
                     zr_place_of(bytes, (size_t)(file->xml.at - bytes)).line, file->xml.reason.text);
    return target;
}

/* Reports that there is no model to read. */
static bool refuse_target(struct zr_threemf *file, bool has_relationships, struct zr_xml_text target)
{
    if (!has_relationships)
        return refuse(file, ZR_BAD_SYNTAX, "the archive has no " RELATIONSHIPS ", which names the 3D model");
    if (!target.at) return refuse(file, ZR_BAD_SYNTAX, RELATIONSHIPS ": no relationship to a 3D model");
    zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%s names the 3D model %s, which the archive does not have",
                 RELATIONSHIPS, zr_quote(target.at, target.length).text);
    return false;
}

bool zr_threemf_find_root(struct zr_threemf *file)
{
    const struct zr_zip_member *relationships = zr_zip_find(&file->zip, RELATIONSHIPS, strlen(RELATIONSHIPS));
    struct zr_xml_text target = {NULL, 0};
    if (relationships) target = read_target(file, relationships);
    if (file->error->count > 0 || !zr_arena_ok(file->arena)) return false;
    const struct zr_zip_member *named = target.at ? zr_threemf_find_member(file, target) : NULL,
                               *root = named ? named : find_only_model(&file->zip);
    file->is_unnamed = !named;
    if (!root) return refuse_target(file, relationships, target);
    struct zr_threemf_part *part = zr_threemf_list_add(file->arena, &file->parts, sizeof *part);
    if (part) *part = (struct zr_threemf_part){.member = root};
    return part != NULL;
}

uint32_t zr_threemf_find_part(struct zr_threemf *file, const char *at, struct zr_xml_text path)
{
    if (file->last_path.length > 0 && zr_xml_texts_equal(path, file->last_path)) return file->last_part;
    const struct zr_zip_member *member = zr_threemf_find_member(file, path);
    if (!member) {
        zr_threemf_fault(file, at, "the archive does not have the part %s", zr_quote(path.at, path.length).text);
        return ZR_THREEMF_NONE;
    }
    uint32_t *number = &file->part_of_member[member - file->zip.members];
    if (*number == ZR_THREEMF_NONE) {
        struct zr_threemf_part *part = zr_threemf_list_add(file->arena, &file->parts, sizeof *part);
        if (!part) return ZR_THREEMF_NONE;
        *part = (struct zr_threemf_part){.member = member};
        *number = file->parts.count - 1;
    }
    file->last_path = path;
    file->last_part = *number;
    return *number;
}

/* ---- detection ---- */

static bool has_model(struct zr_arena *arena, const char *bytes, size_t size)
{
    struct zr_zip zip;
    struct zr_reason reason;
    const char *text;
    if (zr_zip_open(arena, bytes, size, &zip, &reason) != ZR_OK) return false;
    const struct zr_zip_member *member = zr_zip_find(&zip, RELATIONSHIPS, strlen(RELATIONSHIPS));
    if (find_only_model(&zip)) return true;
    if (!member || zr_zip_read(member, arena, &text, &reason) != ZR_OK) return false;
    struct zr_xml *xml = zr_arena_alloc(arena, 1, sizeof *xml);
    struct zr_xml_tag *tag = zr_arena_alloc(arena, 1, sizeof *tag);
    if (!xml || !tag) return false;
    zr_xml_open(xml, text, (size_t)member->size, NULL, 0, NULL);
    return find_target(xml, tag).at != NULL;
}

bool zr_looks_so_3MF(const char *bytes, size_t size)
{
    struct zr_arena arena;
    if (!zr_zip_is(bytes, size)) return false;
    zr_arena_init(&arena, LOOK_BYTES_MAX);
    const bool found = has_model(&arena, bytes, size);
    zr_arena_free(&arena);
    return found;
}
