/* unknown.h - unknown names of settings: the nearest known one, and variables of other programs. */
#ifndef ZRASTERD_UNKNOWN_H
#define ZRASTERD_UNKNOWN_H

#include <stdbool.h>
#include <stddef.h>

enum { UNKNOWN_HINT_SIZE = 128 };

/* Where a name was read, which decides its form. */
enum unknown_form { UNKNOWN_KEY, UNKNOWN_VARIABLE, UNKNOWN_FLAG };

/* Writes "did you mean --port?" or "--help lists the known ones". `name` has no -- or ZRASTER_ before it. */
void unknown_hint(char hint[UNKNOWN_HINT_SIZE], enum unknown_form form, const char *name, size_t length);

/* Returns true for a variable ZRASTER_... of other programs: of the command, of the library, of files of server/deploy,
 * and of Kubernetes, which sets some in every pod beside a service whose name begins with zraster. */
bool unknown_is_others(const char *name, size_t length, const char *value);

#endif
