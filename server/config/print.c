/* print.c - settings as a file of settings. */
#include <inttypes.h>

#include "file.h"
#include "value.h"

static void print_source(const struct config *config, struct config_source source, const struct setting *s, FILE *out)
{
    char place[VALUE_PLACE_SIZE] = "default";
    if (source.kind == CONFIG_FILE)
        snprintf(place, sizeof place, "%s:%u", config->config, source.line);
    else if (source.kind != CONFIG_DEFAULT)
        value_place(config, s, source, place);
    fprintf(out, "  # %s", place);
}

static void print_setting(const struct config *config, const struct config *settled, const struct setting *s,
                          struct config_source source, FILE *out)
{
    const char *text = s->kind == NUMBER ? "" : value_text(config, s);
    const bool is_hidden = s->kind == SECRET && *text;
    fprintf(out, "%s%s =%s", is_hidden ? "# " : "", s->flag, s->kind == NUMBER || *text ? " " : "");
    if (s->kind == NUMBER)
        fprintf(out, "%" PRIu64, value_number(config, s));
    else if (is_hidden)
        fputs("(set)", out);
    else
        file_print_text(text, out);
    print_source(config, source, s, out);
    if (s->kind == NUMBER && value_number(config, s) != value_number(settled, s))
        fprintf(out, "; here %" PRIu64, value_number(settled, s));
    putc('\n', out);
}

void config_print(const struct config *config, FILE *out)
{
    struct config settled = *config;
    const struct setting *s;
    value_settle(&settled);
    fputs("# zrasterd " ZR_VERSION "\n", out);
    for (size_t i = 0; (s = setting_at(i)); i++)
        if (!setting_is_file(s)) print_setting(config, &settled, s, config->sources[i], out);
}
