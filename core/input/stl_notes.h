/* stl_notes.h - input: notes what is odd in the text of ASCII STL and drawn nevertheless; one warning for each kind. */
#ifndef ZR_STL_NOTES_H
#define ZR_STL_NOTES_H

#include <stddef.h>

#include "scene/scene_builder.h"

enum zr_stl_oddity {
    ZR_STL_CR,        /* lines that end in CR alone */
    ZR_STL_COMMENT,   /* comment lines */
    ZR_STL_COLOR,     /* colour lines */
    ZR_STL_UNKNOWN,   /* other lines between facets */
    ZR_STL_WORDS,     /* words behind a keyword and its numbers */
    ZR_STL_SPLIT_END, /* "end loop" */
    ZR_STL_NO_NORMAL, /* facets without three words behind "normal" */
    ZR_STL_POLYGON,   /* facets of more than three corners */
    ZR_STL_NO_SOLID,  /* facets behind "endsolid" without "solid" */
    ZR_STL_NO_END,    /* solids without "endsolid" */
    ZR_STL_ODDITIES
};

struct zr_stl_note {
    size_t count, line; /* line of the first */
    const char *at;     /* its text, up to the end of the line; or NULL */
    size_t size;
};

/* Initially all zero. */
struct zr_stl_notes {
    struct zr_stl_note of[ZR_STL_ODDITIES];
};

void zr_stl_notes_warn(const struct zr_stl_notes *notes, struct zr_scene_builder *builder);

#endif
