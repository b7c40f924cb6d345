/* Drawing in plain GL 2.1 with frame buffer objects, whoever made the context. */
#include "reference/gl/reference_gl.h"

#include "reference/gl/reference_texture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Stencil bits. A gap is inside by the odd-even rule and in none of the triangles. */
enum { INSIDE = 15, GAP = 128 };

/* Asked by the leak sanitizer, where there is one: Mesa keeps what it made once a
 * process, even after its context is gone. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa.so\nleak:libEGL\nleak:libGLdispatch\nleak:_dri.so\nleak:libgallium\nleak:libLLVM";
}

bool reference_failed(struct reference_error *error, const char *what)
{
    GLenum code = glGetError();
    snprintf(error->text, sizeof error->text, "%s: %s (GL error 0x%04x)", reference_context.name, what, code);
    return false;
}

bool reference_gl_ok(struct reference_error *error, const char *what)
{
    GLenum code = glGetError();
    if (code == GL_NO_ERROR) return true;
    snprintf(error->text, sizeof error->text, "%s: %s gave GL error 0x%04x", reference_context.name, what, code);
    return false;
}

/* ---- opening ---- */

static void set_environment(const struct reference_options *options)
{
    /* The driver would sample textures of bytes in bytes, for speed. What ours equals are floats. */
    if (options->native)
        unsetenv("GALLIVM_PERF");
    else
        setenv("GALLIVM_PERF", "no_aos_sampling", 1);
    /* "avx" would leave fused multiply-add on; SSE4.1 has none. On machines other
     * than x86 Mesa ignores it. */
    if (options->native)
        unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
    else
        setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse4.1", 1);
    setenv("GALLIUM_DRIVER", options->driver, 1);
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
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearDepth(1.0);
    glClearStencil(0);
    glPolygonOffset(1.0f, 1.0f);
    glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

static int parse_version(const char *version)
{
    const char *mesa = version ? strstr(version, "Mesa ") : NULL;
    int major, minor;
    return mesa && sscanf(mesa, "Mesa %d.%d", &major, &minor) == 2 ? 100 * major + minor : 0;
}

struct reference *reference_open(const struct reference_options *options, struct reference_error *error)
{
    set_environment(options);
    struct reference *reference = calloc(1, sizeof *reference);
    if (!reference) return NULL;
    reference->context = reference_context.open(error);
    if (!reference->context) {
        free(reference);
        return NULL;
    }
    const char *renderer = (const char *)glGetString(GL_RENDERER), *version = (const char *)glGetString(GL_VERSION);
    snprintf(reference->name, sizeof reference->name, "%s; %s; %s", reference_context.name, renderer ? renderer : "?",
             version ? version : "?");
    reference->mesa_version = parse_version(version);
    if (!renderer || !strstr(renderer, options->driver)) {
        snprintf(error->text, sizeof error->text, "the renderer is not %s but %s", options->driver, reference->name);
        reference_close(reference);
        return NULL;
    }
    set_state();
    return reference;
}

void reference_close(struct reference *reference)
{
    if (!reference) return;
    reference_context.close(reference->context);
    free(reference->row);
    free(reference);
}

const char *reference_name(const struct reference *reference)
{
    return reference->name;
}

int reference_mesa_version(const struct reference *reference)
{
    return reference->mesa_version;
}

/* ---- the frame buffer object ---- */

bool reference_resize(struct reference *reference, uint32_t width, uint32_t height, bool parity,
                      struct reference_error *error)
{
    if (reference->width == width && reference->height == height && reference->stencil == parity) return true;
    uint8_t *row = realloc(reference->row, (size_t)width * 4 * sizeof(float));
    if (!row) return reference_failed(error, "out of memory");
    reference->row = row;
    glDeleteFramebuffers(1, &reference->frame_buffer);
    glDeleteRenderbuffers(1, &reference->color);
    glDeleteRenderbuffers(1, &reference->depth);
    glDeleteFramebuffers(1, &reference->float_frame_buffer);
    glDeleteRenderbuffers(1, &reference->float_color);
    reference->float_frame_buffer = reference->float_color = 0;
    glGenFramebuffers(1, &reference->frame_buffer);
    glGenRenderbuffers(1, &reference->color);
    glGenRenderbuffers(1, &reference->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, reference->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, (GLsizei)width, (GLsizei)height);
    glBindRenderbuffer(GL_RENDERBUFFER, reference->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, parity ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F, (GLsizei)width,
                          (GLsizei)height);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->frame_buffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, reference->color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, reference->depth);
    if (parity) glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, reference->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return reference_failed(error, "no frame buffer object with RGBA8 and 32-bit float depth");
    glViewport(0, 0, (GLsizei)width, (GLsizei)height);
    reference->width = width;
    reference->height = height;
    reference->stencil = parity;
    return reference_gl_ok(error, "resize");
}

