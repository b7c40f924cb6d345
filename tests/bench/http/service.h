/* service.h - bench: the daemon, over HTTP. */
#ifndef ZR_BENCH_SERVICE_H
#define ZR_BENCH_SERVICE_H

#include "bench/bench.h"

/* The bunny as indexed JSON to a PNG, against the stock path (stock_path.h), on 1 and 2 threads; first the pixels of
 * both are compared. The note tells what the daemon says of its steps. */
void service_against_stock(struct bench *bench);

/* A scene of textured objects, its colours, depths and ids in one request, on 1 thread, against llvmpipe that draws it
 * and reads them back, in this process; first all that is read is compared. The note tells what the steps take. */
void service_for_simulator(struct bench *bench);

/* The daemon's cheapest answer against libmicrohttpd alone, giving the same bytes. */
void service_against_bare_http(struct bench *bench);

/* From exec to the first PNG of a cube, against a process that opens Mesa and reads back its first frame. */
void service_cold_start(struct bench *bench);

/* A small request alone, beside a large one, and beside four of them; the note has the slowest time. No rival
 * runs. */
void service_beside_large(struct bench *bench);

/* The same beside six clients that read a large asset, and six whose small bodies inflate to large ones. */
void service_beside_io(struct bench *bench);

/* Many clients at once, of a daemon on one processor: on kept connections, and with ten times more than it can do. */
void service_for_many(struct bench *bench);

/* Pictures served by a daemon on one processor while its metrics are asked for twice a second, against as many without
 * (scraped.c). */
void service_while_scraped(struct bench *bench);

/* The rate of several kinds of pictures on one processor, with memory, bytes and waits in notes (capacity.c). */
void service_capacity(struct bench *bench);

/* Model files again with other matrices, against a daemon that reads them anew; the bytes must be equal. The note tells
 * what the whole request takes beside drawing alone. */
void service_with_kept_meshes(struct bench *bench);

/* Several views by one request, against a request for each (views_http.c). */
void service_with_views(struct bench *bench);

/* Frames of Drake's protocol, the first against later ones (drake_http.c). */
void service_for_drake(struct bench *bench);

/* Bytes a pixel and a triangle, in notes. */
void service_memory(struct bench *bench);

#endif
