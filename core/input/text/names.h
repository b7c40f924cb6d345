/* names.h - input: words of enums in scenes and queries. */
#ifndef ZR_NAMES_H
#define ZR_NAMES_H

#include <stdint.h>

#include "base/status.h"

/* Words of an enum, in its order. The first `count` are supported. The others, up to `all`, are in the contract, but
 * not in this version: the refusal says so instead of calling them unknown. */
struct zr_names {
    int count, all;
    const char *const *words;
    const char *others; /* continues "WORD is ..." for unsupported words; NULL: "not supported in this version" */
};

/* Initialises a struct zr_names from an array; the first `works` words are supported. */
#define ZR_NAMES(works, array)                                                                                         \
    {                                                                                                                  \
        (works), (int)(sizeof(array) / sizeof((array)[0])), (array), NULL                                              \
    }

/* Returns the index of a word, below `all`, or -1. Case matters. */
int zr_names_find(const struct zr_names *names, const char *word);

/* Returns the index of a supported word, or -1 after reporting ZR_BAD_REQUEST for the query parameter. */
int zr_names_of_query(const char *parameter, const struct zr_names *names, const char *word, struct zr_error *error);

/* Lists the supported words, for a message: "a, b, c". */
struct zr_names_text {
    char text[960];
};
struct zr_names_text zr_names_join(const struct zr_names *names);

/* Lists the words whose bits are in `set`. */
struct zr_names_text zr_names_join_set(const struct zr_names *names, uint32_t set);

/* Appends a word, after ", " unless it is the first. */
void zr_names_text_add(struct zr_names_text *text, const char *word);

/* Explains why a word is refused. */
struct zr_names_refusal {
    char text[400];
};
struct zr_names_refusal zr_names_refuse(const struct zr_names *names, const char *word);

/* The same for the name of a look. */
struct zr_names_refusal zr_looks_refuse(const char *word);

extern const struct zr_names zr_shading_names;    /* enum zr_shading */
extern const struct zr_names zr_alpha_mode_names; /* enum zr_alpha_mode */
extern const struct zr_names zr_preset_names;     /* enum zr_preset */
extern const struct zr_names zr_algorithm_names;  /* enum zr_algorithm */
extern const struct zr_names zr_light_names;      /* enum zr_light_type */
extern const struct zr_names zr_up_names;         /* the up axis: y, z */
extern const struct zr_names zr_annotation_names; /* enum zr_annotation */
extern const struct zr_names zr_mesh_up_names;    /* enum zr_mesh_up */
extern const struct zr_names zr_colormap_names;   /* enum zr_colormap */
extern const struct zr_names zr_compress_names;   /* enum zr_compress */

#endif
