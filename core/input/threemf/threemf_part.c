/* Reads a model part of 3MF: its resources and its build. */
#include <string.h>

#include "input/threemf/threemf_file.h"

#define KEYSTORE "Secure/keystore.xml"

static const char *const uris[] = {
#define URI(ID, uri, ...) uri,
    ZR_THREEMF_SPACES(URI)
#undef URI
};
static const struct {
    bool is_read;
    const char *text;
} spaces[] = {
#define SPACE(ID, uri, is_read, text) {is_read, text},
    ZR_THREEMF_SPACES(SPACE)
#undef SPACE
};

/* ---- elements ---- */

/* Counts an unread element, which belongs to an extension that is not drawn or is unknown in the core. */
static void note_unread(struct zr_threemf *file)
{
    const int space = file->tag.space;
    if (space >= 0 && !spaces[space].is_read)
        zr_threemf_note(file, ZR_THREEMF_NOTE_SPACES + space, file->tag.at, file->tag.name);
    else if (zr_threemf_is_core(space))
        zr_threemf_note(file, ZR_THREEMF_NOTE_UNKNOWN, file->tag.at, file->tag.name);
}

/* ---- objects ---- */

/* Reads the attributes of a component or an item. False after a fault. */
static bool read_link(struct zr_threemf *file, struct zr_threemf_link *link)
{
    const struct zr_xml_tag *tag = &file->tag;
    *link = (struct zr_threemf_link){.part = file->part, .target_part = file->part, .at = tag->at};
    for (size_t i = 0; i < tag->count; i++) {
        const struct zr_xml_attribute *attribute = &tag->attributes[i];
        if (attribute->prefix.length == 0 || !zr_xml_text_is(attribute->name, "path") ||
            zr_xml_space(&file->xml, attribute->prefix) != ZR_THREEMF_SPACE_PRODUCTION)
            continue;
        link->target_part = zr_threemf_find_part(file, tag->at, attribute->value);
        if (link->target_part == ZR_THREEMF_NONE) return false;
    }
    return zr_threemf_count(file, "objectid", true, &link->id) &&
           zr_threemf_transform(file, &link->transform, link->offset);
}

static void read_links(struct zr_threemf *file, struct zr_threemf_list *list, const char *name)
{
    const size_t depth = file->xml.depth;
    while (zr_threemf_child(file, depth)) {
        struct zr_threemf_link link;
        if (!zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, name)) {
            note_unread(file);
            continue;
        }
        if (!read_link(file, &link)) continue;
        const struct zr_xml_text printable = zr_xml_value(&file->tag, "printable");
        if (printable.at && (zr_xml_text_is(printable, "0") || zr_xml_text_is(printable, "false")))
            zr_threemf_note(file, ZR_THREEMF_NOTE_NOT_PRINTED, file->tag.at, file->tag.name);
        struct zr_threemf_link *made = zr_threemf_list_add(file->arena, list, sizeof *made);
        if (made) *made = link;
    }
}

/* Returns the object's name as UTF-8; "" if it has none. */
static const char *read_name(struct zr_threemf *file)
{
    const struct zr_xml_text value = zr_xml_value(&file->tag, "name");
    const char *name = value.at ? zr_xml_decode(file->arena, value) : "";
    for (const char *at = name, *end = name ? name + strlen(name) : NULL; at < end;) {
        const size_t length = zr_utf8_length(at, end);
        if (length == 0) {
            zr_threemf_fault(file, file->tag.at, "name: %s is not UTF-8", zr_quote(value.at, value.length).text);
            return "";
        }
        at += length;
    }
    return name ? name : "";
}

/* Reads the type; true for `other`, which is not drawn. */
static bool read_type(struct zr_threemf *file)
{
    static const char *const drawn[] = {"model", "solidsupport", "support", "surface"};
    const struct zr_xml_text type = zr_xml_value(&file->tag, "type");
    if (!type.at) return false;
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn; i++)
        if (zr_xml_text_is(type, drawn[i])) return false;
    if (!zr_xml_text_is(type, "other"))
        zr_threemf_fault(file, file->tag.at, "type: model, solidsupport, support, surface or other is needed, not %s",
                         zr_quote(type.at, type.length).text);
    return true;
}

