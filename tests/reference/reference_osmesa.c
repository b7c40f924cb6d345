/* The reference through OSMesa, Mesa's off-screen interface (up to Mesa 25.0). */
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/reference.h"

/* OSMesa wants a colour buffer of its own before it makes a context current;
 * drawing goes to the frame buffer object, so it is never looked at. */
enum { UNUSED_SIDE = 16 };

struct osmesa {
    OSMesaContext context;
    char renderer[120];
    uint32_t width, height;
    GLuint frame_buffer, color, depth;
    uint8_t *rgba_row;
    float *depth_row;
    uint8_t unused[UNUSED_SIDE * UNUSED_SIDE * 4];
};

/* Asked by the leak sanitizer, where there is one: Mesa keeps a frame buffer of
 * 480 bytes for good, even after its context is gone. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa.so";
}

static bool failed(struct reference_error *error, const char *what)
{
    GLenum code = glGetError();
    snprintf(error->text, sizeof error->text, "OSMesa: %s (GL error 0x%04x)", what, code);
    return false;
}

static bool gl_ok(struct reference_error *error, const char *what)
{
    GLenum code = glGetError();
    if (code == GL_NO_ERROR) return true;
    snprintf(error->text, sizeof error->text, "OSMesa: %s gave GL error 0x%04x", what, code);
    return false;
}

static void set_environment(const struct reference_options *options)
{
    /* "avx" would leave fused multiply-add on; SSE4.1 has none. On machines other
     * than x86 Mesa ignores it. */
    if (options->native)
        unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
    else
        setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    unsetenv("LP_NUM_THREADS");
    if (options->threads > 0) {
        char text[16];
        /* llvmpipe counts helpers: with 0 of them the caller rasterizes. */
        snprintf(text, sizeof text, "%d", options->threads == 1 ? 0 : options->threads);
        setenv("LP_NUM_THREADS", text, 1);
    }
}

static void set_state(void)
{
    glDisable(GL_DITHER);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1.0);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

static void close_context(void *state)
{
    struct osmesa *osmesa = state;
    if (!osmesa) return;
    if (osmesa->context) OSMesaDestroyContext(osmesa->context);
    free(osmesa->rgba_row);
    free(osmesa->depth_row);
    free(osmesa);
}

static void *open_context(const struct reference_options *options, struct reference_error *error)
{
    set_environment(options);
    struct osmesa *osmesa = calloc(1, sizeof *osmesa);
    if (osmesa) osmesa->context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
    if (!osmesa || !osmesa->context ||
        !OSMesaMakeCurrent(osmesa->context, osmesa->unused, GL_UNSIGNED_BYTE, UNUSED_SIDE, UNUSED_SIDE)) {
        snprintf(error->text, sizeof error->text, "OSMesa: no context");
        close_context(osmesa);
        return NULL;
    }
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    snprintf(osmesa->renderer, sizeof osmesa->renderer, "%s; %s", renderer ? renderer : "?",
             (const char *)glGetString(GL_VERSION));
    if (!strstr(osmesa->renderer, "llvmpipe")) {
        snprintf(error->text, sizeof error->text, "OSMesa: the renderer is not llvmpipe but %s", osmesa->renderer);
        close_context(osmesa);
        return NULL;
    }
    set_state();
    return osmesa;
}

static const char *renderer(void *state)
{
    return ((struct osmesa *)state)->renderer;
}

static bool widen_rows(struct osmesa *osmesa, uint32_t width)
{
    uint8_t *rgba_row = realloc(osmesa->rgba_row, (size_t)width * 4);
    if (rgba_row) osmesa->rgba_row = rgba_row;
    float *depth_row = realloc(osmesa->depth_row, (size_t)width * sizeof *depth_row);
    if (depth_row) osmesa->depth_row = depth_row;
    return rgba_row && depth_row;
}

static bool resize(void *state, uint32_t width, uint32_t height, struct reference_error *error)
{
    struct osmesa *osmesa = state;
    if (osmesa->width == width && osmesa->height == height) return true;
    if (!widen_rows(osmesa, width)) return failed(error, "out of memory");
    glDeleteFramebuffers(1, &osmesa->frame_buffer);
    glDeleteRenderbuffers(1, &osmesa->color);
    glDeleteRenderbuffers(1, &osmesa->depth);
    glGenFramebuffers(1, &osmesa->frame_buffer);
    glGenRenderbuffers(1, &osmesa->color);
    glGenRenderbuffers(1, &osmesa->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, osmesa->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, (GLsizei)width, (GLsizei)height);
    glBindRenderbuffer(GL_RENDERBUFFER, osmesa->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, (GLsizei)width, (GLsizei)height);
    glBindFramebuffer(GL_FRAMEBUFFER, osmesa->frame_buffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, osmesa->color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, osmesa->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return failed(error, "no frame buffer object with RGBA8 and DEPTH_COMPONENT32F");
    glViewport(0, 0, (GLsizei)width, (GLsizei)height);
    osmesa->width = width;
    osmesa->height = height;
    return gl_ok(error, "resize");
}

static void draw_faces(const uint32_t *offsets, uint32_t count)
{
    for (uint32_t face = 0; face < count;) {
        uint32_t end = face + 1;
        GLenum mode = GL_POLYGON;
        if (offsets[end] - offsets[face] == 3) {
            mode = GL_TRIANGLES;
            while (end < count && offsets[end + 1] - offsets[end] == 3)
                end++;
        }
        glDrawArrays(mode, (GLint)offsets[face], (GLsizei)(offsets[end] - offsets[face]));
        face = end;
    }
}

static bool draw(void *state, const struct reference_arrays *arrays, struct reference_error *error)
{
    (void)state;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glShadeModel(arrays->smooth ? GL_SMOOTH : GL_FLAT);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(arrays->projection.m);
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(arrays->modelview.m);
    glVertexPointer(4, GL_FLOAT, sizeof *arrays->positions, arrays->positions);
    glColorPointer(4, GL_FLOAT, sizeof *arrays->colors, arrays->colors);
    if (arrays->indices)
        glDrawElements(GL_TRIANGLES, (GLsizei)(3 * arrays->face_count), GL_UNSIGNED_INT, arrays->indices);
    else
        draw_faces(arrays->face_offsets, arrays->face_count);
    glFinish();
    return gl_ok(error, "draw");
}

/* GL's row 0 is the bottom. */
static void flip(void *pixels, void *row, size_t row_bytes, uint32_t height)
{
    for (uint32_t y = 0; y < height / 2; y++) {
        char *a = (char *)pixels + y * row_bytes, *b = (char *)pixels + (height - 1 - y) * row_bytes;
        memcpy(row, a, row_bytes);
        memcpy(a, b, row_bytes);
        memcpy(b, row, row_bytes);
    }
}

static bool read_pixels(void *state, uint8_t *rgba, float *depth, struct reference_error *error)
{
    struct osmesa *osmesa = state;
    GLsizei width = (GLsizei)osmesa->width, height = (GLsizei)osmesa->height;
    if (rgba) {
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        flip(rgba, osmesa->rgba_row, (size_t)osmesa->width * 4, osmesa->height);
    }
    if (depth) {
        glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
        flip(depth, osmesa->depth_row, (size_t)osmesa->width * sizeof *depth, osmesa->height);
    }
    return gl_ok(error, "read");
}

const struct reference_backend reference_osmesa = {.name = "osmesa",
                                                   .open = open_context,
                                                   .close = close_context,
                                                   .renderer = renderer,
                                                   .resize = resize,
                                                   .draw = draw,
                                                   .read = read_pixels};
