/* formats.h - page: the lists of formats and of marks as JavaScript, which the preprocessor makes of their rows (build.sh). */
#include "format_rows.h"
#include "parameter_kinds.h"
#define FORMAT(ID, suffix, types, is_scene, is_binary, is_soup, is_z_up, text)                                         \
    {ending : suffix, isScene : is_scene, isZUp : is_z_up},
const FORMATS = [ZR_FORMAT_ROWS(FORMAT)];
const MARKS = [ZR_ANNOTATE_WORDS];
