#include "input/obj/mtl_file.h"
#include "input/text/text.h"

static const struct {
    const char *one, *many; /* text after the number */
} words[ZR_MTL_NOTES] = {
    [ZR_MTL_NOTE_UNKNOWN] = {"line is not known", "lines are not known"},
    [ZR_MTL_NOTE_LEFT_OUT] = {"property is not drawn", "properties are not drawn"},
    [ZR_MTL_NOTE_STRAY] = {"line is before the first newmtl, and is not read",
                           "lines are before the first newmtl, and are not read"},
    [ZR_MTL_NOTE_TWICE] = {"material is defined twice; the last definition applies",
                           "materials are defined twice; the last definition applies"},
    [ZR_MTL_NOTE_BAD_VALUE] = {"line has no usable value, and is not read",
                               "lines have no usable value, and are not read"},
    [ZR_MTL_NOTE_CLAMPED] = {"value is outside of its range, and clamped",
                             "values are outside of their range, and clamped"},
    [ZR_MTL_NOTE_DISAGREE] = {"material has a d and a Tr that disagree; d applies",
                              "materials have a d and a Tr that disagree; d applies"},
    [ZR_MTL_NOTE_UNSEEN] = {"material would be invisible (d 0 or Tr 1), and is drawn opaque",
                            "materials would be invisible (d 0 or Tr 1), and are drawn opaque"},
    [ZR_MTL_NOTE_BLACK] = {"Kd of 0 would hide its map_Kd, and is taken as 1",
                           "Kd of 0 would hide their map_Kd, and are taken as 1"},
    [ZR_MTL_NOTE_BLACK_ALONE] = {"material with a Kd of 0 lacks its map_Kd, and has the default colour",
                                 "materials with a Kd of 0 lack their map_Kd, and have the default colour"},
    [ZR_MTL_NOTE_OPTION] = {"option is not drawn", "options are not drawn"},
    [ZR_MTL_NOTE_MISSING] = {"texture is no part of the request, and is not drawn",
                             "textures are no parts of the request, and are not drawn"},
    [ZR_MTL_NOTE_BAD_IMAGE] = {"texture cannot be read, and is not drawn",
                               "textures cannot be read, and are not drawn"},
    [ZR_MTL_NOTE_HEIGHTS] = {"height map is not drawn; normal maps are", "height maps are not drawn; normal maps are"},
    [ZR_MTL_NOTE_ALPHA_PLACE] =
        {"map has other options than the map that it is combined with, and is not drawn",
         "maps have other options than the maps that they are combined with, and are not drawn"},
    [ZR_MTL_NOTE_OPAQUE] = {"map_Kd has an alpha below 1 and no map_d that uses it: it is drawn opaque",
                            "map_Kd have an alpha below 1 and no map_d that uses it: they are drawn opaque"},
};

void zr_mtl_note(struct zr_mtl *mtl, enum zr_mtl_note note, const struct zr_mtl_text *first)
{
    if (mtl->notes[note].count++ == 0) mtl->notes[note].first = *first;
}

void zr_mtl_warn(struct zr_mtl *mtl)
{
    struct zr_scene_builder *builder = mtl->builder;
    for (int note = 0; note < ZR_MTL_NOTES; note++) {
        const struct zr_mtl_noted *all = &mtl->notes[note];
        if (all->count == 0) continue;
        const bool has_reason = *all->reason.text != '\0';
        zr_warning_list_add(builder->arena, &builder->color_warnings, "MTL: %zu %s; %s line %zu: %s%s%s%s", all->count,
                            all->count == 1 ? words[note].one : words[note].many,
                            all->count == 1 ? "it is" : "the first is", all->first.line,
                            zr_quote(all->first.at, (size_t)(all->first.end - all->first.at)).text,
                            has_reason ? " (" : "", all->reason.text, has_reason ? ")" : "");
    }
}
