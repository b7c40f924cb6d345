#include "input/zip/zip_read.h"

#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"

/* Source: APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.14 to 4.3.16: signatures, and sizes of records without names. */
enum { LOCAL_SIZE = 30, CENTRAL_SIZE = 46, END_SIZE = 22, LOCATOR_SIZE = 20, END64_SIZE = 56, COMMENT_MAX = 65535 };
enum { LOCAL = 0x04034b50, CENTRAL = 0x02014b50, END = 0x06054b50, LOCATOR = 0x07064b50, END64 = 0x06064b50 };
enum { ENCRYPTED = 1 << 0, SIZES_BEHIND = 1 << 3, STRONGLY_ENCRYPTED = 1 << 6, HEADERS_ENCRYPTED = 1 << 13 };
enum { ZIP64_FIELD = 1, CHECKED_AT_ONCE = 1 << 10 };

struct archive {
    struct zr_arena *arena;
    const char *bytes;
    size_t size;
    size_t directory, directory_end; /* offsets */
    size_t entries;
    struct zr_reason *reason;
};

static uint32_t number(const char *at, int size)
{
    uint32_t value = 0;
    for (int i = size; i-- > 0;)
        value = value << 8 | (unsigned char)at[i];
    return value;
}

static uint64_t number64(const char *at)
{
    return number(at, 4) | (uint64_t)number(at + 4, 4) << 32;
}

static bool fault(const struct archive *archive, const char *text)
{
    zr_reason_give(archive->reason, "%s", text);
    return false;
}

static bool member_fault(const struct archive *archive, const struct zr_zip_member *member, const char *text)
{
    zr_reason_give(archive->reason, "member %s: %s", zr_quote(member->name, member->name_length).text, text);
    return false;
}

/* ---- the end of the directory ---- */

/* Returns the offset of the end record, whose comment ends the archive; SIZE_MAX if there is none. */
static size_t find_end(const struct archive *archive)
{
    for (size_t comment = 0; comment <= COMMENT_MAX && END_SIZE + comment <= archive->size; comment++) {
        const size_t offset = archive->size - END_SIZE - comment;
        const char *at = archive->bytes + offset;
        if (*at == 'P' && number(at, 4) == END && number(at + 20, 2) == comment) return offset;
    }
    return SIZE_MAX;
}

/* Reads the ZIP64 end record that the locator before the end record names. */
static bool read_end64(struct archive *archive, size_t end)
{
    const char *locator = archive->bytes + end - LOCATOR_SIZE;
    const uint64_t offset = number64(locator + 8);
    const size_t room = end - LOCATOR_SIZE;
    if (room < END64_SIZE || offset > room - END64_SIZE || number(archive->bytes + offset, 4) != END64)
        return fault(archive, "its ZIP64 end record is missing");
    const char *at = archive->bytes + offset;
    if (number(at + 16, 4) != 0 || number(at + 20, 4) != 0) return fault(archive, "it is one part of several");
    const uint64_t entries = number64(at + 32), size = number64(at + 40), first = number64(at + 48);
    if (first > offset || size != offset - first || entries > size / CENTRAL_SIZE)
        return fault(archive, "the sizes of its directory do not add up");
    archive->directory = (size_t)first;
    archive->directory_end = (size_t)offset;
    archive->entries = (size_t)entries;
    return true;
}

static bool read_end(struct archive *archive)
{
    const size_t end = find_end(archive);
    if (end == SIZE_MAX) return fault(archive, "its end is missing: the archive is cut off, or bytes follow it");
    const char *at = archive->bytes + end;
    if (end >= LOCATOR_SIZE && number(at - LOCATOR_SIZE, 4) == LOCATOR) return read_end64(archive, end);
    if (number(at + 4, 2) != 0 || number(at + 6, 2) != 0) return fault(archive, "it is one part of several");
    const size_t size = number(at + 12, 4), first = number(at + 16, 4);
    archive->entries = number(at + 10, 2);
    if (first > end || size != end - first || archive->entries > size / CENTRAL_SIZE)
        return fault(archive, "the sizes of its directory do not add up");
    archive->directory = first;
    archive->directory_end = end;
    return true;
}

/* ---- members ---- */

/* Checks that a name stays within its folder and has no control characters. */
static bool check_name(const struct archive *archive, const struct zr_zip_member *member)
{
    const char *name = member->name, *const end = name + member->name_length;
    if (member->name_length == 0 || member->name_length > ZR_ZIP_NAME_MAX)
        return member_fault(archive, member, "a name of 1 to 1024 bytes is needed");
    if (*name == '/' || (member->name_length > 1 && name[1] == ':'))
        return member_fault(archive, member, "its name is absolute");
    for (const char *at = name; at < end; at++) {
        if ((unsigned char)*at < 0x20) return member_fault(archive, member, "its name has a control character");
        const bool begins = at == name || at[-1] == '/';
        if (begins && end - at >= 2 && at[0] == '.' && at[1] == '.' && (end - at == 2 || at[2] == '/'))
            return member_fault(archive, member, "its name has a part '..'");
    }
    return true;
}

