/* neighbours.h - client: files that the file to draw refers to, such as the textures of glTF, read from its folder.
 *
 * Found:  by its path from the folder of the referring file; else without regard to case; else by the path's last part.
 * Safe:   only regular files below the root folder are read, after all links are resolved. Paths that lead out of it,
 *         absolute ones too, cause a warning. The renderer reports a missing file by a warning or a fault.
 */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "input.h"

/* Adds the files that the body refers to, and those that these refer to, to the parts of the input, and warnings to
 * input->warnings. `root`: the option --root, or NULL for the folder of the file; standard input has none. Returns
 * false and adds a line to *faults if the root is no folder or memory is lacking. */
bool neighbours_read(struct input *input, const char *root, struct bytes *faults);

/* Adds the reason why the file of a name is no part of the input: "; the folder of a.json has no such file". Returns
 * false without memory. */
bool neighbours_explain(const struct input *input, const char *root, const char *name, struct bytes *out);

#endif
