/* zraster.c - the command line: draws files in this process by libzraster, or by a daemon. */
#include <stdio.h>

#include "api/zraster.h"
#include "help.h"
#include "tables.h"

int main(int count, char **arguments)
{
    static struct options options;
    int status = options_read(count - 1, (const char **)arguments + 1, &options);
    if (status == 0 && options.own[OPTION_HELP])
        help_print(options.command);
    else if (status == 0 && options.own[OPTION_VERSION])
        printf("zraster %s\n", zraster_version());
    else if (status == 0)
        status = options.command->run(&options);
    tables_close();
    if (fflush(stdout) == 0) return status;
    perror("zraster: standard output");
    return status ? status : STATUS_FAILED;
}
