/* version.h - the one place that says which version this is. */
#ifndef ZR_VERSION_H
#define ZR_VERSION_H

#define ZR_VERSION "0.1.0"

/* Counts the sets of rules by which a scene becomes pixels; `rules` of the output info. Raised by what moves a pixel of
 * a scene that was right before: 1 drew lines as Mesa 22.3 does, 2 as Mesa 25.0 does. */
#define ZR_RULES 2

#endif