/* ---- drawing ---- */

static void enable(GLenum what, bool on)
{
    if (on)
        glEnable(what);
    else
        glDisable(what);
}

bool reference_keep(struct reference *reference, const struct reference_arrays *arrays, uint32_t vertex_count,
                    uint32_t index_count, struct reference_error *error)
{
    const struct {
        const void *bytes;
        size_t size;
    } parts[] = {{arrays->positions, vertex_count * sizeof *arrays->positions},
                 {arrays->front, vertex_count * sizeof *arrays->front},
                 {arrays->indices, index_count * sizeof *arrays->indices}};
    glDeleteBuffers(3, reference->buffers);
    glGenBuffers(3, reference->buffers);
    for (int i = 0; i < 3; i++) {
        glBindBuffer(GL_ARRAY_BUFFER, reference->buffers[i]);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)parts[i].size, parts[i].bytes, GL_STATIC_DRAW);
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    reference->kept = arrays->positions;
    return reference_gl_ok(error, "keep");
}

static bool is_kept(const struct reference *reference, const struct reference_arrays *arrays)
{
    return reference->kept && reference->kept == arrays->positions;
}

static void point_at_arrays(const struct reference *reference, const struct reference_arrays *arrays)
{
    bool kept = is_kept(reference, arrays);
    glBindBuffer(GL_ARRAY_BUFFER, kept ? reference->buffers[0] : 0);
    glVertexPointer(4, GL_FLOAT, sizeof *arrays->positions, kept ? NULL : arrays->positions);
    glBindBuffer(GL_ARRAY_BUFFER, kept ? reference->buffers[1] : 0);
    glColorPointer(4, GL_FLOAT, sizeof *arrays->front, kept ? NULL : arrays->front);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, kept ? reference->buffers[2] : 0);
    if (arrays->texcoords) {
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
        glTexCoordPointer(4, GL_FLOAT, sizeof *arrays->texcoords, arrays->texcoords);
    }
    if (!arrays->normals) return;
    glEnableClientState(GL_NORMAL_ARRAY);
    glNormalPointer(GL_FLOAT, sizeof *arrays->normals, arrays->normals);
    if (!arrays->lighting || !arrays->lighting->places) return;
    glClientActiveTexture(GL_TEXTURE1); /* beside the place in an image */
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    glTexCoordPointer(3, GL_FLOAT, sizeof *arrays->light_points, arrays->light_points);
    glClientActiveTexture(GL_TEXTURE0);
}

static void draw_corners(const struct reference *reference, const struct reference_arrays *arrays, GLenum mode,
                         uint32_t first, uint32_t count)
{
    if (count == 0) return;
    if (is_kept(reference, arrays))
        glDrawElements(mode, (GLsizei)count, GL_UNSIGNED_INT, (const void *)(first * sizeof *arrays->indices));
    else if (arrays->indices)
        glDrawElements(mode, (GLsizei)count, GL_UNSIGNED_INT, arrays->indices + first);
    else
        glDrawArrays(mode, (GLint)first, (GLsizei)count);
}

static void write_pixels(bool on)
{
    GLboolean mask = on ? GL_TRUE : GL_FALSE;
    glColorMask(mask, mask, mask, mask);
    glDepthMask(mask);
    enable(GL_DEPTH_TEST, on);
}

/* Counts the rings' fans at each sample: their parity, or up for one winding and down for the other. */
static void count_rings(const struct reference *reference, const struct reference_arrays *arrays,
                        const struct reference_batch *batch)
{
    glStencilMask(batch->winding ? INSIDE : 1);
    glStencilFunc(GL_ALWAYS, 0, INSIDE);
    glStencilOp(GL_KEEP, GL_INVERT, GL_INVERT);
    if (batch->winding) {
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_INCR_WRAP, GL_INCR_WRAP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_DECR_WRAP, GL_DECR_WRAP);
    }
    draw_corners(reference, arrays, GL_TRIANGLES, batch->rings_first, batch->rings_count);
    glStencilMask(INSIDE);
    if (batch->claim == 0) return;
    glStencilFunc(GL_EQUAL, batch->claim, batch->claim); /* what an earlier cap of the plane has taken */
    glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->rings_first, batch->rings_count);
    glStencilMask(batch->claim);
    glStencilFunc(GL_NOTEQUAL, batch->claim, INSIDE);
    glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->rings_first, batch->rings_count);
    glStencilMask(INSIDE);
}

