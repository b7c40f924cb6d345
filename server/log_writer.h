/* log_writer.h - lines on their way to standard error. Whoever has a line hands it over and goes on: a thread of its
 * own writes, and where nobody reads what it writes, lines are lost and counted, and no answer waits.
 */
#ifndef ZRASTERD_LOG_WRITER_H
#define ZRASTERD_LOG_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LOG_BUFFER_BYTES = 1 << 20 };

/* Until it is started, and once it is stopped, lines are written at once. False: no thread could be had. */
bool log_writer_start(void);

/* Writes what there is, for a second at most. */
void log_writer_stop(void);

/* A whole line. Thread-safe. False: the buffer is full, and the line is lost. */
bool log_writer_put(const char *line, size_t size);

/* How many lines were lost, to be told once there is room again; 0 until then. They count as told. */
uint64_t log_writer_take_lost(void);

#endif
