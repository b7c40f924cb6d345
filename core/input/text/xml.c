#include "input/text/xml.h"

/* Between two checks for cancellation, some 20 microseconds: STEPS elements, SKIPPED_AT_ONCE bytes of text. */
enum { STEPS = 256, SKIPPED_AT_ONCE = 1 << 18 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/* Bytes of UTF-8 sequences count as letters. */
static bool begins_name(char c)
{
    return (unsigned char)((c | 0x20) - 'a') < 26 || c == '_' || (unsigned char)c >= 0x80;
}

static bool continues_name(char c)
{
    return begins_name(c) || (unsigned char)(c - '0') < 10 || c == '-' || c == '.';
}

static enum zr_xml_event fault(struct zr_xml *xml, const char *at, const char *text)
{
    xml->at = at;
    zr_reason_give(&xml->reason, "%s", text);
    return ZR_XML_FAULT;
}

static enum zr_xml_event name_fault(struct zr_xml *xml, const char *at, const char *text, struct zr_xml_text name)
{
    xml->at = at;
    zr_reason_give(&xml->reason, "%s %s", text, zr_quote(name.at, name.length).text);
    return ZR_XML_FAULT;
}

/* ---- skipped text ---- */

/* Returns the first place of `word` at or after `at`; NULL if there is none, or after a cancel. */
static const char *find(struct zr_xml *xml, const char *at, const char *word)
{
    const size_t length = strlen(word);
    while ((size_t)(xml->end - at) >= length) {
        const size_t left = (size_t)(xml->end - at), size = left < SKIPPED_AT_ONCE ? left : SKIPPED_AT_ONCE;
        const char *found = length == 1 ? memchr(at, *word, size) : memmem(at, size, word, length);
        if (found || size == left || zr_is_cancelled(xml->cancel)) return found;
        at += size - length + 1;
    }
    return NULL;
}

/* Checks a reference such as &lt; or &#x41;. Returns the byte after it; NULL for any other text. */
static const char *check_reference(const char *at, const char *end)
{
    static const char *const names[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const size_t length = strlen(names[i]);
        if ((size_t)(end - at) >= length && memcmp(at, names[i], length) == 0) return at + length;
    }
    if (end - at < 4 || at[1] != '#') return NULL;
    const bool is_hex = at[2] == 'x';
    const char *digit = at + (is_hex ? 3 : 2);
    unsigned long value = 0;
    const char *const first = digit;
    for (; digit < end && zr_hex_digit(*digit) >= 0 && (is_hex || zr_hex_digit(*digit) < 10); digit++)
        if (value <= 0x10FFFF) value = value * (is_hex ? 16 : 10) + (unsigned long)zr_hex_digit(*digit);
    const bool is_character = value > 0 && value <= 0x10FFFF && (value < 0xD800 || value > 0xDFFF);
    return digit > first && digit < end && *digit == ';' && is_character ? digit + 1 : NULL;
}

/* Returns the place of the first invalid reference; NULL if there is none. */
static const char *find_wrong_reference(const char *at, const char *end)
{
    while (at < end && (at = memchr(at, '&', (size_t)(end - at))) != NULL) {
        const char *behind = check_reference(at, end);
        if (!behind) return at;
        at = behind;
    }
    return NULL;
}

static enum zr_xml_event reference_fault(struct zr_xml *xml, const char *at)
{
    return fault(xml, at, "a '&' that begins no reference; entities are not defined here");
}

/* Skips text up to the next '<' or the end. ZR_XML_BEGIN: good. */
static enum zr_xml_event skip_text(struct zr_xml *xml)
{
    while (xml->at < xml->end && *xml->at != '<') {
        const size_t left = (size_t)(xml->end - xml->at), size = left < SKIPPED_AT_ONCE ? left : SKIPPED_AT_ONCE;
        const char *next = memchr(xml->at, '<', size);
        const char *stop = next ? next : xml->at + size;
        for (const char *at = xml->at; xml->depth == 0 && at < stop; at++)
            if (!is_blank(*at)) return fault(xml, at, "text outside of the root element");
        const char *wrong = find_wrong_reference(xml->at, stop);
        if (wrong && (next || size == left)) return reference_fault(xml, wrong);
        if (wrong == xml->at) return reference_fault(xml, wrong);
        xml->at = wrong ? wrong : stop; /* the end of the piece may split a reference */
        if (zr_is_cancelled(xml->cancel)) return ZR_XML_CANCELLED;
    }
    return ZR_XML_BEGIN;
}

/* Checks the encoding that <?xml ... ?> names. */
static enum zr_xml_event check_declaration(struct zr_xml *xml, const char *at, const char *end)
{
    static const char word[] = "encoding";
    const char *found = memmem(at, (size_t)(end - at), word, sizeof word - 1);
    if (!found) return ZR_XML_BEGIN;
    for (found += sizeof word - 1; found < end && (is_blank(*found) || *found == '='); found++)
        ;
    if (found == end || (*found != '"' && *found != '\'')) return fault(xml, at, "the encoding is not in quotes");
    const char *name = found + 1, *behind = memchr(name, *found, (size_t)(end - name));
    const struct zr_xml_text text = {name, behind ? (size_t)(behind - name) : 0};
    if (text.length == 5 && (memcmp(text.at, "UTF-8", 5) == 0 || memcmp(text.at, "utf-8", 5) == 0)) return ZR_XML_BEGIN;
    if (text.length == 8 && (memcmp(text.at, "US-ASCII", 8) == 0 || memcmp(text.at, "us-ascii", 8) == 0))
        return ZR_XML_BEGIN;
    return name_fault(xml, at, "only UTF-8 is read, and the encoding is", text);
}

/* Skips a comment, an instruction or a CDATA section; refuses a document type. ZR_XML_BEGIN: good. */
static enum zr_xml_event skip_mark(struct zr_xml *xml)
{
    static const struct {
        const char *begin, *end, *missing;
    } marks[] = {{"<!--", "-->", "a comment without an end"},
                 {"<?", "?>", "an instruction without an end"},
                 {"<![CDATA[", "]]>", "a CDATA section without an end"}};
    const char *at = xml->at;
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
        const size_t length = strlen(marks[i].begin);
        if ((size_t)(xml->end - at) < length || memcmp(at, marks[i].begin, length) != 0) continue;
        const char *end = find(xml, at + length, marks[i].end);
        if (zr_is_cancelled(xml->cancel)) return ZR_XML_CANCELLED;
        if (!end) return fault(xml, at, marks[i].missing);
        if (i == 2 && xml->depth == 0) return fault(xml, at, "text outside of the root element");
        if (i == 1 && end - at > 6 && memcmp(at, "<?xml", 5) == 0 && is_blank(at[5]) &&
            check_declaration(xml, at, end) == ZR_XML_FAULT)
            return ZR_XML_FAULT;
        xml->at = end + strlen(marks[i].end);
        return ZR_XML_BEGIN;
    }
    if (xml->end - at >= 9 && memcmp(at, "<!DOCTYPE", 9) == 0)
        return fault(xml, at, "a document type (DOCTYPE), which can define entities, is not allowed");
    return fault(xml, at, "'<!' begins neither a comment nor a CDATA section");
}

