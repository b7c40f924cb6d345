#include "store_name.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>

#include <nettle/base16.h>
#include <nettle/sha2.h>

#include "store_file.h"

enum { CHUNK_BYTES = 64 << 10 };

bool store_is_name(const char *text)
{
    return strspn(text, "0123456789abcdef") == STORE_NAME_SIZE - 1 && text[STORE_NAME_SIZE - 1] == '\0';
}

static void finish(struct sha256_ctx *context, char name[STORE_NAME_SIZE])
{
    uint8_t digest[SHA256_DIGEST_SIZE];
    sha256_digest(context, sizeof digest, digest);
    base16_encode_update(name, sizeof digest, digest);
    name[STORE_NAME_SIZE - 1] = '\0';
}

void store_name(const void *bytes, size_t size, char name[STORE_NAME_SIZE])
{
    struct sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, size, bytes);
    finish(&context, name);
}

bool store_name_of_file(int fd, size_t size, const struct zr_cancel *cancel, char name[STORE_NAME_SIZE])
{
    struct sha256_ctx context;
    uint8_t chunk[CHUNK_BYTES];
    sha256_init(&context);
    for (size_t done = 0; done < size;) {
        const size_t count = size - done < sizeof chunk ? size - done : sizeof chunk;
        if (zr_is_cancelled(cancel)) {
            errno = ECANCELED;
            return false;
        }
        if (!store_file_read(fd, chunk, count)) return false;
        sha256_update(&context, count, chunk);
        done += count;
    }
    finish(&context, name);
    return true;
}
