#include "input/obj_text.h"

#include <stdlib.h>

#include "input/chunk.h"

/* In each place of a chunk a byte counts the words that begin there: of more chunks it could overflow. */
enum { CHUNKS_TO_COUNT = 255 };

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

/* Many bytes at once: of comments, joined lines, very long ones and the file's last, which ends at `end`,
 * count_one_by_one says it. Room is made for as many corners as are counted here, and whoever reads a face goes from
 * word to word. A fifth of the time of reading. */
size_t zr_obj_count_words(struct zr_obj_statement *statement, const char *end)
{
    zr_chunk begins = {0}, odd = {0};
    for (const char *at = statement->at; at < statement->end; at += ZR_CHUNK) {
        const size_t left = (size_t)(statement->end - at);
        if (end - at < ZR_CHUNK || at - statement->at >= CHUNKS_TO_COUNT * ZR_CHUNK) return count_one_by_one(statement);
        const zr_chunk bytes = zr_chunk_load(at), within = zr_chunk_of_first(left < ZR_CHUNK ? left : ZR_CHUNK);
        begins -= within & zr_chunk_spaces(zr_chunk_load(at - 1)) & ~zr_chunk_spaces(bytes);
        odd |= within & ((zr_chunk)(bytes == '#') | (zr_chunk)(bytes == '\\'));
    }
    return zr_chunk_first(odd) == ZR_CHUNK ? zr_chunk_sum(begins) : count_one_by_one(statement);
}

static int compare_words(const void *key, const void *word)
{
    const struct zr_obj_statement *sought = key;
    const char *text = *(const char *const *)word;
    size_t length = (size_t)(sought->end - sought->at);
    int order = strncmp(sought->at, text, length);
    return order != 0 ? order : text[length] == '\0' ? 0 : -1;
}

static bool is_ignored(const struct zr_obj_statement *word)
{
    static const char *const words[] = {
        "bevel",      "bmat",   "bsp",   "bzp",    "c_interp", "call",      "cdc",  "cdp",    "con",    "csh",
        "cstype",     "ctech",  "curv",  "curv2",  "d_interp", "deg",       "end",  "g",      "hole",   "l",
        "lod",        "maplib", "mg",    "mtllib", "o",        "p",         "parm", "res",    "s",      "scrv",
        "shadow_obj", "sp",     "stech", "step",   "surf",     "trace_obj", "trim", "usemap", "usemtl", "vp"};
    if (memchr(word->at, '\0', (size_t)(word->end - word->at))) return false;
    return bsearch(word, words, sizeof words / sizeof words[0], sizeof words[0], compare_words) != NULL;
}

enum zr_obj_keyword zr_obj_rare_keyword(const struct zr_obj_statement *word)
{
    size_t length = (size_t)(word->end - word->at);
    if (length == 2 && word->at[0] == 'v' && word->at[1] == 'n') return ZR_OBJ_VN;
    if (length == 2 && word->at[0] == 'v' && word->at[1] == 't') return ZR_OBJ_VT;
    return is_ignored(word) ? ZR_OBJ_IGNORED : ZR_OBJ_UNKNOWN;
}

bool zr_obj_has_comment(const char *at, const char *line_end)
{
    for (const char *byte = at; byte < line_end; byte++)
        if (*byte == '#' && (byte == at || zr_obj_is_blank(byte[-1]))) return true;
    return false;
}

/* A line end that no backslash hides ends a statement, be it a comment or not. */
const char *zr_obj_cut(const char *at, size_t size, const char *end)
{
    if ((size_t)(end - at) <= size) return end;
    for (const char *line_end = at + size; line_end < end; line_end++) {
        line_end = memchr(line_end, '\n', (size_t)(end - line_end));
        if (!line_end) break;
        if (!zr_obj_hides_line_end(at, line_end)) return line_end + 1;
    }
    return end;
}
