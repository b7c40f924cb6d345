/* A mesh as OBJ. Its size chooses how it is drawn. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const presets[] = {"isometric", "front", "top"}, *const shadings[] = {"gouraud", "flat",
                                                                                             "unlit"};
    fuzz_request(&(struct zr_request){.format = ZR_FORMAT_OBJ,
                                      .bytes = (const char *)data,
                                      .size = size,
                                      .width = "48",
                                      .height = "32",
                                      .preset = presets[size % 3],
                                      .shading = shadings[size / 3 % 3]});
    return 0;
}
