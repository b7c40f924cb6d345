#include "schema/schema.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "input/scene/json_objects.h"
#include "input/scene/outputs.h"
#include "input/text/color_text.h"
#include "input/text/number.h"
#include "schema/kinds.h"

#define OBJECT(name) &zr_json_object_##name,
const struct zr_json_object *const zr_schema_objects[] = {ZR_JSON_OBJECTS(OBJECT)};
#undef OBJECT
enum { OBJECTS = sizeof zr_schema_objects / sizeof *zr_schema_objects, TEXT_SIZE = 1024, NAME_SIZE = 64 };
const size_t zr_schema_object_count = OBJECTS;

static const char here[] = "#/$defs/";

/* ---- the schema of a value ---- */

static bool is_number(const struct zr_json_field *field)
{
    return field->read == zr_json_number || field->read == zr_json_float;
}

static bool is_bool(const struct zr_json_field *field)
{
    return field->read == zr_json_bool || field->read == zr_json_flag;
}

/* True for a schema of numbers alone, which takes the bounds of its row. */
static bool is_bounded(const char *schema)
{
    return !strchr(schema, ',') && (strstr(schema, "\"number\"") || strstr(schema, "\"integer\""));
}

static void print_bounds(struct zr_print *print, const struct zr_json_field *field)
{
    if (!(field->low < field->high)) return;
    zr_print_double(print, "minimum", field->low);
    zr_print_double(print, "maximum", field->high);
}

static void print_reference(struct zr_print *print, const char *name)
{
    char text[NAME_SIZE + sizeof here];
    snprintf(text, sizeof text, "%s%s", here, name);
    zr_print_string(print, "$ref", text);
}

static void print_pair(struct zr_print *print, const struct zr_json_field *field)
{
    zr_print_string(print, "type", "array");
    zr_print_begin(print, "prefixItems", '[');
    for (int i = 0; i < 2; i++) {
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "type", "number");
        print_bounds(print, field);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
    zr_print_bool(print, "items", false);
    zr_print_count(print, "minItems", 2);
}

static void print_words(struct zr_print *print, const struct zr_names *words)
{
    zr_print_begin(print, "enum", '[');
    for (int i = 0; i < words->count; i++)
        zr_print_string(print, NULL, words->words[i]);
    zr_print_end(print, ']');
}

/* Prints the members of the schema of a value. False if it is not known. */
static bool print_value(struct zr_print *print, const struct zr_json_field *field)
{
    const char *kind = zr_kind_of(field->read);
    if (field->schema) {
        zr_print_members(print, field->schema);
        if (is_bounded(field->schema)) print_bounds(print, field);
    } else if (kind) {
        print_reference(print, kind);
    } else if (is_number(field)) {
        zr_print_string(print, "type", "number");
        print_bounds(print, field);
    } else if (field->read == zr_json_whole) {
        zr_print_string(print, "type", "integer");
        zr_print_double(print, "minimum", field->low);
        zr_print_double(print, "maximum", field->high > 0 ? field->high : UINT32_MAX);
    } else if (field->read == zr_json_string) {
        zr_print_string(print, "type", "string");
    } else if (is_bool(field)) {
        zr_print_string(print, "type", "boolean");
    } else if (field->read == zr_json_float2) {
        print_pair(print, field);
    } else if (field->object) {
        print_reference(print, field->object->name);
    } else if (field->words) {
        print_words(print, field->words);
    } else {
        return false;
    }
    return true;
}

bool zr_schema_has(const struct zr_json_field *field)
{
    return field->schema || field->object || field->words || zr_kind_of(field->read) || is_number(field) ||
           is_bool(field) || field->read == zr_json_whole || field->read == zr_json_string ||
           field->read == zr_json_float2;
}

/* ---- documentation of a value ---- */

/* True for a list of numbers, or an empty list. */
static bool is_list(const char *text)
{
    const size_t length = strlen(text);
    return length >= 2 && text[0] == '[' && text[length - 1] == ']' && strspn(text + 1, "0123456789.,- ") == length - 2;
}

/* Prints the default if it is a value, and not words about one. */
static bool print_default(struct zr_print *print, const struct zr_json_field *field)
{
    const char *text = field->otherwise;
    zr_vec4 color;
    double number;
    if (!text) return true;
    if (is_list(text) || strcmp(text, "true") == 0 || strcmp(text, "false") == 0) {
        zr_print_json(print, "default", text);
        return true;
    }
    if (field->words && zr_names_find(field->words, text) >= 0) {
        zr_print_string(print, "default", text);
        return true;
    }
    if (zr_number_read(text, text + strlen(text), &number) == text + strlen(text)) {
        zr_print_double(print, "default", number);
        return true;
    }
    if (zr_color_of_text(text, strlen(text), &color)) {
        zr_print_string(print, "default", text);
        return true;
    }
    return false;
}

