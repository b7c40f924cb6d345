/* site.h - files compiled into the daemon: the page at "/", examples of scenes, and the manual below "/docs/".
 *
 * The build makes the tables (server/page/build.sh, server/manual/build.sh). All text is compressed by gzip. */
#ifndef ZRASTERD_SITE_H
#define ZRASTERD_SITE_H

#include <stddef.h>

struct site_file {
    const char *name;          /* "": the page; of the manual: address below /docs/, "": its first page */
    const char *title, *files; /* of a scene: name for people; names of its files, as items of JSON; NULL: no scene */
    const char *type;
    const char *tag; /* hash of the bytes, hexadecimal */
    const unsigned char *bytes;
    size_t size, plain_size; /* compressed, decompressed; plain_size 0: not compressed */
};

/* Made by the build. The first file is the page, the second one the page that draws by itself, too (engine.h). */
extern const struct site_file site_files[];
extern const size_t site_file_count;
extern const char *const site_policies[]; /* Content-Security-Policy of the first two files */
extern const struct site_file manual_files[];
extern const size_t manual_file_count;

#endif
