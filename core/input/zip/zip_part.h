/* zip_part.h - input: members of a ZIP body, unpacked when they are used. */
#ifndef ZR_ZIP_PART_H
#define ZR_ZIP_PART_H

#include "core.h"
#include "input/zip/zip_read.h"

/* Bytes unpacked from one archive, and their limit. */
struct zr_unpacked {
    struct zr_quick *quick; /* limits of the request; may be NULL */
    uint64_t bytes;
};

/* A member that may be unpacked. */
struct zr_packed {
    struct zr_unpacked *unpacked; /* shared by all members */
    const struct zr_zip_member *member;
    const char *path;      /* path in the archive */
    bool is_closed;        /* the scene is kept: unused members cannot be unpacked any more */
    enum zr_status status; /* result of unpacking; ZR_CANCELLED also beyond the limit of struct zr_quick */
    const char *reason;    /* reason of ZR_BAD_SYNTAX */
    struct zr_asset asset; /* the unpacked file; bytes NULL before */
};

/* Unpacks a member as zr_zip_read does. Returns ZR_CANCELLED beyond the limit of struct zr_quick. */
enum zr_status zr_unpack(struct zr_unpacked *unpacked, const struct zr_zip_member *member, struct zr_arena *arena,
                         const char **bytes, struct zr_reason *reason);

/* Returns the unpacked member. NULL after a fault, which zr_zip_body_check reports. */
const struct zr_asset *zr_packed_open(struct zr_packed *packed, struct zr_arena *arena);

#endif
