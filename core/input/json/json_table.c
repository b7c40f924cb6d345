#include "input/json/json_table.h"

#include <stdio.h>
#include <string.h>

static uint64_t lowest(uint64_t set)
{
    return set & (~set + 1);
}

static const char *key_of(const struct zr_json_object *object, uint64_t set)
{
    return set ? object->fields[__builtin_ctzll(set)].key : "";
}

/* Reports the first key of `first` and, unless the set is empty, of `other`. */
static void report(struct zr_json_reading *reading, const struct zr_json_rule *rule, uint64_t first, uint64_t other)
{
    const char *last = key_of(reading->object, other ? other : first);
    zr_json_fault(reading->json, rule->at_key ? ZR_JSON_KEY(reading->path, last) : reading->path, rule->text,
                  key_of(reading->object, first), last);
    reading->left &= ~(first | other);
}

/* ---- rules ---- */

static void check_apart(struct zr_json_reading *reading, const struct zr_json_rule *rule)
{
    const uint64_t left = reading->left;
    uint64_t first = 0;
    for (int i = 0; i < ZR_RULE_SETS; i++) {
        const uint64_t here = rule->sets[i] & left;
        if (first && here) report(reading, rule, first, here);
        if (!first) first = here;
    }
}

static void check_against(struct zr_json_reading *reading, const struct zr_json_rule *rule)
{
    const uint64_t first = rule->sets[0] & reading->left;
    uint64_t others = first ? rule->sets[1] & reading->left : 0;
    for (; others; others &= others - 1)
        report(reading, rule, first, lowest(others));
}

static void check_rule(struct zr_json_reading *reading, const struct zr_json_rule *rule)
{
    const uint64_t set = rule->sets[0], here = set & reading->left;
    switch (rule->kind) {
    case ZR_RULE_APART:
        check_apart(reading, rule);
        break;
    case ZR_RULE_AGAINST:
        check_against(reading, rule);
        break;
    case ZR_RULE_NEEDS:
        if (here && !(rule->sets[1] & *reading->given)) report(reading, rule, here, 0);
        break;
    case ZR_RULE_SOME:
        if (!(set & *reading->given) && !reading->has_unknown) report(reading, rule, 0, 0);
        break;
    case ZR_RULE_ALL:
        if (here && here != set) report(reading, rule, set & ~here, 0);
        break;
    }
}

/* ---- types ---- */

/* Names a set of types: "types directional, point and spot". */
static void name_types(const struct zr_names *words, uint32_t types, char text[64])
{
    const bool is_one = (types & (types - 1)) == 0;
    size_t used = (size_t)snprintf(text, 64, is_one ? "type" : "types");
    for (int type = 0; types; type++, types >>= 1) {
        if (!(types & 1u)) continue;
        const char *const before = strchr(text, ' ') == NULL ? " " : types == 1u ? " and " : ", ";
        used += (size_t)snprintf(text + used, 64 - used, "%s%s", before, words->words[type]);
    }
}

static void check_type(struct zr_json_reading *reading, int type)
{
    const struct zr_json_object *object = reading->object;
    char named[64];
    for (size_t i = 0; i < object->count; i++) {
        const struct zr_json_field *field = &object->fields[i];
        const bool is_given = zr_json_gives(*reading->given, (int)i);
        if (is_given && field->of && !(field->of >> type & 1u)) {
            name_types(object->fields[0].words, field->of, named);
            zr_json_fault(reading->json, ZR_JSON_KEY(reading->path, field->key), "belongs to %ss of the %s only",
                          object->name, named);
            reading->left &= ~ZR_KEY(i);
        }
        if (!is_given && field->required_of >> type & 1u)
            zr_json_fault(reading->json, reading->path, "%s is missing: %s", field->key, field->text);
    }
}

void zr_json_check_rules(struct zr_json_reading *reading)
{
    const struct zr_json_object *object = reading->object;
    const struct zr_json_field *first = &object->fields[0];
    reading->left = *reading->given;
    if (object->has_types) {
        const int type = *(const int *)(const void *)((const char *)reading->out + first->offset);
        if (type >= 0) check_type(reading, type);
    }
    for (size_t i = 0; i < object->rule_count; i++)
        check_rule(reading, &object->rules[i]);
}
