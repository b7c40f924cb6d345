#include "reference/gl/reference_blend.h"

#include <stdlib.h>

#include "reference/gl/reference_gl.h"

/* A point in the middle of each pixel, in the order of the arrays. */
static bool draw_points(const struct reference *reference, const float *rgba)
{
    const size_t count = (size_t)reference->width * reference->height;
    float *places = malloc(count * 2 * sizeof *places);
    if (!places) return false;
    for (size_t i = 0; i < count; i++) {
        places[2 * i] = (float)(i % reference->width) + 0.5f;
        places[2 * i + 1] = (float)(reference->height - 1 - i / reference->width) + 0.5f;
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glVertexPointer(2, GL_FLOAT, 0, places);
    glColorPointer(4, GL_FLOAT, 0, rgba);
    glDrawArrays(GL_POINTS, 0, (GLsizei)count);
    glFinish();
    free(places);
    return true;
}

static void use_pixels(const struct reference *reference)
{
    glUseProgram(0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, reference->width, 0, reference->height, -1, 1);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_FOG);
    glShadeModel(GL_FLAT);
    glPointSize(1.0f);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->float_frame_buffer);
}

static void leave_pixels(const struct reference *reference)
{
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->frame_buffer);
}

bool reference_blend_begin(struct reference *reference, const float *rgba, struct reference_error *error)
{
    if (!reference->float_frame_buffer) return reference_failed(error, "nothing was drawn into floats before");
    use_pixels(reference);
    const bool drawn = draw_points(reference, rgba);
    leave_pixels(reference);
    return drawn ? reference_gl_ok(error, "begin blending") : reference_failed(error, "out of memory");
}

bool reference_blend_layer(struct reference *reference, const float *rgba, struct reference_error *error)
{
    use_pixels(reference);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    const bool drawn = draw_points(reference, rgba);
    leave_pixels(reference);
    return drawn ? reference_gl_ok(error, "blend") : reference_failed(error, "out of memory");
}

bool reference_blend_end(struct reference *reference, float *rgba, struct reference_error *error)
{
    glBindFramebuffer(GL_FRAMEBUFFER, reference->float_frame_buffer);
    glReadPixels(0, 0, (GLsizei)reference->width, (GLsizei)reference->height, GL_RGBA, GL_FLOAT, rgba);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->frame_buffer);
    reference_flip(reference, rgba, 4 * sizeof *rgba);
    return reference_gl_ok(error, "read what was blended");
}
