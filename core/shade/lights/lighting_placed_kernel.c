/* The kernel of lighting_kernel.c for pictures with lamps that have a place. With code for these in it, that one took a
 * tenth to a quarter longer for other pictures, and twice as long for Gooch's surfaces. */
#define ZR_LIGHTS_PLACED   true
#define ZR_LIGHTING_KERNEL ZR_KERNEL(zr_look_light_placed)

#include "shade/lights/lighting_kernel.c"
