/* json_image_ahead.h - input: images of a scene that are decoded before the textures that use them are read. */
#ifndef ZR_JSON_IMAGE_AHEAD_H
#define ZR_JSON_IMAGE_AHEAD_H

#include "input/images/image_ahead.h"
#include "input/scene/json_scene.h"

/* Decodes the images of all materials by several threads. Faults are reported when the textures are read. */
void zr_parsed_read_ahead(struct zr_parsed_scene *root);

/* For readers that find the files themselves. zr_parsed_ahead_add adds a file without a name to root->ahead, unless the
 * list has its bytes or is full. The bytes must outlive the reading. zr_parsed_ahead_decode decodes the files of the
 * list. */
void zr_parsed_ahead_add(struct zr_parsed_scene *root, const struct zr_parsed_bytes *bytes);
void zr_parsed_ahead_decode(struct zr_parsed_scene *root);

/* Returns the file with this name or these bytes, or NULL. */
const struct zr_image_file *zr_parsed_ahead_name(const struct zr_parsed_ahead *ahead, const struct zr_bytes_name *name);
const struct zr_image_file *zr_parsed_ahead_bytes(const struct zr_parsed_ahead *ahead,
                                                  const struct zr_parsed_bytes *bytes);

#endif
