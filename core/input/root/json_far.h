/* json_far.h - input: scenes in JSON that are far from the origin (text/recenter.h).
 *
 *     read the scene; if zr_far_find finds numbers to subtract, read it again with them
 */
#ifndef ZR_JSON_FAR_H
#define ZR_JSON_FAR_H

#include "input/scene/json_scene.h"
#include "input/text/recenter.h"

/* Finds the offsets of a scene that was read without them. That of positions is the middle of all lists if they are
 * remote together, else of each remote list. That of places is the middle of a remote scene. False if nothing is far, or
 * without memory. */
bool zr_far_find(const struct zr_parsed_scene *root, struct zr_far *far);

#endif
