/* comparison_json.h - output: prints a comparison of two models as JSON. */
#ifndef ZR_COMPARISON_JSON_H
#define ZR_COMPARISON_JSON_H

#include "measure/comparison.h"
#include "output/bytes/buffer.h"
#include "scene/scene.h"

/* Prints one object and a line feed. `summary` is one line of numbers in words, for people and agents. Keys that cannot
 * be told, such as volumes of open surfaces, are left out. Places are in the space of the first file. Returns ZR_OK or
 * ZR_NO_MEMORY. */
enum zr_status zr_comparison_json_write(const struct zr_comparison *comparison, const struct zr_scene *a,
                                        const struct zr_scene *b, struct zr_buffer *out);

#endif
