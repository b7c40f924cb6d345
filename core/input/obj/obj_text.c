#include "input/obj/obj_text.h"

#include <stdlib.h>

#include "input/text/chunk.h"
#include "input/text/text.h"

struct zr_obj_statement zr_obj_word(struct zr_obj_statement *statement)
{
    struct zr_obj_statement word = *statement;
    while (!zr_obj_ends_word(statement, statement->at))
        statement->at++;
    word.end = statement->at;
    return word;
}

static size_t count_one_by_one(struct zr_obj_statement *statement)
{
    size_t count = 0;
    for (zr_obj_skip_blanks(statement); !zr_obj_at_end(statement); zr_obj_skip_blanks(statement), count++)
        zr_obj_word(statement);
    return count;
}

/* Bit i: byte i of two chunks is a space; is a '#' or a backslash. */
struct marks {
    uint32_t spaces, odd;
};

static inline struct marks mark(const char *at)
{
    const zr_chunk low = zr_chunk_load(at), high = zr_chunk_load(at + ZR_CHUNK);
    const zr_chunk odd_low = (zr_chunk)(low == '#') | (zr_chunk)(low == '\\'),
                   odd_high = (zr_chunk)(high == '#') | (zr_chunk)(high == '\\');
    return (struct marks){zr_chunk_bits(zr_chunk_spaces(low)) | zr_chunk_bits(zr_chunk_spaces(high)) << ZR_CHUNK,
                          zr_chunk_bits(odd_low) | zr_chunk_bits(odd_high) << ZR_CHUNK};
}

/* Counts bits of which no two are adjacent. __builtin_popcount calls a library function on processors without the
 * instruction. */
static inline uint32_t count_apart(uint32_t bits)
{
    bits = (bits | bits >> 1) & 0x55555555;
    bits = (bits & 0x33333333) + (bits >> 2 & 0x33333333);
    return ((bits + (bits >> 4)) & 0x0F0F0F0F) * 0x01010101u >> 24;
}

/* Counts 32 bytes at a time. Statements with comments or continued lines, and the last bytes of the file, are counted
 * word by word. The array has room for the corners counted here, and the reader of faces splits words in the same
 * way. */
size_t zr_obj_count_words(struct zr_obj_statement *statement, const char *end)
{
    enum { BYTES = 2 * ZR_CHUNK };
    size_t count = 0;
    uint32_t space_before = 0; /* the keyword is before */
    for (const char *at = statement->at; at < statement->end; at += BYTES) {
        if (end - at < BYTES) return count_one_by_one(statement);
        const struct marks marks = mark(at);
        const size_t left = (size_t)(statement->end - at);
        const uint32_t within = left < BYTES ? (UINT32_C(1) << left) - 1 : UINT32_MAX;
        if (marks.odd & within) return count_one_by_one(statement);
        count += count_apart(~marks.spaces & (marks.spaces << 1 | space_before) & within);
        space_before = marks.spaces >> (BYTES - 1);
    }
    return count;
}

bool zr_obj_is_short_face(struct zr_obj_statement face, const char *end)
{
    return zr_obj_count_words(&face, end) < ZR_OBJ_CORNERS_LEAST;
}

bool zr_obj_at_not_finite(struct zr_obj_statement statement)
{
    const struct zr_obj_statement word = zr_obj_word(&statement);
    return zr_is_not_finite(word.at, (size_t)(word.end - word.at));
}

bool zr_obj_is_bad_color(struct zr_obj_statement vertex, const char *end)
{
    struct zr_obj_statement counted = vertex;
    bool is_bad = false;
    if (zr_obj_count_words(&counted, end) != 6) return false;
    for (int i = 0; i < 6; i++) {
        zr_obj_skip_blanks(&vertex);
        is_bad = is_bad || (i >= 3 && zr_obj_at_not_finite(vertex));
        zr_obj_word(&vertex);
    }
    return is_bad;
}

struct rare_word {
    const char *text;
    enum zr_obj_keyword keyword;
};

static int compare_words(const void *key, const void *rare_word)
{
    const struct zr_obj_statement *sought = key;
    const char *text = ((const struct rare_word *)rare_word)->text;
    size_t length = (size_t)(sought->end - sought->at);
    int order = strncmp(sought->at, text, length);
    return order != 0 ? order : text[length] == '\0' ? 0 : -1;
}

