/* An NPY file as each list of numbers of a scene. */
#include <string.h>

#include "fuzz/fuzz.h"
#include "render_request.h"

#define MESH(members) "{\"window\":{\"width\":16,\"height\":9},\"meshes\":[{" members "}]}"
#define POSITIONS     "\"positions\":[[0,0,0],[1,0,0],[0,1,0],[1,1,1]]"
#define FACES         "\"faces\":[[0,1,2],[1,3,2]]"
#define ARRAY         ":{\"asset\":\"a\"}"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const scenes[] = {
        MESH("\"positions\"" ARRAY "," FACES),
        MESH(POSITIONS ",\"faces\"" ARRAY),
        MESH("\"faces\"" ARRAY "," POSITIONS),
        MESH(POSITIONS ",\"lines\"" ARRAY),
        MESH(POSITIONS ",\"points\"" ARRAY),
        MESH(POSITIONS "," FACES ",\"colors\"" ARRAY),
        MESH(POSITIONS "," FACES ",\"normals\"" ARRAY),
        MESH(POSITIONS "," FACES ",\"scalars\"" ARRAY),
        MESH("\"heights\"" ARRAY ",\"colormap\":\"turbo\""),
    };
    /* Each scene twice: its bytes are copied, then lent, and used in place. */
    bool accepted = false;
    for (size_t i = 0; i < 2 * sizeof scenes / sizeof *scenes; i++) {
        const struct zr_asset asset = {.name = "a", .bytes = data, .size = size, .is_lent = i % 2};
        fuzz_request(&(struct zr_request){.format = ZR_FORMAT_JSON,
                                          .bytes = scenes[i / 2],
                                          .size = strlen(scenes[i / 2]),
                                          .assets = &asset,
                                          .asset_count = 1});
        accepted |= fuzz_accepted;
    }
    fuzz_accepted = accepted;
    return 0;
}
