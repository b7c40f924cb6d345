/* Reads the bytes of one member of a ZIP archive: stored, or inflated by libisal. */
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <string.h>

#include "base/cancel.h"
#include "base/isa.h"
#include "input/zip/zip_read.h"

/* AT_ONCE: bytes between two checks for cancellation, a fifth of a millisecond. */
enum { STORED = 0, DEFLATED = 8, AT_ONCE = 1 << 18 };

static enum zr_status fault(const struct zr_zip_member *member, struct zr_reason *reason, const char *text)
{
    zr_reason_give(reason, "member %s: %s", zr_quote(member->name, member->name_length).text, text);
    return ZR_BAD_SYNTAX;
}

static enum zr_status check_crc(const struct zr_zip_member *member, const char *bytes, const struct zr_cancel *cancel,
                                struct zr_reason *reason)
{
    uint32_t crc = 0;
    for (uint64_t at = 0; at < member->size; at += AT_ONCE) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        const uint64_t left = member->size - at;
        crc = crc32_gzip_refl(crc, (const unsigned char *)bytes + at, left < AT_ONCE ? left : AT_ONCE);
        zr_isa_clear_upper_halves();
    }
    return crc == member->crc ? ZR_OK : fault(member, reason, "its checksum is wrong");
}

/* Returns the number of packed bytes that the stream has not used. */
static uint64_t unused(const struct inflate_state *state, uint64_t left)
{
    return left + state->avail_in + (uint64_t)(state->read_in_length > 0 ? state->read_in_length / 8 : 0);
}

static enum zr_status inflate_all(const struct zr_zip_member *member, struct inflate_state *state, uint8_t *out,
                                  const struct zr_cancel *cancel, struct zr_reason *reason)
{
    uint64_t packed_left = member->packed_size, used = 0;
    uint8_t behind[1]; /* detects a byte beyond the size in the directory */
    isal_inflate_init(state);
    state->next_in = (uint8_t *)(uintptr_t)member->packed;
    while (state->block_state != ISAL_BLOCK_FINISH) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        if (state->avail_in == 0) {
            state->avail_in = packed_left < AT_ONCE ? (uint32_t)packed_left : AT_ONCE;
            packed_left -= state->avail_in;
        }
        const uint64_t left = member->size - used;
        const uint32_t room = left == 0 ? 1 : left < AT_ONCE ? (uint32_t)left : AT_ONCE;
        state->next_out = left == 0 ? behind : out + used;
        state->avail_out = room;
        const uint32_t in_before = state->avail_in;
        const int code = isal_inflate(state);
        zr_isa_clear_upper_halves();
        if (code != ISAL_DECOMP_OK && code != ISAL_END_INPUT)
            return fault(member, reason, "its deflated data is broken");
        const uint32_t made = room - state->avail_out;
        if (made > left) return fault(member, reason, "it inflates to more than the size in the directory");
        used += made;
        if (made == 0 && in_before == state->avail_in && state->block_state != ISAL_BLOCK_FINISH)
            return fault(member, reason, "its deflated data is cut off");
    }
    if (used != member->size) return fault(member, reason, "it inflates to less than the size in the directory");
    return unused(state, packed_left) == 0 ? ZR_OK : fault(member, reason, "bytes follow its deflated data");
}

/* Counts the bytes of a member. */
static enum zr_status count_bytes(const struct zr_zip_member *member, struct zr_reason *reason)
{
    struct zr_unpacked *unpacked = member->unpacked;
    struct zr_quick *quick = unpacked->quick;
    if (member->size > unpacked->bytes_max - unpacked->bytes) {
        zr_reason_give(reason, "with member %s, those that are read inflate to more than %llu bytes, the most allowed",
                       zr_quote(member->name, member->name_length).text, (unsigned long long)unpacked->bytes_max);
        return ZR_BAD_SCENE;
    }
    unpacked->bytes += member->size;
    if (!quick || unpacked->bytes <= quick->array_bytes_max) return ZR_OK;
    quick->is_exceeded = true;
    return ZR_CANCELLED;
}

enum zr_status zr_zip_read(const struct zr_zip_member *member, struct zr_arena *arena, const char **bytes,
                           struct zr_reason *reason)
{
    const struct zr_cancel *cancel = arena->cancel;
    const enum zr_status counted = count_bytes(member, reason);
    if (counted != ZR_OK) return counted;
    if (member->method != STORED && member->method != DEFLATED) {
        zr_reason_give(reason, "member %s: it is packed by method %u; stored and deflated members are read",
                       zr_quote(member->name, member->name_length).text, member->method);
        return ZR_BAD_SYNTAX;
    }
    *bytes = member->packed;
    if (member->method == DEFLATED) {
        if (member->size > SIZE_MAX) return ZR_NO_MEMORY;
        uint8_t *out = zr_arena_alloc(arena, (size_t)member->size, 1);
        struct inflate_state *state = out ? zr_arena_alloc(arena, 1, sizeof *state) : NULL;
        if (!state) return ZR_NO_MEMORY;
        const enum zr_status status = inflate_all(member, state, out, cancel, reason);
        if (status != ZR_OK) return status;
        *bytes = (const char *)out;
    }
    return check_crc(member, *bytes, cancel, reason);
}

/* ---- members of a ZIP body ---- */

const struct zr_asset *zr_packed_open(struct zr_packed *packed, struct zr_arena *arena)
{
    struct zr_reason reason = {""};
    const char *bytes;
    if (packed->asset.bytes) return &packed->asset;
    if (packed->is_closed || packed->status != ZR_OK) return NULL;
    packed->status = zr_zip_read(packed->member, arena, &bytes, &reason);
    if (*reason.text) packed->reason = zr_arena_copy(arena, reason.text, sizeof reason.text);
    if (packed->status != ZR_OK) return NULL;
    packed->asset.bytes = bytes;
    return &packed->asset;
}
