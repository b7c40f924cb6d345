#include "shade/models/xray.h"

#include "base/arena.h"

bool zr_xray_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_scene *out)
{
    struct zr_material *materials = zr_arena_alloc(arena, scene->material_count, sizeof *materials);
    if (!materials) return false;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        materials[i] = scene->materials[i];
        if (materials[i].shading != ZR_SHADING_XRAY) continue;
        materials[i].double_sided = true;
        materials[i].alpha_mode = ZR_ALPHA_BLEND;
    }
    *out = *scene;
    out->materials = materials;
    return true;
}

zr_xray_fn *zr_xray_of(enum zr_isa isa)
{
    static zr_xray_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_xray);
    return table[isa];
}
