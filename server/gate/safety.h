/* safety.h - headers that keep browsers from doing more with an answer than showing it, and caches from keeping faults.
 */
#ifndef ZRASTERD_SAFETY_H
#define ZRASTERD_SAFETY_H

#include "answer.h"

/* Adds those that the answer lacks. Pages have policies of their own; pictures and assets, which pages of other sites
 * may show, have Cross-Origin-Resource-Policy: cross-origin. */
void safety_finish(struct answer *answer);

#endif
