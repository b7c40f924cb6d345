/* The decoder of Draco meshes. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "input/codecs/draco.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned char *packed = malloc(size + !size); /* exact size, so that sanitizers find reads beyond it */
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    struct zr_arena arena;
    if (!packed) return 0;
    if (size > 0) memcpy(packed, data, size);
    zr_arena_init(&arena, FUZZ_ARENA_BYTES);
    fuzz_accepted = zr_draco_decode(&arena, NULL, packed, size, &mesh, &reason);
    fuzz_expect(fuzz_accepted || *reason.text || !zr_arena_ok(&arena), "a refusal says why");
    for (size_t i = 0; fuzz_accepted && i < 3 * (size_t)mesh.face_count; i++)
        fuzz_expect(mesh.corners[i] < mesh.point_count, "corners are points");
    zr_arena_free(&arena);
    free(packed);
    return 0;
}
