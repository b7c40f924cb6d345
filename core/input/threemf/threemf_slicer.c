/* Settings of slicers in 3MF: colours of filaments, extruders of parts, and parts that are not printed. Read from the
 * members that Bambu Studio, OrcaSlicer and PrusaSlicer write; broken settings are ignored. */
#include <stdlib.h>
#include <string.h>

#include "input/text/text.h"
#include "input/threemf/threemf_file.h"

enum { SETTINGS_MAX = 1 << 16 };

/* Returns a member's bytes; NULL if it is missing or broken, or without memory. */
static const char *find_member(struct zr_threemf *file, const char *name, size_t *size)
{
    const struct zr_zip_member *member = zr_zip_find(&file->zip, name, strlen(name));
    struct zr_reason reason = {""};
    const char *bytes;
    const enum zr_status status = member ? zr_zip_read(member, file->arena, &bytes, &reason) : ZR_BAD_SYNTAX;
    if (status == ZR_BAD_SCENE) zr_error_add(file->error, status, NULL, "%s", reason.text);
    if (status != ZR_OK) return NULL;
    *size = (size_t)member->size;
    return bytes;
}

/* ---- colours ---- */

/* Reads the colours #RRGGBB that follow `key`, up to the character `stop`. */
static void read_colors(struct zr_threemf *file, const char *bytes, size_t size, const char *key, char stop)
{
    const size_t length = strlen(key);
    const char *at = memmem(bytes, size, key, length), *const end = bytes + size;
    file->filament_count = 0;
    for (at = at ? at + length : end; at < end && *at != stop && file->filament_count < ZR_THREEMF_FILAMENTS_MAX;
         at++) {
        uint32_t color = 0xFF;
        int digits = 0;
        if (*at != '#') continue;
        for (; digits < 6 && at + 1 < end && zr_hex_digit(at[1]) >= 0; digits++)
            color = color << 4 | (uint32_t)zr_hex_digit(*++at);
        if (digits < 6) return;
        file->filaments[file->filament_count++] = 0xFF000000u | __builtin_bswap32(color << 8);
    }
}

static void find_filaments(struct zr_threemf *file)
{
    size_t size;
    const char *bytes = find_member(file, "Metadata/project_settings.config", &size);
    if (bytes) read_colors(file, bytes, size, "\"filament_colour\":", ']');
    if (bytes) return;
    bytes = find_member(file, "Metadata/Slic3r_PE.config", &size);
    if (bytes) read_colors(file, bytes, size, "\n; extruder_colour = ", '\n');
    if (bytes && file->filament_count == 0) read_colors(file, bytes, size, "\n; filament_colour = ", '\n');
}

/* ---- settings of objects and parts ---- */

/* Sets a value of the element that contains the current metadata. */
static void read_metadata(const struct zr_xml_tag *tag, struct zr_threemf_setting *setting)
{
    const struct zr_xml_text key = zr_xml_value(tag, "key"), value = zr_xml_value(tag, "value");
    uint32_t number;
    if (!key.at || !value.at) return;
    if (zr_xml_text_is(key, "extruder") && zr_threemf_digits(value, &number)) setting->extruder = number;
    if (zr_xml_text_is(key, "volume_type")) setting->is_left_out = !zr_xml_text_is(value, "ModelPart");
}

/* Begins a setting at <object>, <part> or <volume>. False at other elements. */
static bool begin_setting(const struct zr_xml_tag *tag, struct zr_threemf_setting *setting, uint32_t object)
{
    const struct zr_xml_text id = zr_xml_value(tag, "id"), subtype = zr_xml_value(tag, "subtype");
    const struct zr_xml_text first = zr_xml_value(tag, "firstid"), last = zr_xml_value(tag, "lastid");
    *setting = (struct zr_threemf_setting){.object = object, .part = ZR_THREEMF_NONE, .first = 1};
    if (zr_xml_text_is(tag->name, "object")) return id.at && zr_threemf_digits(id, &setting->object);
    if (object == ZR_THREEMF_NONE) return false;
    if (zr_xml_text_is(tag->name, "part")) {
        setting->is_left_out = subtype.at && !zr_xml_text_is(subtype, "normal_part");
        return id.at && zr_threemf_digits(id, &setting->part);
    }
    return zr_xml_text_is(tag->name, "volume") && first.at && last.at && zr_threemf_digits(first, &setting->first) &&
           zr_threemf_digits(last, &setting->last);
}

static void read_settings(struct zr_threemf *file, const char *bytes, size_t size)
{
    struct zr_threemf_setting *setting = NULL;
    uint32_t object = ZR_THREEMF_NONE;
    zr_xml_open(&file->xml, bytes, size, NULL, 0, file->cancel);
    for (;;) {
        const enum zr_xml_event event = zr_xml_next(&file->xml, &file->tag);
        struct zr_threemf_setting made;
        if (event != ZR_XML_BEGIN && event != ZR_XML_END) return;
        if (event == ZR_XML_END) continue;
        if (begin_setting(&file->tag, &made, object)) {
            if (file->settings.count == SETTINGS_MAX) return;
            if (zr_xml_text_is(file->tag.name, "object")) object = made.object;
            setting = zr_threemf_list_add(file->arena, &file->settings, sizeof *setting);
            if (!setting) return;
            *setting = made;
        } else if (setting && zr_xml_text_is(file->tag.name, "metadata")) {
            read_metadata(&file->tag, setting);
        }
    }
}

/* Orders settings by object, then by part, then by the first triangle. */
static int compare(const void *a, const void *b)
{
    const struct zr_threemf_setting *left = a, *right = b;
    if (left->object != right->object) return left->object < right->object ? -1 : 1;
    if (left->part != right->part) return left->part < right->part ? -1 : 1;
    return left->first != right->first ? (left->first < right->first ? -1 : 1) : 0;
}

void zr_threemf_read_slicer(struct zr_threemf *file)
{
    size_t size;
    find_filaments(file);
    const char *bytes = find_member(file, "Metadata/model_settings.config", &size);
    if (!bytes) bytes = find_member(file, "Metadata/Slic3r_PE_model.config", &size);
    if (!bytes) return;
    read_settings(file, bytes, size);
    if (file->settings.count > 0)
        qsort(file->settings.items, file->settings.count, sizeof(struct zr_threemf_setting), compare);
}

/* ---- finding ---- */

/* Returns the position of the first setting of an object and a part, or where it would be. */
static const struct zr_threemf_setting *find_from(const struct zr_threemf *file, uint32_t object, uint32_t part)
{
    const struct zr_threemf_setting *settings = file->settings.items;
    uint32_t low = 0, high = file->settings.count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const struct zr_threemf_setting *at = &settings[middle];
        if (at->object < object || (at->object == object && at->part < part))
            low = middle + 1;
        else
            high = middle;
    }
    return settings + low;
}

const struct zr_threemf_setting *zr_threemf_find_settings(const struct zr_threemf *file, uint32_t object, uint32_t part,
                                                          uint32_t *count)
{
    *count = 0;
    if (file->settings.count == 0) return NULL;
    const struct zr_threemf_setting *first = find_from(file, object, part);
    const struct zr_threemf_setting *end =
        (const struct zr_threemf_setting *)file->settings.items + file->settings.count;
    const uint32_t most =
        part == ZR_THREEMF_NONE ? file->settings.count : 1; /* a repeated part has the setting of the first */
    while (*count < most && first + *count < end && first[*count].object == object && first[*count].part == part)
        ++*count;
    return first;
}
