#include "input/stl/stl_notes.h"

#include <stdio.h>

#include "input/text/text.h"

static const struct {
    const char *one, *many; /* "1 comment line", "2 comment lines" */
    const char *what;
} rows[ZR_STL_ODDITIES] = {
    [ZR_STL_CR] = {"line", "lines", "that end in CR alone"},
    [ZR_STL_COMMENT] = {"comment line", "comment lines", "ignored"},
    [ZR_STL_COLOR] = {"colour line", "colour lines", "ignored"},
    [ZR_STL_UNKNOWN] = {"unknown line", "unknown lines", "ignored"},
    [ZR_STL_WORDS] = {"line", "lines", "with words that are ignored"},
    [ZR_STL_SPLIT_END] = {"keyword", "keywords", "in two words"},
    [ZR_STL_NO_NORMAL] = {"facet", "facets", "without a normal of three numbers"},
    [ZR_STL_POLYGON] = {"facet", "facets", "of more than three corners"},
    [ZR_STL_NO_SOLID] = {"solid", "solids", "without 'solid'"},
    [ZR_STL_NO_END] = {"solid", "solids", "without 'endsolid'"},
};

void zr_stl_notes_warn(const struct zr_stl_notes *notes, struct zr_scene_builder *builder)
{
    for (int i = 0; i < ZR_STL_ODDITIES; i++) {
        const struct zr_stl_note *note = &notes->of[i];
        if (note->count == 0) continue;
        const struct zr_quote quote = zr_quote(note->at ? note->at : "", note->size);
        zr_warning_list_add(builder->arena, &builder->warnings, "STL: %zu %s %s, %sline %zu%s%s", note->count,
                            note->count == 1 ? rows[i].one : rows[i].many, rows[i].what,
                            note->count == 1 ? "" : "the first in ", note->line, note->size ? ": " : "",
                            note->size ? quote.text : "");
    }
}
