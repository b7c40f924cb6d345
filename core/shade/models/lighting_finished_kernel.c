/* The kernel of lighting_textured_kernel.c for materials with a finish. They need not have textures. */
#define ZR_FINISHES        true
#define ZR_TEXTURED_KERNEL ZR_KERNEL(zr_linear_light_finished)

#include "shade/models/lighting_textured_kernel.c"
