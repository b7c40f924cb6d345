/* json_table.h - input: tables of the keys of objects, and rules about several keys. zr_json_fields reads by them; the
 * schema prints them (schema/schema.h). */
#ifndef ZR_JSON_TABLE_H
#define ZR_JSON_TABLE_H

#include <stdint.h>

#include "input/json/json_fault.h"
#include "input/text/names.h"

#define ZR_JSON_FIELD(parent, field) (&(const struct zr_json_path){(parent), (field)->key, 0, (field)})

struct zr_json_object;

/* Reads the value at `path` into *out, as path->field says. */
typedef bool zr_json_read_fn(struct zr_json *json, const struct zr_json_path *path, void *out);

/* One key of an object. */
struct zr_json_field {
    const char *key;
    zr_json_read_fn *read; /* NULL: reserved for a later version */
    size_t offset;         /* of the output member in the object's struct */
    double low, high;      /* bounds of a number */
    const struct zr_names *words;
    const struct zr_json_object *object; /* table of the value's keys, or of a list's items; NULL: neither */
    bool required;                       /* required fields come first in their table */
    const char *unit, *otherwise, *text; /* documentation: the unit, the default, the meaning */
    const char *schema;                  /* of the value, as JSON Schema; NULL: follows from `read`, `object` or `words`
                                            (schema/schema.h) */
    size_t through;           /* offset in the object's struct of a pointer to the struct that has the member;
                                            0: the object's struct itself has it */
    uint32_t of, required_of; /* of a key of some types only: bits of the words of the first key; 0: all */
};

/* A schema as text. Tokens are not expanded: true and false stay words. Refers to kinds of values and to objects as
 * "#/$defs/NAME". */
#define ZR_SCHEMA(...)     #__VA_ARGS__
#define ZR_SCHEMA_OF(name) "{\"$ref\": \"#/$defs/" name "\"}"

/* A rule about several keys of an object, which zr_json_fields checks and the schema lists. A set has bit i for key i.
 * The first given key of a set is reported. */
enum zr_json_rule_kind {
    ZR_RULE_APART,   /* keys of different sets exclude each other; each set is reported with the first given one */
    ZR_RULE_AGAINST, /* keys of sets[0] exclude those of sets[1]; each of the latter is reported */
    ZR_RULE_NEEDS,   /* keys of sets[0] need one of sets[1] */
    ZR_RULE_SOME,    /* one of sets[0] is required; not reported beside an unknown key, which may be it */
    ZR_RULE_ALL      /* all keys of sets[0] or none; the first missing one is reported */
};
enum { ZR_RULE_SETS = 8 };
struct zr_json_rule {
    enum zr_json_rule_kind kind;
    bool at_key;      /* the fault is at the last reported key, else at the object */
    const char *text; /* format of the fault; %s: the reported keys */
    uint64_t sets[ZR_RULE_SETS];
};
#define ZR_KEY(key) (UINT64_C(1) << (key))

/* The keys of one kind of object, at most 64; the first has a reader. */
struct zr_json_object {
    const char *name;
    size_t count;
    const struct zr_json_field *fields;
    bool is_open;   /* of glTF: unknown keys are expected, and not counted for a warning */
    bool has_types; /* the first key is the type, an int that is -1 until it is read; see `of` */
    size_t rule_count;
    const struct zr_json_rule *rules; /* a key that broke one is not reported for a later one */
    const char *schema;               /* members of the object's schema that no rule says, as an object; NULL: none */
    const char *examples;             /* list of objects; NULL: none */
};
#define ZR_JSON_FIELDS(title, table) .name = (title), .count = sizeof(table) / sizeof((table)[0]), .fields = (table)
#define ZR_JSON_RULES(table)         .rules = (table), .rule_count = sizeof(table) / sizeof((table)[0])
#define ZR_JSON_OBJECT_OF(title, table)                                                                                \
    {                                                                                                                  \
        ZR_JSON_FIELDS(title, table)                                                                                   \
    }

static inline bool zr_json_gives(uint64_t given, int field)
{
    return given >> field & 1u;
}

/* An object while it is read into *out. */
struct zr_json_reading {
    struct zr_json *json;
    const struct zr_json_path *path;
    const struct zr_json_object *object;
    void *out;
    uint64_t *given;  /* keys that are given */
    uint64_t left;    /* those that no broken rule has named yet */
    bool has_unknown; /* an unknown key, which may be a misspelt one */
};

/* Reports keys of other types than the object's, keys that its type lacks, and broken rules. */
void zr_json_check_rules(struct zr_json_reading *reading);

#endif
