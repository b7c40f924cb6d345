/* Drawing by programs of a test's own, into floats. */
#include <stdio.h>

#include "reference/gl/reference_gl.h"
#include "reference/gl/reference_program.h"

/* Once a size; reference_resize takes it away. */
static bool have_target(struct reference *reference, struct reference_error *error)
{
    if (reference->float_frame_buffer) return true;
    glGenFramebuffers(1, &reference->float_frame_buffer);
    glGenRenderbuffers(1, &reference->float_color);
    glBindRenderbuffer(GL_RENDERBUFFER, reference->float_color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, (GLsizei)reference->width, (GLsizei)reference->height);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->float_frame_buffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, reference->float_color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, reference->depth);
    if (reference->stencil)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, reference->depth);
    bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    return complete || reference_failed(error, "no frame buffer object with 32-bit float colour");
}

static bool no_such(const char *kind, const char *name, struct reference_error *error)
{
    snprintf(error->text, sizeof error->text, "the program has no %s %s", kind, name);
    return false;
}

bool reference_uniform_set(unsigned program, const struct reference_uniform *uniform, struct reference_error *error)
{
    GLint at = glGetUniformLocation(program, uniform->name);
    if (at < 0) return no_such("uniform", uniform->name, error);
    switch (uniform->size) {
    case 1:
        glUniform1fv(at, uniform->count, uniform->values);
        break;
    case 2:
        glUniform2fv(at, uniform->count, uniform->values);
        break;
    case 3:
        glUniform3fv(at, uniform->count, uniform->values);
        break;
    case 4:
        glUniform4fv(at, uniform->count, uniform->values);
        break;
    default:
        glUniformMatrix4fv(at, uniform->count, GL_FALSE, uniform->values);
    }
    return reference_gl_ok(error, uniform->name);
}

static bool point_at_attribute(unsigned program, const struct reference_attribute *attribute,
                               struct reference_error *error)
{
    GLint at = glGetAttribLocation(program, attribute->name);
    if (at < 0) return no_such("attribute", attribute->name, error);
    glVertexAttribPointer((GLuint)at, attribute->size, GL_FLOAT, GL_FALSE, 0, attribute->values);
    glEnableVertexAttribArray((GLuint)at);
    return reference_gl_ok(error, attribute->name);
}

static void leave_attributes(const struct reference_shader *shader)
{
    for (uint32_t i = 0; shader->program && i < shader->attribute_count; i++) {
        GLint at = glGetAttribLocation(shader->program, shader->attributes[i].name);
        if (at >= 0) glDisableVertexAttribArray((GLuint)at);
    }
}

static bool set_inputs(const struct reference_shader *shader, struct reference_error *error)
{
    if (shader->program == 0) return true;
    glUseProgram(shader->program);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    for (uint32_t i = 0; i < shader->uniform_count; i++)
        if (!reference_uniform_set(shader->program, &shader->uniforms[i], error)) return false;
    for (uint32_t i = 0; i < shader->attribute_count; i++)
        if (!point_at_attribute(shader->program, &shader->attributes[i], error)) return false;
    return true;
}

bool reference_draw_floats(struct reference *reference, const struct reference_arrays *arrays,
                           const struct reference_shader *shader, float *rgba, struct reference_error *error)
{
    if (!have_target(reference, error)) return false;
    glBindFramebuffer(GL_FRAMEBUFFER, reference->float_frame_buffer);
    bool ok = reference_set_line_width(arrays->line_width, error) && set_inputs(shader, error);
    if (ok && !shader->program && arrays->lighting) ok = reference_light_begin(reference, arrays, error);
    ok = ok && reference_draw_batches(reference, arrays, shader->program, error);
    if (ok) {
        glReadPixels(0, 0, (GLsizei)reference->width, (GLsizei)reference->height, GL_RGBA, GL_FLOAT, rgba);
        reference_flip(reference, rgba, 4 * sizeof *rgba);
        ok = reference_gl_ok(error, "draw into floats");
    }
    leave_attributes(shader);
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, reference->frame_buffer);
    return ok;
}