/* The count of the rings' fans in stencil bits; then the triangles where it is not 0, each clearing it, so that the
 * first decides. What is left is marked as a gap. */
static void draw_parity(const struct reference *reference, const struct reference_arrays *arrays,
                        const struct reference_batch *batch)
{
    glEnable(GL_STENCIL_TEST);
    write_pixels(false);
    glDisable(GL_CULL_FACE);
    count_rings(reference, arrays, batch);

    write_pixels(true);
    enable(GL_CULL_FACE, batch->cull);
    glStencilFunc(GL_NOTEQUAL, 0, INSIDE);
    glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->first, batch->count);

    write_pixels(false); /* culled triangles leave no gaps */
    glDisable(GL_CULL_FACE);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->first, batch->count);
    glStencilMask(GAP); /* the reference value has it, and differs from 0 in the bits that are compared */
    glStencilFunc(GL_NOTEQUAL, GAP, INSIDE);
    glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->rings_first, batch->rings_count);
    glStencilMask(INSIDE);
    glStencilFunc(GL_NOTEQUAL, 0, INSIDE);
    glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
    draw_corners(reference, arrays, GL_TRIANGLES, batch->rings_first, batch->rings_count);
    write_pixels(true);
    glDisable(GL_STENCIL_TEST);
}

/* Fixed functions multiply by the texture of unit 0, whichever program lights vertices. */
static void set_textures(const struct reference_batch *batch, const GLuint *textures)
{
    if (batch->textured && textures) reference_textures_bind(textures, batch->textured);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    enable(GL_TEXTURE_2D, batch->textured && textures);
}

static void draw_batch(struct reference *reference, const struct reference_arrays *arrays,
                       const struct reference_batch *batch, const GLuint *textures, GLuint program)
{
    static const GLenum modes[] = {[REFERENCE_TRIANGLES] = GL_TRIANGLES,
                                   [REFERENCE_POLYGON] = GL_POLYGON,
                                   [REFERENCE_LINES] = GL_LINES,
                                   [REFERENCE_POINTS] = GL_POINTS};
    glShadeModel(batch->smooth ? GL_SMOOTH : GL_FLAT);
    glProvokingVertex(batch->first_provokes ? GL_FIRST_VERTEX_CONVENTION : GL_LAST_VERTEX_CONVENTION);
    glFrontFace(batch->mirrored ? GL_CW : GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, batch->outline ? GL_LINE : GL_FILL);
    if (batch->mode == REFERENCE_POINTS) glPointSize(batch->point_size);
    enable(GL_CULL_FACE, batch->cull);
    enable(GL_POLYGON_OFFSET_FILL, batch->depth_offset);
    set_textures(batch, textures);
    const bool is_fixed = !program && reference_fixed_can(arrays, batch);
    if (program)
        reference_program_batch(program, batch, arrays->textures_of);
    else
        reference_light_batch(reference, arrays, batch);
    if (is_fixed) reference_fixed_begin(arrays);
    if (batch->mode == REFERENCE_PARITY)
        draw_parity(reference, arrays, batch);
    else
        draw_corners(reference, arrays, modes[batch->mode], batch->first, batch->count);
    if (is_fixed) reference_fixed_end(arrays);
}

/* Sets the fog of fixed functions and of programs, which read the same state. */
static void set_fog(const struct zr_fog *fog)
{
    const GLfloat color[4] = {fog->color.x, fog->color.y, fog->color.z, 1.0f};
    glFogi(GL_FOG_MODE, GL_LINEAR);
    glFogi(GL_FOG_COORDINATE_SOURCE, GL_FRAGMENT_DEPTH);
    glFogfv(GL_FOG_COLOR, color);
    glFogf(GL_FOG_START, fog->is_on ? fog->near : 0.0f);
    glFogf(GL_FOG_END, fog->is_on ? fog->far : 1.0f);
    if (fog->is_on)
        glEnable(GL_FOG);
    else
        glDisable(GL_FOG);
}