/* ---- tags ---- */

/* Reads a name with its prefix at *at; false if there is none. */
static bool read_name(const struct zr_xml *xml, const char **at, struct zr_xml_text *prefix, struct zr_xml_text *name)
{
    const char *first = *at, *next = first;
    *prefix = (struct zr_xml_text){first, 0};
    if (next == xml->end || !begins_name(*next)) return false;
    const char *const most = xml->end - next > ZR_XML_WORD_MAX ? next + ZR_XML_WORD_MAX : xml->end;
    while (next < most && continues_name(*next))
        next++;
    if (next < most && *next == ':') {
        prefix->length = (size_t)(next - first);
        first = ++next;
        if (next == most || !begins_name(*next)) return false;
        while (next < most && continues_name(*next))
            next++;
        if (next < most && *next == ':') return false;
    }
    *name = (struct zr_xml_text){first, (size_t)(next - first)};
    *at = next;
    return next < most;
}

static void skip_blanks(const struct zr_xml *xml, const char **at)
{
    while (*at < xml->end && is_blank(**at))
        ++*at;
}

/* Reads = and a value in quotes. ZR_XML_BEGIN: good. */
static enum zr_xml_event read_value(struct zr_xml *xml, const char **at, struct zr_xml_attribute *attribute)
{
    skip_blanks(xml, at);
    if (*at == xml->end || **at != '=') return name_fault(xml, *at, "'=' is missing behind", attribute->name);
    ++*at;
    skip_blanks(xml, at);
    if (*at == xml->end || (**at != '"' && **at != '\''))
        return name_fault(xml, *at, "a value in quotes is missing behind", attribute->name);
    const char quote = **at, *first = ++*at, *next = first;
    const char *const most = xml->end - next > ZR_XML_WORD_MAX ? next + ZR_XML_WORD_MAX : xml->end;
    bool has_references = false;
    for (; next < most && *next != quote; next++) {
        if (*next == '<') return name_fault(xml, next, "a '<' in the value of", attribute->name);
        has_references |= *next == '&';
    }
    if (next == most) return name_fault(xml, first, "the value has no end, or more than 1 MiB:", attribute->name);
    attribute->value = (struct zr_xml_text){first, (size_t)(next - first)};
    *at = next + 1;
    const char *wrong = has_references ? find_wrong_reference(first, next) : NULL;
    return wrong ? reference_fault(xml, wrong) : ZR_XML_BEGIN;
}

