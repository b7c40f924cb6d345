/* Finds the materials of MTL files by their names. */
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "input/formats/sniff.h"
#include "input/obj/mtl_file.h"
#include "input/text/text.h"
#include "render_request.h"

enum { ENTRIES_AT_FIRST = 16, LINES_PER_CANCEL_CHECK = 1024, REPORT_MAX = 64 };

struct zr_mtl *zr_mtl_open(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_mtl *mtl = zr_arena_zero(builder->arena, 1, sizeof *mtl);
    struct zr_model_scene *made = zr_arena_zero(builder->arena, 1, sizeof *made);
    if (!mtl || !made) return NULL;
    mtl->made = made;
    mtl->error = error;
    mtl->arena = builder->arena;
    mtl->cancel = request->cancel;
    mtl->builder = builder;
    mtl->assets = zr_parsed_assets_of(builder, request);
    mtl->decoded = zr_image_list_of(builder, request, limits);
    if (!mtl->assets.uses) return NULL;
    return mtl;
}

enum zr_status zr_mtl_status(const struct zr_mtl *mtl)
{
    return mtl->status;
}

struct zr_model_scene *zr_mtl_made(const struct zr_mtl *mtl)
{
    return mtl->made;
}

uint32_t zr_mtl_file_count(const struct zr_mtl *mtl)
{
    return mtl->file_count;
}

bool zr_mtl_has_maps(const struct zr_mtl *mtl)
{
    return mtl->has_maps;
}

/* ---- the index ---- */

static struct zr_mtl_entry *add_entry(struct zr_mtl *mtl)
{
    if (mtl->count == mtl->room) {
        const uint32_t room = mtl->room ? 2 * mtl->room : ENTRIES_AT_FIRST;
        struct zr_mtl_entry *more =
            room > mtl->room ? zr_arena_grow(mtl->arena, mtl->entries, mtl->count, room, sizeof *more) : NULL;
        if (!more) {
            mtl->status = ZR_NO_MEMORY;
            return NULL;
        }
        mtl->entries = more;
        mtl->room = room;
    }
    mtl->entries[mtl->count].order = mtl->count;
    return &mtl->entries[mtl->count++];
}

static bool is_map(const struct zr_mtl_text *key)
{
    static const char *const words[] = {"bump", "norm"};
    const struct zr_mtl_text begin = {key->at, key->end - key->at > 4 ? key->at + 4 : key->end, key->line};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (zr_mtl_is_word(key, words[i])) return true;
    return zr_mtl_is_word(&begin, "map_");
}

/* Adds an entry per newmtl. Its lines end at the next one. */
static void index_lines(struct zr_mtl *mtl, struct zr_mtl_text rest)
{
    struct zr_mtl_entry *last = NULL;
    struct zr_mtl_text line;
    for (size_t i = 1; mtl->status == ZR_OK && zr_mtl_next(&rest, &line); i++) {
        const struct zr_mtl_text whole = line, key = zr_mtl_word(&line);
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(mtl->cancel)) mtl->status = ZR_CANCELLED;
        if (zr_mtl_is_word(&key, "newmtl")) {
            if (last) last->lines.end = whole.at;
            if ((last = add_entry(mtl)) == NULL) return;
            last->name = line;
            last->lines = rest;
            last->number = ZR_MODEL_MATERIAL_NONE;
        } else if (!last) {
            zr_mtl_note(mtl, ZR_MTL_NOTE_STRAY, &whole);
        } else if (!mtl->has_maps) {
            mtl->has_maps = is_map(&key);
        }
    }
}

bool zr_mtl_add(struct zr_mtl *mtl, const char *name, size_t length)
{
    if (mtl->sought_count++ >= ZR_MTL_SOUGHT_MAX) return false;
    const struct zr_asset *asset = zr_mtl_find_file(mtl, &(const struct zr_mtl_text){name, name + length, 0});
    if (!asset) return false;
    const char *bytes = asset->bytes;
    const size_t mark = zr_byte_order_mark(bytes, asset->size);
    if (zr_is_utf16(bytes, asset->size))
        zr_reason_give(&mtl->notes[ZR_MTL_NOTE_STRAY].reason, "the file is UTF-16 text; UTF-8 is read");
    if (zr_is_lfs_pointer(bytes, asset->size))
        zr_reason_give(&mtl->notes[ZR_MTL_NOTE_STRAY].reason, "a pointer of Git LFS: git lfs pull fetches the file");
    index_lines(mtl, (struct zr_mtl_text){bytes + mark, bytes + asset->size, 1});
    mtl->file_count++;
    return mtl->status == ZR_OK;
}

bool zr_mtl_is_file_name(const char *name, const char *end)
{
    enum { LENGTH = sizeof ".mtl" - 1 };
    return end - name >= LENGTH && zr_mtl_is_word(&(const struct zr_mtl_text){end - LENGTH, end, 0}, ".mtl");
}

const char *zr_mtl_add_only(struct zr_mtl *mtl)
{
    const char *only = NULL;
    if (mtl->assets.looked) *mtl->assets.looked = true;
    for (size_t i = 0; i < mtl->assets.count; i++) {
        const char *name = mtl->assets.items[i].name;
        if (!zr_mtl_is_file_name(name, name + strlen(name))) continue;
        if (only) return NULL;
        only = name;
    }
    return only && zr_mtl_add(mtl, only, strlen(only)) ? only : NULL;
}