char zr_schema_first_letter(const char *meaning)
{
    const size_t letters = strspn(meaning, "abcdefghijklmnopqrstuvwxyz-");
    return letters > 0 && strchr(" ,", meaning[letters]) ? (char)toupper((unsigned char)meaning[0]) : meaning[0];
}

/* Prints meaning and unit; the default, too, unless it is a value and has a member of its own. */
static void print_description(struct zr_print *print, const struct zr_json_field *field, const char *meaning,
                              bool is_value)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text, "%c%s.%s%s%s%s%s%s", zr_schema_first_letter(meaning), meaning + 1,
             field->unit ? " Unit: " : "", field->unit ? field->unit : "", field->unit ? "." : "",
             is_value ? "" : " Default: ", is_value ? "" : field->otherwise, is_value ? "" : ".");
    zr_print_string(print, "description", text);
}

/* is_of_type: leaves out the types that begin the meaning, as in "spot: ...". */
static void print_field(struct zr_print *print, const struct zr_json_field *field, bool is_of_type)
{
    const char *types = is_of_type && field->of ? strstr(field->text, ": ") : NULL;
    const char *meaning = types ? types + 2 : field->text;
    zr_print_begin(print, field->key, '{');
    print_value(print, field);
    print_description(print, field, meaning, print_default(print, field));
    zr_print_end(print, '}');
}

/* ---- objects ---- */

/* Writes "spotLight" for the type spot of the object light. */
static void write_type_name(const struct zr_json_object *object, int type, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%s%c%s", object->fields[0].words->words[type], toupper((unsigned char)object->name[0]),
             object->name + 1);
}

/* True if a type has the key; with -1, if any has. */
static bool is_of(const struct zr_json_field *field, int type)
{
    return field->read && (type < 0 || !field->of || field->of >> type & 1u);
}

static bool is_required(const struct zr_json_field *field, int type)
{
    return field->required || (type >= 0 && field->required_of >> type & 1u);
}

static void print_required(struct zr_print *print, const struct zr_json_object *object, int type)
{
    bool any = false;
    for (size_t i = 0; i < object->count; i++)
        any |= is_required(&object->fields[i], type);
    if (!any) return;
    zr_print_begin(print, "required", '[');
    for (size_t i = 0; i < object->count; i++)
        if (is_required(&object->fields[i], type)) zr_print_string(print, NULL, object->fields[i].key);
    zr_print_end(print, ']');
}

/* Encodings and spaces of each channel. */
static void print_channels(struct zr_print *print)
{
    zr_print_json(print, "if", ZR_SCHEMA({"type" : "object"}));
    zr_print_begin(print, "then", '{');
    zr_print_begin(print, "allOf", '[');
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const struct zr_channel_row *row = &zr_channel_rows[c];
        char text[TEXT_SIZE];
        zr_print_begin(print, NULL, '{');
        snprintf(text, sizeof text, "{\"properties\":{\"channel\":{\"const\":\"%s\"}}}", row->name);
        zr_print_json(print, "if", text);
        zr_print_begin(print, "then", '{');
        zr_print_begin(print, "properties", '{');
        zr_print_begin(print, "encoding", '{');
        zr_print_begin(print, "enum", '[');
        for (int i = 0; i < row->encoding_count; i++)
            zr_print_string(print, NULL, zr_encoding_names.words[row->encodings[i]]);
        zr_print_end(print, ']');
        zr_print_end(print, '}');
        if (row->space_count == 0) {
            zr_print_bool(print, "space", false);
        } else {
            const struct zr_names spaces = {row->space_count, row->space_count, zr_space_names.words, NULL};
            zr_print_begin(print, "space", '{');
            print_words(print, &spaces);
            zr_print_end(print, '}');
        }
        zr_print_end(print, '}');
        if (c == ZR_CHANNEL_FLOW) zr_print_members(print, ZR_SCHEMA({"not" : {"properties" : {"to" : false}}}));
        if (c == ZR_CHANNEL_FRAGMENTS)
            zr_print_members(
                print,
                ZR_SCHEMA({"not" : {"anyOf" : [ {"properties" : {"x" : false}}, {"properties" : {"y" : false}} ]}}));
        if (c != ZR_CHANNEL_DEPTH && zr_channel_has((enum zr_channel)c, ZR_ENCODING_PNG16))
            zr_print_members(print, ZR_SCHEMA({
                                 "if" : {"properties" : {"encoding" : {"const" : "png16"}, "scale" : false}},
                                 "then" : {"properties" : {"encoding" : false}}
                             }));
        zr_print_end(print, '}');
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
    zr_print_end(print, '}');
}

/* ---- rules ---- */