static int number_of(const struct zr_xml *xml, struct zr_xml_text uri)
{
    for (int i = 0; i < xml->uri_count; i++)
        if (zr_xml_text_is(uri, xml->uris[i])) return i;
    return ZR_XML_OTHER_NAMESPACE;
}

/* Declares a namespace for the element at depth xml->depth. ZR_XML_BEGIN: good. */
static enum zr_xml_event bind(struct zr_xml *xml, const char *at, struct zr_xml_text prefix, struct zr_xml_text uri)
{
    if (prefix.length == 0) xml->defaults[xml->depth - 1] = uri.length ? number_of(xml, uri) : ZR_XML_NO_NAMESPACE;
    if (xml->binding_count == ZR_XML_NAMESPACES_MAX) return fault(xml, at, "more than 64 namespaces");
    xml->bindings[xml->binding_count++] = (struct zr_xml_binding){prefix, uri, number_of(xml, uri), xml->depth};
    return ZR_XML_BEGIN;
}

/* Adds an attribute to the tag, or declares a namespace. ZR_XML_BEGIN: good. */
static enum zr_xml_event take(struct zr_xml *xml, const char *at, struct zr_xml_tag *tag,
                              const struct zr_xml_attribute *attribute)
{
    if (attribute->prefix.length == 0 && zr_xml_text_is(attribute->name, "xmlns"))
        return bind(xml, at, attribute->prefix, attribute->value);
    if (zr_xml_text_is(attribute->prefix, "xmlns")) return bind(xml, at, attribute->name, attribute->value);
    for (size_t i = 0; i < tag->count; i++)
        if (zr_xml_texts_equal(tag->attributes[i].name, attribute->name) &&
            zr_xml_texts_equal(tag->attributes[i].prefix, attribute->prefix))
            return name_fault(xml, at, "an element repeats the attribute", attribute->name);
    if (tag->count == ZR_XML_ATTRIBUTES_MAX) return fault(xml, at, "an element with more than 64 attributes");
    tag->attributes[tag->count++] = *attribute;
    return ZR_XML_BEGIN;
}

static struct zr_xml_text whole_name(const struct zr_xml_tag *tag)
{
    const char *first = tag->prefix.length ? tag->prefix.at : tag->name.at;
    return (struct zr_xml_text){first, (size_t)(tag->name.at + tag->name.length - first)};
}