/* ---- use ---- */

static int compare_names(const struct zr_mtl_text *a, const struct zr_mtl_text *b)
{
    const size_t left = (size_t)(a->end - a->at), right = (size_t)(b->end - b->at);
    const int order = memcmp(a->at, b->at, left < right ? left : right);
    return order != 0 ? order : left < right ? -1 : left > right;
}

/* Of several materials with one name, the last one comes first. */
static int compare_entries(const void *left, const void *right)
{
    const struct zr_mtl_entry *a = left, *b = right;
    const int order = compare_names(&a->name, &b->name);
    return order != 0 ? order : a->order > b->order ? -1 : a->order < b->order;
}

static void sort(struct zr_mtl *mtl)
{
    uint32_t kept = 0;
    if (mtl->count > 0) qsort(mtl->entries, mtl->count, sizeof *mtl->entries, compare_entries);
    for (uint32_t i = 0; i < mtl->count; i++) {
        if (kept > 0 && compare_names(&mtl->entries[kept - 1].name, &mtl->entries[i].name) == 0)
            zr_mtl_note(mtl, ZR_MTL_NOTE_TWICE, &mtl->entries[i].name);
        else
            mtl->entries[kept++] = mtl->entries[i];
    }
    mtl->count = kept;
    mtl->is_sorted = true;
}

static struct zr_mtl_entry *find(struct zr_mtl *mtl, const struct zr_mtl_text *name)
{
    uint32_t low = 0, high = mtl->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const int order = compare_names(name, &mtl->entries[middle].name);
        if (order == 0) return &mtl->entries[middle];
        if (order < 0)
            high = middle;
        else
            low = middle + 1;
    }
    return NULL;
}

static struct zr_parsed_material *add_material(struct zr_mtl *mtl)
{
    struct zr_model_scene *made = mtl->made;
    if (made->material_count == mtl->material_room) {
        const uint32_t room = mtl->material_room ? 2 * mtl->material_room : ENTRIES_AT_FIRST;
        struct zr_parsed_material *more =
            zr_arena_grow(mtl->arena, made->materials, made->material_count, room, sizeof *more);
        if (!more) {
            mtl->status = ZR_NO_MEMORY;
            return NULL;
        }
        made->materials = more;
        mtl->material_room = room;
    }
    return &made->materials[made->material_count++];
}

static char *copy_name(struct zr_mtl *mtl, const struct zr_mtl_text *name)
{
    size_t length = (size_t)(name->end - name->at);
    if (length > REPORT_MAX) length = REPORT_MAX;
    char *copy = zr_arena_alloc(mtl->arena, length + 1, 1);
    if (!copy) return NULL;
    memcpy(copy, name->at, length);
    copy[length] = '\0';
    return copy;
}

uint32_t zr_mtl_use(struct zr_mtl *mtl, const char *name, size_t length)
{
    const struct zr_mtl_text wanted = {name, name + length, 0};
    if (!mtl->is_sorted) sort(mtl);
    struct zr_mtl_entry *entry = find(mtl, &wanted);
    if (!entry) return ZR_MODEL_MATERIAL_NONE;
    if (entry->number != ZR_MODEL_MATERIAL_NONE || mtl->status != ZR_OK) return entry->number;
    struct zr_parsed_material *out = add_material(mtl);
    if (!out) return ZR_MODEL_MATERIAL_NONE;
    entry->number = mtl->made->material_count - 1;
    *out = (struct zr_parsed_material){.number = entry->number, .face_style = zr_face_style_unset};
    if ((out->name = copy_name(mtl, &entry->name)) == NULL) {
        mtl->status = ZR_NO_MEMORY;
        return ZR_MODEL_MATERIAL_NONE;
    }
    return entry->number;
}

/* ---- unused materials ---- */

static void use_files(struct zr_mtl *mtl, const struct zr_mtl_entry *entry)
{
    struct zr_mtl_text rest = entry->lines, line;
    while (zr_mtl_next(&rest, &line) && !zr_is_cancelled(mtl->cancel)) {
        const struct zr_mtl_text whole = line, key = zr_mtl_word(&line);
        struct zr_mtl_given_map map = {.is_given = false};
        if (is_map(&key)) zr_mtl_read_map(mtl, &whole, line, &map);
        if (map.is_given) zr_mtl_find_file(mtl, &map.name);
    }
}

/* Marks files of materials that no face uses as used, so that no warning follows. */
static void use_all_files(struct zr_mtl *mtl)
{
    struct zr_mtl_noted *kept = zr_arena_copy(mtl->arena, mtl->notes, sizeof mtl->notes);
    size_t unused = 0;
    for (size_t i = 0; i < mtl->assets.count; i++)
        unused += !mtl->assets.uses[i];
    if (!kept || unused == 0) return;
    for (uint32_t i = 0; i < mtl->count; i++)
        if (mtl->entries[i].number == ZR_MODEL_MATERIAL_NONE) use_files(mtl, &mtl->entries[i]);
    memcpy(mtl->notes, kept, sizeof mtl->notes);
}

void zr_mtl_close(struct zr_mtl *mtl)
{
    use_all_files(mtl);
    zr_mtl_warn(mtl);
    zr_parsed_warn_of_unused_assets(&mtl->assets, mtl->builder);
}
