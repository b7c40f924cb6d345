/* documents.h - bench: a drawing as scene JSON, in both forms that a client may choose, and as files of its triangles.
 *
 * Numbers have up to 7 digits, as models have: sizes are those of what people send.
 */
#ifndef ZR_BENCH_DOCUMENTS_H
#define ZR_BENCH_DOCUMENTS_H

#include <stddef.h>

#include "reference/drawing.h"

/* NULL, or bytes to be freed, zero-terminated beyond `size`. */
struct document {
    char *bytes;
    size_t size;
};

/* One mesh: positions, where asked for a colour each, and faces; unlit, both sides, on black; the colour PNG. */
struct document document_indexed(const struct drawing *drawing, bool colors);

/* The same without colours: of 17 digits, as Python writes doubles; and with a blank behind each comma, as its
 * json.dumps does. */
struct document document_digits(const struct drawing *drawing);
struct document document_spaced(const struct drawing *drawing);

/* The plain form: a list of polygons, each with its own vertices. */
struct document document_soup(const struct drawing *drawing);

/* Positions and faces alone, as Meshlab writes them. */
struct document document_obj(const struct drawing *drawing);

/* Of triangles. As text, laid out as most programs do it. */
struct document document_stl(const struct drawing *drawing);
struct document document_stl_text(const struct drawing *drawing);
struct document document_ply(const struct drawing *drawing);
struct document document_ply_text(const struct drawing *drawing);
struct document document_glb(const struct drawing *drawing);

#endif
