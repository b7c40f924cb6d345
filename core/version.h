/* version.h - the one place that says which version this is. */
#ifndef ZR_VERSION_H
#define ZR_VERSION_H

#define ZR_VERSION "0.1.0"

#endif
