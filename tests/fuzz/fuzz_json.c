/* A scene in JSON: read, drawn by two algorithms, and encoded. */
#include "fuzz/fuzz.h"
#include "render_request.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_request(&(struct zr_request){.format = ZR_FORMAT_JSON, .bytes = (const char *)data, .size = size});
    return 0;
}
