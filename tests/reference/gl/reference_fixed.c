/* Point lamps without a range, up to eight, as GL's fixed functions light vertices: attenuation 0, 0, 1. */
#include <string.h>

#include "reference/gl/reference_gl.h"

/* Only where eye space is object space: elsewhere GL takes normals there through an inverse of its own. A face that is
 * drawn by parity is lit on one side, which GL does not do; and a flat triangle has the colour of its last corner in
 * GL, whereas a polygon has that of its first one. */
bool reference_fixed_can(const struct reference_arrays *arrays, const struct reference_batch *batch)
{
    const zr_mat4 identity = zr_mat4_identity();
    const bool is_sided = batch->light == REFERENCE_LIT || (batch->light == REFERENCE_LIT_FRONT && batch->cull);
    const bool is_first = batch->mode == REFERENCE_POLYGON || (batch->smooth && batch->mode == REFERENCE_TRIANGLES);
    const bool is_eye_space = batch->to_eye && memcmp(batch->modelview, &identity, sizeof identity) == 0 &&
                              memcmp(batch->to_eye, &identity, sizeof identity) == 0;
    return arrays->lighting && arrays->lighting->is_fixed && is_sided && is_first && is_eye_space && !batch->late;
}

static void set_light(const struct reference_lighting *lighting, uint32_t i)
{
    static const GLfloat black[4] = {0, 0, 0, 1};
    const GLenum light = GL_LIGHT0 + i;
    const zr_vec3 c = lighting->colors[i];
    const GLfloat color[4] = {c.x, c.y, c.z, 1};
    glEnable(light);
    glLightfv(light, GL_AMBIENT, black);
    glLightfv(light, GL_DIFFUSE, color);
    glLightfv(light, GL_SPECULAR, black);
    glLightfv(light, GL_POSITION, lighting->places[i].position);
    glLightf(light, GL_CONSTANT_ATTENUATION, 0.0f);
    glLightf(light, GL_QUADRATIC_ATTENUATION, 1.0f);
}

/* Normals are unit before: GL would make them so once more. */
void reference_fixed_begin(const struct reference_arrays *arrays)
{
    static const GLfloat black[4] = {0, 0, 0, 1};
    const struct reference_lighting *lighting = arrays->lighting;
    const GLfloat ambient[4] = {lighting->ambient.x, lighting->ambient.y, lighting->ambient.z, 1};
    glUseProgram(0);
    glNormalPointer(GL_FLOAT, sizeof *arrays->unit_normals, arrays->unit_normals);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ambient);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, black);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 1.0f);
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_LIGHTING);
    for (uint32_t i = 0; i < lighting->count; i++)
        set_light(lighting, i);
}

void reference_fixed_end(const struct reference_arrays *arrays)
{
    for (uint32_t i = 0; i < arrays->lighting->count; i++)
        glDisable(GL_LIGHT0 + i);
    glDisable(GL_LIGHTING);
    glDisable(GL_COLOR_MATERIAL);
    glNormalPointer(GL_FLOAT, sizeof *arrays->normals, arrays->normals);
}
