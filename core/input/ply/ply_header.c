#include "input/formats/input.h"
#include "input/ply/ply_file.h"

#include <string.h>

/* ITEMS_MAX: elements per file, and properties per element. */
enum { WORDS_MAX = 6, ITEMS_MAX = 1000 };

static const struct {
    const char *name, *newer;
    size_t bytes;
} types[ZR_PLY_TYPES] = {
#define TYPE(ID, name, newer, type) {name, newer, sizeof(type)},
    ZR_PLY_TYPE_ROWS(TYPE)
#undef TYPE
};

/* A line of the header, cut into words. */
struct line {
    size_t number, count; /* count: all words, of which WORDS_MAX are kept */
    struct zr_ply_word words[WORDS_MAX];
    const char *end;
};

struct reader {
    const char *at, *end;
    char line_end; /* '\n', or '\r' if the first line ends in '\r' alone */
    struct zr_ply_header *header;
    struct zr_error *error;
    bool has_form;
    struct zr_ply_property *properties; /* free rest of the array, for later elements */
};

bool zr_ply_word_is(struct zr_ply_word word, const char *text)
{
    return strlen(text) == word.size && memcmp(word.at, text, word.size) == 0;
}

struct zr_quote zr_ply_printable(struct zr_ply_word word)
{
    struct zr_quote quote = zr_quote(word.at, word.size);
    const size_t length = strlen(quote.text);
    memmove(quote.text, quote.text + 1, length - 1);
    quote.text[length - 2] = '\0';
    return quote;
}

size_t zr_ply_type_bytes(enum zr_ply_type type)
{
    return types[type].bytes;
}

const struct zr_ply_property *zr_ply_find(const struct zr_ply_element *element, const char *name)
{
    for (size_t i = 0; i < element->property_count; i++)
        if (zr_ply_word_is(element->properties[i].name, name)) return &element->properties[i];
    return NULL;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
}

/* Returns the size of a byte order mark, which some editors put first. */
static size_t mark_size(const char *bytes, size_t size)
{
    return size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

bool zr_looks_so_PLY(const char *bytes, size_t size)
{
    const size_t mark = mark_size(bytes, size);
    size_t at = mark + 3;
    if (size < mark + 4 || memcmp(bytes + mark, "ply", 3) != 0) return false;
    while (at < size && at < mark + 16 && (bytes[at] == ' ' || bytes[at] == '\t'))
        at++;
    return at < size && (bytes[at] == '\n' || bytes[at] == '\r');
}

/* ---- lines ---- */

static void find_line_end(struct reader *reader)
{
    const char *cr = memchr(reader->at, '\r', (size_t)(reader->end - reader->at));
    const char *lf = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
    const bool is_cr = cr && (!lf || cr < lf) && (cr + 1 == reader->end || cr[1] != '\n');
    reader->line_end = is_cr ? '\r' : '\n';
}

/* False if no whole line is left. */
static bool next_line(struct reader *reader, struct line *line)
{
    const char *at = reader->at, *end = memchr(at, reader->line_end, (size_t)(reader->end - at));
    if (!end) return false;
    *line = (struct line){.number = ++reader->header->lines, .end = end};
    for (;;) {
        while (at < end && is_blank(*at))
            at++;
        if (at == end) break;
        const char *first = at;
        while (at < end && !is_blank(*at))
            at++;
        if (line->count < WORDS_MAX) line->words[line->count] = (struct zr_ply_word){first, (size_t)(at - first)};
        line->count++;
    }
    reader->at = end + 1;
    return true;
}

static bool fault(struct reader *reader, const struct line *line, const char *what, struct zr_ply_word word)
{
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: %s%s", line->number, what,
                 word.at ? zr_quote(word.at, word.size).text : "");
    return false;
}

static const struct zr_ply_word no_word = {NULL, 0};

/* ---- statements ---- */

static bool read_form(struct reader *reader, const struct line *line)
{
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    size_t i = 0;
    if (line->count < 3) return fault(reader, line, "format needs a form and a version", no_word);
    while (i < 3 && !zr_ply_word_is(line->words[1], forms[i]))
        i++;
    if (i == 3)
        return fault(reader, line, "the form is ascii, binary_little_endian or binary_big_endian, not ",
                     line->words[1]);
    if (!zr_ply_word_is(line->words[2], "1.0")) return fault(reader, line, "the version is 1.0, not ", line->words[2]);
    if (reader->has_form) return fault(reader, line, "a second format", no_word);
    reader->header->form = (enum zr_ply_form)i;
    reader->has_form = true;
    return true;
}

/* Saturates: no file is large enough for such a count. */
static bool read_count(struct zr_ply_word word, size_t *count)
{
    *count = 0;
    for (size_t i = 0; i < word.size; i++) {
        if (word.at[i] < '0' || word.at[i] > '9') return false;
        if (*count < SIZE_MAX / 100) *count = *count * 10 + (size_t)(word.at[i] - '0');
    }
    return word.size > 0;
}

static bool read_element(struct reader *reader, const struct line *line)
{
    static const char *const known[] = {"vertex", "face", "tristrips", "edge"};
    struct zr_ply_header *header = reader->header;
    struct zr_ply_element *element = &header->elements[header->element_count];
    if (line->count < 3) return fault(reader, line, "element needs a name and a count", no_word);
    if (header->element_count == ITEMS_MAX) return fault(reader, line, "more than 1000 elements", no_word);
    *element = (struct zr_ply_element){.name = line->words[1], .properties = reader->properties};
    if (!read_count(line->words[2], &element->count))
        return fault(reader, line, "expected a count, found ", line->words[2]);
    for (size_t i = 0; i < header->element_count; i++)
        for (size_t k = 0; k < sizeof known / sizeof *known; k++)
            if (zr_ply_word_is(element->name, known[k]) && zr_ply_word_is(header->elements[i].name, known[k]))
                return fault(reader, line, "a second element ", element->name);
    header->element_count++;
    return true;
}

