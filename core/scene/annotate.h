/* annotate.h - scene: dimensions, labels and other marks over the output color (overlay/annotate). */
#ifndef ZR_SCENE_ANNOTATE_H
#define ZR_SCENE_ANNOTATE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum zr_annotation {
    ZR_ANNOTATE_BOX,    /* dimensions of the bounds, along the axes */
    ZR_ANNOTATE_TITLE,  /* name, size and unit */
    ZR_ANNOTATE_TRIAD,  /* axes of the file */
    ZR_ANNOTATE_SCALE,  /* scale bar of parallel views */
    ZR_ANNOTATE_LABELS, /* names of parts, with leader lines */
    ZR_ANNOTATE_HOLES,  /* notes of holes, with leader lines */
    ZR_ANNOTATE_COUNT
};

/* Below this side, pixels, nothing is annotated. */
enum { ZR_ANNOTATE_SIDE = 200, ZR_DIMENSIONS_MAX = 64, ZR_PLACE_MARKS_MAX = 64 };

enum zr_dimension_kind {
    ZR_DIMENSION_LENGTH,
    ZR_DIMENSION_RADIUS,   /* from the centre of a circle to a place on it */
    ZR_DIMENSION_DIAMETER, /* likewise */
    ZR_DIMENSION_ANGLE     /* between the ways from `at` to both ends */
};

/* An end of a dimension: a place, a hole or a pixel. */
struct zr_dimension_end {
    zr_vec3 place;
    bool is_hole, is_pick; /* else the place */
    uint32_t hole, index;  /* number of a group of holes of the part, and of a hole in it; the end is its entry */
    const char *part;      /* NULL: the first part with holes */
    uint32_t pixel[2];     /* the end is the point of its surface */
};

/* A dimension between two ends. */
struct zr_dimension {
    int kind; /* enum zr_dimension_kind */
    struct zr_dimension_end from, to, at;
    bool has_at;
    bool has_to;       /* false: of a radius or diameter from a hole, which has its own circle */
    int along;         /* 0 to 2: the distance along this axis of the file; -1: the distance */
    const char *label; /* instead of the length, UTF-8; NULL: none */
};

/* A numbered place. */
struct zr_place_mark {
    zr_vec3 at;
    const char *text; /* UTF-8 */
};

enum zr_bar_room { ZR_BAR_NO_ROOM, ZR_BAR_ROOM_RIGHT, ZR_BAR_ROOM_LEFT };

struct zr_annotate {
    uint32_t words;    /* bit i: enum zr_annotation i */
    const char *title; /* NULL: names of the scene */
    uint32_t dimension_count;
    const struct zr_dimension *dimensions;
    uint32_t mark_count;
    const struct zr_place_mark *marks;
    enum zr_bar_room bar_room; /* fitted views leave room for a colour bar */
    uint32_t label_letters;    /* characters of the longest label of a part; 0: unknown, some are assumed */
};

static inline bool zr_annotate_has(const struct zr_annotate *annotate, enum zr_annotation word)
{
    return annotate->words >> word & 1u;
}

static inline bool zr_annotate_is_on(const struct zr_annotate *annotate)
{
    return annotate->words != 0 || annotate->dimension_count > 0 || annotate->mark_count > 0;
}

/* True if marks need the holes of parts: notes, or ends of dimensions. */
static inline bool zr_annotate_needs_features(const struct zr_annotate *annotate)
{
    for (uint32_t i = 0; i < annotate->dimension_count; i++) {
        const struct zr_dimension *d = &annotate->dimensions[i];
        if (d->from.is_hole || d->to.is_hole || d->at.is_hole) return true;
    }
    return zr_annotate_has(annotate, ZR_ANNOTATE_HOLES);
}

/* True if a window of these sides has marks. */
static inline bool zr_annotate_fits(const struct zr_annotate *annotate, uint32_t width, uint32_t height)
{
    return zr_annotate_is_on(annotate) && width >= ZR_ANNOTATE_SIDE && height >= ZR_ANNOTATE_SIDE;
}

#endif
