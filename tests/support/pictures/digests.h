/* digests.h - support: hashes of pictures, compared with those in a committed file.
 *
 *     FILE *rows = digests_open();
 *     digests_add(rows, name, frame);     a row for each picture: its name and a hash per channel
 *     digests_check(rows, path);          fails the running test if the file has other rows
 *
 * DIGESTS=write writes the file anew, after a change of the rules or of the scenes.
 */
#ifndef ZR_TEST_DIGESTS_H
#define ZR_TEST_DIGESTS_H

#include <stdio.h>

#include "shade/frame.h"

/* Rows in memory. */
FILE *digests_open(void);

/* FNV-1a of each channel, word by word, in 32 bits. */
void digests_add(FILE *rows, const char *name, const struct zr_frame *frame);

/* Closes the rows; compares nothing if `path` is NULL. */
void digests_check(FILE *rows, const char *path);

#endif
