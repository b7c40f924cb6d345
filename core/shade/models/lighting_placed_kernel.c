/* The kernel of lighting_kernel.c for lamps with positions. In one kernel for both, this code made other pictures a
 * tenth to a quarter slower, and Gooch's surfaces twice as slow. */
#define ZR_LIGHTS_PLACED   true
#define ZR_LIGHTING_KERNEL ZR_KERNEL(zr_linear_light_placed)

#include "shade/models/lighting_kernel.c"
