/* zip.h - output: several files as one.
 *
 * Files are stored, not deflated: PNG is compressed already, and arrays are taken
 * as they are. Time stamps are the format's earliest: the same files give the same bytes.
 */
#ifndef ZR_ZIP_H
#define ZR_ZIP_H

#include "base/status.h"
#include "output/buffer.h"

/* A file: its name is ASCII. */
struct zr_zip_entry {
    const char *name;
    const void *bytes;
    size_t size;
};

/* How large the archive is. False where it would have 4 GiB or more, which the format's first version cannot say. */
bool zr_zip_size(const struct zr_zip_entry *entries, size_t count, size_t *size);

/* Appends the archive to `out`. ZR_NO_MEMORY also where zr_zip_size is false. */
enum zr_status zr_zip_write(const struct zr_zip_entry *entries, size_t count, struct zr_buffer *out);

#endif