/* Returns a name with slashes instead of backslashes, which some programs of Windows write. NULL without memory. */
static const char *clean_name(const struct archive *archive, const char *name, size_t length)
{
    if (!memchr(name, '\\', length)) return name;
    char *clean = zr_arena_copy(archive->arena, name, length);
    for (size_t i = 0; clean && i < length; i++)
        if (clean[i] == '\\') clean[i] = '/';
    return clean;
}

/* Replaces each size and offset of 0xFFFFFFFF by its value in the ZIP64 field. */
static bool read_extra(const struct archive *archive, struct zr_zip_member *member, uint64_t *offset, const char *at,
                       size_t size)
{
    uint64_t *const values[] = {&member->size, &member->packed_size, offset};
    while (size >= 4) {
        const uint32_t id = number(at, 2), length = number(at + 2, 2);
        if (length > size - 4) break; /* padding of some writers */
        const char *value = at + 4, *const end = value + length;
        for (size_t i = 0; id == ZIP64_FIELD && i < 3; i++) {
            if (*values[i] != UINT32_MAX) continue;
            if (end - value < 8) return member_fault(archive, member, "its ZIP64 sizes are cut off");
            *values[i] = number64(value);
            value += 8;
        }
        at += 4 + length;
        size -= 4 + length;
    }
    return true;
}

/* Finds the member's bytes after its local header. Checks the header against the directory, which has `name`. */
static bool read_local(const struct archive *archive, struct zr_zip_member *member, const char *name, uint64_t offset)
{
    const size_t room = archive->directory;
    if (room < LOCAL_SIZE || offset > room - LOCAL_SIZE) return member_fault(archive, member, "it lies outside");
    const char *at = archive->bytes + offset;
    if (number(at, 4) != LOCAL) return member_fault(archive, member, "its local header is missing");
    const size_t name_length = number(at + 26, 2), head = LOCAL_SIZE + name_length + number(at + 28, 2);
    const size_t left = room - (size_t)offset;
    if (head > left || member->packed_size > left - head)
        return member_fault(archive, member, "it reaches into the directory");
    if (name_length != member->name_length || memcmp(at + LOCAL_SIZE, name, name_length) != 0)
        return member_fault(archive, member, "its local header has another name");
    const uint32_t packed = number(at + 18, 4), size = number(at + 22, 4);
    const bool has_sizes = !(number(at + 6, 2) & SIZES_BEHIND) && packed != UINT32_MAX && size != UINT32_MAX;
    if (number(at + 8, 2) != member->method || (has_sizes && (packed != member->packed_size || size != member->size)))
        return member_fault(archive, member, "its local header has another size or method");
    member->offset = (size_t)offset;
    member->packed = at + head;
    return true;
}

static bool check_sizes(const struct archive *archive, const struct zr_zip_member *member)
{
    enum { DEFLATE_MOST = 1032 }; /* most bytes per packed byte */
    if (member->method == 0 ? member->size != member->packed_size
                            : member->size > (member->packed_size + 1) * DEFLATE_MOST)
        return member_fault(archive, member, "its sizes do not add up");
    return true;
}

/* Reads the entry at *at; advances *at to its end. */
static bool read_entry(const struct archive *archive, size_t *at, struct zr_zip_member *member)
{
    const char *entry = archive->bytes + *at;
    const size_t left = archive->directory_end - *at;
    if (left < CENTRAL_SIZE || number(entry, 4) != CENTRAL) return fault(archive, "its directory is cut off");
    const size_t name_length = number(entry + 28, 2), extra = number(entry + 30, 2);
    const size_t entry_size = CENTRAL_SIZE + name_length + extra + number(entry + 32, 2);
    const char *name = entry + CENTRAL_SIZE;
    if (entry_size > left) return fault(archive, "its directory is cut off");
    *member = (struct zr_zip_member){.name = clean_name(archive, name, name_length),
                                     .name_length = name_length,
                                     .method = number(entry + 10, 2),
                                     .crc = number(entry + 16, 4),
                                     .packed_size = number(entry + 20, 4),
                                     .size = number(entry + 24, 4)};
    uint64_t offset = number(entry + 42, 4);
    if (number(entry + 8, 2) & (ENCRYPTED | STRONGLY_ENCRYPTED | HEADERS_ENCRYPTED))
        return member_fault(archive, member, "it is encrypted");
    *at += entry_size;
    return member->name && check_name(archive, member) &&
           read_extra(archive, member, &offset, name + name_length, extra) &&
           read_local(archive, member, name, offset) && check_sizes(archive, member);
}

