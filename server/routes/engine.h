/* engine.h - the package for JavaScript, with which the page draws by itself while a model turns.
 *
 * The files of --engine-dir are read at the start, and served below /engine/. */
#ifndef ZRASTERD_ENGINE_H
#define ZRASTERD_ENGINE_H

#include <stdbool.h>
#include <stddef.h>

#include "site_file.h"

struct config;
struct engine; /* constant after engine_read */

/* Reads the files that the page needs, and compresses them. Returns NULL if one cannot be read; `message` names it and
 * the reason. Without --engine-dir, the engine has no files. Free with engine_free, which takes NULL, too. */
struct engine *engine_read(const struct config *config, char *message, size_t message_size);
void engine_free(struct engine *engine);

/* Returns true if there are files. */
bool engine_is_there(const struct engine *engine);

/* Returns the file of that name, NULL if there is none. */
const struct site_file *engine_find(const struct engine *engine, const char *name);

#endif
