#include "engine.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nettle/sha2.h>
#include <zlib.h>

#include "config.h"

#define SCRIPT "text/javascript; charset=utf-8"
#define MODULE "application/wasm"

/* The scripts that a Worker of a browser imports, and the modules with and without SIMD. */
static const struct {
    const char *name, *type;
} FILES[] = {
    {"browser.mjs", SCRIPT}, {"errors.mjs", SCRIPT},   {"options.mjs", SCRIPT},       {"worker.mjs", SCRIPT},
    {"zraster.mjs", SCRIPT}, {"zraster.wasm", MODULE}, {"worker_thread.mjs", SCRIPT}, {"zraster-scalar.wasm", MODULE},
    {"answers.mjs", SCRIPT}, {"remote.mjs", SCRIPT},
};

enum { COUNT = sizeof FILES / sizeof FILES[0], BYTES_MAX = 16 << 20, TAG_BYTES = 12, TAG_SIZE = 2 * TAG_BYTES + 1 };

struct engine {
    size_t count;
    struct site_file files[COUNT];
    char tags[COUNT][TAG_SIZE];
    unsigned char *packed[COUNT];
};

/* Reads a whole file into `bytes`, malloc'd. Returns the reason why it cannot, or NULL. */
static const char *read_bytes(int fd, unsigned char **bytes, size_t *size)
{
    struct stat info;
    if (fd < 0 || fstat(fd, &info) != 0) return strerror(errno);
    if (!S_ISREG(info.st_mode)) return "this is no regular file";
    if (info.st_size == 0) return "the file is empty";
    if (info.st_size > BYTES_MAX) return "the file has more than 16 MiB";
    *size = (size_t)info.st_size;
    *bytes = malloc(*size);
    if (!*bytes) return "out of memory";
    for (size_t used = 0; used < *size;) {
        const ssize_t count = read(fd, *bytes + used, *size - used);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return strerror(errno);
        if (count == 0) return "the file became shorter";
        used += (size_t)count;
    }
    return NULL;
}

/* Compresses bytes as gzip. Returns NULL without memory. */
static unsigned char *pack(const unsigned char *bytes, size_t size, size_t *packed_size)
{
    enum { GZIP = 16, MEMORY_LEVEL = 8 };
    z_stream stream = {.next_in = (z_const Bytef *)(uintptr_t)bytes, .avail_in = (uInt)size};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + GZIP, MEMORY_LEVEL, Z_DEFAULT_STRATEGY) !=
        Z_OK)
        return NULL;
    const uLong most = deflateBound(&stream, (uLong)size);
    unsigned char *packed = malloc(most);
    stream.next_out = packed;
    stream.avail_out = (uInt)most;
    const bool is_whole = packed && deflate(&stream, Z_FINISH) == Z_STREAM_END;
    *packed_size = stream.total_out;
    deflateEnd(&stream);
    if (!is_whole) {
        free(packed);
        return NULL;
    }
    unsigned char *shorter = realloc(packed, *packed_size);
    return shorter ? shorter : packed;
}

static void write_tag(char tag[TAG_SIZE], const unsigned char *bytes, size_t size)
{
    uint8_t hash[SHA256_DIGEST_SIZE];
    struct sha256_ctx state;
    sha256_init(&state);
    sha256_update(&state, size, bytes);
    sha256_digest(&state, sizeof hash, hash);
    for (int i = 0; i < TAG_BYTES; i++)
        snprintf(tag + 2 * i, 3, "%02x", hash[i]);
}

/* Adds the next file of the list. Returns the reason why it cannot, or NULL. */
static const char *add_file(struct engine *engine, const char *path)
{
    unsigned char *bytes = NULL;
    size_t size = 0, packed_size = 0;
    const size_t at = engine->count;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* no waiting for the other end of a pipe */
    const char *fault = read_bytes(fd, &bytes, &size);
    if (fd >= 0) close(fd);
    if (!fault && !(engine->packed[at] = pack(bytes, size, &packed_size))) fault = "out of memory";
    free(bytes);
    if (fault) return fault;
    write_tag(engine->tags[at], engine->packed[at], packed_size);
    engine->files[at] = (struct site_file){.name = FILES[at].name,
                                           .type = FILES[at].type,
                                           .tag = engine->tags[at],
                                           .bytes = engine->packed[at],
                                           .size = packed_size,
                                           .plain_size = size};
    engine->count++;
    return NULL;
}

struct engine *engine_read(const struct config *config, char *message, size_t message_size)
{
    struct engine *engine = calloc(1, sizeof *engine);
    const char *fault = engine ? NULL : "out of memory";
    char path[CONFIG_TEXT_SIZE + 32] = "";
    while (!fault && *config->engine_dir && engine->count < COUNT) {
        snprintf(path, sizeof path, "%s/%s", config->engine_dir, FILES[engine->count].name);
        fault = add_file(engine, path);
    }
    if (!fault) return engine;
    snprintf(message, message_size, "--engine-dir: %s: %s; the folder needs the package for JavaScript, of make npm",
             path, fault);
    engine_free(engine);
    return NULL;
}

void engine_free(struct engine *engine)
{
    if (!engine) return;
    for (size_t i = 0; i < COUNT; i++)
        free(engine->packed[i]);
    free(engine);
}

bool engine_is_there(const struct engine *engine)
{
    return engine && engine->count > 0;
}

const struct site_file *engine_find(const struct engine *engine, const char *name)
{
    for (size_t i = 0; engine && i < engine->count; i++)
        if (strcmp(engine->files[i].name, name) == 0) return &engine->files[i];
    return NULL;
}
