/* compare.c - client: `zraster compare`: two pictures, two arrays, or two models. */
#include "commands/compare.h"

#include <stdio.h>

#include "files/input.h"
#include "files/numbers.h"
#include "files/pixels.h"

enum kind { UNKNOWN, PICTURE, ARRAY, MODEL, KINDS };

/* Returns the kind of a file, by its ending or its first bytes. */
static enum kind kind_of(const struct options *options, const char *path)
{
    unsigned char head[PIXELS_HEAD];
    if (input_kind_of(path, options) != INPUT_UNKNOWN) return MODEL;
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(head, 1, sizeof head, file) : 0;
    if (file) fclose(file);
    return numbers_are_in(head, size) ? ARRAY : pixels_are_in(head, size) ? PICTURE : UNKNOWN;
}

int command_compare(struct options *options)
{
    if (options->file_count == 3 && !options->own[OPTION_OUTPUT])
        return options_wrong("compare needs two files; -o %s saves the differences", options->files[2]);
    if (options->file_count != 2)
        return options_wrong("compare needs two pictures or two models: \"zraster compare a.png b.png -o diff.png\", "
                             "\"zraster compare a.stl b.stl\"");
    const char *a = options->files[0], *b = options->files[1];
    const enum kind first = kind_of(options, a), second = kind_of(options, b);
    static const char *const words[KINDS] = {"", "a picture", "an array", "a model"};
    if (first != second && first != UNKNOWN && second != UNKNOWN)
        return options_wrong("%s is %s and %s is %s: compare two of one kind", a, words[first], b, words[second]);
    if (first == ARRAY || second == ARRAY) return compare_numbers(options);
    if (first != MODEL && second != MODEL) return compare_pictures(options);
    return compare_models(options);
}
