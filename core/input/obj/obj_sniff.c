#include <string.h>

#include "input/formats/input.h"
#include "input/text/text.h"

/* True if the first statement other than a comment begins with a keyword of OBJ. */
bool zr_looks_so_OBJ(const char *bytes, size_t size)
{
    static const char *const words[] = {"v", "vn", "vt", "f", "l", "p", "g", "o", "s", "mtllib", "usemtl"};
    const char *at = bytes, *const end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX);
    for (;;) {
        at += zr_count_blanks(at, (size_t)(end - at));
        if (at == end || *at != '#') break;
        while (at < end && *at != '\n' && *at != '\r')
            at++;
    }
    size_t length = 0;
    while (at + length < end && zr_count_blanks(at + length, 1) == 0)
        length++;
    if (at + length == end) return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == length && memcmp(at, words[i], length) == 0) return true;
    return false;
}
