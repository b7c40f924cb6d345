/* sections.h - sections: a scene cut open by planes, as a scene that is drawn instead of it.
 *
 * Space:  planes in world space.
 * What:   instances that a plane crosses get sectioned meshes (sectioned.h), which follow the meshes of the scene.
 *         Instances that are wholly cut away get an empty mesh. All others are shared with the scene. Instances keep
 *         their numbers. Each cap has a material of its own, a copy of that of its part, behind those of the scene; it
 * is double-sided and has no textures but the hatch. Hatch:  a texture of stripes, whose coordinates follow from places
 * in the world: 45 or 135 degrees to the axis that points up in the plane, by the number of the part, and three
 * pitches. Source: ISO 128-50.
 */
#ifndef ZR_SECTIONS_H
#define ZR_SECTIONS_H

#include "base/run.h"
#include "sections/section_planes.h"
#include "sections/sectioned.h"

struct zr_section_cap {
    uint32_t instance;
    uint32_t part; /* of the mesh */
    uint32_t plane;
    double area; /* world units */
};

struct zr_sections_cut {
    const struct zr_scene *scene; /* to be drawn */
    uint32_t cap_count;
    const struct zr_section_cap *caps;
    uint32_t id_count;
    const uint32_t *ids;   /* face id - 1 of the drawn scene -> face id - 1 of the whole one; caps follow its last id */
    uint32_t first_cap_id; /* of the whole scene, minus 1: the number of its ids */
    const char *warning;   /* parts that are not closed and therefore have no caps; NULL: none */
};

/* Cuts the scene. `pitch`: distance of the lines of the hatch, world units. Results lie in the arena. Fails with
 * ZR_BAD_SCENE for positions with w <= 0, for unknown names of uncut parts, and, if the scene is strict, for parts that
 * are not closed; with ZR_NO_MEMORY and ZR_CANCELLED. */
enum zr_status zr_sections_make(const struct zr_run *run, const struct zr_scene *scene,
                                const struct zr_section_planes *planes, double diagonal, double pitch,
                                const struct zr_sections_cut **out);

#endif
