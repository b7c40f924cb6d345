/* several.c - client: `zraster views`, `zraster sheet` and `zraster turntable`: several views of one file. */
#include <string.h>
#include <strings.h>

#include "options/parameters.h"
#include "render.h"

/* Sets a parameter that the command line does not give. */
static void suggest(struct options *options, enum parameter parameter, const char *value)
{
    if (!options->parameters[parameter]) options->parameters[parameter] = value;
}

int command_views(struct options *options)
{
    if (!options->parameters[PARAMETER_orbit]) suggest(options, PARAMETER_views, "front,top,right,isometric");
    return command_render(options);
}

int command_sheet(struct options *options)
{
    const bool has_views = options->parameters[PARAMETER_views] || options->parameters[PARAMETER_turntable] ||
                           options->parameters[PARAMETER_orbit];
    suggest(options, PARAMETER_sheet, has_views ? "views" : "threeView");
    return command_render(options);
}

/* Returns the output's name: -o, or the second file. */
static const char *find_output(const struct options *options)
{
    if (options->own[OPTION_OUTPUT]) return options->own[OPTION_OUTPUT];
    return options->file_count == 2 ? options->files[1] : "";
}

int command_turntable(struct options *options)
{
    const char *ending = strrchr(find_output(options), '.');
    /* chosen by the ending (output.h) */
    const bool is_moving = ending && (strcasecmp(ending, ".webp") == 0 || strcasecmp(ending, ".gif") == 0);
    suggest(options, PARAMETER_turntable, "36");
    if (!options->parameters[PARAMETER_channel] && !is_moving) suggest(options, PARAMETER_encoding, "apng");
    return command_render(options);
}
