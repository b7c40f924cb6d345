/* axis_colors.h - input: colours by a coordinate in the world, of bare meshes in their file: heights of a terrain, depths
 * of a scan. */
#ifndef ZR_AXIS_COLORS_H
#define ZR_AXIS_COLORS_H

#include "scene/scene_builder.h"

/* True if the scene's key `colors` names a coordinate. */
static inline bool zr_axis_colors_are_given(const struct zr_scene *scene)
{
    return scene->parts.colors >= ZR_COLORS_X && scene->parts.colors <= ZR_COLORS_Z;
}

/* Replaces all colours of the scene of a closed builder: viridis, from the least to the greatest coordinate of all
 * instances. Instances of one mesh whose coordinates differ get meshes of their own, after all others. False without
 * memory, or if cancelled. */
bool zr_axis_colors_apply(struct zr_scene_builder *builder);

#endif