/* Prints a schema that refuses the keys of a set; inside "not", one that wants one of them. */
static void print_absent(struct zr_print *print, const char *name, const struct zr_json_object *object, uint64_t set)
{
    zr_print_begin(print, name, '{');
    zr_print_begin(print, "properties", '{');
    for (size_t i = 0; i < object->count; i++)
        if (set & ZR_KEY(i)) zr_print_bool(print, object->fields[i].key, false);
    zr_print_end(print, '}');
    zr_print_end(print, '}');
}

/* Prints what a rule says if `key` is given. */
static void print_dependent(struct zr_print *print, const struct zr_json_object *object,
                            const struct zr_json_rule *rule, size_t key)
{
    const char *name = object->fields[key].key;
    uint64_t others = 0;
    int own = 0;
    while (own < ZR_RULE_SETS && !(rule->sets[own] & ZR_KEY(key)))
        own++;
    for (int i = own + 1; i < ZR_RULE_SETS; i++)
        others |= rule->sets[i];
    if (rule->kind == ZR_RULE_ALL && own == 0) {
        zr_print_begin(print, name, '{');
        zr_print_begin(print, "required", '[');
        for (size_t i = 0; i < object->count; i++)
            if (rule->sets[0] & ZR_KEY(i)) zr_print_string(print, NULL, object->fields[i].key);
        zr_print_end(print, ']');
        zr_print_end(print, '}');
    } else if (rule->kind == ZR_RULE_NEEDS && own == 0) {
        zr_print_begin(print, name, '{');
        print_absent(print, "not", object, others);
        zr_print_end(print, '}');
    } else if (others && (rule->kind == ZR_RULE_APART || rule->kind == ZR_RULE_AGAINST)) {
        print_absent(print, name, object, others);
    }
}

static void print_rule(struct zr_print *print, const struct zr_json_object *object, const struct zr_json_rule *rule,
                       int type)
{
    zr_print_begin(print, NULL, '{');
    if (rule->kind == ZR_RULE_SOME) {
        print_absent(print, "not", object, rule->sets[0]);
    } else {
        zr_print_begin(print, "dependentSchemas", '{');
        for (size_t key = 0; key < object->count; key++)
            if (is_of(&object->fields[key], type)) print_dependent(print, object, rule, key);
        zr_print_end(print, '}');
    }
    zr_print_end(print, '}');
}

/* Prints a schema per rule, all of which hold. */
static void print_rules(struct zr_print *print, const struct zr_json_object *object, int type)
{
    if (object->rule_count == 0) return;
    zr_print_begin(print, "allOf", '[');
    for (size_t i = 0; i < object->rule_count; i++)
        print_rule(print, object, &object->rules[i], type);
    zr_print_end(print, ']');
}

/* ---- the schema of an object ---- */

/* Prints an object as a member of the open object; `type`: one of its types, or -1 for all keys. */
static void print_closed(struct zr_print *print, const char *name, const struct zr_json_object *object, int type,
                         bool has_examples)
{
    zr_print_begin(print, name, '{');
    zr_print_string(print, "type", "object");
    zr_print_bool(print, "additionalProperties", false);
    print_required(print, object, type);
    zr_print_begin(print, "properties", '{');
    for (size_t i = 0; i < object->count; i++) {
        const struct zr_json_field *field = &object->fields[i];
        if (i == 0 && type >= 0) {
            zr_print_begin(print, field->key, '{');
            zr_print_string(print, "const", field->words->words[type]);
            print_description(print, field, field->text, true);
            zr_print_end(print, '}');
        } else if (is_of(field, type)) {
            print_field(print, field, type >= 0);
        }
    }
    zr_print_end(print, '}');
    print_rules(print, object, type);
    if (object->schema) zr_print_members(print, object->schema);
    if (object->examples && has_examples) zr_print_json(print, "examples", object->examples);
    if (object == &zr_json_object_output) print_channels(print);
    zr_print_end(print, '}');
}

