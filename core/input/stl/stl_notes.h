/* stl_notes.h - input: counts the oddities of ASCII STL that do not stop reading. Each kind causes one warning. */
#ifndef ZR_STL_NOTES_H
#define ZR_STL_NOTES_H

#include <stddef.h>

#include "scene/scene_builder.h"

enum zr_stl_oddity {
    ZR_STL_CR,        /* lines that end in CR alone */
    ZR_STL_COMMENT,   /* comment lines */
    ZR_STL_COLOR,     /* colour lines */
    ZR_STL_UNKNOWN,   /* other lines between facets */
    ZR_STL_WORDS,     /* extra words after a keyword and its numbers */
    ZR_STL_SPLIT_END, /* "end loop" */
    ZR_STL_NO_NORMAL, /* facets without three words after "normal" */
    ZR_STL_POLYGON,   /* facets of more than three corners */
    ZR_STL_NO_SOLID,  /* facets outside of a solid */
    ZR_STL_NO_END,    /* solids without "endsolid" */
    ZR_STL_ODDITIES
};

struct zr_stl_note {
    size_t count, line; /* `line`: of the first one */
    const char *at;     /* text of the first one up to the end of its line, or NULL */
    size_t size;
};

/* Initially all zero. */
struct zr_stl_notes {
    struct zr_stl_note of[ZR_STL_ODDITIES];
};

void zr_stl_notes_warn(const struct zr_stl_notes *notes, struct zr_scene_builder *builder);

#endif
