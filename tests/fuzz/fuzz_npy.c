/* An array as the z-buffer, the depth and the ids of a base. */
#include <string.h>

#include "fuzz/base.h"
#include "fuzz/fuzz.h"
#include "render_request.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const scenes[] = {
        BASE_SCENE("\"windowDepth\":{\"asset\":\"a\"}", "{\"channel\":\"windowDepth\"}"),
        BASE_SCENE("\"depth\":{\"asset\":\"a\"}",
                   "{\"channel\":\"depth\",\"encoding\":\"png16\"},{\"channel\":\"windowDepth\"}"),
        BASE_SCENE("\"windowDepth\":{\"asset\":\"z\"},\"faceId\":{\"asset\":\"a\"}",
                   "{\"channel\":\"faceId\"},{\"channel\":\"info\"}"),
    };
    /* In front of all, so that any ids pass. */
    static const float nearest[BASE_PIXELS];
    char z[NPY_BYTES];
    base_npy(z, "<f4", nearest);
    const struct zr_asset assets[] = {{.name = "a", .bytes = data, .size = size},
                                      {.name = "z", .bytes = z, .size = sizeof z}};
    bool accepted = false;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        fuzz_request(&(struct zr_request){.format = ZR_FORMAT_JSON,
                                          .bytes = scenes[i],
                                          .size = strlen(scenes[i]),
                                          .assets = assets,
                                          .asset_count = 2});
        accepted |= fuzz_accepted;
    }
    fuzz_accepted = accepted;
    return 0;
}
