/* Reads materials of a fixed OBJ, whose textures are in the request. Draws most of them in the fastest look. */
#include "fuzz/fuzz.h"
#include "render_request.h"
#include "support/input/mtl_pictures.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 2\n"
                              "usemtl a\nf 1/1 2/2 3/3 4/4\nusemtl b c\nf 1/2 2/3 3/4\nusemtl\nf 1 2 4\n";
    const struct zr_asset assets[] = {{.name = "m.mtl", .bytes = data, .size = size},
                                      {.name = "p.png", .bytes = PICTURE_ALPHAS, .size = sizeof PICTURE_ALPHAS - 1},
                                      {.name = "q r.png", .bytes = PICTURE_ALPHAS, .size = sizeof PICTURE_ALPHAS - 2}};
    fuzz_request(&(struct zr_request){.format = ZR_FORMAT_OBJ,
                                      .bytes = obj,
                                      .size = sizeof obj - 1,
                                      .width = "32",
                                      .height = "24",
                                      .look = size % 8 ? "textbook" : "studio",
                                      .samples = "1",
                                      .assets = assets,
                                      .asset_count = 3});
    return 0;
}
