/* A Content-Type header in the first line, the body behind it. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "routes/multipart.h"

static void expect_parts(const struct multipart *parts, const char *bytes, size_t size)
{
    const char *free_from = bytes;
    fuzz_expect(parts->count <= MULTIPART_PARTS_MAX, "no more parts than may be");
    for (size_t i = 0; i < parts->count; i++) {
        const struct multipart_part *part = &parts->parts[i];
        fuzz_expect(part->bytes >= free_from && part->size <= (size_t)(bytes + size - part->bytes),
                    "parts lie in the body, one behind the other");
        fuzz_expect(!part->type || (part->type >= free_from && part->type + part->type_size <= part->bytes),
                    "a type lies in front of its part");
        const size_t length = strnlen(part->name, sizeof part->name);
        fuzz_expect(length >= 1 && length <= MULTIPART_NAME_MAX, "names are neither empty nor too long");
        fuzz_expect(multipart_find(parts, part->name) == part, "no two parts have one name");
        free_from = part->bytes + part->size;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct multipart parts;
    char boundary[MULTIPART_BOUNDARY_SIZE];
    const char *fault = NULL;
    const uint8_t *line_end = size ? memchr(data, '\n', size) : NULL;
    fuzz_accepted = false;
    if (!line_end) return 0;
    const size_t type_size = (size_t)(line_end - data);
    char *type = malloc(type_size + 1);
    fuzz_expect(type, "memory");
    memcpy(type, data, type_size);
    type[type_size] = '\0';
    const char *body = (const char *)line_end + 1;
    const size_t body_size = size - type_size - 1;
    if (!multipart_boundary(type, boundary, &fault)) {
        fuzz_expect(fault && *fault, "a refusal says why");
    } else {
        fuzz_expect(strlen(boundary) >= 1, "a boundary is not empty");
        fault = NULL;
        fuzz_accepted = multipart_parse(boundary, body, body_size, &parts, &fault);
        if (fuzz_accepted)
            expect_parts(&parts, body, body_size);
        else
            fuzz_expect(fault && *fault, "a refusal says why");
    }
    free(type);
    return 0;
}
