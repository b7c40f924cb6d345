/* schema/: the schema of scenes has every key, and OpenAPI every parameter, channel and format. */
#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#include "input/scene/outputs.h"
#include "parameter_rows.h"
#include "routes/openapi.h"
#include "schema/kinds.h"
#include "schema/schema.h"
#include "support/tests.h"

static struct zr_arena arena;
static cJSON *schema, *openapi;

static const cJSON *at(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static cJSON *parse(struct zr_buffer *text)
{
    zr_buffer_add(text, "", 1);
    assert_true(zr_arena_ok(&arena));
    cJSON *made = cJSON_Parse((const char *)text->bytes);
    assert_non_null(made);
    return made;
}

static cJSON *schema_of(const char *name)
{
    struct zr_buffer text = {.arena = &arena};
    const struct zr_limits limits = zr_limits_default();
    assert_true(zr_schema_print(&text, &limits, name, NULL));
    return parse(&text);
}

static int open_all(void **state)
{
    struct zr_buffer text = {.arena = &arena};
    const struct zr_limits limits = zr_limits_default();
    (void)state;
    zr_arena_init(&arena, (size_t)1 << 27);
    schema = schema_of(NULL);
    openapi_print(&text, &limits);
    openapi = parse(&text);
    return 0;
}

static int close_all(void **state)
{
    (void)state;
    cJSON_Delete(schema);
    cJSON_Delete(openapi);
    zr_arena_free(&arena);
    return 0;
}

/* Returns the properties of an object's definition, or of one of its types that has the key. */
static const cJSON *find_key(const cJSON *all, const struct zr_json_object *object, const char *key)
{
    const cJSON *definition = at(all, object->name), *found = at(at(definition, "properties"), key), *type;
    cJSON_ArrayForEach(type, at(definition, "oneOf"))
    {
        const char *name = strrchr(cJSON_GetStringValue(at(type, "$ref")), '/') + 1;
        if (!found) found = at(at(at(all, name), "properties"), key);
    }
    return found;
}

TEST(each_row_has_a_schema)
{
    for (size_t o = 0; o < zr_schema_object_count; o++)
        for (size_t i = 0; i < zr_schema_objects[o]->count; i++) {
            const struct zr_json_field *field = &zr_schema_objects[o]->fields[i];
            if (field->read && !zr_schema_has(field))
                fail_msg("%s.%s: nothing says which values it has", zr_schema_objects[o]->name, field->key);
        }
    const struct zr_json_field without = {.key = "a", .read = zr_json_value_start, .text = "a"};
    assert_false(zr_schema_has(&without));
}

static void check_keys(const cJSON *all)
{
    for (size_t o = 0; o < zr_schema_object_count; o++)
        for (size_t i = 0; i < zr_schema_objects[o]->count; i++) {
            const struct zr_json_object *object = zr_schema_objects[o];
            const struct zr_json_field *field = &object->fields[i];
            const cJSON *key = find_key(all, object, field->key);
            if (!field->read != !key)
                fail_msg("%s.%s: %s", object->name, field->key, key ? "is reserved" : "is missing");
            if (!key) continue;
            assert_non_null(at(key, "description"));
            if (cJSON_GetArraySize(key) < 2) fail_msg("%s.%s: has no value", object->name, field->key);
        }
}

TEST(the_schema_and_openapi_have_every_key_of_every_object)
{
    check_keys(at(schema, "$defs"));
    check_keys(at(at(openapi, "components"), "schemas"));
}

/* Checks that each reference leads to something. */
static void check_references(const cJSON *root, const cJSON *value)
{
    const char *reference = cJSON_GetStringValue(at(value, "$ref"));
    const cJSON *found = root, *item;
    if (reference) {
        char path[200], *rest = path + 2;
        snprintf(path, sizeof path, "%s", reference);
        assert_memory_equal(path, "#/", 2);
        for (char *key; (key = strsep(&rest, "/")) != NULL;)
            found = at(found, key);
        if (!found) fail_msg("%s leads nowhere", reference);
    }
    cJSON_ArrayForEach(item, value)
    {
        if (cJSON_IsObject(item) || cJSON_IsArray(item)) check_references(root, item);
    }
}

/* A reader of JSON takes one of two equal keys, and loses the other. */
static void check_unique(const cJSON *value)
{
    for (const cJSON *one = value->child; one; one = one->next) {
        for (const cJSON *other = one->next; one->string && other; other = other->next)
            if (strcmp(one->string, other->string) == 0)
                fail_msg("%s has the key %s twice", value->string ? value->string : "the root", one->string);
        check_unique(one);
    }
}

TEST(no_object_has_a_key_twice)
{
    check_unique(schema);
    check_unique(openapi);
}

TEST(references_lead_somewhere)
{
    check_references(schema, schema);
    check_references(openapi, openapi);
    for (size_t o = 0; o < zr_schema_object_count; o++) {
        cJSON *one = schema_of(zr_schema_objects[o]->name);
        check_references(one, one);
        cJSON_Delete(one);
    }
}

TEST(an_object_alone_has_only_what_it_refers_to)
{
    cJSON *light = schema_of("light");
    assert_non_null(at(at(light, "$defs"), "spotLight"));
    assert_non_null(at(at(light, "$defs"), "direction"));
    assert_null(at(at(light, "$defs"), "mesh"));
    cJSON_Delete(light);
    struct zr_buffer text = {.arena = &arena};
    const struct zr_limits limits = zr_limits_default();
    assert_false(zr_schema_print(&text, &limits, "lamp", NULL));
}

TEST(a_type_has_its_own_keys_only)
{
    const cJSON *all = at(schema, "$defs"), *spot = at(at(all, "spotLight"), "properties"),
                *hemisphere = at(at(all, "hemisphereLight"), "properties");
    assert_non_null(at(spot, "outerConeAngleDegrees"));
    assert_null(at(spot, "sky"));
    assert_non_null(at(hemisphere, "sky"));
    assert_null(at(hemisphere, "position"));
    assert_string_equal(cJSON_GetStringValue(at(at(spot, "type"), "const")), "spot");
}

TEST(limits_are_those_of_the_caller)
{
    struct zr_limits limits = zr_limits_default();
    struct zr_buffer text = {.arena = &arena};
    limits.window_side_max = 123;
    limits.coordinate_max = 456;
    assert_true(zr_schema_print(&text, &limits, "window", NULL));
    assert_true(zr_schema_print(&text, &limits, "node", NULL));
    zr_buffer_add(&text, "", 1);
    assert_non_null(strstr((const char *)text.bytes, "\"maximum\":123}"));
    assert_non_null(strstr((const char *)text.bytes, "\"minimum\":-456,\"maximum\":456}"));
}

TEST(openapi_has_every_parameter_in_order)
{
    static const char *const names[] = {
#define NAME(name, ...) #name,
        ZR_PARAMETER_ROWS(NAME)
#undef NAME
    };
    const cJSON *list = at(at(at(at(openapi, "paths"), "/v1/render"), "post"), "parameters");
    assert_int_equal(cJSON_GetArraySize(list), sizeof names / sizeof *names);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const cJSON *one = cJSON_GetArrayItem(list, (int)i);
        assert_string_equal(cJSON_GetStringValue(at(one, "name")), names[i]);
        assert_non_null(at(at(one, "schema"), "type"));
    }
}