/* ---- order ---- */

static unsigned char lower(char c)
{
    return (unsigned char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

static int compare_texts(const char *a, size_t a_length, const char *b, size_t b_length, bool exact)
{
    const size_t common = a_length < b_length ? a_length : b_length;
    for (size_t i = 0; i < common; i++) {
        const int order = exact ? (unsigned char)a[i] - (unsigned char)b[i] : lower(a[i]) - lower(b[i]);
        if (order != 0) return order;
    }
    return (a_length > b_length) - (a_length < b_length);
}

static int compare_names(const void *left, const void *right)
{
    const struct zr_zip_member *a = left, *b = right;
    const int order = compare_texts(a->name, a->name_length, b->name, b->name_length, false);
    return order != 0 ? order : compare_texts(a->name, a->name_length, b->name, b->name_length, true);
}

static int compare_offsets(const void *left, const void *right)
{
    const struct zr_zip_member *a = left, *b = right;
    return (a->offset > b->offset) - (a->offset < b->offset);
}

/* Checks for overlaps and duplicates; sorts the members by name. */
static bool check_together(const struct archive *archive, struct zr_zip *zip)
{
    struct zr_zip_member *members = zip->members;
    if (zip->count == 0) return true;
    qsort(members, zip->count, sizeof *members, compare_offsets);
    for (size_t i = 1; i < zip->count; i++)
        if (members[i - 1].packed + members[i - 1].packed_size > archive->bytes + members[i].offset)
            return member_fault(archive, &members[i], "it overlaps another one");
    qsort(members, zip->count, sizeof *members, compare_names);
    for (size_t i = 1; i < zip->count; i++)
        if (compare_names(&members[i - 1], &members[i]) == 0)
            return member_fault(archive, &members[i], "it occurs twice");
    return true;
}

/* ---- interface ---- */

bool zr_zip_is(const char *bytes, size_t size)
{
    return size >= LOCAL_SIZE + CENTRAL_SIZE + END_SIZE && number(bytes, 4) == LOCAL;
}

enum zr_status zr_zip_open(struct zr_arena *arena, const char *bytes, size_t size, struct zr_zip *zip,
                           struct zr_reason *reason)
{
    struct archive archive = {.arena = arena, .bytes = bytes, .size = size, .reason = reason};
    if (!read_end(&archive)) return ZR_BAD_SYNTAX;
    if (archive.entries > ZR_ZIP_MEMBERS_MAX) {
        zr_reason_give(reason, "%zu members; %d are allowed", archive.entries, ZR_ZIP_MEMBERS_MAX);
        return ZR_BAD_SYNTAX;
    }
    *zip = (struct zr_zip){.members = zr_arena_alloc(arena, archive.entries, sizeof *zip->members),
                           .unpacked = zr_arena_zero(arena, 1, sizeof *zip->unpacked)};
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    zip->unpacked->bytes_max = UINT64_MAX;
    size_t at = archive.directory;
    for (size_t i = 0; i < archive.entries; i++) {
        struct zr_zip_member *member = &zip->members[zip->count];
        if (i % CHECKED_AT_ONCE == 0 && zr_is_cancelled(arena->cancel)) return ZR_CANCELLED;
        if (!read_entry(&archive, &at, member)) return zr_arena_ok(arena) ? ZR_BAD_SYNTAX : ZR_NO_MEMORY;
        member->unpacked = zip->unpacked;
        if (member->name[member->name_length - 1] != '/') zip->count++;
    }
    if (at != archive.directory_end) return fault(&archive, "bytes follow its directory"), ZR_BAD_SYNTAX;
    return check_together(&archive, zip) ? ZR_OK : ZR_BAD_SYNTAX;
}

const struct zr_zip_member *zr_zip_find(const struct zr_zip *zip, const char *name, size_t length)
{
    size_t low = 0, high = zip->count;
    while (low < high) { /* the first at or after `name`, ignoring case */
        const size_t middle = low + (high - low) / 2;
        const struct zr_zip_member *member = &zip->members[middle];
        if (compare_texts(member->name, member->name_length, name, length, false) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    const struct zr_zip_member *first = NULL;
    for (; low < zip->count; low++) {
        const struct zr_zip_member *member = &zip->members[low];
        if (compare_texts(member->name, member->name_length, name, length, false) != 0) break;
        if (compare_texts(member->name, member->name_length, name, length, true) == 0) return member;
        if (!first) first = member;
    }
    return first;
}
