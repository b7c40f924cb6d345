/* annotations_json.h - output: the key annotations of the channel info. */
#ifndef ZR_ANNOTATIONS_JSON_H
#define ZR_ANNOTATIONS_JSON_H

#include "output/json/json_print.h"
#include "overlay/annotate/annotate.h"

/* Prints what found no room and the numbers of parts; nothing if the view has no annotations. */
void zr_annotations_print(struct zr_print *print, const struct zr_annotations *annotations);

#endif
