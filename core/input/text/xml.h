/* xml.h - input: pull reader of XML in memory, without allocations: elements and their attributes, no text.
 *
 *     struct zr_xml xml;
 *     struct zr_xml_tag tag;
 *     zr_xml_open(&xml, bytes, size, uris, uri_count, cancel);
 *     while (zr_xml_next(&xml, &tag) == ZR_XML_BEGIN) ...
 *
 * Safe:   a document type is refused, so the only entities are &lt; &gt; &amp; &quot; &apos; and character numbers.
 *         Depth, attributes per element and namespaces are bounded. The encoding is UTF-8.
 * Source: XML 1.0, fifth edition; Namespaces in XML 1.0, third edition.
 */
#ifndef ZR_XML_H
#define ZR_XML_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "input/text/text.h"

enum { ZR_XML_DEPTH_MAX = 64, ZR_XML_ATTRIBUTES_MAX = 64, ZR_XML_NAMESPACES_MAX = 64, ZR_XML_WORD_MAX = 1 << 20 };

/* Bytes of the document. */
struct zr_xml_text {
    const char *at;
    size_t length;
};

struct zr_xml_attribute {
    struct zr_xml_text prefix, name; /* before and after the colon; prefix: may be empty */
    struct zr_xml_text value;        /* as written: zr_xml_decode replaces references */
};

/* Numbers of namespaces: the index in the caller's list, or one of these. */
enum { ZR_XML_NO_NAMESPACE = -1, ZR_XML_OTHER_NAMESPACE = -2 };

/* An element's begin or end. */
struct zr_xml_tag {
    const char *at; /* place in the document */
    struct zr_xml_text prefix, name;
    int space;    /* number of the namespace */
    size_t count; /* of attributes; 0 at an end */
    struct zr_xml_attribute attributes[ZR_XML_ATTRIBUTES_MAX];
};

struct zr_xml {
    const char *bytes, *at, *end;
    const char *const *uris;
    int uri_count;
    const struct zr_cancel *cancel;
    size_t depth;                              /* of open elements */
    struct zr_xml_text open[ZR_XML_DEPTH_MAX]; /* names with their prefixes */
    int defaults[ZR_XML_DEPTH_MAX];            /* namespaces of names without a prefix */
    size_t binding_count;
    struct zr_xml_binding {
        struct zr_xml_text prefix, uri;
        int space;
        size_t depth; /* of its element */
    } bindings[ZR_XML_NAMESPACES_MAX];
    bool ends_next; /* the next event is the end of an empty element */
    bool has_root;
    unsigned steps;          /* steps since the last check of `cancel` */
    struct zr_reason reason; /* reason of a fault */
};

enum zr_xml_event {
    ZR_XML_BEGIN,
    ZR_XML_END,      /* end of the innermost open element; xml->depth is its parent's */
    ZR_XML_DONE,     /* end of the document */
    ZR_XML_FAULT,    /* xml->reason; the place is xml->at */
    ZR_XML_CANCELLED /* possible at any time */
};

void zr_xml_open(struct zr_xml *xml, const char *bytes, size_t size, const char *const *uris, int uri_count,
                 const struct zr_cancel *cancel);

/* Reads up to the next begin or end of an element. */
enum zr_xml_event zr_xml_next(struct zr_xml *xml, struct zr_xml_tag *tag);

/* Returns the namespace of a prefix that is declared here. */
int zr_xml_space(const struct zr_xml *xml, struct zr_xml_text prefix);

/* Returns the URI of a prefix that is declared here; empty if there is none. */
struct zr_xml_text zr_xml_uri(const struct zr_xml *xml, struct zr_xml_text prefix);

/* Returns the value with its references replaced, as a string. NULL without memory. */
const char *zr_xml_decode(struct zr_arena *arena, struct zr_xml_text value);

static inline bool zr_xml_text_is(struct zr_xml_text text, const char *word)
{
    const size_t length = strlen(word);
    return text.length == length && memcmp(text.at, word, length) == 0;
}

/* Compares the last byte first: names often differ there (v1, v2, v3). */
static inline bool zr_xml_texts_equal(struct zr_xml_text a, struct zr_xml_text b)
{
    const size_t length = a.length;
    if (length != b.length) return false;
    return length == 0 || (a.at[length - 1] == b.at[length - 1] && memcmp(a.at, b.at, length - 1) == 0);
}

/* Returns the value of an attribute without a prefix; .at is NULL if there is none. */
struct zr_xml_text zr_xml_value(const struct zr_xml_tag *tag, const char *name);

#endif
