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

/* Those of the material, each to the unit that has the number of its slot. */
void reference_textures_bind(const GLuint *names, const struct zr_material *material);

#endif
