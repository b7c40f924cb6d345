/* Bytes as an image, as the textures of a scene have it read. */
#include <string.h>

#include "fuzz/fuzz.h"
#include "input/images/image_read.h"

static void fill(struct zr_arena *arena, int byte)
{
    enum { ROOM = 1 << 17 };
    memset(zr_arena_alloc(arena, ROOM, 1), byte, ROOM);
    zr_arena_reset(arena, ZR_ARENA_BLOCK);
}

static enum zr_status read_over(struct zr_arena *arena, int byte, const uint8_t *data, size_t size,
                                struct zr_image *image)
{
    struct zr_reason reason = {""};
    fill(arena, byte);
    const enum zr_status status =
        zr_image_read(arena, &(struct zr_encoded_image){data, size, FUZZ_TEXELS_MAX}, image, &reason);
    fuzz_expect(status == ZR_OK || status == ZR_NO_MEMORY || status == ZR_BAD_SCENE, "no other status");
    fuzz_expect(status != ZR_BAD_SCENE || *reason.text, "a refusal says what is wrong");
    fuzz_expect(zr_arena_ok(arena) == (status != ZR_NO_MEMORY), "the arena knows of it");
    return status;
}

void fuzz_image(const uint8_t *data, size_t size)
{
    static struct zr_arena arenas[2];
    struct zr_image images[2] = {{0}};
    enum zr_status statuses[2];
    for (int i = 0; i < 2; i++) {
        if (!arenas[i].ceiling) zr_arena_init(&arenas[i], FUZZ_ARENA_BYTES);
        statuses[i] = read_over(&arenas[i], i ? 0x55 : 0xaa, data, size, &images[i]);
    }
    fuzz_accepted = statuses[0] == ZR_OK;
    fuzz_expect(statuses[0] == statuses[1], "the status is the same each time");
    if (fuzz_accepted) {
        const uint64_t texels = (uint64_t)images[0].width * images[0].height;
        fuzz_expect(texels > 0 && texels <= FUZZ_TEXELS_MAX, "there are as many texels as there may be");
        fuzz_expect(images[0].bits == 8 || images[0].bits == 16, "of 8 or 16 bits");
        fuzz_expect(images[0].width == images[1].width && images[0].height == images[1].height &&
                        images[0].bits == images[1].bits,
                    "of one size");
        fuzz_expect(memcmp(images[0].texels, images[1].texels, texels * images[0].bits / 2) == 0, "of the same values");
    }
    for (int i = 0; i < 2; i++)
        zr_arena_reset(&arenas[i], ZR_ARENA_BLOCK);
}