static bool read_type(struct reader *reader, const struct line *line, struct zr_ply_word word, enum zr_ply_type *type)
{
    for (int i = 0; i < ZR_PLY_TYPES; i++)
        if (zr_ply_word_is(word, types[i].name) || zr_ply_word_is(word, types[i].newer)) {
            *type = (enum zr_ply_type)i;
            return true;
        }
    return fault(reader, line, "a type is one of char, uchar, short, ushort, int, uint, float, double, not ", word);
}

/* Reads `property TYPE NAME` or `property list TYPE TYPE NAME`. */
static bool read_property(struct reader *reader, const struct line *line)
{
    struct zr_ply_header *header = reader->header;
    struct zr_ply_property *property = reader->properties;
    const bool is_list = line->count > 1 && zr_ply_word_is(line->words[1], "list");
    const size_t name = is_list ? 4 : 2;
    if (header->element_count == 0) return fault(reader, line, "a property before the first element", no_word);
    if (line->count <= name) return fault(reader, line, "property needs a type and a name", no_word);
    struct zr_ply_element *element = &header->elements[header->element_count - 1];
    if (element->property_count == ITEMS_MAX) return fault(reader, line, "more than 1000 properties", no_word);
    *property = (struct zr_ply_property){.name = line->words[name], .is_list = is_list, .offset = element->least_bytes};
    if (!read_type(reader, line, line->words[name - 1], &property->type)) return false;
    if (is_list && !read_type(reader, line, line->words[2], &property->count_type)) return false;
    for (size_t i = 0; i < element->property_count; i++)
        if (element->properties[i].name.size == property->name.size &&
            memcmp(element->properties[i].name.at, property->name.at, property->name.size) == 0)
            return fault(reader, line, "a second property ", property->name);
    element->least_bytes += zr_ply_type_bytes(is_list ? property->count_type : property->type);
    element->list_count += is_list;
    element->property_count++;
    reader->properties++;
    return true;
}

/* Reads `comment TextureFile NAME`, in which MeshLab names a texture. */
static void read_comment(struct reader *reader, const struct line *line)
{
    if (line->count < 3 || !zr_ply_word_is(line->words[1], "TextureFile")) return;
    const char *at = line->words[2].at, *end = line->end;
    while (is_blank(end[-1]))
        end--;
    if (reader->header->texture_count++ == 0) reader->header->texture = (struct zr_ply_word){at, (size_t)(end - at)};
}

/* False at the end of the header, or after a fault. */
static bool read_line(struct reader *reader, const struct line *line, bool *is_end)
{
    const struct zr_ply_word word = line->words[0];
    if (line->count == 0 || zr_ply_word_is(word, "obj_info")) return true;
    if (zr_ply_word_is(word, "format")) return read_form(reader, line);
    if (zr_ply_word_is(word, "element")) return read_element(reader, line);
    if (zr_ply_word_is(word, "property")) return read_property(reader, line);
    *is_end = zr_ply_word_is(word, "end_header");
    if (zr_ply_word_is(word, "comment"))
        read_comment(reader, line);
    else if (!*is_end && reader->header->unknown_count++ == 0)
        reader->header->unknown_line = line->number;
    return !*is_end;
}

/* ---- interface ---- */

/* Counts lines that begin with a word, for the size of an array. */
static size_t count_lines(struct reader reader, const char *word)
{
    struct zr_ply_header counts = {.lines = 0};
    struct line line;
    size_t count = 0;
    reader.header = &counts;
    while (next_line(&reader, &line) && !(line.count > 0 && zr_ply_word_is(line.words[0], "end_header")))
        count += line.count > 0 && zr_ply_word_is(line.words[0], word);
    return count;
}

enum zr_status zr_ply_read_header(struct zr_arena *arena, const char *bytes, size_t size, struct zr_ply_header *header,
                                  struct zr_error *error)
{
    const size_t searched = size < ZR_PLY_HEADER_MAX ? size : ZR_PLY_HEADER_MAX;
    struct reader reader = {
        .at = bytes + mark_size(bytes, size), .end = bytes + searched, .header = header, .error = error};
    struct line line;
    bool is_end = false;
    *header = (struct zr_ply_header){.form = ZR_PLY_ASCII};
    if (!zr_looks_so_PLY(bytes, size)) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "the first line is not 'ply'");
    find_line_end(&reader);
    header->elements = zr_arena_alloc(arena, count_lines(reader, "element"), sizeof *header->elements);
    reader.properties = zr_arena_alloc(arena, count_lines(reader, "property"), sizeof *reader.properties);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    next_line(&reader, &line);
    while (next_line(&reader, &line))
        if (!read_line(&reader, &line, &is_end)) break;
    if (error->count > 0) return error->status;
    if (!is_end && size > searched)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "no end_header within the first %d bytes", ZR_PLY_HEADER_MAX);
    /* The last line of a file without values may lack its end. */
    if (!is_end && (size_t)(reader.end - reader.at) == 10 && memcmp(reader.at, "end_header", 10) == 0) {
        is_end = true;
        reader.at = reader.end;
    }
    if (!is_end) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "the file ends within the header, without end_header");
    if (!reader.has_form) return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "the header has no format");
    header->size = (size_t)(reader.at - bytes);
    return ZR_OK;
}