bool reference_set_line_width(float pixels, struct reference_error *error)
{
    GLfloat range[2] = {0, 0};
    const GLfloat width = pixels > 0.0f ? pixels : 1.0f;
    glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range);
    if (width > range[1]) {
        snprintf(error->text, sizeof error->text, "%s has no lines %g pixels wide, but up to %g",
                 reference_context.name, (double)width, (double)range[1]);
        return false;
    }
    glLineWidth(width);
    return reference_gl_ok(error, "line width");
}

bool reference_has_point_sizes(const struct reference_arrays *arrays, struct reference_error *error)
{
    GLfloat range[2] = {0, 0};
    glGetFloatv(GL_ALIASED_POINT_SIZE_RANGE, range);
    for (uint32_t i = 0; i < arrays->batch_count; i++) {
        const struct reference_batch *batch = &arrays->batches[i];
        if (batch->mode != REFERENCE_POINTS || batch->point_size <= range[1]) continue;
        snprintf(error->text, sizeof error->text, "%s has no points of %g pixels, but up to %g", reference_context.name,
                 (double)batch->point_size, (double)range[1]);
        return false;
    }
    return true;
}

bool reference_draw_batches(struct reference *reference, const struct reference_arrays *arrays, GLuint program,
                            struct reference_error *error)
{
    const zr_mat4 *modelview = NULL;
    GLuint *textures = NULL;
    if (arrays->textures_of && !(textures = reference_textures_make(arrays->textures_of, arrays->decode, error)))
        return false;
    glClearColor(arrays->background.x, arrays->background.y, arrays->background.z, arrays->background.w);
    glStencilMask(~0u);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | (reference->stencil ? GL_STENCIL_BUFFER_BIT : 0u));
    set_fog(&arrays->fog);
    enable(GL_BLEND, arrays->blended);
    enable(GL_DEPTH_TEST, !arrays->blended);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(arrays->projection.m);
    glMatrixMode(GL_MODELVIEW);
    point_at_arrays(reference, arrays);
    for (uint32_t i = 0; i < arrays->batch_count; i++) {
        const struct reference_batch *batch = &arrays->batches[i];
        if (batch->modelview != modelview) glLoadMatrixf(batch->modelview->m);
        modelview = batch->modelview;
        draw_batch(reference, arrays, batch, textures, program);
    }
    glDisableClientState(GL_NORMAL_ARRAY);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glClientActiveTexture(GL_TEXTURE1);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
    glClientActiveTexture(GL_TEXTURE0);
    glDisable(GL_TEXTURE_2D);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glUseProgram(0);
    glFinish();
    if (textures) reference_textures_delete(arrays->textures_of, textures);
    return true;
}

bool reference_draw(struct reference *reference, const struct reference_arrays *arrays, struct reference_error *error)
{
    if (arrays->lighting && !reference_light_begin(reference, arrays, error)) return false;
    if (!reference_set_line_width(arrays->line_width, error) || !reference_has_point_sizes(arrays, error)) return false;
    return reference_draw_batches(reference, arrays, 0, error) && reference_gl_ok(error, "draw");
}

/* ---- reading ---- */

void reference_flip(const struct reference *reference, void *pixels, size_t pixel_bytes)
{
    size_t row_bytes = reference->width * pixel_bytes;
    for (uint32_t y = 0; y < reference->height / 2; y++) {
        char *a = (char *)pixels + y * row_bytes, *b = (char *)pixels + (reference->height - 1 - y) * row_bytes;
        memcpy(reference->row, a, row_bytes);
        memcpy(a, b, row_bytes);
        memcpy(b, reference->row, row_bytes);
    }
}

bool reference_read(struct reference *reference, uint8_t *rgba, float *depth, struct reference_error *error)
{
    GLsizei width = (GLsizei)reference->width, height = (GLsizei)reference->height;
    if (rgba) {
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        reference_flip(reference, rgba, 4);
    }
    if (depth) {
        glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
        reference_flip(reference, depth, sizeof *depth);
    }
    return reference_gl_ok(error, "read");
}

bool reference_read_gaps(struct reference *reference, uint8_t *gaps, struct reference_error *error)
{
    size_t pixels = (size_t)reference->width * reference->height;
    memset(gaps, 0, pixels);
    if (!reference->stencil) return true;
    glReadPixels(0, 0, (GLsizei)reference->width, (GLsizei)reference->height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, gaps);
    reference_flip(reference, gaps, 1);
    for (size_t i = 0; i < pixels; i++)
        gaps[i] = gaps[i] & GAP ? 1 : 0;
    return reference_gl_ok(error, "read");
}
