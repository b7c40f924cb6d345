/* zip_read.h - input: members of a ZIP archive in memory, found by name.
 *
 * Safe:   the directory is checked as a whole before a member is read: members do not overlap each other or the
 *         directory, and their sizes fit the archive. A member's memory is allocated by the size in the directory, and
 *         inflating stops beyond that size. Names are relative, without ".." or duplicates; backslashes in
 *         them are read as slashes.
 * Source: PKWARE, APPNOTE.TXT 6.3.10; ZIP64 is read. RFC 1951 for deflate.
 */
#ifndef ZR_ZIP_READ_H
#define ZR_ZIP_READ_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/status.h"
#include "core.h"
#include "input/text/text.h"

enum { ZR_ZIP_MEMBERS_MAX = 65535, ZR_ZIP_NAME_MAX = 1024 };

struct zr_zip_member {
    const char *name; /* in the archive; no terminating zero */
    size_t name_length;
    const char *packed; /* in the archive */
    uint64_t packed_size, size;
    uint32_t crc, method;
    size_t offset;                /* of its local header */
    struct zr_unpacked *unpacked; /* of the archive */
};

/* Bytes read from one archive, and their limits. */
struct zr_unpacked {
    struct zr_quick *quick; /* limits of the request; may be NULL */
    uint64_t bytes, bytes_max;
};

struct zr_zip {
    size_t count;                  /* without folders */
    struct zr_zip_member *members; /* sorted by name: ASCII case is ignored first, then decides */
    struct zr_unpacked *unpacked;  /* in the arena; without limits until the caller sets them */
};

/* True if the bytes begin with a local header, as an archive with members does. */
bool zr_zip_is(const char *bytes, size_t size);

/* Reads the directory. Fails with ZR_BAD_SYNTAX and a reason, ZR_NO_MEMORY or ZR_CANCELLED (arena->cancel). The
 * archive must outlive *zip. */
enum zr_status zr_zip_open(struct zr_arena *arena, const char *bytes, size_t size, struct zr_zip *zip,
                           struct zr_reason *reason);

/* Finds a member by its exact name, else the first whose name differs only in ASCII case. NULL if there is none. */
const struct zr_zip_member *zr_zip_find(const struct zr_zip *zip, const char *name, size_t length);

/* Sets *bytes to the member's member->size bytes: in the archive if they are stored, else inflated in the arena.
 * Fails as zr_zip_open does, with ZR_BAD_SCENE and a reason beyond unpacked->bytes_max, and with ZR_CANCELLED beyond the
 * limit of struct zr_quick. */
enum zr_status zr_zip_read(const struct zr_zip_member *member, struct zr_arena *arena, const char **bytes,
                           struct zr_reason *reason);

/* ---- members of a ZIP body, unpacked when they are used ---- */

/* A member that may be unpacked. */
struct zr_packed {
    const struct zr_zip_member *member;
    const char *path;      /* path in the archive */
    bool is_closed;        /* the scene is kept: unused members cannot be unpacked any more */
    enum zr_status status; /* result of zr_zip_read */
    const char *reason;    /* reason of ZR_BAD_SYNTAX and ZR_BAD_SCENE */
    struct zr_asset asset; /* the unpacked file; bytes NULL before */
};

/* Returns the unpacked member. NULL after a fault, which zr_zip_body_check reports. */
const struct zr_asset *zr_packed_open(struct zr_packed *packed, struct zr_arena *arena);

#endif
