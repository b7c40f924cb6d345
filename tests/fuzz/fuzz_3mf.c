/* The model part of a 3MF: the bytes are packed first. */
#include <stdlib.h>

#include "fuzz/fuzz.h"
#include "support/zip_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const struct zip_entry part = {"3D/3dmodel.model", (const char *)data, size, false};
    size_t package_size;
    unsigned char *package = zip_3mf(&part, 1, &package_size);
    fuzz_request(&(struct zr_request){
        .format = ZR_FORMAT_3MF, .bytes = (const char *)package, .size = package_size, .width = "48", .height = "32"});
    free(package);
    return 0;
}