/* Returns the extruder of an object of the root part by a slicer's settings, or 0. */
static uint32_t find_extruder(const struct zr_threemf *file, uint32_t id)
{
    uint32_t count;
    const struct zr_threemf_setting *settings = zr_threemf_find_settings(file, id, ZR_THREEMF_NONE, &count);
    for (uint32_t i = 0; file->part == 0 && i < count; i++)
        if (settings[i].first > settings[i].last) return settings[i].extruder;
    return 0;
}

/* Applies a slicer's settings to the components of an object, from the link `first` on. */
static void apply_settings(struct zr_threemf *file, uint32_t id, uint32_t first)
{
    struct zr_threemf_link *links = file->links.items;
    const uint32_t extruder = find_extruder(file, id);
    for (uint32_t i = first; file->part == 0 && i < file->links.count; i++) {
        uint32_t count;
        const struct zr_threemf_setting *setting = zr_threemf_find_settings(file, id, links[i].id, &count);
        links[i].extruder = count > 0 && setting->extruder > 0 ? setting->extruder : extruder;
        links[i].is_left_out = count > 0 && setting->is_left_out;
    }
}

static void read_object(struct zr_threemf *file)
{
    const size_t depth = file->xml.depth;
    uint32_t pid = ZR_THREEMF_NONE, pindex = 0;
    struct zr_threemf_resource *object = zr_threemf_add(file, ZR_THREEMF_OBJECT);
    if (!object) return;
    const uint32_t number = file->resources.count - 1;
    const uint32_t id = object->id;
    object->is_left_out = read_type(file);
    object->extruder = find_extruder(file, id);
    object->name = read_name(file);
    zr_threemf_count(file, "pid", false, &pid);
    zr_threemf_count(file, "pindex", false, &pindex);
    bool has_mesh = false, has_components = false;
    while (zr_threemf_child(file, depth)) {
        const bool is_mesh = zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "mesh");
        const bool is_list = zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "components");
        if ((is_mesh || is_list) && (has_mesh || has_components))
            zr_threemf_fault(file, file->tag.at, "an object has one mesh or one list of components");
        else if (is_mesh) {
            has_mesh = true;
            const uint32_t mesh = zr_threemf_read_mesh(file, id, pid, pindex);
            zr_threemf_resources(file)[number].mesh = mesh;
        } else if (is_list) {
            const uint32_t first = file->links.count;
            has_components = true;
            read_links(file, &file->links, "component");
            apply_settings(file, id, first);
            zr_threemf_resources(file)[number].first_link = first;
            zr_threemf_resources(file)[number].link_count = file->links.count - first;
        } else if (!zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "metadatagroup"))
            note_unread(file);
    }
}

/* ---- the part ---- */

static void read_resources(struct zr_threemf *file)
{
    static const struct {
        const char *name;
        void (*read)(struct zr_threemf *);
    } others[] = {{"texture2d", zr_threemf_read_texture},
                  {"texture2dgroup", zr_threemf_read_coords},
                  {"compositematerials", zr_threemf_read_composites},
                  {"multiproperties", zr_threemf_read_multi}};
    const size_t depth = file->xml.depth;
    while (zr_threemf_child(file, depth)) {
        size_t other = 0;
        while (other < sizeof others / sizeof *others &&
               !zr_threemf_is(file, ZR_THREEMF_SPACE_MATERIAL, others[other].name))
            other++;
        if (other < sizeof others / sizeof *others)
            others[other].read(file);
        else if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "object"))
            read_object(file);
        else if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "basematerials"))
            zr_threemf_read_colors(file, ZR_THREEMF_SPACE_CORE, "base", "displaycolor");
        else if (zr_threemf_is(file, ZR_THREEMF_SPACE_MATERIAL, "colorgroup"))
            zr_threemf_read_colors(file, ZR_THREEMF_SPACE_MATERIAL, "color", "color");
        else
            note_unread(file);
    }
}

