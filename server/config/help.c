#include <inttypes.h>

#include "value.h"

void config_print_help(FILE *out)
{
    struct config defaults;
    value_set_defaults(&defaults);
    fprintf(
        out,
        "zrasterd " ZR_VERSION ": renders the scenes and meshes that clients POST to /v1/render.\n\n"
        "usage: zrasterd [--flag=value | --flag value]...\n\n"
        "  --help, --version\n"
        "  --health        health check of the daemon at --address and --port: exit status 0 if it answers well, else "
        "1\n"
        "  --check-config  checks all settings, and the folders and files that they name: exit status 0, or 2 with all "
        "faults\n"
        "  --print-config  prints the settings as a file for --config, and where each comes from\n\n"
        "There are three ways to give a setting. A later one overrides an earlier one:\n"
        "  a line of the file of --config   body-max-bytes = 1000000\n"
        "  a variable                       ZRASTER_BODY_MAX_BYTES=1000000\n"
        "  a flag                           --body-max-bytes=1000000\n\n");
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++) {
        fprintf(out, "  --%s=%s\n      %s%s%s\n", s->flag, s->kind != NUMBER ? "TEXT" : "N", s->unit,
                *s->unit ? " " : "", s->help);
        if (s->kind != NUMBER)
            fprintf(out, "      (default: %s)\n", *s->text ? s->text : "none");
        else
            fprintf(out, "      %" PRIu64 " to %" PRIu64 " (default: %" PRIu64 ")\n", s->min, s->max,
                    value_number(&defaults, s));
    }
}
