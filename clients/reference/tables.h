/* tables.h - reference pages: tables of Markdown from the rows of the core.
 *
 * Each table goes to values.out. Values of JSON are in words, as `zraster help KEY` has them, with links to the page of
 * each object and to values.md. A key has the address "#object-key" in small letters.
 */
#ifndef TABLES_H
#define TABLES_H

#include "options/values.h"

/* The page of an object, "view" for view.md; NULL: on none. */
typedef const char *tables_page_fn(const char *object);

struct tables {
    struct values values;
    tables_page_fn *page_of;
    const cJSON *parameters; /* as OpenAPI has them */
};

/* Makes values link to the pages of objects and kinds. */
void tables_link(struct tables *tables);

/* Print the table of one object's keys, of kinds of values, of the parameters of a query, and of all objects. False:
 * there is no such object. */
bool tables_print_object(const struct tables *tables, const char *name);
void tables_print_values(const struct tables *tables);
void tables_print_parameters(const struct tables *tables);
void tables_print_index(const struct tables *tables);

#endif
