/* simulator_scene.h - bench: what the camera of a physics simulator asks for, as scene JSON.
 *
 * 32 balls, boxes and cylinders on a ground: instances of meshes of up to 352 triangles with normals, each with a PNG
 * of 256x256 as a data URI, under two lamps, by the shading phong; one request for colour, depth as floats, and ids of
 * the instances.
 */
#ifndef ZR_BENCH_SIMULATOR_SCENE_H
#define ZR_BENCH_SIMULATOR_SCENE_H

#include "bench/input/documents.h"

enum { SIMULATOR_OBJECTS = 32, SIMULATOR_WINDOW = 256 };

/* NULL bytes where there is no memory. */
struct document simulator_scene_make(void);

#endif
