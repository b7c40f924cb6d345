#include "input/formats/sniff.h"

#include <string.h>

#include "input/formats/formats.h"

static bool begins_with(const char *bytes, size_t size, const char *begin, size_t length)
{
    return size >= length && memcmp(bytes, begin, length) == 0;
}

#define LFS_POINTER "version https://git-lfs.github.com/spec/"

static const struct {
    const char *begin;
    size_t length;
    const char *words;
} foreign[] = {
    {"\x1F\x8B", 2, "gzip (Content-Encoding: gzip is missing)"},
    {"\x89PNG", 4, "a PNG picture"},
    {"\xFF\xD8\xFF", 3, "a JPEG picture"},
    {"\xFF\xFE", 2, "UTF-16 text (UTF-8 is needed)"},
    {"\xFE\xFF", 2, "UTF-16 text (UTF-8 is needed)"},
    {"\x93NUMPY", 6, "an NPY array"},
    {"%PDF", 4, "a PDF document"},
    {"GIF8", 4, "a GIF picture"},
    {"RIFF", 4, "a RIFF file, as WebP pictures are"},
    {"II*\0", 4, "a TIFF picture"},
    {"MM\0*", 4, "a TIFF picture"},
    {"BM", 2, "a BMP picture"},
    {"\xABKTX ", 5, "a KTX texture"},
    {"DDS ", 4, "a DDS texture"},
    {"#?RADIANCE", 10, "a Radiance picture"},
    {"<", 1, "XML or HTML"},
    {LFS_POINTER, sizeof LFS_POINTER - 1, "a pointer of Git LFS (git lfs pull fetches the file)"},
};

bool zr_is_utf16(const char *bytes, size_t size)
{
    return begins_with(bytes, size, "\xFF\xFE", 2) || begins_with(bytes, size, "\xFE\xFF", 2);
}

bool zr_is_lfs_pointer(const char *bytes, size_t size)
{
    return begins_with(bytes, size, LFS_POINTER, sizeof LFS_POINTER - 1);
}

const char *zr_bytes_in_words(const char *bytes, size_t size)
{
    const enum zr_format format = zr_format_of_bytes(bytes, size);
    if (format != ZR_FORMAT_UNKNOWN) return zr_format_rows[format].name;
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (begins_with(bytes, size, foreign[i].begin, foreign[i].length)) return foreign[i].words;
    return NULL;
}
