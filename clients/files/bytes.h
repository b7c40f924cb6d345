/* bytes.h - client: whole files in memory. */
#ifndef BYTES_H
#define BYTES_H

#include <stdbool.h>
#include <stddef.h>

struct bytes {
    char *data; /* NULL while empty */
    size_t size, room;
    bool is_mapped; /* a file in memory, which nothing is added to */
};

bool bytes_add(struct bytes *bytes, const void *data, size_t size);

/* Adds a text. bytes_text returns all texts as one, valid until the next change. */
__attribute__((format(printf, 2, 3))) bool bytes_print(struct bytes *bytes, const char *format, ...);
const char *bytes_text(const struct bytes *bytes);

void bytes_free(struct bytes *bytes);

/* Sets how many bytes of a file or of standard input bytes_read takes; 8 GiB before. */
void bytes_set_most(unsigned long long most);

/* From then on, bytes_read maps files of 64 MiB and more into memory instead of copying them. If one becomes shorter
 * meanwhile, the process ends with status 1 and says so: for commands that draw one file. */
void bytes_map_large_files(void);

/* Reads a file; "-": standard input. A zero follows the bytes. Waits for a pipe until it ends or a signal is caught
 * (engine/interruption.h). Returns false with errno on failure: EINTR after a signal, EFBIG for too many bytes, ENODEV
 * for a device that is no terminal. */
bool bytes_read(struct bytes *bytes, const char *path);

/* Adds the reason why bytes_read failed, by errno. */
void bytes_explain(struct bytes *faults);

/* Returns true if both paths are one regular file. For `a`, "-" is standard input. */
bool bytes_same_file(const char *a, const char *b);

/* Writes a file; "-": standard output. A regular file gets its name once it is written, so it is never incomplete, even
 * if the process is killed. */
bool bytes_write(const struct bytes *bytes, const char *path);

#endif