enum zr_obj_keyword zr_obj_rare_keyword(const struct zr_obj_statement *word)
{
    static const struct rare_word words[] = {
        {"bevel", ZR_OBJ_IGNORED},   {"bmat", ZR_OBJ_IGNORED},     {"bsp", ZR_OBJ_CURVED},
        {"bzp", ZR_OBJ_CURVED},      {"c_interp", ZR_OBJ_IGNORED}, {"call", ZR_OBJ_CALL},
        {"cdc", ZR_OBJ_CURVED},      {"cdp", ZR_OBJ_CURVED},       {"con", ZR_OBJ_IGNORED},
        {"csh", ZR_OBJ_CALL},        {"cstype", ZR_OBJ_IGNORED},   {"ctech", ZR_OBJ_IGNORED},
        {"curv", ZR_OBJ_CURVED},     {"curv2", ZR_OBJ_IGNORED},    {"d_interp", ZR_OBJ_IGNORED},
        {"deg", ZR_OBJ_IGNORED},     {"end", ZR_OBJ_IGNORED},      {"g", ZR_OBJ_GROUP},
        {"hole", ZR_OBJ_IGNORED},    {"l", ZR_OBJ_LINE},           {"lod", ZR_OBJ_IGNORED},
        {"maplib", ZR_OBJ_MAPS},     {"mg", ZR_OBJ_IGNORED},       {"mtllib", ZR_OBJ_LIBRARY},
        {"o", ZR_OBJ_OBJECT},        {"p", ZR_OBJ_POINT},          {"parm", ZR_OBJ_IGNORED},
        {"res", ZR_OBJ_IGNORED},     {"s", ZR_OBJ_SMOOTH},         {"scrv", ZR_OBJ_IGNORED},
        {"shadow_obj", ZR_OBJ_NAME}, {"sp", ZR_OBJ_IGNORED},       {"stech", ZR_OBJ_IGNORED},
        {"step", ZR_OBJ_IGNORED},    {"surf", ZR_OBJ_CURVED},      {"trace_obj", ZR_OBJ_NAME},
        {"trim", ZR_OBJ_IGNORED},    {"usemap", ZR_OBJ_MAPS},      {"usemtl", ZR_OBJ_USE},
        {"vp", ZR_OBJ_CURVED}};
    size_t length = (size_t)(word->end - word->at);
    if (length == 2 && word->at[0] == 'v' && word->at[1] == 'n') return ZR_OBJ_VN; /* frequent */
    if (length == 2 && word->at[0] == 'v' && word->at[1] == 't') return ZR_OBJ_VT;
    if (length == 6 && memcmp(word->at, "usemtl", 6) == 0) return ZR_OBJ_USE; /* some programs write one per face */
    if (memchr(word->at, '\0', length)) return ZR_OBJ_UNKNOWN;
    const struct rare_word *found =
        bsearch(word, words, sizeof words / sizeof words[0], sizeof words[0], compare_words);
    return found ? found->keyword : ZR_OBJ_UNKNOWN;
}

bool zr_obj_has_comment(const char *at, const char *line_end)
{
    for (const char *byte = at; byte < line_end; byte++)
        if (*byte == '#' && (byte == at || zr_obj_is_blank(byte[-1]))) return true;
    return false;
}

bool zr_obj_ends_with_line(const char *at, const char *line_end)
{
    struct zr_obj_statement statement = {at, line_end + 1, 0}, word; /* with the continuation */
    zr_obj_skip_blanks(&statement);
    if (zr_obj_at_end(&statement)) return false;
    switch (zr_obj_next_keyword(&statement, &word)) {
    case ZR_OBJ_LIBRARY:
    case ZR_OBJ_USE:
    case ZR_OBJ_OBJECT:
    case ZR_OBJ_GROUP:
    case ZR_OBJ_MAPS:
    case ZR_OBJ_NAME:
    case ZR_OBJ_CALL:
    case ZR_OBJ_UNKNOWN:
        return true;
    default:
        return false;
    }
}

/* Returns the next run of carriage returns without a line feed after it, or NULL. Sets *behind to its end. */
static const char *next_returns(const char *at, const char *last, const char *end, const char **behind)
{
    while ((at = memchr(at, '\r', (size_t)(last - at))) != NULL) {
        const char *run = at;
        while (at < last && *at == '\r')
            at++;
        if (at < end && *at != '\n') {
            *behind = at;
            return run;
        }
    }
    return NULL;
}

size_t zr_obj_count_returns(const char *at, const char *behind, const char *end)
{
    size_t count = 0;
    for (const char *next; (at = next_returns(at, behind, end, &next)) != NULL; at = next)
        count += (size_t)(next - at);
    return count;
}

void zr_obj_replace_returns(char *at, const char *end)
{
    const char *run, *next = at;
    while ((run = next_returns(next, end, end, &next)) != NULL)
        memset(at + (run - at), '\n', (size_t)(next - run));
}

/* A line end without a backslash ends every statement, also a comment. */
const char *zr_obj_cut(const char *at, size_t size, const char *end)
{
    for (const char *line_end = at + size; line_end < end; line_end++) {
        line_end = memchr(line_end, '\n', (size_t)(end - line_end));
        if (!line_end) break;
        if (!zr_obj_hides_line_end(at, line_end)) return line_end + 1;
    }
    return end;
}
