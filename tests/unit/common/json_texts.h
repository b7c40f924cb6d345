/* json_texts.h - tests: scenes in JSON with everything in them that has a large list, made at random and spelt in
 * many ways. */
#ifndef ZR_TESTS_JSON_TEXTS_H
#define ZR_TESTS_JSON_TEXTS_H

#include "json_check.h"
#include "texts.h"

#define FACES   "\"faces\":[[0,1,2]]"
#define CORNERS "{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]"

/* ---- scenes ---- */

static inline void add_places(struct text *text, size_t count, size_t most)
{
    for (size_t i = 0; i < count; i++) {
        add(text, "%s[%.9g,%.6g,%.*f", i ? "," : "", any_place(), any_place(), (int)below(17), any_place());
        for (size_t k = 3; k < most && below(2); k++)
            add(text, ",%.3g", 0.5 + (double)below(1000) / 100);
        add(text, "]");
    }
}

static inline void add_colors(struct text *text, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (below(3))
            add(text, "%s[%.7g,0,%.12g%s]", i ? "," : "", (double)below(1000) / 999, (double)below(9999) / 9998,
                below(2) ? "" : ",1");
        else
            add(text, "%s\"#%06zx%s\"", i ? "," : "", below(1u << 24), below(2) ? "" : "Ff");
}

static inline void add_mesh(struct text *text, size_t count)
{
    add(text, "{\"name\":\"part\",\"positions\":[");
    add_places(text, count, 4);
    add(text, "],\"normals\":[");
    add_places(text, count, 3);
    add(text, "],\"colors\":[");
    add_colors(text, count);
    add(text, "],\"faces\":[");
    for (size_t i = 0; i < count; i++) {
        add(text, "%s[%zu,%zu,%zu", i ? "," : "", below(count), below(count), below(count));
        for (size_t k = below(4); k > 0; k--)
            add(text, ",%zu", below(count));
        add(text, "]");
    }
    add(text, "],\"lines\":[");
    for (size_t i = 0; i < count; i++)
        add(text, "%s[%zu,%zu]", i ? "," : "", below(count), below(count));
    add(text, "],\"faceColors\":[");
    add_colors(text, count);
    add(text, "]}");
}

static inline void add_heights(struct text *text, size_t columns)
{
    add(text, "{\"heights\":{\"values\":[");
    for (size_t row = 0; row < 5; row++) {
        for (size_t column = 0; column < columns; column++)
            if (column % 8 == 7)
                add(text, "%snull", column ? "," : row ? ",[" : "[");
            else
                add(text, "%s%.8g", column ? "," : row ? ",[" : "[", any_place());
        add(text, "]");
    }
    add(text, "],\"x\":[-1,0.5]}}");
}

static inline void add_polygons(struct text *text, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        size_t vertices = 3 + below(3);
        add(text, "%s{\"vertices\":[", i ? "," : "");
        add_places(text, vertices, 4);
        add(text, "]");
        if (below(4) == 0) add(text, ",\"color\":%s", below(2) ? "[0,0.5,0.123]" : "\"#ff8000\"");
        if (below(6) == 0) {
            add(text, ",\"holes\":[[");
            add_places(text, 3, 3);
            add(text, "],[");
            vertices += 7;
            add_places(text, 4, 3);
            add(text, "]]");
        }
        if (below(4) == 0) {
            add(text, ",\"colors\":[");
            add_colors(text, vertices);
            add(text, "]");
        }
        if (below(3) == 0)
            add(text, ",\"material\":\"m%zu\",\"doubleSided\":%s", below(2), below(2) ? "true" : "false");
        if (below(4) == 0) {
            add(text, ",\"normals\":[");
            add_places(text, vertices, 3);
            add(text, "]");
        }
        add(text, "}");
    }
}

static inline struct text make_scene(size_t count)
{
    struct text text = {0};
    add(&text, "{\"materials\":[{\"name\":\"m0\"},{\"name\":\"m1\",\"shading\":\"unlit\"}],\"meshes\":[");
    add_mesh(&text, count);
    add(&text, ",");
    add_heights(&text, count + 2);
    add(&text, "],\"polygons\":[");
    add_polygons(&text, count);
    add(&text, "]}");
    return text;
}

/* ---- the same scene in other spellings ---- */

enum spelling { AS_IT_IS, SPACED, LINES, EXPONENTS, LONG, ESCAPED_KEYS, SPELLINGS };

static inline bool begins_number(const char *text, const char *at)
{
    bool is = (*at >= '0' && *at <= '9') || *at == '-';
    return is && at > text && (at[-1] == '[' || at[-1] == ',');
}

static inline void put_number(struct text *out, enum spelling spelling, double value)
{
    if (spelling == EXPONENTS && below(2))
        add(out, "%.17e", value);
    else if (spelling == EXPONENTS)
        add(out, "%.17E", value);
    else
        add(out, "%.17g", value);
}

/* The compact text without escapes, said otherwise. */
static inline struct text respell(const char *text, enum spelling spelling)
{
    struct text out = {0};
    for (const char *at = text; *at;) {
        if ((spelling == EXPONENTS || spelling == LONG) && begins_number(text, at)) {
            char *behind;
            put_number(&out, spelling, strtod(at, &behind));
            at = behind;
        } else if (spelling == ESCAPED_KEYS && *at == '"' && at[1] >= 'a' && at[1] <= 'z') {
            size_t length = strcspn(at + 1, "\""), place = 1 + below(length);
            bool is_key = at[length + 2] == ':';
            put(&out, at, is_key ? place : length + 2);
            if (is_key) {
                add(&out, below(2) ? "\\u%04x" : "\\u%04X", at[place]);
                put(&out, at + place + 1, length + 1 - place);
            }
            at += length + 2;
        } else {
            put(&out, at, 1);
            if (spelling == SPACED && (*at == ',' || *at == ':')) add(&out, " ");
            if (spelling == LINES && strchr("[]{},:", *at)) add(&out, "%s", below(2) ? "\r\n\t" : "\n  ");
            at++;
        }
    }
    return out;
}

#endif
