/* Reads 3MF: a ZIP archive with models in XML (threemf_file.h). */
#include "input/threemf/threemf_file.h"

#include <inttypes.h>
#include <string.h>

#include "input/formats/input.h"
#include "render_request.h"

/* ---- faults and warnings ---- */

/* Text of each warning, after its count. */
static const char *const texts[ZR_THREEMF_NOTE_COUNT] = {
#define TEXT(ID, uri, is_read, text)                                                                                   \
    [ZR_THREEMF_NOTE_SPACES + ZR_THREEMF_SPACE_##ID] = "elements of " text " are not drawn",
    ZR_THREEMF_SPACES(TEXT)
#undef TEXT
        [ZR_THREEMF_NOTE_UNKNOWN] = "elements are not known",
    [ZR_THREEMF_NOTE_REQUIRED] = "required extensions are not read, so parts may be missing",
    [ZR_THREEMF_NOTE_IMAGE] = "textures have no image in the archive, and are not drawn",
    [ZR_THREEMF_NOTE_TILES] = "triangles extend beyond textures of the tilestyle none, whose edges are repeated",
    [ZR_THREEMF_NOTE_LAYERS] =
        "multiproperties have several textures or a translucent colour over one; the last texture is drawn",
    [ZR_THREEMF_NOTE_NO_LAYER] = "layers of multiproperties name no property, and are not drawn",
    [ZR_THREEMF_NOTE_OVER] = "translucent textures lie over colours of multiproperties, which are not drawn",
    [ZR_THREEMF_NOTE_PLAIN] = "objects have some triangles without a colour, which are drawn white",
    [ZR_THREEMF_NOTE_CLEAR] = "objects have only materials or colours of alpha 0, and are drawn opaque",
    [ZR_THREEMF_NOTE_PAINT] = "triangles have unknown paint, which is not drawn",
    [ZR_THREEMF_NOTE_EXTRUDER] = "objects have extruders without a filament, and the colour of the first one",
    [ZR_THREEMF_NOTE_PAINTED] = "triangles are painted for a slicer (paint_color), and the file names no colours",
    [ZR_THREEMF_NOTE_OTHER] = "items or components of the type other are left out",
    [ZR_THREEMF_NOTE_MODIFIER] = "parts or triangles are modifiers of a slicer, and are left out",
    [ZR_THREEMF_NOTE_NOT_PRINTED] = "items are marked as not printable, and are drawn",
    [ZR_THREEMF_NOTE_UNIT] = "parts have a different unit from the first, to which their coordinates are converted",
    [ZR_THREEMF_NOTE_HOLE] = "vertices are not finite, and their triangles are left out"};

static bool is_about_color(int note)
{
    return note >= ZR_THREEMF_NOTE_WORDS && note <= ZR_THREEMF_NOTE_PAINTED;
}

static void warn(const struct zr_threemf *file, struct zr_scene_builder *builder)
{
    for (int i = 0; i < ZR_THREEMF_NOTE_COUNT; i++) {
        if (file->notes[i].count == 0) continue;
        const struct zr_zip_member *member = zr_threemf_parts(file)[file->notes[i].part].member;
        const struct zr_xml_text word = file->notes[i].word;
        const bool has_word = i < ZR_THREEMF_NOTE_WORDS;
        zr_warning_list_add(builder->arena, is_about_color(i) ? &builder->color_warnings : &builder->warnings,
                            "3MF: %" PRIu64 " %s; the first is in %.*s, line %zu%s%s", file->notes[i].count, texts[i],
                            (int)(member->name_length < 80 ? member->name_length : 80), member->name,
                            file->notes[i].line, has_word ? ": " : "",
                            has_word ? zr_quote(word.at, word.length).text : "");
    }
}

/* ---- interface ---- */

static const struct zr_zip_member *root_of(const struct zr_threemf *file)
{
    return zr_threemf_parts(file)[0].member;
}

/* True beyond a limit of struct zr_quick. */
static bool is_slow(const struct zr_threemf *file)
{
    const struct zr_quick *quick = file->zip.unpacked->quick;
    return quick && quick->is_exceeded;
}

static enum zr_status read_parts(struct zr_threemf *file)
{
    if (zr_threemf_find_root(file)) {
        file->part_of_member = zr_arena_alloc(file->arena, file->zip.count, sizeof *file->part_of_member);
        if (!file->part_of_member) return ZR_NO_MEMORY;
        memset(file->part_of_member, 0xFF, file->zip.count * sizeof *file->part_of_member);
        file->part_of_member[root_of(file) - file->zip.members] = 0;
        zr_threemf_read_slicer(file);
        for (uint32_t i = 0; i < file->parts.count && !zr_threemf_stops(file); i++)
            zr_threemf_read_part(file, i);
    }
    if (zr_is_cancelled(file->cancel) || is_slow(file)) return ZR_CANCELLED;
    if (!zr_arena_ok(file->arena)) return ZR_NO_MEMORY;
    return file->error->count > 0 ? file->error->status : ZR_OK;
}

enum zr_status zr_read_3MF(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_arena *arena = builder->arena;
    struct zr_reason reason = {""};
    struct zr_threemf *file = zr_arena_zero(arena, 1, sizeof *file);
    if (!file) return ZR_NO_MEMORY;
    file->arena = arena;
    file->limits = limits;
    file->cancel = request->cancel;
    file->error = error;
    enum zr_status status = zr_zip_open(arena, request->bytes, request->size, &file->zip, &reason);
    if (status == ZR_BAD_SYNTAX) return zr_error_add(error, status, NULL, "a broken ZIP archive: %s", reason.text);
    if (status == ZR_OK) {
        *file->zip.unpacked = (struct zr_unpacked){.quick = request->quick, .bytes_max = limits->unpacked_bytes_max};
        status = read_parts(file);
    }
    if (status == ZR_OK) status = zr_threemf_place(file, builder, request);
    if (status == ZR_OK && is_slow(file)) status = ZR_CANCELLED;
    if (status != ZR_OK) return status;
    warn(file, builder);
    if (file->is_unnamed)
        zr_warning_list_add(arena, &builder->warnings,
                            "3MF: no relationship of _rels/.rels leads to a 3D model; %s is drawn, the only one",
                            zr_quote(root_of(file)->name, root_of(file)->name_length).text);
    builder->scene->file.unit = zr_threemf_parts(file)[0].unit;
    return status;
}
