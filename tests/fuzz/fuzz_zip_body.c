/* Reads a ZIP archive as a body. Packs the archive from the input: each member is a name, a zero, its bytes and the
 * byte 0xFF. Lists the references of each member, too. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "render_request.h"
#include "support/input/zip_file.h"

enum { MEMBERS_MAX = 16, NAMES_ROOM = 64 };

static void list(const struct zip_entry *entry, const char *ending)
{
    char names[NAMES_ROOM];
    const size_t used = zr_references_list(entry->bytes, entry->size, ending, names, sizeof names);
    fuzz_expect(used == zr_references_list(entry->bytes, entry->size, ending, NULL, 0), "both counts are the same");
    fuzz_expect(used > sizeof names || used == 0 || names[used - 1] == '\0', "the last name ends");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    struct zip_entry entries[MEMBERS_MAX];
    size_t count = 0, archive_size, directory;
    if (!text) abort();
    if (size > 0) memcpy(text, data, size);
    text[size] = '\0';
    for (char *at = text, *const end = text + size; at < end && count < MEMBERS_MAX;) {
        char *bytes = at + strlen(at) + (at + strlen(at) < end), *next = memchr(bytes, 0xFF, (size_t)(end - bytes));
        if (!next) next = end;
        entries[count] = (struct zip_entry){at, bytes, (size_t)(next - bytes), count % 2 == 0};
        const char *dot = strrchr(at, '.');
        list(&entries[count++], dot ? dot + 1 : NULL);
        at = next + 1;
    }
    unsigned char *archive = zip_file(entries, count, &archive_size, &directory);
    const bool is_scene = count > 0 && strstr(entries[0].name, ".json"); /* its window is in it */
    fuzz_request(&(struct zr_request){.format = ZR_FORMAT_ZIP,
                                      .bytes = (const char *)archive,
                                      .size = archive_size,
                                      .width = is_scene ? NULL : "48",
                                      .height = is_scene ? NULL : "32",
                                      .member = size % 16 == 9 ? "b" : NULL});
    free(archive);
    free(text);
    return 0;
}
