/* svg_marks.h - output: marks of overlay/marks.h as SVG.
 *
 * Form:   a group "halos" and a group "marks", in an element with fill="none" and round ends and joins. Lines and
 *         letters are paths with strokes, areas are paths that are filled. A text is a group with role="img" and the
 *         text as aria-label: it looks the same everywhere, and can be found and read aloud.
 * Exact:  the same bytes for every machine, LC_NUMERIC being "C". */
#ifndef ZR_SVG_MARKS_H
#define ZR_SVG_MARKS_H

#include "output/bytes/buffer.h"
#include "overlay/marks.h"

/* Appends the groups. `pixel`: length of a pixel in units of the output. Texts must be valid UTF-8. */
void zr_svg_print_marks(struct zr_buffer *out, const struct zr_marks *marks, double pixel);

#endif
