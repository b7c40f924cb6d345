/* A PNG as the colour of a base. */
#include "fuzz/base.h"
#include "fuzz/fuzz.h"
#include "fuzz/png_checksums.h"
#include "render_request.h"

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max, unsigned seed)
{
    size = LLVMFuzzerMutate(data, size, max);
    if (seed % 16) png_checksums_mend(data, size);
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char scene[] =
        BASE_SCENE("\"color\":{\"asset\":\"a\"},\"windowDepth\":{\"asset\":\"z\"}", "{\"channel\":\"color\"}");
    float depths[BASE_PIXELS];
    char z[NPY_BYTES];
    for (size_t i = 0; i < BASE_PIXELS; i++)
        depths[i] = (float)i / BASE_PIXELS;
    base_npy(z, "<f4", depths);
    const struct zr_asset assets[] = {{.name = "a", .bytes = data, .size = size},
                                      {.name = "z", .bytes = z, .size = sizeof z}};
    fuzz_request(&(struct zr_request){
        .format = ZR_FORMAT_JSON, .bytes = scene, .size = sizeof scene - 1, .assets = assets, .asset_count = 2});
    return 0;
}
