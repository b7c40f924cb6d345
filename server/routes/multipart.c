#include "multipart.h"

#include <string.h>
#include <strings.h>

/* Unread rest of a text. */
struct text {
    const char *at, *end;
};

static bool fail(const char **fault, const char *why)
{
    *fault = why;
    return false;
}

static bool is_token_char(char c)
{
    static const char SYMBOLS[] = "!#$%&'*+-.^_`|~";
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return letter || (c != '\0' && strchr(SYMBOLS, c));
}

static void skip_blanks(struct text *text)
{
    while (text->at < text->end && (*text->at == ' ' || *text->at == '\t'))
        text->at++;
}

static bool take(struct text *text, char c)
{
    if (text->at == text->end || *text->at != c) return false;
    text->at++;
    return true;
}

static struct text take_token(struct text *text)
{
    struct text token = {text->at, text->at};
    while (text->at < text->end && is_token_char(*text->at))
        text->at++;
    token.end = text->at;
    return token;
}

static bool is_word(struct text text, const char *word)
{
    size_t length = strlen(word);
    return (size_t)(text.end - text.at) == length && strncasecmp(text.at, word, length) == 0;
}

/* Takes the text between quotes, with its backslashes. */
static bool take_quoted(struct text *text, struct text *value)
{
    value->at = ++text->at;
    while (text->at < text->end && *text->at != '"') {
        if (*text->at == '\\' && text->end - text->at > 1) text->at++;
        text->at++;
    }
    value->end = text->at;
    return take(text, '"');
}

/* Takes a value without quotes. Clients send boundaries with '=' and others that need quotes as they are. */
static struct text take_plain(struct text *text, bool is_boundary)
{
    if (!is_boundary) return take_token(text);
    struct text value = {text->at, text->at};
    while (text->at < text->end && !strchr("; \t", *text->at))
        text->at++;
    value.end = text->at;
    return value;
}

/* Takes "; name=value" with the blanks around it. False: none is left; *broken: malformed. */
static bool take_parameter(struct text *text, struct text *name, struct text *value, bool *broken)
{
    skip_blanks(text);
    if (text->at == text->end) return false;
    *broken = true;
    if (!take(text, ';')) return false;
    skip_blanks(text);
    if (text->at == text->end) { /* some clients end with ';' */
        *broken = false;
        return false;
    }
    *name = take_token(text);
    if (name->at == name->end || !take(text, '=')) return false;
    if (text->at < text->end && *text->at == '"') {
        if (!take_quoted(text, value)) return false;
    } else {
        *value = take_plain(text, is_word(*name, "boundary"));
        if (value->at == value->end) return false;
    }
    *broken = false;
    return true;
}

/* ---- the boundary ---- */

/* RFC 2046, section 5.1.1. */
static bool is_boundary(struct text text)
{
    static const char SYMBOLS[] = "'()+_,-./:=? ";
    size_t size = (size_t)(text.end - text.at);
    if (size < 1 || size > MULTIPART_BOUNDARY_MAX || text.end[-1] == ' ') return false;
    for (const char *c = text.at; c < text.end; c++) {
        bool letter = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9');
        if (!letter && (*c == '\0' || !strchr(SYMBOLS, *c))) return false;
    }
    return true;
}

bool multipart_boundary(const char *content_type, char boundary[MULTIPART_BOUNDARY_SIZE], const char **fault)
{
    struct text text = {content_type + strcspn(content_type, "; \t"), content_type + strlen(content_type)};
    struct text name, value;
    bool broken = false;
    boundary[0] = '\0';
    while (take_parameter(&text, &name, &value, &broken)) {
        if (!is_word(name, "boundary")) continue;
        if (boundary[0]) return fail(fault, "Content-Type: two boundaries");
        if (!is_boundary(value))
            return fail(fault, "Content-Type: the boundary is not 1 to 70 of the characters that RFC 2046 allows");
        memcpy(boundary, value.at, (size_t)(value.end - value.at));
        boundary[value.end - value.at] = '\0';
    }
    if (broken) return fail(fault, "Content-Type: its parameters are malformed");
    return boundary[0] || fail(fault, "Content-Type: multipart/form-data without a boundary");
}

/* ---- headers of a part ---- */

static bool read_name(struct text value, struct multipart_part *part, const char **fault)
{
    size_t size = (size_t)(value.end - value.at);
    if (size < 1 || size > MULTIPART_NAME_MAX) return fail(fault, "a part's name is not 1 to 128 bytes long");
    for (const char *c = value.at; c < value.end; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7F || *c == '\\')
            return fail(fault, "a part's name has a control character or a backslash");
    memcpy(part->name, value.at, size);
    part->name[size] = '\0';
    return true;
}

static bool read_disposition(struct text text, struct multipart_part *part, const char **fault)
{
    struct text name, value;
    bool broken = false;
    if (part->name[0]) return fail(fault, "a part has two Content-Disposition headers");
    if (!is_word(take_token(&text), "form-data")) return fail(fault, "a part's Content-Disposition is not form-data");
    while (take_parameter(&text, &name, &value, &broken)) {
        if (!is_word(name, "name")) continue;
        if (part->name[0]) return fail(fault, "a part has two names");
        if (!read_name(value, part, fault)) return false;
    }
    if (broken) return fail(fault, "a part's Content-Disposition is malformed");
    return part->name[0] || fail(fault, "a part has no name");
}

