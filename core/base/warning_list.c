#include "base/warning_list.h"

#include <stdarg.h>
#include <stdio.h>

enum { TEXT_SIZE = 256, ROOM_AT_FIRST = 8 };

void zr_warning_list_add(struct zr_arena *arena, struct zr_warning_list *list, const char *format, ...)
{
    if (list->count == list->room) {
        size_t room = list->room ? list->room * 2 : ROOM_AT_FIRST;
        const char **more = zr_arena_grow(arena, list->texts, list->count, room, sizeof *more);
        if (!more) return;
        list->texts = more;
        list->room = room;
    }
    char *text = zr_arena_alloc(arena, TEXT_SIZE, 1);
    if (!text) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, TEXT_SIZE, format, arguments);
    va_end(arguments);
    for (char *at = text; *at; at++) /* a warning is one line, whatever names it quotes */
        if ((unsigned char)*at < 0x20 || *at == 0x7F) *at = '?';
    list->texts[list->count++] = text;
}

void zr_warning_list_append(struct zr_arena *arena, struct zr_warning_list *list, const struct zr_warning_list *more)
{
    for (size_t i = 0; i < more->count; i++)
        zr_warning_list_add(arena, list, "%s", more->texts[i]);
}