/* Prints an object with types as a oneOf. */
static void print_types(struct zr_print *print, const struct zr_json_object *object)
{
    zr_print_begin(print, object->name, '{');
    zr_print_begin(print, "oneOf", '[');
    for (int type = 0; type < object->fields[0].words->count; type++) {
        char name[NAME_SIZE];
        write_type_name(object, type, name);
        zr_print_begin(print, NULL, '{');
        print_reference(print, name);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
    zr_print_end(print, '}');
}

/* ---- definitions ---- */

/* A name, and the text of its schema: a part of the text of all. */
struct definition {
    char name[NAME_SIZE];
    size_t at, end;   /* in the text of all: "NAME":{...} */
    const char *text; /* set once all are there */
    bool is_used;
};

enum { TYPES_MAX = 16, DEFINITIONS_MAX = OBJECTS + TYPES_MAX + 128 };

struct definitions {
    struct zr_buffer text;
    size_t count;
    struct definition items[DEFINITIONS_MAX];
};

static struct definition *begin(struct definitions *all, const char *name)
{
    struct definition *item = &all->items[all->count++];
    snprintf(item->name, sizeof item->name, "%s", name);
    item->at = all->text.size;
    return item;
}

static void add_object(struct definitions *all, const struct zr_json_object *object, bool has_examples)
{
    struct definition *item = begin(all, object->name);
    struct zr_print print = {.out = &all->text};
    const bool is_typed = object->has_types;
    if (is_typed)
        print_types(&print, object);
    else
        print_closed(&print, object->name, object, -1, has_examples);
    item->end = all->text.size;
    for (int type = 0; is_typed && type < object->fields[0].words->count; type++) {
        char name[NAME_SIZE];
        write_type_name(object, type, name);
        item = begin(all, name);
        print = (struct zr_print){.out = &all->text};
        print_closed(&print, name, object, type, has_examples);
        item->end = all->text.size;
    }
}

/* Makes all definitions. NULL without memory. */
static struct definitions *make_definitions(struct zr_arena *arena, const struct zr_limits *limits, bool has_examples)
{
    struct definitions *all = zr_arena_zero(arena, 1, sizeof *all);
    if (!all) return NULL;
    all->text.arena = arena;
    for (size_t i = 0; i < OBJECTS; i++)
        add_object(all, zr_schema_objects[i], has_examples);
    for (size_t i = 0; i < zr_kind_count && all->count < DEFINITIONS_MAX; i++) {
        struct zr_print print = {.out = &all->text};
        struct definition *item = begin(all, zr_kind_name(i));
        zr_kind_print(&print, i, limits);
        item->end = all->text.size;
    }
    if (!zr_arena_ok(arena)) return NULL;
    for (size_t i = 0; i < all->count; i++)
        all->items[i].text = (const char *)all->text.bytes + all->items[i].at;
    return all;
}

/* Returns the next reference, behind its prefix, or NULL. */
static const char *next_reference(const char *at, const char *end)
{
    const char *found = memmem(at, (size_t)(end - at), here, sizeof here - 1);
    return found ? found + sizeof here - 1 : NULL;
}

static struct definition *find(struct definitions *all, const char *name, size_t length)
{
    for (size_t i = 0; i < all->count; i++)
        if (strlen(all->items[i].name) == length && memcmp(all->items[i].name, name, length) == 0)
            return &all->items[i];
    return NULL;
}

/* Marks a definition and all that it refers to. The depth is at most the number of definitions. */
static void use(struct definitions *all, struct definition *item)
{
    if (!item || item->is_used) return;
    item->is_used = true;
    const char *const end = item->text + (item->end - item->at);
    for (const char *at = item->text; (at = next_reference(at, end)) != NULL;)
        use(all, find(all, at, strcspn(at, "\"/")));
}

/* Prints the text of a definition, with `refs` for the prefix of its references. */
static void print_definition(struct zr_print *print, const struct definition *item, const char *refs)
{
    const char *at = item->text, *const end = at + (item->end - item->at), *next;
    if (print->needs_comma) zr_buffer_add(print->out, ",", 1);
    print->needs_comma = true;
    for (; (next = next_reference(at, end)) != NULL; at = next) {
        zr_buffer_add(print->out, at, (size_t)(next - at) - (sizeof here - 1));
        zr_buffer_add(print->out, refs, strlen(refs));
    }
    zr_buffer_add(print->out, at, (size_t)(end - at));
}

void zr_schema_print_all(struct zr_print *print, const struct zr_limits *limits, const char *refs)
{
    const struct definitions *all = make_definitions(print->out->arena, limits, false);
    for (size_t i = 0; all && i < all->count; i++)
        print_definition(print, &all->items[i], refs);
}

bool zr_schema_print(struct zr_buffer *out, const struct zr_limits *limits, const char *name, const char *id)
{
    struct zr_print print = {.out = out};
    struct definitions *all = make_definitions(out->arena, limits, true);
    const char *const root = name ? name : zr_json_object_scene.name;
    struct definition *item = all ? find(all, root, strlen(root)) : NULL;
    if (!item) return false;
    use(all, item);
    zr_print_begin(&print, NULL, '{');
    zr_print_string(&print, "$schema", "https://json-schema.org/draft/2020-12/schema");
    if (id) zr_print_string(&print, "$id", id);
    zr_print_string(&print, "title", root);
    print_reference(&print, root);
    zr_print_begin(&print, "$defs", '{');
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].is_used) print_definition(&print, &all->items[i], here);
    zr_print_end(&print, '}');
    zr_print_end(&print, '}');
    return zr_arena_ok(out->arena);
}
