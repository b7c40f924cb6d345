/* line_file.h - output: the file of a frame's lines: units, widths, colours.
 *
 * Unit:  millimetres if the scene's unit is known and all pixels have the same length in the scene, else scene units.
 *        In perspective, and if pixels are not square, pixels.
 * Width: as in pictures. In millimetres, the nearest of ISO 128 (output/svg.h). */
#ifndef ZR_LINE_FILE_H
#define ZR_LINE_FILE_H

#include "output/bytes/buffer.h"
#include "shade/frame.h"

/* Appends the SVG. `scene` needs no geometry. Returns false if the arena failed. */
bool zr_line_file_write(const struct zr_scene *scene, const struct zr_frame *frame, struct zr_buffer *out);

#endif
