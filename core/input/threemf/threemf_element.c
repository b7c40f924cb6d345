/* Iterates over the elements of a part of 3MF; records faults and warnings with part and line. */
#include <stdarg.h>
#include <stdio.h>

#include "input/text/text.h"
#include "input/threemf/threemf_file.h"

enum { ROOM_AT_FIRST = 16 };

/* ---- faults and warnings ---- */

/* Returns the line of a place. If places ascend, as they mostly do, each byte is scanned once. */
static size_t line_of(struct zr_threemf_part *part, const char *at)
{
    if (!part->bytes || at < part->bytes || at > part->bytes + part->size) return 0;
    if (at < part->counted_to) {
        part->counted_to = part->bytes;
        part->line = 1;
    }
    for (const char *next = part->counted_to; (next = memchr(next, '\n', (size_t)(at - next))) != NULL; next++)
        part->line++;
    part->counted_to = at;
    return part->line;
}

bool zr_threemf_fault_in(struct zr_threemf *file, uint32_t number, const char *at, const char *format, ...)
{
    struct zr_threemf_part *part = &zr_threemf_parts(file)[number];
    char text[ZR_DETAIL_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%.*s, line %zu: %s",
                 (int)(part->member->name_length < 80 ? part->member->name_length : 80), part->member->name,
                 line_of(part, at), text);
    return false;
}

void zr_threemf_note(struct zr_threemf *file, int note, const char *at, struct zr_xml_text word)
{
    if (file->notes[note].count++ > 0) return;
    file->notes[note].part = file->part;
    file->notes[note].line = line_of(&zr_threemf_parts(file)[file->part], at);
    file->notes[note].word = word;
}

/* ---- elements ---- */

bool zr_threemf_stops(const struct zr_threemf *file)
{
    return file->is_stopped || file->error->count >= ZR_ERROR_ITEMS || !zr_arena_ok(file->arena);
}

bool zr_threemf_child(struct zr_threemf *file, size_t depth)
{
    struct zr_xml *xml = &file->xml;
    while (!zr_threemf_stops(file)) {
        switch (zr_xml_next(xml, &file->tag)) {
        case ZR_XML_BEGIN:
            if (xml->depth == depth + 1) return true;
            break;
        case ZR_XML_END:
            if (xml->depth < depth) return false;
            break;
        case ZR_XML_FAULT:
            zr_threemf_fault(file, xml->at, "%s", xml->reason.text);
            file->error->status = file->error->count == 1 ? ZR_BAD_SYNTAX : file->error->status;
            file->is_stopped = true;
            break;
        case ZR_XML_DONE:
        case ZR_XML_CANCELLED:
            file->is_stopped = true;
            break;
        }
    }
    return false;
}

bool zr_threemf_is(const struct zr_threemf *file, enum zr_threemf_space space, const char *name)
{
    const bool is_here =
        space == ZR_THREEMF_SPACE_CORE ? zr_threemf_is_core(file->tag.space) : file->tag.space == (int)space;
    return is_here && zr_xml_text_is(file->tag.name, name);
}

/* ---- lists ---- */

void *zr_threemf_list_add(struct zr_arena *arena, struct zr_threemf_list *list, size_t size)
{
    if (list->count == list->room) {
        const uint32_t room = list->room ? 2 * list->room : ROOM_AT_FIRST;
        void *more = room > list->room ? zr_arena_grow(arena, list->items, list->count, room, size) : NULL;
        if (!more) return NULL;
        list->items = more;
        list->room = room;
    }
    return (char *)list->items + size * list->count++;
}
