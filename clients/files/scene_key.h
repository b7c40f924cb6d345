/* scene_key.h - client: tells scenes from other JSON files of a folder, such as the info.json of a picture. */
#ifndef SCENE_KEY_H
#define SCENE_KEY_H

#include <stdbool.h>

/* Returns true if the root of a JSON file has the key meshes or polygons, as each scene has, before a key rules, with
 * which each info begins. Reads no further. Also true for a file that cannot be read: drawing it tells why. */
bool scene_key_found(const char *path);

#endif
