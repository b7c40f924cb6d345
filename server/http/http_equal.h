/* http_equal.h - equal requests that are under way at once: the first one leads, and its answer is also that of its
 * followers. For http*.c only. On the thread of the loop.
 *
 * Equal:     requests are compared byte by byte, with all that a picture depends on.
 * Followers: wait in no queue and hold no worker. A leader whose client left works on while it has followers. If its
 *            work gives no picture, each follower is worked on by itself.
 */
#ifndef ZRASTERD_HTTP_EQUAL_H
#define ZRASTERD_HTTP_EQUAL_H

#include "http_state.h"

/* Makes the exchange the follower of an equal one, if there is one at work that is not cancelled. Its body is here. */
bool http_equal_follow(struct exchange *exchange);

/* Lets later requests follow the exchange, whose work begins, unless its answer may not be shared. */
void http_equal_lead(struct exchange *exchange);

/* Ends its leading or following. Its own followers stay its. */
void http_equal_leave(struct exchange *exchange);

/* Removes a follower from its leader and returns it. NULL: there are none. */
struct exchange *http_equal_take_follower(struct exchange *leader);

#endif
