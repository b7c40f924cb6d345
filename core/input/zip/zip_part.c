#include "input/zip/zip_part.h"

enum zr_status zr_unpack(struct zr_unpacked *unpacked, const struct zr_zip_member *member, struct zr_arena *arena,
                         const char **bytes, struct zr_reason *reason)
{
    struct zr_quick *quick = unpacked->quick;
    unpacked->bytes += member->size;
    if (!quick || unpacked->bytes <= quick->array_bytes_max) return zr_zip_read(member, arena, bytes, reason);
    quick->is_exceeded = true;
    return ZR_CANCELLED;
}

const struct zr_asset *zr_packed_open(struct zr_packed *packed, struct zr_arena *arena)
{
    struct zr_reason reason = {""};
    const char *bytes;
    if (packed->asset.bytes) return &packed->asset;
    if (packed->is_closed || packed->status != ZR_OK) return NULL;
    packed->status = zr_unpack(packed->unpacked, packed->member, arena, &bytes, &reason);
    if (packed->status == ZR_BAD_SYNTAX) packed->reason = zr_arena_copy(arena, reason.text, sizeof reason.text);
    if (packed->status != ZR_OK) return NULL;
    packed->asset.bytes = bytes;
    return &packed->asset;
}
