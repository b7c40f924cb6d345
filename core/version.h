/* version.h - core: version of the program and of the rules. */
#ifndef ZR_VERSION_H
#define ZR_VERSION_H

#define ZR_VERSION "0.2.0"

/* Version of the rules that turn a scene into pixels; `rules` of the output info. A change that moves a pixel of a
 * correct scene raises it. Version 1 drew lines as Mesa 22.3, version 2 draws them as Mesa 25.0. Version 3 draws blended surfaces at the
 * depth of opaque ones. */
#define ZR_RULES 3

#endif
