/* resolved_material.h - input: values of a drawn material from the look's and those that its scene or file gives. */
#ifndef ZR_RESOLVED_MATERIAL_H
#define ZR_RESOLVED_MATERIAL_H

#include "input/model/parsed_material.h"

/* Given keys and textures override the look's values, which `material` has. */
void zr_resolved_material_put(const struct zr_parsed_material *given, struct zr_material *material);

/* Leaves only the base colour of a material, with the numbers of its file; white if given is NULL. */
void zr_resolved_material_leave_color(const struct zr_parsed_material *given, struct zr_material *material);

#endif
