/* cost_window.h - cost: lower bounds of the bytes that rendering holds at once, in arrays of the window's size.
 *
 * Space:  views[0] of the scene.
 */
#ifndef ZR_COST_WINDOW_H
#define ZR_COST_WINDOW_H

#include "cost/cost_passes.h"

/* kept: lower bound of translucent samples. fragments: pixels of faces, hidden ones too. */
double zr_cost_window_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes, double kept,
                            double fragments);

/* Bytes of shadow maps of lights. */
double zr_cost_lamp_map_bytes(uint32_t maps);

#endif
