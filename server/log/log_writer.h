/* log_writer.h - writes log lines to standard error on a thread of its own. If standard error is read too slowly, lines
 * are lost and counted, and no answer waits.
 */
#ifndef ZRASTERD_LOG_WRITER_H
#define ZRASTERD_LOG_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LOG_BUFFER_BYTES = 1 << 20 };

/* Starts the thread. Without it, before this call or after log_writer_stop, lines are written at once. False: no thread
 * available. */
bool log_writer_start(void);

/* Writes the buffered lines, for a second at most, and ends the thread. */
void log_writer_stop(void);

/* Adds a complete line. Thread-safe. False: the buffer is full, and the line is lost. */
bool log_writer_put(const char *line, size_t size);

/* Returns and resets the count of lost lines once half of the buffer is free; 0 until then. */
uint64_t log_writer_take_lost(void);

/* Returns the count of lines that were lost since the start. */
uint64_t log_writer_lost_ever(void);

#endif