/* Refuses required extensions that are not known. Counts known extensions that are not read for a warning. */
static void check_required(struct zr_threemf *file)
{
    const struct zr_xml_text words = zr_xml_value(&file->tag, "requiredextensions");
    const char *at = words.at, *const end = at ? at + words.length : at;
    while (at < end) {
        const char *word = at;
        while (at < end && !strchr(" \t\r\n", *at))
            at++;
        const struct zr_xml_text prefix = {word, (size_t)(at - word)};
        const int space = zr_xml_space(&file->xml, prefix);
        const struct zr_xml_text uri = zr_xml_uri(&file->xml, prefix);
        const struct zr_quote quote = zr_quote(prefix.at, prefix.length);
        if (prefix.length > 0 && uri.length == 0)
            zr_threemf_fault(file, file->tag.at, "the required extension %s has no namespace (xmlns:%.*s)", quote.text,
                             prefix.length > 40 ? 0 : (int)prefix.length, prefix.at);
        else if (prefix.length > 0 && space < 0)
            zr_threemf_fault(file, file->tag.at, "the required extension %s (%.*s) is not known", quote.text,
                             uri.length > 200 ? 0 : (int)uri.length, uri.at);
        else if (prefix.length > 0 && !spaces[space].is_read)
            zr_threemf_note(file, ZR_THREEMF_NOTE_REQUIRED, file->tag.at,
                            (struct zr_xml_text){spaces[space].text, strlen(spaces[space].text)});
        at++;
    }
}

/* Reads the unit of the current part. */
static void read_unit(struct zr_threemf *file)
{
    static const struct {
        const char *name, *word;
        double microns;
    } units[] = {{"millimeter", "millimetre", 1e3}, {"micron", "micron", 1},  {"centimeter", "centimetre", 1e4},
                 {"inch", "inch", 25400},           {"foot", "foot", 304800}, {"meter", "metre", 1e6}};
    struct zr_threemf_part *part = &zr_threemf_parts(file)[file->part];
    const struct zr_xml_text unit = zr_xml_value(&file->tag, "unit");
    size_t i = 0;
    while (unit.at && i < sizeof units / sizeof *units && !zr_xml_text_is(unit, units[i].name))
        i++;
    if (i == sizeof units / sizeof *units) {
        zr_threemf_fault(file, file->tag.at,
                         "unit: micron, millimeter, centimeter, inch, foot or meter is needed, not %s",
                         zr_quote(unit.at, unit.length).text);
        i = 0;
    }
    part->unit = units[i].word;
    part->microns = units[i].microns;
}

static void read_model(struct zr_threemf *file)
{
    struct zr_threemf_part *part = &zr_threemf_parts(file)[file->part];
    const bool is_root = file->part == 0;
    const size_t depth = file->xml.depth;
    if (!zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "model")) {
        zr_threemf_fault(file, file->tag.at, "the root element is %s, not the model of 3MF",
                         zr_quote(file->tag.name.at, file->tag.name.length).text);
        file->is_stopped = true;
        return;
    }
    check_required(file);
    if (file->error->count > 0) file->is_stopped = true;
    read_unit(file);
    if (strcmp(part->unit, zr_threemf_parts(file)[0].unit) != 0)
        zr_threemf_note(file, ZR_THREEMF_NOTE_UNIT, file->tag.at, file->tag.name);
    while (zr_threemf_child(file, depth)) {
        if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "resources"))
            read_resources(file);
        else if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "build") && is_root)
            read_links(file, &file->items, "item");
        else if (!zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "metadata") &&
                 !zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "build"))
            note_unread(file);
    }
}

void zr_threemf_read_part(struct zr_threemf *file, uint32_t number)
{
    struct zr_threemf_part *part = &zr_threemf_parts(file)[number];
    struct zr_reason reason = {""};
    const char *bytes;
    const enum zr_status status = zr_zip_read(part->member, file->arena, &bytes, &reason);
    file->part = number;
    if (status != ZR_OK) {
        if (*reason.text) zr_error_add(file->error, status, NULL, "%s", reason.text);
        file->is_stopped = true;
        return;
    }
    if (number > 0 && part->member->size > 0 && *bytes != '<' && zr_zip_find(&file->zip, KEYSTORE, strlen(KEYSTORE))) {
        zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%.*s is encrypted (secure content), which is not read",
                     (int)(part->member->name_length < 80 ? part->member->name_length : 80), part->member->name);
        file->is_stopped = true;
        return;
    }
    part->bytes = part->counted_to = bytes;
    part->size = (size_t)part->member->size;
    part->line = 1;
    zr_xml_open(&file->xml, bytes, part->size, uris, ZR_THREEMF_SPACE_COUNT, file->cancel);
    if (!zr_threemf_child(file, 0)) return;
    read_model(file);
    while (!zr_threemf_stops(file))
        zr_threemf_child(file, 0); /* to the end of the document */
    if (!zr_is_cancelled(file->cancel) && file->error->count == 0) file->is_stopped = false;
}
