/* The first pass over a file of OBJ: counts. */
#include "input/obj/obj_file.h"

/* Words of v with colours. */
enum { COLORED_WORDS = 6 };

/* Counts of one thread: a local variable, since the structs of other threads share cache lines. */
struct counting {
    struct zr_obj_counts counts;
    struct zr_obj_noted notes[ZR_OBJ_NOTES];
    bool has_colors, has_groups;
    uint32_t group;
};

bool zr_obj_read_group(struct zr_obj_statement *statement, uint32_t *group)
{
    struct zr_obj_statement rest = *statement;
    int64_t number;
    zr_obj_skip_blanks(&rest);
    const char *behind = zr_obj_read_integer(rest.at, rest.end, &number);
    if (behind && number >= 0 && zr_obj_ends_word(&rest, behind)) {
        *group = (uint32_t)number;
        return true;
    }
    const struct zr_obj_statement word = zr_obj_word(&rest);
    const size_t length = (size_t)(word.end - word.at);
    const bool is_on = length == 2 && memcmp(word.at, "on", 2) == 0;
    if (!is_on && !(length == 3 && memcmp(word.at, "off", 3) == 0)) return false;
    *group = is_on;
    return true;
}

/* Counts a name that ends in a backslash for a warning. The line is not continued. */
static void note_name(struct counting *counting, const struct zr_obj_statement *whole, const char *end)
{
    if (whole->end < end && zr_obj_hides_line_end(whole->at, whole->end) && !zr_obj_has_comment(whole->at, whole->end))
        zr_obj_note(counting->notes, ZR_OBJ_NOTE_NAMES, whole);
}

/* Counts statements other than v, vn and f. `statement` begins after its keyword, `whole` includes it. */
static void count_rare(struct counting *counting, enum zr_obj_keyword keyword, struct zr_obj_statement *statement,
                       const struct zr_obj_statement *whole, const char *end)
{
    switch (keyword) {
    case ZR_OBJ_LINE: {
        const size_t words = zr_obj_count_words(statement, end);
        counting->counts.segments += words > 1 ? words - 1 : 0;
        break;
    }
    case ZR_OBJ_POINT:
        counting->counts.points += zr_obj_count_words(statement, end);
        break;
    case ZR_OBJ_SMOOTH:
        if (zr_obj_read_group(statement, &counting->group))
            counting->has_groups = true;
        else
            zr_obj_note(counting->notes, ZR_OBJ_NOTE_UNKNOWN, whole);
        break;
    case ZR_OBJ_MAPS:
        zr_obj_note(counting->notes, ZR_OBJ_NOTE_MAPS, whole);
        note_name(counting, whole, end);
        break;
    case ZR_OBJ_LIBRARY:
        counting->counts.libraries++;
        note_name(counting, whole, end);
        break;
    case ZR_OBJ_USE:
    case ZR_OBJ_OBJECT:
    case ZR_OBJ_GROUP:
        counting->counts.names++;
        note_name(counting, whole, end);
        break;
    case ZR_OBJ_NAME:
        note_name(counting, whole, end);
        break;
    case ZR_OBJ_CALL:
        zr_obj_note(counting->notes, ZR_OBJ_NOTE_CALLS, whole);
        break;
    case ZR_OBJ_CURVED:
        zr_obj_note(counting->notes, ZR_OBJ_NOTE_CURVES, whole);
        break;
    case ZR_OBJ_UNKNOWN:
        zr_obj_note(counting->notes, ZR_OBJ_NOTE_UNKNOWN, whole);
        break;
    default:
        break;
    }
}

bool zr_obj_count_part(void *context, size_t index)
{
    const struct zr_obj_file *file = context;
    struct zr_obj_part *part = &file->parts[index];
    struct zr_obj_text text = {file->texts[index].at, file->texts[index].end, 0};
    struct zr_obj_statement statement, word;
    struct counting counting = {.group = 0};
    struct zr_obj_counts *counts = &counting.counts;
    while (zr_obj_next(&text, &statement)) {
        if (zr_obj_at_end(&statement)) continue;
        const struct zr_obj_statement whole = statement;
        const enum zr_obj_keyword keyword = zr_obj_next_keyword(&statement, &word);
        switch (keyword) {
        case ZR_OBJ_V:
            counts->positions++;
            if (zr_obj_count_words(&statement, file->end) == COLORED_WORDS) counting.has_colors = true;
            break;
        case ZR_OBJ_VN:
            counts->normals++;
            break;
        case ZR_OBJ_VT:
            counts->texcoords++;
            break;
        case ZR_OBJ_F: {
            const size_t corners = zr_obj_count_words(&statement, file->end);
            counts->faces += corners >= ZR_OBJ_CORNERS_LEAST;
            counts->corners += corners >= ZR_OBJ_CORNERS_LEAST ? corners : 0;
            if (corners < ZR_OBJ_CORNERS_LEAST) zr_obj_note(counting.notes, ZR_OBJ_NOTE_SHORT_FACES, &whole);
            break;
        }
        default:
            count_rare(&counting, keyword, &statement, &whole, file->end);
            break;
        }
    }
    counts->lines = text.line;
    part->holds = *counts;
    memcpy(part->notes, counting.notes, sizeof part->notes);
    part->returns = zr_obj_count_returns(file->texts[index].at, file->texts[index].end, file->end);
    part->has_colors = counting.has_colors;
    part->has_groups = counting.has_groups;
    part->group = counting.group;
    return true;
}

static struct zr_obj_counts sum(struct zr_obj_counts a, struct zr_obj_counts b)
{
    return (struct zr_obj_counts){a.lines + b.lines,   a.positions + b.positions, a.normals + b.normals,
                                  a.faces + b.faces,   a.corners + b.corners,     a.segments + b.segments,
                                  a.points + b.points, a.texcoords + b.texcoords, a.libraries + b.libraries,
                                  a.names + b.names};
}

void zr_obj_add_up(struct zr_obj_file *file)
{
    uint32_t group = 0;
    for (size_t i = 0; i < file->part_count; i++) {
        struct zr_obj_part *part = &file->parts[i];
        part->before = file->total;
        for (int note = 0; note < ZR_OBJ_NOTE_SECOND; note++)
            part->notes[note].first.line += part->before.lines + 1;
        part->group_before = group;
        if (part->has_groups) group = part->group;
        file->total = sum(file->total, part->holds);
        file->has_colors = file->has_colors || part->has_colors;
        file->has_groups = file->has_groups || part->has_groups;
    }
}
