/* options.h - reference: what the command line of zraster-verify says. */
#ifndef ZR_TEST_OPTIONS_H
#define ZR_TEST_OPTIONS_H

#include "reference/page/report.h"

struct options {
    uint64_t triangles, seed;
    uint64_t floats;               /* triangles whose results are compared as floats (floats.h); 0: none */
    const char *kind;              /* NULL: all */
    const char *models, *pictures; /* NULL: none */
    const char *page, *title;      /* NULL: no page */
    bool plain;                    /* the page has pictures of differences only */
    const char *preset;            /* of bare meshes */
    const char *mutant;            /* NULL: none */
    const char *without;           /* likewise */
    bool line_rule;                /* to be printed, and that is all */
    struct harness_options harness;
    enum report_style style;
    int path_count;
    char *const *paths; /* files and folders; where there are some, random polygons take --triangles or --kind */
    bool random;        /* random polygons are wanted */
};

/* False where the line is not understood, or asks for help: options_usage is to be shown. */
bool options_parse(int argc, char **argv, struct options *options);
extern const char options_usage[];

#endif
