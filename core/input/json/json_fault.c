#include "input/json/json_fault.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { PATH_LINKS_MAX = 16, POINTER_ROOM = ZR_POINTER_SIZE + 8 };

/* RFC 6901, section 3: ~ becomes ~0 and / becomes ~1. A key without room is cut short; the text is then still too long
 * for zr_error_add, which cuts it at a whole character. */
static size_t write_key(char *text, size_t used, const char *key)
{
    for (; *key && used + 2 < POINTER_ROOM; key++) {
        if (*key == '~' || *key == '/') {
            text[used++] = '~';
            text[used++] = *key == '~' ? '0' : '1';
        } else {
            text[used++] = *key;
        }
    }
    return used;
}

static void write_pointer(const struct zr_json_path *path, char text[POINTER_ROOM])
{
    const struct zr_json_path *links[PATH_LINKS_MAX];
    size_t count = 0, used = 0;
    for (; path && count < PATH_LINKS_MAX; path = path->parent)
        links[count++] = path;
    while (count > 0 && used + 24 < POINTER_ROOM) {
        const struct zr_json_path *link = links[--count];
        if (link->key) {
            text[used++] = '/';
            used = write_key(text, used, link->key);
        } else {
            used += (size_t)snprintf(text + used, POINTER_ROOM - used, "/%zu", link->index);
        }
    }
    text[used] = '\0';
}

const char *zr_json_pointer(struct zr_arena *arena, const struct zr_json_path *path)
{
    char pointer[POINTER_ROOM];
    write_pointer(path, pointer);
    return zr_arena_copy(arena, pointer, strlen(pointer) + 1);
}

bool zr_json_fault(struct zr_json *json, const struct zr_json_path *path, const char *format, ...)
{
    char pointer[POINTER_ROOM], detail[ZR_DETAIL_SIZE + 8];
    if (json->is_ahead) zr_json_give_up(json);
    if (json->ended || !zr_arena_ok(json->arena)) return false;
    write_pointer(path, pointer);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    zr_error_add(json->error, ZR_BAD_SCENE, pointer, "%s", detail);
    zr_json_look(json);
    return false;
}
