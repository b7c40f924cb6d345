/* The materials of a fixed OBJ, whose textures are there. */
#include "fuzz/fuzz.h"

/* A PNG of 2 by 2 pixels with alpha. */
static const char PICTURE[] =
    "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\002\000\000\000\002"
    "\010\006\000\000\000\162\266\015\044\000\000\000\026\111\104\101\124\170\332\143\370\317\300\360"
    "\037\010\101\340\177\003\047\047\247\003\000\063\362\004\330\355\240\116\225\000\000\000\000\111"
    "\105\116\104\256\102\140\202";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 2\n"
                              "usemtl a\nf 1/1 2/2 3/3 4/4\nusemtl b c\nf 1/2 2/3 3/4\nusemtl\nf 1 2 4\n";
    const struct zr_asset assets[] = {{.name = "m.mtl", .bytes = data, .size = size},
                                      {.name = "p.png", .bytes = PICTURE, .size = sizeof PICTURE - 1},
                                      {.name = "q r.png", .bytes = PICTURE, .size = sizeof PICTURE - 2}};
    fuzz_request(&(struct zr_request){.format = ZR_FORMAT_OBJ,
                                      .bytes = obj,
                                      .size = sizeof obj - 1,
                                      .width = "32",
                                      .height = "24",
                                      .samples = "1",
                                      .assets = assets,
                                      .asset_count = 3});
    return 0;
}
