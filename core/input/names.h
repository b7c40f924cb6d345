/* names.h - input: the words that a scene and a query may use. */
#ifndef ZR_NAMES_H
#define ZR_NAMES_H

#include "base/status.h"

/* Words in the order of the enum that they name. Behind the `count` words that
 * work come, up to `all`, those that the contract has and this version lacks, so
 * that they are refused as such and not as misspelt. */
struct zr_names {
    int count, all;
    const char *const *words;
    const char *others; /* what those behind are, where they are not just what this version lacks */
};

/* Fills a struct zr_names from an array of words of which the first `works` work. */
#define ZR_NAMES(works, array)                                                                                         \
    {                                                                                                                  \
        (works), (int)(sizeof(array) / sizeof((array)[0])), (array), NULL                                              \
    }

/* The index of a word, below `all`, or -1. Case matters. */
int zr_names_find(const struct zr_names *names, const char *word);

/* What a query parameter says: the index of a word that works, or -1 after reporting ZR_BAD_REQUEST. */
int zr_names_of_query(const char *parameter, const struct zr_names *names, const char *word, struct zr_error *error);

/* Those that work, for a message: "a, b, c". */
struct zr_names_text {
    char text[440];
};
struct zr_names_text zr_names_join(const struct zr_names *names);

/* Why a word is none of those that work. */
struct zr_names_refusal {
    char text[400];
};
struct zr_names_refusal zr_names_refuse(const struct zr_names *names, const char *word);

/* Why a word is no look. */
struct zr_names_refusal zr_looks_refuse(const char *word);

extern const struct zr_names zr_shading_names;    /* enum zr_shading */
extern const struct zr_names zr_alpha_mode_names; /* enum zr_alpha_mode */
extern const struct zr_names zr_preset_names;     /* enum zr_preset */
extern const struct zr_names zr_algorithm_names;  /* enum zr_algorithm */
extern const struct zr_names zr_up_names;         /* the axis that is up: y, z */
extern const struct zr_names zr_colormap_names;   /* enum zr_colormap */
extern const struct zr_names zr_compress_names;   /* enum zr_compress */

#endif
