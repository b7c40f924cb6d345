#include "input/obj/obj_file.h"
#include "input/text/text.h"

struct words {
    const char *one, *many; /* text after the number */
    bool names_first;       /* quotes the first statement */
};

static const struct words all_words[ZR_OBJ_NOTES] = {
    [ZR_OBJ_NOTE_MAPS] = {"statement of maps without a material (maplib, usemap) is not drawn",
                          "statements of maps without a material (maplib, usemap) are not drawn", true},
    [ZR_OBJ_NOTE_CALLS] = {"other file (call, csh) is not read", "other files (call, csh) are not read", true},
    [ZR_OBJ_NOTE_CURVES] = {"statement of curves and surfaces is not drawn",
                            "statements of curves and surfaces are not drawn", true},
    [ZR_OBJ_NOTE_UNKNOWN] = {"line is not known", "lines are not known", true},
    [ZR_OBJ_NOTE_NAMES] = {"name ends in a backslash, and does not continue on the next line",
                           "names end in a backslash, and do not continue on the next line", true},
    [ZR_OBJ_NOTE_RETURNS] = {"line ends in a carriage return alone", "lines end in a carriage return alone", false},
    [ZR_OBJ_NOTE_SHORT_FACES] = {"face has fewer than three corners, and is not drawn",
                                 "faces have fewer than three corners, and are not drawn", true},
    [ZR_OBJ_NOTE_EMPTY_INDICES] = {"corner has nothing behind a slash", "corners have nothing behind a slash", true},
    [ZR_OBJ_NOTE_WRONG_NORMALS] = {"corner names a normal that does not exist; it is computed",
                                   "corners name normals that do not exist; they are computed", true},
    [ZR_OBJ_NOTE_WRONG_TEXCOORDS] = {"corner names a texture coordinate that does not exist; it is 0, 0",
                                     "corners name texture coordinates that do not exist; they are 0, 0", true},
    [ZR_OBJ_NOTE_BAD_NORMALS] = {"normal is not of three numbers; it is computed",
                                 "normals are not of three numbers; they are computed", true},
    [ZR_OBJ_NOTE_BAD_TEXCOORDS] = {"texture coordinate is not of numbers", "texture coordinates are not of numbers",
                                   true},
    [ZR_OBJ_NOTE_CLAMPED] = {"colour is outside of its range, and clamped",
                             "colours are outside of their range, and "
                             "clamped",
                             true},
    [ZR_OBJ_NOTE_BAD_COLORS] = {"colour is not of three numbers, and white",
                                "colours are not of three numbers, and white", true},
    [ZR_OBJ_NOTE_BAD_LINES] = {"line (l) has wrong indices, and is not drawn",
                               "lines (l) have wrong indices, and are not drawn", true},
    [ZR_OBJ_NOTE_BAD_POINTS] = {"statement of points (p) has wrong indices, and is not drawn",
                                "statements of points (p) have wrong indices, and are not drawn", true},
    [ZR_OBJ_NOTE_HOLES] = {"vertex is not finite; its faces, lines and points are left out",
                           "vertices are not finite; their faces, lines and points are left out", true},
};

/* Warnings about names, which are found after the whole text is read. */
static const struct words missing_libraries = {"material library (mtllib) is no part of the request",
                                               "material libraries (mtllib) are no parts of the request", true},
                          missing_materials = {"material (usemtl) is in no material library; its faces have the look's",
                                               "materials (usemtl) are in no material library; their faces have the "
                                               "look's",
                                               true},
                          untextured = {"face has a texture but no texture coordinates: they are 0, 0",
                                        "faces have a texture but no texture coordinates: they are 0, 0", false};

/* Sums the counts of all parts. */
static struct zr_obj_noted noted(const struct zr_obj_file *file, enum zr_obj_note note)
{
    struct zr_obj_noted all = {.count = 0};
    for (size_t i = 0; i < file->part_count; i++) {
        const struct zr_obj_noted *own = &file->parts[i].notes[note];
        if (all.count == 0) all.first = own->first;
        all.count += own->count;
    }
    return all;
}

static void warn_of(struct zr_scene_builder *builder, const struct zr_obj_noted *all, const struct words *words)
{
    const struct zr_obj_statement *first = &all->first;
    const char *text = all->count == 1 ? words->one : words->many;
    if (all->count == 0) return;
    if (words->names_first)
        zr_warning_list_add(builder->arena, &builder->warnings, "OBJ: %zu %s; %s line %zu: %s", all->count, text,
                            all->count == 1 ? "it is" : "the first is", first->line,
                            zr_quote(first->at, (size_t)(first->end - first->at)).text);
    else
        zr_warning_list_add(builder->arena, &builder->warnings, "OBJ: %zu %s", all->count, text);
}

void zr_obj_warn(const struct zr_obj_file *file, struct zr_scene_builder *builder)
{
    for (int note = 0; note < ZR_OBJ_NOTES; note++) {
        const struct zr_obj_noted all = noted(file, (enum zr_obj_note)note);
        warn_of(builder, &all, &all_words[note]);
    }
    warn_of(builder, &file->missing_libraries, &missing_libraries);
    if (file->only_library)
        zr_warning_list_add(builder->arena, &builder->warnings, "OBJ: the only material library, %s, is read instead",
                            zr_quote(file->only_library, strlen(file->only_library)).text);
    warn_of(builder, &file->missing_materials, &missing_materials);
    warn_of(builder, &file->untextured, &untextured);
    if (file->color_scale > 1.0f)
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "OBJ: the colours of vertices are taken as 0 to %g, not 0 to 1", (double)file->color_scale);
}

const struct zr_obj_statement *zr_obj_first_unknown(const struct zr_obj_file *file)
{
    for (size_t i = 0; i < file->part_count; i++)
        if (file->parts[i].notes[ZR_OBJ_NOTE_UNKNOWN].count > 0)
            return &file->parts[i].notes[ZR_OBJ_NOTE_UNKNOWN].first;
    return NULL;
}
