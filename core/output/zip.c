#include "output/zip.h"

#include <isa-l/crc.h>
#include <stdint.h>
#include <string.h>

#include "base/checked.h"
#include "base/isa.h"

/* Source: PKWARE, APPNOTE.TXT 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16: sizes of records without their names. */
enum { LOCAL_SIZE = 30, CENTRAL_SIZE = 46, END_SIZE = 22 };

/* VERSION needed to read: 1.0, enough for stored files. MADE_BY: version 6.3 on Unix; the upper half of MODE is the
 * Unix mode. */
enum { VERSION = 10, MADE_BY = 3 << 8 | 63, DOS_DATE_1980_01_01 = 0x21 };
static const uint32_t MODE = UINT32_C(0100666) << 16;

/* Position of the next byte of the archive. */
struct writer {
    unsigned char *at;
};

static void put(struct writer *w, uint32_t value, int bytes)
{
    for (; bytes > 0; bytes--, value >>= 8)
        *w->at++ = (unsigned char)value;
}

static void put_bytes(struct writer *w, const void *bytes, size_t size)
{
    if (size > 0) memcpy(w->at, bytes, size);
    w->at += size;
}

/* Writes the fields that local and central headers share, beginning with the version needed. */
static void put_file(struct writer *w, const struct zr_zip_entry *entry, uint32_t crc)
{
    put(w, VERSION, 2);
    put(w, 0, 2); /* flags */
    put(w, 0, 2); /* stored */
    put(w, 0, 2); /* time */
    put(w, DOS_DATE_1980_01_01, 2);
    put(w, crc, 4);
    put(w, (uint32_t)entry->size, 4); /* packed, */
    put(w, (uint32_t)entry->size, 4); /* and not */
    put(w, (uint32_t)strlen(entry->name), 2);
    put(w, 0, 2); /* no extra field */
}

static void put_local(struct writer *w, const struct zr_zip_entry *entry, uint32_t crc)
{
    put(w, 0x04034b50, 4);
    put_file(w, entry, crc);
    put_bytes(w, entry->name, strlen(entry->name));
    put_bytes(w, entry->bytes, entry->size);
}

static void put_central(struct writer *w, const struct zr_zip_entry *entry, uint32_t crc, uint32_t offset)
{
    put(w, 0x02014b50, 4);
    put(w, MADE_BY, 2);
    put_file(w, entry, crc);
    put(w, 0, 2); /* comment */
    put(w, 0, 2); /* disk */
    put(w, 0, 2); /* internal attributes */
    put(w, MODE, 4);
    put(w, offset, 4);
    put_bytes(w, entry->name, strlen(entry->name));
}

static void put_end(struct writer *w, size_t count, uint32_t size, uint32_t offset)
{
    put(w, 0x06054b50, 4);
    put(w, 0, 2); /* this disk, */
    put(w, 0, 2); /* and that of the directory */
    put(w, (uint32_t)count, 2);
    put(w, (uint32_t)count, 2);
    put(w, size, 4);
    put(w, offset, 4);
    put(w, 0, 2); /* comment */
}

bool zr_zip_size(const struct zr_zip_entry *entries, size_t count, size_t *size)
{
    *size = END_SIZE;
    for (size_t i = 0; i < count; i++)
        if (!zr_add_size(*size, LOCAL_SIZE + CENTRAL_SIZE + 2 * strlen(entries[i].name), size) ||
            !zr_add_size(*size, entries[i].size, size))
            return false;
    return *size < UINT32_MAX && count < UINT16_MAX;
}

enum zr_status zr_zip_write(const struct zr_zip_entry *entries, size_t count, struct zr_buffer *out)
{
    size_t size;
    if (!zr_zip_size(entries, count, &size)) return ZR_NO_MEMORY;
    struct {
        uint32_t crc, offset;
    } *files = zr_arena_alloc(out->arena, count, sizeof *files);
    unsigned char *first = files ? zr_buffer_room(out, size) : NULL;
    if (!first) return ZR_NO_MEMORY;
    struct writer w = {first};
    for (size_t i = 0; i < count; i++) {
        files[i].offset = (uint32_t)(w.at - first);
        files[i].crc = crc32_gzip_refl(0, entries[i].bytes, entries[i].size);
        put_local(&w, &entries[i], files[i].crc);
    }
    zr_isa_clear_upper_halves();
    const unsigned char *directory = w.at;
    for (size_t i = 0; i < count; i++)
        put_central(&w, &entries[i], files[i].crc, files[i].offset);
    put_end(&w, count, (uint32_t)(w.at - directory), (uint32_t)(directory - first));
    out->size += size;
    return ZR_OK;
}
