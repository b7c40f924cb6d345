/* replay [--accepted] FOLDER... - hands each file of the folders to the target that it is linked with. A crash is what
 * fails; behind --accepted, a file that is refused, too. Prints TAP. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "support/files.h"

enum { PATH_SIZE = 4096 };

static int count, failed;

static void replay_file(const char *path, bool wanted)
{
    size_t size;
    char *bytes = file_read(path, &size), *exact = bytes ? malloc(size ? size : 1) : NULL;
    if (exact) memcpy(exact, bytes, size); /* with nothing behind, so that a sanitizer sees what reads on */
    free(bytes);
    fprintf(stderr, "%s\n", path);
    if (exact) LLVMFuzzerTestOneInput((const uint8_t *)exact, size);
    const bool ok = exact && (fuzz_accepted || !wanted);
    free(exact);
    if (!ok) failed++;
    printf("%sok %d - %s%s\n", ok ? "" : "not ", ++count, path, wanted ? " is accepted" : "");
}

static void replay_folder(const char *folder, bool wanted)
{
    struct dirent **entries;
    const int entry_count = scandir(folder, &entries, NULL, alphasort);
    for (int i = 0; i < entry_count; i++) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.') replay_file(path, wanted);
        free(entries[i]);
    }
    if (entry_count >= 0) free(entries);
}

int main(int argument_count, char **arguments)
{
    bool wanted = false;
    for (int i = 1; i < argument_count; i++)
        if (strcmp(arguments[i], "--accepted") == 0)
            wanted = true;
        else
            replay_folder(arguments[i], wanted);
    printf("1..%d\n", count);
    return failed || !count;
}
