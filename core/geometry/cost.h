/* cost.h - geometry: how much work a scene is, counted before any of it is done.
 *
 * Space:  triangles are placed, clipped and measured in the window just as for
 *         drawing, but of a large scene only a sample, evenly spaced, so that the
 *         count costs well under a millisecond. The same scene gives the same cost.
 */
#ifndef ZR_COST_H
#define ZR_COST_H

#include "scene/scene.h"
#include "zraster.h"

/* At most this many polygons of a scene are measured. */
enum { ZR_COST_SAMPLES = 1024 };

#endif
