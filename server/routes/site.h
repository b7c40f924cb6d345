/* site.h - files compiled into the daemon: the page at "/", examples of scenes, and the manual below "/docs/".
 *
 * The build makes the tables (server/page/build.sh, server/manual/build.sh). All text is compressed by gzip. */
#ifndef ZRASTERD_SITE_H
#define ZRASTERD_SITE_H

#include "site_file.h"

/* Made by the build. The first file is the page, the second one the page that draws by itself, too (engine.h). */
extern const struct site_file site_files[];
extern const size_t site_file_count;
extern const char *const site_policies[]; /* Content-Security-Policy of the first two files */
extern const struct site_file manual_files[];
extern const size_t manual_file_count;

#endif
