/* features_json.h - output: the object features of a part, for the channel info. */
#ifndef ZR_FEATURES_JSON_H
#define ZR_FEATURES_JSON_H

#include "mesh/features/part_features.h"
#include "output/json/json_print.h"

/* Most groups of holes, bosses or fillets, and most places of a group, that are printed. */
enum { ZR_FEATURE_GROUPS_MAX = 200, ZR_FEATURE_PLACES_MAX = 1000 };

/* Prints the list of the steps of a hole. */
void zr_hole_steps_print(struct zr_print *print, const char *key, const struct zr_hole *hole);

/* Prints "features": its lists, or {"omitted": true} and the reason. `moved` is added to places; NULL: nothing. */
void zr_features_print(struct zr_print *print, const struct zr_part_features *features, const double *moved);

#endif
