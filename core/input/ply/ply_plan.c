#include <string.h>
#include <strings.h>

#include "input/ply/ply_file.h"

/* A group of values, under the property names of one program. The first `needed` are required together. */
static const struct {
    enum zr_ply_kind kind;
    enum zr_ply_slot first;
    size_t needed, count;
    const char *names[4];
} groups[] = {
    {ZR_PLY_VERTEX, ZR_PLY_X, 3, 3, {"x", "y", "z"}},
    {ZR_PLY_VERTEX, ZR_PLY_NX, 3, 3, {"nx", "ny", "nz"}},
    {ZR_PLY_VERTEX, ZR_PLY_NX, 3, 3, {"normal_x", "normal_y", "normal_z"}},
    {ZR_PLY_VERTEX, ZR_PLY_RED, 3, 4, {"red", "green", "blue", "alpha"}},
    {ZR_PLY_VERTEX, ZR_PLY_RED, 3, 4, {"diffuse_red", "diffuse_green", "diffuse_blue", "alpha"}},
    {ZR_PLY_VERTEX, ZR_PLY_RED, 3, 4, {"r", "g", "b", "a"}},
    {ZR_PLY_VERTEX, ZR_PLY_RED, 3, 3, {"f_dc_0", "f_dc_1", "f_dc_2"}},
    {ZR_PLY_VERTEX, ZR_PLY_S, 2, 2, {"s", "t"}},
    {ZR_PLY_VERTEX, ZR_PLY_S, 2, 2, {"u", "v"}},
    {ZR_PLY_VERTEX, ZR_PLY_S, 2, 2, {"texture_u", "texture_v"}},
    {ZR_PLY_FACE, ZR_PLY_RED, 3, 4, {"red", "green", "blue", "alpha"}},
    {ZR_PLY_FACE, ZR_PLY_RED, 3, 4, {"diffuse_red", "diffuse_green", "diffuse_blue", "alpha"}},
    {ZR_PLY_FACE, ZR_PLY_RED, 3, 4, {"r", "g", "b", "a"}},
    {ZR_PLY_EDGE, ZR_PLY_VERTEX1, 2, 2, {"vertex1", "vertex2"}},
};

/* Finds a value by its name, else by its name in capitals. */
static const struct zr_ply_property *find_value(const struct zr_ply_element *element, const char *name)
{
    const struct zr_ply_property *property = zr_ply_find(element, name);
    for (size_t i = 0; !property && i < element->property_count; i++) {
        const struct zr_ply_word word = element->properties[i].name;
        if (word.size == strlen(name) && strncasecmp(word.at, name, word.size) == 0) property = &element->properties[i];
    }
    return property && !property->is_list ? property : NULL;
}

static void find_group(struct zr_ply_plan *plan, size_t group)
{
    const struct zr_ply_property **slots = &plan->slots[groups[group].first];
    const char *const *names = groups[group].names;
    if (groups[group].kind != plan->kind || slots[0]) return;
    for (size_t i = 0; i < groups[group].needed; i++)
        if (!find_value(plan->element, names[i])) return;
    for (size_t i = 0; i < groups[group].count; i++)
        slots[i] = find_value(plan->element, names[i]);
}

/* Finds colours in one property. */
static void find_packed(struct zr_ply_plan *plan)
{
    static const char *const names[] = {"rgb", "rgba"};
    for (size_t i = 0; i < 2 && !plan->slots[ZR_PLY_RED]; i++) {
        const struct zr_ply_property *property = find_value(plan->element, names[i]);
        plan->is_packed = property && zr_ply_type_bytes(property->type) == sizeof(uint32_t);
        for (int k = 0; plan->is_packed && k < 3; k++)
            plan->slots[ZR_PLY_RED + k] = property;
    }
}

static enum zr_ply_kind kind_of(const struct zr_ply_element *element)
{
    static const char *const names[] = {"vertex", "face", "tristrips", "edge"};
    int kind = ZR_PLY_VERTEX;
    while (kind < ZR_PLY_OTHER && !zr_ply_word_is(element->name, names[kind]))
        kind++;
    return (enum zr_ply_kind)kind;
}

struct zr_ply_plan zr_ply_plan_of(const struct zr_ply_element *element)
{
    static const char *const lists[] = {"vertex_indices", "vertex_index"};
    struct zr_ply_plan plan = {.kind = kind_of(element), .element = element};
    const bool has_list = plan.kind == ZR_PLY_FACE || plan.kind == ZR_PLY_STRIPS;
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        find_group(&plan, i);
    if (plan.kind == ZR_PLY_VERTEX || plan.kind == ZR_PLY_FACE) find_packed(&plan);
    plan.is_splat = plan.slots[ZR_PLY_RED] && plan.slots[ZR_PLY_RED] == zr_ply_find(element, "f_dc_0");
    for (size_t i = 0; has_list && !plan.indices && i < 2; i++) {
        const struct zr_ply_property *property = zr_ply_find(element, lists[i]);
        if (property && property->is_list) plan.indices = property;
    }
    return plan;
}