static const cJSON *parameter(const char *name)
{
    const cJSON *one;
    cJSON_ArrayForEach(one, at(at(at(at(openapi, "paths"), "/v1/render"), "post"), "parameters"))
    {
        if (strcmp(cJSON_GetStringValue(at(one, "name")), name) == 0) return at(one, "schema");
    }
    fail_msg("there is no parameter %s", name);
    return NULL;
}

TEST(parameters_have_types_bounds_and_defaults)
{
    assert_string_equal(cJSON_GetStringValue(at(parameter("width"), "type")), "integer");
    assert_float_equal(at(parameter("width"), "maximum")->valuedouble, 8192, 0);
    assert_null(at(parameter("width"), "default")); /* a scene has its own */
    assert_float_equal(at(parameter("turntableSeconds"), "default")->valuedouble, 4, 0);
    assert_float_equal(at(parameter("elevation"), "minimum")->valuedouble, -90, 0);
    assert_string_equal(cJSON_GetStringValue(at(parameter("look"), "default")), "studio");
    assert_true(cJSON_IsFalse(at(parameter("strict"), "default")));
    assert_int_equal(cJSON_GetArraySize(at(parameter("samples"), "enum")), 4);
    assert_float_equal(at(parameter("lightPosition"), "maxItems")->valuedouble, 3, 0);
    assert_int_equal(cJSON_GetArraySize(at(at(parameter("channel"), "items"), "enum")), ZR_CHANNEL_COUNT);
    assert_int_equal(cJSON_GetArraySize(at(cJSON_GetArrayItem(at(parameter("environment"), "anyOf"), 0), "enum")), 4);
}

TEST(openapi_has_the_types_of_all_bodies_and_answers)
{
    const cJSON *post = at(at(at(openapi, "paths"), "/v1/render"), "post");
    const cJSON *bodies = at(at(post, "requestBody"), "content"),
                *answers = at(at(at(at(post, "responses"), "200"), "content"), "image/png");
    static const char *const types[] = {"application/json", "model/stl", "application/sla", "model/gltf-binary",
                                        "multipart/form-data"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        assert_non_null(at(bodies, types[i]));
    assert_non_null(answers);
}

TEST(channels_have_their_encodings_in_the_schema)
{
    char *text = cJSON_PrintUnformatted(at(at(schema, "$defs"), "output"));
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        char wanted[120];
        snprintf(wanted, sizeof wanted,
                 "{\"channel\":{\"const\":\"%s\"}}},\"then\":{\"properties\":{\"encoding\":{\"enum\":[\"%s\"",
                 zr_channel_rows[c].name, zr_encoding_names.words[zr_channel_rows[c].encodings[0]]);
        if (!strstr(text, wanted)) fail_msg("%s has other encodings", zr_channel_rows[c].name);
    }
    cJSON_free(text);
}

TEST(too_little_memory_gives_no_schema)
{
    const struct zr_limits limits = zr_limits_default();
    struct zr_arena small;
    zr_arena_init(&small, 1000);
    struct zr_buffer text = {.arena = &small};
    assert_false(zr_schema_print(&text, &limits, NULL, NULL));
    zr_arena_free(&small);
}

RUN_TESTS(open_all, close_all)
