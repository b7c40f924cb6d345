/* environment_image.h - input: reads an environment image (Radiance HDR, equirectangular) and gathers its light.
 *
 * Image:  the top row is up, the middle column is +x of the environment, a quarter to the right of it is +z, as in
 *         three.js.
 * Suns:   light above 50 times the mean becomes one directional light, if it comes from one place.
 * Exact:  additions, products, quotients and square roots in a fixed order.
 * Source: Ward, "Real Pixels", Graphics Gems II, 1991 (the format); Karis, "Real Shading in Unreal Engine 4", 2013
 *         (gathering with N = V = R); Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance Environment
 *         Maps", 2001.
 */
#ifndef ZR_ENVIRONMENT_IMAGE_H
#define ZR_ENVIRONMENT_IMAGE_H

#include "base/arena.h"
#include "base/status.h"
#include "input/images/image_file.h"
#include "scene/environment_map.h"

/* True if the bytes begin like a Radiance file. */
bool zr_radiance_looks_so(const void *bytes, size_t size);

/* Reads the size from the header, and the offset of the first row. False with the reason. */
bool zr_radiance_head_read(const struct zr_encoded_image *file, uint32_t *width, uint32_t *height, size_t *rows,
                           struct zr_reason *reason);

/* Decodes the rows from offset `rows` on to width * height texels of four bytes: mantissas of RGB, exponent. Checks
 * `cancel` per row. ZR_OK, ZR_CANCELLED, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_radiance_read(const struct zr_encoded_image *file, size_t rows, const struct zr_image *image,
                                uint8_t *rgbe, const struct zr_cancel *cancel, struct zr_reason *reason);

/* Returns 2^(exponent - 136), the factor of the mantissas. */
float zr_radiance_unit(uint8_t exponent);

/* Reads a file and makes its map in the arena. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED (arena->cancel), or ZR_BAD_SCENE with
 * the reason. */
enum zr_status zr_environment_map_read(struct zr_arena *arena, const struct zr_encoded_image *file,
                                       struct zr_environment_map **out, struct zr_reason *reason);

#endif
