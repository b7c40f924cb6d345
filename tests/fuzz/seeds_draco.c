/* Seeds of Draco meshes: the streams of draco_streams.h, alone and in a glTF file. */
#include <stdio.h>

#include "fuzz/seeds.h"
#include "support/input/draco_check.h"

void write_draco(void)
{
    for (size_t i = 0; i < DRACO_STREAMS; i++) {
        unsigned char bytes[DRACO_BYTES_MOST];
        const size_t size = draco_stream_bytes(i, bytes);
        char name[32];
        snprintf(name, sizeof name, "draco_%zu", i);
        write_seed("draco", name, bytes, size);
        char text[2 * DRACO_BYTES_MOST];
        if (i < 4) write_seed("gltf", name, text, draco_stream_file(i, "", text));
    }
}
