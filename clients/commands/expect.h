/* expect.h - client: `zraster info --expect`: facts of a model beside the expected ones. */
#ifndef EXPECT_H
#define EXPECT_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "files/bytes.h"

/* Reads the expected facts: JSON, or the name of a file with it. Returns NULL with a line in *faults on failure, which
 * has the JSON pointer of a wrong value. The caller deletes it. Keys:
 *   box        sides along x, y and z of the file
 *   volume, area, triangles, closed
 *   holes      list of {diameter, count}: exactly `count` holes have this diameter; empty: there are none
 *   tolerance  largest difference of lengths, and of volumes by area; else a thousandth of each value */
cJSON *expect_read(const char *text, struct bytes *faults);

/* Prints a row for each expected fact: pass or FAIL, or a JSON object; and why, if the model has no such fact. Hidden
 * parts do not count. Returns true if all pass. */
bool expect_print(const cJSON *facts, const cJSON *expected, bool as_json);

#endif
