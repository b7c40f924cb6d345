/* The tables of keys: what their rows must have. */
#include <string.h>

#include "input/scene/json_objects.h"
#include "support/tests.h"

#define OBJECT(name) &zr_json_object_##name,
static const struct zr_json_object *const objects[] = {ZR_JSON_OBJECTS(OBJECT)};
enum { OBJECTS = sizeof objects / sizeof *objects };

TEST(each_key_stands_in_its_table_once)
{
    for (size_t o = 0; o < OBJECTS; o++) {
        assert_in_range(objects[o]->count, 1, 64);
        for (size_t i = 0; i < objects[o]->count; i++)
            for (size_t k = 0; k < i; k++)
                assert_string_not_equal(objects[o]->fields[i].key, objects[o]->fields[k].key);
    }
}

TEST(each_row_says_what_it_is_and_what_holds_without_it)
{
    for (size_t o = 0; o < OBJECTS; o++)
        for (size_t i = 0; i < objects[o]->count; i++) {
            const struct zr_json_field *field = &objects[o]->fields[i];
            if (field->read && (!field->text || !*field->text))
                fail_msg("%s.%s says nothing", objects[o]->name, field->key);
            if (field->required && field->otherwise) fail_msg("%s.%s is required", objects[o]->name, field->key);
        }
}

TEST(required_keys_come_first)
{
    for (size_t o = 0; o < OBJECTS; o++)
        for (size_t i = 1; i < objects[o]->count; i++)
            if (objects[o]->fields[i].required && !objects[o]->fields[i - 1].required)
                fail_msg("%s.%s comes too late", objects[o]->name, objects[o]->fields[i].key);
}

TEST(readers_find_the_bounds_and_the_words_that_they_need)
{
    size_t bounds = 0, words = 0;
    for (size_t o = 0; o < OBJECTS; o++)
        for (size_t i = 0; i < objects[o]->count; i++) {
            const struct zr_json_field *field = &objects[o]->fields[i];
            if (field->read == zr_json_number || field->read == zr_json_float) {
                if (!(field->low < field->high)) fail_msg("%s.%s has no bounds", objects[o]->name, field->key);
                bounds++;
            }
            if (field->read == zr_json_choice) {
                if (!field->words || field->words->count < 1)
                    fail_msg("%s.%s has no words", objects[o]->name, field->key);
                words++;
            }
        }
    assert_true(bounds >= 8 && words >= 8);
}

RUN_TESTS(NULL, NULL)
