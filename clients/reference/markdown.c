#include "markdown.h"

#include <ctype.h>
#include <string.h>

#include "schema/schema.h"

void markdown_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (strchr("|*<", *text)) fputc('\\', out);
        fputc(*text, out);
    }
}

void markdown_code(FILE *out, const char *code)
{
    fputc('`', out);
    for (; *code; code++) {
        if (*code == '|') fputc('\\', out);
        fputc(*code, out);
    }
    fputc('`', out);
}

void markdown_sentence(FILE *out, const char *text)
{
    fputc(zr_schema_first_letter(text), out);
    markdown_text(out, text + 1);
    fputc('.', out);
}

static void put_lower(FILE *out, const char *text)
{
    for (; *text; text++)
        fputc(tolower((unsigned char)*text), out);
}

static void put_address(FILE *out, const char *object, const char *key)
{
    put_lower(out, object);
    if (!key) return;
    fputc('-', out);
    put_lower(out, key);
}

void markdown_link(FILE *out, const char *words, const char *page, const char *object, const char *key)
{
    fprintf(out, "[`%s`](%s.md#", words, page);
    put_address(out, object, key);
    fputc(')', out);
}

void markdown_begin_row(FILE *out, const char *object, const char *key)
{
    fputs("| <a id=\"", out);
    put_address(out, object, key);
    fputs("\"></a>", out);
}

void markdown_end_row(FILE *out, const char *meaning)
{
    fputs(" | ", out);
    markdown_sentence(out, meaning);
    fputs(" |\n", out);
}
