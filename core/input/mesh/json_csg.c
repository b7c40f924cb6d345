/* Reads the key csg: a tree of unions, differences and intersections of parts. part_select.h finds the parts. */
#include <stdio.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "scene/csg.h"

struct reading {
    struct zr_csg_key *steps;
    uint32_t count;
};

/* A node of the tree while its operands are read. */
struct node {
    struct reading *reading;
    int depth;
    bool is_tool; /* nothing of it fits a view */
    enum zr_csg_op op;
};

static bool read_operand(struct zr_json *json, const struct zr_json_path *path, struct node node);

static bool add_step(struct zr_json *json, const struct zr_json_path *path, struct reading *reading,
                     struct zr_csg_key step)
{
    if (reading->count == ZR_CSG_STEPS_MAX)
        return zr_json_fault(json, path, "more than %d operands and operations", ZR_CSG_STEPS_MAX);
    reading->steps[reading->count++] = step;
    return true;
}

/* Reads the operands of one operation. */
static bool read_operands(struct zr_json *json, const struct zr_json_path *path, struct node node)
{
    size_t count, number = 0;
    if (!zr_json_count(json, path, &count)) return false;
    if (count < 1) return zr_json_skip(json) && zr_json_fault(json, path, "no operands; at least one is needed");
    bool is_good = true;
    for (zr_json_enter(json, '['); zr_json_item(json); number++) {
        const struct zr_json_path *item = ZR_JSON_ITEM(path, number);
        struct node inner = node;
        inner.is_tool = node.is_tool || (number > 0 && node.op != ZR_CSG_UNION);
        is_good = read_operand(json, item, inner) && is_good;
        if (is_good && number > 0) is_good = add_step(json, item, node.reading, (struct zr_csg_key){.op = node.op});
    }
    return is_good;
}

/* ---- one operation ---- */

struct given_operation {
    const char *operands[3]; /* first bytes of the lists; NULL: not given, or malformed */
};

#define AT(which) offsetof(struct given_operation, operands) + (which - 1) * sizeof(const char *)
#define OPERANDS  .schema = ZR_SCHEMA({"type" : "array", "minItems" : 1, "items" : {"$ref" : "#/$defs/csgOperand"}})
static const struct zr_json_field operation_fields[] = {
    {"union", zr_json_value_start, AT(ZR_CSG_UNION), .text = "operands: all of them", OPERANDS},
    {"difference", zr_json_value_start, AT(ZR_CSG_DIFFERENCE), .text = "operands: the first one without all others",
     OPERANDS},
    {"intersection", zr_json_value_start, AT(ZR_CSG_INTERSECTION), .text = "operands: their common space", OPERANDS}};
#undef AT
#undef OPERANDS
static const struct zr_json_rule operation_rules[] = {
    {ZR_RULE_SOME, .text = "an operation is union, difference or intersection: {\"difference\": [\"body\", \"hole\"]}",
     .sets = {ZR_KEY(0) | ZR_KEY(1) | ZR_KEY(2)}},
    {ZR_RULE_APART, .text = "an object has one operation; operands may be objects again",
     .sets = {ZR_KEY(0), ZR_KEY(1), ZR_KEY(2)}}};
const struct zr_json_object zr_json_object_csg = {ZR_JSON_FIELDS("csg", operation_fields),
                                                  ZR_JSON_RULES(operation_rules)};

static bool read_operation(struct zr_json *json, const struct zr_json_path *path, struct node node)
{
    struct given_operation given = {{NULL}};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (node.depth == ZR_CSG_DEPTH_MAX)
        return zr_json_skip(json) && zr_json_fault(json, path, "nested deeper than %d operations", ZR_CSG_DEPTH_MAX);
    if (!zr_json_fields(json, path, &zr_json_object_csg, &given, &keys) || zr_json_failed_since(json, faults))
        return false;
    for (int op = ZR_CSG_UNION; op <= ZR_CSG_INTERSECTION; op++) {
        if (!given.operands[op - 1]) continue;
        struct zr_json there = zr_json_at(json, given.operands[op - 1]);
        node.op = (enum zr_csg_op)op;
        node.depth++;
        return read_operands(&there, ZR_JSON_FIELD(path, &operation_fields[op - 1]), node);
    }
    return false;
}

static bool read_operand(struct zr_json *json, const struct zr_json_path *path, struct node node)
{
    struct zr_csg_key step = {.op = ZR_CSG_PARTS, .is_tool = node.is_tool};
    if (zr_json_type(json) == ZR_JSON_OBJECT) return read_operation(json, path, node);
    return zr_read_part_set(json, path, &step.parts) && add_step(json, path, node.reading, step);
}

bool zr_read_csg(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_csg_keys *keys = &((struct zr_parsed_scene *)out)->scene->parts.csg;
    struct reading reading = {.steps = zr_arena_zero(json->arena, ZR_CSG_STEPS_MAX, sizeof *reading.steps)};
    const char *pointer = zr_json_pointer(json->arena, path);
    if (!reading.steps || !pointer) return false;
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_json_expect(json, path, "an object");
    if (!read_operation(json, path, (struct node){.reading = &reading})) return false;
    *keys = (struct zr_csg_keys){reading.count, reading.steps, pointer};
    return true;
}
