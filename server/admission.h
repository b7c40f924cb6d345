/* admission.h - may this work begin? Foreseen time and memory in use, against the limits.
 *
 * Time: the renderer counts the work of a scene (zr_scene_cost); what a unit of each kind
 * costs on this machine is measured once, at start, on small scenes. Memory: what the
 * control group says, version 2 or 1, where the daemon runs in one that has a limit.
 */
#ifndef ZRASTERD_ADMISSION_H
#define ZRASTERD_ADMISSION_H

#include <stdbool.h>

#include "zraster.h"

/* Nanoseconds on one thread. */
struct admission {
    double triangle_ns, fragment_ns, pixel_ns, png_pixel_ns;
};

/* Takes some 20 ms. */
void admission_calibrate(struct admission *admission);

/* Milliseconds that rendering and encoding will take on one thread. */
double admission_predict_ms(const struct admission *admission, const struct zr_cost *cost);

/* True where more than ADMISSION_MEMORY_PERCENT of the control group's memory limit is
 * used. Page cache that the kernel can drop at once does not count. `folder` is where the
 * kernel tells, such as /sys/fs/cgroup. */
enum { ADMISSION_MEMORY_PERCENT = 92 };
bool admission_memory_is_short(const char *folder);

#endif
