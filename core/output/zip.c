#include "output/zip.h"

#include <stdint.h>
#include <zip.h>

#include "base/checked.h"

/* HEADERS_SIZE: what the format adds to a file with a short name, amply. */
enum { DOS_DATE_1980_01_01 = 0x21, HEADERS_SIZE = 512 };

static bool add_entries(zip_t *archive, const struct zr_zip_entry *entries, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        zip_source_t *source = zip_source_buffer(archive, entries[i].bytes, entries[i].size, 0);
        if (!source) return false;
        zip_int64_t index = zip_file_add(archive, entries[i].name, source, ZIP_FL_ENC_UTF_8);
        if (index < 0) {
            zip_source_free(source);
            return false;
        }
        if (zip_set_file_compression(archive, (zip_uint64_t)index, ZIP_CM_STORE, 0) != 0 ||
            zip_file_set_dostime(archive, (zip_uint64_t)index, 0, DOS_DATE_1980_01_01, 0) != 0)
            return false;
    }
    return true;
}

/* Straight to the end of the buffer. */
static bool copy_out(zip_source_t *source, struct zr_buffer *out)
{
    zip_stat_t stat;
    if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) return false;
    unsigned char *end = zr_buffer_room(out, stat.size);
    bool ok = end && zip_source_read(source, end, stat.size) == (zip_int64_t)stat.size;
    if (ok) out->size += stat.size;
    zip_source_close(source);
    return ok;
}

/* The archive as libzip makes it, in memory of its own; NULL where that is short. */
static zip_source_t *make_archive(const struct zr_zip_entry *entries, size_t count)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *target = zip_source_buffer_create(NULL, 0, 0, &error);
    zip_t *archive = target ? zip_open_from_source(target, ZIP_TRUNCATE, &error) : NULL;
    zip_error_fini(&error);
    if (!archive) {
        if (target) zip_source_free(target);
        return NULL;
    }
    zip_source_keep(target); /* outlives the archive, which writes into it as it closes */
    if (add_entries(archive, entries, count) && zip_close(archive) == 0) return target;
    zip_discard(archive);
    zip_source_free(target);
    return NULL;
}

enum zr_status zr_zip_write(const struct zr_zip_entry *entries, size_t count, struct zr_buffer *out)
{
    size_t charged = 0;
    for (size_t i = 0; i < count; i++)
        if (!zr_add_size(charged, entries[i].size + HEADERS_SIZE, &charged)) return ZR_NO_MEMORY;
    if (!zr_arena_charge(out->arena, charged)) return ZR_NO_MEMORY;
    zip_source_t *archive = make_archive(entries, count);
    bool ok = archive && copy_out(archive, out);
    if (archive) zip_source_free(archive);
    zr_arena_refund(out->arena, charged);
    return ok ? ZR_OK : ZR_NO_MEMORY;
}
