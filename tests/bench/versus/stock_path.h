/* stock_path.h - bench: a picture from scene JSON the way one puts it together from stock parts, in one process and
 * without HTTP: cJSON, llvmpipe, libpng with its default settings.
 */
#ifndef ZR_BENCH_STOCK_PATH_H
#define ZR_BENCH_STOCK_PATH_H

#include "bench/input/documents.h"
#include "bench/versus/stock_png.h"
#include "reference/gl/reference.h"

struct stock_path {
    struct reference *reference;
    const struct drawing *camera; /* window and matrices, which it need not read */
    struct stock_file file;       /* the last picture */
    uint8_t *pixels;
};

/* exact: see theirs_open. False, explained on stderr. */
bool stock_path_open(struct stock_path *path, bool exact, int threads, const struct drawing *camera);
void stock_path_close(struct stock_path *path);

/* Of a document_indexed with colours, all of whose faces are triangles. */
bool stock_path_answer(struct stock_path *path, const struct document *document);

#endif