static enum zr_xml_event read_begin(struct zr_xml *xml, struct zr_xml_tag *tag)
{
    const char *at = xml->at + 1;
    enum zr_xml_event event = ZR_XML_BEGIN;
    if (!read_name(xml, &at, &tag->prefix, &tag->name))
        return fault(xml, xml->at, "'<' without the name of an element");
    if (xml->depth == 0 && xml->has_root) return fault(xml, xml->at, "a second root element");
    if (xml->depth == ZR_XML_DEPTH_MAX) return fault(xml, xml->at, "elements nested more than 64 deep");
    xml->open[xml->depth] = whole_name(tag);
    xml->defaults[xml->depth] = xml->depth ? xml->defaults[xml->depth - 1] : ZR_XML_NO_NAMESPACE;
    xml->depth++;
    xml->has_root = true;
    for (;;) {
        const char *const before = at;
        skip_blanks(xml, &at);
        if (at == xml->end) return name_fault(xml, xml->at, "the end is missing: tag", tag->name);
        if (*at == '>') break;
        if (*at == '/' && xml->end - at > 1 && at[1] == '>') break;
        struct zr_xml_attribute attribute;
        const char *const first = at;
        if (at == before || !read_name(xml, &at, &attribute.prefix, &attribute.name))
            return name_fault(xml, at, "neither an attribute nor the end of the tag", tag->name);
        event = read_value(xml, &at, &attribute);
        if (event == ZR_XML_BEGIN) event = take(xml, first, tag, &attribute);
        if (event != ZR_XML_BEGIN) return event;
    }
    xml->ends_next = *at == '/';
    xml->at = at + (xml->ends_next ? 2 : 1);
    tag->space = tag->prefix.length ? zr_xml_space(xml, tag->prefix) : xml->defaults[xml->depth - 1];
    return ZR_XML_BEGIN;
}

/* Closes the innermost element. */
static enum zr_xml_event close(struct zr_xml *xml)
{
    while (xml->binding_count > 0 && xml->bindings[xml->binding_count - 1].depth == xml->depth)
        xml->binding_count--;
    xml->depth--;
    xml->ends_next = false;
    return ZR_XML_END;
}

static enum zr_xml_event read_end(struct zr_xml *xml, struct zr_xml_tag *tag)
{
    const char *at = xml->at + 2;
    if (!read_name(xml, &at, &tag->prefix, &tag->name)) return fault(xml, xml->at, "'</' without a name");
    skip_blanks(xml, &at);
    if (at == xml->end || *at != '>') return name_fault(xml, xml->at, "the end is missing: tag", tag->name);
    if (xml->depth == 0 || !zr_xml_texts_equal(xml->open[xml->depth - 1], whole_name(tag)))
        return name_fault(xml, xml->at, "this tag ends another element than the innermost one:", tag->name);
    xml->at = at + 1;
    return close(xml);
}

/* ---- interface ---- */

void zr_xml_open(struct zr_xml *xml, const char *bytes, size_t size, const char *const *uris, int uri_count,
                 const struct zr_cancel *cancel)
{
    const bool has_mark = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0;
    xml->bytes = bytes;
    xml->at = bytes + (has_mark ? 3 : 0);
    xml->end = bytes + size;
    xml->uris = uris;
    xml->uri_count = uri_count;
    xml->cancel = cancel;
    xml->depth = xml->binding_count = 0;
    xml->ends_next = xml->has_root = false;
    xml->steps = 0;
    xml->reason.text[0] = '\0';
}

static bool is_utf16(const struct zr_xml *xml)
{
    const char *at = xml->bytes;
    return xml->end - at >= 2 && (memcmp(at, "\xFF\xFE", 2) == 0 || memcmp(at, "\xFE\xFF", 2) == 0 ||
                                  memcmp(at, "<\0", 2) == 0 || memcmp(at, "\0<", 2) == 0);
}

