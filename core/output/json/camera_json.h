/* camera_json.h - output: the key "camera": matrices, planes and angles of a view. */
#ifndef ZR_CAMERA_JSON_H
#define ZR_CAMERA_JSON_H

#include "output/json/json_print.h"
#include "shade/frame.h"

/* Prints the key with the camera of the frame, and the lens of its view. z_is_up: axis of the angles. */
void zr_camera_print(struct zr_print *print, const struct zr_frame *frame, bool z_is_up);

/* Prints the key "worldToCamera", from the places that the client gives: those of the scene plus `moved`, three numbers;
 * NULL: nothing was subtracted. */
void zr_camera_print_pose(struct zr_print *print, const struct zr_camera *camera, const double *moved);

#endif