static bool read_header(struct text line, struct multipart_part *part, const char **fault)
{
    struct text name = take_token(&line);
    if (name.at == name.end || !take(&line, ':')) return fail(fault, "a part's header is malformed");
    for (const char *c = line.at; c < line.end; c++)
        if (((unsigned char)*c < ' ' && *c != '\t') || *c == 0x7F)
            return fail(fault, "a part's header has a control character");
    skip_blanks(&line);
    while (line.end > line.at && (line.end[-1] == ' ' || line.end[-1] == '\t'))
        line.end--;
    if (is_word(name, "Content-Disposition")) return read_disposition(line, part, fault);
    if (is_word(name, "Content-Transfer-Encoding") && !is_word(line, "binary") && !is_word(line, "8bit") &&
        !is_word(line, "7bit"))
        return fail(fault, "a part has a Content-Transfer-Encoding; send its bytes as they are");
    if (is_word(name, "Zraster-Use")) part->is_optional = is_word(line, "optional");
    if (is_word(name, "Content-Type")) {
        if (part->type) return fail(fault, "a part has two Content-Type headers");
        part->type = line.at;
        part->type_size = (size_t)(line.end - line.at);
    }
    return true;
}

/* Reads headers to the empty line, and skips that. */
static bool read_headers(struct text *body, struct multipart_part *part, const char **fault)
{
    size_t left = (size_t)(body->end - body->at), room = left < MULTIPART_HEADER_MAX ? left : MULTIPART_HEADER_MAX;
    const char *begin = body->at;
    for (;;) {
        size_t used = (size_t)(body->at - begin);
        const char *end = memmem(body->at, room - used, "\r\n", 2);
        if (!end)
            return fail(fault,
                        room < left ? "a part's headers have more than 4096 bytes" : "a part's headers break off");
        struct text line = {body->at, end};
        body->at = end + 2;
        if (line.at == line.end) break;
        if (!read_header(line, part, fault)) return false;
    }
    return part->name[0] || fail(fault, "a part has no Content-Disposition");
}

/* ---- parts ---- */

enum delimiter { DELIMITER_NEXT, DELIMITER_LAST, DELIMITER_BROKEN };

/* Takes the rest of a boundary line: blanks and a line end, or "--". */
static enum delimiter take_delimiter(struct text *body)
{
    struct text after = *body;
    if (take(&after, '-')) return take(&after, '-') ? DELIMITER_LAST : DELIMITER_BROKEN;
    skip_blanks(&after);
    if (!take(&after, '\r') || !take(&after, '\n')) return DELIMITER_BROKEN;
    *body = after;
    return DELIMITER_NEXT;
}

/* Finds the first boundary. At the beginning of the body it has no line break before it. */
static bool skip_preamble(struct text *body, const char *mark, size_t mark_size)
{
    size_t left = (size_t)(body->end - body->at);
    if (left >= mark_size - 2 && memcmp(body->at, mark + 2, mark_size - 2) == 0) {
        body->at += mark_size - 2;
        return true;
    }
    const char *found = memmem(body->at, left, mark, mark_size);
    if (found) body->at = found + mark_size;
    return found != NULL;
}

static bool read_part(struct text *body, const char *mark, size_t mark_size, struct multipart *out, const char **fault)
{
    if (out->count == MULTIPART_PARTS_MAX) return fail(fault, "the body has more than 256 parts");
    struct multipart_part *part = &out->parts[out->count];
    *part = (struct multipart_part){.type = NULL};
    if (!read_headers(body, part, fault)) return false;
    if (multipart_find(out, part->name)) return fail(fault, "two parts have the same name");
    /* In an empty part, the line break of the boundary may be that of the header's end. */
    const char *from = body->at - 2, *found = memmem(from, (size_t)(body->end - from), mark, mark_size);
    if (!found) return fail(fault, "the body ends without its closing boundary");
    part->bytes = body->at;
    part->size = found > body->at ? (size_t)(found - body->at) : 0;
    body->at = found + mark_size;
    out->count++;
    return true;
}

bool multipart_parse(const char *boundary, const char *bytes, size_t size, struct multipart *out, const char **fault)
{
    char mark[4 + MULTIPART_BOUNDARY_SIZE] = "\r\n--";
    size_t length = strlen(boundary), mark_size = 4 + length;
    memcpy(mark + 4, boundary, length + 1);
    struct text body = {bytes, bytes + size};
    out->count = 0;
    if (!skip_preamble(&body, mark, mark_size))
        return fail(fault, "the body does not contain the boundary that Content-Type names");
    for (;;) {
        switch (take_delimiter(&body)) {
        case DELIMITER_LAST:
            return true;
        case DELIMITER_BROKEN:
            return fail(fault, body.at == body.end ? "the body ends without its closing boundary"
                                                   : "bytes follow a boundary in its line");
        case DELIMITER_NEXT:
            break;
        }
        if (!read_part(&body, mark, mark_size, out, fault)) return false;
    }
}

const struct multipart_part *multipart_find(const struct multipart *multipart, const char *name)
{
    for (size_t i = 0; i < multipart->count; i++)
        if (strcmp(multipart->parts[i].name, name) == 0) return &multipart->parts[i];
    return NULL;
}
