/* Reads objects and lists of glTF, and skips unknown keys. */
#include "input/gltf/gltf_file.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/visible.h"

/* ---- counts of problems ---- */

void *zr_gltf_allocate(struct zr_gltf *file, size_t count, size_t size)
{
    return zr_json_has_time(&file->json, count * size) ? zr_arena_alloc(file->json.arena, count, size) : NULL;
}

void zr_gltf_note(struct zr_gltf_note *note, const struct zr_json_path *path)
{
    if (note->count++ > 0) return;
    const struct zr_json_path *links[16];
    size_t count = 0, used = 0;
    for (; path && count < 16; path = path->parent)
        links[count++] = path;
    while (count > 0 && used + 16 < sizeof note->first) {
        const struct zr_json_path *link = links[--count];
        const size_t room = sizeof note->first - used;
        const int length = link->key ? snprintf(note->first + used, room, "/%s", link->key)
                                     : snprintf(note->first + used, room, "/%zu", link->index);
        used += (size_t)length < room ? (size_t)length : room - 1;
    }
}

void zr_gltf_note_name(struct zr_gltf_note *note, const char *name)
{
    const size_t used = strlen(note->first);
    if (note->count == 1) snprintf(note->first + used, sizeof note->first - used, " '%.120s'", name);
    zr_make_visible(note->first, false);
}

double zr_gltf_clamp(struct zr_gltf *file, const struct zr_json_path *path, double value, double low, double high)
{
    if (value >= low && value <= high) return value;
    zr_gltf_note(&file->clamped, path);
    return value > low ? high : low;
}

/* ---- objects ---- */

bool zr_gltf_ignore(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    (void)path;
    (void)out;
    return zr_json_skip(json);
}

bool zr_gltf_index(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_index(json, path, ZR_GLTF_NONE, "items", out);
}

static bool read_numbers(struct zr_json *json, const struct zr_json_path *path, size_t count, double *out)
{
    double given[4] = {0};
    const struct zr_json_row row = {count, count, -DBL_MAX, DBL_MAX};
    if (!zr_json_numbers(json, path, row, given, NULL)) return false;
    memcpy(out, given, count * sizeof *given);
    return true;
}

bool zr_gltf_three(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_numbers(json, path, 3, out);
}

bool zr_gltf_four(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_numbers(json, path, 4, out);
}

static size_t find_field(const struct zr_json_object *object, const struct zr_json_text *key)
{
    size_t i = 0;
    while (i < object->count && !zr_json_is(key, object->fields[i].key))
        i++;
    return i;
}

static void note_unknown(struct zr_gltf *file, struct zr_json_reading *reading, const struct zr_json_text *key)
{
    const char *word = file->unknown.count == 0 ? zr_json_decode(reading->json, key) : "";
    if (word) zr_gltf_note(&file->unknown, ZR_JSON_KEY(reading->path, word));
}

static void read_field(struct zr_gltf *file, struct zr_json_reading *reading, const struct zr_json_text *key)
{
    const size_t number = find_field(reading->object, key);
    struct zr_json *json = reading->json;
    if (number == reading->object->count) {
        if (!reading->object->is_open) note_unknown(file, reading, key);
        zr_json_skip(json);
        return;
    }
    const struct zr_json_field *field = &reading->object->fields[number];
    const struct zr_json_path *path = ZR_JSON_FIELD(reading->path, field);
    if (zr_json_gives(file->given, (int)number)) {
        if (zr_json_skip(json)) zr_json_fault(json, path, "given twice");
        return;
    }
    file->given |= ZR_KEY(number);
    field->read(json, path, (char *)reading->out + field->offset);
}

bool zr_gltf_fields(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                    const struct zr_json_object *object, void *out)
{
    struct zr_json_reading reading = {.json = json, .path = path, .object = object, .out = out};
    struct zr_json_text key;
    file->given = 0;
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_json_expect(json, path, "an object");
    if (!zr_json_enter(json, '{')) return false;
    while (zr_json_member(json, &key))
        read_field(file, &reading, &key);
    for (size_t i = 0; i < object->count && object->fields[i].required; i++)
        if (!zr_json_gives(file->given, (int)i))
            zr_json_fault(json, path, "%s is missing: %s", object->fields[i].key, object->fields[i].text);
    return !json->ended;
}

bool zr_gltf_fields_at(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                       const struct zr_json_object *object, void *out)
{
    struct zr_json there = zr_json_at(&file->json, place);
    return zr_gltf_fields(file, &there, path, object, out);
}

/* ---- lists ---- */

bool zr_gltf_read_items(struct zr_gltf *file, const char *place, const struct zr_json_path *path, zr_gltf_item_fn *read)
{
    struct zr_json there = zr_json_at(&file->json, place), *json = &there;
    uint32_t number = 0;
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_any_item(json); number++)
        read(file, json, ZR_JSON_ITEM(path, number), number);
    return !zr_json_stops(&file->json);
}
