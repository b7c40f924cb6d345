/* draw.c - draws a scene or a mesh to a file by libzraster.
 *
 *     cc draw.c -o draw $(pkg-config --cflags --libs zraster)
 *     ./draw part.stl part.png look=technical
 */
#include <stdio.h>
#include <stdlib.h>
#include <zraster.h>

static char bytes[1 << 24];

int main(int argc, char **argv)
{
    zraster *renderer = NULL;
    zraster_picture *picture = NULL;
    zraster_error *error = NULL;
    static struct zraster_request request; /* all members are 0 */
    struct zraster_bytes png;
    FILE *in = argc > 2 ? fopen(argv[1], "rb") : NULL, *out = in ? fopen(argv[2], "wb") : NULL;
    if (!out) return fprintf(stderr, "usage: draw MODEL PICTURE [QUERY]\n"), EXIT_FAILURE;
    request.struct_size = sizeof request;
    request.body = bytes;
    request.body_size = fread(bytes, 1, sizeof bytes, in);
    request.query = argc > 3 ? argv[3] : NULL;
    if (zraster_open(NULL, &renderer) == ZRASTER_OK &&
        zraster_draw(renderer, &request, &picture, &error) == ZRASTER_OK &&
        zraster_picture_encode(picture, NULL, &png, &error) == ZRASTER_OK)
        fwrite(png.data, 1, png.size, out);
    else
        fprintf(stderr, "%s\n", zraster_error_text(error));
    fclose(in);
    fclose(out);
    zraster_error_free(error);
    zraster_picture_free(picture);
    zraster_close(renderer);
    return picture ? EXIT_SUCCESS : EXIT_FAILURE;
}
