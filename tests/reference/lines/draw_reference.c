/* The reference opens the context and reads the picture; only what is drawn differs from the batches
 * there. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>

#include "geometry/outline.h"
#include "reference/lines/batch.h"

static struct reference *reference;

bool draw_reference_open(enum line_rule *rule)
{
    struct reference_error error = {""};
    reference = reference_open(&(struct reference_options){.driver = "llvmpipe", .threads = 1}, &error);
    if (reference) printf("# reference: %s\n", reference_name(reference));
    if (reference && line_rule_find(reference, rule, &error)) return true;
    fprintf(stderr, "reference: %s\n", error.text);
    return false;
}

static void set_sides(const struct batch *batch)
{
    static const float black[4] = {0, 0, 0, 1};
    if (!batch->sided) {
        glDisable(GL_LIGHTING);
        return;
    }
    glEnable(GL_LIGHTING);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, black);
    glMaterialfv(GL_FRONT, GL_EMISSION, &batch_front.x);
    glMaterialfv(GL_BACK, GL_EMISSION, &batch_back.x);
}

static void set_state(const struct batch *batch)
{
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glShadeModel(batch->smooth ? GL_SMOOTH : GL_FLAT);
    glPolygonMode(GL_FRONT_AND_BACK, batch->mode == BATCH_OUTLINES ? GL_LINE : GL_FILL);
    (batch->faces == ZR_SIDE_BOTH ? glDisable : glEnable)(GL_CULL_FACE);
    glCullFace(batch->faces == ZR_SIDE_FRONT ? GL_BACK : GL_FRONT);
    (batch->mode == BATCH_FILLED ? glEnable : glDisable)(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(batch->factor, batch->units);
    set_sides(batch);
    glVertexPointer(4, GL_FLOAT, sizeof *batch->positions, batch->positions);
    glColorPointer(4, GL_FLOAT, sizeof *batch->colors, batch->colors);
}

static GLenum kind_of(const struct batch *batch, uint32_t corners)
{
    if (corners == 2) return GL_LINES;
    if (batch->mode == BATCH_LINES) return batch->chain == CHAIN_LOOP ? GL_LINE_LOOP : GL_LINE_STRIP;
    return corners == 3 ? GL_TRIANGLES : GL_POLYGON;
}

static void draw_runs(const struct batch *batch)
{
    const uint32_t *offsets = batch->offsets;
    for (uint32_t i = 0; i < batch->count;) {
        uint32_t corners = offsets[i + 1] - offsets[i], end = i + 1;
        GLenum mode = kind_of(batch, corners);
        while ((mode == GL_LINES || mode == GL_TRIANGLES) && end < batch->count &&
               offsets[end + 1] - offsets[end] == corners)
            end++;
        glDrawArrays(mode, (GLint)offsets[i], (GLsizei)(offsets[end] - offsets[i]));
        i = end;
    }
}

bool draw_reference(const struct batch *batch, struct batch_picture *picture)
{
    struct reference_error error = {""};
    bool ok = reference_resize(reference, batch->width, batch->height, false, &error);
    if (ok) {
        set_state(batch);
        draw_runs(batch);
        glFinish();
        ok = reference_read(reference, picture->rgba, picture->depth, &error);
    }
    if (!ok) fprintf(stderr, "reference: %s\n", error.text);
    return ok;
}
