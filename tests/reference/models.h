/* models.h - reference: real meshes, from several sides, large and small. */
#ifndef ZR_TEST_MODELS_H
#define ZR_TEST_MODELS_H

#include "reference/drawing.h"
#include "reference/page/report.h"

/* The model NAME.obj of `directory`, with colours made from its normals, seen from
 * `view` in a window of this size. False, explained on stderr, where it cannot be
 * read. drawing_free in any case. */
enum { MODELS_VIEWS = 3 };
bool models_drawing(struct drawing *drawing, const char *directory, const char *name, size_t view, uint32_t width,
                    uint32_t height);

/* Looks at the whole drawing from `view`, in a window of this size. */
void models_look(struct drawing *drawing, size_t view, uint32_t width, uint32_t height);

/* Draws each model found in `directory`; one that is missing is named on stderr
 * and left out, but where none is there, nothing is proved. */
enum verdict models_check(struct harness *harness, struct report *report, const char *directory, struct tally *sum);

#endif
