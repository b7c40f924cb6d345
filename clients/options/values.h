/* values.h - client: values of a JSON Schema in words, for the help of keys and the reference pages. */
#ifndef VALUES_H
#define VALUES_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdio.h>

enum { VALUES_PATH_SIZE = 160 };

struct values {
    const cJSON *all; /* definitions */
    FILE *out;
    const char *quote; /* around words and lists of JSON; NULL: none */
    /* Prints a link to a definition; NULL: definitions are described instead. */
    void (*refer)(const struct values *values, const char *name);
};

/* Return a member, or the text of a member: NULL and "" if there is none. */
const cJSON *values_member(const cJSON *object, const char *key);
const char *values_text(const cJSON *object, const char *key);

/* Returns the name that a schema refers to: "fit", or "view/properties/preset". NULL: it has no reference. */
const char *values_name(const cJSON *schema);

/* Returns the definition that a schema refers to, or NULL. */
const cJSON *values_follow(const cJSON *all, const cJSON *schema);

/* Prints the values that a schema allows: "number from 0 to 1". */
void values_print(const struct values *values, const cJSON *schema);

/* Prints a value of JSON, a string without its quotes. */
void values_print_json(const struct values *values, const cJSON *value);

/* Writes the path of an object in a scene: "/view/fit", "/lights/N"; "" of the scene. False: there is none. */
bool values_path(const cJSON *all, const char *name, char path[VALUES_PATH_SIZE]);

/* Returns the number of keys, of all objects, whose value is the object or a list of it. */
int values_places(const cJSON *all, const char *name);

#endif
