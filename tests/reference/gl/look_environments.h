/* look_environments.h - reference: light of environments, in GLSL (look_program.c), written from the definition.
 *
 * vec3 diffuse_light(vec3 n), vec3 mirrored_light(vec3 d, float alpha) and vec3 turned(vec3 v), which takes a direction
 * of the eye to one of the environment. They read the uniforms environment, around, around_map and to_environment.
 */
#ifndef ZR_TEST_LOOK_ENVIRONMENTS_H
#define ZR_TEST_LOOK_ENVIRONMENTS_H

/* The second follows the first. */
extern const char *const look_environments, *const look_radiances;

#endif
