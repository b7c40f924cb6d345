#include "output/zip.h"

#include <stdint.h>
#include <zip.h>

enum { DOS_DATE_1980_01_01 = 0x21 };

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

static bool copy_out(zip_source_t *source, struct zr_buffer *out)
{
    zip_stat_t stat;
    if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) return false;
    unsigned char *bytes = zr_arena_alloc(out->arena, stat.size, 1);
    bool ok = bytes && zip_source_read(source, bytes, stat.size) == (zip_int64_t)stat.size;
    zip_source_close(source);
    return ok && zr_buffer_add(out, bytes, stat.size);
}

enum zr_status zr_zip_write(const struct zr_zip_entry *entries, size_t count, struct zr_buffer *out)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *target = zip_source_buffer_create(NULL, 0, 0, &error);
    zip_t *archive = target ? zip_open_from_source(target, ZIP_TRUNCATE, &error) : NULL;
    zip_error_fini(&error);
    if (!archive) {
        if (target) zip_source_free(target);
        return ZR_NO_MEMORY;
    }
    zip_source_keep(target); /* outlives the archive, which writes into it as it closes */
    bool ok = add_entries(archive, entries, count) && zip_close(archive) == 0;
    if (!ok) zip_discard(archive);
    ok = ok && copy_out(target, out);
    zip_source_free(target);
    return ok ? ZR_OK : ZR_NO_MEMORY;
}
