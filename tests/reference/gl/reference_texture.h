/* reference_texture.h - reference: textures of a scene as GL has them, every level computed here.
 *
 * Levels are those of core/shade/texture_maps.h, from the definition of a mean over an area.
 */
#ifndef ZR_TEST_REFERENCE_TEXTURE_H
#define ZR_TEST_REFERENCE_TEXTURE_H

#include "reference/gl/reference_gl.h"

/* GL texture objects, one a texture of the scene. decode: floats, colours in linear light; else the image's own bits.
 * NULL, and *error says why, where there are none. */
GLuint *reference_textures_make(const struct zr_scene *scene, bool decode, struct reference_error *error);
void reference_textures_delete(const struct zr_scene *scene, GLuint *names);

/* A table of fours of floats for texelFetch, 1024 a row, bound to a unit that no slot has. 0, and *error says why, if
 * there is none. */
enum { REFERENCE_TABLE_UNIT = 15, REFERENCE_TABLE_ROW = 1024 };
GLuint reference_table_make(const float *fours, uint32_t count, struct reference_error *error);
void reference_table_delete(GLuint table);

/* Those of the material, each to the unit that has the number of its slot. */
void reference_textures_bind(const GLuint *names, const struct zr_material *material);

#endif
