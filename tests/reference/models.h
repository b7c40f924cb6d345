/* models.h - reference: real meshes, from several sides, large and small. */
#ifndef ZR_TEST_MODELS_H
#define ZR_TEST_MODELS_H

#include "reference/harness.h"
#include "reference/report.h"

/* Draws each model found in `directory`; one that is missing is named on stderr
 * and left out, but where none is there, nothing is proved. */
enum verdict models_check(struct harness *harness, struct report *report, const char *directory, struct tally *sum);

#endif
