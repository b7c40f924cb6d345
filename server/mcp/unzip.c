#include "unzip.h"

#include <stdint.h>
#include <string.h>

/* Source: PKWARE, APPNOTE.TXT 6.3.10, section 4.3.7. */
enum { LOCAL_SIZE = 30, AT_METHOD = 8, AT_SIZE = 18, AT_NAME_LENGTH = 26, AT_EXTRA_LENGTH = 28 };

static size_t number_at(const unsigned char *at, int bytes)
{
    size_t value = 0;
    while (bytes-- > 0)
        value = value << 8 | at[bytes];
    return value;
}

/* Returns true for channel.extension and view.channel.extension. Another name could lead out of the folder. */
static bool is_plain(const char *name, size_t length)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    int dots = 0;
    size_t at = strspn(name, letters);
    for (size_t part = at; part > 0 && name[at] == '.'; at += part, dots++)
        part = strspn(name + ++at, letters);
    return at == length && (dots == 1 || dots == 2) && name[at - 1] != '.';
}

bool unzip_next(struct unzip *unzip, struct unzip_file *file)
{
    const unsigned char *at = unzip->at;
    const size_t left = at ? (size_t)(unzip->end - at) : 0;
    if (left < 4 || memcmp(at, "PK\3\4", 4) != 0) return false;
    unzip->at = NULL;
    if (left < LOCAL_SIZE || number_at(at + AT_METHOD, 2) != 0) return false;
    const size_t name = number_at(at + AT_NAME_LENGTH, 2), extra = number_at(at + AT_EXTRA_LENGTH, 2);
    file->size = number_at(at + AT_SIZE, 4);
    if (name >= sizeof file->name || left - LOCAL_SIZE < name + extra || left - LOCAL_SIZE - name - extra < file->size)
        return false;
    memcpy(file->name, at + LOCAL_SIZE, name);
    file->name[name] = '\0';
    file->data = at + LOCAL_SIZE + name + extra;
    if (!is_plain(file->name, name)) return false;
    unzip->at = at + LOCAL_SIZE + name + extra + file->size;
    return true;
}
