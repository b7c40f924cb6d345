/* markdown.h - reference pages: cells and rows of tables in Markdown, addresses of keys, and links to them.
 *
 * A key has the address "#object-key" in small letters. Without a key, it is that of the object: "#object".
 */
#ifndef MARKDOWN_H
#define MARKDOWN_H

#include <stdio.h>

/* Prints text for a cell: marks of Markdown have no effect. */
void markdown_text(FILE *out, const char *text);

/* Prints code for a cell, where only | has to be marked. */
void markdown_code(FILE *out, const char *code);

/* Prints the meaning of a row as a sentence, for a cell. */
void markdown_sentence(FILE *out, const char *text);

/* Prints a link to an object, or to its key, on PAGE.md. `key` may be NULL. */
void markdown_link(FILE *out, const char *words, const char *page, const char *object, const char *key);

/* Begins a row that has an address. `key` may be NULL. */
void markdown_begin_row(FILE *out, const char *object, const char *key);

/* Ends a row with such a sentence. */
void markdown_end_row(FILE *out, const char *meaning);

#endif