enum zr_xml_event zr_xml_next(struct zr_xml *xml, struct zr_xml_tag *tag)
{
    tag->count = 0;
    tag->at = xml->at;
    if (xml->ends_next) return close(xml);
    if (++xml->steps % STEPS == 0 && zr_is_cancelled(xml->cancel)) return ZR_XML_CANCELLED;
    if (!xml->has_root && is_utf16(xml)) return fault(xml, xml->bytes, "UTF-16; only UTF-8 is read");
    for (;;) {
        enum zr_xml_event event = skip_text(xml);
        if (event != ZR_XML_BEGIN) return event;
        tag->at = xml->at;
        if (xml->at == xml->end) break;
        const char second = xml->end - xml->at > 1 ? xml->at[1] : '\0';
        if (second == '/') return read_end(xml, tag);
        if (second != '!' && second != '?') return read_begin(xml, tag);
        event = skip_mark(xml);
        if (event != ZR_XML_BEGIN) return event;
        if (++xml->steps % STEPS == 0 && zr_is_cancelled(xml->cancel)) return ZR_XML_CANCELLED;
    }
    if (xml->depth > 0) return name_fault(xml, xml->end, "the text ends within the element", xml->open[xml->depth - 1]);
    return xml->has_root ? ZR_XML_DONE : fault(xml, xml->end, "no element");
}

struct zr_xml_text zr_xml_uri(const struct zr_xml *xml, struct zr_xml_text prefix)
{
    for (size_t i = xml->binding_count; i-- > 0;)
        if (zr_xml_texts_equal(xml->bindings[i].prefix, prefix)) return xml->bindings[i].uri;
    return (struct zr_xml_text){"", 0};
}

int zr_xml_space(const struct zr_xml *xml, struct zr_xml_text prefix)
{
    for (size_t i = xml->binding_count; i-- > 0;)
        if (zr_xml_texts_equal(xml->bindings[i].prefix, prefix)) return xml->bindings[i].space;
    return ZR_XML_OTHER_NAMESPACE;
}

struct zr_xml_text zr_xml_value(const struct zr_xml_tag *tag, const char *name)
{
    for (size_t i = 0; i < tag->count; i++)
        if (tag->attributes[i].prefix.length == 0 && zr_xml_text_is(tag->attributes[i].name, name))
            return tag->attributes[i].value;
    return (struct zr_xml_text){NULL, 0};
}

/* Writes a character as UTF-8; returns the byte after it. */
static char *put_character(char *out, unsigned long value)
{
    const int more = value < 0x80 ? 0 : value < 0x800 ? 1 : value < 0x10000 ? 2 : 3;
    static const unsigned char leads[] = {0, 0xC0, 0xE0, 0xF0};
    *out++ = (char)(leads[more] | value >> (6 * more));
    for (int i = more; i-- > 0;)
        *out++ = (char)(0x80 | ((value >> (6 * i)) & 0x3F));
    return out;
}

/* The value's length suffices: a reference is longer than its character. */
const char *zr_xml_decode(struct zr_arena *arena, struct zr_xml_text value)
{
    char *text = zr_arena_alloc(arena, value.length + 1, 1), *out = text;
    const char *at = value.at, *const end = at + value.length;
    while (text && at < end) {
        if (*at != '&') {
            *out++ = *at++;
            continue;
        }
        const bool is_hex = at[2] == 'x';
        const char *digit = at + (is_hex ? 3 : 2);
        unsigned long code = 0;
        for (; at[1] == '#' && *digit != ';'; digit++)
            code = code * (is_hex ? 16 : 10) + (unsigned long)zr_hex_digit(*digit);
        if (at[1] != '#')
            code = at[1] == 'l' ? '<' : at[1] == 'g' ? '>' : at[1] == 'q' ? '"' : at[2] == 'm' ? '&' : '\'';
        out = put_character(out, code);
        at = (const char *)memchr(at, ';', (size_t)(end - at)) + 1;
    }
    if (text) *out = '\0';
    return text;
}
