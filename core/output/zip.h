/* zip.h - output: writes a ZIP archive of several files.
 *
 * Files are stored, not deflated: PNG is already compressed, and arrays are stored as they are. All time stamps are the
 * format's earliest, so the same files give the same bytes.
 */
#ifndef ZR_ZIP_H
#define ZR_ZIP_H

#include "base/status.h"
#include "output/bytes/buffer.h"

/* One file. Its name is ASCII. */
struct zr_zip_entry {
    const char *name;
    const void *bytes;
    size_t size;
};

/* Computes the size of the archive. False if it would have 4 GiB or more, which needs ZIP64. */
bool zr_zip_size(const struct zr_zip_entry *entries, size_t count, size_t *size);

/* Appends the archive to `out`. Returns ZR_OK or ZR_NO_MEMORY; the latter also if zr_zip_size is false. */
enum zr_status zr_zip_write(const struct zr_zip_entry *entries, size_t count, struct zr_buffer *out);

#endif
