/* file_list.h - client: the files of a batch, from files, folders, globs and standard input. */
#ifndef FILE_LIST_H
#define FILE_LIST_H

#include "engine/job.h"

struct file_list {
    struct job *jobs; /* of the shard */
    size_t count;
    /* while the list is made */
    struct listed *files; /* of all shards */
    size_t file_count, room;
    size_t other_count; /* JSON files of folders that are no scenes (scene_key.h) */
    char first_other[256];
    struct shard shard;
    const char *folder; /* of the outputs; "": the current one */
    const struct options *options;
};

/* Makes the jobs of all arguments and of --list, or of one shard of them. A folder stands for the files below it that
 * have the ending of a format, without JSON files that are no scenes; their outputs keep the folders below it. Outputs of
 * equal names keep their endings, or the folders that tell them apart. "-" stands for lines of standard input: names, or
 * objects {"file": ..., "output": ..., "look": ...} with any parameters. The order depends on names alone. Returns 0, or
 * an exit status reported on stderr: a file is missing, a line is wrong, or two outputs have the same name, also if they
 * are of other shards. The texts live until the process ends. */
int file_list_make(struct file_list *list, const struct options *options);

#endif
