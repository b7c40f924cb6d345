/* A mesh as STL, ASCII or binary. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_request(&(struct zr_request){
        .format = ZR_FORMAT_STL, .bytes = (const char *)data, .size = size, .width = "48", .height = "32"});
    return 0;
}
