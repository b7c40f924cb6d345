/* The reference through OSMesa, Mesa's off-screen interface (up to Mesa 25.0). */
#include <GL/osmesa.h>

#include <stdio.h>
#include <stdlib.h>

#include "reference/gl/reference.h"

/* OSMesa wants a colour buffer of its own before it makes a context current;
 * drawing goes to the frame buffer object, so it is never looked at. */
enum { UNUSED_SIDE = 16 };

struct osmesa {
    OSMesaContext context;
    uint8_t unused[UNUSED_SIDE * UNUSED_SIDE * 4];
};

static void close_context(void *context)
{
    struct osmesa *osmesa = context;
    if (osmesa && osmesa->context) OSMesaDestroyContext(osmesa->context);
    free(osmesa);
}

static void *open_context(struct reference_error *error)
{
    struct osmesa *osmesa = calloc(1, sizeof *osmesa);
    if (osmesa) osmesa->context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
    if (osmesa && osmesa->context &&
        OSMesaMakeCurrent(osmesa->context, osmesa->unused, GL_UNSIGNED_BYTE, UNUSED_SIDE, UNUSED_SIDE))
        return osmesa;
    snprintf(error->text, sizeof error->text, "OSMesa: no context");
    close_context(osmesa);
    return NULL;
}

const struct reference_context reference_context = {"OSMesa", open_context, close_context};
