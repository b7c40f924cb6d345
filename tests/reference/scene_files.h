/* scene_files.h - reference: scene files and bare meshes, read as a request is read.
 *
 * A path is a scene (.json), a mesh (.obj, .stl) or a folder of them, searched to its bottom, in
 * alphabetical order. Meshes are drawn fitted, from one preset view or from all.
 */
#ifndef ZR_TEST_SCENE_FILES_H
#define ZR_TEST_SCENE_FILES_H

#include "reference/gl/twins.h"

struct scene_files_options {
    const char *preset;   /* of bare meshes: a name, or "all" */
    const char *pictures; /* NULL, or the directory that gets pictures of everything */
    struct twins *twins;  /* that all channels are held against */
};

/* A file that was named and cannot be read proves nothing; one that a folder brought along, and that our
 * readers refuse, is reported and left out. */
enum verdict scene_files_check(struct harness *harness, struct report *report, const char *path,
                               const struct scene_files_options *options, struct tally *sum);

#endif
