/* zip_part.h - input: members of a ZIP body, unpacked when they are used. */
#ifndef ZR_ZIP_PART_H
#define ZR_ZIP_PART_H

#include "core.h"
#include "input/zip_read.h"

/* What is unpacked of an archive. */
struct zr_unpacked {
    struct zr_quick *quick; /* the request's; may be NULL */
    uint64_t bytes;
};

/* A member that may be unpacked. */
struct zr_packed {
    struct zr_unpacked *unpacked; /* of all members */
    const struct zr_zip_member *member;
    const char *path;      /* in the archive */
    bool is_closed;        /* a kept scene is read: members that were not used cannot be any more */
    enum zr_status status; /* of unpacking; ZR_CANCELLED also beyond the limit of struct zr_quick */
    const char *reason;    /* of ZR_BAD_SYNTAX */
    struct zr_asset asset; /* unpacked; bytes NULL before */
};

/* Unpacks a member as zr_zip_read does. Returns ZR_CANCELLED beyond the limit of struct zr_quick. */
enum zr_status zr_unpack(struct zr_unpacked *unpacked, const struct zr_zip_member *member, struct zr_arena *arena,
                         const char **bytes, struct zr_reason *reason);

/* Returns the unpacked member. NULL after a fault, which zr_zip_body_check reports. */
const struct zr_asset *zr_packed_open(struct zr_packed *packed, struct zr_arena *arena);

#endif
