/* assets.h - a directory for a daemon's assets, and requests about them. A failure here fails
 * the running test.
 */
#ifndef TEST_ASSETS_H
#define TEST_ASSETS_H

#include "problems.h"

enum { ASSET_NAME_SIZE = 65, ASSET_TARGET_SIZE = 128, FOLDER_SIZE = 256 };

#define ABC_NAME   "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad" /* of "abc": FIPS 180-2, B.1 */
#define EMPTY_NAME "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"

/* An empty directory of its own, and a path in it. */
struct folder {
    char path[FOLDER_SIZE];
};
struct folder folder_make(void);
struct folder folder_file(const struct folder *folder, const char *name);
/* How many files are in it, all kinds and hidden ones too. */
int folder_count(const struct folder *folder);
/* Writes the whole of a file in it, old or new. */
void folder_write(const struct folder *file, const void *bytes, size_t size);
/* With all files in it. */
void folder_remove(const struct folder *folder);

/* A daemon that keeps assets there; `flags` as for daemon_start. */
struct daemon assets_start(const struct folder *folder, const char *const *flags);

struct reply asset_put(const struct daemon *daemon, const char *name, const void *bytes, size_t size);
struct reply asset_get(const struct daemon *daemon, const char *name);
long asset_status(const struct daemon *daemon, const char *name);

/* POSTs it; the status must be this one. Its name. */
struct asset_name {
    char text[ASSET_NAME_SIZE];
};
struct asset_name asset_post(const struct daemon *daemon, const void *bytes, size_t size, long status);

#endif
