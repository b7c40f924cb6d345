/* zip_file.h - tests: makes ZIP archives, valid or not. */
#ifndef ZR_TESTS_ZIP_FILE_H
#define ZR_TESTS_ZIP_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

struct zip_entry {
    const char *name, *bytes;
    size_t size;
    bool deflated;
};

static inline unsigned char *zip_put(unsigned char *at, uint64_t value, int bytes)
{
    for (; bytes > 0; bytes--, value >>= 8)
        *at++ = (unsigned char)value;
    return at;
}

static inline size_t zip_deflate(const char *bytes, size_t size, unsigned char *out, size_t room)
{
    z_stream stream = {0};
    if (deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) abort();
    stream.next_in = (z_const Bytef *)(uintptr_t)bytes;
    stream.avail_in = (uInt)size;
    stream.next_out = out;
    stream.avail_out = (uInt)room;
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) abort();
    deflateEnd(&stream);
    return room - stream.avail_out;
}

/* Returns an archive, which the caller frees. Sets *directory to the offset of its directory. */
static inline unsigned char *zip_file(const struct zip_entry *entries, size_t count, size_t *size, size_t *directory)
{
    size_t room = 22;
    for (size_t i = 0; i < count; i++)
        room += 2 * strlen(entries[i].name) + entries[i].size + entries[i].size / 8 + 256;
    unsigned char *file = calloc(room, 1), *at = file, *central = malloc(room), *end = central;
    if (!file || !central) abort();
    for (size_t i = 0; i < count; i++) {
        const size_t length = strlen(entries[i].name), offset = (size_t)(at - file);
        unsigned char head[26], *next = head;
        unsigned char *packed = at + 30 + length;
        size_t packed_size = entries[i].size;
        if (entries[i].deflated)
            packed_size = zip_deflate(entries[i].bytes, entries[i].size, packed, room - (size_t)(packed - file));
        else if (entries[i].size > 0)
            memcpy(packed, entries[i].bytes, entries[i].size);
        next = zip_put(next, 20, 2);
        next = zip_put(next, 0, 2);
        next = zip_put(next, entries[i].deflated ? 8 : 0, 2);
        next = zip_put(next, 0x210000, 4);
        next = zip_put(next, crc32(0, (const Bytef *)entries[i].bytes, (uInt)entries[i].size), 4);
        next = zip_put(next, packed_size, 4);
        next = zip_put(next, entries[i].size, 4);
        next = zip_put(next, length, 2);
        zip_put(next, 0, 2);
        memcpy(zip_put(at, 0x04034b50, 4), head, sizeof head);
        memcpy(at + 30, entries[i].name, length);
        at = packed + packed_size;
        end = zip_put(end, 0x02014b50, 4);
        end = zip_put(end, 20, 2);
        memcpy(end, head, sizeof head);
        end = zip_put(end + sizeof head, 0, 6);
        end = zip_put(end, 0, 4);
        end = zip_put(end, offset, 4);
        memcpy(end, entries[i].name, length);
        end += length;
    }
    *directory = (size_t)(at - file);
    const size_t directory_size = (size_t)(end - central);
    memcpy(at, central, directory_size);
    at = zip_put(at + directory_size, 0x06054b50, 4);
    at = zip_put(at, 0, 4);
    at = zip_put(at, count, 2);
    at = zip_put(at, count, 2);
    at = zip_put(at, directory_size, 4);
    at = zip_put(at, *directory, 4);
    at = zip_put(at, 0, 2);
    *size = (size_t)(at - file);
    free(central);
    return file;
}

/* Returns a 3MF package of these parts; the relationships name the first as the model. */
static inline unsigned char *zip_3mf(const struct zip_entry *parts, size_t count, size_t *size)
{
    static const char rels[] =
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
        "Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
    struct zip_entry all[8] = {{"_rels/.rels", rels, sizeof rels - 1, true}};
    size_t directory;
    if (count > 7) abort();
    for (size_t i = 0; i < count; i++)
        all[i + 1] = parts[i];
    return zip_file(all, count + 1, size, &directory);
}

#endif
