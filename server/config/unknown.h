/* unknown.h - names of settings that are none: what was meant, and variables that are others'. */
#ifndef ZRASTERD_UNKNOWN_H
#define ZRASTERD_UNKNOWN_H

#include <stdbool.h>
#include <stddef.h>

enum { UNKNOWN_HINT_SIZE = 128 };

/* What the name of a setting looks like where it was read. */
enum unknown_form { UNKNOWN_KEY, UNKNOWN_VARIABLE, UNKNOWN_FLAG };

/* Writes "did you mean --port?" or "--help lists the known ones". `name` has no -- or ZRASTER_ before it. */
void unknown_hint(char hint[UNKNOWN_HINT_SIZE], enum unknown_form form, const char *name, size_t length);

/* Returns true for a variable ZRASTER_... that the daemon is not asked to know: of the command, of the library and of
 * files of server/deploy, and those that Kubernetes sets in every pod beside a service whose name begins with zraster.
 */
bool unknown_is_others(const char *name, size_t length, const char *value);

#endif
