#include "shade/lights/lighting.h"

zr_look_light_fn *zr_look_light_of(enum zr_isa isa)
{
    static zr_look_light_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_look_light);
    return table[isa];
}
