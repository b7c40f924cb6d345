/* check.c - folders that settings name. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "value.h"

static void check_folder(const struct config *config, const struct setting *s, struct config_source source,
                         struct faults *faults)
{
    struct stat status;
    const char *path = value_text(config, s);
    char place[VALUE_PLACE_SIZE];
    value_place(config, s, source, place);
    const bool is_there = stat(path, &status) == 0;
    if (is_there && !S_ISDIR(status.st_mode))
        faults_add(faults, "%s: '%.200s' is no folder", place, path);
    else if (!is_there || access(path, R_OK | W_OK | X_OK) != 0)
        faults_add(faults, "%s: cannot use '%.200s': %s", place, path, strerror(errno));
}

bool config_check_folders(const struct config *config, char *message, size_t message_size)
{
    struct faults faults;
    const struct setting *s;
    unsigned counts[CONFIG_FLAG + 1] = {0};
    faults_begin(&faults, message, message_size);
    for (size_t i = 0; (s = setting_at(i)); i++) {
        counts[config->sources[i].kind]++;
        if (s->kind == FOLDER && *value_text(config, s)) check_folder(config, s, config->sources[i], &faults);
    }
    faults_end(&faults);
    if (faults.count > 0) return false;
    snprintf(message, message_size,
             "the settings are valid: %u from the file, %u from variables, %u from flags; the others are defaults",
             counts[CONFIG_FILE], counts[CONFIG_VARIABLE], counts[CONFIG_FLAG]);
    return true;
}
