/* A query. Its first byte chooses the body: a model of two parts, points, or a scene. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "input/query/query_text.h"
#include "render_request.h"

static const struct {
    enum zr_format format;
    const char *text;
} BODIES[] = {{ZR_FORMAT_OBJ, "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\no b\n"
                              "v 2 0 0\nv 3 0 0\nv 2 1 1\nf 5 6 7\n"},
              {ZR_FORMAT_XYZ, "0 0 0\n1 0 0\n0 1 0\n1 1 2\n"},
              {ZR_FORMAT_JSON,
               "{\"window\":{\"width\":48,\"height\":32},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,1]]}]}"}};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const size_t body = size > 0 ? data[0] % (sizeof BODIES / sizeof *BODIES) : 0;
    struct zr_request request = {
        .format = BODIES[body].format, .bytes = BODIES[body].text, .size = strlen(BODIES[body].text)};
    struct zr_error error = {0};
    char *query = size > 0 ? strndup((const char *)data + 1, size - 1) : NULL;
    char *values = query ? malloc(zr_query_room(query)) : NULL;
    fuzz_accepted = false;
    if (values && zr_query_split(query, values, &request, &error) == ZR_OK) {
        if (body < 2 && !request.width) request.width = "48";
        if (body < 2 && !request.height) request.height = "32";
        fuzz_request(&request);
    }
    free(values);
    free(query);
    return 0;
}
