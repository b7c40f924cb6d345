/* An archive: every member that opens is read. */
#include "fuzz/fuzz.h"
#include "input/zip/zip_read.h"

enum { CEILING = 1 << 20 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct zr_arena arena;
    struct zr_zip zip;
    struct zr_reason reason = {""};
    if (!arena.ceiling) zr_arena_init(&arena, CEILING);
    const enum zr_status status = zr_zip_open(&arena, (const char *)data, size, &zip, &reason);
    fuzz_accepted = status == ZR_OK;
    fuzz_expect(status == ZR_OK || *reason.text || status == ZR_NO_MEMORY, "a refusal has a reason");
    for (size_t i = 0; status == ZR_OK && i < zip.count && zr_arena_ok(&arena); i++) {
        const struct zr_zip_member *member = &zip.members[i];
        const char *bytes = NULL;
        const enum zr_status read = zr_zip_read(member, &arena, &bytes, &reason);
        fuzz_expect(read != ZR_OK || bytes, "what is read has bytes");
        fuzz_expect(zr_zip_find(&zip, member->name, member->name_length) == member, "a member is found by its name");
    }
    zr_arena_reset(&arena, ZR_ARENA_BLOCK);
    return 0;
}
